"""Drive headraced, a server for smoothed particle hydrodynamics, from Python.

`Simulation` blocks, `headrace.aio.Simulation` is for asyncio; both have the same names. Quantities are in SI units.
"""

from . import aio as aio
from . import errors as errors
from ._groups import Parameter as Parameter
from ._json import Reply as Reply
from .errors import *  # noqa: F403  one class per error name
from .frame import Frame as Frame
from .probe_series import ProbeSeries as ProbeSeries
from .recording import Recording as Recording
from .simulation import Simulation as Simulation
from .simulation import Stream as Stream

__version__ = "0.1.0"
