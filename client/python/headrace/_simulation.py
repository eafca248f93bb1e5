"""Operations on a simulation as a whole, shared by `headrace.Simulation` and `headrace.aio.Simulation`."""

from __future__ import annotations

import json
import os
import pathlib
from typing import Any, Callable, Generic, Mapping, Sequence, TypeVar

import numpy as np

from . import errors
from ._connection import Connection, default_endpoint
from ._groups import Group, as_arrays
from ._json import Reply, with_numbers, without_none
from ._operation import Steps, operation, operation_property
from ._server import PrivateServer
from ._stream import LiveSource, LosslessSource, fault_of
from ._until import Until, until_member
from .frame import Frame

StreamT = TypeVar("StreamT")
RecordingT = TypeVar("RecordingT")

Scene = str | os.PathLike[str] | Mapping[str, Any]


class SimulationOperations(Group, Generic[StreamT, RecordingT]):
    """A simulation on a server.

    Parameters
    ----------
    server : str, optional
        Endpoint of the control socket of a running `headraced`, such as ``tcp://127.0.0.1:5755`` or ``ipc:///path``;
        ``"default"``: the environment's HEADRACE_SERVER, else ``tcp://127.0.0.1:5755``. Without one a private server is
        started, from HEADRACE_SERVER_BINARY, the checkout or the PATH; it ends with this object.
    threads : int, optional
        Of the private server's solver; by default as many as the machine has.
    data : path, optional
        Folder below which the private server writes recordings; by default the current one.
    patience : float
        How long the server may show no sign of life before `ConnectionFailed` is raised [s, wall time]. Requests
        themselves may take as long as they need.

    Raises
    ------
    ConnectionFailed
        No server answers, or none can be started.
    ProtocolMismatch
        The server is of another version.
    """

    _make_stream: Callable[..., StreamT]
    _make_recording: Callable[[Connection, Reply], RecordingT]

    def __init__(self, server: str | None = None, *, threads: int | None = None,
                 data: str | os.PathLike[str] | None = None, patience: float = 5.0) -> None:
        self._server = PrivateServer(threads, data) if server is None else None
        endpoint = default_endpoint() if server == "default" else server or ""
        super().__init__(Connection(endpoint, patience, self._server.gone if self._server else None))
        self._begin()

    def _begin(self) -> None:
        """Makes the parts, of the client's own kind."""
        raise NotImplementedError

    @property
    def endpoint(self) -> str:
        """Endpoint of the server's control socket; others may use it too (``headrace --server ...``)."""
        return self._connection.endpoint

    @property
    def session(self) -> str:
        """Of the server: 16 hex digits, new at each of its starts."""
        return str(self._connection.hello.get("session", ""))

    # ---- life ----

    def _open(self) -> Steps[None]:
        try:
            if self._server is not None:
                yield from self._server.start()
                self._connection.endpoint = self._server.endpoint
            yield from self._connection.open()
        except BaseException:
            yield from self._close()
            raise

    def _close(self) -> Steps[None]:
        self._connection.close()
        if self._server is not None:
            yield from self._server.stop()

    # ---- scene ----

    @operation
    def load(self, scene: Scene, parameters: Mapping[str, Any] | None = None) -> Steps[Reply]:
        """Load a scene and wait until it is there; step 0.

        Parameters
        ----------
        scene : str, path or mapping
            A preset's name (`scenes` lists them), a file (a path, or a str that ends in .json), or a scene document.
        parameters : mapping, optional
            Model parameters that override the scene's own.

        Returns
        -------
        Reply
            ``scene``, ``particles``, ``time_step`` [s], ``objects`` (their names), ``step``, ``time`` [s], ``state``.

        Raises
        ------
        SceneNotFound, SceneInvalid, InvalidParams, ParameterNotFound, WrongState
        FileError, ParseError, DuplicateKey
            Of the file.
        """
        return (yield from self._call("scene.load", scene=_scene_member(scene), parameters=parameters))

    @operation_property
    def scene(self) -> Steps[dict[str, Any]]:
        """The scene document, every member filled in."""
        return (yield from self._call("scene.get")).to_dict()

    @operation
    def scenes(self) -> Steps[list[Reply]]:
        """The presets: ``name``, ``description``, ``dimensions``, ``particles``."""
        scenes: list[Reply] = (yield from self._call("scene.list"))["scenes"]
        return scenes

    # ---- runs ----

    @operation
    def run(self, until: Until = None, *, timeout: float | None = None, pace: float | None = None,
            wait: bool = True) -> Steps[Reply]:
        """Run until something is reached.

        An interrupted wait (Ctrl-C, a cancelled task) leaves the run going: `pause` or `cancel` it.

        Parameters
        ----------
        until : float, str, mapping or None
            ``2.0``: t = 2 s. ``"+0.5"``: 0.5 s from now. ``"step=400"``, ``"steps=400"``. ``"at-rest"``.
            ``"gauge>0.3"``, ``"post.fx<20"``: a probe's value, in its unit. None: without end, with ``wait=False``.
        timeout : float, optional
            End as timed out after so much simulated time [s].
        pace : float, optional
            Simulated seconds per wall second at most.
        wait : bool
            False: return at once; `wait` waits later.

        Returns
        -------
        Reply
            The job: ``job``, ``state``, ``reason``, ``step``, ``time`` [s], ``steps``, ``wall_s`` [s].

        Raises
        ------
        TimedOut
            `timeout` (or that of the scene, for ``"at-rest"``) came first.
        Cancelled
            The run was cancelled before.
        Faulted
            The run went wrong and stopped; ``hint`` has the remedy, `status` the particle.
        WrongState, ProbeNotFound, InvalidParams, Usage
        """
        member = until_member(until, timeout)
        if member is None and wait:
            raise errors.Usage("a run without end is not waited for", path="until", hint="give until=, or wait=False")
        return (yield from self._ended((yield from self._run(member, pace, wait)), wait))

    def _run(self, until: dict[str, Any] | None, pace: float | None, wait: bool) -> Steps[Reply]:
        return (yield from self._call("sim.run", until=until, pace=pace, wait=wait))

    @operation
    def step(self, steps: int = 1) -> Steps[Reply]:
        """Do so many steps.

        Returns
        -------
        Reply
            The job, as `run` does.

        Raises
        ------
        Cancelled, Faulted, WrongState, InvalidParams
        """
        return (yield from self._ended((yield from self._call("sim.step", steps=steps)), True))

    @operation
    def wait(self, job: int | None = None, timeout: float | None = None) -> Steps[Reply]:
        """Wait until a run has ended: the running, paused or last one unless `job` names one.

        Raises
        ------
        TimedOut
            It has not ended after `timeout` [s, wall time].
        JobNotFound
            There was none.
        Cancelled, Faulted
        """
        if job is None:
            current = (yield from self._call("sim.status")).job
            if current is None:
                raise errors.JobNotFound("nothing has run yet")
            job = current.job
        return (yield from self._ended((yield from self._call("job.wait", job=job, timeout=timeout)), True))

    def _ended(self, job: Reply, was_awaited: bool) -> Steps[Reply]:
        if not was_awaited:
            return job
        if job.state == "faulted":
            raise fault_of((yield from self._call("sim.status")))
        if job.state in ("timed_out", "cancelled"):
            kind = errors.TimedOut if job.state == "timed_out" else errors.Cancelled
            raise kind(f"the run ended at step {job.step}, t {job.time:g} s: {job.reason or job.state}")
        return job

    @operation
    def pause(self) -> Steps[Reply]:
        """Pause the run when the step under way is done. Nothing happens when none runs."""
        return (yield from self._call("sim.pause"))

    @operation
    def resume(self) -> Steps[Reply]:
        """Continue the paused run; without one, begin a run without end."""
        return (yield from self._call("sim.resume"))

    @operation
    def cancel(self) -> Steps[Reply]:
        """End the running or the paused run, or the load under way."""
        return (yield from self._call("sim.cancel"))

    @operation
    def reset(self) -> Steps[Reply]:
        """Load the scene anew: step 0, its own objects and parameters; recordings end."""
        return (yield from self._call("sim.reset"))

    # ---- queries ----

    @operation
    def status(self, hash: bool = False) -> Steps[Reply]:
        """Where the simulation is, at once, also while it steps.

        Parameters
        ----------
        hash : bool
            True: with a fresh ``state_hash``, at the next step boundary.

        Returns
        -------
        Reply
            ``state``, ``step``, ``time`` [s], ``time_step`` [s], ``particles``, ``steps_per_second``, ``job``,
            ``diagnostics``, ``fault``, ``plan``, ...: `proto/README.md`, "sim.status".
        """
        reply = yield from self._connection.call("sim.status", {"hash": True} if hash else {})
        return Reply(with_numbers(reply))

    @operation_property
    def plan(self) -> Steps[list[Reply]]:
        """The stages of a step: ``stage``, ``active``, ``reason``, ``seconds`` spent in it [s, wall time]."""
        plan: list[Reply] = (yield from self._call("sim.status"))["plan"]
        return plan

    @operation
    def inspect(self, id: int) -> Steps[Reply]:
        """Explain one particle: state, ``neighbours``, and the acceleration of each of its ``terms``.

        Returns
        -------
        Reply
            Vectors have the shape (3,), the last component 0 in 2D, in SI units; `proto/README.md`, "One particle".

        Raises
        ------
        ParticleNotFound, WrongState
        InvalidParams
            The model cannot tell.
        """
        reply = yield from self._connection.call("sim.inspect", {"id": id})
        return Reply(as_arrays(with_numbers(reply)))

    @operation
    def events(self, since: int = 0, timeout: float = 0.0, types: Sequence[str] | None = None) -> Steps[Reply]:
        """What happened after event number `since`; waits up to `timeout` [s, wall time, 60 at most] for something.

        Returns
        -------
        Reply
            ``events``, ``last_seq`` (to ask again with), ``lost``.
        """
        return (yield from self._call("events.since", seq=since, timeout=timeout, types=types))

    # ---- frames ----

    @operation
    def snapshot(self, fields: Sequence[str] | None = None, precision: str | None = None) -> Steps[Frame]:
        """The particles as they are now, between two steps.

        Parameters
        ----------
        fields : sequence of str, optional
            Of id, position, velocity, acceleration, density, pressure; by default all but the acceleration.
        precision : {"f4", "f8"}, optional
            By default "f4", single.

        Raises
        ------
        InvalidParams, WrongState
        ParseError
            The frame arrived damaged.
        """
        frames: list[Frame] = []
        channel = self._connection.connect("data")
        try:
            yield from channel.call("frame.get", without_none(fields=fields, precision=precision),
                                    lambda part: frames.append(Frame(part.buffer)))
        finally:
            channel.close()
        if not frames:
            raise errors.ParseError("the server's reply came without a frame")
        return frames[0]

    def stream(self, fields: Sequence[str] | None = None, every: int | float | None = None, *, lossless: bool = True,
               until: Until = None, timeout: float | None = None, follow: bool = False, rate: float | None = None,
               precision: str | None = None, window: int | None = None, on_stall: str | None = None,
               stall_timeout: float | None = None, resume: str | None = None, acked: int | None = None) -> StreamT:
        """Frames while the simulation runs, the first one of the present state.

        Iteration ends when the run is over and its last frame was read; with `follow` it waits for the next run.

        Parameters
        ----------
        fields, precision
            As for `snapshot`.
        every : int or float, optional
            Lossless only. An int: steps between frames. A float: simulated time between frames [s]. By default every
            step.
        lossless : bool
            True: no frame is lost; the run waits for a slow reader. False: the newest frame each time; the run never
            waits.
        until, timeout
            Begin such a run (see `run`) once the stream is open, so that its frames come from the first on.
        follow : bool
            True: go on when no run is under way.
        rate : float, optional
            Live only: frames per wall second at most.
        window : int, optional
            Lossless only: frames under way at most, by default 16.
        on_stall : {"pause", "fail"}, optional
            Lossless only: while the window is full the run waits (default), or the stream fails.
        stall_timeout : float, optional
            Lossless only: how long the run waits [s, wall time], by default 60; then the stream fails.
        resume : str, optional
            Go on with the lossless stream of this name (`id` of the stream) whose reader has vanished, with its fields
            and window. The run waits for a new reader as long as `stall_timeout` says.
        acked : int, optional
            The last frame (its `seq`) that the vanished reader has dealt with: the next one comes first. By default the
            last one that it has acknowledged, which it does when it asks for the next.

        Raises
        ------
        InvalidParams, WrongState, LimitExceeded, StreamNotFound
            When it is opened.
        Faulted, StreamNotFound, ConnectionFailed, ParseError
            While it is read: see `read` of the stream.
        """
        if isinstance(every, (bool, str)) or (every is not None and every <= 0):
            raise errors.Usage(f"frames cannot come every {every!r}", path="every",
                               hint="an int counts steps, a float is simulated time [s]")
        is_count = isinstance(every, (int, np.integer))
        options = without_none(fields=fields, precision=precision, rate=rate, window=window, on_stall=on_stall,
                               stall_timeout=stall_timeout, every_steps=every if is_count else None,
                               interval=None if is_count else every)
        if resume is None and acked is not None:
            raise errors.Usage("which stream is it whose frames have arrived?", path="acked", hint="give resume=its id")
        if resume is not None:
            if options or not lossless:
                raise errors.Usage("a stream that is resumed is as it was opened", path="resume",
                                   hint=f"leave out {', '.join(options) or 'lossless=False'}")
            options = without_none(resume=resume, acked=acked)
        target = until_member(until, timeout)
        source = (LosslessSource if lossless else LiveSource)(self._connection, options)
        return self._make_stream(self._connection, source,
                                 (lambda: self._run(target, None, False)) if target else None, follow)

    @operation
    def record(self, path: str | os.PathLike[str], *, fields: Sequence[str] | None = None,
               every: int | float | None = None, precision: str | None = None, compression: str | None = None,
               overwrite: bool = False) -> Steps[RecordingT]:
        """Let the server write a recording, frames and probes, until it is stopped; no frame is lost.

        Parameters
        ----------
        path : path
            Ends in .mcap; below the server's data folder (of a private server: `data`, by default the current folder).
        fields, precision, every
            As for `stream`; by default the scene's own output fields and interval.
        compression : {"none", "zstd"}, optional
            Of the file, by default "none".
        overwrite : bool
            True: an existing file is replaced.

        Returns
        -------
        A handle: a context manager that ends the recording, with `stop`.

        Raises
        ------
        FileError, InvalidParams, WrongState
        """
        is_count = isinstance(every, (int, np.integer))
        started = yield from self._call(
            "record.start", file=self._data_path(path), fields=fields, precision=precision, compression=compression,
            overwrite=overwrite or None, every_steps=every if is_count else None, interval=None if is_count else every)
        return self._make_recording(self._connection, started)

    def _data_path(self, path: str | os.PathLike[str]) -> str:
        """Absolute paths into a private server's data folder are fine too."""
        if self._server is not None and os.path.isabs(path):
            absolute = pathlib.Path(path).parent.resolve() / pathlib.Path(path).name
            if absolute.is_relative_to(self._server.data):
                return str(absolute.relative_to(self._server.data))
        return os.fspath(path)

    # ---- everything else ----

    @operation
    def call(self, method: str, /, **params: Any) -> Steps[Any]:
        """Any method of the control socket by its name in `proto/README.md`, parameters as they stand there.

        Returns
        -------
        The member ``result`` of the reply, as plain Python objects.

        Raises
        ------
        Error
            Whatever the server answers, one class per name.
        """
        return (yield from self._connection.call(method, params))

    @operation
    def shutdown(self) -> Steps[Reply]:
        """End the server, also one that was not started here."""
        return (yield from self._call("server.shutdown"))


def _scene_member(scene: Scene) -> str | Mapping[str, Any]:
    if isinstance(scene, Mapping) or (isinstance(scene, str) and not scene.endswith(".json")):
        return scene
    path = os.fspath(scene)
    try:
        text = pathlib.Path(path).read_text(encoding="utf-8")
        document: Any = json.loads(text, object_pairs_hook=_without_duplicates, parse_constant=_refuse_constant)
    except OSError as error:
        raise errors.FileError(f"{path}: {error.strerror}", path=path) from error
    except ValueError as error:
        raise errors.ParseError(f"{path}: {error}", path=path) from error
    if not isinstance(document, dict):
        raise errors.ParseError(f"{path} holds no JSON object", path=path)
    return document


def _without_duplicates(members: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(members)
    if len(found) < len(members):
        names = [name for name, _ in members]
        twice = next(name for name in names if names.count(name) > 1)
        raise errors.DuplicateKey(f"the member {twice!r} stands twice in one object", path=twice)
    return found


def _refuse_constant(word: str) -> Any:
    raise ValueError(f"{word} is no JSON number")
