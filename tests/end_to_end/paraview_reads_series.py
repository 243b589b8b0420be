"""Lets ParaView read a series of scarp and compares what it sees with the run's own record.

    pvbatch paraview_reads_series.py DIRECTORY

DIRECTORY holds run.json and one .pvd with its frames.  Exit code 1 and a line for each difference
if ParaView sees other times, numbers of points, fields or corners of the body than there should be.
"""

import json
import math
import pathlib
import sys
import xml.etree.ElementTree as xml

from paraview import servermanager, simple


def listed_frames(series):
    """The (time, file) pairs that the .pvd lists."""
    return [
        (float(entry.get("timestep")), series.parent / entry.get("file"))
        for entry in xml.parse(series).iter("DataSet")
    ]


def differences(directory):
    """Yields a line for each thing that is not as recorded; prints what ParaView sees."""
    run = json.loads((directory / "run.json").read_text(encoding="utf-8"))
    (series,) = directory.glob("*.pvd")
    frames = listed_frames(series)
    if len(frames) != run["frames"]:
        yield f"{series.name} lists {len(frames)} frames, run.json says {run['frames']}"

    reader = simple.PVDReader(FileName=str(series))
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    print(f"{series}: {len(times)} times, {times[0]:g} s to {times[-1]:g} s")
    if times != [time for time, _ in frames]:
        yield f"times {times} are not those of {series.name}"
    if not math.isclose(times[-1], run["stop_time_s"], rel_tol=1e-9):
        yield f"the last time is {times[-1]} s, run.json stops at {run['stop_time_s']} s"

    first_fields = None
    for time, file in frames:
        reader.UpdatePipeline(time)
        data = servermanager.Fetch(reader)
        fields = {
            data.GetPointData().GetArrayName(i): data.GetPointData().GetArray(i)
            for i in range(data.GetPointData().GetNumberOfArrays())
        }
        first_fields = first_fields or sorted(fields)
        points, cells = data.GetNumberOfPoints(), data.GetNumberOfCells()
        if (points, cells) != (run["points"], run["points"]):
            yield f"{file.name}: {points} points, {cells} cells, run.json says {run['points']}"
        if not fields or sorted(fields) != first_fields:
            yield f"{file.name}: fields {sorted(fields)} instead of {first_fields}"
        for name, values in fields.items():
            if values.GetNumberOfTuples() != points:
                yield f"{file.name}: {values.GetNumberOfTuples()} values of {name}"
            if not all(math.isfinite(bound) for bound in values.GetRange(-1)):
                yield f"{file.name}: {name} is not finite"
        stamp = data.GetFieldData().GetArray("TimeValue")
        if stamp is None or stamp.GetTuple1(0) != time:
            yield f"{file.name}: TimeValue is not the {time} of {series.name}"

    print(f"{points} points; at the last time:")
    for name, values in sorted(fields.items()):
        low, high = values.GetRange(-1)
        print(f"  {name}: {values.GetNumberOfComponents()} component(s), magnitude {low:g} to {high:g}")


def main():
    """The program."""
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(differences(pathlib.Path(sys.argv[1])))
    for line in found[:20]:
        print("differs: " + line)
    print(f"ParaView sees {len(found)} difference(s)" if found else "ParaView sees what was recorded")
    sys.exit(1 if found else 0)


main()
