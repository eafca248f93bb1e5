"""Ends of runs: the words of ``headrace resume --until``."""

from __future__ import annotations

import re
from numbers import Real
from typing import Any, Mapping, Union

from .errors import Usage

Until = Union[float, str, Mapping[str, Any], None]
"""``2.0``: t = 2 s. ``"+0.5"``: 0.5 s from now. ``"step=400"``, ``"steps=400"``: that step, so many steps from now.
``"at-rest"``. ``"gauge>0.3"``, ``"post.fx<20"``: the value of a probe. A mapping: as the protocol's `sim.run` takes it.
None: no end."""

_PROBE = re.compile(r"(?P<probe>[^<>]+)(?P<sign>[<>])(?P<value>.+)", re.DOTALL)
_STEPS = re.compile(r"(?P<kind>steps?)=(?P<count>[0-9]+)")


def until_member(until: Until, timeout: float | None) -> dict[str, Any] | None:
    """The member ``until`` of a request; `timeout` [s, simulated] is added when given.

    Raises
    ------
    Usage
        `until` is no end of a run.
    """
    member = _target(until)
    if timeout is not None:
        member["timeout"] = timeout
    return member or None


def _target(until: Until) -> dict[str, Any]:
    if until is None:
        return {}
    if isinstance(until, Mapping):
        return dict(until)
    if isinstance(until, Real) and not isinstance(until, bool):
        return {"time": float(until)}
    if isinstance(until, str):
        if until in ("at-rest", "at_rest"):
            return {"at_rest": True}
        if steps := _STEPS.fullmatch(until):
            return {steps["kind"]: int(steps["count"])}
        number = _number(until)
        if number is not None:
            return {"duration" if until.startswith("+") else "time": number}
        probe = _PROBE.fullmatch(until)
        value = _number(probe["value"]) if probe else None
        if probe and value is not None:
            return {"probe": {"probe": probe["probe"].strip(), "above" if probe["sign"] == ">" else "below": value}}
    raise Usage(f"{until!r} is no end of a run", path="until",
                hint="at-rest, 2.0 (t = 2 s), '+2' (2 s from now), 'step=400', 'steps=400' or 'gauge>0.3'")


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
