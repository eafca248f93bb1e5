#!/usr/bin/python3
"""Checks proto/schemas with an independent validator: every schema against the 2020-12 metaschema, every example and
preset against its schema. Ends with status 1 when one fails."""

import json
import pathlib
import sys

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
failures = []


def load(file):
    with open(file, encoding="utf-8") as text:
        return json.load(text)


def check(what, value, schema):
    error = jsonschema.exceptions.best_match(jsonschema.Draft202012Validator(schema).iter_errors(value))
    if error is not None:
        failures.append(f"{what}: {error.json_path}: {error.message}")


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "proto" / "schemas"
    schemas = {file.name.removesuffix(".schema.json"): load(file) for file in sorted(folder.glob("*.schema.json"))}
    for name, schema in schemas.items():
        try:
            jsonschema.Draft202012Validator.check_schema(schema)
        except jsonschema.exceptions.SchemaError as error:
            failures.append(f"{name}.schema.json: {error.message}")

    checked = set()
    examples = sorted(folder.glob("*.example.json"))
    for file in examples:
        name, example = file.name.removesuffix(".example.json"), load(file)
        if name in ("scene", "event"):
            parts = {name: example}
        else:
            method = example["request"]["method"]
            if name not in (method, "error"):
                failures.append(f"{file.name}: is an example of {method}")
            parts = (
                {"error": example["reply"]["error"]}
                if name == "error"
                else {name + ".params": example["request"]["params"], name + ".result": example["reply"]["result"]}
            )
        for schema_name, value in parts.items():
            if schema_name not in schemas:
                failures.append(f"{file.name}: no {schema_name}.schema.json")
                continue
            checked.add(schema_name)
            check(f"{file.name} against {schema_name}", value, schemas[schema_name])
    for name in sorted(set(schemas) - checked):
        failures.append(f"{name}.schema.json: no example")

    presets = sorted((ROOT / "proto" / "presets").glob("*.json"))
    for file in presets:
        check(f"presets/{file.name}", load(file), schemas.get("scene", False))

    for failure in failures:
        print(failure, file=sys.stderr)
    print(f"checked {len(schemas)} schemas, {len(examples)} examples, {len(presets)} presets: {len(failures)} failures")
    return 1 if failures or not schemas or not examples else 0


if __name__ == "__main__":
    sys.exit(main())
