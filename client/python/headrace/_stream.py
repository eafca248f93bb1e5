"""Frames as they come: lossless, where the run waits for a slow reader, or live, where a slow reader loses frames."""

from __future__ import annotations

import time
from collections import deque
from typing import Any, Callable, Mapping

import zmq

from . import errors
from ._connection import Channel, Connection, is_json
from ._operation import Steps, operation
from .frame import Frame

QUIET = 0.05  # [s] without a frame, after which it is asked whether the run has ended
LAST_WORDS = 1.0  # [s] that a closed socket may take to send what it was given
UNDER_WAY = ("running", "paused", "loading")


class LosslessSource:
    """Over the data socket. A frame is acknowledged when the next one is asked for: then it was dealt with."""

    def __init__(self, connection: Connection, options: Mapping[str, Any]) -> None:
        self._connection, self._options = connection, options
        self.id: str | None = None
        self._arrived: deque[Frame] = deque()
        self._seq = self._acked = 0  # of the last frame handed out, and acknowledged
        self._last: int | None = None  # known when the stream is closed

    def open(self) -> Steps[None]:
        self._channel = self._connection.connect("data")
        opened = yield from self._channel.call("stream.open", {"mode": "lossless", **self._options}, self._keep)
        self.id = opened["stream"]
        self._window: int = opened["window"]
        self._seq = self._acked = int(opened["next_seq"]) - 1  # not 0 where an earlier reader is replaced

    def read(self, seconds: float) -> Steps[Frame | None]:
        """The next frame; None when none comes in time."""
        if self._seq > self._acked:
            self._channel.send("stream.ack", {"stream": self.id, "seq": self._seq}, notify=True)
            self._acked = self._seq
        if not self._arrived:
            for part in (yield from self._channel.receive(seconds)) or ():
                if not is_json(part):
                    self._keep(part)
        if not self._arrived:
            return None
        frame = self._arrived.popleft()
        if frame.seq != self._seq + 1:
            raise errors.ConnectionFailed(f"frames {self._seq + 1} to {frame.seq - 1} of the stream are missing")
        self._seq = frame.seq
        return frame

    def check(self) -> Steps[None]:
        """Raises when the stream has failed or the server is gone."""
        yield from self._channel.call("stream.ack", {"stream": self.id, "seq": self._seq}, self._keep)

    def finish(self) -> Steps[None]:
        """No further frame is captured; those that were can still be read."""
        if self._last is None:
            closed = yield from self._channel.call("stream.close", {"stream": self.id}, self._keep)
            self._last = int(closed["last_seq"])

    def is_drained(self) -> bool:
        return self._last is not None and self._seq >= self._last

    def drop(self) -> Steps[None]:
        """Lets go of what was captured and not read."""
        yield from self.finish()
        if not self.is_drained() or self._seq > self._acked:
            yield from self._channel.call("stream.ack", {"stream": self.id, "seq": self._last}, lambda part: None)

    def abandon(self) -> None:
        self._channel.send("stream.close", {"stream": self.id}, notify=True)
        # The server drops the stream when its last frame is acknowledged. Which one that is only a reply could tell: the
        # numbers that it can have are few, and those that were not sent are refused without consequence.
        for seq in range(self._acked + 1, self._acked + self._window + 1):
            self._channel.send("stream.ack", {"stream": self.id, "seq": seq}, notify=True)
        self._channel.close(LAST_WORDS)

    def close(self) -> None:
        self._channel.close()

    def _keep(self, part: zmq.Frame) -> None:
        self._arrived.append(Frame(part.buffer))


