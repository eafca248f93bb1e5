#!/usr/bin/env bash
# Each subcommand does what it is for, on a server of its own. Two recordings, by client and by server, and the files
# converted from one of them stay in RESULTS/commands for other programs' readers.
# usage: commands.sh HEADRACED HEADRACE ROOT [RESULTS]
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
results=${4:-}
number='[0-9][0-9,]*(\.[0-9]+)?(e-[0-9]+)?'

# expect_json EXPRESSION command...: its standard output is JSON `r`, of which the Python expression holds.
expect_json() {
    local expression=$1
    shift
    "$@" >"$work/reply.json" 2>"$work/notes" || fail "\`$*\` ended with $?: $(cat "$work/notes")"
    /usr/bin/python3 -c "import json, sys; r = json.load(open(sys.argv[1])); sys.exit(not ($expression))" \
        "$work/reply.json" || fail "\`$*\`: not $expression: $(cat "$work/reply.json")"
}

# expect_files COUNT GLOB FOLDER: so many files that are not empty.
expect_files() {
    local found
    found=$(find "$3" -name "$2" -type f -size +0 | wc -l)
    [ "$found" -eq "$1" ] || fail "$3 has $found files $2 instead of $1: $(ls "$3")"
}

start_server --json
cd "$work" || exit 1
cat >own.json <<'JSON'
{"headrace_scene": 1, "name": "own", "dimensions": 2, "model": "thesis", "spacing": 0.02,
 "domain": {"min": [-0.1, -0.1], "max": [0.5, 0.5]},
 "fluids": [{"name": "block", "shape": {"box": {"min": [0.05, 0.05], "max": [0.25, 0.25]}}}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [0.4, 0.4]}}}]}
JSON

# Scenes
expect 0 'empty: no scene is loaded' "$headrace" status
expect_result 0 '(.*)dam_break  \(3D, 3,000 particles\).*dam_break_2d  \(2D, .*' "$headrace" scenes
expect_json '"bowl" in [s["name"] for s in r["scenes"]]' "$headrace" --json scenes
expect_result 0 "bowl: 2,197 particles, dt 0\.01 s, idle; objects: bowl.*density: .*pressure: .*" "$headrace" plan bowl
expect_json 'any(s["stage"] == "surface_tension" and not s["active"] for s in r)' \
    "$headrace" --json plan bowl --set surface_tension=0
expect_result 0 "own: 100 particles, dt $number s, idle; objects: tank" "$headrace" load own.json
expect_json 'r["scene"] == "bowl" and r["particles"] == 2197' "$headrace" --json load bowl
expect_result 0 'bowl: 2,197 particles, .*' "$headrace" load bowl --set viscosity=4

# Steps and state
expect_result 0 'step 1, t 0\.01 s' "$headrace" step
expect_json 'r["state"] == "finished" and r["step"] == 4' "$headrace" --json step 3
expect_result 0 'bowl \(thesis\): idle, step 4, t 0\.04 s.*2,197 particles, dt 0\.01 s.*max speed .*' "$headrace" status
expect_result 0 '.*state hash [0-9a-f]{16} at step 4' "$headrace" status --hash
expect_json 'r["step"] == 4 and r["state"] == "idle"' "$headrace" status --json

# Parameters
expect_result 0 'viscosity = 4 Pa s \(default 3\.5\): .*' "$headrace" get viscosity
expect_result 0 'gravity = 0,-9\.82,0 m/s\^2.*time_step = .*' "$headrace" get
expect_result 0 'before step 4: viscosity 4 -> 5' "$headrace" set viscosity=5
expect_result 0 'before step 4: gravity 0,-9\.82,0 -> 0,-9\.7,0, viscosity 5 -> 6' \
    "$headrace" set viscosity=6 gravity=0,-9.7,0
expect_json '{p["name"]: p["value"] for p in r["parameters"]} == {"viscosity": 6}' "$headrace" --json get viscosity

