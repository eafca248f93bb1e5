"""The package as it is installed and typed, and the documents about it."""

from __future__ import annotations

import ast
import contextlib
import importlib.util
import inspect
import io
import os
import pathlib
import pydoc
import re
import shutil
import subprocess
import sys
from typing import Any

import headrace
import pytest
from headrace import aio
from headrace._operation import operation, operation_property

from conftest import PACKAGE, ROOT, run, tank


def test_pip_installs_it_from_a_checkout_without_a_network(tmp_path: pathlib.Path) -> None:
    for module in ("venv", "pip", "setuptools", "wheel", "ensurepip"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"the module {module} is not installed")
    shutil.copytree(PACKAGE, tmp_path / "python", ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv")
    python = tmp_path / "venv" / "bin" / "python"
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    run(python, "-m", "pip", "install", "--no-index", "--no-build-isolation", tmp_path / "python", env=clean)
    script = "import headrace; sim = headrace.Simulation(threads=1); sim.load('dam_break_2d'); " \
             "print(headrace.__file__, sim.step(2).step)"
    file, step = run(python, "-c", script, env=clean, cwd=tmp_path).stdout.split()
    assert pathlib.Path(file).is_relative_to(tmp_path / "venv") and step == "2"
    assert (pathlib.Path(file).parent / "py.typed").exists()


def test_types_hold(tmp_path: pathlib.Path) -> None:
    if shutil.which("mypy") is None:
        pytest.skip("mypy is not installed")
    done = subprocess.run(["mypy", "--cache-dir", str(tmp_path)], cwd=PACKAGE, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_types_tell_the_two_clients_apart(tmp_path: pathlib.Path) -> None:
    if shutil.which("mypy") is None:
        pytest.skip("mypy is not installed")
    (tmp_path / "use.py").write_text(
        "import headrace\nfrom headrace import aio\n"
        "def one(sim: headrace.Simulation) -> int:\n    sim.stepp\n    headrace.ObjectNotFound('x').hint\n"
        "    return sim.snapshot().step\n"
        "async def two(sim: aio.Simulation) -> int:\n    (await sim.snapshot()).step\n    return sim.snapshot().step\n")
    done = subprocess.run(["mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), "use.py"], cwd=tmp_path,
                          capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(PACKAGE)})
    assert set(re.findall(r"use\.py:(\d+): error", done.stdout)) == {"4", "9"}, done.stdout


def public(kind: type) -> set[str]:
    return {name for name in dir(kind) if not name.startswith("_") and name not in ("open",)}


@pytest.mark.parametrize("name", ["Simulation", "Stream", "Parameters", "Objects", "Probes", "ServerRecording"])
def test_both_clients_have_the_same_names(name: str) -> None:
    blocking, awaited = getattr(headrace.simulation, name), getattr(aio, name)
    assert public(blocking) - {"keys"} == public(awaited)


def operations() -> list[tuple[str, Any]]:
    kinds = (headrace.Simulation, headrace.Stream, headrace.simulation.Parameters, headrace.simulation.Objects,
             headrace.simulation.Probes, headrace.simulation.ServerRecording)
    found = ((kind, name, inspect.getattr_static(kind, name)) for kind in kinds for name in dir(kind) if name[0] != "_")
    return [(f"{kind.__name__}.{name}", member) for kind, name, member in found
            if isinstance(member, (operation, operation_property))]


def test_every_operation_is_documented() -> None:
    assert len(operations()) > 30
    assert [name for name, member in operations() if not (member.__doc__ or "").strip()] == []


def test_every_operation_is_used_by_the_tests() -> None:
    text = "".join(file.read_text() for file in pathlib.Path(__file__).parent.glob("test_*.py"))
    used = {node.attr for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Attribute)}
    assert {name.split(".")[1] for name, _ in operations()} - used == set()


def test_help_shows_every_operation_with_its_text() -> None:
    for client in (headrace.Simulation, aio.Simulation):
        text = pydoc.plain(pydoc.render_doc(client))
        assert "Do so many steps." in text and "The stages of a step" in text
    assert "step(self, steps: 'int' = 1) -> 'Reply'" in pydoc.plain(pydoc.render_doc(headrace.Simulation))
    assert "step(self, steps: 'int' = 1) -> 'Awaitable[Reply]'" in pydoc.plain(pydoc.render_doc(aio.Simulation))


def test_signatures_show_what_a_user_gives_and_gets(tmp_path: pathlib.Path) -> None:
    with headrace.Simulation(threads=1, data=tmp_path) as sim:
        assert str(inspect.signature(sim.step)) == "(steps: 'int' = 1) -> 'Reply'"
        assert str(inspect.signature(sim.params.info)) == "(name: 'str') -> 'Parameter'"
    awaited = aio.Simulation("ipc:///nowhere")  # not connected yet
    assert str(inspect.signature(awaited.step)) == "(steps: 'int' = 1) -> 'Awaitable[Reply]'"


def sessions(file: pathlib.Path) -> list[str]:
    """The Python code that a document shows."""
    return re.findall(r"^```python\n(.*?)^```", file.read_text(), re.M | re.S)


@pytest.mark.parametrize("document, least", [(ROOT / "README.md", 1), (PACKAGE / "README.md", 4)])
def test_what_the_documents_show_runs(document: pathlib.Path, least: int, tmp_path: pathlib.Path,
                                      monkeypatch: pytest.MonkeyPatch) -> None:
    """In order, in one namespace. A comment `# prints TEXT` behind a print must be what is printed."""
    monkeypatch.chdir(tmp_path)
    shown = sessions(document)
    assert len(shown) >= least
    names: dict[str, Any] = {"__name__": "__main__"}
    for code in shown:
        with contextlib.redirect_stdout(io.StringIO()) as output:
            exec(compile(code, str(document), "exec"), names)
        for promise in re.findall(r"# prints (.*)$", code, re.M):
            assert promise in output.getvalue()