class LiveSource:
    """Over the frames socket; always the newest frame."""

    def __init__(self, connection: Connection, options: Mapping[str, Any]) -> None:
        self._connection, self._options = connection, options
        self.id: str | None = None
        self._first: Frame | None = None
        self._finished = False

    def open(self) -> Steps[None]:
        opened = yield from self._connection.call("stream.open", {"mode": "live", **self._options})
        self.id = str(opened["stream"])
        # The topic ends with its NUL, so that frame/1 is not frame/10 as well.
        self._channel: Channel = self._connection.connect("frames", self.id.encode() + b"\0")
        # A new subscriber gets a frame at once: when it is here, the subscription is.
        deadline = time.monotonic() + self._connection.patience
        while self._first is None and time.monotonic() < deadline:
            self._first = yield from self.read(QUIET)
            self._connection.check_peer()

    def read(self, seconds: float) -> Steps[Frame | None]:
        frame, self._first = self._first, None
        if frame is not None:
            return frame
        wait = seconds
        while (parts := (yield from self._channel.receive(wait))) is not None:
            frame, wait = Frame(parts[0].buffer), 0.0
        return frame

    def check(self) -> Steps[None]:
        yield from ()

    def finish(self) -> Steps[None]:
        if not self._finished:
            self._finished = True
            yield from self._connection.call("stream.close", {"stream": self.id})

    def drop(self) -> Steps[None]:
        yield from self.finish()

    def is_drained(self) -> bool:
        return self._finished

    def abandon(self) -> None:
        self._channel.close()
        control = self._connection.connect("control")
        control.send("stream.close", {"stream": self.id}, notify=True)
        control.close(LAST_WORDS)

    def close(self) -> None:
        self._channel.close()


class StreamOperations:
    """What blocking and asyncio streams have in common.

    Parameters
    ----------
    start : Callable or None
        Starts the run once the stream is open.
    follow : bool
        False: the stream ends when no run is under way any more.
    """

    def __init__(self, connection: Connection, source: LosslessSource | LiveSource,
                 start: Callable[[], Steps[Any]] | None, follow: bool) -> None:
        self._connection, self._source, self._start, self._follow = connection, source, start, follow
        self._state = "new"  # then open, ending, closed
        self._fault: errors.Error | None = None

    @property
    def id(self) -> str | None:
        """The stream's name in the server, with which another client can go on with it; None before it is open."""
        return self._source.id

    def _open(self) -> Steps[None]:
        if self._state == "new":
            yield from self._source.open()
            self._state = "open"
            if self._start is not None:
                try:
                    yield from self._start()
                except BaseException:
                    self._abandon()
                    raise

    @operation
    def read(self) -> Steps[Frame | None]:
        """Wait for the next frame.

        Returns
        -------
        Frame or None
            None when the stream has ended: its run is over (finished, cancelled, timed out) and all frames were read,
            or it was closed.

        Raises
        ------
        Faulted
            The run has faulted; after its last frame.
        StreamNotFound
            The server has ended the stream, since it was read too slowly.
        ConnectionFailed
            The server has vanished.
        """
        yield from self._open()
        silent_since = time.monotonic()
        while self._state != "closed":
            if self._state == "ending" and self._source.is_drained():
                yield from self._close()
                if self._fault is not None:
                    raise self._fault
                break
            frame = yield from self._source.read(QUIET)
            if frame is not None:
                return frame
            self._connection.check_peer()
            if self._state == "open":
                yield from self._look_at_run()
            elif time.monotonic() - silent_since > self._connection.patience:
                raise self._connection.lost("the last frames do not come")
        return None

    def _look_at_run(self) -> Steps[None]:
        yield from self._source.check()
        status = yield from self._connection.call("sim.status", {})
        if self._follow or status["state"] in UNDER_WAY or (status.get("job") or {}).get("state") in UNDER_WAY:
            return
        if status["state"] == "faulted":
            self._fault = fault_of(status)
        yield from self._source.finish()
        self._state = "ending"

    @operation
    def close(self) -> Steps[None]:
        """End the stream; frames not read yet are dropped. The run goes on."""
        yield from self._close()

    def _close(self) -> Steps[None]:
        before, self._state = self._state, "closed"
        if before in ("open", "ending"):
            try:
                yield from self._source.drop()
            except errors.Error:
                pass  # the stream or its server is gone already
            finally:
                self._source.close()

    def _abandon(self) -> None:
        """Ends the stream without waiting for anything, so that it does not hold the run up."""
        before, self._state = self._state, "closed"
        if before in ("open", "ending"):
            try:
                self._source.abandon()
            except errors.Error:
                pass  # the connection is closed

    def __del__(self) -> None:
        if hasattr(self, "_state"):
            self._abandon()


def fault_of(status: Mapping[str, Any]) -> errors.Faulted:
    """The exception for a status whose state is faulted."""
    fault = status.get("fault") or {}
    job = status.get("job") or {}
    what = job.get("reason") or fault.get("criterion", "")
    return errors.Faulted(f"the run stopped before step {status.get('step', 0) + 1}: {what}",
                          hint=str(fault.get("remedy", "")))
