#!/usr/bin/env bash
# The session that README.md shows, line by line.
# usage: transcript.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
number='[0-9][0-9,]*(\.[0-9]+)?'

start_server
[[ $ready_line =~ ^control\ tcp://127\.0\.0\.1:[0-9]+\ events\ [0-9]+\ frames\ [0-9]+\ data\ [0-9]+\ \(loopback\ only\)$ ]] ||
    fail "the ready line is: $ready_line"
cd "$work" || exit 1

expect 0 "dam_break: 3,000 particles, dt $number s, idle; objects: tank, panel" "$headrace" load dam_break
expect_result 0 "at rest: step $number, t $number s" "$headrace" resume --until at-rest
expect 4 'error object_not_found \(params.name\): did you mean "panel"\?' "$headrace" remove pannel
expect 0 "removed before step $number" "$headrace" remove panel
expect_result 0 '301 frames, 0 gaps' "$headrace" record wave.mcap --for 3 --fps 100
expect_result 0 'open wave/wave.pvd in ParaView' "$headrace" convert wave.mcap --format vtp,png --out wave/
[ -s wave/wave.pvd ] || fail "wave/wave.pvd is missing"
[ "$(find wave -name '*.vtp' -newer wave.mcap | wc -l)" -ge 301 ] || fail "not every frame became a .vtp file"
[ "$(find wave -name '*.png' -newer wave.mcap | wc -l)" -ge 301 ] || fail "not every frame became a picture"
expect 0 '.*complete, 301 frames, 0 gaps, t .*' "$headrace" info wave.mcap

python=$(find_python)
if [ -n "$python" ]; then
    expect 0 "0\.1\.0 .*'step': [0-9]+.*" "$python" "$root/client/python/first.py"
else
    echo "no Python with pyzmq here: client/python/first.py was not tried"
fi

expect 0 'the server ends' "$headrace" shutdown
wait "$server_pid" || fail "the server ended with $?"
server_pid=
echo "the transcript holds"
