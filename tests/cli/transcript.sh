#!/usr/bin/env bash
# The session that README.md shows: its commands are run as they stand there, and must print what stands there. Steps,
# times and ports may have other values.
# usage: transcript.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"

# The fenced block that starts the server.
session() {
    awk '/^```/ { if (inside && block ~ /\$ headraced &\n/) printf "%s", block; inside = !inside; block = ""; next }
         inside { block = block $0 "\n" }' "$root/README.md"
}

# pattern_of TEXT: an extended regular expression for it.
pattern_of() {
    sed -E -e 's/[][\.*^$+?(){}|]/\\&/g' \
        -e 's/((^|[ ;])(t|step|events|frames|data) |:)[0-9][0-9,]*(\\\.[0-9]+)?/\1[0-9][0-9,]*(\\.[0-9]+)?/g' <<<"$1"
}

# The README's words mean the programs of this build, a Python with pyzmq and the repository's scripts.
python=$(find_python)
mkdir "$work/bin"
ln -s "$headrace" "$work/bin/headrace"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$(command -v "${python:-false}")" >"$work/bin/python3"
chmod +x "$work/bin/python3"
ln -s "$root/client" "$work/client"
cd "$work" || exit 1

# check COMMAND OUTPUT: OUTPUT is what the README shows, an error with its exit status at the end; none: nothing said.
skipped=
check() {
    local command=$1 output=$2 status=0
    if [ "$command" = 'headraced &' ]; then # elsewhere the first server of a machine, here on free ports
        start_server
        [[ $ready_line =~ ^$(pattern_of "$output")$ ]] || fail "the ready line is: $ready_line"
        return
    fi
    if [[ $command == python3\ * && -z $python ]]; then
        echo "no Python with pyzmq here, so not tried: $command" >&2
        skipped=yes
        return
    fi
    if [[ $output =~ ^(.*[^\ ])\ +\[exit\ ([0-9]+)\]$ ]]; then
        status=${BASH_REMATCH[2]}
        expect "$status" "$(pattern_of "${BASH_REMATCH[1]}")" env PATH="$work/bin:$PATH" bash -c "$command"
    else
        expect_result 0 "$([ -n "$output" ] && pattern_of "$output" || echo '.*')" \
            env PATH="$work/bin:$PATH" bash -c "$command"
    fi
    commands=$((commands + 1))
}

commands=0
command=
shown=
while IFS= read -r line <&4; do
    if [[ $line == '$ '* ]]; then
        [ -z "$command" ] || check "$command" "$shown"
        command=${line#'$ '}
        shown=
    else
        shown+=${shown:+$'\n'}$line
    fi
done 4< <(session)
[ -n "$command" ] || fail "README.md shows no session"
check "$command" "$shown"
[ "$commands" -ge 6 ] || fail "the session in README.md has only $commands commands for the client"

# What it left behind.
[ -s wave/wave.pvd ] || fail "wave/wave.pvd is missing"
[ "$(find wave -name 'wave_[0-9]*.vtp' | wc -l)" -eq 301 ] || fail "not every frame became a .vtp file"
[ "$(find wave -name 'wave_[0-9]*.png' | wc -l)" -eq 301 ] || fail "not every frame became a picture"
expect 0 '.*complete, 301 frames, 0 gaps, t .*' "$headrace" info wave.mcap

expect 0 'the server ends' "$headrace" shutdown
wait "$server_pid" || fail "the server ended with $?"
server_pid=
[ -z "$skipped" ] || exit 77
echo "the transcript holds"
