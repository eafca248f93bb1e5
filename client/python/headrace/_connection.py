"""Requests and replies over ZeroMQ, without waiting by itself (see `_operation`).

Each request has a DEALER socket for itself while it is under way, from a small pool: several tasks or threads may have
requests under way, and one that is interrupted or cancelled leaves no reply behind for the next.
"""

from __future__ import annotations

import itertools
import json
import os
import time
from typing import Any, Callable, Mapping

import zmq

from . import errors
from ._json import to_text
from ._operation import Steps, Wait
from ._replies import from_reply

PROTOCOL = 1
DEFAULT_ENDPOINT = "tcp://127.0.0.1:5755"
HEARTBEAT = 5_000  # [ms]
HEARTBEAT_TIMEOUT = 60_000  # [ms] large frames on a slow line trip shorter ones
SLICE = 0.1  # [s] between looks at a private server
SILENCE = 2.0  # [s] of a request under way, after which the server is asked for a sign of life

Parts = list[zmq.Frame]


def default_endpoint() -> str:
    """HEADRACE_SERVER, else where `headraced` listens by default."""
    return os.environ.get("HEADRACE_SERVER") or DEFAULT_ENDPOINT


class Channel:
    """One socket, in the hands of one operation at a time."""

    def __init__(self, connection: Connection, socket: zmq.Socket[bytes]) -> None:
        self._connection, self.socket = connection, socket

    def send(self, method: str, params: Mapping[str, Any], *, notify: bool = False) -> int:
        """Sends a request, or a notification, which gets no reply; returns the request's id."""
        number = next(self._connection.ids)
        request = {"jsonrpc": "2.0", "id": number, "method": method, "params": params}
        if notify:
            del request["id"]
        text = to_text(request)
        try:
            self.socket.send(text, zmq.NOBLOCK)
        except zmq.Again:
            raise self._connection.lost("too many requests wait for an answer") from None
        except zmq.ZMQError as error:
            raise errors.ConnectionFailed(f"the connection is closed ({error.strerror})") from None
        return number

    def receive(self, seconds: float) -> Steps[Parts | None]:
        """The parts of the next message, None when none comes in time."""
        try:
            if (yield Wait(self.socket, seconds)):
                return self.socket.recv_multipart(zmq.NOBLOCK, copy=False)
        except zmq.Again:
            pass
        except zmq.ZMQError as error:
            raise errors.ConnectionFailed(f"the connection is closed ({error.strerror})") from None
        return None

    def reply(self, number: int, on_frame: Callable[[zmq.Frame], None] | None = None) -> Steps[dict[str, Any]]:
        """The reply to request `number`, which may take as long as the server shows signs of life."""
        connection = self._connection
        last_sign = time.monotonic()
        probe = None
        while True:
            parts = yield from self.receive(SLICE)
            if parts is not None:
                last_sign, probe = time.monotonic(), None
                reply = None
                for part in parts:
                    if not is_json(part):
                        if on_frame is not None and part.buffer.nbytes > 0:
                            on_frame(part)
                    else:
                        reply = _parsed(part)
                if reply is not None and reply.get("id") == number:
                    return reply
                continue
            connection.check_peer()
            silent = time.monotonic() - last_sign
            if probe is None and silent > min(SILENCE, connection.patience / 2):
                probe = self.send("hello", {})  # where it does not belong it is refused, which is a sign of life too
            if silent > connection.patience:
                raise connection.lost("no sign of life")

    def call(self, method: str, params: Mapping[str, Any],
             on_frame: Callable[[zmq.Frame], None] | None = None) -> Steps[Any]:
        """Sends a request and returns its result; a refusal is raised."""
        return result_of((yield from self.reply(self.send(method, params), on_frame)))

    def close(self, linger: float = 0.0) -> None:
        """`linger` [s]: that the socket may take, behind the scenes, to send what it was given."""
        self.socket.close(round(1e3 * linger))


