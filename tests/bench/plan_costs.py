#!/usr/bin/python3
"""What each part of a step costs in instructions, counted by valgrind's callgrind: noise-free, so small costs show.

usage: plan_costs.py HEADRACE_BENCH --check [--server HEADRACED HEADRACE]    states truths, exits with 1 if one fails
       plan_costs.py HEADRACE_BENCH --out FILE                               writes the table of costs

Each scene is stepped by `headrace_bench count-steps` on one thread. The pair loops run in AVX2 there: callgrind knows no
AVX-512. Exits with 77 where valgrind is not installed, or knows less than the machine's programs use.
"""
import argparse
import copy
import fnmatch
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

SKIPPED = 77
COUNTED = "*make_counted_steps*"
# One thread, and no restart for the sake of settings (server/solver/process_settings.h): callgrind would lose the program.
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", GOMP_SPINCOUNT="0", GLIBC_TUNABLES="")


# ---- counting --------------------------------------------------------------------------------------------------------


# What the C library's allocator does depends on the heap's history, not on the work: it is not counted.
ALLOCATOR = re.compile(r"^(_int_\w+|malloc\w*|free|calloc|realloc|posix_memalign|aligned_alloc|sysmalloc|systrim|"
                       r"unlink_chunk|tcache\w*|arena\w*|alloc_perturb|operator (new|delete))\b")


class Counts:
    """Instructions of a run: all, and by function (those that it spent itself)."""

    def __init__(self, profile, told):
        self.particles, self.steps, self.plan = told["particles"], told["steps"], told["plan"]
        self.functions = {name: c for name, c in read_profile(profile).items() if not ALLOCATOR.match(name)}
        self.total = sum(self.functions.values())

    def per_particle_step(self):
        return self.total / (self.particles * self.steps)

    def of(self, *patterns):
        """Instructions of functions whose name contains one of these."""
        return sum(count for name, count in self.functions.items() if any(part in name for part in patterns))

    def sorts(self):
        reason = next(stage["reason"] for stage in self.plan if stage["stage"] == "neighbours")
        found = re.search(r"sorted (?:once|(\d+) times)", reason)
        return int(found.group(1) or 1)


def read_profile(file):
    """{function: own instructions} of a callgrind profile without compression."""
    costs, function, is_call = {}, None, False
    with open(file, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if line.startswith("fn="):
                function = line[3:].strip()
            elif line.startswith("calls="):
                is_call = True  # the next line has the callee's instructions
            elif line[:1].isdigit():
                if not is_call:
                    costs[function] = costs.get(function, 0) + int(line.split()[1])
                is_call = False
    return {name: count for name, count in costs.items() if count > 0}


def run_callgrind(command, profile, collect=None, **more):
    options = ["--tool=callgrind", f"--callgrind-out-file={profile}", "--compress-strings=no", "--compress-pos=no"]
    if collect:
        options.append(f"--toggle-collect={collect}")
    return subprocess.Popen(["valgrind", "-q", *options, *command], env=ENVIRONMENT, text=True, **more)


class Bench:
    def __init__(self, program):
        self.program = program
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="plan-costs-"))
        self.known = {}

    def count(self, scene, steps=2, reader=False, collect=COUNTED):
        """Counts of a scene's steps, or of the function `collect` while it is loaded and stepped."""
        key = json.dumps([scene, steps, reader, collect])
        if key not in self.known:
            document, profile = self.folder / "scene.json", self.folder / "profile"
            document.write_text(json.dumps(scene))
            command = [self.program, "count-steps", str(document), "--warmup", "1", "--steps", str(steps)]
            process = run_callgrind(command + (["--reader"] if reader else []), profile, collect,
                                    stdout=subprocess.PIPE)
            told, _ = process.communicate(timeout=500)
            if process.returncode != 0:
                sys.exit(f"plan_costs.py: {' '.join(command)} failed")
            self.known[key] = Counts(profile, json.loads(told))
        return self.known[key]

    def close(self):
        shutil.rmtree(self.folder)


# ---- scenes ----------------------------------------------------------------------------------------------------------

SPACING = 0.02  # [m]
SOUND_SPEED = 10.0  # [m/s]
ACOUSTIC_STEP = 0.6 * 1.5 * SPACING / SOUND_SPEED  # [s] cfl h/c0 at the default support


