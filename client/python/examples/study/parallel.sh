#!/bin/sh
# A parameter study with GNU parallel: a private server per case, as many at once as the machine has cores.
# usage: parallel.sh [FILE.csv] [OPTIONS of case.py]
set -eu
out=${1:-study.csv}
[ $# -eq 0 ] || shift
echo "viscosity,front,steps" >"$out"
parallel --keep-order --halt soon,fail=1 python3 "$(dirname "$0")/case.py" {} "$@" ::: 0.5 2 5 10 >>"$out"
