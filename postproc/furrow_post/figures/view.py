# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs in 3D in one self-contained HTML page: three.js draws what is quantised here (view.js).

Positions are kept in 65535 steps of the range along each axis, colours in 255; differences between
frames are packed by zlib. Frames, and at last points, are left out until the page is small enough.
"""

import base64
import json
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup

from ..uncertainty.whole_error import headline
from ..arrays import Floats
from ..errors import ResultsError
from ..read.motion import Body, Cloud, Motion, Points, evenly_chosen
from .ground_quantities import COLOURS, Quantity, quantities_of
from .page import render
from .style import GROUND_COLOURS, MILLIMETRE

LARGEST = 12e6  # [byte] of a view; a report has its figures beside it
THREE = Path("/usr/share/javascript/three")  # Debian's libjs-three
LIBRARY = ("three.min.js", "examples/js/controls/OrbitControls.js")
LEVELS = 65535  # of a position: 0 ... 65534; 65535: the point is not there
FEWEST_FRAMES = 12  # below which points are left out instead of frames
MOST_VALUES = 6_000_000  # points times frames that are read at all


@dataclass
class _Selection:
    """The frames and points of one run that go into the page."""

    motion: Motion
    label: str
    times: Floats
    stride: int = 1  # one of so many points is shown

    def points(self, cloud: Cloud) -> list[Points]:
        return [self._thinned(cloud.at(time)) for time in self.times]

    def _thinned(self, points: Points) -> Points:
        if self.stride == 1:
            return points
        kept = points.id % self.stride == 0
        fields = {name: values[kept] for name, values in points.fields.items()}
        # larger, so that fewer points fill the same volume
        radius = points.radius[kept] * self.stride ** (1 / 3)
        return Points(points.id[kept], points.x[kept], radius, fields)

    def note(self) -> str:
        """Note on the frames that are shown, for the reader."""
        motion = self.motion
        if not motion.has_frames:
            return f"{self.label}: the run wrote no frames ('vtk N'); this is its end."
        frames, every = len(self.times), len(motion.times)
        text = f"{self.label}: " + (f"all {frames} frames" if frames == every else f"{frames} of {every} frames")
        return f"{text}, one of {self.stride} points, enlarged." if self.stride > 1 else f"{text}."


def view_page(motions: Sequence[Motion], labels: Sequence[str], largest: float = LARGEST) -> str:
    """The whole page. @raises ResultsError, OSError"""
    return render("view.html", " and ".join(labels), view=view_values(motions, labels, largest))


def view_values(motions: Sequence[Motion], labels: Sequence[str], largest: float = LARGEST) -> dict[str, Any]:
    """The values of the template section.html, which shows these runs side by side.

    largest: [byte] @raises ResultsError where frames are damaged, or three.js is not installed
    """
    library = _library()
    share = (largest - sum(map(len, library))) / len(motions)
    chosen = [
        _Selection(motion, label, evenly_chosen(motion.times, _readable(motion)))
        for motion, label in zip(motions, labels)
    ]
    quantities = quantities_of(motions)
    runs = [_fitted(selection, quantities, share) for selection in chosen]
    data = {
        "runs": runs,
        "quantities": [vars(quantity) for quantity in quantities],
        "colours": _text(_colour_table()),
        "cut": _sides(chosen),
    }
    scripts = [*library, Path(__file__).with_name("view.js").read_text(encoding="utf-8")]
    return {
        "labels": [(label, headline(motion.folder)) for label, motion in zip(labels, motions)],
        "notes": _notes(chosen, runs),
        # "<" is escaped: no text in the data can end the script
        "data": Markup(json.dumps(data).replace("<", "\\u003c")),
        "scripts": [Markup(script.replace("</script", "<\\/script")) for script in scripts],
    }


def _library() -> list[str]:
    """three.js and its OrbitControls. @raises ResultsError where they are not installed"""
    files = [THREE / name for name in LIBRARY]
    for file in files:
        if not file.is_file():
            raise ResultsError(f"{file}: is missing; install Debian's package (apt-get install libjs-three)")
    return [file.read_text(encoding="utf-8") for file in files]


def _readable(motion: Motion) -> int:
    """How many frames are read at all, by the number of points in the last one."""
    count = sum(len(cloud.at(motion.times[-1]).id) for cloud in motion.clouds)
    return max(MOST_VALUES // max(count, 1), 2)


def _fitted(selection: _Selection, quantities: Sequence[Quantity], largest: float) -> dict[str, Any]:
    """The data of a run in no more bytes than this; leaves out frames, then points."""
    while True:
        data = _run_data(selection, quantities)
        size = len(json.dumps(data))
        if size <= largest:
            return data
        frames = int(0.95 * len(selection.times) * largest / size)
        if frames >= FEWEST_FRAMES:
            selection.times = evenly_chosen(selection.motion.times, frames)
        elif len(selection.times) > FEWEST_FRAMES:
            selection.times = evenly_chosen(selection.motion.times, FEWEST_FRAMES)
        else:
            selection.stride += max(int(size / largest), 1)


def _run_data(selection: _Selection, quantities: Sequence[Quantity]) -> dict[str, Any]:
    clouds = []
    for cloud in selection.motion.clouds:
        frames = selection.points(cloud)
        if any(len(frame.id) for frame in frames):
            clouds.append(_cloud_data(cloud, frames, quantities))
    return {
        "label": selection.label,
        "times": selection.times.tolist(),
        "bodies": [_body_data(selection, body) for body in selection.motion.bodies],
        "clouds": clouds,
    }


def _cloud_data(cloud: Cloud, frames: Sequence[Points], quantities: Sequence[Quantity]) -> dict[str, Any]:
    every = np.unique(np.concatenate([frame.id for frame in frames]))
    low, span = _range(np.concatenate([frame.x for frame in frames]))
    places = np.full((len(frames), 3, len(every)), LEVELS, np.uint16)
    radius = np.zeros(len(every), np.float32)
    named = [q for q in quantities if any(q.key in frame.fields for frame in frames)]
    values = {q.key: np.full((len(frames), len(every)), COLOURS, np.uint8) for q in named}
    for k, frame in enumerate(frames):
        column = np.searchsorted(every, frame.id)
        places[k][:, column] = np.round((LEVELS - 1) * ((frame.x - low) / span)).T
        radius[column] = frame.radius
        for q in named:
            if q.key in frame.fields:
                values[q.key][k, column] = q.levels(frame.fields[q.key])
    return {
        "kind": cloud.kind,
        "count": len(every),
        "mirrored": cloud.mirrored,
        "radius": _packed(radius),
        "low": low.tolist(),
        "span": (span * LEVELS / (LEVELS - 1)).tolist(),  # of level 65535, as the shader takes it
        "places": _packed_levels(places),
        "values": {key: _packed(_differences(levels)) for key, levels in values.items()},
    }


def _body_data(selection: _Selection, body: Body) -> dict[str, Any]:
    shown = [body.at(time) for time in selection.times]
    x = np.stack([surface.x for surface in shown])
    low, span = _range(x.reshape(-1, 3))
    levels = np.round(LEVELS * ((x - low) / span)).astype(np.uint16).transpose(0, 2, 1)
    return {
        "nodes": x.shape[1],
        "mirrored": selection.motion.bodies_mirrored,
        "triangles": _packed(shown[0].triangles.astype(np.uint32)),
        "low": low.tolist(),
        "span": span.tolist(),
        "places": _packed_levels(levels),
    }


def _range(x: Floats) -> tuple[Floats, Floats]:
    """Lowest coordinates and extents (3) of points (n, 3)."""
    low = x.min(axis=0)
    span: Floats = np.maximum(x.max(axis=0) - low, 1e-9)
    return low, span


def _differences(levels: Any) -> Any:
    """Differences of each frame to the one before, modulo the type."""
    differences = levels.copy()
    differences[1:] -= levels[:-1]
    return differences


def _packed_levels(levels: Any) -> str:
    """Levels of 16 bits as text: zigzag (0, -1, 1, -2 ... become 0, 1, 2, 3 ...), low bytes before high bytes."""
    signed = _differences(levels).reshape(-1).view(np.int16)
    zigzag = ((signed << 1) ^ (signed >> 15)).view(np.uint16)
    return _packed(np.concatenate([zigzag & 255, zigzag >> 8]).astype(np.uint8))


def _packed(values: Any) -> str:
    return _text(zlib.compress(values.astype(values.dtype.newbyteorder("<")).tobytes(), 9))


def _text(content: bytes) -> str:
    return base64.b64encode(content).decode()


def _colour_table() -> bytes:
    """256 colours in RGB."""
    colours = np.round(255 * GROUND_COLOURS(np.linspace(0, 1, 256))[:, :3])
    return bytes(colours.astype(np.uint8).tobytes())


def _sides(chosen: Sequence[_Selection]) -> list[float]:
    """Range of y of the cut plane [m]."""
    sides: list[float] = []
    for selection in chosen:
        end = selection.times[-1]
        for body in selection.motion.bodies:
            sides += body.at(end).x[:, 1].tolist()
        for cloud in selection.motion.clouds:
            y = cloud.at(end).x[:, 1]
            sides += [*y, *-y] if cloud.mirrored else [*y]
    reach = 0.01 * (max(sides) - min(sides))
    return [min(sides) - reach, max(sides) + reach]


def _notes(chosen: Sequence[_Selection], runs: Sequence[dict[str, Any]]) -> list[str]:
    finest = max((max(cloud["span"]) / LEVELS for run in runs for cloud in run["clouds"]), default=0.0)
    parts = [selection.note() for selection in chosen]
    if finest:
        size = f"{MILLIMETRE * finest:.1g} mm"
        parts.append(f"Positions to {size}; each grain, or particle of a continuum, is a sphere of its volume.")
    return [*parts, "Drag: turn; wheel: zoom; right button: move; arrows and blank: frames, play."]
