#!/usr/bin/env python3
"""Writes proto/reference.md from what a server's `describe` says, or checks that the file is up to date.

usage: protocol_reference.py HEADRACED HEADRACE REPOSITORY [--write]
"""

import json
import pathlib
import subprocess
import sys

from private_server import private_server

INT_LIMITS = (-(2**31), 2**31 - 1)  # of an integer that the protocol does not limit
STATES = ("empty", "loading", "idle", "running", "faulted")

HEAD = """# Reference of the headrace protocol, number {protocol}

Generated from the server's `describe` by `tests/support/protocol_reference.py`; a test checks that it is up to date.
[README.md](README.md) explains what stands here in tables. SI units; `[1]` is left out. A member `a.b` is member `b` of the
object `a`, `a[].b` one of each object in the list `a`. Schemas and examples as files: `schemas/`.
"""


class Parts:
    """Objects that several messages hold: told once, elsewhere linked."""

    def __init__(self, document):
        scene = result_schema(document, "scene.get")
        objects, probes = (scene["properties"][name]["items"] for name in ("objects", "probes"))
        self.sections = {
            "scene": scene,
            "object": objects,
            "probe": probes,
            "job": result_schema(document, "sim.step"),
            "event": document["x-events"]["schema"],
        } | document["components"]["schemas"]

    def name_of(self, schema):
        for name, part in self.sections.items():
            if "properties" in part and schema.get("properties") == part["properties"]:
                return name
        return None


def result_schema(document, method):
    return next(m for m in document["methods"] if m["name"] == method)["result"]["schema"]


def link(name):
    return f"[{name}](#{name})"


def kind_of(schema, parts):
    if "$ref" in schema:
        return link(schema["$ref"].rsplit("/", 1)[-1])
    if name := parts.name_of(schema):
        return link(name)
    if "enum" in schema:
        return " \\| ".join(f"`{value}`" for value in schema["enum"])
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "oneOf" in schema and "properties" not in schema:
        return "object with one of the members below"
    if "anyOf" in schema:
        return " or ".join(kind_of(option, parts) for option in schema["anyOf"])
    kind = schema.get("type", "any")
    if kind == "array" and "items" in schema:
        count = f"{schema.get('minItems', 0)} to {schema['maxItems']} " if schema.get("maxItems") == 3 else ""
        return f"array of {count}{kind_of(schema['items'], parts)}"
    return " or ".join(kind) if isinstance(kind, list) else kind


def range_of(schema):
    signs = (("minimum", "≥"), ("exclusiveMinimum", ">"), ("maximum", "≤"), ("exclusiveMaximum", "<"))
    own = [(key, sign) for key, sign in signs if key in schema and schema[key] not in INT_LIMITS]
    return ", ".join(f"{sign} {schema[key]:.10g}" for key, sign in own)


def about(schema, parts):
    words = [kind_of(schema, parts)]
    if schema.get("x-unit", "1") != "1":
        words.append(f"[{schema['x-unit']}]")
    if range_of(schema):
        words.append(range_of(schema))
    return " ".join(words)


def rows(schema, parts, prefix="", is_choice=False):
    """One row per member, those of objects inside behind them."""
    for name, member in schema.get("properties", {}).items():
        if is_choice:
            presence = "one of them"
        elif name in schema.get("required", []):
            presence = "required"
        else:
            presence = f"default `{json.dumps(member['default'])}`" if "default" in member else "optional"
        meaning = member.get("description", "").replace("|", "\\|")
        yield f"| `{prefix}{name}` | {about(member, parts)} | {presence} | {meaning} |"
        yield from inner_rows(member, parts, prefix + name)
    for choice in schema.get("oneOf", []):
        if "properties" in choice:
            yield from rows(choice, parts, prefix, is_choice=True)


def inner_rows(schema, parts, path):
    if parts.name_of(schema) or "$ref" in schema:
        return
    if schema.get("type") == "array" and "items" in schema:
        yield from inner_rows(schema["items"], parts, path + "[]")
    else:
        for option in [schema, *schema.get("anyOf", [])]:
            if not parts.name_of(option):
                yield from rows(option, parts, path + ".")


