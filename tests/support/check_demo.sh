#!/usr/bin/env bash
# The demo as a user runs it, with the programs of an existing build: the recording is whole and without gaps, and every
# frame became a ParaView file and a picture. Arguments: build folder, repository root, folder for the results.
set -euo pipefail
build=$1
root=$2
out=$3
rm -rf "$out"

fail() {
    echo "check_demo.sh: $*" >&2
    find "$out" -maxdepth 2 | sort | head -50 >&2
    exit 1
}

# What the user and an earlier demo have left.
mkdir -p "$out/dam_break"
touch "$out/dam_break/notes.txt" "$out/dam_break/dam_break_999999.vtp"

HEADRACE_BUILD_DIR=$build HEADRACE_NO_INSTALL=1 "$root/client/demo.sh" --out "$out" </dev/null

files="$out/dam_break"
[ -e "$files/notes.txt" ] || fail "the user's own file is gone"
[ ! -e "$files/dam_break_999999.vtp" ] || fail "a file of an earlier demo is still there"
[ -s "$files/dam_break.pvd" ] || fail "no .pvd"
particle_files=$(find "$files" -name 'dam_break_[0-9]*.vtp' -size +0 | wc -l)
[ "$particle_files" -ge 301 ] || fail "$particle_files particle files instead of 301"
pictures=$(find "$files" -name 'dam_break_[0-9]*.png' -size +0 | wc -l)
[ "$pictures" -eq 301 ] || fail "$pictures pictures instead of 301"
[ "$(head -c 4 "$files/dam_break_sheet.png" | tail -c 3)" = PNG ] || fail "no contact sheet"
info=$("$build/client/headrace" --json info "$out/dam_break.mcap")
for fact in '"complete":true' '"frames":301' '"gaps":0'; do
    tr -d ' \n' <<<"$info" | grep -q "${fact}[,}]" || fail "the recording is not whole, no $fact: $info"
done
