"""The asyncio client: the same names as in `headrace`, each call awaited.

    async with aio.Simulation() as sim:
        await sim.load("dam_break")
        await sim.params.set(viscosity=2.0)
        print(await sim.params["viscosity"], await sim.plan)
        async for frame in sim.stream(every=0.1, until=1.0):
            print(frame.time)

Several calls may be under way at once: a run in one task, status and parameters in another.
"""

from __future__ import annotations

from types import TracebackType
from typing import Any, AsyncIterator, Callable, NoReturn

from ._connection import Connection
from ._groups import ObjectOperations, ParameterOperations, ProbeOperations, RecordingOperations
from ._operation import Asynchronous, Steps
from ._simulation import SimulationOperations
from ._stream import LiveSource, LosslessSource, StreamOperations
from .frame import Frame


class _Named(Asynchronous):
    def __iter__(self) -> NoReturn:
        raise TypeError("names are asked for with `await ....all()`")

    def __contains__(self, name: object) -> NoReturn:
        self.__iter__()


class Parameters(ParameterOperations, _Named):
    __doc__ = ParameterOperations.__doc__


class Objects(ObjectOperations, _Named):
    __doc__ = ObjectOperations.__doc__


class Probes(ProbeOperations, _Named):
    __doc__ = ProbeOperations.__doc__


class ServerRecording(RecordingOperations, Asynchronous):
    __doc__ = RecordingOperations.__doc__

    async def __aenter__(self) -> ServerRecording:
        return self

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None,
                        trace: TracebackType | None) -> None:
        await self.stop()


class Stream(StreamOperations, Asynchronous):
    """Frames as they come: an asynchronous iterator, and a context manager that ends the stream.

    It is opened by ``async with`` or by the first frame asked for.
    """

    def __aiter__(self) -> AsyncIterator[Frame]:
        return self

    async def __anext__(self) -> Frame:
        frame = await self.read()
        if frame is None:
            raise StopAsyncIteration
        return frame

    async def __aenter__(self) -> Stream:
        await self._carry_out(self._open())
        return self

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None,
                        trace: TracebackType | None) -> None:
        await self.close()


class Simulation(SimulationOperations[Stream, ServerRecording], Asynchronous):
    __doc__ = (SimulationOperations.__doc__ or "") + """
    Connects in ``async with``, or by `open`.
    """

    _make_stream = Stream
    _make_recording = ServerRecording

    def _begin(self) -> None:
        self.params = Parameters(self._connection)
        self.objects = Objects(self._connection)
        self.probes = Probes(self._connection)

    async def open(self) -> Simulation:
        """Connect to the server, or start the private one."""
        await self._carry_out(self._open())
        return self

    async def close(self) -> None:
        """Leave the server; a private one ends."""
        await self._carry_out(self._close())

    async def __aenter__(self) -> Simulation:
        return await self.open()

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None,
                        trace: TracebackType | None) -> None:
        await self.close()


__all__ = ["Objects", "Parameters", "Probes", "ServerRecording", "Simulation", "Stream"]
