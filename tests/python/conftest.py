"""What the tests of the Python package share: clients on private servers, small scenes, the built programs."""

from __future__ import annotations

import asyncio
import inspect
import os
import pathlib
import subprocess
import sys
from typing import Any, Iterator

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "client" / "python"
sys.path.insert(0, str(PACKAGE))
os.environ["PYTHONPATH"] = str(PACKAGE)
os.environ.setdefault("MPLBACKEND", "Agg")

import headrace  # noqa: E402
from headrace import aio  # noqa: E402

SKIPPED = 77  # for ctest


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    """Where every test was skipped ctest shall know."""
    reporter = session.config.pluginmanager.get_plugin("terminalreporter")
    counts = {kind: len(reporter.stats.get(kind, [])) for kind in ("passed", "failed", "error", "skipped")}
    if counts["skipped"] and not (counts["passed"] or counts["failed"] or counts["error"]):
        session.exitstatus = SKIPPED


class Awaited:
    """Makes an asyncio client answer like a blocking one: whatever is awaitable is awaited on a loop of its own."""

    def __init__(self, target: Any, loop: asyncio.AbstractEventLoop) -> None:
        self.__dict__.update(target=target, loop=loop)

    def _settle(self, value: Any) -> Any:
        while inspect.isawaitable(value):
            value = self.loop.run_until_complete(_awaited(value))
        return Awaited(value, self.loop) if type(value).__module__ == "headrace.aio" else value

    def __getattr__(self, name: str) -> Any:
        value = getattr(self.target, name)
        if not callable(value):
            return self._settle(value)
        return lambda *args, **kwargs: self._settle(value(*args, **kwargs))

    def __getitem__(self, name: str) -> Any:
        return self._settle(self.target[name])

    def __setitem__(self, name: str, value: Any) -> None:
        self._settle(self.target.set({name: value}))

    def __iter__(self) -> Iterator[Any]:
        if not hasattr(self.target, "__aiter__"):
            yield from self._settle(self.target.all())
            return
        while True:
            try:
                yield self._settle(self.target.__anext__())
            except StopAsyncIteration:
                return

    def __enter__(self) -> Any:
        return self._settle(self.target.__aenter__())

    def __exit__(self, *error: Any) -> None:
        self._settle(self.target.__aexit__(*error))


async def _awaited(value: Any) -> Any:
    return await value


@pytest.fixture(scope="session")
def data(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """The private servers' data folder."""
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="session", params=["blocking", "asyncio"])
def server(request: pytest.FixtureRequest, data: pathlib.Path) -> Iterator[Any]:
    """A client with a private server, once of each kind."""
    if request.param == "blocking":
        with headrace.Simulation(threads=1, data=data) as sim:
            yield sim
    else:
        loop = asyncio.new_event_loop()
        with Awaited(aio.Simulation(threads=1, data=data), loop) as sim:
            yield sim
        loop.close()


@pytest.fixture
def sim(server: Any) -> Any:
    """The same, with the small tank of the thesis's model at step 0."""
    server.cancel()
    server.load(tank("thesis"))
    return server


@pytest.fixture
def water(server: Any) -> Any:
    """The same, with the small tank of `wcsph`."""
    server.cancel()
    server.load(tank("wcsph"))
    return server


@pytest.fixture(scope="session")
def program() -> pathlib.Path:
    """The C++ client of this build."""
    path = pathlib.Path(os.environ.get("HEADRACE_CLIENT_BINARY", ROOT / "build" / "client" / "headrace"))
    if not path.exists():
        pytest.skip("the C++ client is not built")
    return path


def tank(model: str, **members: Any) -> dict[str, Any]:
    """A column of 200 particles that collapses in a 2D tank."""
    return {"headrace_scene": 1, "name": "small", "dimensions": 2, "model": model, "spacing": 0.02,
            "domain": {"min": [-0.2, -0.2], "max": [1.0, 1.0]},
            "fluids": [{"name": "column", "shape": {"box": {"min": [0, 0], "max": [0.2, 0.4]}}}],
            "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [0.8, 0.8]}}}],
            "probes": [{"name": "tip", "kind": {"front": {}}, "every_steps": 1}], **members}


def run(*words: Any, **options: Any) -> subprocess.CompletedProcess[str]:
    """A program's output; its failure is an error of the test."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300, **options)
    assert done.returncode == 0, f"{words} ended with {done.returncode}: {done.stdout}{done.stderr}"
    return done
