"""The job array of the examples, on a Slurm cluster of one machine."""

from __future__ import annotations

import pathlib
import sys

import pytest
import slurm

from conftest import PACKAGE, run

STUDY = PACKAGE / "examples" / "study"

pytestmark = pytest.mark.skipif(bool(slurm.why_not()), reason=slurm.why_not())


def test_a_job_array_runs_each_case_on_a_server_of_its_own(tmp_path: pathlib.Path) -> None:
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python3").symlink_to(sys.executable)
    with slurm.cluster(tmp_path) as environment:
        environment |= {"STUDY": str(STUDY), "PATH": f"{tmp_path / 'bin'}:{environment['PATH']}"}
        run("sbatch", STUDY / "slurm.sh", "--until", "0.1", env=environment, cwd=tmp_path)
        slurm.wait_until(lambda: not slurm.output_of("squeue", "--noheader", environment=environment), tmp_path)
    lines = [(tmp_path / f"study_{task}.csv").read_text() for task in range(4)]
    assert [line.split(",")[0] for line in lines] == ["0.5", "2", "5", "10"]
    assert lines[2] == run(sys.executable, STUDY / "case.py", "5", "--until", "0.1").stdout
