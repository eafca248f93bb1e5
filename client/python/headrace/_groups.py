"""Operations on parts of a simulation: its parameters, its objects, its probes, a recording of the server's."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, Mapping

import numpy as np

from ._connection import Connection
from ._json import Reply, without_none
from ._operation import Steps, T, operation
from .errors import ObjectNotFound, ParameterNotFound
from .probe_series import ProbeSeries


class Group:
    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def _call(self, method: str, **params: Any) -> Steps[Reply]:
        """Those `params` that are not None go along."""
        return Reply((yield from self._connection.call(method, without_none(**params))))


class NamedGroup(Group, Generic[T]):
    """Things of the simulation that have names."""

    @operation
    def all(self) -> Steps[dict[str, T]]:
        """All of them by name, in the server's order."""
        return (yield from self._all())

    def _all(self) -> Steps[dict[str, T]]:
        raise NotImplementedError


@dataclass(frozen=True)
class Parameter:
    """A parameter of the model."""

    name: str
    value: Any
    default: Any
    unit: str
    meaning: str

    def __str__(self) -> str:
        return f"{self.name} = {self.value} {self.unit}  ({self.meaning}; default {self.default})"


class ParameterOperations(NamedGroup[Parameter]):
    """The model's parameters. Units: ``sim.params.info("viscosity")``."""

    @operation
    def __getitem__(self, name: str) -> Steps[Any]:
        return (yield from self._info(name)).value

    @operation
    def info(self, name: str) -> Steps[Parameter]:
        """One parameter: name, value, default, unit and meaning.

        Raises
        ------
        ParameterNotFound
        """
        return (yield from self._info(name))

    @operation
    def set(self, parameters: Mapping[str, Any] | None = None, /, *, at_step: int | None = None,
            **more: Any) -> Steps[Reply]:
        """Set some parameters between two steps: all or none.

        Parameters
        ----------
        parameters : mapping, optional
            Values by name, in the units that `info` tells; further ones as keywords.
        at_step : int, optional
            Wait for that step; then the call returns when it was reached.

        Returns
        -------
        Reply
            ``step`` and ``time`` [s] at which they were set, and the ``previous`` values.

        Raises
        ------
        ParameterNotFound, InvalidParams, WrongState
        """
        return (yield from self._call("params.set", parameters={**(parameters or {}), **more}, at_step=at_step))

    def _all(self) -> Steps[dict[str, Parameter]]:
        return _parameters((yield from self._call("params.get")))

    def _info(self, name: str) -> Steps[Parameter]:
        found = _parameters((yield from self._call("params.get", names=[name])))
        if name not in found:
            raise ParameterNotFound(f"no parameter {name!r}")
        return found[name]


def _parameters(reply: Reply) -> dict[str, Parameter]:
    found = (Parameter(each["name"], each["value"], each.default_value, each.unit or "", each.meaning or "")
             for each in reply["parameters"])
    return {parameter.name: parameter for parameter in found}


class ObjectOperations(NamedGroup[Reply]):
    """The walls and obstacles of the scene, by name, in the order in which they are tested."""

    @operation
    def __getitem__(self, name: str) -> Steps[Reply]:
        found = yield from self._all()
        if name not in found:
            raise ObjectNotFound(f"no object {name!r}", hint=", ".join(found))
        return found[name]

    @operation
    def add(self, name: str, /, shape: Mapping[str, Any], role: str = "obstacle", **members: Any) -> Steps[Reply]:
        """Add an object between two steps.

        Parameters
        ----------
        name : str
        shape : mapping
            Such as ``{"sphere": {"center": [0.6, 0.1], "radius": 0.08}}``, lengths in m.
        role : {"obstacle", "container"}
            What of the shape is solid: its inside, or everything outside. Of no meaning to planes, which have a normal.
        **members
            As in scene documents: ``motion``, ``surface_velocity``, ``slip``.

        Returns
        -------
        Reply
            ``step`` and ``time`` [s] at which it was added.

        Raises
        ------
        ObjectExists, InvalidParams, SceneInvalid, LimitExceeded, WrongState
        """
        document = without_none(name=name, role=role, shape=shape, **members)
        return (yield from self._call("objects.add", object=document))

    @operation
    def move(self, name: str, *, to: Any = None, by: Any = None) -> Steps[Reply]:
        """Move an object between two steps: its centre `to` a place, or `by` a displacement, shape (d,) [m].

        Raises
        ------
        ObjectNotFound, InvalidParams, WrongState
        """
        return (yield from self._call("objects.move", name=name, to=to, by=by))

    @operation
    def remove(self, name: str) -> Steps[Reply]:
        """Remove an object between two steps.

        Raises
        ------
        ObjectNotFound, WrongState
        """
        return (yield from self._call("objects.remove", name=name))

    def _all(self) -> Steps[dict[str, Reply]]:
        return {each["name"]: each for each in (yield from self._call("objects.list"))["objects"]}


