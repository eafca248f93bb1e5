#!/usr/bin/env bash
# Particles from files: a frame converted to .npz, .csv and .ply starts a scene with the same positions and velocities;
# what is wrong with a file is told of its place, and the server lives on.
# usage: particles.sh HEADRACED HEADRACE ROOT [RESULTS]
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"

cd "$work" || exit 1
# scene NAME DIMENSIONS MODEL FLUID: a document on standard output.
scene() {
    local corner='0.4, 0.4' low='-0.1, -0.1' high='0.5, 0.5' origin='0, 0' gravity='0, -9.81'
    if [ "$2" = 3 ]; then
        corner+=', 0.4' low+=', -0.1' high+=', 0.5' origin+=', 0' gravity+=', 0'
    fi
    cat <<JSON
{"headrace_scene": 1, "name": "$1", "dimensions": $2, "model": "$3", "spacing": 0.02,
 "parameters": {"gravity": [$gravity]}, "domain": {"min": [$low], "max": [$high]}, "fluids": [$4],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [$origin], "max": [$corner]}}}],
 "output": {"interval": 0.01, "fields": ["id", "position", "velocity", "density", "pressure"]}}
JSON
}

# same_columns A.csv B.csv: positions and velocities are the same digits, those of single precision.
cat >same_columns.py <<'PY'
import csv
import sys

tables = [list(csv.DictReader(open(name, newline=""))) for name in sys.argv[1:]]
wanted = [title for title in tables[0][0] if title.startswith(("position", "velocity"))]
assert len(wanted) in (4, 6) and len(tables[0]) == len(tables[1]) > 0
assert any(float(row["velocity_y [m/s]"]) != 0 for row in tables[0])
for first, second in zip(*tables):
    assert all(first[title] == second[title] for title in wanted), (first, second)
PY

mkdir -p data
for kind in '2 wcsph flat' '3 wcsph deep' '2 thesis soft'; do
    read -r dimensions model name <<<"$kind"
    high='0.2, 0.2'
    [ "$dimensions" = 2 ] || high='0.1, 0.1, 0.1'
    low=${high//0.[12]/0}
    scene "$name" "$dimensions" "$model" "{\"name\": \"block\", \"shape\": {\"box\": {\"min\": [$low], \"max\": [$high]}}}" \
        >"$name.json"
    "$headrace" run "$name.json" --until 0.05 --out . --format '' >run.txt 2>&1 || fail "run: $(cat run.txt)"
    "$headrace" convert "$name.mcap" --format npz,csv,ply --out frames --from 0.045 >run.txt 2>&1 || fail "$(cat run.txt)"
    for ending in npz csv ply; do
        cp "frames/${name}_000000.$ending" "data/$name.$ending"
        again=${name}_$ending
        scene "$again" "$dimensions" "$model" "{\"name\": \"block\", \"particles\": {\"file\": \"$name.$ending\"}}" \
            >"data/$again.json"
        "$headrace" run "data/$again.json" --steps 1 --out again --format csv --overwrite >run.txt 2>&1 ||
            fail "$again: $(cat run.txt)"
        /usr/bin/python3 same_columns.py "frames/${name}_000000.csv" "again/${again}_000000.csv" ||
            fail "$again does not start as the frame was"
    done
done

# A server finds the files below its data folder, and resets from them.
start_server --json
expect_result 0 'flat_npz: 100 particles, .*' "$headrace" load data/flat_npz.json
"$headrace" reset >reset.txt 2>&1 || fail "reset: $(cat reset.txt)"

# refuse FILE PATTERN: loading it as flat particles is refused with this message.
refuse() {
    scene bad 2 wcsph "{\"name\": \"block\", \"particles\": {\"file\": \"$1\"}}" >bad.json
    expect "${3:-2}" "error (scene_invalid|file_error) \((params\.)?scene\.fluids\[0\]\.particles(\.file)?\): $2" \
        "$headrace" load bad.json
}
refuse missing.npz 'there is no file missing\.npz below .*' 6
refuse ../own.npz 'the path leaves the data folder; .*' 6
refuse /etc/hostname 'an absolute path is not allowed; .*' 6
echo x >data/odd.txt
refuse odd.txt 'particles are read from \.npz, \.csv and \.ply files, not from odd\.txt; .*' 6
printf 'position_x [m],position_y\n0.1,0.1\n0.2,abc\n' >data/cell.csv
refuse cell.csv 'cell\.csv, line 3: column 2 \(position_y\) is "abc", not a number; .*'
printf 'position_x,position_y\n0.1,0.1,7\n' >data/wide.csv
refuse wide.csv 'wide\.csv, line 2: 3 columns where line 1 has 2.*'
printf 'position_x,density\n0.1,1\n' >data/half.csv
refuse half.csv 'half\.csv, there is no position_y; .*'
printf 'velocity_x,velocity_y\n1,1\n' >data/nowhere.csv
refuse nowhere.csv 'nowhere\.csv, column position_x is missing; there are the columns velocity_x, velocity_y; .*'
printf 'position_x,position_y\n0.1,nan\n' >data/nan.csv
refuse nan.csv 'nan\.csv, position_y of particle 0 is not finite.*'
printf 'position_x,position_y\n0.1,0.9\n' >data/outside.csv
refuse outside.csv 'reaches out of container "tank" with particle 0 at \(0\.1, 0\.9\) m; leave the particle out .*'
printf 'position_x,position_y,position_z\n0.1,0.1,0.2\n' >data/solid.csv
refuse solid.csv 'solid\.csv, position_z of particle 0 is not 0 in a scene of 2 dimensions; .*'
echo nothing >data/broken.npz
refuse broken.npz 'broken\.npz is not a zip archive, or not all of one; .*'
head -c 3000 data/flat.npz >data/cut.npz
refuse cut.npz 'cut\.npz .*'
head -c 1000 data/flat.ply >data/cut.ply
refuse cut.ply 'cut\.ply, the file is cut off at vertex [0-9]+ of 100.*'
printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty list uchar int y\nend_header\n0 0\n' >data/list.ply
refuse list.ply 'list\.ply, line 5: a property of type list is not read here; .*'

# Text of other programs is read too.
printf 'ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0.1 0.1 0\n0.2 0.1 0\n' >data/text.ply
scene text 2 wcsph '{"name": "block", "particles": {"file": "text.ply"}, "velocity": [1, 0]}' >text.json
expect_result 0 'text: 2 particles, .*' "$headrace" load text.json
scene none 2 wcsph '{"name": "block"}' >none.json
expect 2 'error (.*)shape(.*)particles(.*)' "$headrace" load none.json
