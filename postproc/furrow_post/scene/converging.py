# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes of a scene by sizes of cells or grains and by the intervals of the soil: stored for all its later runs."""

from collections.abc import Sequence
from pathlib import Path

from ..uncertainty.material_error import require_intervals, varied_text
from ..uncertainty.scene_errors import CONVERGENCE, MATERIAL, RELATIVE, SceneConvergence, SceneMaterial
from ..uncertainty.scene_errors import found_file, of_runs, places, values_of
from ..errors import ResultsError
from ..formatting import duration
from ..read.ground_kinds import ground_kind
from ..read.wheel_run import read_wheel_run
from ..run.record import digest
from ..run.script import RESERVED, check_variables, script_variables
from ..csv_table import in_columns
from .catalogue import Variables, is_shipped, script_of
from .one import SceneRun, run_missing, words_of

COARSER = 1.6  # sizes of a pilot over those of the scene
SIZES = ("cell", "diameter")  # variables that set the size of cells and of grains
KEPT = (
    "hub_drop", "rut_depth", "tyre_deflection", "resistance_coefficient", "net_traction_coefficient", "drive_torque",
    "drawbar_pull", "slip",
)  # fmt: skip


def converge(scene: str, given: Variables, ratio: float, count: int, folder: Path, jobs: int) -> SceneConvergence:
    """Runs the scene in its own size and coarser ones, each by this ratio, and stores what they give.

    @raises ResultsError, Interrupted, Failed
    """
    script = _checked_script(scene, given)
    sizes = sizes_of(script, given)
    fixed = [pair for pair in given if pair[0] not in sizes]
    runs = []
    for step in range(count):
        of_size = [(name, f"{value * ratio**step:.6g}") for name, value in sizes.items()]
        variables = [*of_size, *fixed]
        name = "_".join(f"{name}_{value}" for name, value in of_size)
        runs.append(SceneRun(script, folder / name, variables, words=words_of(scene, variables)))
    run_missing(folder, runs, jobs)
    found = of_runs(_place(script, folder), script, [read_wheel_run(run.folder) for run in runs], KEPT)
    found.write()
    return found


def vary_material(scene: str, given: Variables, folder: Path, jobs: int) -> SceneMaterial:
    """Runs the scene in coarser cells, and again with each parameter of its card or material larger by its standard error.

    @raises ResultsError, Interrupted, Failed
    """
    script = _checked_script(scene, given)
    known = {**script_variables(script, dict(given)).defaults, **dict(given)}
    files = {name: path for name, text in known.items() if text.endswith(".yaml") and (path := found_file(text, script))}
    variable, file, parameters = require_intervals(files)
    sizes = {name: size for name, size in sizes_of(script, given).items() if name not in dict(given)}
    fixed = [*((name, f"{COARSER * size:.6g}") for name, size in sizes.items()), *(pair for pair in given if pair[0] != variable)]
    folder.mkdir(parents=True, exist_ok=True)
    runs = [SceneRun(script, folder / "base", [*fixed, (variable, str(file.resolve()))])]
    for one in parameters:
        varied = folder / f"{one.name}.yaml"
        varied.write_text(varied_text(file, one), encoding="utf-8")
        runs.append(SceneRun(script, folder / one.name, [*fixed, (variable, str(varied.resolve()))]))
    run_missing(folder, runs, jobs)
    base, *others = [values_of(read_wheel_run(run.folder), KEPT) for run in runs]
    scales = {name: abs(value) if name in RELATIVE and value else 1.0 for name, (value, _) in base.items()}
    parts = {
        name: {one.name: (other[name][0] - base[name][0]) / scale for one, other in zip(parameters, others) if name in other}
        for name, scale in scales.items()
    }
    made = SceneMaterial(_place(script, folder, MATERIAL), digest(script), file.name, digest(file), parts)
    made.write()
    return made


def _checked_script(scene: str, given: Variables) -> Path:
    """Script of a scene. Prints warnings of the variables. @raises ResultsError"""
    script = script_of(scene)
    for warning in check_variables(script, given, RESERVED):
        print(f"WARNING: {warning}")
    return script


def _place(script: Path, results: Path, ending: str = CONVERGENCE) -> Path:
    """File that belongs to a scene: next to the results of a shipped one, else next to its script."""
    own, shipped = places(script, results, ending)
    return shipped if is_shipped(script) else own


def material_table(made: SceneMaterial) -> str:
    """Change of each quantity by each parameter, and the whole."""
    names = list(next(iter(made.parts.values())))
    rows: list[Sequence[str]] = [["change by one standard error", *names, "all"]]
    for quantity, changes in made.parts.items():
        percent = quantity in RELATIVE
        cells = [*changes.values(), made.error(quantity, 1.0) or 0.0]
        rows.append([quantity.replace("_", " "), *(f"{100 * cell:.2g} %" if percent else f"{cell:.2g}" for cell in cells)])
    return "\n".join(line.rstrip() for line in in_columns(rows))


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
    kind = ground_kind(found.ground).sizes
    head = ["", *(f"{kind} {1e3 * size:.3g} mm" for size in found.sizes), "order", "error of the finest"]
    rows: list[Sequence[str]] = [head]
    for name, values in found.quantities.items():
        series = found.series(name)
        order = f"{series.order:.2g}" if series.order == series.order else series.reason
        error = series.size_error(min(found.sizes))
        rows.append([name.replace("_", " "), *(f"{value:.4g}" for value, _ in values), order, f"{error:.2g}"])
    rows.append(["core time", *(duration(time) for time in found.cpu_times), "", ""])
    return "\n".join(line.rstrip() for line in in_columns(rows))
