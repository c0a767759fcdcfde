#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The tyre of [Shoop2001] on a rigid plane (Table 6): identification at two pressures, prediction
of the other two, and what lies around it. See README.md.

Makes the runs that are missing and prints and writes one table per part. --check makes Table 6
alone with the tyre file as it stands, and fails beyond the goals: area within 10 % everywhere,
deflection within 10 % at 103 and 241 kPa and 15 % at 138 and 179 kPa.
"""

import csv
import itertools
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

from furrow_post.analyse.statistics import block_mean, rms
from furrow_post.csv_table import read_numbers, read_rows
from furrow_post.read.results import Results
from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case
from furrow_post.study.launch import SCREEN
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

TYRE = PROJECT / "inputs/tyres/p235_75r15.yaml"
LOAD = 6227  # [N]
AREA_GOAL = 0.10
DEFLECTION_GOAL = {"identification": 0.10, "prediction": 0.15}
HALF_TREAD = 0.0785  # [m] width of half the tread
BELT_RADIUS = 0.3475  # [m] as made
MIDDLE_OF_PRINT = 0.05  # [m] to both sides of its middle along the travel

PRESSURES = (103, 138, 179, 241)  # [kPa] of Table 6
IDENTIFIED_AT = (103, 241)  # [kPa]
Mesh = tuple[int, int]  # elements across and around


@dataclass(frozen=True)
class Measured:
    """A row of Table 6."""

    pressure: float  # [kPa]
    area: float  # [cm2]
    deflection: float  # [cm]
    section_width: float  # [cm]
    used_for: str  # identification or prediction


def reference() -> list[Measured]:
    return [
        Measured(
            float(row["pressure_kPa"]),
            float(row["area_cm2"]),
            float(row["deflection_cm"]),
            float(row["section_width_cm"]),
            row["used_for"],
        )
        for row in read_rows(HERE / "reference.csv")
    ]


def pressed(
    name: str,
    stage: str,
    pressures: Sequence[Value],
    loads: Sequence[Value],
    mesh: Mesh,
    *options: Value,
) -> Case:
    """The tyre inflated [kPa] and pressed on the plane [N]; options: of furrow-tyre.

    Some states are refused, which is a result; the first table must be complete (missed_goals).
    """
    arguments: tuple[Value, ...] = (
        TYRE,
        "--pressure",
        *pressures,
        "--load",
        *loads,
        "--mesh",
        *mesh,
        *options,
    )
    return Case(name, "furrow-tyre", arguments, stage=stage, may_fail=True)


def mesh_name(mesh: Mesh) -> str:
    return f"{mesh[0]}x{mesh[1]}"


# End springs of the sidewall at rim and tread [N m/rad/m], link to the tread's edge, axially [m]
SPRINGS_AND_LINKS = tuple(itertools.product([1, 30, 300], [1, 30, 300], [0, -0.01]))
MESHES = (((4, 36), True), ((6, 72), True), ((6, 72), False), ((12, 144), True))  # half model?
TREAD_SPRINGS = tuple(itertools.product([10, 50], [(6, 72), (12, 144), (20, 240)]))
HARD_CASES = (  # name, pressure [kPa], load [N], options
    ("low pressure, high load", 69, 5000, ()),
    ("bottomed", 69, 8000, ()),
    ("nearly flat", 20, 1000, ()),
    ("without air", 0, 200, ("--direct",)),
)
BASE_MESH = (6, 72)

TABLE6 = pressed("table6", "table6", PRESSURES, [LOAD], BASE_MESH)
LOAD_DEFLECTION = pressed(
    "load_deflection",
    "load_deflection",
    (103, 179, 241),
    range(1000, 8001, 1000),
    BASE_MESH,
    "--half",
)
MESH_CASES = tuple(
    pressed(
        f"meshes/{mesh_name(mesh)}{'_half' if half else ''}",
        "meshes",
        PRESSURES,
        [LOAD],
        mesh,
        *(["--half"] if half else []),
    )
    for mesh, half in MESHES
)
STRESS_CASES = tuple(
    pressed(
        f"contact_stress/{mesh_name(mesh)}_{spring}",
        "contact_stress",
        [207],
        [6627],
        mesh,
        "--half",
        "--tread-stiffness",
        spring,
        "--folder",
        FOLDER,
    )
    for spring, mesh in TREAD_SPRINGS
)
HARD = tuple(
    pressed(
        f"hard_cases/{name.replace(', ', '_').replace(' ', '_')}",
        "hard_cases",
        [pressure],
        [load],
        BASE_MESH,
        "--half",
        *options,
    )
    for name, pressure, load, options in HARD_CASES
)
IDENTIFICATION = tuple(
    pressed(
        f"identification/{rim}_{tread}_{abs(axial)}",
        "identification",
        IDENTIFIED_AT,
        [LOAD],
        BASE_MESH,
        "--half",
        "--rim-stiffness",
        rim,
        "--tread-stiffness",
        tread,
        "--link",
        axial,
        0,
    )
    for rim, tread, axial in SPRINGS_AND_LINKS
)
# Rolling on the plane at 8 km/h, friction 0.825 as in the report, two turns: damping of the tread
# [1/s]
DAMPINGS = (20, 100, 300)
ROLLING_DISTANCE = 4.5  # [m]
ROLLING = tuple(
    script_case(
        f"rolling/{damping}",
        PROJECT / "inputs/scenes/tyre_on_plane.lig",
        {"damping": damping, "length": ROLLING_DISTANCE, "friction": 0.825},
        stage="rolling",
    )
    for damping in DAMPINGS
)
CASES = (
    TABLE6,
    *MESH_CASES,
    LOAD_DEFLECTION,
    *STRESS_CASES,
    *HARD,
    *IDENTIFICATION,
    *ROLLING,
)


def states(runner: Runner, case: Case) -> list[dict[str, float]]:
    """Lines that furrow-tyre printed, also before it refused a state; the first has no load."""
    if not runner.ended(case):
        return []
    with open(runner.folder(case) / SCREEN, encoding="utf-8") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def errors(rows: Sequence[dict[str, float]]) -> list[dict[str, float | str]]:
    """Relative errors of the loaded states against Table 6, pressure by pressure."""
    return [
        {
            "pressure_kPa": row["pressure_kPa"],
            "used_for": measured.used_for,
            "deflection_cm": row["deflection_cm"],
            "deflection_error": row["deflection_cm"] / measured.deflection - 1,
            "area_cm2": row["perimeter_area_cm2"],
            "area_error": row["perimeter_area_cm2"] / measured.area - 1,
            "section_width_cm": row["section_width_cm"],
            "section_width_error": row["section_width_cm"] / measured.section_width - 1,
        }
        for measured in reference()
        for row in rows
        if row["load_N"] > 0 and abs(row["pressure_kPa"] - measured.pressure) < 0.5
    ]


def number(row: dict[str, float | str], key: str) -> float:
    return float(row[key])


def missed_goals(table: Sequence[dict[str, float | str]]) -> Iterator[str]:
    """What lies beyond the goals, and pressures without a result."""
    seen = {round(number(row, "pressure_kPa")) for row in table}
    for measured in reference():
        if round(measured.pressure) not in seen:
            yield f"{measured.pressure:.0f} kPa: no result"
    for row in table:
        pressure = f"{number(row, 'pressure_kPa'):.0f} kPa"
        deflection_goal = DEFLECTION_GOAL[str(row["used_for"])]
        for what, goal in (("area", AREA_GOAL), ("deflection", deflection_goal)):
            error = number(row, f"{what}_error")
            if abs(error) > goal:
                yield f"{pressure}: {what} {100 * error:+.1f} %, goal {100 * goal:.0f} %"


def mesh_table(runner: Runner) -> list[dict[str, object]]:
    return [
        {"mesh": mesh_name(mesh), "half": int(half), **row}
        for case, (mesh, half) in zip(MESH_CASES, MESHES)
        for row in errors(states(runner, case))
    ]


def stress_table(runner: Runner) -> list[dict[str, object]]:
    """Pressures of the tread's lines from the middle to the edge, over the middle of the print."""
    found: list[dict[str, object]] = []
    for case, (spring, mesh) in zip(STRESS_CASES, TREAD_SPRINGS):
        rows = states(runner, case)
        if len(rows) < 2:
            continue
        count = mesh[0] // 2  # lines from the middle to the edge
        lines: list[list[float]] = [[] for _ in range(count + 1)]
        for node in read_numbers(runner.folder(case) / "207kPa_6627N_pressure.csv"):
            if abs(node["x_m"]) < MIDDLE_OF_PRINT:
                line = min(count, round(node["y_m"] / HALF_TREAD * mesh[0] / 2))
                lines[line].append(node["pressure_Pa"] / 1e3)
        means = [sum(line) / len(line) if line else 0.0 for line in lines]
        least = means.index(min(means))
        found.append(
            {
                "mesh": mesh_name(mesh),
                "tread_stiffness": spring,
                "mean_kPa": rows[1]["mean_pressure_kPa"],
                "largest_kPa": rows[1]["largest_pressure_kPa"],
                "middle_kPa": round(means[0], 1),
                "edge_kPa": round(means[-1], 1),
                "least_line_kPa": round(means[least], 1),
                "least_line_from_edge_mm": round(1e3 * HALF_TREAD * (1 - least / count), 1),
            }
        )
    return found


