# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders whose frames move in closed form; written by VTK, as Furrow writes them."""

from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from furrow_post.arrays import Floats, Integers

from .runs import RADIUS, WIDTH, write_run

FRAMES, INTERVAL = 5, 0.1  # [s]
SPEED, SINKAGE = 1.0, 0.05  # [m/s], [m] of the wheel
LEVEL = 0.2  # z of the ground [m]
SPOKES = 24


def write_vtp(file: Path, x: Floats, triangles: Integers | None = None, **fields: Any) -> None:
    """Appended, raw, zlib; without triangles a vertex for each point."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x), deep=True))
    data, cells = vtkPolyData(), vtkCellArray()
    data.SetPoints(points)
    shape = np.arange(len(x))[:, None] if triangles is None else triangles
    count, corners = shape.shape
    cells.SetData(corners, numpy_to_vtkIdTypeArray(shape.ravel().astype(np.int64), deep=True))
    (data.SetVerts if triangles is None else data.SetPolys)(cells)
    for name, values in fields.items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(data)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToZLib()
    assert writer.Write()


def write_collection(file: Path, entries: dict[float, str]) -> None:
    lines = "".join(f'<DataSet timestep="{time!r}" part="0" file="{name}"/>\n' for time, name in entries.items())
    file.write_text(
        f'<?xml version="1.0"?>\n<VTKFile type="Collection"><Collection>\n{lines}' "</Collection></VTKFile>\n"
    )


def wheel(time: float) -> tuple[Floats, Integers]:
    """A band of triangles that rolls along x; nodes (n, 3), triangles."""
    angle = 2 * np.pi * np.arange(SPOKES) / SPOKES - SPEED * time / RADIUS
    x, z = RADIUS * np.cos(angle), RADIUS * np.sin(angle)
    rims = [np.column_stack([x, np.full(SPOKES, side), z]) for side in (-WIDTH / 2, WIDTH / 2)]
    a = np.arange(SPOKES)
    b = (a + 1) % SPOKES
    triangles = np.vstack([np.column_stack([a, b, a + SPOKES]), np.column_stack([b, b + SPOKES, a + SPOKES])])
    return np.vstack(rims) + [SPEED * time, 0, LEVEL + RADIUS - SINKAGE], triangles  # fmt: skip


def ground(number: int = 6) -> Floats:
    """A block of points, from y > 0 on, 2 x number points a metre: (n, 3)."""
    step = 0.5 / number
    i, j, k = (index.ravel() for index in np.indices((3 * number, number // 2, number // 2)))
    return np.column_stack([i * step - 0.4, (j + 0.5) * step, LEVEL - (k + 0.5) * step])


def settlement(x: Floats, time: float) -> Floats:
    """Displacement (n, 3): down where the wheel has been."""
    moved = np.zeros_like(x)
    moved[:, 2] = -SINKAGE * (x[:, 0] < SPEED * time) * np.exp(-((x[:, 1] / WIDTH) ** 2))
    return moved


def write_rolling_wheel(folder: Path, behind: float = 0.0) -> None:
    """History and frames of the wheel, or of one so far [m] behind it."""
    write_run(folder)
    frames = folder / "vtk"
    frames.mkdir()
    names = {k * INTERVAL: f"wheel_{k}.vtp" for k in range(FRAMES)}
    for time, name in names.items():
        x, triangles = wheel(time)
        write_vtp(frames / name, x - [behind, 0, 0], triangles, velocity=0 * x)
    write_collection(frames / "wheel.pvd", names)


def write_moving_run(folder: Path, kind: str = "grains", number: int = 6, noise: float = 0.0) -> Path:
    """The wheel rolls; the ground settles under it.

    kind: "grains", or "continuum", a half model; noise: [m] that each frame adds
    """
    write_rolling_wheel(folder)
    frames = folder / "vtk"
    random = np.random.default_rng(7)
    start = ground(number)
    series = "grains" if kind == "grains" else "terrain"
    identity = np.arange(len(start)) + 1
    for k in range(FRAMES):
        time = k * INTERVAL
        moved = settlement(start, time) + random.normal(0, noise, start.shape)
        fields = {"id": identity, "velocity": 2 * moved, "displacement": moved}
        one = np.ones(len(start))
        if kind == "grains":
            fields["radius"] = 0.04 * one
        else:
            fields |= {"id": 1.0 * identity, "volume": 1e-4 * one, "density": (200 + k) * one}
        write_vtp(frames / f"{series}_{k}.vtp", start + moved, **fields)
    write_collection(frames / f"{series}.pvd", {k * INTERVAL: f"{series}_{k}.vtp" for k in range(FRAMES)})
    return folder
