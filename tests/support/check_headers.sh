#!/usr/bin/env bash
# Each header compiles alone. Arguments: compiler, repository root.
set -euo pipefail
compiler=$1
cd "$2"
headers=$(find proto server client tests -name '*.h' -not -path '*/node_modules/*' | sort)
[ -n "$headers" ] || { echo "no headers found" >&2; exit 1; }
libraries=$(pkg-config --cflags cairo)
# shellcheck disable=SC2086  # several words
echo "$headers" | xargs -P 2 -I {} "$compiler" -std=c++20 -I. $libraries -fopenmp -fsyntax-only -Wall -Wextra -Werror \
    -Wno-psabi -Wno-missing-field-initializers \
    '-DHEADRACE_SOURCE_DIR="."' \
    -x c++ -include {} /dev/null
echo "$(wc -l <<<"$headers") headers compile alone"
