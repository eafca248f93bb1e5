#!/usr/bin/env bash
# Each command has a manual page that is right in the eyes of mandoc and man, and tells its options. Arguments: headrace,
# headraced.
set -euo pipefail
headrace=$1
headraced=$2
pages=$(mktemp -d)
trap 'rm -rf "$pages"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

"$headrace" man --out "$pages"
"$headraced" --man >"$pages/headraced.1"
commands=$("$headrace" __complete '' | cut -f 1)
[ "$(wc -w <<<"$commands")" -ge 25 ] || fail "few commands: $commands"
for command in $commands; do
    page="$pages/headrace-$command.1"
    [ -s "$page" ] || fail "no page for $command"
    cmp -s "$page" <("$headrace" man "$command") || fail "the page of $command is another one alone"
    for option in $("$headrace" __complete "$command" --); do
        [[ $option == --* && $option != --server && $option != --json && $option != --version ]] || continue
        grep -q -- "${option//-/\\\\-}" "$page" || fail "$page does not tell $option"
    done
done
[ "$(find "$pages" -name '*.1' | wc -l)" -eq $(($(wc -w <<<"$commands") + 2)) ] || fail "other pages: $(ls "$pages")"

judged=
if command -v mandoc >/dev/null; then
    # No date: the pages are the same whenever they are made.
    faults=$(mandoc -T lint -W warning "$pages"/*.1 | grep -v 'missing date' || true)
    [ -z "$faults" ] || fail "$faults"
    judged+=" mandoc"
fi
if command -v man >/dev/null && man --help 2>/dev/null | grep -q -- --warnings; then
    for page in "$pages"/*.1; do
        faults=$(MANWIDTH=100 LC_ALL=C.UTF-8 man --warnings -l "$page" 2>&1 >/dev/null)
        [ -z "$faults" ] || fail "$page: $faults"
    done
    MANWIDTH=200 LC_ALL=C.UTF-8 man -l "$pages/headrace-script.1" | grep -q 'headrace script \[options\] FILE' || fail "no synopsis"
    judged+=" man"
fi
[ -n "$judged" ] || { echo "neither mandoc nor man here" >&2; exit 77; }
echo "the manual pages are right, say$judged"
