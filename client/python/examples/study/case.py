#!/usr/bin/env python3
"""One case of a parameter study, on a server of its own: prints one CSV line. `parallel.sh` and `slurm.sh` run many.

    case.py VISCOSITY [--until 0.6] [--threads 1]
"""

import argparse

import headrace

parser = argparse.ArgumentParser()
parser.add_argument("viscosity", type=float, help="[Pa s]")
parser.add_argument("--until", type=float, default=0.6, help="simulated seconds")
parser.add_argument("--threads", type=int, default=1, help="of the solver")
args = parser.parse_args()

with headrace.Simulation(threads=args.threads) as sim:
    sim.load("dam_break_2d", parameters={"viscosity": args.viscosity})
    sim.probes.add("tip", {"front": {}}, interval=0.01)
    job = sim.run(until=args.until)
    print(f"{args.viscosity:g},{sim.probes['tip'].values[-1]:.6f},{job.steps}")
