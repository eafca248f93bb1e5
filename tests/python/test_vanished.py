"""What a client says when its server ends, is killed, is another program, or falls silent."""

from __future__ import annotations

import asyncio
import concurrent.futures
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
from typing import Any, Callable, Iterator

import headrace
import pytest
import zmq
from headrace import aio
from headrace._asynchronous import drive as async_drive
from headrace._blocking import drive as blocking_drive
from headrace._operation import Wait

from conftest import tank


@pytest.fixture
def private() -> Iterator[headrace.Simulation]:
    with headrace.Simulation(threads=1) as sim:
        sim.load(tank("thesis"))
        yield sim


def pid_of(sim: Any) -> int:
    return int(sim._server.process.pid)


def test_a_killed_private_server_is_reported_with_its_fate(private: headrace.Simulation) -> None:
    private.run(wait=False)
    os.kill(pid_of(private), signal.SIGKILL)
    with pytest.raises(headrace.ConnectionFailed, match="signal 9"):
        private.wait()
    with pytest.raises(headrace.ConnectionFailed, match="signal 9"):
        private.status()


def test_a_killed_private_server_ends_a_stream(private: headrace.Simulation) -> None:
    stream = private.stream(every=1, until="steps=1000000")
    assert stream.read() is not None
    os.kill(pid_of(private), signal.SIGKILL)
    with pytest.raises(headrace.ConnectionFailed, match="signal 9"):
        list(stream)


def test_the_asyncio_client_reports_it_as_well() -> None:
    async def scenario() -> None:
        async with aio.Simulation(threads=1) as sim:
            await sim.load(tank("thesis"))
            run = asyncio.create_task(sim.run(until="steps=100000000"))
            while (await sim.status()).state != "running":
                pass
            os.kill(pid_of(sim), signal.SIGKILL)
            with pytest.raises(headrace.ConnectionFailed, match="signal 9"):
                await run

    asyncio.run(scenario())


def test_a_vanished_server_of_somebody_else_is_noticed_by_its_silence(private: headrace.Simulation) -> None:
    with headrace.Simulation(private.endpoint, patience=1.5) as guest:
        os.kill(pid_of(private), signal.SIGSTOP)
        try:
            with pytest.raises(headrace.ConnectionFailed, match="no sign of life") as caught:
                guest.status()
            assert caught.value.retryable
        finally:
            os.kill(pid_of(private), signal.SIGCONT)
        assert guest.status().scene == "small"  # the late reply of before is nobody's


def test_a_long_run_outlasts_the_patience_of_its_client(private: headrace.Simulation) -> None:
    with headrace.Simulation(private.endpoint, patience=1.0) as guest:
        # Three times the patience without a reply: signs of life are asked for meanwhile.
        assert guest.run(until=3.0, pace=1.0).state == "finished"


def test_ctrl_c_ends_the_wait_and_leaves_the_run_and_the_client() -> None:
    script = """
import headrace
sim = headrace.Simulation(threads=1)
sim.load("dam_break_2d")
print(sim.endpoint, flush=True)
try:
    sim.run(until="steps=100000000")
except KeyboardInterrupt:
    print(sim.status().state)
    sim.cancel()
    print(sim.step(2).steps)
"""
    # A terminal's Ctrl-C goes to the whole process group of the program.
    program = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True,
                               start_new_session=True)
    assert program.stdout is not None
    with headrace.Simulation(program.stdout.readline().strip()) as other:
        while other.status().state != "running":
            pass
        os.killpg(program.pid, signal.SIGINT)
    assert program.communicate(timeout=60)[0].split() == ["running", "2"]


@pytest.mark.parametrize("drive", [blocking_drive, lambda steps: asyncio.run(async_drive(steps))])
def test_a_wait_tells_whether_there_is_something_to_read(drive: Any) -> None:
    def steps() -> Any:
        before = yield Wait(receiver, 0.01)
        sender.send(b"x")
        return before, (yield Wait(receiver, 30.0)), (yield Wait(pipe[0], 0.01)), os.write(pipe[1], b"x"), (
            yield Wait(pipe[0], 30.0))

    context, pipe = zmq.Context(), os.pipe()
    sender, receiver = context.socket(zmq.PUSH), context.socket(zmq.PULL)
    try:
        receiver.bind("inproc://here")
        sender.connect("inproc://here")
        assert drive(steps()) == (False, True, False, 1, True)
    finally:
        context.destroy(linger=0)
        os.close(pipe[0]), os.close(pipe[1])


def test_threads_may_share_a_client(private: headrace.Simulation) -> None:
    def work(number: int) -> int:
        for _ in range(20):
            private.params[("viscosity", "stiffness")[number % 2]] = float(number)
        return int(private.status().particles)

    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert list(pool.map(work, range(1, 9))) == [200] * 8


