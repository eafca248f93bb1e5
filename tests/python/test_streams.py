"""Frames as they come: lossless without gaps, live, recorded; equal to what the C++ client writes."""

from __future__ import annotations

import csv
import itertools
import pathlib
import signal
import subprocess
import sys
from typing import Any

import headrace
import numpy as np
import pytest
from headrace import Frame
from headrace._stream import LosslessSource

from conftest import run, tank

# A reader in a process of its own: tells the stream's name and the number of each frame that it has dealt with, and is
# killed when it has dealt with the seventh.
READER = """
import os, signal, sys, headrace
sim = headrace.Simulation(sys.argv[1])
for frame in (stream := sim.stream(["id"], every=1, window=4, until="step=60")):
    print(stream.id, frame.seq, flush=True)
    if frame.seq == 7:
        os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_lossless_stream_has_no_gaps(sim: Any) -> None:
    frames = list(sim.stream(every=2, until="step=100"))
    assert [frame.step for frame in frames] == list(range(0, 101, 2))
    assert [frame.seq for frame in frames] == list(range(1, 52))


def test_a_slow_reader_holds_the_run_up_and_loses_nothing(sim: Any) -> None:
    steps = []
    with sim.stream(["id"], every=1, window=2, until="step=60") as stream:
        for frame in stream:
            # This frame and the next are under way; the step after them is done, and its frame has to wait.
            assert sim.status().step <= frame.step + 2
            steps.append(frame.step)
    assert steps == list(range(61))


def test_frames_come_by_simulated_time(sim: Any) -> None:
    dt = sim.status().time_step
    times = [frame.time for frame in sim.stream(every=0.05, until=0.3)]
    # One frame per interval, taken after the step that reaches it.
    assert times[0] == 0 and np.allclose(np.diff(times), 0.05, atol=dt)


def test_a_stream_of_a_run_started_elsewhere_ends_with_it(sim: Any) -> None:
    with sim.stream(every=1) as stream:
        sim.run(until="step=20", wait=False)
        assert [frame.step for frame in stream] == list(range(21))
        assert stream.read() is None


def test_a_stream_whose_reader_was_killed_is_resumed_without_a_lost_frame(sim: Any) -> None:
    reader = subprocess.run([sys.executable, "-c", READER, sim.endpoint], stdout=subprocess.PIPE, text=True, timeout=300)
    assert reader.returncode == -signal.SIGKILL
    told = [line.split() for line in reader.stdout.splitlines()]
    name, last = told[-1][0], int(told[-1][1])
    with sim.stream(resume=name, acked=last) as stream:
        frames = list(stream)
        assert stream.id == name
    assert [int(seq) for _, seq in told] + [frame.seq for frame in frames] == list(range(1, 62))
    assert [frame.step for frame in frames] == list(range(last, 61)) and all(list(frame) == ["id"] for frame in frames)
    assert sim.wait().state == "finished" and sim.status().streams == 0


def test_resuming_from_what_was_acknowledged_repeats_what_was_not(sim: Any) -> None:
    first = sim.stream(every=1, window=4, until="step=20")
    assert [first.read().seq for _ in range(3)] == [1, 2, 3]  # asking for the third has acknowledged the second
    with sim.stream(resume=first.id) as stream:
        assert [frame.seq for frame in stream] == list(range(3, 22))
    first.close()


def test_streams_are_resumed_as_they_were_opened(sim: Any) -> None:
    for options in ({"acked": 3}, {"resume": "data/1", "every": 2}, {"resume": "data/1", "lossless": False},
                    {"resume": "data/1", "window": 4}):
        with pytest.raises(headrace.Usage):
            sim.stream(**options)
    with pytest.raises(headrace.StreamNotFound):
        list(sim.stream(resume="data/none"))
    with sim.stream(every=1, until="step=20") as stream:
        assert stream.read().seq == 1
        with pytest.raises(headrace.InvalidParams, match="not between"):
            list(sim.stream(resume=stream.id, acked=1000))
        assert [frame.seq for frame in stream] == list(range(2, 22))


def test_a_lost_frame_is_told(sim: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    keep = LosslessSource._keep
    monkeypatch.setattr(LosslessSource, "_keep", lambda self, part: Frame(part.buffer).seq == 4 or keep(self, part))
    with sim.stream(every=1, until="step=10") as stream:
        assert [stream.read().seq for _ in range(3)] == [1, 2, 3]
        with pytest.raises(headrace.ConnectionFailed, match="frames 4 to 4"):
            stream.read()
    sim.wait()


def test_a_damaged_frame_is_refused_and_the_client_goes_on(sim: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def damaged(message: memoryview) -> Frame:
        return Frame(bytes(message[:-1]) + bytes([message[-1] ^ 1]))

    with sim.stream(every=1, until="step=10") as stream, monkeypatch.context() as patch:
        patch.setattr("headrace._stream.Frame", damaged)
        with pytest.raises(headrace.ParseError, match="CRC"):
            list(stream)
    assert sim.wait().step == 10 and sim.status().streams == 0


def test_a_stream_left_early_does_not_hold_the_run(sim: Any) -> None:
    with sim.stream(every=1, window=1, until="step=200") as stream:
        assert [frame.step for frame in itertools.islice(stream, 3)] == [0, 1, 2]
    assert sim.wait().step == 200
    assert sim.status().streams == 0


@pytest.mark.parametrize("lossless", [True, False])
def test_a_stream_that_a_loop_has_left_does_not_hold_the_run(sim: Any, lossless: bool) -> None:
    options = {"window": 1, "stall_timeout": 3600} if lossless else {}
    for frame in sim.stream(lossless=lossless, until="step=200", **options):
        assert frame.step == 0
        break
    del frame
    # Were the stream still open, the run would wait for its reader for an hour.
    assert sim.wait(timeout=60).step == 200
    while sim.status().streams > 0:  # nothing has waited for its end
        pass


def test_a_stream_whose_run_is_refused_is_not_left_open(sim: Any) -> None:
    sim.run(wait=False)
    before = sim.events().last_seq
    with pytest.raises(headrace.WrongState):
        list(sim.stream(every=1, until="step=200"))
    sim.cancel()
    # Closed by a message that nobody answers: the event may follow.
    assert sim.events(since=before, timeout=60.0, types=["stream.closed"]).events
    assert sim.run(until="steps=100").steps == 100


def test_a_stream_that_is_read_too_slowly_fails_where_that_was_asked_for(sim: Any) -> None:
    stream = sim.stream(every=1, window=1, on_stall="fail", until="step=50")
    with stream, pytest.raises(headrace.StreamNotFound):
        stream.read()
        sim.wait()
        list(stream)


def test_a_live_stream_shows_the_newest_frame(sim: Any) -> None:
    steps = [frame.step for frame in sim.stream(lossless=False, until="step=3000")]
    assert steps[0] == 0 and steps == sorted(set(steps))
    assert sim.status().streams == 0


def test_a_stream_that_follows_goes_on_between_runs(sim: Any) -> None:
    with sim.stream(every=1, follow=True) as stream:
        sim.step(2)
        assert [stream.read().step for _ in range(3)] == [0, 1, 2]
        sim.step(2)
        assert [stream.read().step for _ in range(2)] == [3, 4]


def test_a_fault_is_raised_after_the_last_frame(water: Any) -> None:
    water.load(tank("wcsph", objects=[]))
    steps = []
    with pytest.raises(headrace.Faulted, match="domain"):
        for frame in water.stream(["position"], every=1, until=2.0):
            steps.append(frame.step)
    assert steps == list(range(water.status().step + 1))


@pytest.mark.parametrize("every", [0, -1.0, True, "2"])
def test_intervals_that_make_no_sense_are_refused(sim: Any, every: Any) -> None:
    with pytest.raises(headrace.Usage):
        sim.stream(every=every)


def test_frames_equal_the_csv_files_of_the_other_client(sim: Any, data: pathlib.Path, program: pathlib.Path,
                                                        tmp_path: pathlib.Path) -> None:
    with sim.record("same.mcap", every=10, overwrite=True) as recording:
        frames = list(sim.stream(every=10, until="step=50"))
    assert recording.file == "same.mcap"
    run(program, "convert", data / "same.mcap", "--format", "csv", "--out", tmp_path)
    with open(tmp_path / "same_frames.csv", newline="") as file:
        index = list(csv.DictReader(file))
    assert [frame.step for frame in frames] == [int(row["step"]) for row in index] == list(range(0, 51, 10))
    for frame, row in zip(frames, index):
        rows = np.loadtxt(tmp_path / row["file"], delimiter=",", skiprows=1)
        ours = np.column_stack([frame[name] for name in frame])
        # The CSV has the shortest digits that give back the stored single-precision number: equal to the last bit.
        assert np.array_equal(rows.astype(np.float32), ours.astype(np.float32))


def test_a_recording_tells_what_it_holds(sim: Any, data: pathlib.Path) -> None:
    recording = sim.record(data / "two.mcap", every=5, compression="zstd", overwrite=True)
    sim.step(20)
    done = recording.stop()
    assert (done.frames, done.gaps, done.step) == (5, 0, 20)
    assert done.bytes == (data / "two.mcap").stat().st_size
    with pytest.raises(headrace.RecordingNotFound):
        recording.stop()
    with pytest.raises(headrace.FileError):
        sim.record("two.mcap")
    with pytest.raises(headrace.Error, match="mcap"):
        sim.record("two.txt")
