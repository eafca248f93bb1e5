#!/usr/bin/env bash
# Words complete themselves in an interactive zsh, at the press of Tab.
# usage: completion_zsh.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
. "$(dirname "${BASH_SOURCE[0]}")/completion.bash"
command -v zsh >/dev/null || { echo "no zsh here" >&2; exit 77; }
completes() { /usr/bin/python3 "$root/tests/support/type_into_shell.py" zsh "$1" | sed 's/.*<\([^>]*\)>$/\1/'; }
check_completion
echo "zsh completes"
