#!/usr/bin/env bash
# Every example that `headrace help TOPIC` shows is run as it stands there, topic by topic, each in a folder of its own.
# usage: help_topics.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
python=$(find_python)
mkdir "$work/bin"
ln -s "$headrace" "$work/bin/headrace"
printf '#!/bin/sh\nexec "%s" "$@"\n' "$(command -v "${python:-false}")" >"$work/bin/python3"
chmod +x "$work/bin/python3"
skipped=

# run_example TOPIC COMMAND: `[exit N]` at its end is the status it has; `headraced &` a server of the topic's own.
run_example() {
    local topic=$1 command=$2 status=0 got
    if [ "$command" = 'headraced &' ]; then
        start_server
        return
    fi
    if [[ $command == python3\ * && -z $python ]]; then
        skipped=yes
        return
    fi
    if [[ $command =~ ^(.*[^\ ])\ +\[exit\ ([0-9]+)\]$ ]]; then
        command=${BASH_REMATCH[1]}
        status=${BASH_REMATCH[2]}
    fi
    PATH="$work/bin:$PATH" bash -c "$command" >"$work/output" 2>&1 </dev/null
    got=$?
    [ $got -eq $status ] || fail "help $topic: \`$command\` ended with $got instead of $status: $(cat "$work/output")"
    examples=$((examples + 1))
}

# The examples of a text: lines that begin with "    $ ", a here-document with all of its lines.
run_topic() {
    local topic=$1 line command='' ends=''
    while IFS= read -r line <&4; do
        line=${line#    }
        if [ -n "$ends" ]; then
            command+=$'\n'$line
            if [ "$line" = "$ends" ]; then
                ends=
                run_example "$topic" "$command"
            fi
        elif [[ $line == '$ '* ]]; then
            command=${line#'$ '}
            if [[ $command =~ \<\<\'([A-Z]+)\' ]]; then ends=${BASH_REMATCH[1]}; else run_example "$topic" "$command"; fi
        fi
    done 4< <("$headrace" help "$topic")
}

topics=$("$headrace" help | sed -n 's/^  \([a-z]*\) .*/\1/p')
for topic in scenes running probes recording converting scripts remote python accuracy; do
    grep -qx "$topic" <<<"$topics" || fail "no topic $topic in: $topics"
done
for topic in $topics; do
    examples=0
    mkdir -p "$work/data"
    cd "$work/data" || exit 1
    unset HEADRACE_SERVER
    run_topic "$topic"
    [ $examples -ge 2 ] || fail "help $topic has only $examples examples"
    if [ -n "$server_pid" ]; then
        expect 0 'the server ends' "$headrace" shutdown
        wait "$server_pid" || fail "the server of topic $topic ended with $?"
        server_pid=
    fi
    cd "$work" || exit 1
    rm -rf data ready
done

expect 0 '.*compute some steps.*' "$headrace" help step
expect 2 'error usage \(TOPIC\): did you mean "scripts"\?' "$headrace" help script_
[ -z "$skipped" ] || exit 77
echo "every example of the help works"
