#!/usr/bin/env python3
"""The first conversation: loads a scene if there is none, computes ten steps, tells where the run is."""
import json, os, sys, zmq

socket = zmq.Context().socket(zmq.REQ)
socket.connect(os.environ.get("HEADRACE_SERVER", "tcp://127.0.0.1:5755"))

def call(method, **params):
    socket.send_json({"jsonrpc": "2.0", "id": 1, "method": method, "params": params})
    reply = socket.recv_json()
    return reply["result"] if "result" in reply else sys.exit(json.dumps(reply["error"]))

if call("sim.status")["state"] == "empty":
    call("scene.load", scene="dam_break")
print(call("hello")["version"], call("sim.step", steps=10))
