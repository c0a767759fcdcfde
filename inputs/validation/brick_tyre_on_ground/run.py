#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tyres with a tread of rubber on soft ground, beside a rigid wheel of the smooth one's outline and
the tyre of [Shoop2001] Table 8. See README.md.

Makes the runs that are missing, writes results.csv and the page's table. --check makes two runs
again that take seconds, and compares them with the stored ones.
"""

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
INPUTS = HERE.parents[1]
sys.path.insert(0, str(INPUTS.parent / "postproc"))

from furrow_post.analyse.statistics import block_mean
from furrow_post.csv_table import read_matrix, read_rows
from furrow_post.read.results import Results
from furrow_post.study.case import Case, Value
from furrow_post.study.furrow_cases import script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study
from furrow_post.study.tables import markdown

PRESSURE = 241  # [kPa]
SECTIONS = 60
RIM = "mass 30 inertia 1"


@dataclass(frozen=True)
class Wheel:
    """What is towed."""

    words: str  # of its fix, for a half model
    radius: float  # [m] without load, inflated
    deforms: bool = True

    def body(self, half: bool) -> str:
        return self.words if half else self.words.replace("half yes", "half no")


def brick(tread: str) -> Wheel:
    file = INPUTS / f"tyres/p235_75r15_{tread}.yaml"
    words = f"tyre/brick file {file} pressure {PRESSURE}e3 sections {SECTIONS} half yes {RIM}"
    return Wheel(words, 0.373)


WHEELS = {
    # Outline of the inflated smooth tyre: its tread is flat between the shoulders
    "rigid": Wheel(
        "wheel/rigid diameter 0.746 width 0.236 shoulder 0.045 mass 36.7 inertia 1.81 segments 60",
        0.373,
        deforms=False,
    ),
    "darnell": Wheel(
        f"tyre/darnell file {INPUTS / 'tyres/p235_75r15.yaml'} pressure {PRESSURE}e3 mesh 4 36 "
        f"half yes {RIM}",
        0.3483,
    ),
    "smooth": brick("smooth"),
    "lugged": brick("lugged"),
    "ribbed": brick("ribbed"),
}
SMOOTH = ("rigid", "darnell", "smooth")


@dataclass(frozen=True)
class Ground:
    """Where it is towed."""

    script: str
    half: bool  # half a model
    window: float  # [m] of travel before the end, over which is averaged
    variables: dict[str, Value]


MATERIALS = INPUTS / "materials"
GROUNDS = {
    "snow": Ground("ground.lig", True, 0.5, {"material": MATERIALS / "field_snow.yaml"}),
    "sand": Ground(
        "ground.lig", True, 0.5, {"material": MATERIALS / "dry_sand.yaml", "friction": 0.5}
    ),
    "grains": Ground("grains.lig", False, 0.2, {}),
    "clusters": Ground("clusters.lig", False, 0.2, {}),
}
ON = {
    "snow": tuple(WHEELS),
    "sand": SMOOTH,
    "grains": SMOOTH,
    "clusters": SMOOTH,
}


def rolled(ground: str, wheel: str) -> Case:
    where, what = GROUNDS[ground], WHEELS[wheel]
    given: dict[str, Value] = {
        **where.variables,
        "body": what.body(where.half),
        "radius": what.radius,
        "deflection": "f_wheel[1]" if what.deforms else "0",
    }
    return script_case(f"ground/{ground}_{wheel}", HERE / where.script, given, stage="ground")


CHECKED = "snow", "smooth"
SAME = 0.02  # relative difference of a run that is made again
CASES = {(ground, wheel): rolled(ground, wheel) for ground in ON for wheel in ON[ground]}


def row_of(ground: str, wheel: str, folder: Path) -> dict[str, Any]:
    """Means over the last part of the travel, and the standard error of c of eight blocks.

    A tyre's deflection, and what its hub has sunk in, are counted from the inflated shape, which
    the first row of watch.txt has: there it does not touch the ground yet.
    """
    history = Results(folder).columns
    last = history["x"] > history["x"][-1] - GROUNDS[ground].window
    load = history["force_z"][last].mean()
    c, error = block_mean(-history["force_x"][last] / load)
    watch = read_matrix(folder / "watch.txt", 2)
    steps = watch[-1, 0] - watch[0, 0]
    since = (watch[:, 0] - watch[0, 0]) / steps
    start = (history["time"][last][0] - history["time"][0]) / (
        history["time"][-1] - history["time"][0]
    )
    unloaded = watch[0, 1]
    deflection = watch[since > start, 1].mean() - unloaded
    hub = history["hub_drop"][last].mean() - unloaded
    return {
        "run": f"{ground}_{wheel}",
        "hub_mm": round(1e3 * hub, 1),
        "deflection_mm": round(1e3 * deflection, 1),
        "rut_mm": round(1e3 * (hub - deflection), 1),
        "c": round(c, 4),
        "c_error": round(error, 4),
        "load_N": round(load),
        "slip": round(history["slip"][last].mean(), 3),
    }


def in_check(case: Case) -> bool:
    return case is CASES[CHECKED]


def changed(again: Sequence[dict[str, Any]], before: Sequence[dict[str, str]]) -> Iterator[str]:
    """What differs of runs made again from those that are stored."""
    stored = {row["run"]: row for row in before}
    for row in again:
        if old := stored.get(row["run"]):
            for what in ("hub_mm", "deflection_mm", "c"):
                if abs(row[what] - float(old[what])) > SAME * abs(float(old[what])):
                    yield f"{row['run']}: {what} {row[what]} was {old[what]}"


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    rows = [
        {
            **row_of(ground, wheel, runner.folder(case)),
            "user_s": round(record.cpu_time, 1),
        }
        for (ground, wheel), case in CASES.items()
        if (record := runner.record(case))
    ]
    output.table("results.csv", rows)
    output.section(page_lines(rows))
    stored = HERE / "results.csv"
    return list(changed(rows, read_rows(stored))) if stored.is_file() else []


def page_lines(rows: Sequence[dict[str, Any]]) -> list[str]:
    head = ("run", "hub mm", "deflection mm", "rut mm", "c", "±", "load N", "slip", "core s")
    return markdown(head, ([str(value) for value in row.values()] for row in rows))


if __name__ == "__main__":
    study = Study(Path(__file__), __doc__ or "", list(CASES.values()), evaluate, checked=in_check)
    sys.exit(run_study(study))
