"""Drive headraced, a server for smoothed particle hydrodynamics, from Python.

`Simulation` blocks, `headrace.aio.Simulation` is for asyncio; both have the same names. Quantities are in SI units.
"""

from . import aio, errors
from ._groups import Parameter
from ._json import Reply
from .errors import *  # noqa: F403  one class per error name
from .errors import Error
from .frame import Frame
from .probe_series import ProbeSeries
from .simulation import Simulation, Stream

__version__ = "0.1.0"
