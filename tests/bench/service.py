#!/usr/bin/python3
"""Times the service around the solver, on a headraced of its own.

  latency    sim.status while ~10^6 particles are stepped: p50, p99 and largest time of a call
  recording  a frame of every step of ~10^5 particles: frames, gaps, and the slow-down against no recording
  live       steps per second with and without a live subscriber

One line per case. With and without take turns, so that a slow minute of the machine hits both alike.
"""
import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import zmq

SCALE_UNITS = ("m", "1/m", "kg", "kg/m", "s")  # parameters that belong to one spacing


class Server:
    """A headraced with free ports and a folder of its own, ended with this process."""

    def __init__(self, program, threads):
        self.folder = tempfile.TemporaryDirectory(prefix="headrace-bench-")
        arguments = [program, "--bind", "tcp://127.0.0.1:*", "--data", self.folder.name, "--json"]
        if threads:
            arguments += ["--threads", str(threads)]
        self.process = subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"service.py: {program} ended before it was ready")
        self.ready = json.loads(line)
        self.context = zmq.Context()
        self.control = Peer(self.context, self.ready["control"])
        self.frames_endpoint = self.ready["frames"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(timeout=60)
        self.control.socket.close(0)
        self.context.term()
        self.folder.cleanup()


class Peer:
    """JSON-RPC over a DEALER socket."""

    def __init__(self, context, endpoint):
        self.socket = context.socket(zmq.DEALER)
        self.socket.linger = 0
        self.socket.connect(endpoint)
        self.last_id = 0

    def call(self, method, timeout_s=900, **params):
        self.last_id += 1
        request = {"jsonrpc": "2.0", "id": self.last_id, "method": method, "params": params}
        self.socket.send(json.dumps(request).encode())
        if not self.socket.poll(timeout_s * 1000):
            sys.exit(f"service.py: no reply to {method} within {timeout_s} s")
        reply = json.loads(self.socket.recv_multipart()[0])
        if "error" in reply:
            sys.exit(f"service.py: {method}: {reply['error']}")
        return reply["result"]


class Subscriber(threading.Thread):
    """Reads a live stream as fast as frames come, until told to stop."""

    def __init__(self, context, endpoint, topic):
        super().__init__(daemon=True)
        self.context, self.endpoint = context, endpoint
        self.topic = topic.encode() + b"\0"
        self.ending = threading.Event()
        self.frames = self.bytes = 0

    def run(self):
        socket = self.context.socket(zmq.SUB)
        socket.linger = 0
        socket.connect(self.endpoint)
        socket.subscribe(self.topic)
        while not self.ending.is_set():
            if socket.poll(50):
                self.bytes += len(socket.recv(copy=False))
                self.frames += 1
        socket.close()

    def stop(self):
        self.ending.set()
        self.join()


def load(server, preset, particles, warmup):
    """Loads a preset, refined to about so many particles, without its panel, and steps it."""
    control = server.control
    loaded = control.call("scene.load", scene=preset)
    scene = control.call("scene.get")
    if particles:
        factor = (particles / loaded["particles"]) ** (1 / scene["dimensions"])
        scale = {p["name"] for p in control.call("params.get")["parameters"] if p["unit"] in SCALE_UNITS}
        scene["spacing"] /= factor
        scene["parameters"] = {k: v for k, v in scene.get("parameters", {}).items() if k not in scale}
    scene["objects"] = [o for o in scene["objects"] if o["name"] != "panel"]
    scene["events"] = []
    loaded = control.call("scene.load", scene=scene)
    control.call("sim.step", steps=warmup)
    return loaded["particles"]


def timed_steps(server, steps):
    """Steps per wall second, by the server's own clock."""
    job = server.control.call("sim.step", steps=steps)
    return job["steps"] / job["wall_s"]


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def latency(server, options):
    particles = load(server, options.preset, options.particles or 1e6, 2)
    server.control.call("sim.run", until={})
    times, first = [], server.control.call("sim.status")
    for _ in range(options.calls):
        start = time.perf_counter()
        server.control.call("sim.status")
        times.append((time.perf_counter() - start) * 1e3)
        time.sleep(options.pause)  # spreads the calls over many steps
    last = server.control.call("sim.status")
    server.control.call("sim.cancel")
    print(f"latency    N {particles}  calls {len(times)}  steps meanwhile {last['step'] - first['step']}  "
          f"sim.status ms: p50 {percentile(times, 0.50):.3f}  p99 {percentile(times, 0.99):.3f}  max {max(times):.3f}")
    return last["step"] > first["step"]


def recording(server, options):
    particles = load(server, options.preset, options.particles or 1e5, options.warmup)
    plain, recorded, frames, gaps, size = [], [], 0, 0, 0
    for turn in range(options.repeat):
        plain.append(timed_steps(server, options.steps))
        server.control.call("record.start", file=f"bench{turn}.mcap", every_steps=1, overwrite=True)
        recorded.append(timed_steps(server, options.steps))
        done = server.control.call("record.stop")
        frames, gaps, size = frames + done["frames"], gaps + done["gaps"], size + done["bytes"]
    expected = options.repeat * (options.steps + 1)  # the first frame is the state before the first step
    ratio = statistics.median(b / a for a, b in zip(plain, recorded))
    print(f"recording  N {particles}  frames {frames} of {expected}  gaps {gaps}  {size / frames / 1e6:.2f} MB each  "
          f"steps/s {statistics.median(plain):.2f} without, {statistics.median(recorded):.2f} with, ratio {ratio:.3f}")
    return frames == expected and gaps == 0


def live(server, options):
    particles = load(server, options.preset, options.particles or 1e5, options.warmup)
    stream = server.control.call("stream.open", mode="live", rate=options.rate)["stream"]
    alone, watched, frames, size = [], [], 0, 0
    for _ in range(options.repeat):
        alone.append(timed_steps(server, options.steps))
        subscriber = Subscriber(server.context, server.frames_endpoint, stream)
        subscriber.start()
        watched.append(timed_steps(server, options.steps))
        subscriber.stop()
        frames, size = frames + subscriber.frames, size + subscriber.bytes
    ratio = statistics.median(b / a for a, b in zip(alone, watched))
    print(f"live       N {particles}  at most {options.rate:g} frames/s  received {frames}  "
          f"{size / max(frames, 1) / 1e6:.2f} MB each  steps/s {statistics.median(alone):.2f} without, "
          f"{statistics.median(watched):.2f} with a subscriber, ratio {ratio:.3f}")
    return frames > 0


CASES = {"latency": latency, "recording": recording, "live": live}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", nargs="*", default=list(CASES), help=f"any of {', '.join(CASES)} (default: all)")
    parser.add_argument("--server", required=True, help="the headraced program")
    parser.add_argument("--preset", default="dam_break")
    parser.add_argument("--particles", type=float, help="about so many, instead of 10^6 or 10^5")
    parser.add_argument("--threads", type=int, help="of the solver (default: as many as cores)")
    parser.add_argument("--calls", type=int, default=1000)
    parser.add_argument("--pause", type=float, default=0.02, help="[s] between the calls of latency")
    parser.add_argument("--warmup", type=int, default=20, help="steps before the clock starts")
    parser.add_argument("--steps", type=int, default=50, help="steps of a window")
    parser.add_argument("--repeat", type=int, default=5, help="windows with, and as many without")
    parser.add_argument("--rate", type=float, default=30.0, help="live frames per second at most")
    options = parser.parse_args()
    unknown = [case for case in options.case if case not in CASES]
    if unknown:
        parser.error(f"no case {unknown[0]!r}; there are {', '.join(CASES)}")

    held = True
    for case in options.case:
        with Server(options.server, options.threads) as server:
            held = CASES[case](server, options) and held
        sys.stdout.flush()
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
