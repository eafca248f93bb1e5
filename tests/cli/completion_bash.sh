#!/usr/bin/env bash
# Words complete themselves in an interactive bash, at the press of Tab.
# usage: completion_bash.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
. "$(dirname "${BASH_SOURCE[0]}")/completion.bash"
completes() { /usr/bin/python3 "$root/tests/support/type_into_shell.py" bash "$1" | sed 's/.*<\([^>]*\)>$/\1/'; }
check_completion
# A word with = in it, which Bash takes for two.
offers 'headrace --server=x run bowl --set visc' 'visc'
offers "headrace --server=$HEADRACE_SERVER set visc" 'viscosity='
echo "bash completes"
