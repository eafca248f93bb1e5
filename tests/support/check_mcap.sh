#!/usr/bin/env bash
# The reference implementation of MCAP reads our recordings: whole ones by index and as a stream, and one that was cut
# off as a stream. Arguments: repository root, frames that each recording has, recordings.
set -euo pipefail
reader=$1/tests/support/mcap
frames=$2
shift 2
command -v node >/dev/null 2>&1 || { echo "node is not installed" >&2; exit 77; }
[ -d "$reader/node_modules/@mcap/core" ] || { echo "run npm ci in $reader" >&2; exit 77; }

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for recording in "$@"; do
    found=$(node "$reader/read_mcap.mjs" "$recording")
    echo "$found"
    grep -q "\"frames\":$frames," <<<"$found" || { echo "$recording: not $frames frames" >&2; exit 1; }

    # What a killed server leaves: the last bytes are missing, in the middle of a record. Chunks are alike, one for each
    # frame, so two thirds of the bytes hold more than half of the frames.
    head -c "$(($(stat -c %s "$recording") * 2 / 3))" "$recording" >"$scratch/cut.mcap"
    found=$(node "$reader/read_mcap.mjs" "$scratch/cut.mcap" --cut)
    left=$(sed -nE 's/.*"frames":([0-9]+),.*/\1/p' <<<"$found")
    if [ "$((2 * left))" -lt "$frames" ] || [ "$left" -ge "$frames" ]; then
        echo "$recording, cut: $found" >&2
        exit 1
    fi
done