def block(dimensions, edge, model="wcsph", acoustic_steps=5, **parameters):
    """A block of fluid that turns slowly, `edge` particles long, without anything around it. Its steps have so many
    acoustic ones, and none of the counted ones needs new lists."""
    length = edge * SPACING
    zero, most = [0.0] * dimensions, [length] * dimensions
    settings = {"gravity": [0.0] * dimensions}
    if model == "wcsph":
        settings |= {"sound_speed": SOUND_SPEED, "time_step": (acoustic_steps - 0.5) * ACOUSTIC_STEP}
    turn = ["-0.01*y", "0.01*x", "0"][:dimensions]
    return {
        "headrace_scene": 1,
        "name": "block",
        "dimensions": dimensions,
        "model": model,
        "parameters": settings | parameters,
        "spacing": SPACING,
        "domain": {"min": [-0.5 * length - 0.2] * dimensions, "max": [2.0 * length + 0.2] * dimensions},
        "fluids": [{"name": "block", "shape": {"box": {"min": zero, "max": most}}, "velocity": turn}],
    }


def in_tank(scene, gap=0.0):
    """The same in a container half as high again, all of whose walls are `gap` [m] away from the fluid."""
    scene = copy.deepcopy(scene)
    box = scene["fluids"][0]["shape"]["box"]
    low, high = [x - gap for x in box["min"]], [x + gap for x in box["max"]]
    high[1] += 0.5 * box["max"][1]
    scene["objects"] = [{"name": "tank", "role": "container", "shape": {"box": {"min": low, "max": high}}}]
    return scene


def with_probes(scene, *probes):
    """Probes that are due after each step."""
    scene = copy.deepcopy(scene)
    scene["probes"] = [{"name": f"p{k}", "kind": kind, "every_steps": 1} for k, kind in enumerate(probes)]
    return scene


def level_probe(scene):
    length = scene["fluids"][0]["shape"]["box"]["max"][0]
    low, high = [0.5 * length] * scene["dimensions"], [0.5 * length] * scene["dimensions"]
    low[1], high[1] = 0.0, 1.4 * length
    return {"level": {"from": low, "to": high}}


# ---- truths ----------------------------------------------------------------------------------------------------------

VISCOSITY = ("ViscosityPass",)
TENSION = ("SurfaceStressPass", "TensionPass", "TensionKernel")
WALLS = ("WallPressurePass", "WallField::", "WallObject::", "Walls::place", "nearest_surface")
BODY_FORCE = ("add_body_force", "scene::Formula", "mu::")
ENERGIES = ("EnergyAccount::note", "EnergyAccount::count", "compute_stored_energy")
PROBES = ("ProbeSet::sample_due", "find_nearby", "Probe::sample", "ProbeBoard::append")
FRAMES = ("copy_fields", "copy_reals", "encode_capture", "encode_frame", "publish::(anonymous namespace)::scatter")


class Verdicts:
    def __init__(self):
        self.failed = 0

    def state(self, truth, holds, figures):
        print(f"{'ok    ' if holds else 'FAILED'} {truth}: {figures}", flush=True)
        self.failed += not holds


def check_skipped(bench, verdicts):
    """Not one instruction of what a scene does not have; many where it has it, so that no name is out of date."""
    plain = block(2, 24)
    cases = [
        ("viscosity", VISCOSITY, block(2, 24, viscosity=0.001), {}),
        ("surface tension", TENSION, block(2, 24, surface_tension=0.01), {}),
        ("walls", WALLS, in_tank(plain), {}),
        ("a body force", BODY_FORCE, plain | {"body_force": ["0.001*x", "0"]}, {}),
        ("energies followed", ENERGIES, with_probes(plain, {"energies": {}}), {}),
        ("probes", PROBES, with_probes(plain, level_probe(plain)), {}),
        ("a reader of frames", FRAMES, plain, {"reader": True}),
    ]
    without = bench.count(plain)
    for what, functions, scene, options in cases:
        some = bench.count(scene, **options).of(*functions)
        none = without.of(*functions)
        verdicts.state(f"without {what} no instruction of it", none == 0 and some > 0, f"{none}, with it {some}")


