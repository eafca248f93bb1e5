#!/usr/bin/env bash
# client/install.sh against a make-believe package manager: what it asks for, and what it says when that fails.
# Argument: repository root.
set -euo pipefail
root=$1
sandbox=$(mktemp -d)
trap 'rm -rf "$sandbox"' EXIT
bin="$sandbox/bin"
mkdir "$bin"

# The real tools that install.sh uses, and nothing else: the machine's own packages must not show through.
for tool in bash env cat awk nproc; do ln -s "$(command -v $tool)" "$bin/$tool"; done
cat >"$bin/dpkg-query" <<'END'
#!/bin/sh
for name; do :; done
case " $INSTALLED " in *" $name "*) echo installed ;; *) exit 1 ;; esac
END
cat >"$bin/apt-get" <<'END'
#!/bin/sh
echo "apt-get $*" >>"$LOG"
case "$*" in *update) exit ${UPDATE_STATUS:-0} ;; *) exit ${INSTALL_STATUS:-0} ;; esac
END
cat >"$bin/apt-cache" <<'END'
#!/bin/sh
case " $UNKNOWN " in *" $2 "*) exit 100 ;; esac
END
printf '#!/bin/sh\necho ${USER_ID:-0}\n' >"$bin/id"
chmod +x "$bin"/dpkg-query "$bin"/apt-get "$bin"/apt-cache "$bin"/id

# install VARIABLE=VALUE... -- PACKAGE...: runs install_packages in the sandbox; output, exit status and calls are kept.
install() {
    local settings=()
    while [ "$1" != -- ]; do settings+=("$1") && shift; done
    shift
    : >"$sandbox/calls"
    status=0
    env -i PATH="$bin" LOG="$sandbox/calls" "${settings[@]}" bash -c \
        'set -euo pipefail; . "$0"; install_packages "$@"' "$root/client/install.sh" "$@" \
        >"$sandbox/output" 2>&1 </dev/null || status=$?
}

failures=0
expect() { # description, command...
    local what=$1
    shift
    "$@" && return
    echo "FAILED: $what (status $status)"
    cat "$sandbox/calls" "$sandbox/output"
    failures=$((failures + 1))
}
says() { grep -q -- "$1" "$sandbox/output"; }
calls() { [ "$(grep -c . "$sandbox/calls")" -eq "$1" ]; }
called() { grep -q -- "$1" "$sandbox/calls"; }
ends_with() { [ "$status" -eq "$1" ]; }

install INSTALLED="one two" -- one two
expect "nothing missing: success" ends_with 0
expect "nothing missing: the package manager is left alone" calls 0

install INSTALLED=one -- one two three
expect "missing: success" ends_with 0
expect "missing: one update and one install" calls 2
expect "missing: only those" called ' install -y --no-install-recommends two three$'

install INSTALLED= -- interpreter=bash
expect "a command from elsewhere counts" calls 0

install INSTALLED= HEADRACE_NO_INSTALL=1 -- one
expect "HEADRACE_NO_INSTALL installs nothing" calls 0
expect "HEADRACE_NO_INSTALL: success" ends_with 0

install INSTALLED= USER_ID=1000 -- one
expect "neither root nor sudo: failure" ends_with 1
expect "neither root nor sudo: the remedy" says 'Run this as root: apt-get install --no-install-recommends one'
expect "neither root nor sudo: nothing is tried" calls 0

install INSTALLED= UPDATE_STATUS=100 -- one
expect "somebody else's broken source does not stop us" ends_with 0

install INSTALLED= UPDATE_STATUS=100 UNKNOWN=one -- one
expect "no network: failure" ends_with 1
expect "no network: the remedy" says 'Is there a network'

install INSTALLED= UNKNOWN=one -- one two
expect "unknown package: failure" ends_with 1
expect "unknown package: named" says 'apt knows no package one$'

install INSTALLED= INSTALL_STATUS=100 -- one
expect "failed install: failure" ends_with 1
expect "failed install: named" says 'could not install: one$'

rm "$bin/apt-get"
install INSTALLED= -- one=absent two
expect "not Debian: failure" ends_with 1
expect "not Debian: the equivalents are named" says 'equivalents of: one two$'

[ $failures -eq 0 ] && echo "install.sh: all as expected"