class ProbeOperations(NamedGroup[Reply]):
    """What is measured while the run goes on, by name.

    `all` tells of each its document (``probe``), ``columns``, number of ``samples``, ``latest`` row and ``failure``.
    """

    @operation
    def __getitem__(self, name: str) -> Steps[ProbeSeries]:
        return (yield from self._get(name, None))

    @operation
    def get(self, name: str, since: float | None = None) -> Steps[ProbeSeries]:
        """The samples of a probe, those after the simulated time `since` [s] when it is given.

        Raises
        ------
        ProbeNotFound
        """
        return (yield from self._get(name, since))

    @operation
    def add(self, name: str, /, kind: Mapping[str, Any], **members: Any) -> Steps[Reply]:
        """Add a probe between two steps; its first sample is of the present state.

        Parameters
        ----------
        name : str
        kind : mapping
            Such as ``{"level": {"from": [0.3, 0], "to": [0.3, 0.6]}}``; `proto/README.md`, "Probes", has all.
        **members
            ``interval`` [s, simulated] or ``every_steps``.

        Raises
        ------
        ProbeExists, InvalidParams, WrongState
        """
        return (yield from self._call("probes.add", probe=without_none(name=name, kind=kind, **members)))

    @operation
    def remove(self, name: str) -> Steps[Reply]:
        """Remove a probe, with its samples.

        Raises
        ------
        ProbeNotFound, WrongState
        """
        return (yield from self._call("probes.remove", name=name))

    def _all(self) -> Steps[dict[str, Reply]]:
        return {each["probe"]["name"]: each for each in (yield from self._call("probes.list"))["probes"]}

    def _get(self, name: str, since: float | None) -> Steps[ProbeSeries]:
        # A long series comes in parts. The run may go on meanwhile: what there was at the beginning is the aim.
        latest = (yield from self._all()).get(name, Reply({})).latest
        rows: list[list[float | None]] = []
        while True:
            reply = yield from self._connection.call("probes.get", without_none(name=name, since=since))
            part = reply["probes"][0]
            rows += part["rows"]
            since = reply.get("complete_to")
            if not part["rows"] or since is None or latest is None or since >= latest[0]:
                return ProbeSeries(name, part["columns"], rows, part["dropped"])


class RecordingOperations(Group):
    """A recording that the server writes.

    Attributes
    ----------
    file : str
        Where, below the server's data folder.
    """

    def __init__(self, connection: Connection, started: Reply) -> None:
        super().__init__(connection)
        self._id, self.file = started["recording"], str(started["file"])

    @operation
    def stop(self) -> Steps[Reply]:
        """Finish the file.

        Returns
        -------
        Reply
            ``file``, ``frames``, ``gaps``, ``bytes``, and the ``step`` and ``time`` [s] of the end.

        Raises
        ------
        RecordingNotFound
            It has ended already: the scene was reset, or the disk is full.
        """
        return (yield from self._call("record.stop", recording=self._id))


def as_arrays(value: Any) -> Any:
    """Lists of numbers in `value` as arrays."""
    if isinstance(value, dict):
        return {key: as_arrays(item) for key, item in value.items()}
    if isinstance(value, list):
        if value and all(isinstance(item, (int, float)) for item in value):
            return np.array(value, dtype=np.float64)
        return [as_arrays(item) for item in value]
    return value
