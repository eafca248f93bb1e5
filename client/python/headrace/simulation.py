"""The blocking client: each call returns when it is done."""

from __future__ import annotations

from types import TracebackType
from typing import Any, Callable, Iterator

from ._connection import Connection
from ._groups import NamedGroup, ObjectOperations, Parameter, ParameterOperations, ProbeOperations, RecordingOperations
from ._json import Reply
from ._operation import Blocking, Steps, T
from ._simulation import SimulationOperations
from ._stream import LiveSource, LosslessSource, StreamOperations
from .frame import Frame


class _Named(NamedGroup[T], Blocking):
    """The parts of a mapping that follow from the names."""

    def __iter__(self) -> Iterator[str]:
        return iter(self.all())

    def __len__(self) -> int:
        return len(self.all())

    def __contains__(self, name: object) -> bool:
        return name in self.all()

    def keys(self) -> list[str]:
        """The names."""
        return list(self.all())


class Parameters(ParameterOperations, _Named[Parameter]):
    __doc__ = (ParameterOperations.__doc__ or "") + """

    A mapping: ``sim.params["viscosity"]`` reads, ``sim.params["viscosity"] = 2`` sets between two steps.
    """

    def __setitem__(self, name: str, value: Any) -> None:
        self.set({name: value})

    def __repr__(self) -> str:
        return "\n".join(str(each) for each in self.all().values())


class Objects(ObjectOperations, _Named[Reply]):
    __doc__ = ObjectOperations.__doc__


class Probes(ProbeOperations, _Named[Reply]):
    __doc__ = ProbeOperations.__doc__


class ServerRecording(RecordingOperations, Blocking):
    __doc__ = RecordingOperations.__doc__

    def __enter__(self) -> ServerRecording:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.stop()


class Stream(StreamOperations, Blocking):
    """Frames as they come: an iterator, and a context manager that ends the stream."""

    def __iter__(self) -> Iterator[Frame]:
        return self

    def __next__(self) -> Frame:
        frame = self.read()
        if frame is None:
            raise StopIteration
        return frame

    def __enter__(self) -> Stream:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()


class Simulation(SimulationOperations[Stream, ServerRecording], Blocking):
    __doc__ = (SimulationOperations.__doc__ or "") + """
    Examples
    --------
    >>> with Simulation() as sim:
    ...     loaded = sim.load("dam_break")
    ...     job = sim.run(until="at-rest")
    ...     moved = sim.objects.remove("panel")
    ...     for frame in sim.stream(every=0.1, until="+1"):
    ...         print(frame.time, frame.position[:, 0].max())
    """

    _make_recording = ServerRecording

    def _begin(self) -> None:
        self.params = Parameters(self._connection)
        self.objects = Objects(self._connection)
        self.probes = Probes(self._connection)
        self._carry_out(self._open())

    def _make_stream(self, connection: Connection, source: LosslessSource | LiveSource,
                     start: Callable[[], Steps[Any]] | None, follow: bool) -> Stream:
        stream = Stream(connection, source, start, follow)
        self._carry_out(stream._open())
        return stream

    def close(self) -> None:
        """Leave the server; a private one ends."""
        self._carry_out(self._close())

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()
