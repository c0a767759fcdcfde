# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: tables, the page's section, the map of contact stress."""

import csv
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt

import cases
import choice
import shapes

from furrow_post.analyse.statistics import block_mean
from furrow_post.csv_table import read_numbers, read_rows
from furrow_post.errors import ResultsError
from furrow_post.figures.style import save
from furrow_post.read.results import Results
from furrow_post.study.case import Case
from furrow_post.study.launch import SCREEN
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.tables import markdown

MEASURED = cases.HERE.parent / "tyre_table6" / "reference.csv"
WALL = 1.2  # [cm] rubber outside of the carcass, both sides; assumed
GOAL = 0.10
SAME = 5e-3  # relative difference of a state that is made again
CHECKED = ("deflection_cm", "area_cm2", "section_width_cm")
MIDDLE = 1e-3  # [m] from the middle of the print: its nodes there
# [m] y from the middle of one groove of the ribbed tyre to that of the next
RIBS = {"centre": (0.0, 0.0198), "middle": (0.0198, 0.0516), "shoulder": (0.0516, 0.1)}
STEADY = 1.2  # [m] of rolling at the end of which the mean is taken

Row = dict[str, Any]


def states(runner: Runner, case: Case) -> list[dict[str, float]]:
    """Lines that furrow-tyre printed, also before it refused a state; the first has no load."""
    if not runner.ended(case):
        return []
    with open(runner.folder(case) / SCREEN, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    try:
        return [{key: float(value) for key, value in row.items()} for row in rows]
    except (TypeError, ValueError) as error:
        raise ResultsError(f"{runner.folder(case) / SCREEN}: is not furrow-tyre's table") from error


def cost(runner: Runner, case: Case) -> float:
    """[core s] of a run that was made."""
    record = runner.ended(case)
    return round(record.cpu_time, 1) if record else 0.0


def errors(rows: Sequence[dict[str, float]], load: float = cases.LOAD) -> list[Row]:
    """The states of Table 6, and their relative errors."""
    found: list[Row] = []
    for measured in read_rows(MEASURED):
        pressure = float(measured["pressure_kPa"])
        for row in rows:
            if row["load_N"] != load or abs(row["pressure_kPa"] - pressure) > 0.5:
                continue
            mine: Row = {
                "pressure_kPa": round(pressure),
                "used_for": measured["used_for"],
                "touching_area_cm2": row["nodal_area_cm2"],
            }
            for what, value in (
                ("deflection_cm", row["deflection_cm"]),
                ("area_cm2", row["perimeter_area_cm2"]),
                ("section_width_cm", row["section_width_cm"] + WALL),
            ):
                mine[what] = round(value, 3)
                name = what.removesuffix("_cm2").removesuffix("_cm")
                mine[f"{name}_error"] = round(value / float(measured[what]) - 1, 4)
            found.append(mine)
    return found


def inflated(rows: Sequence[dict[str, float]]) -> list[Row]:
    """Size without load, rubber included."""
    return [
        {
            "pressure_kPa": round(row["pressure_kPa"]),
            "diameter_cm": round(2 * row["crown_radius_cm"], 2),
            "width_cm": round(row["section_width_cm"] + WALL, 2),
        }
        for row in rows
        if row["load_N"] == 0
    ]


def between_table(runner: Runner) -> list[Row]:
    """From the smooth tyre to its equivalent, one change after the other."""
    found: list[Row] = []
    for name, case in {
        "smooth": cases.BETWEEN_FIRST,
        **cases.BETWEEN,
        "and rubber of 0.2 MPa: equivalent": cases.TABLE6,
    }.items():
        rows = states(runner, case)
        for row in errors(rows):
            if row["pressure_kPa"] == cases.BETWEEN_AT:
                size = inflated(rows)[-1]
                kept = ("deflection_cm", "deflection_error", "area_cm2", "area_error")
                found.append({"tyre": name, **size, **{key: row[key] for key in kept}})
    return found


def stored(name: str) -> list[Row]:
    """A table of Table 6's columns beside this file."""
    return [
        {key: text if key == "used_for" else float(text) for key, text in row.items()}
        for row in read_rows(cases.HERE / name)
    ]


def changed(again: Sequence[Row], before: Sequence[Row]) -> Iterator[str]:
    """What differs of states made again from those that are stored."""
    for row, old in zip(again, before, strict=True):
        for what in CHECKED:
            change = row[what] / old[what] - 1
            if abs(change) > SAME:
                yield (
                    f"{row['pressure_kPa']:.0f} kPa, {cases.COARSE} sections: {what} {row[what]} "
                    f"was {old[what]}, {100 * change:+.2f} %; the tables are of another program"
                )


def missed_goals(table: Sequence[Row]) -> Iterator[str]:
    """What lies beyond the goals, and pressures without a result."""
    for pressure in sorted(set(cases.PRESSURES) - {int(row["pressure_kPa"]) for row in table}):
        yield f"{pressure} kPa: no result"
    for row in table:
        for what in ("deflection", "area", "section_width"):
            error = row[f"{what}_error"]
            if abs(error) > GOAL:
                yield f"{row['pressure_kPa']:.0f} kPa: {what} {100 * error:+.1f} %, goal 10 %"


def print_of(folder: Path, pressure: float, load: float) -> list[dict[str, float]]:
    """Position [m], pressure [Pa] and area [m2] of the tread's nodes that touch."""
    return read_numbers(folder / f"{pressure:.0f}kPa_{load:.0f}N_pressure.csv")


def stress_table(runner: Runner) -> list[Row]:
    """Across the middle of the print: the centreline, the largest to its side, the least between
    the two."""
    found: list[Row] = []
    for (tread, sections), case in cases.STRESS.items():
        rows = states(runner, case)
        if not runner.record(case) or len(rows) < 3:
            continue
        nodes = print_of(runner.folder(case), cases.STRESS_PRESSURE, cases.STRESS_LOAD)
        middle = sorted((n["y_m"], n["pressure_Pa"]) for n in nodes if abs(n["x_m"]) < MIDDLE)
        side = max(range(1, len(middle)), key=lambda i: middle[i][1])
        least = min(range(side + 1), key=lambda i: middle[i][1])
        found.append(
            {
                "tread": tread,
                "sections": sections,
                "deflection_cm": rows[-1]["deflection_cm"],
                "largest_kPa": round(rows[-1]["largest_pressure_kPa"], 1),
                "least_kPa": round(1e-3 * min(n["pressure_Pa"] for n in nodes), 1),
                "centreline_kPa": round(1e-3 * middle[0][1], 1),
                "shoulder_kPa": round(1e-3 * middle[side][1], 1),
                "shoulder_cm": round(100 * middle[side][0], 2),
                "between_kPa": round(1e-3 * middle[least][1], 1),
                "between_cm": round(100 * middle[least][0], 2),
                "user_s": cost(runner, case),
            }
        )
    return found


def stress_maps(runner: Runner) -> dict[str, list[dict[str, float]]]:
    """The prints of each tread on its finest mesh."""
    return {
        tread: print_of(runner.folder(case), cases.STRESS_PRESSURE, cases.STRESS_LOAD)
        for (tread, _), case in cases.STRESS.items()
        if runner.record(case)
    }


def draw_stress(maps: dict[str, list[dict[str, float]]], path: Path) -> None:
    """Like the report's Figure 52."""
    figure, panels = plt.subplots(
        1, len(maps), figsize=(5.2 * len(maps), 4.6), squeeze=False, constrained_layout=True
    )
    for axes, (tread, nodes) in zip(panels[0], maps.items()):
        x = [100 * n["x_m"] for n in nodes] * 2
        y = [100 * side * n["y_m"] for side in (1, -1) for n in nodes]
        stress = [1e-3 * n["pressure_Pa"] for n in nodes] * 2
        shown = axes.scatter(y, x, c=stress, s=45, marker="s", vmin=0.0)
        axes.set(xlabel="across [cm]", ylabel="along the travel [cm]", aspect="equal")
        axes.set(xlim=(-10, 10), ylim=(-12, 12))
        axes.set_title(f"{tread}: {min(stress):.0f} to {max(stress):.0f} kPa")
        figure.colorbar(shown, ax=axes, label="contact pressure [kPa]", shrink=0.8)
    save(figure, path, dpi=90)


def tread_table(runner: Runner) -> list[Row]:
    """Smooth, ribbed and lugged: area without voids, and which share of the load is carried where
    the ribs are."""
    found: list[Row] = []
    for (tread, pressure), case in cases.TREADS.items():
        for state in states(runner, case):
            if state["load_N"] == 0:
                continue
            row: Row = {
                "tread": tread,
                "pressure_kPa": pressure,
                "load_N": round(state["load_N"]),
                "deflection_cm": state["deflection_cm"],
                "area_cm2": state["nodal_area_cm2"],
                "outline_area_cm2": state["perimeter_area_cm2"],
                "largest_kPa": state["largest_pressure_kPa"],
            }
            nodes = print_of(runner.folder(case), pressure, state["load_N"])
            total = sum(n["pressure_Pa"] * n["area_m2"] for n in nodes)
            for rib, (inner, outer) in RIBS.items():
                on_rib = [n for n in nodes if inner <= n["y_m"] < outer]
                carried = sum(n["pressure_Pa"] * n["area_m2"] for n in on_rib)
                row[f"{rib}_share"] = round(carried / total, 3)
            found.append(row)
    return found


def rolling_table(runner: Runner) -> list[Row]:
    """Resistance of rolling over the last part of the travel, with the error of eight blocks."""
    found: list[Row] = []
    for damping, case in cases.ROLLING.items():
        if runner.record(case):
            wheel = Results(runner.folder(case)).columns
            steady = wheel["x"] > wheel["x"][-1] - STEADY
            mean, error = block_mean(-wheel["force_x"][steady])
            found.append(
                {
                    "damping": damping,
                    "travel_m": round(float(wheel["x"][-1] - wheel["x"][0]), 2),
                    "resistance_N": round(mean, 2),
                    "resistance_error_N": round(error, 2),
                    "deflection_mm": round(1e3 * float(wheel["hub_drop"][steady].mean()), 2),
                    "user_s": cost(runner, case),
                }
            )
    return found


def choice_lines(rows: Sequence[Row]) -> list[str]:
    """The table of a choice, without the options."""
    columns = [name for name in rows[0] if name != "options"]
    return markdown(columns, ([str(row[name]) for name in columns] for row in rows))


def choices(
    output: Output, mine: dict[int, tuple[list[Row], float]], stress: list[Row]
) -> list[str]:
    """Writes the tables that --error chooses from; lines of the page."""
    lines: list[str] = []
    peaks = choice.stress(stress)
    for scene, title, rows, comments in (
        ("tyre_on_plane", "Table 6", choice.table6(mine), choice.TABLE6_COMMENTS),
        ("brick_tyre_on_plane", "contact stress", peaks, choice.STRESS_COMMENTS),
    ):
        output.table(f"errors_{scene}.csv", rows, comments)
        lines += [f"**Which tyre for which error: {title}**", "", *choice_lines(rows), ""]
    return lines


def percent(value: object) -> str:
    return f"{100 * value:+.1f} %" if isinstance(value, float) else ""


def table6_lines(table: Sequence[Row]) -> list[str]:
    head = ("pressure", "", "deflection", "error", "area", "error", "of its nodes", "width")
    return markdown(
        (*head, "error"),
        (
            (
                f"{row['pressure_kPa']} kPa",
                row["used_for"],
                f"{row['deflection_cm']:.2f} cm",
                percent(row["deflection_error"]),
                f"{row['area_cm2']:.0f} cm2",
                percent(row["area_error"]),
                f"{row['touching_area_cm2']:.0f} cm2",
                f"{row['section_width_cm']:.1f} cm",
                percent(row["section_width_error"]),
            )
            for row in table
        ),
    )


def plain_lines(rows: Sequence[Row]) -> list[str]:
    """A table with the columns' own names."""
    return markdown(list(rows[0]), ([str(value) for value in row.values()] for row in rows))


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    table = errors(states(runner, cases.TABLE6))
    mesh = errors(states(runner, cases.MESH))
    check = errors(states(runner, cases.CHECK))
    stress = stress_table(runner)
    lines: list[str] = []
    for name, title, rows, written in (
        ("table6.csv", f"Table 6, equivalent tread, {cases.SECTIONS} sections", table, table6_lines),
        ("meshes.csv", f"The same, {cases.COARSE} sections", mesh, table6_lines),
        ("between.csv", "From one tread to the other, 6227 N", between_table(runner), plain_lines),
        ("check.csv", "", check, table6_lines),
        ("inflated.csv", "Inflated", inflated(states(runner, cases.TABLE6)), plain_lines),
        ("load_deflection.csv", "", states(runner, cases.MESH), plain_lines),
        ("contact_stress.csv", "Contact stress", stress, plain_lines),
        ("treads.csv", "Treads", tread_table(runner), plain_lines),
        ("ribs.csv", "Ribs", shapes.rib_table(runner), plain_lines),
        ("profiles.csv", "Profiles", shapes.profile_table(runner), plain_lines),
        ("rolling.csv", "Rolling", rolling_table(runner), plain_lines),
    ):
        output.table(name, rows)
        if rows and title:
            lines += [f"**{title}**", "", *written(rows), ""]
    costs = [{"run": case.name, "user_s": cost(runner, case)} for case in cases.CASES]
    if table and mesh and stress:
        mine = {
            cases.COARSE: (mesh, cost(runner, cases.MESH)),
            cases.SECTIONS: (table, cost(runner, cases.TABLE6)),
        }
        lines += choices(output, mine, stress)
    output.table("costs.csv", [row for row in costs if row["user_s"]])
    if maps := stress_maps(runner):
        draw_stress(maps, output.path("contact_stress.png"))
    if table:
        shapes.draw_profiles(runner, output.path("profiles.png"))
    output.section(lines)
    missed = list(missed_goals(table or stored("table6.csv")))
    return [*missed, *changed(check, stored("check.csv"))] if check else missed
