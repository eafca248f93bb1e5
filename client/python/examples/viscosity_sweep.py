#!/usr/bin/env python3
"""The same dam break with several viscosities: how far the front has come, as a plot.

    viscosity_sweep.py [--viscosities 0.5 2 5 10] [--until 0.3] [--out viscosity_sweep.png]
"""

import argparse

import headrace
import matplotlib.pyplot as plt

parser = argparse.ArgumentParser()
parser.add_argument("--viscosities", type=float, nargs="+", default=[0.5, 2.0, 5.0, 10.0], help="[Pa s]")
parser.add_argument("--until", type=float, default=0.3, help="simulated seconds")
parser.add_argument("--out", default="viscosity_sweep.png")
args = parser.parse_args()

figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
with headrace.Simulation() as sim:
    for viscosity in args.viscosities:
        sim.load("dam_break_2d", parameters={"viscosity": viscosity})
        sim.probes.add("tip", {"front": {}}, interval=0.01)
        sim.run(until=args.until)
        tip = sim.probes["tip"]
        axes.plot(tip.times, tip.values, label=f"{viscosity:g} {sim.params.info('viscosity').unit}")
        print(f"viscosity {viscosity:g}: front at {tip.values[-1]:.3f} {tip.unit}")
axes.set(xlabel="time [s]", ylabel=f"front [{tip.unit}]", title="Dam break in 2D, thesis's model")
axes.legend(title="viscosity")
figure.savefig(args.out, dpi=120)
