"""The frame parser: what it shows, and what it refuses."""

from __future__ import annotations

import pathlib
import re
import zlib
from typing import Any, Callable

import headrace
import numpy as np
import pytest
from headrace._replies import CLASSES, from_reply
from headrace.frame import FIELD, HEADER, Frame

from conftest import PACKAGE, ROOT

COUNT = 3


def frame_bytes(fields: dict[str, np.ndarray[Any, Any]], **header: Any) -> bytearray:
    """A frame made from the byte tables of the protocol."""
    table = np.zeros(len(fields), FIELD)
    body = b""
    start = HEADER.itemsize + table.nbytes
    for entry, (name, values) in zip(table, fields.items()):
        body += bytes(-(start + len(body)) % 64)
        components = values.shape[1] if values.ndim == 2 else 1
        for member, value in (("name", name), ("dtype", values.dtype.str), ("components", components), ("scale", 1),
                              ("offset", start + len(body)), ("bytes", values.nbytes)):
            entry[member] = value
        body += values.tobytes()
    head = np.zeros(1, HEADER)
    for member, value in {"topic": b"frame/1", "magic": b"HRFRAME1", "version": 1, "dimensions": 2,
                          "field_count": len(fields), "session": 0xABC, "seq": 7, "step": 40, "time": 0.5,
                          "wall_clock": 1.7e9, "particle_count": COUNT, "total_bytes": start + len(body),
                          **header}.items():
        head[member] = value
    return sealed(bytearray(head.tobytes() + table.tobytes() + body))


def sealed(message: bytearray) -> bytearray:
    """With the CRC that its bytes have: only what the CRC does not tell is wrong then."""
    message[124:128] = zlib.crc32(message[128:], zlib.crc32(message[:124])).to_bytes(4, "little")
    return message


def sample() -> bytearray:
    return frame_bytes({"id": np.arange(COUNT, dtype="<u4"),
                        "position": np.arange(2 * COUNT, dtype="<f4").reshape(COUNT, 2),
                        "pressure": np.array([1.5, 2.5, 3.5], "<f8")})


def test_a_frame_shows_its_fields() -> None:
    frame = Frame(sample())
    assert (frame.step, frame.time, frame.seq, frame.dimensions, frame.particle_count) == (40, 0.5, 7, 2, COUNT)
    assert frame.session == "0000000000000abc"
    assert frame.ids.tolist() == [0, 1, 2] and frame["position"].tolist() == [[0, 1], [2, 3], [4, 5]]
    assert frame.pressure.dtype == np.float64 and list(frame) == ["id", "position", "pressure"]
    with pytest.raises(AttributeError, match="velocity"):
        frame.velocity
    with pytest.raises(KeyError, match="position"):
        frame["velocity"]


def test_arrays_are_read_only_views_into_the_message() -> None:
    message = sample()
    frame = Frame(message)
    assert all(np.shares_memory(frame[name], np.frombuffer(message, "u1")) for name in frame)
    with pytest.raises(ValueError, match="read-only"):
        frame.position[0] = 0


def test_fields_of_a_later_server_are_passed_over() -> None:
    message = frame_bytes({"vorticity": np.zeros(COUNT, "<f2"), "id": np.arange(COUNT, dtype="<u4")})
    assert list(Frame(message)) == ["id"]


def test_each_flipped_bit_and_each_cut_is_noticed() -> None:
    message = sample()
    for at in range(len(message)):
        damaged = bytearray(message)
        damaged[at] ^= 1 << at % 8
        with pytest.raises(headrace.ParseError):
            Frame(damaged)
        with pytest.raises(headrace.ParseError):
            Frame(message[:at])


def field(index: int, member: str, value: Any) -> Callable[[bytearray], None]:
    def change(message: bytearray) -> None:
        np.frombuffer(message, FIELD, 3, HEADER.itemsize)[index][member] = value

    return change


def header(member: str, value: Any) -> Callable[[bytearray], None]:
    def change(message: bytearray) -> None:
        np.frombuffer(message, HEADER, 1)[0][member] = value

    return change


@pytest.mark.parametrize("change", [
    header("magic", b"HRFRAME2"), header("version", 2), header("dimensions", 4), header("total_bytes", 1),
    header("field_count", 4000), header("time", np.nan), header("particle_count", COUNT + 1),
    field(0, "offset", 1 << 40), field(0, "offset", 64), field(1, "offset", 321), field(2, "bytes", 1 << 40),
    field(2, "bytes", 16), field(0, "dtype", "<i4"), field(1, "components", 0), field(1, "components", 3),
    field(1, "encoding", 1), field(1, "scale", 2.0), field(1, "bias", 1.0), field(1, "name", "id"),
])
def test_a_frame_that_contradicts_itself_is_refused(change: Callable[[bytearray], None]) -> None:
    message = sample()
    change(message)
    with pytest.raises(headrace.ParseError):
        Frame(sealed(message))


def test_the_plain_example_repeats_the_same_tables() -> None:
    example: dict[str, Any] = {}
    exec((PACKAGE / "parse_frame.py").read_text(), example)
    assert example["HEADER"] == HEADER and example["FIELD"] == FIELD
    head, arrays = example["parse_frame"](bytes(sample()))
    assert head["step"] == 40 and arrays["pressure"].tolist() == [1.5, 2.5, 3.5]


def test_each_error_of_the_protocol_has_its_class() -> None:
    text = (ROOT / "proto" / "reference.md").read_text()
    table = re.findall(r"^\| `(\w+)` \| -32\d+ \| \d \|", text, re.MULTILINE)
    assert len(table) > 20 and sorted(CLASSES) == sorted(table)
    for name, kind in CLASSES.items():
        assert kind.__name__.lower() == name.replace("_", "") and getattr(headrace, kind.__name__) is kind


def test_an_error_of_a_later_server_keeps_its_name() -> None:
    error = from_reply({"code": -1, "message": "m", "data": {"name": "new_one", "retryable": True}})
    assert type(error) is headrace.Error and (error.name, error.retryable) == ("new_one", True)


def test_versions_agree_with_the_programs() -> None:
    version = re.search(r'kProgramVersion = "(.*?)"', (ROOT / "proto" / "version.h").read_text())
    project = re.search(r'^version = "(.*?)"', (PACKAGE / "pyproject.toml").read_text(), re.MULTILINE)
    assert version and project and version[1] == project[1] == headrace.__version__
