"""A Slurm cluster of one machine for a test: munged, slurmctld and slurmd configured anew, on loopback
and in a temporary folder, ended by their own process ids."""

from __future__ import annotations

import contextlib
import os
import pathlib
import shutil
import socket
import subprocess
import time
from typing import Iterator

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo", "squeue")
PATIENCE = 120.0  # [s] for each thing asked of the daemons; a loaded machine may be slow


def why_not() -> str:
    """Why there can be no cluster here; "" when there can."""
    missing = [program for program in PROGRAMS if find(program) is None]
    if missing:
        return f"Slurm is not installed: no {', '.join(missing)}"
    return "" if os.geteuid() == 0 else "the daemons of Slurm need root"


def find(program: str) -> str | None:
    return shutil.which(program, path=os.environ["PATH"] + ":/usr/sbin:/sbin")


def free_ports(count: int) -> list[int]:
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]


def configuration(folder: pathlib.Path) -> str:
    name = socket.gethostname().split(".")[0]
    controller, node = free_ports(2)
    return f"""ClusterName=test
SlurmctldHost={name}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SchedulerParameters=batch_sched_delay=0,sched_interval=1
MpiDefault=none
SwitchType=switch/none
NodeName={name} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
"""


@contextlib.contextmanager
def cluster(folder: pathlib.Path) -> Iterator[dict[str, str]]:
    """The environment in which sbatch speaks to the cluster."""
    key, conf = folder / "key", folder / "slurm.conf"
    key.write_bytes(os.urandom(128))
    key.chmod(0o600)
    for name in ("state", "spool"):
        (folder / name).mkdir()
    conf.write_text(configuration(folder))
    environment = {**os.environ, "SLURM_CONF": str(conf)}
    daemons = [
        [find("munged"), "--foreground", "--force", f"--key-file={key}", f"--socket={folder}/munge.socket",
         f"--pid-file={folder}/munged.pid", f"--log-file={folder}/munged.log", f"--seed-file={folder}/seed"],
        [find("slurmctld"), "-D"],
        [find("slurmd"), "-D"],
    ]
    running: list[subprocess.Popen[bytes]] = []
    try:
        for words in daemons:
            with open(folder / f"{pathlib.Path(str(words[0])).name}.out", "wb") as output:
                running.append(subprocess.Popen([str(word) for word in words], env=environment, stdout=output,
                                                stderr=subprocess.STDOUT))
        wait_until(lambda: "idle" in output_of("sinfo", "--noheader", "--format=%T", environment=environment), folder)
        yield environment
    finally:
        for daemon in reversed(running):
            daemon.terminate()
            try:
                daemon.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def output_of(*words: str, environment: dict[str, str]) -> str:
    return subprocess.run(words, env=environment, capture_output=True, text=True, timeout=PATIENCE).stdout


def wait_until(is_so: object, folder: pathlib.Path) -> None:
    """Polls, since Slurm's programs only answer questions."""
    assert callable(is_so)
    deadline = time.monotonic() + PATIENCE
    while not is_so():
        if time.monotonic() > deadline:
            logs = "\n".join(file.name + file.read_text(errors="replace")[-2000:] for file in folder.glob("*.out"))
            raise TimeoutError(f"Slurm does not come to it\n{logs}")
        time.sleep(0.1)
