#!/usr/bin/env bash
# `headrace converge`: error bars of a scene's probes, and what it refuses.
# usage: converge.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
cd "$work" || exit 1
number='[0-9][0-9,]*(\.[0-9]+)?(e-[0-9]+)?'

cat >still.json <<'JSON'
{"headrace_scene": 1, "name": "still", "dimensions": 2, "model": "wcsph", "spacing": 0.1,
 "domain": {"min": [-0.5, -0.5], "max": [1.5, 1.8]},
 "fluids": [{"name": "water", "shape": {"box": {"min": [0, 0], "max": [1, 1]}}, "hydrostatic": true}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [1, 1.5]}}}],
 "probes": [{"name": "bed", "kind": {"pressure": {"point": [0.5, 0]}}, "interval": 0.01},
            {"name": "line", "kind": {"profile": {"from": [0.5, 0], "to": [0.5, 0.5], "points": 3}}}]}
JSON
cat >soft.json <<'JSON'
{"headrace_scene": 1, "name": "soft", "dimensions": 2, "model": "thesis", "spacing": 0.02,
 "domain": {"min": [-0.1, -0.1], "max": [0.5, 0.5]},
 "fluids": [{"name": "block", "shape": {"box": {"min": [0, 0], "max": [0.2, 0.2]}}}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [0.4, 0.4]}}}]}
JSON
front='tip={"front": {}}'

# The table: four runs, whole cells at each spacing, a line for each probe
expect_result 0 "still until t 0\.1 s; .*coarse +0\.1 +$number +100 .*middle +0\.071429 .* 196 .*fine +0\.05 .* 400 .*faster sound +0\.071429 .* 196 .*bed\.pressure +Pa +9[0-9.]+ .*line\.profile +Pa .*error bars: of the fine run" \
    "$headrace" converge still.json --until 0.1 --csv still.csv --threads 1
[ "$(grep -c '^bed,pressure,,Pa,' still.csv)" = 1 ] && [ "$(grep -c '^line,' still.csv)" = 4 ] ||
    fail "still.csv: $(cat still.csv)"
grep -q 'run 4 of 4, spacing 0\.0714286 m, sound speed .*: 196 particles, ' "$work/notes" || fail "notes: $(cat "$work/notes")"

# JSON: the water's weight rests on the bed (5 %: the water is 20 particles deep); the second speed is twice the first
"$headrace" --json converge still.json --until 0.1 --of mean --threads 1 >still.out 2>notes || fail "$(cat notes)"
/usr/bin/python3 - still.out <<'PYTHON' || fail "$(cat still.out)"
import json, sys
study = json.load(open(sys.argv[1]))
runs, bed = study["runs"], study["results"][0]
assert [r["name"] for r in runs] == ["coarse", "middle", "fine", "faster sound"]
assert abs(runs[3]["sound_speed"] / runs[1]["sound_speed"] - 2) < 1e-12
assert runs[0]["sound_speed"] == runs[2]["sound_speed"] > 0 and all(r["steps"] > 0 for r in runs)
assert bed["covered"] == 1 and abs(bed["values"][2] - 1000 * 9.81) < 0.05 * 9810
assert abs(bed["total_error"] - bed["resolution_error"] - bed["compressibility_error"]) < 1e-9
PYTHON

# The thesis's model: its sound speed is that of its stiffness, and its front stands half a spacing past the wall
expect_result 0 "(.*)middle +0\.014286 +1\.7321 .*faster sound +0\.014286 +3\.4641 .*tip\.front +m +0\.41 +0\.40714 +0\.405 .* 1 +0\.4 .*" \
    "$headrace" converge soft.json --until 0.3 --of last --probe "$front" --threads 1

# Refusals, each before anything runs or naming the run
expect 2 'error usage \(scene\.probes\): .*--probe .*' "$headrace" converge soft.json --until 1
expect 2 'error usage \(scene\.parameters\): fixed for one spacing: support_radius, time_step; .*' \
    "$headrace" converge soft.json --until 1 --probe "$front" --set time_step=0.01 --set support_radius=0.05
expect 2 'error usage \(--until\): .*' "$headrace" converge soft.json --until at-rest --probe "$front"
expect 2 'error usage \(--probe\): .*NAME=JSON.*' "$headrace" converge soft.json --until 1 --probe tip
expect 2 'error .*\(--probe tip.*\).*' "$headrace" converge soft.json --until 1 --probe 'tip={"frnt": {}}'
expect 4 'error scene_not_found \(SCENE\): did you mean "bowl"\?' "$headrace" converge bowll --until 1
cat >flight.json <<'JSON'
{"headrace_scene": 1, "name": "flight", "dimensions": 2, "model": "thesis", "spacing": 0.1,
 "domain": {"min": [-1, -1], "max": [1, 1]},
 "fluids": [{"name": "drop", "shape": {"box": {"min": [0, 0], "max": [0.2, 0.2]}}, "velocity": [10, 0]}]}
JSON
expect 7 'error faulted: run 1 of 4, spacing 0\.1 m: left_domain: .*' \
    "$headrace" converge flight.json --until 5 --probe "$front"
echo "converge tells error bars and refuses what has none"
