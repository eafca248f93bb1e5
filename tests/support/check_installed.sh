#!/usr/bin/env bash
# What `cmake --install` puts together works by itself: the client finds the server beside it, and the server its scenes.
# Arguments: cmake, build folder, prefix to install to.
set -euo pipefail
cmake=$1
build=$2
prefix=$3
rm -rf "$prefix"
"$cmake" --install "$build" --prefix "$prefix" >/dev/null

# Nothing else may help: no variables, no PATH.
run() { env -i "$prefix/bin/$1" "${@:2}"; }
check() { # pattern, command...
    local pattern=$1 output
    shift
    output=$(run "$@") || { echo "$* ended with $?" >&2; exit 1; }
    [[ $output =~ ^$pattern ]] || { echo "$* printed: $output" >&2; exit 1; }
}
check 'headrace [0-9]+\.[0-9]+\.[0-9]+$' headrace --version
check 'headraced [0-9]+\.[0-9]+\.[0-9]+$' headraced --version
check 'bowl: 2,197 particles, ' headrace plan bowl
preset=$(find "$prefix" -path '*/headrace/presets/bowl.json')
[ -s "$preset" ] || { echo "the presets are not installed" >&2; exit 1; }
check 'bowl: 2,197 particles, ' headrace plan "$preset"
[ -n "$(find "$prefix" -path '*/headrace/schemas/scene.schema.json')" ] || { echo "no schemas" >&2; exit 1; }
for file in share/man/man1/headrace.1 share/man/man1/headraced.1 share/man/man1/headrace-run.1 \
    share/bash-completion/completions/headrace share/zsh/site-functions/_headrace \
    share/fish/vendor_completions.d/headrace.fish; do
    [ -s "$prefix/$file" ] || { echo "$file is not installed" >&2; exit 1; }
done
echo "the installed programs work"