def check_zeros(bench, verdicts):
    """A term that is there with a coefficient of 0 costs what leaving it out does. One pass over the particles that
    does nothing would cost an instruction for each at least: half of one is the tolerance."""
    body_force = block(2, 24) | {"body_force": ["0", "0"]}
    pairs = [
        ("viscosity 0, in a form", block(2, 24), block(2, 24, viscosity=0.0, viscosity_form="morris")),
        ("surface_tension 0, in a form", block(2, 24), block(2, 24, surface_tension=0.0, tension_form="thesis")),
        ("density_diffusion_factor 0", block(2, 24, density_diffusion="none"), block(2, 24, density_diffusion_factor=0.0)),
        ("shifting_factor 0", block(2, 24, shifting=False), block(2, 24, shifting_factor=0.0)),
        (
            "artificial_viscosity 0, in a form",
            block(2, 24, artificial_viscosity=0.0, shifting=False),
            block(2, 24, artificial_viscosity=0.0, shifting=False, artificial_viscosity_form="monaghan"),
        ),
        ("a body force of 0", block(2, 24), body_force),
        ("an empty list of probes", block(2, 24), with_probes(block(2, 24))),
    ]
    for what, without, zero in pairs:
        a, b = bench.count(without), bench.count(zero)
        apart = abs(a.total - b.total) / (a.particles * a.steps)
        verdicts.state(f"{what} costs nothing", apart < 0.5, f"{apart:.4f} instructions a particle-step")


def check_walls(bench, verdicts, dimensions, edges):
    """What a tank costs its fluid, n particles long, grows as the wetted surface, n^(D-1), not as the volume, n^D. Near
    edges two walls are within reach, which makes it a little less even: a quarter is allowed."""
    extra = []
    for edge in (edges[0], edges[-1]):
        free = block(dimensions, edge)
        extra.append(bench.count(in_tank(free)).total - bench.count(free).total)
    ratio = edges[-1] / edges[0]
    growth, surface, volume = extra[1] / extra[0], ratio ** (dimensions - 1), ratio**dimensions
    verdicts.state(f"walls cost with the wetted surface, {dimensions}D", abs(growth / surface - 1.0) < 0.25,
                   f"{edges[0]} to {edges[-1]} particles long they cost {growth:.2f} times as much; surface {surface:g}, "
                   f"volume {volume:g}")


def check_far_walls(bench, verdicts, dimensions, edges):
    """A tank that is nowhere near the fluid costs by its own particles, whose number is a polynomial of degree D - 1 in
    the fluid's length n; what grows as n^D is what it costs the fluid. For each pass over pairs a particle's cluster looks
    whether it has walls, and finds none: some instructions for a few particles, of hundreds that its pairs take. One and a
    half hundredths of its step are allowed."""
    extra, plain = [], []
    for edge in edges:
        free = block(dimensions, edge)
        alone, walled = bench.count(free), bench.count(in_tank(free, gap=6 * SPACING))
        plain.append(alone.per_particle_step())
        extra.append((walled.total - alone.total) / alone.steps)
    everywhere = solve([[edge**power for power in range(dimensions + 1)] for edge in edges], extra)[dimensions]
    verdicts.state(f"walls out of reach cost the fluid next to nothing, {dimensions}D",
                   0.0 <= everywhere < 0.015 * plain[-1],
                   f"{everywhere:.0f} instructions a particle-step, of {plain[-1]:.0f}")


def solve(rows, values):
    """The x with rows x = values, by elimination."""
    system = [list(map(float, row)) + [float(value)] for row, value in zip(rows, values)]
    for k in range(len(system)):
        pivot = max(range(k, len(system)), key=lambda r: abs(system[r][k]))
        system[k], system[pivot] = system[pivot], system[k]
        for r in range(len(system)):
            if r != k:
                factor = system[r][k] / system[k][k]
                system[r] = [a - factor * b for a, b in zip(system[r], system[k])]
    return [row[-1] / row[k] for k, row in enumerate(system)]


