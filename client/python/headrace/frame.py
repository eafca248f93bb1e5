"""Particle frames: the binary message of `proto/README.md`, "Frames", as NumPy views."""

from __future__ import annotations

import zlib
from typing import Any, Iterator, Mapping

import numpy as np
import numpy.typing as npt

from .errors import ParseError

HEADER = np.dtype([("topic", "S16"), ("magic", "S8"), ("version", "<u2"), ("dimensions", "<u2"),
                   ("field_count", "<u4"), ("session", "<u8"), ("seq", "<u8"), ("step", "<u8"), ("time", "<f8"),
                   ("wall_clock", "<f8"), ("particle_count", "<u8"), ("total_bytes", "<u8"), ("reserved", "V36"),
                   ("crc", "<u4")])
FIELD = np.dtype([("name", "S16"), ("dtype", "S8"), ("components", "<u2"), ("encoding", "<u2"), ("reserved", "<u4"),
                  ("offset", "<u8"), ("bytes", "<u8"), ("scale", "<f8"), ("bias", "<f8")])
MAGIC = b"HRFRAME1"
VERSION = 1
ALIGNMENT = 64  # of the arrays' offsets [bytes]

UNITS = {"id": "", "position": "m", "velocity": "m/s", "acceleration": "m/s^2", "density": "kg/m^3", "pressure": "Pa"}
"""Unit of each field that this version knows."""

Array = npt.NDArray[Any]


class Frame(Mapping[str, Array]):
    """The particles at one instant; a mapping from field name to array.

    The arrays are read-only views into the message as it was received: nothing is copied. Rows ascend by particle id.
    Fields are there when they were asked for; each is an attribute as well (``frame.position``):

    ============  ======  =======  ==========================================
    field         shape   unit
    ============  ======  =======  ==========================================
    id            (n,)             particle number, also as ``frame.ids``
    position      (n, d)  m        of the step just done
    velocity      (n, d)  m/s      of the step just done
    acceleration  (n, d)  m/s^2    of the step just done
    density       (n,)    kg/m^3   as evaluated in that step, at the positions before it
    pressure      (n,)    Pa       likewise
    ============  ======  =======  ==========================================

    Parameters
    ----------
    message : bytes-like
        One frame, byte for byte as streamed or recorded.

    Attributes
    ----------
    step : int
        Steps done.
    time : float
        Simulated time [s].
    dimensions : int
        d, 2 or 3.
    seq : int
        Number of the frame within its stream, from 1, without gaps in a lossless one.
    wall_clock : float
        When it was captured [s since 1970, UTC].
    session : str
        Of the server, 16 hex digits; a restarted server has another one.
    message : memoryview
        The bytes themselves.

    Raises
    ------
    ParseError
        The message is no frame, is cut short or damaged (CRC), or of a version or encoding that is not known.
    """

    def __init__(self, message: bytes | bytearray | memoryview) -> None:
        self.message = memoryview(message).toreadonly()
        header = _checked_header(self.message)
        self.step = int(header["step"])
        self.time = float(header["time"])
        self.dimensions = int(header["dimensions"])
        self.seq = int(header["seq"])
        self.wall_clock = float(header["wall_clock"])
        self.session = f"{int(header['session']):016x}"
        self._count = int(header["particle_count"])
        self._arrays = dict(_arrays(self.message, header))

    @property
    def ids(self) -> Array:
        """Particle numbers, shape (n,)."""
        return self["id"]

    @property
    def particle_count(self) -> int:
        """n, the number of particles."""
        return self._count

    def __getitem__(self, name: str) -> Array:
        try:
            return self._arrays[name]
        except KeyError:
            there = ", ".join(self._arrays)
            raise KeyError(f"this frame has no {name!r}, but {there}: ask for it with fields=") from None

    def __getattr__(self, name: str) -> Array:
        try:
            return self.__dict__["_arrays"][name]  # type: ignore[no-any-return]
        except KeyError:
            raise AttributeError(f"this frame has no {name!r}: ask for it with fields=") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._arrays]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        """The number of fields."""
        return len(self._arrays)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Frame) and self.message == other.message

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<Frame step {self.step}, t {self.time:g} s, {self._count:,} particles: {', '.join(self._arrays)}>"


def _checked_header(message: memoryview) -> Any:
    """The header, when the message is a whole frame with a right CRC."""
    if message.nbytes < HEADER.itemsize:
        raise ParseError(f"a frame has {HEADER.itemsize} bytes or more, not {message.nbytes}")
    header = np.frombuffer(message, HEADER, 1)[0]
    if header["magic"] != MAGIC:
        raise ParseError("this is no frame")
    if header["version"] != VERSION:
        raise ParseError(f"a frame of version {header['version']}, not {VERSION}", hint="use a newer client")
    if header["total_bytes"] != message.nbytes:
        raise ParseError(f"a frame of {header['total_bytes']} bytes, of which {message.nbytes} are here")
    crc_at = HEADER.fields["crc"][1]  # type: ignore[index]
    if header["crc"] != zlib.crc32(message[HEADER.itemsize:], zlib.crc32(message[:crc_at])):
        raise ParseError("a damaged frame: its CRC does not match")
    if header["dimensions"] not in (2, 3) or not np.isfinite(header["time"]) or not np.isfinite(header["wall_clock"]):
        raise ParseError("a frame of neither 2 nor 3 dimensions, or without a time")
    return header


def _arrays(message: memoryview, header: Any) -> Iterator[tuple[str, Array]]:
    """Name and view of each field. The CRC was right, but a writer may err."""
    count = int(header["field_count"])
    table_end = HEADER.itemsize + count * FIELD.itemsize
    if table_end > message.nbytes:
        raise ParseError(f"a frame with a table of {count} fields that it has no room for")
    seen = set()
    for entry in np.frombuffer(message, FIELD, count, HEADER.itemsize):
        name, offset, size = entry["name"].decode("ascii", "replace"), int(entry["offset"]), int(entry["bytes"])
        if name not in UNITS:  # of a later server
            continue
        if offset % ALIGNMENT or offset < table_end or size > message.nbytes - offset:
            raise ParseError(f"a frame whose array {name!r} lies outside of it")
        if entry["encoding"] != 0 or entry["scale"] != 1 or entry["bias"] != 0:
            raise ParseError(f"a frame whose array {name!r} has an unknown encoding", hint="use a newer client")
        if entry["dtype"] not in (b"<u4", b"<f4", b"<f8") or entry["components"] == 0:
            raise ParseError(f"a frame whose array {name!r} has a type that is not known")
        dtype, components = np.dtype(entry["dtype"].decode()), int(entry["components"])
        if size != header["particle_count"] * components * dtype.itemsize:
            raise ParseError(f"a frame whose array {name!r} has not a row for each particle")
        if name in seen:
            raise ParseError(f"a frame with the array {name!r} twice")
        seen.add(name)
        values = np.frombuffer(message, dtype, size // dtype.itemsize, offset)
        yield name, values.reshape(-1, components) if components > 1 else values
