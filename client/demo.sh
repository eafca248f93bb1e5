#!/usr/bin/env bash
# The main job in one command, from a clean clone: installs what is missing, builds, simulates the dam break with its
# panel, records it and turns the recording into ParaView files and pictures.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=client/install.sh
. "$root/client/install.sh"

usage() {
    cat <<'TEXT'
usage: client/demo.sh [--out FOLDER]

Builds headraced and headrace, lets a column of water come to rest behind a panel, removes the panel, records 3 s of the
dam break at 100 frames per simulated second, and writes ParaView files and pictures. Can be run again at any time.

  --out FOLDER   where the recording and the pictures go (default: out/demo below the repository)
  --help         this text

Environment:
  HEADRACE_BUILD_DIR    a build folder that has the programs already: nothing is installed or built
  HEADRACE_NO_INSTALL   set: installs no packages
TEXT
}

out="$root/out/demo"
while [ $# -gt 0 ]; do
    case "$1" in
        --out)
            [ $# -ge 2 ] || die "--out needs a folder" "see client/demo.sh --help"
            out=$2
            shift
            ;;
        --out=*) out=${1#--out=} ;;
        -h | --help)
            usage
            exit 0
            ;;
        *) die "unknown option '$1'" "see client/demo.sh --help" ;;
    esac
    shift
done

server_pid=
scratch=
finish() {
    if [ -n "$server_pid" ]; then
        kill "$server_pid" 2>/dev/null || true
        wait "$server_pid" 2>/dev/null || true
    fi
    [ -z "$scratch" ] || rm -rf "$scratch"
}
trap finish EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

phases=()
phase_start=$SECONDS
end_phase() {
    phases+=("$1 $((SECONDS - phase_start)) s")
    phase_start=$SECONDS
}

build="${HEADRACE_BUILD_DIR:-}"
if [ -z "$build" ]; then
    build="$root/build-demo"
    install_packages "${headrace_build_packages[@]}"
    end_phase packages
    say "building headraced and headrace in $build"
    configure_build "$build" -DCMAKE_BUILD_TYPE=Release -DHEADRACE_TESTS=OFF -DHEADRACE_BENCH=OFF
    cmake --build "$build" --target headraced headrace -j "$(build_jobs)"
    end_phase build
fi
for program in server/headraced client/headrace; do
    [ -x "$build/$program" ] || die "$build/$program does not exist" "unset HEADRACE_BUILD_DIR to build it here"
done
headrace() { "$build/client/headrace" "$@"; }

# The server, on a free port of this machine; its ready line tells which.
mkdir -p "$out"
out=$(cd "$out" && pwd)
say "starting headraced"
exec 3< <(exec "$build/server/headraced" --bind 'tcp://127.0.0.1:*' --data "$out" --json)
server_pid=$!
IFS= read -r -t 60 ready <&3 || die "headraced did not get ready" "Its message is above."
HEADRACE_SERVER=$(sed -n 's/.*"control" *: *"\([^"]*\)".*/\1/p' <<<"$ready")
[ -n "$HEADRACE_SERVER" ] || die "the ready line is unknown: $ready"
export HEADRACE_SERVER
echo "$HEADRACE_SERVER"

say "dam_break: 3000 particles; the water comes to rest behind the panel"
headrace load dam_break
headrace resume --until at-rest
end_phase "coming to rest"

say "the panel is removed; 3 s are recorded at 100 frames per simulated second"
headrace remove panel
headrace record "$out/dam_break.mcap" --for 3 --fps 100 --overwrite
end_phase "dam break"

say "writing ParaView files and pictures"
# Only files that an earlier demo has made: the folder is the user's.
if [ -d "$out/dam_break" ]; then
    find "$out/dam_break" -maxdepth 1 -type f \( -name 'dam_break_[0-9]*.vtp' -o -name 'dam_break_objects_[0-9]*.vtp' \
        -o -name 'dam_break.pvd' -o -name 'dam_break_[0-9]*.png' -o -name 'dam_break_sheet.png' \) -delete
fi
headrace convert "$out/dam_break.mcap" --format vtp,png --out "$out/dam_break"
end_phase conversion

# What there is now, and what it took.
files="$out/dam_break"
size_of() { du -ch "$@" 2>/dev/null | tail -1 | cut -f1; }
count_of() { find "$files" -maxdepth 1 -name "$1" | wc -l; }
say "done"
cat <<TEXT
at a glance   $files/dam_break_sheet.png
ParaView      $files/dam_break.pvd   ($(count_of 'dam_break_*.vtp') .vtp files, $(size_of "$files"/*.vtp))
pictures      $files/dam_break_*.png   ($(count_of 'dam_break_[0-9]*.png') files, $(size_of "$files"/*.png))
recording     $out/dam_break.mcap   ($(size_of "$out/dam_break.mcap"))
TEXT
printf 'time          %s' "${phases[0]}"
printf ', %s' "${phases[@]:1}"
printf '; %s s in all\n' "$SECONDS"
