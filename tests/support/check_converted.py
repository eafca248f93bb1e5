#!/usr/bin/env python3
"""Reads the .npz, .ply, long and wide .csv files of one recording with NumPy, and says where they differ.

usage: check_converted.py FOLDER STEM --frames N [--vtk]

The wide CSV files are the reference: their digits give back the stored bits. --vtk: reads the .ply files with VTK as
well. Exit status: 0 right, 1 wrong, 77 VTK is asked for and not installed.
"""
import argparse
import csv
import pathlib
import sys

import numpy as np

PLY_TYPES = {"uint": "<u4", "float": "<f4", "double": "<f8"}


class Wrong(Exception):
    """What is wrong, in one sentence."""


def expect(condition, message):
    if not condition:
        raise Wrong(message)


def read_wide(file):
    """{"velocity_x": strings} of one frame."""
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.reader(lines))
    return {title.split(" [")[0]: np.array([row[k] for row in rows[1:]]) for k, title in enumerate(rows[0])}


def columns_of(fields):
    """Arrays by field name, vectors (n, d), to columns by name."""
    columns = {}
    for name, values in fields.items():
        if values.ndim == 1:
            columns[name] = values
        else:
            columns.update({f"{name}_{'xyz'[axis]}": values[:, axis] for axis in range(values.shape[1])})
    return columns


def compare(columns, wide, file):
    for name, digits in wide.items():
        expect(name in columns, f"{file} lacks {name}")
        values = columns[name]
        expect(np.array_equal(values, digits.astype(values.dtype)), f"{file}: {name} differs from the CSV file")


def check_npz(file, wide, moment):
    with np.load(file) as archive:
        fields = {name: archive[name] for name in archive.files}
    expect(fields.pop("time") == float(moment["time [s]"]), f"{file}: another time")
    expect(fields.pop("step") == int(moment["step"]), f"{file}: another step")
    count = int(moment["particles"])
    for name, values in fields.items():
        expect(len(values) == count, f"{file}: {name} has the shape {values.shape}")
        expect(values.dtype == ("<u4" if name == "id" else "<f4"), f"{file}: {name} is {values.dtype}")
    expect(set(columns_of(fields)) == set(wide), f"{file} holds {sorted(fields)}")
    compare(columns_of(fields), wide, file)


def check_ply(file, wide):
    data = file.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode("ascii").splitlines()
    expect(lines[:2] == ["ply", "format binary_little_endian 1.0"], f"{file} begins with {lines[:2]}")
    properties = [line.split()[1:] for line in lines if line.startswith("property ")]
    dtype = np.dtype([(name, PLY_TYPES[kind]) for kind, name in properties])
    vertices = np.frombuffer(data, dtype, offset=end)
    named = {f"position_{name}" if name in "xyz" else name: vertices[name] for name in dtype.names}
    expect(np.all(named["position_z"] == 0) or "position_z" in wide, f"{file}: a flat scene has a height")
    compare(named, wide, file)


def check_ply_by_vtk(file, wide):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOPLY import vtkPLYReader

    reader = vtkPLYReader()
    reader.SetFileName(str(file))
    reader.Update()
    points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData())
    compare({f"position_{axis}": points[:, k] for k, axis in enumerate("xyz")},
            {name: digits for name, digits in wide.items() if name.startswith("position")}, file)


def check_long(file, wides, moments):
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    expect(list(rows[0]) == ["time", "step", "id", "field", "component", "value"], f"{file} has columns {list(rows[0])}")
    found = {(row["step"], row["id"], row["field"] + ("_" if row["component"] else "") + row["component"]): row
             for row in rows}
    expect(len(found) == len(rows), f"{file}: a value is told twice")
    wanted = 0
    for wide, moment in zip(wides, moments):
        for name, digits in wide.items():
            if name == "id":
                continue
            for particle, text in zip(wide["id"], digits):
                row = found.get((moment["step"], particle, name))
                expect(row is not None, f"{file} lacks {name} of particle {particle} in step {moment['step']}")
                expect(row["value"] == text and row["time"] == moment["time [s]"], f"{file}: {row} is not {text}")
                wanted += 1
    expect(wanted == len(rows), f"{file} has {len(rows)} values, not {wanted}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("stem")
    parser.add_argument("--frames", type=int, required=True)
    parser.add_argument("--vtk", action="store_true")
    arguments = parser.parse_args()
    with open(arguments.folder / f"{arguments.stem}_frames.csv", newline="", encoding="utf-8") as lines:
        moments = list(csv.DictReader(lines))
    wides = [read_wide(arguments.folder / moment["file"]) for moment in moments]
    try:
        expect(len(moments) == arguments.frames, f"{len(moments)} frames, not {arguments.frames}")
        for moment, wide in zip(moments, wides):
            file = arguments.folder / moment["file"]
            if arguments.vtk:
                check_ply_by_vtk(file.with_suffix(".ply"), wide)
                continue
            check_npz(file.with_suffix(".npz"), wide, moment)
            check_ply(file.with_suffix(".ply"), wide)
        if not arguments.vtk:
            check_long(arguments.folder / f"{arguments.stem}_long.csv", wides, moments)
    except ImportError:
        print("skipped: VTK for Python is not installed (python3-vtk9)", file=sys.stderr)
        return 77
    except (Wrong, OSError, ValueError) as wrong:
        print(f"check_converted: {wrong}", file=sys.stderr)
        return 1
    print(f"{len(moments)} frames agree")
    return 0


if __name__ == "__main__":
    sys.exit(main())
