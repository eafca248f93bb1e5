#!/usr/bin/env bash
# Each exit status that `headrace --help` documents, with its line on standard error.
# usage: errors.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
start_server --json
cd "$work" || exit 1

# 2: the command line, or the request
expect 2 'error usage: .*' "$headrace" nonsense
expect 2 'error usage \(viscosity\): .*name=value.*' "$headrace" set viscosity
expect 2 'error usage \(--until\): .*' "$headrace" resume --until whenever
expect 2 'error method_not_found .*' "$headrace" call sim.stepp
expect 2 'error parse_error.*' "$headrace" call sim.step '{"steps":'
expect 2 'error invalid_params \(params.steps\): .*' "$headrace" call sim.step '{"steps":"many"}'
# before anything is simulated: nothing is left behind
expect 2 'error usage \(--format\): did you mean "vtp"\?' "$headrace" run bowl --until 0.01 --out early --format vpt
expect 2 'error usage \(velocty\): did you mean "velocity"\?' "$headrace" run bowl --until 0.01 --out early --fields velocty
expect 2 'error usage \(--fields\): vtp files need the field position; .*' \
    "$headrace" run bowl --until 0.01 --out early --fields id,density
expect 2 'error usage \(--fields\): png files need the field velocity; .*' \
    "$headrace" run bowl --until 0.01 --out early --format csv,png --fields id,position
cat >blind.json <<'JSON'
{"headrace_scene": 1, "name": "blind", "dimensions": 2, "model": "thesis", "spacing": 0.1,
 "domain": {"min": [-1, -1], "max": [1, 1]}, "output": {"interval": 0.01, "fields": ["id", "velocity"]},
 "fluids": [{"name": "drop", "shape": {"box": {"min": [0, 0], "max": [0.2, 0.2]}}}]}
JSON
expect 2 '(.*)error usage \(--fields\): vtp files need the field position; .*' \
    "$headrace" run blind.json --until 0.01 --out early
[ ! -e early ] || fail "a run that was refused left files"
# 3: nobody answers
expect 3 'error connection_failed: .*; start one: headraced &' "$headrace" --server "ipc://$work/nobody" status
# 4: no such thing
expect 4 'error scene_not_found \(params.scene\): did you mean "bowl"\?' "$headrace" load bowll
# 5: not in this state
expect 5 'error wrong_state.*' "$headrace" step
expect 0 '.*' "$headrace" load bowl
expect 4 'error object_not_found \(params.name\): did you mean "bowl"\?' "$headrace" remove bowll
expect 4 'error parameter_not_found .*did you mean "viscosity"\?' "$headrace" get viscosty
expect 5 'error object_exists .*' "$headrace" add bowl --sphere 0,0,0,0.1
# 6: files
expect 6 'error file_error \(.*missing.mcap\): .*' "$headrace" info missing.mcap
expect 6 'error file_error \(missing.json\): .*' "$headrace" load missing.json
expect 6 'error file_error \(.*nowhere/x.mcap\): .*' "$headrace" record nowhere/x.mcap --for 0.1
: >taken.mcap
expect 6 'error file_error \(taken\.mcap\): cannot create the file: File exists; .* --overwrite, .*' \
    "$headrace" record taken.mcap --for 0.1
# 8: the time given has passed, here 0.05 s for a cube that has to fall first
expect 8 'error timed_out: .*; go on with: headrace resume --until at-rest' \
    "$headrace" resume --until at-rest --timeout 0.05
expect 8 'error timed_out: [^;]*' "$headrace" resume --until +10 --timeout 0.05

# 7: fluid that flies out of a domain without walls
cat >flight.json <<'JSON'
{"headrace_scene": 1, "name": "flight", "dimensions": 3, "model": "thesis", "spacing": 0.1,
 "parameters": {"gravity": [0, 0, 0]},
 "domain": {"min": [-1, -1, -1], "max": [1, 1, 1]},
 "fluids": [{"name": "drop", "shape": {"box": {"min": [0, 0, 0], "max": [0.2, 0.2, 0.2]}}, "velocity": [10, 0, 0]}]}
JSON
expect 0 'flight: 8 particles, .*' "$headrace" load flight.json
expect 7 'error faulted: left_domain: particle [0-9]+ .*' "$headrace" resume --until 10
expect 5 'error wrong_state.*' "$headrace" step
for where in '' --at-server; do # no run can come, so recording would never end
    expect 7 'error faulted: left_domain: .*' "$headrace" record never.mcap $where
    expect 7 'error faulted: left_domain: .*' "$headrace" record never.mcap $where --for 1
done
[ ! -e never.mcap ] || fail "a refused recording left a file"
expect 7 '(.*)error faulted: left_domain: .*' "$headrace" run flight.json --until 10 --out "$work/flight"

# 3 and 1: another protocol, and a server that breaks. A stand-in answers.
python=$(find_python)
if [ -z "$python" ]; then
    echo "no Python with pyzmq here: another protocol and a broken server were not tried" >&2
    exit 77
fi
cat >stand_in.py <<'PYTHON'
import json, sys, zmq
socket = zmq.Context().socket(zmq.ROUTER)
socket.bind(sys.argv[1])
protocol = 99
while True:
    peer, text = socket.recv_multipart()
    request = json.loads(text)
    reply = {"jsonrpc": "2.0", "id": request["id"]}
    if request["method"] == "hello":
        reply["result"] = {"program": "headraced", "version": "0", "protocol": protocol, "session": "0" * 16,
                           "data_port": 1, "threads": 1, "soft_message_limit": 1, "hard_message_limit": 1}
        protocol = 1
    else:
        reply["error"] = {"code": -32603, "message": "broken", "data": {"name": "internal_error", "path": "", "hint": "",
                                                                      "retryable": False}}
    socket.send_multipart([peer, json.dumps(reply).encode()])
PYTHON
"$python" stand_in.py "ipc://$work/stand_in" &
client_pid=$!
wait_for 20 test -S "$work/stand_in" || fail "the stand-in does not start"
expect 3 'error protocol_mismatch \(.*\): the server speaks protocol 99, this client 1; .*' \
    "$headrace" --server "ipc://$work/stand_in" status
expect 1 'error internal_error: broken' "$headrace" --server "ipc://$work/stand_in" status
echo "every exit status is as documented"
