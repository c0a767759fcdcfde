# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: their table, a closed-form estimate, the figure over depth."""

from collections.abc import Iterator, Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

import cases
import closed_form
import fields

from furrow_post.analyse import empirical
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.figures.style import save
from furrow_post.read.results import Results
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner
from furrow_post.study.tables import markdown

MEASURED = cases.HERE.parent / "snow_wheel" / "reference.csv"
NRMM_DENSITIES = (200.0, 240.0)  # [kg/m3]; the report finds its model at the second
PRESSURE = 179e3  # [Pa]

SERIES = (  # names of runs, look, words of the figure
    ("depth_*_zero_d30", "o-", "d 30 kPa, zero slip"),
    ("depth_*_free_d30", "^", "d 30 kPa, free"),
    ("d_5", "s", "d 5 kPa, zero slip"),
)

Row = dict[str, Any]


def row_of(case: Case, folder: Path, record: Record) -> Row:
    """Sinkage of the standing wheel; means over the window of rolling, and half the difference
    between its halves. A failed run has its error alone."""
    row: Row = {
        "run": case.name,
        "stage": case.stage,
        "what": case.what,
        "user_s": round(record.cpu_time, 1),
        "error": record.error,
        "depth_m": case.variables["depth"],
        "cell_m": case.variables["cell"],
    }
    if record.error:
        return row
    wheel = Results(folder).columns
    x = wheel["x"] - wheel["x"][0]
    standing = wheel["time"] <= float(str(case.variables["settle"]))
    window = cases.REPORT_WINDOW if case.stage == "depth" else cases.SHORT_WINDOW
    end = float(x[-1])
    value = means(wheel, x, end - window, end)
    first, second = (
        means(wheel, x, low, low + window / 2) for low in (end - window, end - window / 2)
    )
    change = 0.5 * np.abs(second - first)
    row["standing_m"] = round(float(wheel["hub_drop"][standing][-1]), 4)
    row["sinkage_m"], row["sinkage_change_m"] = round(value[0], 4), round(change[0], 4)
    row["resistance"], row["resistance_change"] = round(value[1], 4), round(change[1], 4)
    row["slip"] = round(value[2], 3)
    return row


def means(wheel: dict[str, Floats], x: Floats, low: float, high: float) -> Floats:
    """(3) Sinkage [m], resistance coefficient, slip over a part of the travel [m]."""
    part = (x >= low) & (x <= high)
    resistance = -wheel["force_x"][part].sum() / wheel["force_z"][part].sum()
    return np.array([wheel["hub_drop"][part].mean(), resistance, wheel["slip"][part].mean()])


def nrmm(depth: float, density: float) -> tuple[float, float]:
    """Sinkage [m] and resistance coefficient of the formula for this wheel."""
    z = empirical.nrmm_sinkage(depth, density, PRESSURE)
    resistance = empirical.nrmm_resistance(density, closed_form.WIDTH, closed_form.RADIUS, z)
    return z, resistance / closed_form.LOAD


def draw_depths(rows: Sequence[Row], path: Path) -> None:
    """Sinkage and resistance over depth: computed, measured, NRMM."""
    measured = read_numbers(MEASURED)
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.6), constrained_layout=True)
    depths = np.linspace(0.12, 0.52, 101)
    for axes, what, title in (
        (panels[0], "sinkage_m", "sinkage [m]"),
        (panels[1], "resistance", "resistance over load"),
    ):
        column = 0 if what == "sinkage_m" else 1
        axes.plot(
            [r["depth_m"] for r in measured],
            [r[what] for r in measured],
            ".",
            color="0.3",
            label="measured, a tyre, 110 to 220 kg/m3",
        )
        for density, style in zip(NRMM_DENSITIES, ("-", "--")):
            values = [nrmm(depth, density)[column] for depth in depths]
            axes.plot(depths, values, style, color="0.5", label=f"NRMM, {density:.0f} kg/m3")
        for pattern, mark, label in SERIES:
            mine = [r for r in rows if fnmatch(r["run"], pattern) and not r["error"]]
            axes.plot([r["depth_m"] for r in mine], [r[what] for r in mine], mark, label=label)
        axes.set(xlabel="depth of the snow [m]", ylabel=title, ylim=(0, None))
        axes.grid(alpha=0.3)
    panels[0].plot(0.20, 0.08, "k*", ms=11, label="the report's own wheel, about 8 cm")
    panels[0].legend(frameon=False, fontsize=8)
    save(figure, path, dpi=90)