def run_server(server, client, folder, scene, has_reader):
    """Functions that a real server runs while a client steps the scene, with a recording or without."""
    profile, document = folder / "server", folder / "server.json"
    document.write_text(json.dumps(scene))
    arguments = [server, "--bind", "tcp://127.0.0.1:*", "--data", str(folder), "--threads", "1", "--json"]
    process = run_callgrind(arguments, profile, stdout=subprocess.PIPE)
    try:
        control = json.loads(process.stdout.readline())["control"]
        commands = [["load", str(document)], ["step", "3"], ["shutdown"]]
        if has_reader:
            start = {"file": "steps.mcap", "every_steps": 1, "overwrite": True}
            commands.insert(1, ["call", "record.start", json.dumps(start)])
        for command in commands:
            subprocess.run([client, "--server", control, *command], check=True, stdout=subprocess.DEVNULL, timeout=300)
        process.wait(timeout=120)
    finally:
        process.kill()
    return read_profile(profile)


def check_server(server, client, bench, verdicts):
    """The same in the server itself, whose publisher is a thread of its own."""
    plain = block(2, 16)
    idle = run_server(server, client, bench.folder, plain, has_reader=False)
    busy = run_server(server, client, bench.folder, with_probes(plain, level_probe(plain)), has_reader=True)
    for what, functions in (("probes", PROBES), ("a reader of frames", FRAMES)):
        none, some = (sum(c for name, c in run.items() if any(f in name for f in functions)) for run in (idle, busy))
        verdicts.state(f"headraced without {what} runs no instruction of it", none == 0 and some > 0,
                       f"{none}, with it {some}")


def check_thesis(bench, verdicts):
    """The thesis's terms share one loop, compiled with and without each of them: one that is off runs no loop with it."""
    def loops(counts):
        """{(with viscosity, with tension)} of the loops over forces that ran."""
        found = (re.search(r"forces_\w+<\d, [^,]+, (true|false), (true|false)>", name) for name in counts.functions)
        return {(match[1] == "true", match[2] == "true") for match in found if match}

    block_3d = block(3, 10, model="thesis", viscosity=0.0, surface_tension=0.0)
    without = bench.count(block_3d)
    for name, value in (("viscosity", 3.5), ("surface_tension", 0.0728)):
        other = bench.count(block(3, 10, model="thesis", **({"viscosity": 0.0, "surface_tension": 0.0} | {name: value})))
        more = (other.total - without.total) / (other.particles * other.steps)
        is_apart = loops(without) == {(False, False)} and loops(other) == {(name == "viscosity", name != "viscosity")}
        verdicts.state(f"the thesis's {name} is paid for only where it is on", is_apart and more > 10.0,
                       f"{more:.0f} instructions a particle-step")
    walled, works = bench.count(in_tank(block_3d)), without.particles * without.steps
    more = (walled.of("advance_in") - without.of("advance_in")) / works
    elsewhere = (walled.total - without.total) / works - more
    verdicts.state("the thesis's collisions cost where particles advance, and there alone", more > 10.0 and abs(elsewhere) < 0.5,
                   f"{more:.1f} instructions a particle-step, elsewhere {elsewhere:.2f}")


# ---- the table -------------------------------------------------------------------------------------------------------


def table_rows(dimensions, edge):
    """(what, scene, base it is compared with, options of count) from bare to complete."""
    bare = {"density_diffusion": "none", "artificial_viscosity": 0.0, "shifting": False}
    default = block(dimensions, edge)
    tank = in_tank(default)
    force = ["0.001*x", "0", "0"][:dimensions]
    direction = [1.0] + [0.0] * (dimensions - 1)
    return [
        ("continuity and pressure only", block(dimensions, edge, **bare), None, {}),
        ("+ density diffusion", block(dimensions, edge, **(bare | {"density_diffusion": "antuono"})), 0, {}),
        ("+ artificial viscosity", block(dimensions, edge, **(bare | {"artificial_viscosity": 0.03})), 0, {}),
        ("+ shifting", block(dimensions, edge, **(bare | {"shifting": True})), 0, {}),
        ("all three: the defaults", default, 0, {}),
        ("defaults + viscosity", block(dimensions, edge, viscosity=0.001), 4, {}),
        ("defaults + surface tension", block(dimensions, edge, surface_tension=0.01), 4, {}),
        ("defaults + uniform body force", default | {"body_force": ["0.001"] + ["0"] * (dimensions - 1)}, 4, {}),
        ("defaults + body force by place", default | {"body_force": force}, 4, {}),
        ("defaults + tank", tank, 4, {}),
        ("defaults + tank of no-slip walls, viscosity", tank | {"parameters": default["parameters"] | {
            "viscosity": 0.001, "wall_slip": "no_slip"}}, 4, {}),
        ("defaults + level probe, each step", with_probes(default, level_probe(default)), 4, {}),
        ("defaults + front probe, each step", with_probes(default, {"front": {"direction": direction}}), 4, {}),
        ("defaults + energies, each step", with_probes(default, {"energies": {}}), 4, {}),
        ("defaults + a frame of x, v, p, each step", default, 4, {"reader": True}),
    ]


