"""Operations: each is written once, as a generator, and serves the blocking and the asyncio client.

An operation never waits by itself. Where it has to, it yields a `Wait` and is sent whether the thing became readable in
time; all else (requests, replies, errors) is plain code in between. A driver carries the waits out: `_blocking.drive`
with poll, `_asynchronous.drive` with the event loop.

A class of operations is a plain class whose methods are marked with `operation`. Mixed with `Blocking` the method
returns the result, mixed with `Asynchronous` it returns an awaitable of it; type checkers see which.
"""

from __future__ import annotations

import functools
import inspect
from dataclasses import dataclass
from typing import Any, Awaitable, Callable, Concatenate, Generator, Generic, ParamSpec, TypeVar, overload

import zmq

P = ParamSpec("P")
T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)


@dataclass(frozen=True)
class Wait:
    """Until `source` (socket or file descriptor) can be read, or `seconds` have passed. Sent back: whether it can."""

    source: zmq.Socket[bytes] | int
    seconds: float


Steps = Generator[Wait, bool, T]
"""An operation under way: yields waits, returns a T."""


class Blocking:
    """The client waits for each operation."""

    def _carry_out(self, steps: Steps[T]) -> T:
        from ._blocking import drive

        return drive(steps)


class Asynchronous:
    """The client's operations are awaited."""

    def _carry_out(self, steps: Steps[T]) -> Awaitable[T]:
        from ._asynchronous import drive

        return drive(steps)


class operation(Generic[P, T]):
    """Marks a method that returns `Steps` as an operation."""

    def __init__(self, steps: Callable[Concatenate[Any, P], Steps[T]]) -> None:
        self.steps = steps
        functools.update_wrapper(self, steps)

    @overload
    def __get__(self, client: None, owner: type) -> Callable[..., Any]: ...
    @overload
    def __get__(self, client: Blocking, owner: type) -> Callable[P, T]: ...
    @overload
    def __get__(self, client: Asynchronous, owner: type) -> Callable[P, Awaitable[T]]: ...

    def __get__(self, client: Any, owner: type) -> Any:
        @functools.wraps(self.steps)
        def method(itself: Any, *args: P.args, **kwargs: P.kwargs) -> Any:
            return itself._carry_out(self.steps(itself, *args, **kwargs))

        signature = _outer_signature(self.steps, issubclass(owner, Asynchronous))
        method.__signature__ = signature  # type: ignore[attr-defined]
        return method if client is None else method.__get__(client, owner)


class operation_property(property, Generic[T_co]):
    """Marks a method without parameters as a property whose value is asked for (``sim.plan``, ``await sim.plan``)."""

    def __init__(self, steps: Callable[[Any], Steps[T_co]]) -> None:
        super().__init__(lambda client: client._carry_out(steps(client)))
        self.__doc__ = steps.__doc__  # what `property` keeps is hidden by the text of this class

    @overload  # type: ignore[override]
    def __get__(self, client: None, owner: type) -> operation_property[T_co]: ...
    @overload
    def __get__(self, client: Blocking, owner: type) -> T_co: ...
    @overload
    def __get__(self, client: Asynchronous, owner: type) -> Awaitable[T_co]: ...

    def __get__(self, client: Any, owner: type) -> Any:
        return super().__get__(client, owner)


@functools.cache
def _outer_signature(steps: Callable[..., Any], is_awaited: bool) -> inspect.Signature:
    """As a user sees it: returning the T of `Steps[T]` or an awaitable of it."""
    inner = inspect.signature(steps)
    result = str(inner.return_annotation).removeprefix("Steps[").removesuffix("]")
    return inner.replace(return_annotation=f"Awaitable[{result}]" if is_awaited else result)
