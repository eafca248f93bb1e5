# What the scripts of this folder share. Sourced with: headraced, headrace, repository root.
set -uo pipefail

headraced=$(realpath "$1")
headrace=$(realpath "$2")
root=$(realpath "$3")
export HEADRACE_SERVER_BINARY=$headraced

work=$(mktemp -d)
server_pid=
client_pid=
end_all() {
    for pid in $client_pid $server_pid; do
        kill "$pid" 2>/dev/null
        wait "$pid" 2>/dev/null
    done
    rm -rf "$work"
}
trap end_all EXIT

fail() {
    echo "FAILED: $*" >&2
    exit 1
}

# start_server: on free ports; sets HEADRACE_SERVER. The ready line comes through a fifo, so nothing is guessed.
start_server() {
    mkdir -p "$work/data"
    mkfifo "$work/ready"
    "$headraced" --bind 'tcp://127.0.0.1:*' --data "$work/data" "$@" >"$work/ready" 2>"$work/server.log" &
    server_pid=$!
    exec 3<"$work/ready"
    read -r -t 60 ready_line <&3 || fail "the server does not get ready: $(cat "$work/server.log")"
    HEADRACE_SERVER=$(grep -oE 'tcp://[0-9.]+:[0-9]+' <<<"$ready_line" | head -n 1)
    export HEADRACE_SERVER
}

# expect STATUS PATTERN command...: runs it; its output, both streams, must have the status and match the extended
# regular expression as a whole, line breaks being ordinary characters.
expect() {
    local status=$1 pattern=$2 got
    shift 2
    output=$("$@" 2>&1)
    got=$?
    [ "$got" = "$status" ] || fail "\`$*\` ended with $got instead of $status: $output"
    [[ $output =~ ^$pattern$ ]] || fail "\`$*\` printed: $output"$'\n'"expected: $pattern"
}

# Like expect, for standard output alone.
expect_result() {
    local status=$1 pattern=$2 got
    shift 2
    output=$("$@" 2>"$work/notes")
    got=$?
    [ "$got" = "$status" ] || fail "\`$*\` ended with $got instead of $status: $output $(cat "$work/notes")"
    [[ $output =~ ^$pattern$ ]] || fail "\`$*\` printed: $output"$'\n'"expected: $pattern"
}

# wait_for SECONDS command...: until the command succeeds.
wait_for() {
    local end=$((SECONDS + $1))
    shift
    until "$@" >/dev/null 2>&1; do
        [ "$SECONDS" -lt "$end" ] || return 1
        sleep 0.05
    done
}

is_larger() { [ -f "$1" ] && [ "$(stat -c %s "$1")" -gt "$2" ]; }

# A Python with pyzmq, if there is one.
find_python() {
    local candidate
    for candidate in python3 /usr/bin/python3; do
        if "$candidate" -c 'import zmq' 2>/dev/null; then
            echo "$candidate"
            return
        fi
    done
}
