# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors against Table 6, its goals, and a table of each further part."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from furrow_post.analyse.evaluations import cost_ratio, tyre_states
from furrow_post.analyse.statistics import block_mean, rms
from furrow_post.csv_table import read_numbers, read_rows
from furrow_post.read.results import Results
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

HERE = Path(__file__).resolve().parent
AREA_GOAL = 0.10
DEFLECTION_GOAL = {"identification": 0.10, "prediction": 0.15}
HALF_TREAD = 0.0785  # [m] width of half the tread
BELT_RADIUS = 0.3475  # [m] as made
IDENTIFIED_AT = 2  # pressures
TIMED = [(whole, "meshes/6x72_half") for whole in ("table6", "meshes/6x72")]  # the same states
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


def mesh_table(runs: Runs) -> list[dict[str, object]]:
    found: list[dict[str, object]] = []
    for run in runs.ended("meshes"):
        mesh, _, half = run.name.rpartition("/")[2].partition("_")
        found += [
            {"mesh": mesh, "half": int(half == "half"), **row} for row in errors(tyre_states(run.folder))
        ]
    return found


def stress_table(runs: Runs) -> list[dict[str, object]]:
    """Pressures of the tread's lines from the middle to the edge, over the middle of the print."""
    found: list[dict[str, object]] = []
    for run in runs.ended("contact_stress"):
        rows = tyre_states(run.folder)
        mesh, spring = run.name.rpartition("/")[2].split("_")
        if len(rows) < 2:
            continue
        count = int(mesh.partition("x")[0]) // 2  # lines from the middle to the edge
        lines: list[list[float]] = [[] for _ in range(count + 1)]
        for node in read_numbers(run.folder / "207kPa_6627N_pressure.csv"):
            if abs(node["x_m"]) < MIDDLE_OF_PRINT:
                line = min(count, round(node["y_m"] / HALF_TREAD * count))
                lines[line].append(node["pressure_Pa"] / 1e3)
        means = [sum(line) / len(line) if line else 0.0 for line in lines]
        least = means.index(min(means))
        found.append(
            {
                "mesh": mesh,
                "tread_stiffness": int(spring),
                "mean_kPa": rows[1]["mean_pressure_kPa"],
                "largest_kPa": rows[1]["largest_pressure_kPa"],
                "middle_kPa": round(means[0], 1),
                "edge_kPa": round(means[-1], 1),
                "least_line_kPa": round(means[least], 1),
                "least_line_from_edge_mm": round(1e3 * HALF_TREAD * (1 - least / count), 1),
            }
        )
    return found


def inflated_table(run: Run) -> list[dict[str, object]]:
    """Size of the tyre without load, of cords and belts, without the rubber outside of them;
    growth from the lowest pressure on."""
    unloaded = [row for row in tyre_states(run.folder) if row["load_N"] == 0]
    return [
        {
            "run": run.name,
            "pressure_kPa": row["pressure_kPa"],
            "diameter_cm": round(2 * row["crown_radius_cm"], 3),
            "growth": round(row["crown_radius_cm"] / unloaded[0]["crown_radius_cm"] - 1, 5),
            "section_width_cm": row["section_width_cm"],
        }
        for row in unloaded
    ]


def rolling_row(run: Run) -> dict[str, object]:
    """Resistance of rolling, mean over the last turn, with the error of eight blocks."""
    wheel = Results(run.folder).columns
    turn = wheel["x"] > wheel["x"][-1] - 2 * math.pi * BELT_RADIUS
    mean, error = block_mean(-wheel["force_x"][turn])
    return {
        "damping": round(run.number("damping")),
        "resistance_N": round(mean, 2),
        "resistance_error_N": round(error, 2),
        "deflection_mm": round(1e3 * float(wheel["hub_drop"][turn].mean()), 2),
        "user_s": run.seconds,
    }


def identification_row(run: Run) -> dict[str, object]:
    """End springs and link against deflection and area at the two pressures."""
    words = [str(word) for word in run.case.arguments]
    rim, tread, link = (
        float(words[words.index(key) + 1]) for key in ("--rim-stiffness", "--tread-stiffness", "--link")
    )
    table = errors(tyre_states(run.folder))
    parts = [number(row, key) for row in table for key in ("deflection_error", "area_error")]
    misfit = rms(parts) if len(table) == IDENTIFIED_AT else math.nan
    return {
        "rim_stiffness": round(rim),
        "tread_stiffness": round(tread),
        "link_axial_m": link,
        "rms_error": round(misfit, 4),
    }


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    of_table6 = [state for run in runs.ended("table6") for state in tyre_states(run.folder)]
    table = errors(of_table6)
    output.table("table6.csv", table)
    output.table("meshes.csv", mesh_table(runs))
    states = [state for run in runs.ended("load_deflection") for state in tyre_states(run.folder)]
    output.table("load_deflection.csv", states)
    output.table("contact_stress.csv", stress_table(runs))
    # a refused state has the unloaded one alone
    hard: list[dict[str, object]] = [
        {"case": run.what, **state}
        for run in runs.ended("hard_cases")
        for state in tyre_states(run.folder)
    ]
    output.table("hard_cases.csv", hard)
    output.table("identification.csv", [identification_row(run) for run in runs.ended("identification")])
    inflated = [row for run in runs.ended("table6", "meshes/*_half") for row in inflated_table(run)]
    output.table("inflated.csv", inflated)
    output.table("rolling.csv", [rolling_row(run) for run in runs.done("rolling")])
    seconds = [{"run": run.name, "user_s": run.seconds} for run in runs.ended("*")]
    output.table("costs.csv", seconds)
    timed = {str(row["run"]): float(row["user_s"]) for row in output.known("costs.csv", seconds)}
    output.table("timing.csv", cost_ratio("whole over half", timed, TIMED))
    return list(missed_goals(table))