# Objects
expect_result 0 'added before step 4' "$headrace" add block --box 0.3,0.3,0.3,0.31,0.31,0.31
expect_result 0 'added before step 4' "$headrace" add ball --sphere 0,0,0,0.01
expect_result 0 'moved before step 4' "$headrace" move ball --to 0.1,0,0
expect_result 0 'moved before step 4' "$headrace" move ball --by 0,0,0.1
expect_result 0 '(.*)block: obstacle, box 0\.3,0\.3,0\.3 to 0\.31,0\.31,0\.31.ball: obstacle, sphere at 0\.1,0,0\.1, radius 0\.01' \
    "$headrace" objects
expect_result 0 'removed before step 4' "$headrace" remove ball
expect_json '[o["name"] for o in r["objects"]] == ["bowl", "block"]' "$headrace" --json objects
expect_result 0 'bowl: 2,197 particles, .* objects: bowl' "$headrace" reset
expect_result 0 'viscosity = 4 .*' "$headrace" get viscosity

# Runs
expect_result 0 'job 3 running: step [0-9]+, t .*' "$headrace" resume --no-wait
expect_result 0 "paused at step $number, t $number s" "$headrace" pause
expect_result 0 '(.*)job 3: paused.*' "$headrace" status
expect_result 0 "job 3 running: step $number, t $number s" "$headrace" resume
expect_result 0 "cancelled at step $number, t $number s" "$headrace" cancel
expect_result 0 'bowl: .*' "$headrace" reset
expect_result 0 'done: step 200, t 2 s' "$headrace" resume --until 2
expect_result 0 'done: step 210, t 2\.1 s' "$headrace" resume --until +0.1
expect_result 0 'done: step 215, t 2\.15 s' "$headrace" resume --until step=215
expect_json 'r["state"] == "finished" and r["step"] == 220' "$headrace" --json resume --until steps=5
expect_result 0 '#[0-9]+  step 1, t 0\.01 s  job\.ended  .*job 3 cancelled.*step 220, t 2\.2 s  job.ended .*' \
    "$headrace" events --type job.ended
"$headrace" --json events >events.txt || fail "events --json ended with $?"
/usr/bin/python3 -c 'import json; assert {"scene.loaded", "object.added"} <= {json.loads(l)["type"] for l in open("events.txt")}' ||
    fail "events: $(cat events.txt)"
expect_json 'r["step"] == 220' "$headrace" call sim.status
expect_json 'r["steps"] == 1' "$headrace" call sim.step '{"steps": 1}'

# Recordings
expect_result 0 '11 frames, 0 gaps' "$headrace" record idle.mcap --for 0.1 --fps 100
expect_result 0 '(.*): idle, step 231, .*' "$headrace" status
expect_json 'r["frames"] == 3 and r["gaps"] == 0' \
    "$headrace" --json record few.mcap --for 0.1 --every 5 --fields id,position --precision f8
expect_result 0 '11 frames, 0 gaps, there\.mcap at the server' "$headrace" record there.mcap --for 0.1 --at-server
[ -s data/there.mcap ] || fail "the server left no recording: $(ls data)"
expect_result 0 'job [0-9]+ running: .*' "$headrace" resume --no-wait
expect_result 0 "[0-9]+ frames, 0 gaps" "$headrace" record running.mcap --for 0.1
expect_result 0 '(.*): running, .*' "$headrace" status # it was not the recording's
expect_result 0 'cancelled .*' "$headrace" cancel
expect_json 'r["complete"] and r["gaps"] == 0 and 9 <= r["frames"] <= 11 and r["last_time"] - r["first_time"] < 0.1 + 1e-6' \
    "$headrace" --json info running.mcap
expect_result 0 'few\.mcap: complete, 3 frames, 0 gaps, t .* s to .* s.scene bowl, 2,197 particles, fields id,position, .*' \
    "$headrace" info few.mcap

# Files for other programs
expect_result 0 '3 files part/idle_\*\.csv, their times in part/idle_frames\.csv' "$headrace" convert idle.mcap \
    --format csv,vtp,png --out part --every 2 --from 2.23 --to 2.27 --field density --range 900:1500 --size 320x240
