# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the inputs of CalculiX and Yade, runs both, and puts their results next to Furrow's.

The other programs run in the results folder of the study, once for each input.
"""

import hashlib
import math
import re
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.evaluations import path_states, plate_curve
from furrow_post.analyse.grid_convergence import grid_convergence
from furrow_post.arrays import Booleans, Floats
from furrow_post.errors import ResultsError
from furrow_post.figures.style import save
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

HERE = Path(__file__).resolve().parent
PACKAGES = {"ccx": "calculix-ccx", "yade": "yade"}

YOUNG, POISSON, YIELD = 1e6, 0.3, 1e4  # [Pa], as in elastic.yaml and mises.yaml
BOX, DEPTH, SIZE = 0.6, 0.3, 0.2  # [m], as in ground.lig
ELASTIC_SINKAGE, MISES_SINKAGE = 0.005, 0.01  # [m]
STRAINS = (0.01, 0.04, 0.02)  # of the path of the point
INCREMENTS = 5  # of CalculiX on the Mises law
ELEMENTS = {"elastic": (6, 9, 12), "mises": (3, 6, 9)}  # along an edge of the quarter; 3 divides them
CELLS = {"50": 0.05, "33": 0.1 / 3, "25": 0.025, "17": 0.05 / 3}  # [m], by the end of a run's name
EARLY, BED_SINKAGE = 0.005, 0.01  # [m] of the plate on grains

Row = Mapping[str, object]


# ---- the other programs


def run_other(folder: Path, program: str, name: str, text: str, words: Sequence[str], result: str) -> Path:
    """The result file of another program for this input; made if it is not there. @raises ResultsError"""
    folder.mkdir(parents=True, exist_ok=True)
    source, found, done = folder / name, folder / result, folder / "done.txt"
    made_of = hashlib.sha256(text.encode()).hexdigest()
    if done.is_file() and done.read_text() == made_of:
        return found
    executable = shutil.which(program)
    if not executable:
        raise ResultsError(
            f"{program}: is not installed, and this study compares with it; install Debian's package "
            f"{PACKAGES[program]}"
        )
    for old in (done, found):
        old.unlink(missing_ok=True)
    source.write_text(text)
    command = ["nice", "-n", "10", "env", "OMP_NUM_THREADS=1", executable, *words]
    with open(folder / f"{name}.log", "w") as log:
        ended = subprocess.run(command, cwd=folder, stdout=log, stderr=subprocess.STDOUT)
    if ended.returncode or not found.is_file():
        raise ResultsError(f"{folder / name}: {program} failed; see {name}.log there")
    done.write_text(made_of)
    return found


def yade(run: Run, template: str, values: Mapping[str, object]) -> Floats:
    """The curve of the same test by Yade, from the grains of a run of Furrow."""
    grains, start = run.folder / "grains.txt", run.folder / "start.txt"
    made_of = hashlib.sha256(grains.read_bytes() + start.read_bytes()).hexdigest()
    folder = run.folder / "yade"
    text = f"# grains {made_of}\n" + (HERE / template).read_text()
    places: dict[str, object] = {"start": start, "grains": grains, "out": folder / "curve.txt"}
    for key, value in {**places, **values}.items():
        text = text.replace(f"@{key}@", str(value))
    curve: Floats = np.loadtxt(
        run_other(folder, "yade", "test.py", text, ("-n", "-x", "-j1", "test.py"), "curve.txt")
    )
    return curve


def calculix(folder: Path, name: str, deck: str) -> list[float]:
    """Vertical force of the node set PLATE on the ground at the end of each increment [N]."""
    file = run_other(folder / name, "ccx", f"{name}.inp", deck, ("-i", name), f"{name}.dat")
    return [-float(z) for z in re.findall(r"\n +\S+ +\S+ +(\S+)\n", file.read_text())]


def material(plastic: bool) -> str:
    law = f"*PLASTIC\n{YIELD:g},0\n" if plastic else ""
    return f"*MATERIAL, NAME=SOIL\n*ELASTIC\n{YOUNG:g},{POISSON:g}\n{law}*SOLID SECTION, ELSET=SOIL, MATERIAL=SOIL\n"


def mesh(points: Floats, elements: Sequence[Sequence[int]], kind: str) -> str:
    """points: (n, 3); elements: of indices from 0."""
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i},{x:.9g},{y:.9g},{z:.9g}" for i, (x, y, z) in enumerate(points, 1)]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=SOIL")
    for i, nodes in enumerate(elements, 1):
        words = [str(node + 1) for node in nodes]
        lines.append(f"{i}," + ",".join(words[:15]) + ("," if len(words) > 15 else ""))
        if len(words) > 15:
            lines.append(",".join(words[15:]))
    return "\n".join(lines) + "\n"


def node_set(name: str, chosen: Booleans) -> str:
    return f"*NSET, NSET={name}\n" + "".join(f"{i + 1},\n" for i in np.flatnonzero(chosen))


def loading(displacement: float, static: str, geometry: str) -> str:
    return (
        f"*STEP{geometry}, INC=1000\n*STATIC{static}\n*BOUNDARY\nPLATE,3,3,{displacement:.12g}\n"
        "*NODE PRINT, NSET=PLATE, TOTALS=ONLY\nRF\n*END STEP\n"
    )


CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
MIDDLES = ((1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
           (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1))  # fmt: skip


def plate_deck(count: int, plastic: bool) -> str:
    """A quarter of the layer in count^3 elements with quadratic shape functions (C3D20R)."""
    places: dict[tuple[int, int, int], int] = {}
    elements = []
    for i in range(count):
        for j in range(count):
            for k in range(count):
                corner = (2 * i, 2 * j, 2 * k)
                nodes = [tuple(c + d for c, d in zip(corner, o)) for o in (*CORNERS, *MIDDLES)]
                elements.append([places.setdefault((n[0], n[1], n[2]), len(places)) for n in nodes])
    points = np.array(list(places)) * np.array([BOX / 2, BOX / 2, DEPTH]) / (2 * count)
    x, y, z = points.T
    near = 1e-9
    text = mesh(points, elements, "C3D20R")
    text += node_set("BASE", z < near)
    text += node_set("SIDESX", (x < near) | (x > BOX / 2 - near))
    text += node_set("SIDESY", (y < near) | (y > BOX / 2 - near))
    text += node_set("PLATE", (z > DEPTH - near) & (x < SIZE / 2 + near) & (y < SIZE / 2 + near))
    text += material(plastic) + "*BOUNDARY\nBASE,1,3\nSIDESX,1\nSIDESY,2\n"
    static = f", DIRECT\n{1 / INCREMENTS:g},1" if plastic else ""
    return text + loading(-(MISES_SINKAGE if plastic else ELASTIC_SINKAGE), static, "")


def oedometer_deck() -> str:
    """One cube of 1 m without lateral strain, large deformations."""
    points = np.array(CORNERS) / 2.0
    text = mesh(points, [range(8)], "C3D8") + node_set("PLATE", points[:, 2] > 0.5)
    text += node_set("BASE", points[:, 2] < 0.5) + material(True) + "*BOUNDARY\nALL,1,2\nBASE,3\n"
    for strain in STRAINS:
        text += loading(math.exp(-strain) - 1, ", DIRECT\n0.05,1", ", NLGEOM")
    return text


# ---- comparisons


class Table:
    """Rows of results.csv (Furrow) and reference.csv (the other program), pair by pair."""

    def __init__(self) -> None:
        self.ours: list[Row] = []
        self.others: list[Row] = []

    def add(
        self, test: str, quantity: str, unit: str, program: str, ours: tuple[float, float],
        other: tuple[float, float],
    ) -> None:  # fmt: skip
        """ours, other: value and standard error."""
        key = {"test": test, "quantity": quantity, "unit": unit}
        relative = ours[0] / other[0] - 1
        self.ours.append({**key, **_cells(ours), "difference_percent": f"{100 * relative:.1f}"})
        self.others.append({**key, **_cells(other), "program": program})


def _cells(pair: tuple[float, float]) -> dict[str, str]:
    value, error = pair
    return {"value": f"{value:.5g}", "error": f"{error:.2g}"}


def add_point(table: Table, runs: Runs, folder: Path) -> None:
    run = runs.one("mises_oedometer")
    if not run:
        return
    states = path_states(run.folder, 100, 3)
    ends = calculix(folder, "oedometer", oedometer_deck())[19::20]  # twenty increments of a step
    for name, state, force in zip(("1 %", "4 %", "2 %, unloaded"), states, ends):
        ours = state["stress_zz"] / -1e3
        table.add("oedometer", f"axial stress at {name}", "kPa", "CalculiX", (ours, 0.0), (force / 1e3, 0.0))


def force_at(curve: Floats, sinkage: float) -> float:
    """Load of a plate that is pressed steadily, from a line through the last quarter before [N]."""
    part = (curve[:, 1] > 0.75 * sinkage) & (curve[:, 1] < sinkage + 1e-4)
    line = np.polyfit(curve[part, 1], curve[part, 2], 1)
    return float(np.polyval(line, sinkage))


def add_ground(table: Table, runs: Runs, folder: Path) -> dict[str, dict[float, Floats]]:
    """Adds the plate on the layer; the curves of CalculiX, (n, 2) sinkage and load, by law and size."""
    curves: dict[str, dict[float, Floats]] = {}
    for law, counts in ELEMENTS.items():
        sinkage = ELASTIC_SINKAGE if law == "elastic" else MISES_SINKAGE
        found = {cell: run for name, cell in CELLS.items() if (run := runs.one(f"{law}_{name}"))}
        if len(found) < 3:
            continue
        curves[law] = {}
        for count in counts:
            loads = [4 * f for f in calculix(folder, f"{law}_{count}", plate_deck(count, law == "mises"))]
            places = np.linspace(0, sinkage, len(loads) + 1)[1:]
            curves[law][BOX / 2 / count] = np.column_stack([places, loads])
        for place in (sinkage,) if law == "elastic" else (0.6 * sinkage, sinkage):
            ours = grid_convergence(
                list(found), [force_at(plate_curve(run.folder), place) for run in found.values()]
            )
            others = curves[law]
            other = grid_convergence(
                list(others), [float(np.interp(place, c[:, 0], c[:, 1])) for c in others.values()]
            )
            name = f"load at {1e3 * place:g} mm"
            test = f"plate, {law}"
            table.add(test, name, "N", "CalculiX", (ours.value, ours.error), (other.value, other.error))
    return curves


def default_spring(runs: Runs) -> list[Row]:
    """The load on the elastic layer with the contact's default spring, of each size of cells; error:
    the distance from the value extrapolated to zero cell size, and the error of that."""
    found = runs.done("elastic_*_soft")
    sizes = [run.number("cell") for run in found]
    loads = [force_at(plate_curve(run.folder), ELASTIC_SINKAGE) for run in found]
    if len(found) < 3:
        return []
    series = grid_convergence(sizes, loads)
    return [
        {"run": run.name, "cell_mm": f"{1e3 * size:.3g}", "load_N": f"{load:.5g}", "error_N": f"{series.size_error(size):.2g}"}
        for run, size, load in zip(found, sizes, loads)
    ]  # fmt: skip


def stresses(curve: Floats) -> dict[str, Floats]:
    """Of a cell, from columns step, three edges [m], three stresses [Pa]."""
    x, y, z = curve[:, 4:7].T / 1e3
    lateral = 0.5 * (x + y)
    sine = (z - lateral) / (z + lateral)
    return {"axial": z, "ratio": lateral / z, "angle": np.degrees(np.arcsin(sine))}


def cells(runs: Runs, test: str, fixed: bool) -> list[tuple[Floats, dict[str, Floats], Floats, dict[str, Floats]]]:
    """Of each packing: strain and stresses by Furrow, and by Yade."""
    found = []
    for run in runs.done(f"{test}_*"):
        values = {"strain": run.number("strain"), "rate": 0.4, "confinement": 5e4, "lateral_fixed": fixed}
        words = (run.folder / "start.txt").read_text().split()
        height = float(words[words.index("edge_z") + 1])
        ours, other = np.loadtxt(run.folder / "curve.txt"), yade(run, "yade_cell.txt", values)
        found.append(
            (np.log(height / ours[:, 3]), stresses(ours), np.log(height / other[:, 3]), stresses(other))
        )
    return found


def add_packings(
    table: Table, test: str, quantity: str, unit: str, pairs: Sequence[tuple[float, float]]
) -> None:
    """pairs: Furrow's value and Yade's of each packing; the error is that of the mean difference."""
    if len(pairs) < 2:
        return
    ours, others = np.array(pairs).T
    error = float(np.std(ours - others, ddof=1) / math.sqrt(len(pairs)))
    table.add(test, quantity, unit, "Yade", (float(ours.mean()), error), (float(others.mean()), 0.0))


def mean_between(x: Floats, values: Floats, low: float, high: float) -> float:
    return float(values[(x >= low) & (x <= high)].mean())


def add_grains(table: Table, runs: Runs) -> dict[str, list[tuple[Floats, Floats, Floats, Floats]]]:
    """Adds cells and plates of grains; what the figure draws: x and y of Furrow, of Yade, by test."""
    drawn: dict[str, list[tuple[Floats, Floats, Floats, Floats]]] = {}
    for test, fixed, rows in (
        ("triaxial", False, (("friction angle at 0.5 % strain", "degree", "angle", 0.0045, 0.0055),
                             ("friction angle at 2 % strain", "degree", "angle", 0.018, 0.022),
                             ("friction angle, 4 to 10 %", "degree", "angle", 0.04, 0.1))),
        ("oedometer", True, (("axial stress at 0.5 % strain", "kPa", "axial", 0.0045, 0.0055),
                             ("axial stress at 1.9 % strain", "kPa", "axial", 0.0185, 0.0195),
                             ("lateral over axial stress at 1.9 %", "-", "ratio", 0.0185, 0.0195))),
        ("undamped", True, (("axial stress at 1.9 % strain", "kPa", "axial", 0.0185, 0.0195),
                            ("lateral over axial stress at 1.9 %", "-", "ratio", 0.0185, 0.0195))),
    ):  # fmt: skip
        found = cells(runs, test, fixed)
        for quantity, unit, key, low, high in rows:
            pairs = [
                (mean_between(a, ours[key], low, high), mean_between(b, other[key], low, high))
                for a, ours, b, other in found
            ]
            name = "undamped oedometer" if test == "undamped" else test
            add_packings(table, f"grains, {name}", quantity, unit, pairs)
        drawn[test] = [(a, ours["axial"], b, other["axial"]) for a, ours, b, other in found]
    drawn["plate"] = []
    for run in runs.done("plate_*"):
        values = {"width": 0.12, "depth": 0.06, "size": 0.05, "speed": 0.05, "sinkage": BED_SINKAGE}
        ours, other = plate_curve(run.folder), yade(run, "yade_plate.txt", values)
        drawn["plate"].append((ours[:, 1], ours[:, 2], other[:, 1], other[:, 2]))
    for quantity, low, high in (
        ("mean load to 5 mm", 0.0, EARLY),
        ("mean load to 10 mm", 0.0, BED_SINKAGE),
    ):
        pairs = [
            (mean_between(a, ours, low, high), mean_between(b, other, low, high))
            for a, ours, b, other in drawn["plate"]
        ]
        add_packings(table, "grains, plate", quantity, "N", pairs)
    return drawn


def draw(
    runs: Runs, ground: Mapping[str, Mapping[float, Floats]],
    grains: Mapping[str, Sequence[tuple[Floats, Floats, Floats, Floats]]], target: Path,
) -> None:  # fmt: skip
    figure, panels = plt.subplots(2, 2, figsize=(10, 7), constrained_layout=True)
    first = panels[0, 0]
    for law, colour in (("elastic", "C0"), ("mises", "C3")):
        run = runs.one(f"{law}_17") or runs.one(f"{law}_25")
        if run and law in ground:
            curve = plate_curve(run.folder)
            part = curve[:, 1] >= 0
            first.plot(1e3 * curve[part, 1], curve[part, 2], colour, label=f"Furrow, {law}")
            finest = np.vstack([[0, 0], ground[law][min(ground[law])]])
            first.plot(1e3 * finest[:, 0], finest[:, 1], "o", color=colour, mfc="none", label=f"CalculiX, {law}")
    first.set(title="plate on a layer, finest meshes", xlabel="sinkage [mm]", ylabel="load [N]")
    for axes, test, scale, title, x_label, y_label in (
        (panels[0, 1], "triaxial", 100, "triaxial cell of 200 grains", "axial strain [%]", "axial stress [kPa]"),
        (panels[1, 0], "oedometer", 100, "oedometer cell of 200 grains", "axial strain [%]", "axial stress [kPa]"),
        (panels[1, 1], "plate", 1e3, "plate on 1000 grains", "sinkage [mm]", "load [N]"),
    ):  # fmt: skip
        for number, (a, ours, b, other) in enumerate(grains[test]):
            label = ("Furrow", "Yade") if number == 0 else (None, None)
            axes.plot(scale * a, ours, f"C{number}", lw=1.4, label=label[0])
            axes.plot(scale * b, other, f"C{number}--", lw=0.9, label=label[1])
        for number, (a, ours, _, _) in enumerate(grains["undamped"] if test == "oedometer" else ()):
            words = "Furrow, no tangential damping" if number == 0 else None
            axes.plot(scale * a, ours, f"C{number}:", lw=1.4, label=words)
        axes.set(title=f"{title}, three packings", xlabel=x_label, ylabel=y_label)
    for axes in panels.flat:
        axes.legend(frameon=False, fontsize=8)
    save(figure, target, dpi=90)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    table, folder = Table(), runs.executor.results / "calculix"
    add_point(table, runs, folder)
    ground = add_ground(table, runs, folder)
    grains = add_grains(table, runs)
    output.table("results.csv", table.ours)
    output.table("reference.csv", table.others)
    output.table("spring.csv", default_spring(runs))
    if table.ours:
        draw(runs, ground, grains, output.path("curves.png"))
    return []
