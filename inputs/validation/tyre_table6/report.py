# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: errors against Table 6, its goals, and a table of each further part."""

import csv
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import cases

from furrow_post.analyse.statistics import block_mean, rms
from furrow_post.csv_table import read_numbers, read_rows
from furrow_post.read.results import Results
from furrow_post.study.case import Case
from furrow_post.study.launch import SCREEN
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner

HERE = Path(__file__).resolve().parent
AREA_GOAL = 0.10
DEFLECTION_GOAL = {"identification": 0.10, "prediction": 0.15}
HALF_TREAD = 0.0785  # [m] width of half the tread
BELT_RADIUS = 0.3475  # [m] as made
MIDDLE_OF_PRINT = 0.05  # [m] to both sides of its middle along the travel


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
        {"mesh": cases.mesh_name(mesh), "half": int(half), **row}
        for case, (mesh, half) in zip(cases.MESH_CASES, cases.MESHES)
        for row in errors(states(runner, case))
    ]


def stress_table(runner: Runner) -> list[dict[str, object]]:
    """Pressures of the tread's lines from the middle to the edge, over the middle of the print."""
    found: list[dict[str, object]] = []
    for case, (spring, mesh) in zip(cases.STRESS_CASES, cases.TREAD_SPRINGS):
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
                "mesh": cases.mesh_name(mesh),
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
    unloaded = [row for row in states(runner, cases.TABLE6) if row["load_N"] == 0]
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
    for case, damping in zip(cases.ROLLING, cases.DAMPINGS):
        if record := runner.record(case):
            wheel = Results(runner.folder(case)).columns
            turn = wheel["x"] > wheel["x"][-1] - 2 * math.pi * BELT_RADIUS
            mean, error = block_mean(-wheel["force_x"][turn])
            found.append(
                {
                    "damping": damping,
                    "resistance_N": round(mean, 2),
                    "resistance_error_N": round(error, 2),
                    "deflection_mm": round(1e3 * float(wheel["hub_drop"][turn].mean()), 2),
                    "user_s": round(record.cpu_time, 1),
                }
            )
    return found


def cost_table(runner: Runner) -> list[dict[str, object]]:
    """Of every run, failed ones too."""
    known = ((case, runner.ended(case)) for case in cases.CASES)
    return [{"run": c.name, "user_s": round(r.cpu_time, 1)} for c, r in known if r]


def hard_table(runner: Runner) -> list[dict[str, object]]:
    """States of the hard cases; a refused one has the unloaded state alone."""
    return [
        {"case": name, **row}
        for case, (name, *_) in zip(cases.HARD, cases.HARD_CASES)
        for row in states(runner, case)
    ]


def identification_table(runner: Runner) -> list[dict[str, object]]:
    """End springs and link against deflection and area at the two pressures."""
    found: list[dict[str, object]] = []
    for case, (rim, tread, axial) in zip(cases.IDENTIFICATION, cases.SPRINGS_AND_LINKS):
        if not runner.ended(case):
            continue
        table = errors(states(runner, case))
        parts = [number(row, key) for row in table for key in ("deflection_error", "area_error")]
        misfit = rms(parts) if len(table) == len(cases.IDENTIFIED_AT) else float("nan")
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
    table = errors(states(runner, cases.TABLE6))
    output.table("table6.csv", table)
    output.table("meshes.csv", mesh_table(runner))
    output.table("load_deflection.csv", states(runner, cases.LOAD_DEFLECTION))
    output.table("contact_stress.csv", stress_table(runner))
    output.table("hard_cases.csv", hard_table(runner))
    output.table("identification.csv", identification_table(runner))
    output.table("inflated.csv", inflated_table(runner))
    output.table("rolling.csv", rolling_table(runner))
    output.table("costs.csv", cost_table(runner))
    return list(missed_goals(table))
