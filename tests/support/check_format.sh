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

status=0
complaints=$(find proto server client tests \( -name '*.h' -o -name '*.cpp' \) -not -path '*/node_modules/*' -print0 |
    sort -z | xargs -0 "$formatter" --dry-run --Werror 2>&1) || status=$?
if [ $status -ne 0 ]; then
    echo "clang-format -i these:"
    sed -n 's/^\([^: ]*\):[0-9]*:[0-9]*: error.*/\1/p' <<<"$complaints" | uniq
    exit 1
fi
