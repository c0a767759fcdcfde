# SPDX-License-Identifier: GPL-2.0-or-later
"""Curves of the same tests by Furrow, CalculiX and Yade. The other programs run in the results folder, as Furrow does."""

import hashlib
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from furrow_post.analyse.evaluations import plate_curve
from furrow_post.arrays import Floats
from furrow_post.run.case import Case
from furrow_post.study.runs import Run, Runs

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import decks


def calculix(runs: Runs, texts: dict[str, str]) -> list[list[float]]:
    """Results of each input: vertical force of the node set PLATE on the ground at the end of each increment [N]."""
    cases = [Case(f"calculix/{name}", "ccx", ("-i", name), files={f"{name}.inp": text}) for name, text in texts.items()]
    made = runs.executor.completed(cases)
    results = [(run.folder / f"{name}.dat").read_text() for run, name in zip(made, texts)]
    return [[-float(z) for z in re.findall(r"\n +\S+ +\S+ +(\S+)\n", text)] for text in results]


def point(runs: Runs) -> list[dict[str, Any]]:
    """Ends of the three steps of the oedometer, of twenty increments each."""
    if not runs.one("mises_oedometer"):
        return []
    (forces,) = calculix(runs, {"oedometer": decks.oedometer()})
    return [{"step": step, "force": force} for step, force in enumerate(forces[19::20])]


def layer(runs: Runs, law: str, counts: Sequence[int], sinkage: float) -> list[dict[str, Any]]:
    """Loads on the layer at the ends of increments. counts: of elements along an edge of the quarter."""
    if len(runs.done(f"{law}_??")) < 3:
        return []
    found = calculix(runs, {f"{law}_{count}": decks.plate(count, sinkage, law == "mises") for count in counts})
    places = [np.linspace(0, sinkage, len(forces) + 1)[1:] for forces in found]
    return [
        {"law": law, "size": decks.BOX / 2 / count, "sinkage": float(z), "load": 4 * force}
        for count, forces, steps in zip(counts, found, places)
        for z, force in zip(steps, forces)
    ]


def yade(runs: Runs, run: Run, template: str, **values: Any) -> Floats:
    """The curve of the same test by Yade, from the grains of a run of Furrow."""
    files: dict[str, Any] = {"start": run.folder / "start.txt", "grains": run.folder / "grains.txt"}
    made_of = hashlib.sha256(files["grains"].read_bytes() + files["start"].read_bytes()).hexdigest()
    text = f"# grains {made_of}\n" + (HERE / template).read_text()
    for key, value in {**files, "out": "curve.txt", **values}.items():
        text = text.replace(f"@{key}@", str(value))
    case = Case(f"yade/{run.name}", "yade", ("-n", "-x", "-j1", "test.py"), files={"test.py": text})
    (other,) = runs.executor.completed([case])
    curve: Floats = np.loadtxt(other.folder / "curve.txt")
    return curve


def cells(runs: Runs, test: str, lateral_fixed: bool) -> list[dict[str, Any]]:
    """x: axial strain of a cell; axial: stress [kPa]; ratio: lateral over axial stress; angle: of friction [degree]."""
    rows = []
    for run in runs.done(f"{test}_*"):
        words = (run.folder / "start.txt").read_text().split()
        height = float(words[words.index("edge_z") + 1])
        strain = run.number("strain")
        other = yade(runs, run, "yade_cell.txt", strain=strain, rate=0.4, confinement=5e4, lateral_fixed=lateral_fixed)
        for program, curve in (("Furrow", np.loadtxt(run.folder / "curve.txt")), ("Yade", other)):
            x, y, z = curve[:, 4:7].T / 1e3
            side = 0.5 * (x + y)
            angle = np.degrees(np.arcsin((z - side) / (z + side)))
            columns = zip(np.log(height / curve[:, 3]), z, side / z, angle)
            same = {"test": test, "run": run.name, "program": program}
            rows += [{**same, **dict(zip(("x", "axial", "ratio", "angle"), row))} for row in columns]
    return rows


def bed(runs: Runs, **values: float) -> list[dict[str, Any]]:
    """x: sinkage of the plate on grains [m]; axial: its load [N]."""
    rows = []
    for run in runs.done("plate_*"):
        for program, curve in (("Furrow", plate_curve(run.folder)), ("Yade", yade(runs, run, "yade_plate.txt", **values))):
            same = {"test": "plate", "run": run.name, "program": program}
            rows += [{**same, "x": x, "axial": load} for x, load in curve[:, 1:3]]
    return rows
