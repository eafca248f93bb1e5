#!/usr/bin/env python3
"""Watches a probe while the run goes on: wall pressure and water levels of a dam break, redrawn as samples come.

    live_probe.py [--until 1.0] [--out live_probe.png]

With asyncio: the run in one task, the plot in another. Without a display set MPLBACKEND=Agg.
"""

import argparse
import asyncio

import matplotlib.pyplot as plt
from headrace import aio

parser = argparse.ArgumentParser()
parser.add_argument("--until", type=float, default=1.0, help="simulated seconds")
parser.add_argument("--out", default="live_probe.png")
args = parser.parse_args()


async def main() -> None:
    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(6, 5), layout="constrained")
    upper.set(ylabel="wall pressure [Pa]", title="Dam break of Lobovsky et al. 2014, 2D")
    lower.set(ylabel="level [m]", xlabel="time [s]")
    plt.ion()
    async with aio.Simulation() as sim:
        await sim.load("water_dam_break")
        lines = {"P2": upper.plot([], [], label="P2")[0],
                 **{name: lower.plot([], [], label=name)[0] for name in ("H1", "H2", "H3", "H4")}}
        upper.legend(), lower.legend()

        run = asyncio.create_task(sim.run(until=args.until))
        while not run.done():
            await asyncio.wait([run], timeout=0.2)
            for name, line in lines.items():
                series = await sim.probes[name]
                line.set_data(series.times, series.values)
            for axes in (upper, lower):
                axes.relim(), axes.autoscale_view()
            plt.pause(0.001)
        job = run.result()
        print(f"{job.reason}: {job.steps} steps in {job.wall_s:.1f} s")
    figure.savefig(args.out, dpi=120)


asyncio.run(main())
