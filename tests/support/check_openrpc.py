#!/usr/bin/python3
"""What `describe` returns fits the meta-schema that the makers of OpenRPC publish, on npm. check_description.py holds it
against a compact one of ours, which needs no network.

usage: check_openrpc.py HEADRACED
Exits with 77 where Node.js or the packages of tests/support/openrpc are not installed.
"""

import json
import pathlib
import shutil
import subprocess
import sys
from typing import Any

import jsonschema
import zmq

from private_server import private_server

PACKAGES = pathlib.Path(__file__).resolve().parent / "openrpc"
PATIENCE_MS = 120_000  # a loaded machine with sanitizers; only a failing test waits so long


def published(package: str) -> Any:
    """The schema that a package exports."""
    script = f"process.stdout.write(JSON.stringify(require('{package}').default))"
    return json.loads(subprocess.run(["node", "-e", script], cwd=PACKAGES, check=True, capture_output=True).stdout)


def describe(headraced: str) -> Any:
    with private_server(headraced, "--threads", "1") as server, zmq.Context() as context:
        with context.socket(zmq.REQ) as socket:
            socket.setsockopt(zmq.LINGER, 0)
            socket.connect(server["control"])
            socket.send_string(json.dumps({"jsonrpc": "2.0", "id": 1, "method": "describe"}))
            if not socket.poll(PATIENCE_MS):
                sys.exit("no reply to describe")
            return json.loads(socket.recv())["result"]


def main() -> int:
    if shutil.which("node") is None or not (PACKAGES / "node_modules" / "@open-rpc").is_dir():
        print(f"no Node.js, or run npm ci in {PACKAGES}", file=sys.stderr)
        return 77
    # The document's meta-schema refers to that of schemas, with and without a slash at the end of its address.
    meta, schemas = published("@open-rpc/meta-schema"), published("@json-schema-tools/meta-schema")
    address = str(schemas["$id"]).rstrip("/")
    meta.pop("$schema"), schemas.pop("$schema")  # JSON Schema draft 7 under another name
    resolver = jsonschema.RefResolver(meta["$id"], meta, store={address: schemas, address + "/": schemas})
    validator = jsonschema.Draft7Validator(meta, resolver=resolver)
    document = describe(sys.argv[1])

    # The judge is no yes-man.
    for damage in ({"methods": [{"name": 7}]}, {"openrpc": "12"}, {"info": {}}):
        if validator.is_valid(document | damage):
            sys.exit(f"the meta-schema takes {damage}")

    failures = sorted(validator.iter_errors(document), key=lambda error: error.json_path)
    for failure in failures:
        best = jsonschema.exceptions.best_match([failure])
        print(f"{best.json_path}: {best.message[:500]}", file=sys.stderr)
    print(f"{len(document['methods'])} methods against the published meta-schema: {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