def test_a_server_is_named_by_the_environment(private: headrace.Simulation, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HEADRACE_SERVER", private.endpoint)
    with headrace.Simulation("default") as sim:
        assert sim.session == private.session


def test_a_cancelled_task_leaves_the_client_usable() -> None:
    async def scenario() -> None:
        async with aio.Simulation(threads=1) as sim:
            await sim.load(tank("thesis"))
            run = asyncio.create_task(sim.run(until="steps=100000000"))
            while (await sim.status()).state != "running":
                pass
            run.cancel()
            with pytest.raises(asyncio.CancelledError):
                await run
            await sim.cancel()
            results = await asyncio.gather(*(sim.params["viscosity"] for _ in range(20)), sim.step(5))
            assert results[:-1] == [3.5] * 20 and results[-1].steps == 5

    asyncio.run(scenario())


def test_a_private_server_ends_with_its_client_and_leaves_nothing() -> None:
    sim = headrace.Simulation(threads=1)
    process, folder = sim._server.process, pathlib.Path(sim.endpoint.removeprefix("ipc://")).parent  # type: ignore
    assert folder.exists()
    sim.close()
    assert process.returncode == 0 and not folder.exists()
    with pytest.raises(headrace.ConnectionFailed, match="closed"):
        sim.status()


@pytest.mark.parametrize("end", ["", "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"])
def test_a_private_server_does_not_outlive_its_program(end: str) -> None:
    script = f"import headrace\nsim = headrace.Simulation(threads=1)\nprint(sim._server.process.pid, flush=True)\n{end}"
    program = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert program.stdout is not None
    pid = int(program.stdout.readline())
    try:
        descriptor = os.pidfd_open(pid)
    except ProcessLookupError:
        descriptor = None  # gone already
    program.wait()
    program.stdout.close()
    if descriptor is not None:
        poller = zmq.Poller()
        poller.register(descriptor, zmq.POLLIN)
        assert poller.poll(30_000), "the server still runs"
        os.close(descriptor)


def test_shutdown_ends_a_server_of_somebody_else(private: headrace.Simulation) -> None:
    with headrace.Simulation(private.endpoint) as guest:
        guest.shutdown()
    assert private._server is not None and private._server.process.wait(30) == 0


def test_a_server_over_tcp_is_reached_by_its_ports(tmp_path: pathlib.Path) -> None:
    server = subprocess.Popen([os.environ.get("HEADRACE_SERVER_BINARY", "headraced"), "--bind", "tcp://127.0.0.1:*",
                               "--data", str(tmp_path), "--json", "--quit-on-stdin-eof", "--threads", "1"],
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert server.stdin is not None and server.stdout is not None
    ready = json.loads(server.stdout.readline())
    with headrace.Simulation(ready["control"]) as sim:
        assert sim.session == ready["session"]
        sim.load(tank("thesis"))
        assert [frame.step for frame in sim.stream(every=5, until="step=10")] == [0, 5, 10]
        assert next(sim.stream(lossless=False)).step == 10
        assert sim.snapshot().step == 10
    server.stdin.close()
    assert server.wait(30) == 0
    server.stdout.close()


def test_no_program_is_an_error_with_a_remedy(monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path) -> None:
    monkeypatch.setenv("HEADRACE_SERVER_BINARY", str(tmp_path / "none"))
    with pytest.raises(headrace.ConnectionFailed, match="HEADRACE_SERVER_BINARY"):
        headrace.Simulation()


@pytest.mark.parametrize("body, what", [("exit 3", "exited with status 3: out of luck"),
                                        ("exec sleep 0", "exited with status 0")])
def test_a_program_that_ends_at_once_is_reported(monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path, body: str,
                                                 what: str) -> None:
    fake = tmp_path / "headraced"
    fake.write_text(f"#!/bin/sh\necho out of luck >&2\n{body}\n")
    fake.chmod(0o755)
    monkeypatch.setenv("HEADRACE_SERVER_BINARY", str(fake))
    with pytest.raises(headrace.ConnectionFailed, match=what):
        headrace.Simulation()


@pytest.fixture
def pretender(tmp_path: pathlib.Path) -> Iterator[Callable[[bytes], str]]:
    """A peer that answers its first request with given bytes; {id} becomes the request's."""
    context = zmq.Context()
    threads = []

    def start(answer: bytes) -> str:
        socket = context.socket(zmq.ROUTER)
        socket.linger = 0
        endpoint = f"ipc://{tmp_path}/p"
        socket.bind(endpoint)

        def serve() -> None:
            who, request = socket.recv_multipart()
            socket.send_multipart([who, answer.replace(b"{id}", str(json.loads(request)["id"]).encode())])
            socket.close(1000)

        threads.append(threading.Thread(target=serve))
        threads[-1].start()
        return endpoint

    yield start
    for thread in threads:
        thread.join()
    context.destroy()


@pytest.mark.parametrize("answer, kind", [
    (b'{"jsonrpc": "2.0", "id": {id}, "result": {"protocol": 2}}', headrace.ProtocolMismatch),
    (b'{"jsonrpc": "2.0", "id": {id}, "result": 3}', headrace.ProtocolMismatch),
    (b'{"hello": 1}', headrace.ConnectionFailed), (b"{", headrace.ConnectionFailed),
    (b'{"jsonrpc": "2.0", "id": 99, "result": {}}', headrace.ConnectionFailed),
    (b"\x00\x01", headrace.ConnectionFailed),
])
def test_another_program_is_told_from_headraced(pretender: Callable[[bytes], str], answer: bytes,
                                                kind: type[headrace.Error]) -> None:
    with pytest.raises(kind):
        # Where the pretender falls silent the patience has to pass; elsewhere it leaves a loaded machine its time.
        headrace.Simulation(pretender(answer), patience=10.0 if kind is headrace.ProtocolMismatch else 0.3)
