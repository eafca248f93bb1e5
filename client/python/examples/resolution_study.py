#!/usr/bin/env python3
"""How the error falls with the spacing: Taylor-Green vortices at Re 100 against their exact solution.

    resolution_study.py [--particles 16 24 36] [--until 0.5]
"""

import argparse

import headrace
import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("--particles", type=int, nargs="+", default=[16, 24, 36], help="along a side of the square")
parser.add_argument("--until", type=float, default=0.5, help="simulated seconds")
args = parser.parse_args()


def exact(x: np.ndarray, t: float) -> np.ndarray:
    """Velocity at the places x, shape (n, 2) [m/s]: decays as exp(-8 pi^2 t/Re), Re 100."""
    a, b = 2 * np.pi * x.T
    return np.exp(-8 * np.pi**2 * t / 100) * np.column_stack([-np.cos(a) * np.sin(b), np.sin(a) * np.cos(b)])


with headrace.Simulation() as sim:
    sim.load("taylor_green")
    scene = sim.scene
    spacings, errors = 1 / np.array(args.particles), []
    for spacing in spacings:
        sim.load({**scene, "spacing": spacing})
        sim.run(until=args.until)
        frame = sim.snapshot(["position", "velocity"], precision="f8")
        reference = exact(frame.position, frame.time)
        # L2 norms over the particles, relative.
        errors.append(np.linalg.norm(frame.velocity - reference) / np.linalg.norm(reference))
        print(f"spacing {spacing:.5f} m   particles {frame.particle_count:6,}   error {100 * errors[-1]:.3f} %")

# error ~ spacing^order: the slope of a straight line through the logarithms.
order = np.polyfit(np.log(spacings), np.log(errors), 1)[0]
print(f"observed order of convergence {order:.2f}")
