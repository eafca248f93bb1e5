"""Carries operations out on an asyncio event loop."""

from __future__ import annotations

import asyncio

import zmq

from ._operation import Steps, T


async def drive(steps: Steps[T]) -> T:
    try:
        wait = next(steps)
        while True:
            wait = steps.send(await _is_readable(wait.source, wait.seconds))
    except StopIteration as end:
        return end.value  # type: ignore[no-any-return]
    finally:
        steps.close()  # a cancelled task too lets the operation clean up


async def _is_readable(source: zmq.Socket[bytes] | int, seconds: float) -> bool:
    """An operation has its sockets for itself, so nobody else takes what the descriptor signals."""
    loop = asyncio.get_running_loop()
    signal = asyncio.Event()
    descriptor = source if isinstance(source, int) else source.getsockopt(zmq.FD)
    assert isinstance(descriptor, int)
    loop.add_reader(descriptor, signal.set)
    try:
        async with asyncio.timeout(max(0.0, seconds)):
            # A socket's descriptor tells of changes only: what matters is asked each time, before and after.
            while isinstance(source, int) or not source.getsockopt(zmq.EVENTS) & zmq.POLLIN:  # type: ignore[operator]
                await signal.wait()
                signal.clear()
                if isinstance(source, int):
                    return True
        return True
    except TimeoutError:
        return False
    finally:
        loop.remove_reader(descriptor)
