#!/usr/bin/python3
"""What `describe` says holds: it is an OpenRPC document, each example in it works on a server and is answered as the result's
schema says, and the events that come are those it lists.

usage: check_description.py HEADRACED REPOSITORY
"""

import json
import pathlib
import re
import sys
from collections.abc import Callable
from typing import Any

import jsonschema
import zmq

from private_server import private_server

PATIENCE_MS = 120_000  # a loaded machine with sanitizers; only a failing test waits so long

failures: list[str] = []

# ---- OpenRPC 1.2.6 (https://spec.open-rpc.org/): which objects have which members -----------------------------------------


def open_rpc_object(needed: str, /, **members: Any) -> dict[str, Any]:
    """An object of the specification: no members but its own and extensions, `x-...`."""
    return {
        "type": "object",
        "required": needed.split(),
        "properties": members,
        "patternProperties": {"^x-": True},
        "additionalProperties": False,
    }


TEXT = {"type": "string"}
NAME = {"type": "string", "minLength": 1}
SCHEMA = {"type": ["object", "boolean"]}
DESCRIPTOR = open_rpc_object(
    "name schema", name=NAME, summary=TEXT, description=TEXT, required={"type": "boolean"}, schema=SCHEMA,
    deprecated={"type": "boolean"},
)
EXAMPLE = open_rpc_object("name value", name=NAME, summary=TEXT, description=TEXT, value=True)
PAIRING = open_rpc_object(
    "name params", name=NAME, summary=TEXT, description=TEXT, params={"type": "array", "items": EXAMPLE}, result=EXAMPLE
)
ERROR = open_rpc_object("code message", code={"type": "integer"}, message=TEXT, data=True)
METHOD = open_rpc_object(
    "name params",
    name={"type": "string", "pattern": r"^(?!rpc\.)."},  # JSON-RPC 2.0 keeps rpc.* for itself
    summary=NAME,
    description=TEXT,
    paramStructure={"enum": ["by-name", "by-position", "either"]},
    params={"type": "array", "items": DESCRIPTOR},
    result=DESCRIPTOR,
    errors={"type": "array", "items": ERROR},
    examples={"type": "array", "items": PAIRING, "minItems": 1},  # ours: each method has one
    deprecated={"type": "boolean"},
)
OPEN_RPC = open_rpc_object(
    "openrpc info methods",
    openrpc={"type": "string", "pattern": r"^1\.2\.\d+$"},
    info=open_rpc_object("title version", title=TEXT, version=TEXT, description=TEXT),
    methods={"type": "array", "items": METHOD},
    components=open_rpc_object("", schemas={"type": "object", "propertyNames": {"pattern": r"^[0-9a-zA-Z._-]+$"}}),
)


def validate(what: str, value: Any, schema: dict[str, Any], document: dict[str, Any]) -> None:
    """Holds a value against a schema that stands in the document, in which it may refer to other parts."""
    resolver = jsonschema.RefResolver.from_schema(document)
    validator = jsonschema.Draft202012Validator(schema, resolver=resolver)
    error = jsonschema.exceptions.best_match(validator.iter_errors(value))
    if error is not None:
        failures.append(f"{what}: {error.json_path}: {error.message}")


def expect(is_so: bool, what: str) -> None:
    if not is_so:
        failures.append(what)


def check_document(document: dict[str, Any]) -> None:
    validate("describe", document, OPEN_RPC, document)
    names = [method["name"] for method in document["methods"]]
    expect(len(names) == len(set(names)), "two methods have one name")
    for method in document["methods"]:
        name = method["name"]
        schemas = [method["x-params-schema"], method["result"]["schema"], *(p["schema"] for p in method["params"])]
        for schema in schemas:
            for judge in (jsonschema.Draft202012Validator, jsonschema.Draft7Validator):  # OpenRPC means the latter
                try:
                    judge.check_schema(schema)
                except jsonschema.exceptions.SchemaError as error:
                    failures.append(f"{name}: no schema: {error.json_path}: {error.message}")
        order = [parameter["required"] for parameter in method["params"]]
        expect(order == sorted(order, reverse=True), f"{name}: optional parameters stand before required ones")
        errors = [error["data"]["name"] for error in method["errors"]]
        expect(len(errors) == len(set(errors)), f"{name}: an error is listed twice: {errors}")
        for example in method["examples"]:
            params = {parameter["name"]: parameter["value"] for parameter in example["params"]}
            validate(f"{name}: params of its example", params, method["x-params-schema"], document)
            validate(f"{name}: result of its example", example["result"]["value"], method["result"]["schema"], document)


# ---- the examples, on servers of their own -------------------------------------------------------------------------------


