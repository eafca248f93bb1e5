#!/usr/bin/env bash
# Walls of every shape, moved and slippery, by `headrace add`; probes as CSV by `headrace run`.
# usage: walls.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
number='[0-9][0-9,]*(\.[0-9]+)?(e-[0-9]+)?'
start_server --json --threads 1
cd "$work" || exit 1
cat >basin.json <<'JSON'
{"headrace_scene": 1, "name": "basin", "dimensions": 3, "model": "wcsph", "spacing": 0.05,
 "domain": {"min": [-0.5, -0.5, -0.5], "max": [1, 1, 1]},
 "fluids": [{"name": "water", "hydrostatic": true, "shape": {"box": {"min": [0, 0, 0], "max": [0.3, 0.2, 0.2]}}}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0, 0], "max": [0.6, 0.6, 0.2]}}}]}
JSON
cat >flat.json <<'JSON'
{"headrace_scene": 1, "name": "flat", "dimensions": 2, "model": "wcsph", "spacing": 0.05,
 "domain": {"min": [-0.5, -0.5], "max": [1, 1]}, "output": {"interval": 0.01, "fields": ["id", "position"]},
 "fluids": [{"name": "water", "hydrostatic": true, "shape": {"box": {"min": [0, 0], "max": [0.4, 0.3]}}}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [0.4, 0.6]}}}]}
JSON
printf '{"cylinder": {"from": [0.5, 0.45, 0], "to": [0.5, 0.45, 0.2], "radius": 0.05}}' >post.json
printf '{"displacement": {"table": [[0, 0, 0, 0], [1, 0, 0.1, 0]]}, "pivot": [0, 0, 0]}' >lift.json

# Every shape, by numbers and by JSON, inline and from a file
expect_result 0 'basin: 96 particles, .*' "$headrace" load basin.json
expect_result 0 'added before step 0' "$headrace" add rod --cylinder 0.4,0.4,0,0.4,0.4,0.2,0.05 --slip no_slip \
    --motion '{"angle": "2*t", "pivot": [0.4, 0.4, 0]}'
expect_result 0 'added before step 0' "$headrace" add roof --plane 0,0.55,0,0,-1,0
expect_result 0 'added before step 0' "$headrace" add post --shape post.json --motion lift.json
expect_result 0 'added before step 0' "$headrace" add belt --surface-velocity '["0.5*t", 0, 0]' \
    --shape '{"box": {"min": [0.4, 0.1, 0.05], "max": [0.5, 0.2, 0.15]}}'
expect_result 0 'added before step 0' "$headrace" add ball --sphere 0.5,0.3,0.1,0.04 --surface-velocity 0,0,0.5
expect_result 0 '(.*)rod: obstacle, cylinder 0\.4,0\.4,0 to 0\.4,0\.4,0\.2, radius 0\.05, moves.roof: obstacle, plane at 0,0\.55,0, fluid towards 0,-1,0.post: obstacle, cylinder .*, moves.belt: .*ball: .*' \
    "$headrace" objects
"$headrace" --json objects >objects.out || fail "objects --json ended with $?"
/usr/bin/python3 - objects.out <<'PYTHON' || fail "$(cat objects.out)"
import json, sys
objects = {o["name"]: o for o in json.load(open(sys.argv[1]))["objects"]}
assert objects["rod"]["slip"] == "no_slip" and objects["rod"]["motion"]["angle"] == "2*t"
assert objects["post"]["motion"]["displacement"]["table"][1] == [1, 0, 0.1, 0]
assert objects["belt"]["surface_velocity"] == ["0.5*t", 0, 0]
assert objects["ball"]["surface_velocity"] == [0, 0, 0.5]
PYTHON
expect_result 0 'step 5, t .* s' "$headrace" step 5
expect_result 0 'moved before step 5' "$headrace" move roof --by 0,0.1,0
expect_result 0 '(.*)roof: obstacle, plane at 0,0\.65,0.*' "$headrace" objects
expect_result 0 'step 6, .*' "$headrace" step

# What is wrong, where, and what to do about it
expect 2 'error usage \(--box\): an object needs a shape; give --box, --sphere, --cylinder, --plane or --shape' \
    "$headrace" add x
expect 2 'error usage \(--box\): an object has one shape; .*' "$headrace" add x --sphere 0,0,0,1 --plane 0,0,0,0,1,0
expect 2 'error usage \(--cylinder\): a cylinder has 7 numbers; .*' "$headrace" add x --cylinder 0,0,0,1
expect 2 'error usage \(--plane\): a plane has 4 numbers \(2D\) or 6 \(3D\); .*' "$headrace" add x --plane 0,0,1
expect 6 'error file_error \(nowhere\.json\): No such file or directory; --motion takes JSON, or the name of a file that holds it' \
    "$headrace" add x --sphere 0,0,0,1 --motion nowhere.json
