# shellcheck shell=bash
# Sourced by client/demo.sh and tests/run.sh: installs the Debian packages that are missing, and only those; configures
# and builds. The caller is bash with `set -euo pipefail`, and has set `root`, the repository.

# What the two programs need. NAME=COMMAND: also content when the command is there from elsewhere.
headrace_build_packages=(
    g++=g++ cmake=cmake make=make pkg-config=pkg-config libzmq3-dev cppzmq-dev nlohmann-json3-dev libcli11-dev
    libhwy-dev libzstd-dev zlib1g-dev libcairo2-dev libzip-dev libmuparser-dev fonts-dejavu-core
)

say() { printf '\n== %s\n' "$*"; }

die() {
    printf '%s: %s\n' "${0##*/}" "$1" >&2
    shift
    [ $# -eq 0 ] || printf '  %s\n' "$@" >&2
    exit 1
}

is_package_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# install_packages NAME[=COMMAND]...: leaves the package manager alone when nothing is missing.
install_packages() {
    local entry missing=() wanted=()
    for entry in "$@"; do
        wanted+=("${entry%%=*}")
        case "$entry" in
            *=*) ! command -v "${entry#*=}" >/dev/null 2>&1 || continue ;;
        esac
        is_package_installed "${entry%%=*}" || missing+=("${entry%%=*}")
    done
    if [ ${#missing[@]} -eq 0 ] || [ -n "${HEADRACE_NO_INSTALL:-}" ]; then
        return 0
    fi

    command -v apt-get >/dev/null 2>&1 || die "this is not Debian (no apt-get): cannot install ${missing[*]}" \
        "Install your system's equivalents of: ${wanted[*]}" "then run again with HEADRACE_NO_INSTALL=1."
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null 2>&1 || die "missing packages, and neither root nor sudo to install them" \
            "Run this as root: apt-get install --no-install-recommends ${missing[*]}"
        # Without a terminal sudo could only hang or fail on its question for a password.
        [ -t 0 ] || sudo -n true 2>/dev/null || die "missing packages, and sudo wants a password but there is no terminal" \
            "Run this as root: apt-get install --no-install-recommends ${missing[*]}"
        as_root=(sudo)
    fi

    say "installing ${#missing[@]} missing packages: ${missing[*]}"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300)
    local list_is_fresh=yes
    # A broken source of somebody else's need not stop us: only a package that cannot be had does.
    "${apt[@]}" -o APT::Update::Error-Mode=any update || list_is_fresh=no
    local name unknown=()
    for name in "${missing[@]}"; do
        apt-cache show "$name" >/dev/null 2>&1 || unknown+=("$name")
    done
    if [ ${#unknown[@]} -gt 0 ]; then
        if [ $list_is_fresh = no ]; then
            die "could not fetch the package lists, and apt does not know: ${unknown[*]}" \
                "Is there a network? Behind a proxy, set http_proxy. Sources: /etc/apt/sources.list*." "Then run again."
        fi
        # shellcheck source=/dev/null
        die "apt knows no package ${unknown[*]}" \
            "These are in Debian 12 (bookworm) main; this is $(. /etc/os-release 2>/dev/null && echo "${PRETTY_NAME:-unknown}")." \
            "Enable that source in /etc/apt, or install equivalents and run again with HEADRACE_NO_INSTALL=1."
    fi
    "${apt[@]}" install -y --no-install-recommends "${missing[@]}" || die "apt-get could not install: ${missing[*]}" \
        "Its message is above. No network: connect and run again. Disk full: the packages need about 1.4 GB at most." \
        "Broken packages: apt-get --fix-broken install."
}

# Parallel compilers: one per core, and 1.5 GB of memory each (the JSON and option libraries are large).
build_jobs() {
    local cores memory_jobs
    cores=$(nproc)
    memory_jobs=$(awk '/^MemAvailable:/ {print int($2 / 1572864)}' /proc/meminfo)
    [ "${memory_jobs:-1}" -ge 1 ] || memory_jobs=1
    echo $((cores < memory_jobs ? cores : memory_jobs))
}

# configure_build FOLDER ARGUMENTS...: a build folder keeps the generator that it was made with.
configure_build() {
    local folder=$1 generator=()
    shift
    if [ ! -e "$folder/CMakeCache.txt" ]; then
        if command -v ninja >/dev/null 2>&1; then generator=(-G Ninja); else generator=(-G "Unix Makefiles"); fi
    fi
    cmake -S "$root" -B "$folder" "${generator[@]}" "$@"
}
