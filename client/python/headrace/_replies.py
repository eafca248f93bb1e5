"""Errors as the server tells them, and the exceptions that they become."""

from __future__ import annotations

from typing import Any, Mapping

from .errors import Error

CLASSES: Mapping[str, type[Error]] = {kind.name: kind for kind in Error.__subclasses__()}
"""The class of each error name."""


def from_reply(error: Mapping[str, Any]) -> Error:
    """The exception for the member ``error`` of a JSON-RPC reply."""
    data = error.get("data") or {}
    name = str(data.get("name", ""))
    made = CLASSES.get(name, Error)(str(error.get("message", "")), path=str(data.get("path", "")),
                                    hint=str(data.get("hint", "")), retryable=bool(data.get("retryable", False)))
    made.name = name
    return made
