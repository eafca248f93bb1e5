"""Parse a frame that C++ wrote, with the ten lines of the README.

Usage: check_parse_frame.py FRAME.bin, frame 7 of write_sample_recording (values: tests/support/frame_samples.h)
"""

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "client" / "python"))
from parse_frame import parse_frame  # noqa: E402


def refuses(message):
    try:
        parse_frame(message)
    except ValueError:
        return True
    return False


def main():
    message = pathlib.Path(sys.argv[1]).read_bytes()
    head, arrays = parse_frame(message)
    assert head["topic"] == b"sample" and head["seq"] == 7 and head["step"] == 700
    assert head["time"] == 0.07 and head["wall_clock"] == 1.7e9 + 7
    assert head["session"] == 0x0123456789ABCDEF and head["dimensions"] == 3 and head["particle_count"] == 10

    i = np.arange(10)
    row, c = np.meshgrid(i, np.arange(3), indexing="ij")
    expected = {"id": i, "position": row + 0.25 * c + 7, "velocity": c + 0.5 - row, "density": 1000 + i,
                "pressure": 10 * i - 7}
    assert list(arrays) == list(expected), list(arrays)
    for name, values in expected.items():
        assert arrays[name].shape == values.shape, name
        assert arrays[name].dtype == ("<u4" if name == "id" else "<f4"), name
        assert (arrays[name] == values).all(), name

    # Damage anywhere is noticed: each byte flipped, each length cut.
    for k in range(len(message)):
        flipped = bytearray(message)
        flipped[k] ^= 0x10
        assert refuses(bytes(flipped)), k
        assert refuses(message[:k]), k


if __name__ == "__main__":
    main()
