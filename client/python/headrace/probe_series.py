"""What a probe has measured."""

from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from .errors import ProbeNotFound

Floats = npt.NDArray[np.float64]


class ProbeSeries:
    """The samples of one probe.

    Attributes
    ----------
    name : str
    times : ndarray, shape (n,)
        Simulated time of each sample [s], rising.
    values : ndarray, shape (n,) or (n, k)
        One row per sample, with k > 1 one column per quantity; nan where there was no fluid to measure.
    columns : tuple of str, length k
        Names of the quantities, such as ``("fx", "fy", "tz")``.
    units : tuple of str, length k
        Their units.
    positions : ndarray, shape (k,), or None
        Of a profile: where along its line each column is [m].
    dropped : int
        Samples that the server no longer holds, older than the first.
    """

    def __init__(self, name: str, columns: Sequence[Mapping[str, Any]], rows: Sequence[Sequence[float | None]],
                 dropped: int = 0) -> None:
        quantities = columns[1:]  # the first is the time
        table = np.array(rows, dtype=np.float64).reshape(-1, len(columns))  # None becomes nan
        self.name, self.dropped = name, dropped
        self.columns = tuple(str(column["name"]) for column in quantities)
        self.units = tuple(str(column["unit"]) for column in quantities)
        places = [column.get("position") for column in quantities]
        self.positions: Floats | None = None if None in places or not places else np.array(places, dtype=np.float64)
        self.times: Floats = table[:, 0]
        self.values: Floats = table[:, 1] if len(quantities) == 1 else table[:, 1:]

    @property
    def unit(self) -> str:
        """The unit that all columns share; "" when they do not."""
        return self.units[0] if len(set(self.units)) == 1 else ""

    def __getitem__(self, column: str) -> Floats:
        """The values of one column, shape (n,).

        Raises
        ------
        ProbeNotFound
            The probe has no such column.
        """
        if column not in self.columns:
            raise ProbeNotFound(f"the probe {self.name!r} has no column {column!r}", hint=", ".join(self.columns))
        return self.values if self.values.ndim == 1 else self.values[:, self.columns.index(column)]

    def __len__(self) -> int:
        """n, the number of samples."""
        return len(self.times)

    def __repr__(self) -> str:
        what = ", ".join(f"{column} [{unit}]" for column, unit in zip(self.columns[:6], self.units))
        more = ", ..." if len(self.columns) > 6 else ""
        return f"<ProbeSeries {self.name!r}: {len(self)} samples of {what}{more}>"
