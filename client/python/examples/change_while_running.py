#!/usr/bin/env python3
"""Turns gravity round while the run goes on, and shows the sloshing in the speeds.

    change_while_running.py [--until 2.0]
"""

import argparse

import headrace
import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("--until", type=float, default=2.0, help="simulated seconds")
args = parser.parse_args()

with headrace.Simulation() as sim:
    sim.load("dam_break_2d")
    g = np.array(sim.params["gravity"])
    print(sim.params.info("gravity"))
    # The frames are lossless: with a window of 1 the run waits for this loop, a frame ahead of it at most.
    for frame in sim.stream(["velocity"], every=args.until / 20, until=args.until, window=1):
        if frame.seq == 10:
            changed = sim.params.set(gravity=-g)
            print(f"gravity turned round before step {changed.step + 1}, t {changed.time:.3f} s")
        speed = np.linalg.norm(frame.velocity, axis=1)
        rms = np.sqrt(np.mean(speed**2))
        print(f"t {frame.time:5.2f} s  rms speed {rms:6.3f} m/s  " + "#" * round(20 * rms))
