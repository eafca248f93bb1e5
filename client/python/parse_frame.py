"""Read binary frames of headraced with NumPy alone."""

import zlib

import numpy as np

HEADER = np.dtype([("topic", "S16"), ("magic", "S8"), ("version", "<u2"), ("dimensions", "<u2"),
                   ("field_count", "<u4"), ("session", "<u8"), ("seq", "<u8"), ("step", "<u8"), ("time", "<f8"),
                   ("wall_clock", "<f8"), ("particle_count", "<u8"), ("total_bytes", "<u8"), ("reserved", "V36"),
                   ("crc", "<u4")])
FIELD = np.dtype([("name", "S16"), ("dtype", "S8"), ("components", "<u2"), ("encoding", "<u2"), ("reserved", "<u4"),
                  ("offset", "<u8"), ("bytes", "<u8"), ("scale", "<f8"), ("bias", "<f8")])


def parse_frame(message):
    """Return (header, arrays) of one frame given as bytes; ValueError when it is none or is damaged.

    header: NumPy record; `time` simulated [s], `step`, `seq`, `particle_count`, `wall_clock` [s since 1970, UTC].
    arrays: dict of read-only views into `message`, one row per particle, ascending by particle id:
      id (n,) | position (n, d) [m] | velocity (n, d) [m/s] | acceleration (n, d) [m/s^2] | density (n,) [kg/m^3] |
      pressure (n,) [Pa], with d = header["dimensions"]; only those that were asked for.
    """
    head = np.frombuffer(message, HEADER, 1)[0]
    if head["magic"] != b"HRFRAME1" or head["version"] != 1 or head["total_bytes"] != len(message):
        raise ValueError("no frame of version 1, or not all of it")
    if head["crc"] != zlib.crc32(message[128:], zlib.crc32(message[:124])):
        raise ValueError("damaged frame: its CRC does not match")
    arrays = {}
    for f in np.frombuffer(message, FIELD, head["field_count"], 128):
        values = np.frombuffer(message, f["dtype"].decode(), int(f["bytes"]) // int(f["dtype"][2:]), f["offset"])
        arrays[f["name"].decode()] = values.reshape(-1, f["components"]) if f["components"] > 1 else values
    return head, arrays