def inflated_table(runner: Runner) -> list[dict[str, object]]:
    """Size of the tyre without load, of cords and belts, without the rubber outside of them;
    growth from the lowest pressure on."""
    unloaded = [row for row in states(runner, TABLE6) if row["load_N"] == 0]
    return [
        {
            "pressure_kPa": row["pressure_kPa"],
            "diameter_cm": round(2 * row["crown_radius_cm"], 3),
            "growth": round(row["crown_radius_cm"] / unloaded[0]["crown_radius_cm"] - 1, 5),
            "section_width_cm": row["section_width_cm"],
        }
        for row in unloaded
    ]


def rolling_table(runner: Runner) -> list[dict[str, object]]:
    """Resistance of rolling, mean over the last turn, with the error of eight blocks."""
    found: list[dict[str, object]] = []
    for case, damping in zip(ROLLING, DAMPINGS):
        if record := runner.record(case):
            wheel = Results(runner.folder(case)).columns
            turn = wheel["x"] > wheel["x"][-1] - 2 * math.pi * BELT_RADIUS
            mean, error = block_mean(-wheel["force_x"][turn])
            found.append(
                {
                    "damping": damping,
                    "resistance_N": round(mean, 2),
                    "resistance_error_N": round(error, 2),
                    "deflection_mm": round(1e3 * float(wheel["sinkage"][turn].mean()), 2),
                    "user_s": round(record.cpu_time, 1),
                }
            )
    return found


