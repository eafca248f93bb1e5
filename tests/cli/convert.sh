#!/usr/bin/env bash
# `headrace convert`: selections, jobs and errors. What it wrote of one recording stays in RESULTS/convert for other
# programs' readers.
# usage: convert.sh HEADRACED HEADRACE ROOT [RESULTS]
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
results=${4:-}

cd "$work" || exit 1
cat >flat.json <<'JSON'
{"headrace_scene": 1, "name": "flat", "dimensions": 2, "model": "wcsph", "spacing": 0.02,
 "parameters": {"gravity": [0, -9.81]},
 "domain": {"min": [-0.1, -0.1], "max": [0.5, 0.5]},
 "fluids": [{"name": "block", "shape": {"box": {"min": [0, 0], "max": [0.2, 0.2]}}}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [0.4, 0.4]}}},
             {"name": "lid", "role": "obstacle", "shape": {"box": {"min": [0.3, 0.25], "max": [0.34, 0.29]}},
              "motion": {"displacement": [0, "t"]}}],
 "output": {"interval": 0.01, "fields": ["id", "position", "velocity", "density", "pressure"]}}
JSON
"$headrace" run flat.json --until 0.1 --out . --format '' >run.txt 2>&1 || fail "run: $(cat run.txt)"
convert() { "$headrace" convert flat.mcap "$@"; }

formats=vtp,csv,csv-long,npz,ply
expect_result 0 'open all/flat\.pvd in ParaView' convert --format $formats --out all
for ending in vtp csv npz ply; do
    [ "$(find all -name "flat_[0-9]*.$ending" | wc -l)" = 11 ] || fail "not 11 files .$ending: $(ls all)"
done

# The files do not depend on the number of jobs, pictures included.
pictures=png,pov
if command -v ffmpeg >/dev/null 2>&1; then pictures+=,mp4; fi
for jobs in 1 3; do convert --format $formats,$pictures --size 320x240 --jobs $jobs --out jobs$jobs >notes 2>&1 || fail "$(cat notes)"; done
diff -r jobs1 jobs3 || fail "1 and 3 jobs write different files"
find . -name '*.part' | grep -q . && fail "temporary files are left"

# A moving object stands in each file where it did at its time: the lid rises from 0.25 m by 1 m/s for 0.1 s. POV-Ray's
# matrix ends with the box's lower corner; a rounding, and the thousandth that solids are drawn smaller.
[ "$(find jobs1 -name 'flat_objects_*.vtp' | wc -l)" = 11 ] || fail "not 11 files of objects: $(ls jobs1)"
lid_height() { sed -n '/^\/\/ lid$/{n;s/.*,\([0-9.]*\),-[0-9.e-]*> texture.*/\1/p}' "$1"; }
[[ $(lid_height jobs1/flat_000000.pov) =~ ^0\.250 ]] || fail "the lid begins at $(lid_height jobs1/flat_000000.pov)"
[[ $(lid_height jobs1/flat_000010.pov) =~ ^0\.35[0-2] ]] || fail "the lid ends at $(lid_height jobs1/flat_000010.pov)"
# Colours may be asked for by the names that people use.
for name in velocity speed; do
    convert --format png --sheet-only --size 320x240 --color-by $name --out by_$name >notes 2>&1 || fail "$(cat notes)"
done
diff -r by_velocity by_speed || fail "the colours of speed are not those of the velocity"

# Some particles, some fields, some frames.
expect_result 0 '3 files part/flat_\*\.csv.*' convert --format csv --out part --fields id,density --region 0,0,0.1,0.05 \
    --from 0.015 --to 0.065 --every 2
head -n 1 part/flat_000000.csv | grep -qx 'id,density \[kg/m^3\]' || fail "fields: $(head -n 1 part/flat_000000.csv)"
rows=$(($(wc -l <part/flat_000000.csv) - 1))
[ "$rows" -gt 5 ] && [ "$rows" -lt 20 ] || fail "$rows particles of about 12 are in the region"

# What leaves nothing is said, and no file is written.
expect 2 'error usage \(--fields\): there is no field acceleration; the recording holds id, position, .*' \
    convert --format csv --out none --fields acceleration
expect 2 'error usage (.*): did you mean "velocity"\?' convert --format csv --out none --fields velocty
expect 2 'error usage \(--region\): no particle is ever inside; .*' convert --format csv --out none --region 5,5,6,6
expect 2 'error usage \(--region\): the second corner .*' convert --format csv --out none --region 1,1,0,0
expect 6 'error file_error (.*): no frame in the range asked for; its frames are from t 0 s to .*' \
    convert --format csv --out none --from 7
