#!/usr/bin/env bash
# Words complete themselves in fish, which tells what Tab would offer.
# usage: completion_fish.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
. "$(dirname "${BASH_SOURCE[0]}")/completion.bash"
command -v fish >/dev/null || { echo "no fish here" >&2; exit 77; }
# Without a candidate the line stays as it is.
completes() {
    local found
    found=$(HOME=$work fish --no-config -c 'headrace completion fish | source; complete -C "$argv[1]"' "$1" | cut -f 1)
    echo "${found:-${1##* }}"
}
check_completion
echo "fish completes"
