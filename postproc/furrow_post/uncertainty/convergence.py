# SPDX-License-Identifier: GPL-2.0-or-later
"""Convergence of a scene over its cells or grains, as 'furrow-post converge' stores it for all later runs."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import ResultsError, content_of
from ..json_text import parse_json
from ..read.wheel_run import WheelRun, cells_or_grains
from ..run.record import digest
from ..run.summary import Summary
from .grid_convergence import Convergence, grid_convergence

ENDING = ".convergence.json"  # behind the stem of the scene's script
RELATIVE = ("hub_drop", "rut_depth", "tyre_deflection")  # errors over the value; others are absolute


@dataclass(frozen=True)
class SceneConvergence:
    """Results of several sizes of one scene."""

    path: Path
    script: str  # digest of the scene's script
    ground: str
    sizes: tuple[float, ...]  # [m]
    quantities: Mapping[str, Sequence[tuple[float, float]]]  # value and its error over time of each size
    cpu_times: tuple[float, ...]  # [s] of one core

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
        return f"{self.path.name}: {cells_or_grains(self.ground)} of {sizes} mm"

    def write(self) -> None:
        content = {name: getattr(self, name) for name in ("script", "ground", "sizes", "quantities")}
        content["cpu_times"] = [time if math.isfinite(time) else None for time in self.cpu_times]
        self.path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def of_runs(path: Path, script: Path, runs: Sequence[WheelRun], names: Sequence[str]) -> SceneConvergence:
    """Convergence of runs that differ in size alone. @raises ResultsError for fewer than two sizes"""
    if len({run.size for run in runs}) < 2:
        raise ResultsError(f"{path.name}: convergence needs runs of at least two sizes, three for an order")
    table = [values_of(run, names) for run in runs]
    kept = [name for name in names if all(name in row for row in table)]
    quantities = {name: [row[name] for row in table] for name in kept}
    sizes, times = (tuple(getattr(run, name) for run in runs) for name in ("size", "cpu_time"))
    return SceneConvergence(path, digest(script), runs[0].ground, sizes, quantities, times)


def values_of(run: WheelRun, names: Sequence[str]) -> dict[str, tuple[float, float]]:
    """Value and its error over time."""
    summary = Summary(run.folder)
    found = {name: run.values.get(name) or summary.quantity(name) for name in names}
    return {name: (value.mean, value.standard_error) for name, value in found.items() if value}


def read_convergence(path: Path) -> SceneConvergence:
    """@raises ResultsError"""
    with content_of(path, "write it again with 'furrow-post converge SCENE'"):
        content: dict[str, Any] = parse_json(path.read_text(encoding="utf-8"))
        quantities = {name: [(float(a), float(b)) for a, b in rows] for name, rows in content["quantities"].items()}
        sizes = tuple(map(float, content["sizes"]))
        times = tuple(math.nan if time is None else float(time) for time in content["cpu_times"])
        if len(sizes) < 2 or not all(0 < size < math.inf for size in sizes):
            raise ValueError("it has fewer than two sizes")
        return SceneConvergence(path, str(content["script"]), str(content["ground"]), sizes, quantities, times)


def places(script: Path, results: Path, ending: str = ENDING) -> list[Path]:
    """Where the convergence of a scene may be: next to its script, and next to its results."""
    name = script.stem + ending
    return [script.parent / name, results.resolve().parent / name]


def beside_scene(run: WheelRun, ending: str) -> tuple[Path, Path | None]:
    """Script of a run, and the file of its scene with this ending; None where there is none."""
    script = Path(str(run.results.run.get("script", "")))
    found = (path for path in places(script, run.folder, ending) if script.is_file() and path.is_file())
    return script, next(found, None)


def convergence_of(run: WheelRun) -> SceneConvergence | None:
    """Convergence of the scene of a run; None where there is none, or the script has changed since."""
    script, path = beside_scene(run, ENDING)
    found = read_convergence(path) if path else None
    return found if found and found.script == digest(script) and found.ground == run.ground else None
