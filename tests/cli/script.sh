#!/usr/bin/env bash
# `headrace script`: what it does, where it stops, and with which status. The examples of client/examples are run too.
# usage: script.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
cd "$work" || exit 1
unset HEADRACE_SERVER

# The examples as their own first lines tell: `headrace script client/examples/...`, on private servers.
mkdir bin
ln -s "$headrace" bin/headrace
ln -s "$root/client" client
examples=0
for file in "$root"/client/examples/*.jsonl; do
    command=$(sed -n 's/^# *\(headrace script .*\)$/\1/p' "$file")
    [ -n "$command" ] || fail "$file does not say how it is run"
    expect_result 0 '1?[0-9] scene\.load: \{.*\}' env PATH="$work/bin:$PATH" bash -c "$command"
    expect 0 '.*: [0-9]+ lines to do, nothing wrong with them' env PATH="$work/bin:$PATH" bash -c "$command --dry-run"
    examples=$((examples + 1))
done
[ $examples -ge 3 ] || fail "only $examples examples"
expect 0 'wave\.mcap: complete, 51 frames, 0 gaps, .*' "$headrace" info wave.mcap

# Times have the digits that they mean; all of them with --json, for programs. 30 steps of 0.01 s add up to a bit more.
printf '%s\n' '{"method": "scene.load", "params": {"scene": "bowl"}}' '{"method": "sim.run", "params": {"until": {"steps": 30}, "wait": true}}' >times.jsonl
expect_result 0 '.*2 sim\.run: \{.*"time":0\.3[,}].*' "$headrace" script times.jsonl
expect_result 0 '.*"time":0\.30000000000000[0-9]+[,}].*' "$headrace" --json script times.jsonl

# Types are kept: a number is a number, a string a string, and text goes into text.
cat >types.jsonl <<'JSON'

# scene, steps and file are set outside
{"method": "scene.load", "params": {"scene": "${scene}", "parameters": {"viscosity": "${nu}", "gravity": "${g}"}}}
   {"jsonrpc": "2.0", "id": 7, "method": "sim.step", "params": {"steps": "${n}"}}
{"method": "params.get", "params": {"names": ["viscosity", "gravity"]}}
{"method": "probes.add", "params": {"probe": {"name": "tip_${n}", "kind": {"front": {}}}}}
JSON
set_all=(--set scene=bowl --set nu=4.25 --set 'g=[0, -9.7, 0]' --set n=3)
expect_result 0 '3 scene\.load: .*"particles":2197.*4 sim\.step: .*"step":3,.*"value":4\.25.*"value":\[0\.0,-9\.7,0\.0\].*6 probes.add: \{"step":3.*' \
    "$headrace" script types.jsonl "${set_all[@]}"
expect_result 0 '.*"line":4,"method":"sim\.step","result":\{"job":1,.*' "$headrace" --json script types.jsonl "${set_all[@]}"
expect_result 0 '.*"step":3.*' "$headrace" script - "${set_all[@]}" <types.jsonl
expect 2 'error usage \(types\.jsonl:3\): \$\{scene\} has no value; give it one: --set scene=VALUE' "$headrace" script types.jsonl
expect 2 'error usage \(types\.jsonl:3\): did you mean "nuu"\?' "$headrace" script types.jsonl --set scene=bowl --set nuu=4
expect 2 'error usage \(--set\): no line uses \$\{z\}; .*' "$headrace" script types.jsonl "${set_all[@]}" --set z=1
expect 2 'error usage \(--set\): "z" sets nothing; .*' "$headrace" script types.jsonl --set z
expect 2 'error invalid_params \(types\.jsonl:4: params\.steps\): must be an integer.*' \
    "$headrace" script types.jsonl "${set_all[@]:0:6}" --set 'n="3"'

# What is wrong with a line is told before anything is done: the server of this script sees no command.
start_server --json
refused() { # STATUS PATTERN LINE: the line, second of a script, with and without --dry-run
    printf '{"method": "scene.load", "params": {"scene": "bowl"}}\n%s\n' "$3" >bad.jsonl
    expect "$1" "error $2" "$headrace" script bad.jsonl --dry-run
    expect "$1" "error $2" "$headrace" script bad.jsonl
    expect 0 'empty: no scene is loaded' "$headrace" status
}
refused 2 'parse_error \(bad\.jsonl:2.*' '{"method": '
refused 2 'usage \(bad\.jsonl:2\): not an object; .*' '[1]'
refused 2 'usage \(bad\.jsonl:2: method\): no method; .*' '{}'
refused 2 'usage \(bad\.jsonl:2: parms\): did you mean "params"\?' '{"method": "sim.step", "parms": {}}'
refused 2 'method_not_found \(bad\.jsonl:2: method\): did you mean "sim\.step"\?' '{"method": "sim.stepp"}'
refused 2 'invalid_params \(bad\.jsonl:2: params\.step\): did you mean "steps"\?' '{"method": "sim.step", "params": {"step": 2}}'
refused 2 'invalid_params \(bad\.jsonl:2: params\.steps\): .*' '{"method": "sim.step", "params": {"steps": 0}}'
refused 2 'wrong_socket \(bad\.jsonl:2: method\): .*' '{"method": "frame.get"}'
refused 2 'usage \(bad\.jsonl:2: wait\): "soon" is no end of a run; .*' '{"wait": "soon"}'
refused 2 'usage \(bad\.jsonl:2: wait\): neither .*' '{"wait": {}}'
refused 2 'usage \(bad\.jsonl:2: wait\.timeout\): must be a number above 0; .*' '{"wait": {"event": "job.ended", "timeout": 0}}'
refused 6 'file_error \(bad\.jsonl:2: .*missing\.json\): .*' '{"method": "scene.load", "params": {"scene": "missing.json"}}'
expect 2 'error usage \(empty\.jsonl\): the script has no commands; .*' bash -c ': >empty.jsonl; "$1" script empty.jsonl' - "$headrace"
expect 6 'error file_error \(nowhere\.jsonl\): .*' "$headrace" script nowhere.jsonl

# The first error of the server ends it: the line before is done, the one behind is not.
cat >stops.jsonl <<'JSON'
{"method": "scene.load", "params": {"scene": "bowl"}}
{"method": "sim.step", "params": {"steps": 2}}
{"method": "objects.remove", "params": {"name": "bowll"}}
{"method": "sim.step", "params": {"steps": 5}}
JSON
expect 4 '1 scene\.load: .*2 sim\.step: .*error object_not_found \(stops\.jsonl:3: params\.name\): did you mean "bowl"\?' \
    "$headrace" script stops.jsonl
expect 0 '.*step 2, t 0\.02 s.*' "$headrace" status

# Waits: with nothing running they run to their end, beside a run they watch it.
cat >waits.jsonl <<'JSON'
{"method": "scene.load", "params": {"scene": "bowl"}}
{"method": "probes.add", "params": {"probe": {"name": "low", "kind": {"front": {"direction": [0, -1, 0]}}, "every_steps": 1}}}
{"wait": "0.1"}
{"wait": "+0.1"}
{"wait": "step=30"}
{"wait": "steps=10"}
{"method": "sim.run"}
{"wait": "steps=20"}
{"wait": {"event": "job.started"}}
{"wait": "+0.1"}
{"wait": "low>-100"}
{"method": "sim.cancel"}
{"wait": {"event": "job.ended", "timeout": 60}}
JSON
expect_result 0 '.*3 wait: \{"step":10,.*4 wait: \{"step":20,.*5 wait: \{"step":30,.*6 wait: \{"step":40,.*12 sim\.cancel: .*13 wait: .*' \
    "$headrace" script waits.jsonl
expect 0 '.*idle, step ([7-9][0-9]|[0-9,]{3,}), .*' "$headrace" status
# Events are found in their order, also those that have come meanwhile.
printf '%s\n' '{"method": "objects.add", "params": {"object": {"name": "ball", "shape": {"sphere": {"center": [0, 0, 0], "radius": 0.01}}}}}' \
    '{"method": "objects.remove", "params": {"name": "ball"}}' '{"method": "sim.step"}' '{"wait": {"event": "object.added"}}' \
    '{"wait": {"event": "object.removed", "timeout": 60}}' '{"wait": {"event": "job.ended", "timeout": 60}}' >events.jsonl
expect_result 0 '.*6 wait: .*' "$headrace" script events.jsonl
printf '%s\n' '{"method": "sim.step"}' '{"wait": {"event": "job.ended"}}' '{"wait": {"event": "job.started", "timeout": 0.1}}' >events.jsonl
expect 8 '(.*)error timed_out \(events\.jsonl:3: .*' "$headrace" script events.jsonl
wait_fails() { # STATUS PATTERN LINES...: bad.jsonl of the lines, after a load
    local status=$1 pattern=$2
    shift 2
    printf '%s\n' '{"method": "scene.load", "params": {"scene": "bowl"}}' "$@" >bad.jsonl
    expect "$status" "(.*)error $pattern" "$headrace" script bad.jsonl
}
wait_fails 8 'timed_out \(bad\.jsonl:2: wait\.timeout\): no event job\.ended within 0\.1 s' '{"wait": {"event": "job.ended", "timeout": 0.1}}'
wait_fails 8 'timed_out \(bad\.jsonl:2\): .*' '{"wait": {"until": "at-rest", "timeout": 0.05}}'
wait_fails 5 'wrong_state \(bad\.jsonl:3\): the run that was under way has ended before: done: step 200.*' \
    '{"method": "sim.run", "params": {"until": {"step": 200}}}' '{"wait": "step=300"}'
wait_fails 4 'probe_not_found \(bad\.jsonl:3: wait\): .*' '{"method": "sim.run"}' '{"wait": "tip>1"}'
expect 0 '.*' "$headrace" cancel

# Scene files are sought from the script's folder, wherever it is run from; the run that faults says so.
mkdir sub
cat >sub/flight.json <<'JSON'
{"headrace_scene": 1, "name": "flight", "dimensions": 3, "model": "thesis", "spacing": 0.1,
 "parameters": {"gravity": [0, 0, 0]},
 "domain": {"min": [-1, -1, -1], "max": [1, 1, 1]},
 "fluids": [{"name": "drop", "shape": {"box": {"min": [0, 0, 0], "max": [0.2, 0.2, 0.2]}}, "velocity": [10, 0, 0]}]}
JSON
printf '%s\n' '{"method": "scene.load", "params": {"scene": "flight.json"}}' '{"wait": "10"}' >sub/flight.jsonl
expect 7 '.*error faulted \(sub/flight\.jsonl:2\): left_domain: .*' "$headrace" script sub/flight.jsonl
expect 3 'error connection_failed: .*' "$headrace" --server "ipc://$work/nobody" script sub/flight.jsonl
echo "scripts do what they say"
