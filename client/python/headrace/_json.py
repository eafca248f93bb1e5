"""What goes into requests and comes out of replies."""

from __future__ import annotations

import json
import os
from typing import Any, Iterator, Mapping

import numpy as np

from .errors import InvalidParams

_NAMES = {"object", "name", "term"}  # members that hold names, never numbers


class Reply(Mapping[str, Any]):
    """A JSON object of the server: a mapping whose members are attributes as well.

    Members are those of `proto/README.md`, "Messages"; a later server may send further ones. An optional member that
    was not sent is None as an attribute, and a KeyError as an item.
    """

    def __init__(self, members: Mapping[str, Any]) -> None:
        self._members = members

    def __getitem__(self, name: str) -> Any:
        return _wrapped(self._members[name])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return _wrapped(self._members.get(name))

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._members]

    def __iter__(self) -> Iterator[str]:
        return iter(self._members)

    def __len__(self) -> int:
        return len(self._members)

    def __repr__(self) -> str:
        return f"Reply({dict(self._members)!r})"

    def to_dict(self) -> dict[str, Any]:
        """The members as plain Python objects."""
        return dict(self._members)


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Reply(value)
    return [_wrapped(item) for item in value] if isinstance(value, list) else value


def with_numbers(value: Any, member: str = "") -> Any:
    """`value` with "NaN", "Infinity" and "-Infinity", which JSON has no numbers for, as floats."""
    if isinstance(value, dict):
        return {key: with_numbers(item, key) for key, item in value.items()}
    if isinstance(value, list):
        return [with_numbers(item, member) for item in value]
    if member not in _NAMES and value in ("NaN", "Infinity", "-Infinity"):
        return float(value)
    return value


def without_none(**members: Any) -> dict[str, Any]:
    """The members that were given."""
    return {name: value for name, value in members.items() if value is not None}


def to_text(request: Mapping[str, Any]) -> bytes:
    """UTF-8 JSON; NumPy numbers and arrays, replies and paths become what they stand for."""
    try:
        return json.dumps(request, default=_plain, allow_nan=False, ensure_ascii=False).encode("utf-8")
    except (TypeError, ValueError) as wrong:
        raise InvalidParams(f"{request.get('method')}: {wrong}", path="params",
                            hint="numbers must be finite; strings, lists, dicts and NumPy arrays can be sent") from None


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{type(value).__name__} cannot be sent as JSON")
