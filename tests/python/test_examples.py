"""The examples run as a user runs them, with small settings, and come to what they promise."""

from __future__ import annotations

import importlib.util
import os
import pathlib
import re
import shutil
import sys

import numpy as np
import pytest

from conftest import PACKAGE, run

EXAMPLES = PACKAGE / "examples"
needs_matplotlib = pytest.mark.skipif(importlib.util.find_spec("matplotlib") is None, reason="no matplotlib here")


@pytest.fixture
def here(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> pathlib.Path:
    monkeypatch.chdir(tmp_path)
    # The interpreter that has the packages is the one that scripts call.
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python3").symlink_to(sys.executable)
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}{os.pathsep}{os.environ['PATH']}")
    return tmp_path


def example(name: str, *words: object) -> str:
    return run(sys.executable, EXAMPLES / name, *words).stdout


def is_picture(file: pathlib.Path) -> bool:
    """Whether it shows something: not all of its pixels have one colour."""
    from matplotlib.image import imread

    pixels = imread(file)[..., :3]
    return bool(pixels.min() < 0.5 < pixels.max())


def test_dam_break_follows_the_front(here: pathlib.Path) -> None:
    text = example("dam_break.py", "--settle", "step=100", "--for", "0.3")
    assert text.startswith("3000 particles behind a panel\nstep 100 reached: step 100, t 1.00 s\n")
    fronts = [float(front) for front in re.findall(r"front at (\S+) m", text)]
    # The panel stands at 0.407 m; without it the front moves on.
    assert len(fronts) == 4 and fronts[0] < 0.41 and fronts == sorted(fronts) and fronts[-1] > 0.5


@needs_matplotlib
def test_viscosity_sweep_draws_slower_fronts_for_thicker_fluids(here: pathlib.Path) -> None:
    text = example("viscosity_sweep.py", "--until", "0.2")
    fronts = [float(front) for front in re.findall(r"front at (\S+) m", text)]
    assert len(fronts) == 4 and fronts == sorted(fronts, reverse=True) and fronts[0] > fronts[-1]
    assert is_picture(here / "viscosity_sweep.png")


@needs_matplotlib
def test_live_probe_draws_while_the_run_goes_on(here: pathlib.Path) -> None:
    assert "reached: " in example("live_probe.py", "--until", "0.05")
    assert is_picture(here / "live_probe.png")


def test_gravity_turned_round_lifts_the_fluid(here: pathlib.Path) -> None:
    text = example("change_while_running.py", "--until", "0.4")
    assert re.search(r"gravity turned round before step \d+, t 0\.(1[89]|2[0-3])\d* s", text)
    assert text.count("rms speed") == 21


@needs_matplotlib
def test_thesis_scenes_are_drawn(here: pathlib.Path) -> None:
    text = example("thesis_scenes.py", "--rest", "step=20", "--scale", "0.1")
    particles = dict(re.findall(r"(\w+): (\d+) particles", text))
    assert particles == {"bowl": "2197", "dam_break": "3000", "obstacle": "3000"}
    assert is_picture(here / "thesis_scenes.png")


def test_resolution_study_finds_an_order(here: pathlib.Path) -> None:
    text = example("resolution_study.py", "--particles", 12, 24, "--until", 0.1)
    errors = [float(error) for error in re.findall(r"error (\S+) %", text)]
    order = float(text.split()[-1])
    # The printed errors have three decimals.
    assert errors[1] < errors[0] and order == pytest.approx(np.log2(errors[0] / errors[1]), abs=0.02)


def fronts_of(study: str) -> dict[float, float]:
    return {float(viscosity): float(front) for viscosity, front, _ in re.findall(r"^(\S+),(\S+),(\d+)$", study, re.M)
            if viscosity != "viscosity"}


@pytest.mark.skipif(shutil.which("parallel") is None, reason="GNU parallel is not installed")
def test_a_study_with_gnu_parallel_has_a_line_per_case(here: pathlib.Path) -> None:
    run("sh", EXAMPLES / "study" / "parallel.sh", "study.csv", "--until", "0.1", env={**os.environ, "HOME": str(here)})
    study = (here / "study.csv").read_text()
    assert study.startswith("viscosity,front,steps\n") and list(fronts_of(study)) == [0.5, 2, 5, 10]
    # Each case has a server of its own, so running four at once changes nothing.
    assert fronts_of(run(sys.executable, EXAMPLES / "study" / "case.py", "5", "--until", "0.1").stdout) == {
        5.0: fronts_of(study)[5.0]}
