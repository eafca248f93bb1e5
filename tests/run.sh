#!/usr/bin/env bash
# Builds everything and runs the tests: the one command behind "does it still hold?". Ends with ctest's own summary.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=client/install.sh
. "$root/client/install.sh"

usage() {
    cat <<'TEXT'
usage: tests/run.sh [--full] [--preset NAME] [--label LABEL] [ctest arguments]

Installs missing packages, builds, and runs the tests with ctest. Tests whose tools are not installed are reported as
skipped.

  --full          installs those tools too (VTK, mandoc, zsh, fish, clang-format, valgrind, POV-Ray, Node.js and its
                  packages, Matplotlib, mypy, pip, GNU parallel, Slurm); then a skipped test is a failure, unless it
                  lacks the reference data of the validation, root, or
                  an instruction that the machine hides (rdtscp: valgrind)
  --preset NAME   release (default), debug, asan or tsan: see CMakePresets.json
  --label LABEL   only tests with this label: unit, stability, protocol, validation, cli, script, python, demo
  --help          this text

  tests/run.sh --label unit -R Kernel     further arguments go to ctest

Environment: HEADRACE_NO_INSTALL set: installs no packages. HEADRACE_REFERENCE_DIR: where the validation's
reference data lie. PYTHON: the interpreter (default /usr/bin/python3, where the packages are installed for).
TEXT
}

full=no
preset=release
ctest_arguments=()
while [ $# -gt 0 ]; do
    case "$1" in
        --full) full=yes ;;
        --preset | --label)
            [ $# -ge 2 ] || die "$1 needs a value" "see tests/run.sh --help"
            if [ "$1" = --preset ]; then preset=$2; else ctest_arguments+=(-L "^$2\$"); fi
            shift
            ;;
        --help | -h)
            usage
            exit 0
            ;;
        *) ctest_arguments+=("$1") ;;
    esac
    shift
done
case "$preset" in
    release) build="$root/build" ;;
    debug | asan | tsan) build="$root/build-$preset" ;;
    *) die "no preset '$preset'" "release, debug, asan or tsan" ;;
esac

packages=("${headrace_build_packages[@]}" catch2 python3 python3-zmq python3-numpy python3-jsonschema python3-pytest
    tmux=tmux ffmpeg=ffmpeg)
[ $full = no ] || packages+=(python3-vtk9 mandoc=mandoc zsh=zsh fish=fish clang-format valgrind=valgrind povray=povray
    nodejs=node npm=npm python3-venv python3-pip python3-setuptools python3-wheel python3-matplotlib python3-zstandard
    mypy=mypy parallel slurm-wlm munge)
install_packages "${packages[@]}"

# Other projects judge our recordings (mcap) and what the server says of itself (openrpc).
for judge in mcap openrpc; do
    folder="$root/tests/support/$judge"
    if [ $full = no ] || [ -n "${HEADRACE_NO_INSTALL:-}" ] ||
        cmp -s "$folder/package-lock.json" "$folder/node_modules/.installed-lock.json"; then
        continue
    fi
    say "installing the Node.js packages of tests/support/$judge"
    (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error) ||
        die "npm ci failed in $folder" "Its message is above. Is there a network?"
    cp "$folder/package-lock.json" "$folder/node_modules/.installed-lock.json"
done

say "building everything in $build"
cd "$root"
launcher=()
if command -v ccache >/dev/null 2>&1; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    unset CCACHE_BASEDIR # makes __FILE__ relative, by which tests find their data
fi
configure_build "$build" --preset "$preset" "${launcher[@]}" -DHEADRACE_TESTS=ON -DHEADRACE_BENCH=ON \
    -DHEADRACE_PYTHON="${PYTHON:-/usr/bin/python3}"
cmake --build "$build" -j "$(build_jobs)"

say "running the tests ($preset)"
# Two tests run at a time, each with a team of threads: threads that wait must sleep, or they starve the others.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}
log="$build/ctest.log"
status=0
ctest --preset "$preset" -j2 --no-tests=error --output-on-failure "${ctest_arguments[@]}" 2>&1 | tee "$log" || status=$?
# The validation skips what needs reference data that are not part of the repository, Slurm's test what needs root, and
# instructions cannot be counted where a virtual machine hides rdtscp, which libhwy runs when it is loaded and valgrind
# then refuses: there is nothing to install.
allowed=' validation:'
[ "$(id -u)" -eq 0 ] || allowed+='\| python: slurm'
[ "$(uname -m)" != x86_64 ] || grep -qw rdtscp /proc/cpuinfo || allowed+='\| plan: what'
if [ $full = yes ] && [ $status -eq 0 ] && grep '\*\*\*Skipped' "$log" | grep -qv "$allowed"; then
    echo "run.sh: tests were skipped, and --full allows none but those without reference data, root or rdtscp" >&2
    status=1
fi
exit $status