def table(schema, parts):
    if not schema.get("properties") and "oneOf" not in schema:
        return ["No members."]
    return ["| member | kind | | meaning |", "|---|---|---|---|", *rows(schema, parts)]


def states_of(document, method):
    for rule in document["x-state"]:
        if rule["method"] == method:
            return ", ".join(state for state in STATES if rule[state])
    return "every one"


def result_lines(schema, parts):
    name = parts.name_of(schema)
    return [f"Result: {link(name)}."] if name else ["Result:", "", *table(schema, parts)]


def common_errors(document):
    """What every method may give, in the document's order."""
    common = set.intersection(*({e["message"] for e in m["errors"]} for m in document["methods"]))
    return [e["message"] for e in document["methods"][0]["errors"] if e["message"] in common]


def method_section(document, method, parts):
    told = set(common_errors(document))
    if method["x-socket"] == "control":
        told.add("wrong_socket")  # told of all of these together
    own = [f"[`{e['message']}`](#errors)" for e in method["errors"] if e["message"] not in told]
    lines = ["", f"### {method['name']}", "", method["summary"], ""]
    lines += [f"- socket: {method['x-socket']}", f"- states: {states_of(document, method['name'])}"]
    lines += [f"- errors: {', '.join(own)}"] if own else []
    lines += ["", "Params:", "", *table(method["x-params-schema"], parts), ""]
    lines += [*result_lines(method["result"]["schema"], parts), ""]
    for example in method["examples"]:
        params = {param["name"]: param["value"] for param in example["params"]}
        request = {"jsonrpc": "2.0", "id": 1, "method": method["name"], "params": params}
        reply = {"jsonrpc": "2.0", "id": 1, "result": example["result"]["value"]}
        for message in (request, reply):
            lines += ["```json", json.dumps(message, ensure_ascii=False), "```"]
    return lines


def reference(document):
    parts = Parts(document)
    common = [f"`{name}`" for name in common_errors(document)]
    lines = [HEAD.format(protocol=document["x-protocol"])]
    lines += ["## Methods", "", "| method | |", "|---|---|"]
    lines += [f"| [{m['name']}](#{m['name'].replace('.', '')}) | {m['summary']} |" for m in document["methods"]]
    lines += ["", f"Every method may give the errors {', '.join(common)}, and `wrong_socket` on the other socket."]
    for method in document["methods"]:
        lines += method_section(document, method, parts)
    lines += ["", "## Parts of messages"]
    for name, schema in parts.sections.items():
        lines += ["", f"### {name}", "", *table(schema, parts)]
    lines += ["", "## Events", "", "An event's topic on the events socket is the first word of its type.", ""]
    lines += ["| type | when | data |", "|---|---|---|"]
    for event in document["x-events"]["types"]:
        data = ", ".join(f"`{name}`" for name in event["data"]) + (", and `objects`" if event["objects"] else "")
        lines.append(f"| `{event['type']}` | {event['when']} | {data} |")
    lines += ["", "## Errors", "", "| name | code | exit status of `headrace` | retryable | meaning |", "|---|---|---|---|---|"]
    for error in document["x-errors"]["names"]:
        retryable = "yes" if error["retryable"] else ""
        lines.append(f"| `{error['name']}` | {error['code']} | {error['exit_status']} | {retryable} | {error['meaning']} |")
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__.strip())
    headraced, headrace, repository = sys.argv[1:4]
    with private_server(headraced) as server:
        document = json.loads(subprocess.run([headrace, "--server", server["control"], "call", "describe"], check=True,
                                             capture_output=True, text=True).stdout)
    file = pathlib.Path(repository) / "proto" / "reference.md"
    fresh = reference(document)
    if "--write" in sys.argv:
        file.write_text(fresh, encoding="utf-8")
    elif not file.exists() or fresh != file.read_text(encoding="utf-8"):
        sys.exit("proto/reference.md is out of date: run tests/support/protocol_reference.py with --write")
    else:
        print(f"{len(document['methods'])} methods, up to date")


if __name__ == "__main__":
    main()
