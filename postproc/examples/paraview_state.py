# SPDX-License-Identifier: GPL-2.0-or-later
"""A state of ParaView: opens the frames of a run, coloured, every length at the same scale.

    paraview --script=postproc/examples/paraview_state.py           with FURROW_RESULTS=results/x
    pvpython postproc/examples/paraview_state.py results/x x.png    a picture of the last frame

Grains are spheres of their radius, coloured by displacement; particles of a continuum are spheres
of their volume, coloured by density. The reflection of a half model: Filters, Reflect, Y Min.
"""

import os
import sys
from pathlib import Path

from paraview import simple

folder = Path(sys.argv[1] if len(sys.argv) > 1 else os.environ["FURROW_RESULTS"]) / "vtk"
view = simple.GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground = 0
view.Background = [0.96, 0.96, 0.97]
view.OrientationAxesLabelColor = [0.1, 0.1, 0.1]
view.ViewSize = [1600, 900]


def spheres(points, radius, colour, unit):
    """Draws points as spheres; radius: a formula of their arrays."""
    sized = simple.Calculator(Input=points, ResultArrayName="shown_radius", Function=radius)
    display = simple.Show(sized, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.GaussianRadius = 1.0
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "shown_radius"]
    display.UseScaleFunction = 0
    simple.ColorBy(display, ("POINTS", colour))
    display.SetScalarBarVisibility(view, True)
    colours = simple.GetColorTransferFunction(colour)
    colours.NanColor = [0.75, 0.75, 0.78]  # a displacement that is not known
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = colour, f"[{unit}]"
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    return display


shown = []
for name, radius, colour, unit in (
    ("grains", "radius", "displacement", "m"),
    ("terrain", "(0.2387*volume)^(1/3)", "density", "kg/m3"),
):
    series = folder / f"{name}.pvd"
    if series.is_file() and "DataSet" in series.read_text(encoding="utf-8"):
        shown.append(spheres(simple.PVDReader(FileName=str(series)), radius, colour, unit))
if (folder / "wheel.pvd").is_file():
    wheel = simple.Show(simple.PVDReader(FileName=str(folder / "wheel.pvd")), view)
    wheel.ColorArrayName = ["POINTS", ""]  # one colour
    wheel.DiffuseColor = [0.36, 0.40, 0.45]

scene = simple.GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
simple.Render(view)  # reads that frame; its range becomes that of the colours
for display in shown:
    display.RescaleTransferFunctionToDataRange(False, True)
view.CameraPosition, view.CameraViewUp = [0.6, -1.2, 0.8], [0, 0, 1]
simple.ResetCamera(view)
if len(sys.argv) > 2:
    simple.SaveScreenshot(sys.argv[2], view)
else:
    simple.Render(view)
