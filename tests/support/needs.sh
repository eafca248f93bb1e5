#!/usr/bin/env bash
# Runs a script that needs Python modules; exits 77, "skipped" for ctest, where one is not installed.
# Arguments: interpreter, modules with commas, script and its arguments.
set -euo pipefail
python=$1
modules=$2
shift 2
for module in ${modules//,/ }; do
    "$python" -c "import $module" 2>/dev/null || { echo "$python has no module $module" >&2; exit 77; }
done
exec "$python" "$@"
