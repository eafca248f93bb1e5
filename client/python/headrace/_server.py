"""A headraced of one's own, on an ipc endpoint in a private folder; it ends when its standard input ends."""

from __future__ import annotations

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import weakref

from ._operation import Steps, Wait
from .errors import ConnectionFailed, FileError

READY_PATIENCE = 20.0  # [s] a loaded machine may take long to start a process
END_PATIENCE = 10.0  # [s] after end-of-file; it closes recordings first
TERM_PATIENCE = 2.0  # [s]
LONGEST_IPC_PATH = 100  # [bytes] 107 less the server's endings for its other sockets


def find_server() -> pathlib.Path | None:
    """HEADRACE_SERVER_BINARY, else in the checkout that this package stands in, else on the PATH."""
    chosen = os.environ.get("HEADRACE_SERVER_BINARY")
    if chosen:
        return pathlib.Path(chosen) if os.access(chosen, os.X_OK) else None
    checkout = pathlib.Path(__file__).resolve().parents[3]
    for build in ("build", "build-demo"):
        built = checkout / build / "server" / "headraced"
        if os.access(built, os.X_OK):
            return built
    found = shutil.which("headraced")
    return pathlib.Path(found) if found else None


class PrivateServer:
    """Started by `start`; ended by `stop`, or at the latest when the interpreter ends."""

    def __init__(self, threads: int | None, data: str | os.PathLike[str] | None) -> None:
        binary = find_server()
        if binary is None:
            raise ConnectionFailed("headraced is not found", hint="set HEADRACE_SERVER_BINARY to its path, put it on "
                                   "the PATH, or give the endpoint of a running one: "
                                   "Simulation('tcp://127.0.0.1:5755')")
        self.endpoint = ""
        folder = _private_folder()
        if data is None:
            data = os.getcwd() if os.access(os.getcwd(), os.W_OK) else folder
        self.data = pathlib.Path(data).resolve()
        words = [str(binary), "--bind", f"ipc://{folder / 's'}", "--data", str(self.data), "--json",
                 "--quit-on-stdin-eof", *(["--threads", str(threads)] if threads else [])]
        self._log = folder / "log"
        try:
            with open(self._log, "wb") as log:
                # A session of its own: Ctrl-C reaches the client only, which then ends the server in order.
                self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log,
                                                bufsize=0, start_new_session=True)
        except OSError as error:
            shutil.rmtree(folder, ignore_errors=True)
            raise ConnectionFailed(f"cannot start {binary}: {error.strerror}") from error
        self._end = weakref.finalize(self, _end, self.process, folder)

    def start(self) -> Steps[None]:
        """Returns when the server listens."""
        assert self.process.stdout is not None
        text = b""
        deadline = time.monotonic() + READY_PATIENCE
        while b"\n" not in text:
            if not (yield Wait(self.process.stdout.fileno(), deadline - time.monotonic())):
                raise ConnectionFailed(f"the private server does not get ready: {self._last_log_line()}")
            got = os.read(self.process.stdout.fileno(), 4096)
            if not got:
                self.process.wait(TERM_PATIENCE)
                raise self.gone() or ConnectionFailed("the private server has closed its standard output")
            text += got
        self.endpoint = json.loads(text.split(b"\n")[0])["control"]

    def stop(self) -> Steps[None]:
        """Ends the server in order and waits for it."""
        assert self.process.stdin is not None and self.process.stdout is not None
        self.process.stdin.close()
        deadline = time.monotonic() + END_PATIENCE
        while self._end.alive and (yield Wait(self.process.stdout.fileno(), deadline - time.monotonic())):
            if not os.read(self.process.stdout.fileno(), 4096):
                break
        self._end()

    def gone(self) -> ConnectionFailed | None:
        """How the server ended, if it did."""
        status = self.process.poll()
        if status is None:
            return None
        how = f"was ended by signal {-status}" if status < 0 else f"exited with status {status}"
        line = self._last_log_line()
        return ConnectionFailed(f"the private server {how}" + (f": {line}" if line else ""))

    def _last_log_line(self) -> str:
        try:
            lines = [line for line in self._log.read_text(errors="replace").splitlines() if line]
        except OSError:
            return ""
        return lines[-1] if lines else ""


def _private_folder() -> pathlib.Path:
    base = tempfile.gettempdir()
    if len(os.fsencode(base)) + 24 > LONGEST_IPC_PATH:
        base = "/tmp"
    try:
        return pathlib.Path(tempfile.mkdtemp(prefix="headrace-", dir=base))
    except OSError as error:
        raise FileError(f"{base}: {error.strerror}", path=base,
                        hint="set TMPDIR to a folder that can be written") from error


def _end(process: subprocess.Popen[bytes], folder: pathlib.Path) -> None:
    assert process.stdin is not None and process.stdout is not None
    process.stdin.close()
    for patience, insist in ((END_PATIENCE, process.terminate), (TERM_PATIENCE, process.kill), (None, process.kill)):
        try:
            process.wait(patience)
            break
        except subprocess.TimeoutExpired:
            insist()
    process.stdout.close()
    shutil.rmtree(folder, ignore_errors=True)