expect 2 'error usage \(--to\): the range ends before it begins; .*' convert --format csv --out none --from 2 --to 1
expect 2 'error usage \(--format\): did you mean "npz"\?' convert --format npx --out none
expect 2 'error usage \(--format\): png files need the field acceleration; .*' \
    convert --format png --color-by acceleration --out none
expect 2 'error usage \(--crop\): "here" is no part of a scene; .*' convert --format png --out none --crop here
expect 2 'error invalid_params \(--crop\): .*' convert --format png --out none --crop 0.2,0,0.1,0.2
expect 2 'error invalid_params \(picture\.view\.zoom\): .*' convert --format png --out none --zoom 0
# Numbers are refused in few words.
expect 2 'error usage \(--fps\): "abc" is no number; .{1,80}' convert --format png --out none --fps abc
expect 2 'error usage: --every: "0" is no number above 0; .{1,80}' convert --format png --out none --every 0
expect 2 'error usage \(--color-by\): there is no field "vorticity"; known: .*' convert --format png --color-by vorticity --out none
[ ! -e none ] || fail "a refused conversion left $(ls none)"
mkdir taken
mkdir taken/flat_long.csv
expect 6 '(.*)error file_error (.*): cannot write .*flat_long\.csv.*' convert --format csv-long --out taken
[ -z "$(find taken -type f)" ] || fail "a failed conversion left $(find taken -type f)"

# A failure in the middle leaves whole frames only, and what it says is there is there; what was in the folder stays. It fails
# at the sixth frame, whichever job has it.
for jobs in 1 3; do
    half=half$jobs
    mkdir -p "$half/flat_000005.csv"
    touch "$half/flat_000010.ply"
    expect 6 '(.*)error file_error (.*): cannot write .*flat_000005\.csv: .*; written and whole: the first 5 frames of 11' \
        convert --format npz,csv,csv-long,vtp --jobs $jobs --out "$half"
    for ending in npz csv vtp; do
        [ "$(cd "$half" && find . -type f -name "flat_[0-9]*.$ending" | sort | tr -d '\n')" = \
            "$(printf "./flat_00000%d.$ending" 0 1 2 3 4)" ] || fail "jobs $jobs, $ending: $(ls "$half")"
    done
    [ -d "$half/flat_000005.csv" ] && [ -f "$half/flat_000010.ply" ] || fail "others' files are gone: $(ls "$half")"
    # The list for ParaView names these five, each with its objects, and there is nothing else but the other's file.
    [ "$(grep -c 'part="0"' "$half/flat.pvd")" = 5 ] || fail "the list is not of 5 frames: $(cat "$half/flat.pvd")"
    [ "$(find "$half" -type f ! -name 'flat_objects_*.vtp' | wc -l)" = 17 ] || fail "more than that: $(ls "$half")"
    [ "$(find "$half" -name 'flat_objects_*.vtp' | wc -l)" = "$(grep -o 'flat_objects_[0-9]*' "$half/flat.pvd" | sort -u | wc -l)" ] ||
        fail "objects of no frame: $(ls "$half")"
done
# A file that grows meets the limit of sizes (as it would a full disk): of the frame at which it does nothing is listed.
expect 6 '(.*)error file_error (.*): cannot write .*full/flat_long\.csv: File too large; written and whole: the first [0-9]+ frames? of 11' \
    bash -c 'ulimit -f 30; exec "$1" convert flat.mcap --format vtp,csv-long --jobs 2 --out full' - "$headrace"
frames=$(sed -nE 's/.*the first ([0-9]+) frames? of 11.*/\1/p' <<<"$output")
[ "$frames" -ge 1 ] && [ "$frames" -lt 11 ] || fail "$frames frames in 30 kB"
[ "$(find full -type f -name 'flat_[0-9]*.vtp' | wc -l)" = "$frames" ] || fail "not $frames frames: $(ls full)"
[ "$(grep -c 'part="0"' full/flat.pvd)" = "$frames" ] || fail "the list is not of $frames frames: $(cat full/flat.pvd)"
mkdir -p first/flat_000000.npz
expect 6 '(.*)error file_error (.*): cannot write .*flat_000000\.npz: .*; nothing was written' convert --format npz --out first
[ -z "$(find first -type f)" ] || fail "a conversion that failed at once left $(find first -type f)"

if [ -n "$results" ]; then
    rm -rf "$results/convert"
    mkdir -p "$results"
    cp -r all "$results/convert"
fi
