# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors of a scene by cells or grains, and by its material, as 'furrow-post converge' stores them for later runs."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ..errors import ResultsError, content_of
from ..json_text import parse_json
from ..read.ground_kinds import ground_kind
from ..read.wheel_run import WheelRun
from ..run.record import digest
from ..run.summary import SteadyValue, Summary
from .grid_convergence import Convergence, grid_convergence

CONVERGENCE, MATERIAL = ".convergence.json", ".material.json"  # behind the stem of the scene's script
RELATIVE = ("hub_drop", "rut_depth", "tyre_deflection")  # errors over the value; others are absolute


@dataclass(frozen=True)
class SceneFile:
    """Errors of the quantities of one scene."""

    path: Path
    script: str  # digest of the scene's script

    def content(self) -> dict[str, Any]:
        return {one.name: getattr(self, one.name) for one in fields(self) if one.name != "path"}

    def write(self) -> None:
        self.path.write_text(json.dumps(self.content(), indent=1) + "\n", encoding="utf-8")


@dataclass(frozen=True)
class SceneConvergence(SceneFile):
    """Results of several sizes of one scene."""

    ground: str
    sizes: tuple[float, ...]  # [m]
    quantities: Mapping[str, Sequence[tuple[float, float]]]  # value and its error over time of each size
    cpu_times: tuple[float, ...]  # [s] of one core

    def content(self) -> dict[str, Any]:
        return {**super().content(), "cpu_times": [time if math.isfinite(time) else None for time in self.cpu_times]}

    def series(self, name: str) -> Convergence:
        values, errors = zip(*self.quantities[name])
        return grid_convergence(self.sizes, values, errors)

    def size_error(self, name: str, size: float, value: float) -> float | None:
        """Error of the size in a run of this size and value; None for a quantity that was not kept."""
        if name not in self.quantities:
            return None
        series, largest = self.series(name), max(self.sizes)
        error = series.size_error(min(size, largest)) * max(size / largest, 1.0)
        return error * abs(value / series.value) if name in RELATIVE and series.value else error

    @property
    def source(self) -> str:
        sizes = ", ".join(f"{1e3 * size:.3g}" for size in sorted(self.sizes, reverse=True))
        return f"{self.path.name}: {ground_kind(self.ground).sizes} of {sizes} mm"


@dataclass(frozen=True)
class SceneMaterial(SceneFile):
    """Errors of the quantities of a scene by the intervals of one file: over the value for depths."""

    file: str  # name of the card or material
    digest: str
    parts: Mapping[str, Mapping[str, float]]  # quantity -> parameter -> change by its standard error

    def error(self, name: str, value: float) -> float | None:
        """Root sum square over the parameters; None for a quantity that was not kept."""
        if name not in self.parts:
            return None
        return math.hypot(*self.parts[name].values()) * (abs(value) if name in RELATIVE else 1.0)

    @property
    def source(self) -> str:
        return f"{self.path.name}: {', '.join(next(iter(self.parts.values()), {}))} of {self.file}"


def of_runs(path: Path, script: Path, runs: Sequence[WheelRun], names: Sequence[str]) -> SceneConvergence:
    """Convergence of runs that differ in size alone. @raises ResultsError for fewer than two sizes"""
    if len({run.size for run in runs}) < 2:
        raise ResultsError(f"{path.name}: convergence needs runs of at least two sizes, three for an order")
    table = [values_of(run, names) for run in runs]
    quantities = {name: [row[name] for row in table] for name in names if all(name in row for row in table)}
    sizes, times = (tuple(getattr(run, name) for run in runs) for name in ("size", "cpu_time"))
    return SceneConvergence(path, digest(script), runs[0].ground, sizes, quantities, times)


def values_of(run: WheelRun, names: Sequence[str]) -> dict[str, tuple[float, float]]:
    """Value and its error over time."""
    values = steady_values(run)
    return {name: (values[name].mean, values[name].standard_error) for name in names if name in values}


def steady_values(run: WheelRun) -> dict[str, SteadyValue]:
    """Values of the summary, with those of the run in their place."""
    return summary_values(run.folder) | run.values


def summary_values(folder: Path) -> dict[str, SteadyValue]:
    summary = Summary(folder)
    return {name: value for name in summary.quantities if (value := summary.quantity(name))}


def read_convergence(path: Path) -> SceneConvergence:
    """Reads the convergence of a scene over sizes. @raises ResultsError"""
    with content_of(path, "write it again with 'furrow-post converge SCENE'"):
        content: dict[str, Any] = parse_json(path.read_text(encoding="utf-8"))
        quantities = {name: [(float(a), float(b)) for a, b in rows] for name, rows in content["quantities"].items()}
        sizes = tuple(map(float, content["sizes"]))
        times = tuple(math.nan if time is None else float(time) for time in content["cpu_times"])
        if len(sizes) < 2 or not all(0 < size < math.inf for size in sizes):
            raise ValueError("it has fewer than two sizes")
        return SceneConvergence(path, str(content["script"]), str(content["ground"]), sizes, quantities, times)


def read_material_error(path: Path) -> SceneMaterial:
    """Reads the errors of a scene from its material. @raises ResultsError"""
    with content_of(path, "write it again with 'furrow-post converge SCENE --material'"):
        content = parse_json(path.read_text(encoding="utf-8"))
        parts = {name: {key: float(change) for key, change in one.items()} for name, one in content["parts"].items()}
        return SceneMaterial(path, str(content["script"]), str(content["file"]), str(content["digest"]), parts)


def places(script: Path, results: Path, ending: str = CONVERGENCE) -> list[Path]:
    """Possible places of a file of a scene: next to its script, and next to its results."""
    name = script.stem + ending
    return [script.parent / name, results.resolve().parent / name]


def _beside_scene(run: WheelRun, ending: str) -> tuple[Path, Path | None]:
    """Script of a run, and the file of its scene with this ending; None where there is none."""
    script = Path(str(run.results.run.get("script", "")))
    found = (path for path in places(script, run.folder, ending) if script.is_file() and path.is_file())
    return script, next(found, None)


def convergence_of(run: WheelRun) -> SceneConvergence | None:
    """Convergence of the scene of a run; None where there is none, or the script has changed since."""
    script, path = _beside_scene(run, CONVERGENCE)
    found = read_convergence(path) if path else None
    return found if found and found.script == digest(script) and found.ground == run.ground else None


def material_error_of(run: WheelRun) -> SceneMaterial | None:
    """Error by the material in the scene of a run; None where there is none, or the script or the file has changed since."""
    script, path = _beside_scene(run, MATERIAL)
    found = read_material_error(path) if path else None
    soil = run.results.styles().terrain()
    keyword = next((key for key in ("material", "card") if soil and soil.has(key)), "")
    if not found or not soil or not keyword or found.script != digest(script):
        return None
    file = found_file(soil.text(keyword), script)
    return found if file and digest(file) == found.digest else None


def found_file(text: str, script: Path) -> Path | None:
    """A file that a script names, from its folder or from here."""
    return next((path for path in (script.parent / text, Path(text)) if path.is_file()), None)
