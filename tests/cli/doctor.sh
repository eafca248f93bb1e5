#!/usr/bin/env bash
# `headrace doctor`: nothing wrong on a machine that is in order, and each thing that is wrong found, with its remedy.
# usage: doctor.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
start_server
cd "$work" || exit 1
unset OMP_NUM_THREADS

expect 0 '(ok|warning) .*private server +.*headraced [0-9.]+.*server +tcp://127.*, [0-9]+ threads?' "$headrace" doctor
"$headrace" --json doctor >findings.json || fail "doctor --json ended with $?"
/usr/bin/python3 - <<'PYTHON' || fail "$(cat findings.json)"
import json
findings = json.load(open("findings.json"))
subjects = [f["subject"] for f in findings]
assert subjects == ["client", "instruction sets", "threads", "open files", "size of files", "this folder",
                    "temporary folder", "ffmpeg", "Python", "private server", "server"], subjects
assert all(f["health"] in ("ok", "warning") for f in findings)
assert all(bool(f["remedy"]) == (f["health"] != "ok") for f in findings), "a remedy for all that is not in order, and only that"
PYTHON

# Limits warn: work goes on.
expect 0 '.*warning +open files +at most 256.*-> many subscribers need more: ulimit -n 1024.*' \
    bash -c 'ulimit -n 256; exec "$1" doctor' - "$headrace"
expect 0 '.*warning +size of files +at most [0-9]+ bytes.*ulimit -f unlimited.*' \
    bash -c 'ulimit -f 1000; exec "$1" doctor' - "$headrace"
expect 0 '.*warning +threads +.*OMP_NUM_THREADS=4096.*unset OMP_NUM_THREADS.*' env OMP_NUM_THREADS=4096 "$headrace" doctor

# So do programs that only some of the work needs. A PATH with none of them, with a Python that lacks both modules, and
# with one that has them.
mkdir bare
expect 0 '.*warning +ffmpeg +not on the PATH.*apt install ffmpeg.*warning +Python +no python3 on the PATH.*python3-zmq.*' \
    env PATH="$work/bare" "$headrace" doctor
for modules in '|' '25.1|1.24'; do
    printf '#!/bin/sh\necho "/opt/python3|3.9.9|%s"\n' "$modules" >bare/python3
    chmod +x bare/python3
    case $modules in
    '|') expect 0 '.*warning +Python +/opt/python3 3\.9\.9, no pyzmq, no NumPy.*/opt/python3 -m pip install pyzmq numpy.*' \
        env PATH="$work/bare" "$headrace" doctor ;;
    *) expect 0 '.*ok +Python +/opt/python3 3\.9\.9, pyzmq 25\.1, NumPy 1\.24.*' env PATH="$work/bare" "$headrace" doctor ;;
    esac
done
findings=$("$headrace" doctor)
[[ $findings =~ folder\ +.+,\ [0-9]{1,3}(,[0-9]{3})*(\.[0-9])?\ GiB\ free ]] || fail "too many digits: $findings"

# Failures, with the exit status of the first.
expect 3 '.*failure +private server +HEADRACE_SERVER_BINARY is no program.*error connection_failed \(private server\): 1 failure found; .*' \
    env HEADRACE_SERVER_BINARY=/dev/null "$headrace" doctor
printf '#!/bin/sh\nexit 1\n' >broken
chmod +x broken
expect 3 '.*failure +private server +.*broken: .*' env HEADRACE_SERVER_BINARY="$work/broken" "$headrace" doctor
expect 3 '.*failure +server +no answer from ipc://.*error connection_failed \(server\): .*' \
    "$headrace" --server "ipc://$work/nobody" doctor
(cd /proc && expect 6 '.*failure +this folder +/proc: .*choose a folder of yours.*' "$headrace" doctor) || exit 1
expect 6 '.*failure +temporary folder +.*' env TMPDIR=/proc "$headrace" doctor

# A port that another program has taken is told from one that nobody listens on.
/usr/bin/python3 - "$work/port" <<'PYTHON' &
import signal, socket, sys, os
s = socket.socket()
s.bind(("127.0.0.1", 0))
s.listen()
open(sys.argv[1] + ".new", "w").write(str(s.getsockname()[1]))
os.rename(sys.argv[1] + ".new", sys.argv[1])
signal.pause()
PYTHON
client_pid=$!
wait_for 60 test -s port || fail "nobody listens"
expect 3 ".*failure +server +port $(cat port) is taken, and no headraced answers at .*choose other ports.*" \
    "$headrace" --server "tcp://127.0.0.1:$(cat port)" doctor
echo "doctor finds what is wrong"
