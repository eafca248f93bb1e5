#!/usr/bin/env python3
"""Dam break with a panel: lets the fluid come to rest, takes the panel away, and follows the front of the wave.

    dam_break.py [--settle at-rest] [--for 1.0]
"""

import argparse

import headrace

parser = argparse.ArgumentParser()
parser.add_argument("--settle", default="at-rest", help="end of the run before the panel is removed")
parser.add_argument("--for", dest="duration", type=float, default=1.0, help="simulated seconds afterwards")
args = parser.parse_args()

with headrace.Simulation() as sim:
    loaded = sim.load("dam_break")
    print(f"{loaded.particles} particles behind a panel")

    job = sim.run(until=args.settle)
    print(f"{job.reason}: step {job.step}, t {job.time:.2f} s")

    sim.objects.remove("panel")
    for frame in sim.stream(["position", "velocity"], every=0.1, until=f"+{args.duration}"):
        front = frame.position[:, 0].max()
        fastest = (frame.velocity**2).sum(axis=1).max() ** 0.5
        print(f"t {frame.time:5.2f} s   front at {front:.3f} m   fastest {fastest:.2f} m/s")