def cost_table(runner: Runner) -> list[dict[str, object]]:
    """Of every run, failed ones too."""
    known = ((case, runner.ended(case)) for case in CASES)
    return [{"run": c.name, "user_s": round(r.cpu_time, 1)} for c, r in known if r]


def hard_table(runner: Runner) -> list[dict[str, object]]:
    """States of the hard cases; a refused one has the unloaded state alone."""
    return [
        {"case": name, **row}
        for case, (name, *_) in zip(HARD, HARD_CASES)
        for row in states(runner, case)
    ]


def identification_table(runner: Runner) -> list[dict[str, object]]:
    """End springs and link against deflection and area at the two pressures."""
    found: list[dict[str, object]] = []
    for case, (rim, tread, axial) in zip(IDENTIFICATION, SPRINGS_AND_LINKS):
        if not runner.ended(case):
            continue
        table = errors(states(runner, case))
        parts = [number(row, key) for row in table for key in ("deflection_error", "area_error")]
        misfit = rms(parts) if len(table) == len(IDENTIFIED_AT) else float("nan")
        found.append(
            {
                "rim_stiffness": rim,
                "tread_stiffness": tread,
                "link_axial_m": axial,
                "rms_error": round(misfit, 4),
            }
        )
    return found


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    table = errors(states(runner, TABLE6))
    output.table("table6.csv", table)
    output.table("meshes.csv", mesh_table(runner))
    output.table("load_deflection.csv", states(runner, LOAD_DEFLECTION))
    output.table("contact_stress.csv", stress_table(runner))
    output.table("hard_cases.csv", hard_table(runner))
    output.table("identification.csv", identification_table(runner))
    output.table("inflated.csv", inflated_table(runner))
    output.table("rolling.csv", rolling_table(runner))
    output.table("costs.csv", cost_table(runner))
    return list(missed_goals(table))


def in_table6(case: Case) -> bool:
    return case is TABLE6


if __name__ == "__main__":
    study = Study(Path(__file__), __doc__ or "", CASES, evaluate, checked=in_table6)
    sys.exit(run_study(study))