def effects(rows: Sequence[Row]) -> list[Row]:
    """How far sinkage and resistance move with absorbing faces, with friction [%]."""
    found = {row["run"]: row for row in rows if not row["error"]}
    return [
        {
            "run": run,
            "of": base,
            **{
                f"{quantity}_percent": round(abs(100 * (found[run][key] / found[base][key] - 1)), 1)
                for quantity, key in (("sinkage", "sinkage_m"), ("resistance", "resistance"))
            },
        }
        for run, base in cases.EFFECTS.items()
        if run in found and base in found
    ]


def field_rows(runner: Runner) -> list[Row]:
    """The ground of the runs that Figs 65 to 67 are held against."""
    found = [case for case in cases.all_cases() if case.name in cases.FIELDS]
    return [
        {"run": case.name, "what": case.what, **fields.numbers(runner.folder(case))}
        for case in found
        if runner.record(case)
    ]


TABLES = {  # stage -> what its table is headed
    "reading": "Readings of Tables 1 and 3 (20 cm, zero slip, cells of 5 cm)",
    "artefact": "Mesh and load (20 cm, zero slip)",
    "domain": "Ends and sides (20 cm, zero slip, cells of 5 cm; else smooth, 1.6 x 0.8 m)",
    "slip": "Slip (20 cm, friction 0.3, cells of 5 cm)",
    "friction": "Friction (20 cm, zero slip, cells of 5 cm)",
    "depth": "Depth, as the report ran it (cells of 6 to 6.7 cm)",
}


GROUND_TITLE = "The ground at the end of the run (Figs 65 to 67)"
GROUND = {  # column of the page -> of fields.csv
    "run": "what",
    "kg/m3 under": "density_under",
    "greatest": "density_greatest",
    "shoulder": "density_shoulder",
    "mass left": "mass_left",
    "surface down cm": "surface_down_cm",
    "forward": "surface_forward_cm",
    "half depth down cm": "middle_down_cm",
    "forward there": "middle_forward_cm",
    "beside out cm": "aside_cm",
    "up": "raised_cm",
    "q kPa": "q_kPa",
    "at cm ahead, half way to the base": "q_middle_ahead_cm",
    "base": "q_base_ahead_cm",
}


def section(rows: Sequence[Row], ground: Sequence[Row]) -> list[str]:
    """The page's tables."""
    lines = []
    head = ("run", "standing z m", "z m", "c", "change of z m", "change of c", "slip", "core s")
    columns = (
        "what",
        "standing_m",
        "sinkage_m",
        "resistance",
        "sinkage_change_m",
        "resistance_change",
        "slip",
        "user_s",
    )
    for stage, title in TABLES.items():
        mine = [row for row in rows if row["stage"] == stage]
        if mine:
            cells = [[str(row.get(column, row["error"])) for column in columns] for row in mine]
            lines += [f"**{title}**", "", *markdown(head, cells), ""]
    if ground:
        cells = [[str(row[column]) for column in GROUND.values()] for row in ground]
        lines += [f"**{GROUND_TITLE}**", "", *markdown(tuple(GROUND), cells), ""]
    return lines


def missed(rows: Sequence[Row]) -> Iterator[str]:
    """The checked runs that are not what they were."""
    for row in rows:
        if row["run"] not in cases.CHECKED or row["error"]:
            continue
        expected = cases.CHECKED[row["run"]]
        for what, value, tolerance in zip(("sinkage_m", "resistance"), expected, cases.TOLERANCES):
            if abs(row[what] - value) > tolerance:
                yield f"{row['run']}: {what} {row[what]:g}, not {value:g} ± {tolerance:g}"


def report(runner: Runner, output: Output) -> list[str]:
    """Writes the tables and the figure."""
    rows = []
    for case in cases.all_cases():
        if record := runner.ended(case):
            rows.append(row_of(case, runner.folder(case), record))
    output.table("results.csv", rows)
    output.table("effects.csv", effects(rows))
    output.table("closed_form.csv", closed_form.table())
    output.table(
        "nrmm.csv",
        [
            {
                "density_kgm3": density,
                "depth_m": depth,
                "sinkage_m": round(nrmm(depth, density)[0], 3),
                "resistance": round(nrmm(depth, density)[1], 3),
            }
            for density in NRMM_DENSITIES
            for depth in cases.DEPTHS
        ],
    )
    ground = field_rows(runner)
    output.table("fields.csv", ground)
    draw_depths(rows, output.path("depth.png"))
    output.section(section(rows, ground))
    return list(missed(rows))
