#!/usr/bin/env python3
"""Writes the message reference of proto/README.md from proto/schemas, or checks that it is up to date.

usage: protocol_reference.py REPOSITORY [--write]
"""
import json
import pathlib
import sys

BEGIN, END = "<!-- messages -->", "<!-- end of messages -->"


def kind_of(schema):
    if "enum" in schema:
        return " \\| ".join(f"`{value}`" for value in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    if "oneOf" in schema or "anyOf" in schema:
        return " or ".join(kind_of(option) for option in schema.get("oneOf") or schema["anyOf"])
    if "$ref" in schema:
        return schema["$ref"].rsplit("/", 1)[-1]
    kind = schema.get("type", "any")
    if kind == "array" and "items" in schema:
        return f"array of {kind_of(schema['items'])}"
    return " or ".join(kind) if isinstance(kind, list) else kind


def range_of(schema):
    words = []
    for key, sign in (("minimum", "≥"), ("exclusiveMinimum", ">"), ("maximum", "≤"), ("exclusiveMaximum", "<")):
        if key in schema:
            words.append(f"{sign} {schema[key]:g}" if isinstance(schema[key], (int, float)) else str(schema[key]))
    return ", ".join(words)


def table(schema):
    rows = []
    for name, member in schema.get("properties", {}).items():
        unit = member.get("x-unit", "")
        about = [kind_of(member)]
        if unit and unit != "1":
            about.append(f"[{unit}]")
        if range_of(member):
            about.append(range_of(member))
        if name in schema.get("required", []):
            default = "required"
        else:
            default = f"default `{json.dumps(member['default'])}`" if "default" in member else "optional"
        rows.append(f"| `{name}` | {' '.join(about)} | {default} | {member.get('description', '')} |")
    return ["| member | kind | | meaning |", "|---|---|---|---|", *rows] if rows else ["No members."]


def reference(folder):
    lines = []
    for example_file in sorted(folder.glob("*.example.json")):
        name = example_file.name.removesuffix(".example.json")
        params_file, result_file = (folder / f"{name}.{part}.schema.json" for part in ("params", "result"))
        if not params_file.exists():
            continue
        params, result = (json.loads(file.read_text()) for file in (params_file, result_file))
        example = json.loads(example_file.read_text())
        lines += ["", f"### `{name}`", "", "Params:", "", *table(params), "", "Result:", "", *table(result), ""]
        for part in ("request", "reply"):
            lines += ["```json", json.dumps(example[part], ensure_ascii=False), "```"]
    return "\n".join(lines) + "\n"


def main():
    repository = pathlib.Path(sys.argv[1])
    readme = repository / "proto" / "README.md"
    text = readme.read_text()
    head, rest = text.split(BEGIN, 1)
    tail = rest.split(END, 1)[1]
    fresh = head + BEGIN + "\n" + reference(repository / "proto" / "schemas") + END + tail
    if "--write" in sys.argv:
        readme.write_text(fresh)
    elif fresh != text:
        sys.exit("proto/README.md is out of date: run tests/support/protocol_reference.py . --write")
    else:
        print(f"{fresh.count(chr(10) + '### `')} messages, up to date")


if __name__ == "__main__":
    main()