def write_table(bench, file):
    sizes = {2: 48, 3: 14}
    columns, lists = {}, {}
    for dimensions, edge in sizes.items():
        rows = table_rows(dimensions, edge)
        counts = [bench.count(scene, **options).per_particle_step() for _, scene, _, options in rows]
        columns[dimensions] = [
            f"{count:,.0f}" + (f" | +{count - counts[base]:,.0f}, {100.0 * (count / counts[base] - 1.0):.1f} %"
                               if base is not None else " |")
            for count, (_, _, base, _) in zip(counts, rows)
        ]
        scene = block(dimensions, edge)
        lists[dimensions] = bench.count(scene, collect="*Wcsph::sort_all*")
    text = [
        "# What each part of a step costs, in instructions",
        "",
        "Written by `tests/bench/plan_costs.py build/tests/bench/headrace_bench --out tests/bench/results/plan_costs.md`;",
        "counted by callgrind, so free of noise. One thread, AVX2 (callgrind knows no AVX-512), `wcsph`, support of 3 spacings,",
        "steps of 5 acoustic steps, a block of fluid that turns slowly and needs no new lists meanwhile. Instructions for each",
        "particle and step; beside them what the part adds. Instructions are not time: those of the pair loops take longer.",
        "",
        "| | " + " | ".join(f"{d}D, {edge**d:,} particles | adds" for d, edge in sizes.items()) + " |",
        "|---|---|---|---|---|",
    ]
    for k, (what, *_) in enumerate(table_rows(2, 2)):
        text.append(f"| {what} | " + " | ".join(columns[d][k] for d in sizes) + " |")
    made = " | ".join(f"{c.total / (c.particles * c.sorts()):,.0f} |" for c in lists.values())
    text += [f"| new order and lists, each time they are made | {made} |", ""]
    pathlib.Path(file).write_text("\n".join(text))
    print("\n".join(text))


def can_count(program):
    """False where valgrind ends the program at an instruction it does not know: on virtual machines that hide what the
    processor has, libraries may use what valgrind believes is missing (seen: rdtscp)."""
    if shutil.which("valgrind") is None:
        print("valgrind is not installed", file=sys.stderr)
        return False
    trial = subprocess.run(["valgrind", "-q", "--tool=none", program, "--help"], stdout=subprocess.DEVNULL,
                           stderr=subprocess.PIPE, text=True, env=ENVIRONMENT, timeout=300)
    if trial.returncode == -signal.SIGILL:
        print(f"valgrind cannot run {program} on this machine:\n{trial.stderr}", file=sys.stderr)
        return False
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench", help="headrace_bench")
    parser.add_argument("--check", action="store_true", help="state the truths")
    parser.add_argument("--server", nargs=2, metavar=("HEADRACED", "HEADRACE"), help="the server's truths, too")
    parser.add_argument("--out", help="write the table of costs to this file")
    options = parser.parse_args()
    if not can_count(options.bench):
        return SKIPPED
    bench, verdicts = Bench(options.bench), Verdicts()
    try:
        if options.check:
            check_skipped(bench, verdicts)
            check_zeros(bench, verdicts)
            check_walls(bench, verdicts, 2, [16, 48])
            check_walls(bench, verdicts, 3, [8, 14])
            check_far_walls(bench, verdicts, 2, [16, 24, 48])
            check_far_walls(bench, verdicts, 3, [6, 8, 10, 12])
            check_thesis(bench, verdicts)
        if options.server:
            check_server(*options.server, bench, verdicts)
        if options.out:
            write_table(bench, options.out)
    finally:
        bench.close()
    return 1 if verdicts.failed else 0


if __name__ == "__main__":
    sys.exit(main())
