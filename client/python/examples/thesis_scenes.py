#!/usr/bin/env python3
"""The three scenes of Staubach 2010, Figs. 4.1 to 4.3, as one picture: side views, coloured by speed.

    thesis_scenes.py [--rest at-rest] [--scale 1.0] [--out thesis_scenes.png]
"""

import argparse

import headrace
import matplotlib.pyplot as plt
import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("--rest", default="at-rest", help="end of the dam's run before its panel is removed")
parser.add_argument("--scale", type=float, default=1.0, help="of the instants shown")
parser.add_argument("--out", default="thesis_scenes.png")
args = parser.parse_args()

SCENES = {"bowl": [0, 0.2, 0.4, 0.7, 1.2], "dam_break": [0, 0.15, 0.3, 0.6, 1], "obstacle": [0, 0.15, 0.3, 0.5, 0.8]}

figure, rows = plt.subplots(3, 5, figsize=(13, 7), layout="constrained")
with headrace.Simulation() as sim:
    for row, (scene, instants) in zip(rows, SCENES.items()):
        sim.load(scene)
        if scene == "dam_break":
            print(f"dam_break: {sim.run(until=args.rest).reason}")
            sim.objects.remove("panel")
        start = sim.status().time
        spheres = [each.shape.sphere for each in sim.objects.all().values() if each.shape.sphere]
        low, high = (np.array(sim.scene["domain"][end]) for end in ("min", "max"))
        for axes, instant in zip(row, instants):
            if instant > 0:
                sim.run(until=start + args.scale * instant)
            frame = sim.snapshot(["position", "velocity"])
            speed = np.linalg.norm(frame.velocity, axis=1)
            dots = axes.scatter(*frame.position[:, :2].T, c=speed, s=2, cmap="viridis", vmin=0, vmax=2.5)
            axes.set(title=f"{scene}, t {frame.time:.2f} s", aspect="equal", xticks=[], yticks=[],
                     xlim=(low[0], high[0]), ylim=(low[1], high[1]))
            for sphere in spheres:
                axes.add_patch(plt.Circle(sphere.center[:2], sphere.radius, fill=False, lw=0.5))
        print(f"{scene}: {frame.particle_count} particles, step {frame.step}")
figure.colorbar(dots, ax=rows, label="speed [m/s]", shrink=0.6)
figure.savefig(args.out, dpi=110)
