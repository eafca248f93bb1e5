#!/usr/bin/env bash
# The sources are as clang-format 14 leaves them (other versions format differently). Argument: repository root.
# Names each file that is not.
set -euo pipefail
cd "$1"
formatter=
for name in clang-format-14 clang-format; do
    case "$("$name" --version 2>/dev/null)" in
        *"version 14."*) formatter=$name && break ;;
    esac
done
[ -n "$formatter" ] || { echo "clang-format 14 is not installed" >&2; exit 77; }

export formatter
unformatted=$(find proto server client tests \( -name '*.h' -o -name '*.cpp' \) -not -path '*/node_modules/*' | sort |
    xargs -n 1 sh -c '"$formatter" --dry-run --Werror "$0" 2>/dev/null || echo "$0"')
[ -z "$unformatted" ] || { printf 'clang-format -i these:\n%s\n' "$unformatted"; exit 1; }
