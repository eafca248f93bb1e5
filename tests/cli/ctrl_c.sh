#!/usr/bin/env bash
# Ctrl-C leaves complete files: while recording from a server, and in the middle of `headrace run`.
# usage: ctrl_c.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
enough=300000 # [bytes] of a recording: several frames of the scene `bowl`

# interrupt: ends the client by SIGINT, which must give status 130.
interrupt() {
    kill -INT "$client_pid"
    wait "$client_pid"
    local status=$?
    client_pid=
    [ "$status" = 130 ] || fail "$1 ended with $status instead of 130: $(cat "$work/output")"
}

start_server --json
cd "$work" || exit 1
expect 0 '.*' "$headrace" load bowl
expect 0 'job .*' "$headrace" resume

"$headrace" record live.mcap >"$work/output" 2>&1 &
client_pid=$!
wait_for 60 is_larger live.mcap $enough || fail "nothing is recorded: $(cat "$work/output")"
interrupt record
grep -qE '^[0-9,]+ frames, 0 gaps$' "$work/output" || fail "record printed: $(cat "$work/output")"
expect 0 'live.mcap: complete, [0-9,]+ frames, 0 gaps, .*' "$headrace" info live.mcap
# The run was not ours: it goes on.
expect 0 '.*: running, .*' "$headrace" status
expect 0 'cancelled at .*' "$headrace" cancel

# A run that `record --for` has started ends with it.
"$headrace" record own.mcap --for 1000 >"$work/output" 2>&1 &
client_pid=$!
wait_for 60 is_larger own.mcap $enough || fail "nothing is recorded: $(cat "$work/output")"
interrupt 'record --for'
expect 0 'own.mcap: complete, .*' "$headrace" info own.mcap
expect 0 '.*: idle, .*' "$headrace" status

"$headrace" run bowl --until 1000 --out local >"$work/output" 2>&1 &
client_pid=$!
wait_for 60 is_larger local/bowl.mcap $enough || fail "nothing is recorded: $(cat "$work/output")"
endpoint=$(sed -nE 's/^server ipc:\/\/(.*)/\1/p' "$work/output")
[ -S "$endpoint" ] || fail "the private server is not at '$endpoint'"
# A second client can attach meanwhile.
expect 0 'bowl .*: running, .*' "$headrace" --server "ipc://$endpoint" status
interrupt run
expect 0 'local/bowl.mcap: complete, [0-9,]+ frames, 0 gaps, .*' "$headrace" info local/bowl.mcap
[ ! -e "$(dirname "$endpoint")" ] || fail "the private folder was left behind"
echo "Ctrl-C leaves complete files"
