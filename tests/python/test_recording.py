"""Recordings read without a server: whole, compressed, cut off, damaged, foreign."""

from __future__ import annotations

import importlib.util
import json
import pathlib
from typing import Any

import headrace
import numpy as np
import pytest

from conftest import run, tank

needs_zstandard = pytest.mark.skipif(importlib.util.find_spec("zstandard") is None, reason="zstandard is not installed")
COMPRESSIONS = ["none", pytest.param("zstd", marks=needs_zstandard)]


@pytest.fixture(scope="module", params=COMPRESSIONS)
def recorded(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """A recording, the frames that a stream brought meanwhile, and the samples of its probe."""
    folder = tmp_path_factory.mktemp("recorded")
    with headrace.Simulation(threads=1, data=folder) as sim:
        sim.load(tank("thesis"))
        with sim.record("run.mcap", every=5, compression=request.param):
            frames = list(sim.stream(every=5, until="step=50"))
            sim.params["viscosity"] = 2.0
        return folder / "run.mcap", frames, sim.probes["tip"]


def arrays(frame: headrace.Frame) -> list[Any]:
    return [frame.step, frame.time, *(frame[name].tolist() for name in frame)]


def test_a_recording_holds_the_frames_that_were_streamed(recorded: Any) -> None:
    file, frames, _ = recorded
    recording = headrace.Recording(file)
    assert recording.is_complete and recording.damaged_bytes == recording.gaps == 0
    assert [arrays(frame) for frame in recording] == [arrays(frame) for frame in frames]
    # log_time is in whole nanoseconds.
    assert recording.times == pytest.approx([frame.time for frame in frames], abs=1e-9)


def test_frames_are_found_by_index_and_by_time(recorded: Any) -> None:
    file, frames, _ = recorded
    recording = headrace.Recording(file)
    assert len(recording) == 11 and recording[3].step == 15 and recording[-1].step == 50
    assert [frame.step for frame in recording[2:8:3]] == [10, 25]
    between = 0.4 * frames[3].time + 0.6 * frames[4].time
    assert recording.at(between).step == 20 and recording.at(-1).step == 0 and recording.at(1e9).step == 50
    with pytest.raises(IndexError):
        recording[11]


def test_a_recording_tells_scene_events_commands_and_probes(recorded: Any) -> None:
    file, _, tip = recorded
    recording = headrace.Recording(file)
    assert recording.scene["name"] == "small" and [each.name for each in recording.objects] == ["tank"]
    assert recording.program.startswith("headraced ") and len(recording.session) == 16 and recording.strategy
    assert [command.method for command in recording.commands] == ["sim.run", "params.set"]
    assert {"job.started", "job.ended", "params.changed"} <= {event.type for event in recording.events}
    series = recording.probes["tip"]
    assert series.columns == ("front",) and series.unit == "m"
    # A recording may or may not have the sample of its first instant, which was taken before it began.
    assert np.array_equal(series.values, tip.values[-len(series):]) and len(series) >= len(tip) - 1
    assert np.array_equal(series.times, tip.times[-len(series):])


def test_a_file_cut_anywhere_yields_its_whole_chunks(recorded: Any, tmp_path: pathlib.Path) -> None:
    file, frames, _ = recorded
    content = file.read_bytes()
    cut = tmp_path / "cut.mcap"
    seen = set()
    for size in range(len(content) - 1, 100, -997):
        cut.write_bytes(content[:size])
        recording = headrace.Recording(cut)
        assert not recording.is_complete
        assert [arrays(frame) for frame in recording] == [arrays(frame) for frame in frames[: len(recording)]]
        seen.add(len(recording))
    assert min(seen) <= 1 and max(seen) == 11


def test_a_damaged_frame_is_named_and_the_others_are_not_affected(recorded: Any, tmp_path: pathlib.Path) -> None:
    file, frames, _ = recorded
    content = bytearray(file.read_bytes())
    at = headrace.Recording(file)._places[1][4].offset
    content[at + 200] ^= 1
    damaged = tmp_path / "damaged.mcap"
    damaged.write_bytes(content)
    recording = headrace.Recording(damaged)
    with pytest.raises(headrace.ParseError, match=f"damaged.mcap, byte {at}"):
        recording[4]
    assert arrays(recording[5]) == arrays(frames[5]) and arrays(recording[3]) == arrays(frames[3])
    # Without the summary the file is read through, and the damaged chunk is passed over whole.
    damaged.write_bytes(content[:-20])
    scanned = headrace.Recording(damaged)
    assert [frame.step for frame in scanned] == [0, 5, 10, 15, 25, 30, 35, 40, 45, 50]
    assert scanned.damaged_bytes > 0


def test_missing_frames_are_counted_as_the_other_client_does(recorded: Any, program: pathlib.Path,
                                                             tmp_path: pathlib.Path) -> None:
    file, _, _ = recorded
    content = file.read_bytes()
    places = headrace.Recording(file)._places[1]

    def torn(*frames: int, cut: int = 20) -> bytes:
        """Without these frames, and without so many bytes at the end."""
        left = bytearray(content)
        for frame in frames:
            left[places[frame].offset + 200] ^= 1
        return bytes(left[: len(left) - cut])

    cases = {"whole": (content, 0), "cut": (torn(), 0), "one": (torn(4), 1), "two": (torn(2, 3), 1), "apart": (torn(2, 7), 2),
             "end": (torn(10), 0), "half": (torn(3, cut=len(content) - places[8].offset - 50), 1)}
    for name, (bytes_left, gaps) in cases.items():
        path = tmp_path / f"{name}.mcap"
        path.write_bytes(bytes_left)
        ours, theirs = headrace.Recording(path), json.loads(run(program, "--json", "info", path).stdout)
        assert ours.gaps == gaps, name
        assert (ours.gaps, len(ours), ours.damaged_bytes, ours.is_complete) == (
            theirs["gaps"], theirs["frames"], theirs["damaged_bytes"], theirs["complete"]), name
    assert "1 gap, incomplete" in repr(headrace.Recording(tmp_path / "one.mcap"))


def test_a_damaged_summary_is_not_believed(recorded: Any, tmp_path: pathlib.Path) -> None:
    file, _, _ = recorded
    content = bytearray(file.read_bytes())
    content[-200] ^= 1
    (tmp_path / "summary.mcap").write_bytes(content)
    recording = headrace.Recording(tmp_path / "summary.mcap")
    assert not recording.is_complete and [frame.step for frame in recording] == list(range(0, 51, 5))


def test_a_damaged_length_costs_no_more_than_its_chunk(recorded: Any, tmp_path: pathlib.Path) -> None:
    file, _, _ = recorded
    content = bytearray(file.read_bytes()[:-20])
    content[headrace.Recording(file)._places[1][4].offset + 1] ^= 0xFF
    (tmp_path / "torn.mcap").write_bytes(content)
    steps = [frame.step for frame in headrace.Recording(tmp_path / "torn.mcap")]
    assert steps == [0, 5, 10, 15, 25, 30, 35, 40, 45, 50]


def test_uncompressed_frames_are_views_into_the_file(recorded: Any) -> None:
    file, _, _ = recorded
    recording = headrace.Recording(file)
    is_compressed = b"zstd" in file.read_bytes()[:4000]
    assert np.shares_memory(recording[2].position, np.frombuffer(recording._view, "u1")) == (not is_compressed)


def test_what_the_other_client_recorded_is_read(program: pathlib.Path, tmp_path: pathlib.Path) -> None:
    run(program, "run", "dam_break_2d", "--until", "step=4", "--fps", "1000", "--out", tmp_path)
    recording = headrace.Recording(tmp_path / "dam_break_2d.mcap")
    assert recording.is_complete and recording[0].step == 0 and recording[-1].particle_count == 3200


@pytest.mark.parametrize("content", [b"", b"\x89MCAP0\r", b"PK\x03\x04" + bytes(100)])
def test_what_is_no_recording_is_refused(tmp_path: pathlib.Path, content: bytes) -> None:
    (tmp_path / "a.mcap").write_bytes(content)
    with pytest.raises(headrace.ParseError, match="no recording"):
        headrace.Recording(tmp_path / "a.mcap")
    with pytest.raises(headrace.FileError, match="No such file"):
        headrace.Recording(tmp_path / "none.mcap")


def test_a_file_of_another_program_is_refused(tmp_path: pathlib.Path) -> None:
    header = b"\x04\0\0\0ros2\0\0\0\0"
    (tmp_path / "other.mcap").write_bytes(b"\x89MCAP0\r\n\x01" + len(header).to_bytes(8, "little") + header)
    with pytest.raises(headrace.ParseError, match="another program"):
        headrace.Recording(tmp_path / "other.mcap")
