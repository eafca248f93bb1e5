#!/usr/bin/env python3
"""Reads a converted recording (.pvd with its .vtp files) by real VTK and says what is wrong with it.

usage: check_vtp.py FILE.pvd [--frames N] [--points N] [--csv FOLDER/STEM_frames.csv]

Always checked: every listed file exists and reads without a complaint of VTK's, each particle is a vertex, numbers are
finite, times ascend and agree with the files' own. With --csv: all numbers equal those of the CSV conversion of the
same recording. Exit status: 0 right, 1 wrong, 77 VTK for Python is not installed.
"""
import argparse
import csv
import math
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkCommand
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError:
    print("skipped: VTK for Python is not installed (python3-vtk9)", file=sys.stderr)
    sys.exit(77)


class Wrong(Exception):
    """What is wrong, in one sentence."""


def expect(condition, message):
    if not condition:
        raise Wrong(message)


def read_vtp(file):
    expect(file.is_file(), f"{file} is listed but does not exist")
    complaints = []
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    for event in (vtkCommand.ErrorEvent, vtkCommand.WarningEvent):
        reader.AddObserver(event, lambda *_: complaints.append(file))
    reader.Update()
    expect(not complaints and reader.GetErrorCode() == 0, f"VTK cannot read {file}")
    return reader.GetOutput()


def arrays_of(data):
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


def check_particles(file, time, points_wanted):
    mesh = read_vtp(file)
    count = mesh.GetNumberOfPoints()
    expect(points_wanted is None or count == points_wanted, f"{file} has {count} points, not {points_wanted}")
    expect(mesh.GetNumberOfVerts() == count == mesh.GetNumberOfCells(), f"{file}: not one vertex for each point")
    own_time = mesh.GetFieldData().GetArray("TimeValue")
    expect(own_time is not None, f"{file} has no TimeValue")
    expect(own_time.GetValue(0) == time, f"{file} says {own_time.GetValue(0)} s, the collection {time} s")

    radius = mesh.GetFieldData().GetArray("particle_radius")
    expect(radius is not None and radius.GetValue(0) > 0, f"{file} has no particle_radius")

    arrays = arrays_of(mesh.GetPointData())
    expect("position" not in arrays, f"{file}: positions are the points, not an array")
    if "velocity" in arrays:
        active = mesh.GetPointData().GetVectors()
        expect(active is not None and active.GetName() == "velocity", f"{file}: velocity is not the active vector")
    for row in range(count):  # each vertex shows its own point
        if row in (0, count // 2, count - 1):
            expect(mesh.GetCell(row).GetPointId(0) == row, f"{file}: vertex {row} is at another point")
    if count:
        arrays["position"] = vtk_to_numpy(mesh.GetPoints().GetData())
    for name, values in arrays.items():
        expect(len(values) == count, f"{file}: {name} has {len(values)} rows, not {count}")
        expect(all(map(math.isfinite, values.ravel().tolist())), f"{file}: {name} holds a number that is not finite")
    return arrays


def check_objects(file):
    mesh = read_vtp(file)
    names = mesh.GetFieldData().GetAbstractArray("names")
    numbers = arrays_of(mesh.GetCellData()).get("object", [])
    expect(len(numbers) == mesh.GetNumberOfCells(), f"{file}: `object` does not number the cells")
    if len(numbers):
        expect(names is not None and names.GetNumberOfValues() > max(numbers), f"{file}: an object has no name")


def check_against_csv(arrays, file, source):
    """CSV columns are `velocity_x [m/s]`; VTK vectors have three components, also in 2D."""
    with open(source, newline="") as lines:
        rows = list(csv.reader(lines))
    for column, title in enumerate(rows[0]):
        name = title.split(" [")[0]
        component = None
        if name[-2:] in ("_x", "_y", "_z"):
            name, component = name[:-2], "xyz".index(name[-1])
        expect(name in arrays, f"{file} lacks {name}, which {source} has")
        values = arrays[name] if component is None else arrays[name][:, component]
        expect(len(rows) - 1 == len(values), f"{source} has {len(rows) - 1} particles, {file} {len(values)}")
        for row, value in zip(rows[1:], values):
            # The text is the shortest that gives back the stored bits, in the stored precision.
            expect(value.dtype.type(row[column]) == value, f"{file}: {title} is {value}, not {row[column]}")


def check_collection(collection, arguments):
    entries = [(float(entry.get("timestep")), int(entry.get("part")), entry.get("file"))
               for entry in ElementTree.parse(collection).iter("DataSet")]
    frames = [(time, file) for time, part, file in entries if part == 0]
    expect(frames, f"{collection} lists no frames")
    expect(arguments.frames is None or len(frames) == arguments.frames,
           f"{collection} lists {len(frames)} frames, not {arguments.frames}")
    expect(all(a[0] < b[0] for a, b in zip(frames, frames[1:])), f"{collection}: times do not ascend")
    expect(not any(pathlib.PurePath(file).is_absolute() for _, _, file in entries), f"{collection}: absolute paths")

    csv_frames = None
    if arguments.csv:
        with open(arguments.csv, newline="") as lines:
            csv_frames = list(csv.DictReader(lines))
        expect(len(csv_frames) == len(frames), f"{arguments.csv} lists {len(csv_frames)} frames, not {len(frames)}")
    for k, (time, file) in enumerate(frames):
        arrays = check_particles(collection.parent / file, time, arguments.points)
        if csv_frames:
            expect(float(csv_frames[k]["time [s]"]) == time, f"{arguments.csv}: frame {k} is not at {time} s")
            check_against_csv(arrays, file, arguments.csv.parent / csv_frames[k]["file"])
    objects = sorted({file for _, part, file in entries if part == 1})
    for file in objects:
        check_objects(collection.parent / file)
    return len(frames), len(objects)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("collection", type=pathlib.Path)
    parser.add_argument("--frames", type=int, help="how many frames there must be")
    parser.add_argument("--points", type=int, help="how many particles each must have")
    parser.add_argument("--csv", type=pathlib.Path, help="index of the CSV conversion to compare with")
    arguments = parser.parse_args()
    try:
        frames, objects = check_collection(arguments.collection, arguments)
    except (Wrong, OSError, ElementTree.ParseError) as wrong:
        print(f"check_vtp: {wrong}", file=sys.stderr)
        return 1
    print(f"{frames} frames and {objects} sets of objects read by VTK")
    return 0


if __name__ == "__main__":
    sys.exit(main())