class Client:
    """JSON-RPC on the control and the data socket."""

    def __init__(self, server: dict[str, str]) -> None:
        self.folder = pathlib.Path(server["folder"])
        self.context = zmq.Context()
        self.sockets = {name: self.context.socket(zmq.DEALER) for name in ("control", "data")}
        for name, socket in self.sockets.items():
            socket.connect(server[name])
        self.last_id = 0

    def close(self) -> None:
        self.context.destroy(linger=0)

    def ask(self, method: str, params: dict[str, Any], socket: str = "control") -> dict[str, Any]:
        """The reply; frames that come before it are passed over."""
        self.last_id += 1
        request = {"jsonrpc": "2.0", "id": self.last_id, "method": method, "params": params}
        self.sockets[socket].send_string(json.dumps(request))
        while self.sockets[socket].poll(PATIENCE_MS):
            part = self.sockets[socket].recv_multipart()[0]
            if part.startswith(b"{") and json.loads(part).get("id") == self.last_id:
                return json.loads(part)
        raise RuntimeError(f"no reply to {method}")

    def call(self, method: str, socket: str = "control", **params: Any) -> dict[str, Any]:
        reply = self.ask(method, params, socket)
        if "error" in reply:
            raise RuntimeError(f"{method} {params}: {reply['error']}")
        return reply["result"]


def load(client: Client, scene: str = "dam_break") -> None:
    client.call("scene.load", scene=scene)


def run(client: Client) -> None:
    load(client)
    client.call("sim.run")


def pause(client: Client) -> None:
    run(client)
    client.call("sim.pause")


def do_three_jobs(client: Client) -> None:
    load(client)
    for _ in range(3):
        client.call("sim.step")


def add_ball(client: Client) -> None:
    load(client)
    client.call("objects.add", object={"name": "ball", "shape": {"sphere": {"center": [0.6, 0.1, 0.2], "radius": 0.08}}})


def add_gauge(client: Client) -> None:
    load(client)
    client.call("probes.add", probe={"name": "H1", "kind": {"level": {"from": [0.3, 0, 0.1], "to": [0.3, 0.6, 0.1]}}})


def remove_panel(client: Client) -> None:
    add_ball(client)
    for _ in range(4):
        client.call("objects.move", name="ball", by=[0, 0.01, 0])
    client.call("objects.remove", name="panel")


def stream_twice(client: Client) -> None:
    load(client)
    for _ in range(2):
        client.call("stream.open", "data", mode="lossless", every_steps=2, window=1024)
    client.call("sim.step", steps=240)  # 121 frames each


def start_recording(client: Client) -> None:
    load(client)
    client.call("record.start", file="run1.mcap")


def make_folder(client: Client) -> None:
    load(client)
    (client.folder / "dam").mkdir()


# What has to be there for an example to work; else a loaded scene.
SETTING: dict[str, Callable[[Client], None]] = {
    "hello": lambda _: None,
    "describe": lambda _: None,
    "scene.list": lambda _: None,
    "scene.load": lambda _: None,
    "job.wait": do_three_jobs,
    "sim.pause": run,
    "sim.resume": pause,
    "sim.cancel": run,
    "sim.inspect": lambda client: load(client, "water_tank"),
    "params.set": run,
    "objects.move": add_ball,
    "probes.get": lambda client: load(client, "water_dam_break"),
    "probes.remove": add_gauge,
    "events.since": remove_panel,
    "stream.open": stream_twice,
    "stream.ack": stream_twice,
    "stream.close": stream_twice,
    "record.start": make_folder,
    "record.stop": start_recording,
}


POINTS = {
    "headrace_scene": 1, "name": "points", "dimensions": 2, "model": "thesis", "spacing": 0.1,
    "domain": {"min": [0, 0], "max": [1, 1]}, "fluids": [{"name": "water", "particles": {"file": "points.csv"}}],
}


