# SPDX-License-Identifier: GPL-2.0-or-later
"""A run over time in 3D: the surfaces of its wheels, and its grains or particles, frame by frame.

Frames are those of the folder vtk. A run that wrote none has one: its end, from history.h5 and
terrain.h5. Results of further wheels lie in folders within that of the first.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Floats, Integers
from ..errors import ResultsError
from .results import Results, Styles, Surface, read_effective_input, read_surface
from .terrain import is_half, read_terrain_fields, read_terrain_history, terrain_file
from .vtk import Frames, read_frames, read_vtp

REMEDY = (
    "repeat the run with 'vtk N' (steps between frames) in its lines wheel/history and "
    "terrain/history"
)


@dataclass(frozen=True)
class Points:
    """Grains, or particles of a continuum, at one instant."""

    id: Integers  # (n), each once
    x: Floats  # (n, 3) [m]
    radius: Floats  # (n) [m]; of a particle: of the sphere of its volume
    fields: dict[str, Floats]  # displacement [m], speed [m/s], density [kg/m3]; NaN: not known


@dataclass(frozen=True)
class Cloud:
    """Grains or particles over time: frames of a series, or one instant."""

    kind: str  # "grains" or "continuum"
    mirrored: bool  # a half model: what stands at y > 0 stands at y < 0 too
    series: Frames | None
    end: Points | None = None  # of a run without frames

    def at(self, time: float) -> Points:
        """@raises ResultsError for a damaged frame"""
        if self.series is None:
            assert self.end is not None
            return self.end
        return _read_points(self.series.files[self.series.at(time)])


@dataclass(frozen=True)
class Body:
    """A wheel, tyre or plate over time: frames of a series, or its end."""

    series: Frames | None
    end: Surface | None = None  # of a run without frames

    def at(self, time: float) -> Surface:
        """@raises ResultsError for a damaged frame"""
        if self.series is None:
            assert self.end is not None
            return self.end
        frame = read_vtp(self.series.files[self.series.at(time)])
        return Surface(frame.triangles, frame.x)


@dataclass(frozen=True)
class Motion:
    """Moving bodies, grains and particles of one results folder."""

    folder: Path
    title: str
    times: Floats  # of the frames [s]
    clouds: tuple[Cloud, ...]
    bodies: tuple[Body, ...]  # the wheels, that of the folder first, then a height field
    bodies_mirrored: bool

    @property
    def has_frames(self) -> bool:
        """True where the run wrote frames, and not its end alone."""
        rolling = any(body.series for body in self.bodies)
        return rolling or any(cloud.series for cloud in self.clouds)


def read_motion(folder: Path) -> Motion:
    """@raises ResultsError for a folder without results, and for damaged ones"""
    folder = folder.parent if folder.is_file() else folder
    grains, terrain = (read_frames(folder / "vtk" / f"{name}.pvd") for name in ("grains", "terrain"))
    results = Results(folder) if (folder / "history.h5").is_file() else None
    wheels = [folder, *(_further_wheels(results) if results else ())]
    rolling = [one for wheel in wheels if (one := read_frames(wheel / "vtk" / "wheel.pvd"))]
    if results is None and terrain is None and not terrain_file(folder).is_file():
        raise ResultsError(f"{folder}: has no results; name the results folder of a run")
    styles = results.styles() if results else Styles([])
    soil, wheel = styles.of_kind("terrain"), styles.of_kind("wheel")
    field = read_frames(folder / "vtk" / "scm.pvd")
    bodies, clouds = [Body(one) for one in (*rolling, *([field] if field else []))], []
    if not rolling and grains is None and terrain is None:
        if results:
            bodies = [Body(None, one) for one in _bodies_at_the_end(results, wheels)]
        clouds = _clouds_at_the_end(folder, results)
        times = (results.columns if results else read_terrain_history(folder))["time"][-1:]
    else:
        series = [one for one in (*rolling, grains, terrain) if one]
        times = max(series, key=lambda one: len(one.files)).times
        clouds += [Cloud("grains", False, grains)] if grains else []
        if terrain:
            half = soil.flag("symmetry") if soil else is_half(read_vtp(terrain.files[0]).x)
            clouds.append(Cloud("continuum", half, terrain))
    if not clouds and not bodies:
        raise ResultsError(f"{folder}: has nothing to look at; {REMEDY}")
    return Motion(
        folder,
        results.title if results else folder.resolve().name,
        times,
        tuple(clouds),
        tuple(bodies),
        wheel.flag("half") if wheel else False,
    )


def _further_wheels(results: Results) -> list[Path]:
    """Folders within that of the results that the same run wrote: one input names them all."""
    own = results.effective_input
    histories = sorted(results.folder.glob("*/history.h5"))
    return [file.parent for file in histories if read_effective_input(file) == own]


def _bodies_at_the_end(results: Results, wheels: Sequence[Path]) -> list[Surface]:
    """Among the grains, where there are any, as frames have them."""
    kept = (read_surface(wheel / "history.h5") for wheel in wheels)
    surfaces = [surface for surface in kept if surface is not None]
    if not surfaces or not results.has_grains:
        return surfaces
    grains = results.grains("reference")
    return [grains.image_of(one) for one in surfaces] if len(grains.id) else surfaces


def _read_points(file: Path) -> Points:
    frame = read_vtp(file)
    named = frame.fields
    size = "radius" if "radius" in named else "volume"
    for name in ("id", "velocity", size):
        if name not in named:
            raise ResultsError(f"{file}: has no '{name}'; {REMEDY}")
    fields = {"speed": _lengths(named["velocity"])}
    if "displacement" in named:
        fields["displacement"] = _lengths(named["displacement"])
    if "density" in named:
        fields["density"] = np.asarray(named["density"], float)
    radius = np.asarray(named[size], float)
    if size == "volume":
        radius = _radius_of(radius)
    return _checked(Points(named["id"].astype(np.int64), frame.x, radius, fields), file)


def _clouds_at_the_end(folder: Path, results: Results | None) -> list[Cloud]:
    clouds = []
    if results and results.has_grains:
        grains = results.grains("final")
        fields = {}
        if len(grains.id):
            moved = grains.displacement_from(results.grains("reference"))
            fields["displacement"] = _lengths(moved)
            points = Points(grains.id, grains.x, grains.radius, fields)
            clouds.append(Cloud("grains", False, None, _checked(points, results.file)))
    if terrain_file(folder).is_file():
        named = read_terrain_fields(folder)
        named.require_finite("x", "initial_position", "v", "density", "volume")
        fields = {
            "density": named["density"],
            "displacement": _lengths(named["x"] - named["initial_position"]),
            "speed": _lengths(named["v"]),
        }
        points = Points(
            named["id"].astype(np.int64), named["x"], _radius_of(named["volume"]), fields
        )
        half = is_half(named["initial_position"])
        clouds.append(Cloud("continuum", half, None, _checked(points, named.file)))
    return clouds


def _checked(points: Points, file: Path) -> Points:
    """@raises ResultsError where two points have one number, or a place is no number"""
    if len(np.unique(points.id)) != len(points.id):
        raise ResultsError(f"{file}: two of its points have the same id; {REMEDY}")
    if not np.isfinite(points.x).all() or not np.isfinite(points.radius).all():
        raise ResultsError(f"{file}: a position is no finite number; {REMEDY}")
    return points


def _lengths(vectors: Floats) -> Floats:
    lengths: Floats = np.linalg.norm(np.asarray(vectors, float), axis=1)
    return lengths


def _radius_of(volume: Floats) -> Floats:
    radius: Floats = np.cbrt(0.75 / np.pi * np.asarray(volume, float))
    return radius


def evenly_chosen(times: Floats, number: int) -> Floats:
    """At most a number of the times, with the first and the last."""
    if number >= len(times):
        return times
    places = np.round(np.linspace(0, len(times) - 1, number)).astype(int)
    chosen: Floats = times[np.unique(places)]
    return chosen
