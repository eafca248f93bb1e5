"""Carries operations out by waiting for them."""

from __future__ import annotations

import zmq

from ._operation import Steps, T


def drive(steps: Steps[T]) -> T:
    try:
        wait = next(steps)
        while True:
            poller = zmq.Poller()
            poller.register(wait.source, zmq.POLLIN)
            wait = steps.send(bool(poller.poll(round(max(0.0, wait.seconds) * 1e3))))
    except StopIteration as end:
        return end.value  # type: ignore[no-any-return]
    finally:
        steps.close()  # an interrupt too lets the operation clean up
