"""A headraced of a script's own: on free loopback ports, in a folder of its own, ended with the block."""

import contextlib
import json
import subprocess
import tempfile
from collections.abc import Iterator


@contextlib.contextmanager
def private_server(headraced: str, *options: str) -> Iterator[dict[str, str]]:
    """Starts a server and yields its ready line (endpoints `control`, `events`, `frames`, `data`) and its `folder`."""
    with tempfile.TemporaryDirectory() as folder:
        command = [headraced, "--bind", "tcp://127.0.0.1:*", "--data", folder, "--json", "--quit-on-stdin-eof", *options]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
            try:
                ready = process.stdout.readline()
                if not ready:
                    raise RuntimeError(f"{headraced} ended before it was ready")
                yield json.loads(ready) | {"folder": folder}
            finally:
                process.stdin.close()
                try:
                    process.wait(timeout=60)
                except subprocess.TimeoutExpired:
                    process.kill()
