#!/usr/bin/python3
"""Holds the sources to the house's order: who may include whom. Prints each include that breaks it."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()

# Queues and boards between the server's threads.
EXCHANGE = r"server/(doorbell|outbox|inbox|event_log|jobs|probe_board|state_table|status)\."

# First match wins: files, what of ours they may include. The solver knows nothing of ours but itself.
ROOMS = [
    (r"proto/", [r"proto/"]),
    (r"client/", [r"client/", r"proto/"]),
    (r"server/solver/(forces|boundaries|integrator)/",
     [r"server/solver/(forces|boundaries|integrator)/", r"server/solver/[^/]+$"]),
    (r"server/solver/pairs/", [r"server/solver/pairs/", r"server/solver/[^/]+$", r"hwy/"]),
    (r"server/solver/(models/|diagnostics\.)", [r"server/solver/", r"hwy/"]),
    (r"server/solver/", [r"server/solver/[^/]+$"]),
    (r"server/scene/", [r"server/scene/", r"server/solver/", r"proto/"]),
    (r"server/probes/", [r"server/probes/", r"server/solver/", r"proto/"]),
    (EXCHANGE, [EXCHANGE, r"proto/"]),
    (r"server/publish/", [r"server/publish/", r"server/solver/[^/]+$", EXCHANGE, r"proto/"]),
    (r"server/service/", [r"server/service/", r"server/publish/", r"server/simulation\.h", r"server/scene/run\.h",
                          r"server/solver/models/registry\.h", EXCHANGE, r"proto/"]),
    (r"server/main\.cpp", [r"server/", r"proto/"]),
    (r"server/[^/]+$", [r"server/(?!service/)", r"proto/"]),  # the simulation thread
    (r"tests/", [r""]),
]

# Rooms without these libraries.
BANS = [
    (r"server/solver/", r"(nlohmann|zmq|CLI|spdlog)", "the solver uses no such library"),
    (r"server/scene/", r"(nlohmann|zmq|CLI)", "scenes are plain structs here"),
    (r"server/probes/", r"(nlohmann|zmq|CLI)", "probes are plain structs here"),
]

# Large libraries: a header that includes one, by itself or through another header, is private to its folder, so that no
# room pays for another's. The one header made to be shared, by .cpp files that handle requests:
HEAVY = r"nlohmann/json\.hpp$|zmq(_addon)?\.h(pp)?$"
SHARED_HEAVY = "proto/envelope.h"


def includes(file):
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        match = re.match(r'\s*#\s*include\s+([<"])([^>"]+)[>"]', line)
        if match:
            yield number, match.group(1) == '"', match.group(2)


def allowed_in(name):
    for pattern, allowed in ROOMS:
        if re.match(pattern, name):
            return allowed
    return []


def faults_of(name, number, is_ours, target):
    if is_ours and not any(re.match(pattern, target) for pattern in allowed_in(name)):
        yield f"{name}:{number}: may not include {target}"
    for files, libraries, why in BANS:
        if re.match(files, name) and re.match(libraries, target):
            yield f"{name}:{number}: {target}: {why}"


def heavy_headers(found):
    """Headers that pull in a heavy library, directly or through each other."""
    heavy, before = set(), None
    while heavy != before:
        before = set(heavy)
        heavy |= {name for name, number, is_ours, target in found
                  if name.endswith(".h") and (target in heavy if is_ours else re.match(HEAVY, target))}
    return heavy


def border_faults(found):
    heavy = heavy_headers(found)
    for name, number, is_ours, target in found:
        if target in heavy - {SHARED_HEAVY} and not name.startswith("tests/"):
            if pathlib.PurePath(name).parent != pathlib.PurePath(target).parent:
                yield f"{name}:{number}: {target} includes JSON or sockets and is private to its folder"


def main():
    files = [f for room in ("proto", "server", "client", "tests") for f in sorted((root / room).rglob("*"))
             if f.suffix in (".h", ".cpp") and "node_modules" not in f.parts]
    found = [(str(f.relative_to(root)), *include) for f in files for include in includes(f)]
    faults = [fault for include in found for fault in faults_of(*include)] + list(border_faults(found))
    print("\n".join(faults) if faults else f"{len(files)} files keep the order")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
