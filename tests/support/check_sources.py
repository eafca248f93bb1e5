#!/usr/bin/python3
"""What every text of ours must keep: no leftovers, no paths of one machine, no giant files, an end to each last line."""
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()

MOST_LINES = 600
SOURCES = (".h", ".cpp", ".py", ".sh", ".mjs", ".cmake")
TEXTS = SOURCES + (".md", ".txt", ".json", ".in")
LEFTOVERS = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b")
MACHINE_PATHS = re.compile(r"(?<![\w.$}])/(home|root|work|Users)/\w")


def our_files():
    try:
        names = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                               check=True, capture_output=True, text=True).stdout.split("\0")
        return [root / name for name in names if name and (root / name).is_file()]
    except (OSError, subprocess.CalledProcessError):  # an unpacked archive
        return [f for f in root.rglob("*") if f.is_file() and not re.match(r"(build|out|\.)", f.relative_to(root).parts[0])
                and "node_modules" not in f.parts]


def faults_of(file):
    name = file.relative_to(root)
    text = file.read_text(encoding="utf-8")
    lines = text.splitlines()
    if file.suffix in SOURCES and len(lines) > MOST_LINES:
        yield f"{name}: {len(lines)} lines, more than {MOST_LINES}"
    if text and not text.endswith("\n"):
        yield f"{name}: no newline at the end"
    for number, line in enumerate(lines, 1):
        if LEFTOVERS.search(line) or MACHINE_PATHS.search(line):
            yield f"{name}:{number}: {line.strip()}"
        if "\t" in line and file.suffix in SOURCES:
            yield f"{name}:{number}: a tab"


def main():
    files = [f for f in our_files() if f.suffix in TEXTS and f.name != "package-lock.json"]
    faults = [fault for file in sorted(files) for fault in faults_of(file)]
    print("\n".join(faults) if faults else f"{len(files)} files are in order")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