class Connection:
    """To the sockets of one server.

    `patience` [s]: how long it may show no sign of life. `gone`: tells how a server that we started has ended.
    """

    def __init__(self, endpoint: str, patience: float, gone: Callable[[], errors.Error | None] | None = None) -> None:
        self.endpoint, self.patience, self._gone = endpoint, patience, gone
        self.ids = itertools.count(1)
        self.hello: dict[str, Any] = {}
        self._context = zmq.Context()
        self._idle: list[Channel] = []

    def open(self) -> Steps[None]:
        """Greets the server, and refuses one of another protocol."""
        hello = yield from self.call("hello", {})
        protocol = hello.get("protocol") if isinstance(hello, dict) else None
        if protocol != PROTOCOL:
            raise errors.ProtocolMismatch(f"the server speaks protocol {protocol}, this client {PROTOCOL}",
                                          path=self.endpoint, hint="use a client and a server of one version")
        self.hello = hello

    def call(self, method: str, params: Mapping[str, Any]) -> Steps[Any]:
        """A request on the control socket; returns its result, raises its error."""
        try:
            channel = self._idle.pop()  # another thread may take the last one
        except IndexError:
            channel = self.connect("control")
        try:
            reply = yield from channel.reply(channel.send(method, params))
        except BaseException:
            channel.close()
            raise
        self._idle.append(channel)
        return result_of(reply)

    def connect(self, role: str, topic: bytes | None = None) -> Channel:
        """A new socket to the server's socket `role`: control, data, or frames (which subscribes to `topic`)."""
        endpoint = self.endpoint if role == "control" else self._endpoint(role)
        try:
            socket = self._context.socket(zmq.DEALER if topic is None else zmq.SUB)
        except zmq.ZMQError as error:
            raise errors.ConnectionFailed(f"the connection is closed ({error.strerror})") from None
        socket.linger = 0
        socket.setsockopt(zmq.HEARTBEAT_IVL, HEARTBEAT)
        socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, HEARTBEAT_TIMEOUT)
        socket.setsockopt(zmq.IPV6, 1)
        if topic is not None:
            socket.setsockopt(zmq.RCVHWM, 2)  # a late viewer wants the newest
            socket.setsockopt(zmq.SUBSCRIBE, topic)
        try:
            socket.connect(endpoint)
        except zmq.ZMQError as error:
            socket.close(0)
            raise errors.Usage(f"not an endpoint: {error.strerror}", path=endpoint,
                               hint="write tcp://HOST:PORT or ipc://PATH") from None
        return Channel(self, socket)

    def _endpoint(self, role: str) -> str:
        """`hello` tells ports, not addresses: the host is the one by which the control socket was reached."""
        named = self.hello.get(f"{role}_endpoint")
        port = self.hello.get(f"{role}_port")
        if named:
            return str(named)
        if port and self.endpoint.startswith("tcp://"):
            return f"{self.endpoint.rpartition(':')[0]}:{port}"
        raise errors.ConnectionFailed(f"the server names no {role} socket", path=self.endpoint)

    def check_peer(self) -> None:
        """Raises when a server that we started has ended."""
        if self._gone is not None and (how := self._gone()) is not None:
            raise how

    def lost(self, what: str) -> errors.ConnectionFailed:
        hint = "" if self._gone else "start one: headraced &"
        return errors.ConnectionFailed(f"{what} from {self.endpoint}", hint=hint, retryable=True)

    def close(self) -> None:
        self._context.destroy(linger=0)


def is_json(part: zmq.Frame) -> bool:
    return bytes(part.buffer[:1]) == b"{"


def result_of(reply: Mapping[str, Any]) -> Any:
    if "result" in reply:
        return reply["result"]
    raise from_reply(reply.get("error") or {})


def _parsed(part: zmq.Frame) -> dict[str, Any]:
    try:
        reply = json.loads(part.bytes)
    except ValueError:
        reply = None
    if not isinstance(reply, dict) or "jsonrpc" not in reply:
        raise errors.ConnectionFailed("something else than headraced answers",
                                      hint=f"give the control endpoint, by default {DEFAULT_ENDPOINT}")
    return reply