expect 2 'error parse_error \(--motion.*\): .*' "$headrace" add x --sphere 0,0,0,1 --motion '{"angle":'
expect 2 'error invalid_params \(params\.object\.motion\.angel\): .*did you mean "angle"\?.*' \
    "$headrace" add x --sphere 0,0,0,1 --motion '{"angel": "t"}'
expect 2 'error invalid_params \(params\.object\.motion\.displacement\[0\]\): .*Unexpected token "q".*' \
    "$headrace" add x --sphere 0,0,0,1 --motion '{"displacement": ["q", 0, 0]}'
expect 2 'error invalid_params \(params\.object\.shape\): must be a box, a sphere, a cylinder or a plane; give each part an object of its own; .*' \
    "$headrace" add x --shape '{"difference": {"of": [{"box": {"min": [0,0,0], "max": [1,1,1]}}, {"sphere": {"center": [0,0,0], "radius": 1}}]}}'
expect 5 'error limit_exceeded \(params\.object\): walls need more than 20 million dummy particles.*' \
    "$headrace" add x --box=-1e4,-1e4,-1e4,1e4,-0.4,1e4 --motion '{"displacement": [0, "0.01*t", 0]}'
expect_result 0 'step 7, .*' "$headrace" step # the run goes on

# Probes of a whole run as CSV: those of the scene, and others
expect_result 0 '6 frames, 0 gaps, out/flat\.mcap.out/flat_probe_bed\.csv.out/flat_probe_load\.csv' \
    "$headrace" run flat.json --until 0.05 --out out --format '' --threads 1 \
    --probe 'bed={"pressure": {"point": [0.2, 0]}}' --probe 'load={"kind": {"force": {"object": "tank"}}, "every_steps": 1}'
[ "$(head -n 1 out/flat_probe_load.csv)" = 'time [s],fx [N/m],fy [N/m],tz [N]' ] || fail "$(cat out/flat_probe_load.csv)"
[ "$(wc -l <out/flat_probe_bed.csv)" = 7 ] || fail "not a sample every 0.01 s: $(cat out/flat_probe_bed.csv)"
# 1000 kg/m^3 0.3 m 9.81 m/s^2 = 2943 Pa on the bed, to a tenth: the water is 6 particles deep
awk -F, 'NR > 1 && ($2 < 0.9 * 2943 || $2 > 1.1 * 2943) { bad = 1 } END { exit bad }' out/flat_probe_bed.csv ||
    fail "$(cat out/flat_probe_bed.csv)"
/usr/bin/python3 -c 'import json, sys
s = json.load(open("flat.json")); s["name"] = "own"; s["probes"] = [{"name": "tip", "kind": {"front": {}}}]
json.dump(s, open("own.json", "w"))'
"$headrace" --json run own.json --until 0.02 --out own --format '' --probes --threads 1 >own.out 2>notes || fail "$(cat notes)"
grep -q '"own/own_probe_tip.csv"' own.out && [ -s own/own_probe_tip.csv ] || fail "$(cat own.out)"
# which may end the run
cat >collapse.json <<'JSON'
{"headrace_scene": 1, "name": "collapse", "dimensions": 2, "model": "wcsph", "spacing": 0.05,
 "domain": {"min": [-0.5, -0.5], "max": [2, 2]},
 "fluids": [{"name": "water", "hydrostatic": true, "shape": {"box": {"min": [0, 0], "max": [0.4, 0.4]}}}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [1, 1]}}}]}
JSON
expect 0 "(.*)probe tip is 0\.5$number m, above 0\.5 m: step .*" "$headrace" run collapse.json --until 'tip>0.5' --out tip \
    --format '' --threads 1 --probe 'tip={"kind": {"front": {}}, "every_steps": 1}'
# refused before anything is simulated
expect 2 '(.*)error usage \(--probes\): the scene has no probes; add one here: --probe .*' \
    "$headrace" run flat.json --until 0.02 --out early --probes
expect 2 'error usage \(--probe\): no NAME=JSON in "tip"; .*' "$headrace" run flat.json --out early --probe tip
expect 2 'error invalid_params \(--probe tip\.kind\.frnt\): did you mean "front"\?' "$headrace" run flat.json --out early --probe 'tip={"frnt": {}}'
expect 4 '(.*)error object_not_found \(--probe f\.kind\.force\.object\): did you mean "tank"\?' \
    "$headrace" run flat.json --out early --probe 'f={"force": {"object": "tnak"}}'
expect 5 '(.*)error probe_exists \(--probe tip\.name\): .*' "$headrace" run own.json --out early --probe 'tip={"front": {}}'
[ ! -e early ] || fail "a run that was refused left files"

# The help names every shape
for option in --box --sphere --cylinder --plane --shape --motion --surface-velocity --slip; do
    "$headrace" add --help | grep -q -- "$option" || fail "add --help does not tell of $option"
done
echo "walls of every shape, probes as CSV"