for ending in csv vtp png; do expect_files 3 "idle_[0-9]*.$ending" part; done
for file in idle.pvd idle_frames.csv idle_objects_000000.vtp idle_sheet.png; do expect_files 1 $file part; done
expect_json 'r["frames"] == 11 and len(r["summaries"]) == 2' \
    "$headrace" --json convert idle.mcap --format vtp,csv --out whole
expect_result 0 '(.*)idle_sheet\.png' "$headrace" convert idle.mcap --format png --out sheet --sheet-only --sheet 4
expect_files 1 '*.png' sheet

# Probes: the preset has none, a scene of one's own may
expect_result 0 'no probes' "$headrace" probes
cat >measured.json <<'JSON'
{"headrace_scene": 1, "name": "measured", "dimensions": 2, "model": "thesis", "spacing": 0.02,
 "domain": {"min": [-0.1, -0.1], "max": [0.5, 0.5]},
 "fluids": [{"name": "block", "shape": {"box": {"min": [0, 0], "max": [0.2, 0.2]}}}],
 "objects": [{"name": "tank", "role": "container", "shape": {"box": {"min": [0, 0], "max": [0.4, 0.4]}}}],
 "probes": [{"name": "tip", "kind": {"front": {}}, "every_steps": 1},
            {"name": "gauge", "kind": {"level": {"from": [0.1, 0], "to": [0.1, 0.4]}}, "interval": 0.02}]}
JSON
expect_result 0 'measured: .*' "$headrace" load measured.json
expect_result 0 "tip  t 0 s: front 0\.2 m  \(1 sample\).gauge  t 0 s: level $number m  \(1 sample\)" "$headrace" probes
expect_result 0 "probe tip is $number m, above 0\.22 m: step .*" "$headrace" resume --until 'tip>0.22'
expect_json 'r["probes"][0]["latest"][1] > 0.22' "$headrace" --json probes
expect_result 0 'time \[s\],level \[m\].0,.*' "$headrace" probes gauge
expect_result 0 "$number samples in tip\.csv" "$headrace" probes tip --csv tip.csv
head -n 1 tip.csv | grep -qx 'time \[s\],front \[m\]' || fail "tip.csv begins with $(head -n 1 tip.csv)"
expect 4 'error probe_not_found \(params\.name\): did you mean "tip"\?' "$headrace" probes tipp
expect 4 'error particle_not_found \(params\.id\): no particle 100; .*' "$headrace" inspect 100
expect_result 0 "$number frames, 0 gaps" "$headrace" record measured.mcap --for 0.1
expect_result 0 'probes/measured_probe_gauge\.csv.probes/measured_probe_tip\.csv' \
    "$headrace" convert measured.mcap --probes --out probes
[ "$(wc -l <probes/measured_probe_tip.csv)" -gt 5 ] || fail "the recording has too few samples: $(cat probes/*)"
expect 6 'error file_error \(--probes\): no samples .*' "$headrace" convert idle.mcap --probes --out none

# Without this server
expect_result 0 '6 frames, 0 gaps, local/own\.mcap.open local/own\.pvd in ParaView.6 files local/own_\*\.csv.*' \
    "$headrace" run own.json --until 0.05 --out local --format vtp,csv
expect_files 6 'own_[0-9]*.vtp' local
expect_files 6 'own_[0-9]*.csv' local
expect_json 'r["frames"] == 3' "$headrace" --json run bowl --steps 2 --set viscosity=5 --format ''
expect_files 1 'bowl.mcap' bowl
expect_json 'r["frames"] == 5' "$headrace" --json run dam_break --remove panel@0.02 --until +0.02 --out removal \
    --fields id,position
expect_files 1 'dam_break.pvd' removal
expect_files 2 'dam_break_objects_*.vtp' removal

expect_result 0 'the server ends' "$headrace" shutdown
wait "$server_pid" || fail "the server ended with $?"
server_pid=

if [ -n "$results" ]; then
    rm -rf "$results/commands"
    mkdir -p "$results/commands"
    cp -r idle.mcap data/there.mcap whole "$results/commands"
fi
echo "every command does what it is for"