def check_refusals(headraced: str, document: dict[str, Any]) -> int:
    """Whatever a method refuses, in a server without a scene, with one, and on the other socket, it refuses with an error
    that is listed. Returns how many refusals there were."""
    listed = {m["name"]: {error["data"]["name"] for error in m["errors"]} for m in document["methods"]}
    kinds = {error["name"]: error["code"] for error in document["x-errors"]["names"]}
    refused = 0

    def judge(name: str, error: dict[str, Any]) -> None:
        kind = error["data"]["name"]
        expect(kind in listed[name], f"{name} is refused with {kind}, which is not listed for it: {error}")
        expect(kinds.get(kind) == error["code"], f"{name}: the code of {kind} is not {error['code']}")

    with private_server(headraced, "--threads", "1") as server:
        client = Client(server)
        try:
            for is_loaded in (False, True):
                if is_loaded:
                    load(client, "dam_break_2d")
                for method in document["methods"]:
                    name = method["name"]
                    example = {p["name"]: p["value"] for p in method["examples"][0]["params"]}
                    # What would succeed is not tried, as some of it takes its time.
                    is_tried = not is_loaded and name not in ("scene.load", "server.shutdown", "job.wait", "events.since")
                    tries = [({"nonsense": 1}, "control"), ({"nonsense": 1}, "data"), (example, "data")]
                    for params, socket in tries + ([(example, "control"), ({}, "control")] if is_tried else []):
                        error = client.ask(name, params, socket).get("error")
                        if error is None:
                            continue
                        refused += 1
                        judge(name, error)
            # A reset reads the particles' file anew.
            file = client.folder / "points.csv"
            file.write_text("position_x,position_y\n0.1,0.1\n")
            client.call("scene.load", scene=POINTS)
            file.write_text("position_x,position_y\n0.1,one\n")
            judge("sim.reset", client.ask("sim.reset", {})["error"])
            file.unlink()
            judge("sim.reset", client.ask("sim.reset", {})["error"])
        finally:
            client.close()
    return refused


def check_events(client: Client, document: dict[str, Any]) -> set[str]:
    """All that has happened is listed, as it is listed. Returns the types that came."""
    listed = {event["type"]: event for event in document["x-events"]["types"]}
    events = client.call("events.since")["events"]
    for event in events:
        validate(f"event {event['type']}", event, document["x-events"]["schema"], document)
        expect(event["type"] in listed, f"event {event['type']} is not listed")
        if event["type"] in listed:
            about = listed[event["type"]]
            data = event.get("data", {})
            expect(set(data) == set(about["data"]), f"event {event['type']} has data {data}")
            expect(("objects" in event) == about["objects"], f"event {event['type']}: objects are not as listed")
    return {event["type"] for event in events}


def try_example(headraced: str, method: dict[str, Any], document: dict[str, Any]) -> set[str]:
    name = method["name"]
    with private_server(headraced, "--threads", "1") as server:
        client = Client(server)
        try:
            SETTING.get(name, load)(client)
            socket = "control" if method["x-socket"] == "control" else "data"
            for example in method["examples"]:
                params = {parameter["name"]: parameter["value"] for parameter in example["params"]}
                reply = client.ask(name, params, socket)
                expect("result" in reply, f"{name}: its example is answered with {reply.get('error')}")
                if "result" in reply:
                    validate(f"{name}: the server's reply", reply["result"], method["result"]["schema"], document)
            return set() if name == "server.shutdown" else check_events(client, document)
        finally:
            client.close()


def check_error_example(client: Client, repository: pathlib.Path, document: dict[str, Any]) -> None:
    example = json.loads((repository / "proto" / "schemas" / "error.example.json").read_text())
    reply = client.ask(example["request"]["method"], example["request"]["params"])
    expect(reply.get("error") == example["reply"]["error"], f"the example of an error is answered with {reply}")
    validate("the example of an error", reply["error"], document["x-errors"]["schema"], document)
    listed = {error["name"]: error["code"] for error in document["x-errors"]["names"]}
    expect(listed[reply["error"]["data"]["name"]] == reply["error"]["code"], "an error's code is not the one listed")


def check_event_sources(repository: pathlib.Path, document: dict[str, Any]) -> None:
    """Types that no example brings about: what the server's sources report is listed, and nothing else is."""
    sources = "\n".join(file.read_text() for file in sorted((repository / "server").rglob("*.cpp")))
    reported = set(re.findall(r'(?:\breport\(|\.type = )"([a-z_]+\.[a-z_]+)"', sources))
    listed = {event["type"] for event in document["x-events"]["types"]}
    expect(len(reported) > 15, f"few events in the sources: {reported}")
    expect(reported <= listed, f"events that are not listed: {reported - listed}")
    unknown = {event for event in listed if f'"{event}"' not in sources}
    expect(not unknown, f"events that the server does not know: {unknown}")


def main() -> int:
    headraced, repository = sys.argv[1], pathlib.Path(sys.argv[2])
    with private_server(headraced) as server:
        client = Client(server)
        document = client.call("describe")
        check_document(document)
        check_error_example(client, repository, document)
        check_event_sources(repository, document)
        client.close()
    types = set().union(*(try_example(headraced, method, document) for method in document["methods"]))
    refusals = check_refusals(headraced, document)
    expect(refusals > 3 * len(document["methods"]), f"only {refusals} refusals")
    for failure in failures:
        print(failure, file=sys.stderr)
    count = sum(len(method["examples"]) for method in document["methods"])
    print(f"{len(document['methods'])} methods, {count} examples, {len(types)} types of events, "
          f"{refusals} refusals: {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
