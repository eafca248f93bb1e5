#!/usr/bin/env bash
# README.md's still water: its commands are run as they stand there, and must print what stands there.
# usage: still_water.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"

cd "$work" || exit 1
mkdir bin
ln -s "$headrace" bin/headrace
export PATH="$work/bin:$PATH"
start_server --threads 1

/usr/bin/python3 - "$root/README.md" <<'PYTHON' || exit 1
import re
import subprocess
import sys

# Pairs are summed in single precision and in an order that depends on the instruction set, which must not matter more than
# the precision itself does: with `precision=double` the bed's pressure is 9813.77 Pa, 3e-6 of it away. Three times that.
TOLERANCE = 1e-5
NUMBER = re.compile(r"-?\d[\d,]*(?:\.\d+)?(?:e-?\d+)?")


def same(shown, printed):
    """Words and whole numbers are equal, other numbers within the tolerance."""
    if NUMBER.sub("#", shown) != NUMBER.sub("#", printed):
        return False
    pairs = list(zip(NUMBER.findall(shown), NUMBER.findall(printed)))
    return all(a == b or ("." in a and abs(float(a) - float(b)) <= TOLERANCE * abs(float(a))) for a, b in pairs)


text = open(sys.argv[1], encoding="utf-8").read()
blocks = [block for block in re.findall(r"^```\n(.*?)^```$", text, re.M | re.S) if "$ headrace load water_tank" in block]
assert len(blocks) == 1, f"README.md shows {len(blocks)} sessions with still water"
session = re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", blocks[0], re.M)
assert len(session) >= 5, session
compared = 0
for command, shown in session:
    done = subprocess.run(["bash", "-c", command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    print(f"$ {command}\n{done.stdout}", end="")
    assert done.returncode == 0, f"{command} ended with {done.returncode}: {done.stderr}"
    if shown:
        compared += len(NUMBER.findall(shown))
        assert same(shown, done.stdout), f"{command} printed\n{done.stdout}where README.md shows\n{shown}"
assert compared >= 12, f"only {compared} numbers were compared"
with open("bed.csv", encoding="utf-8") as file:
    rows = file.read().splitlines()
assert len(rows) == 52, f"bed.csv has {len(rows)} lines"
PYTHON
# The probe that the last line adds is there: its first sample has the weight of the water, 9,810 N/m downwards.
"$headrace" probes force >force.csv || fail "no probe force: $(cat force.csv)"
/usr/bin/python3 - <<'PYTHON' || fail "$(cat force.csv)"
rows = open("force.csv").read().splitlines()
fy = float(rows[-1].split(",")[2])
assert abs(fy + 9810) < 0.02 * 9810, fy  # the water still sloshes by some per mille
PYTHON
echo "the still water holds"
