# SPDX-License-Identifier: GPL-2.0-or-later
"""Convergence of a scene: runs in several sizes of its cells or grains, stored for all its later runs."""

from collections.abc import Sequence
from pathlib import Path

from ..analyse.convergence import SceneConvergence, of_runs, places
from ..errors import ResultsError
from ..formatting import duration
from ..read.wheel_run import cells_or_grains, read_wheel_run
from ..run.script import RESERVED, check_variables, script_variables
from ..study.tables import in_columns
from .catalogue import Variables, is_shipped, script_of
from .one import SceneRun, run_missing, words_of

SIZES = ("cell", "diameter")  # variables that set the size of cells and of grains
KEPT = (
    "hub_drop", "rut_depth", "tyre_deflection", "resistance_coefficient", "net_traction_coefficient", "drive_torque",
    "drawbar_pull", "slip",
)  # fmt: skip


def converge(scene: str, given: Variables, ratio: float, count: int, folder: Path, jobs: int) -> SceneConvergence:
    """Runs the scene in its own size and coarser ones, each by this ratio, and stores what they give.

    @raises ResultsError, Interrupted, Failed
    """
    script = script_of(scene)
    for warning in check_variables(script, given, RESERVED):
        print(f"WARNING: {warning}")
    sizes = sizes_of(script, given)
    fixed = [pair for pair in given if pair[0] not in sizes]
    runs = []
    for step in range(count):
        of_size = [(name, f"{value * ratio**step:.6g}") for name, value in sizes.items()]
        variables = [*of_size, *fixed]
        name = "_".join(f"{name}_{value}" for name, value in of_size)
        runs.append(SceneRun(script, folder / name, variables, words=words_of(scene, variables)))
    run_missing(folder, runs, jobs)
    own, results = places(script, folder)
    path = results if is_shipped(script) else own
    found = of_runs(path, script, [read_wheel_run(run.folder) for run in runs], KEPT)
    found.write()
    return found


def sizes_of(script: Path, given: Variables) -> dict[str, float]:
    """Variable -> size [m]. @raises ResultsError"""
    known = script_variables(script, dict(given))
    texts = {name: dict(given).get(name, known.defaults.get(name, "")) for name in SIZES if name in known.settable}
    if not texts:
        raise ResultsError(
            f"{script}: has no variable {' or '.join(SIZES)}; write 'variable cell index 0.05' and 'cell ${{cell}}' in the "
            "line of the ground"
        )
    try:
        return {name: float(text) for name, text in texts.items()}
    except ValueError:
        raise ResultsError(f"{script}: {' or '.join(texts)} has no number; give the finest size with -v") from None


def convergence_table(found: SceneConvergence) -> str:
    """Values over the sizes, order, and the error of the finest."""
    kind = cells_or_grains(found.ground)
    head = ["", *(f"{kind} {1e3 * size:.3g} mm" for size in found.sizes), "order", "error of the finest"]
    rows: list[Sequence[str]] = [head]
    for name, values in found.quantities.items():
        series = found.series(name)
        order = f"{series.order:.2g}" if series.order == series.order else series.reason
        error = series.size_error(min(found.sizes))
        rows.append([name.replace("_", " "), *(f"{value:.4g}" for value, _ in values), order, f"{error:.2g}"])
    rows.append(["core time", *(duration(time) for time in found.cpu_times), "", ""])
    return "\n".join(line.rstrip() for line in in_columns(rows))
