# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of all runs: tables, accuracy, figures."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import cases
import closed_form
import error_study
import mass_balance
import slope
import snow
import table11
from one_run import LOAD, Found, Row, means

from furrow_post.analyse import empirical
from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats
from furrow_post.figures.style import save
from furrow_post.figures.terrain import draw_terrain
from furrow_post.read.results import Results
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner

RADIUS = 0.38  # [m] Table 11
CRUISE = 2  # stage of a history
FORCES = ("force_x", "force_z")

# Of a run, beside each measured row
COMPARED = (
    "sinkage_m",
    "rut_depth_m",
    "resistance",
    "density_under",
    "density_shoulder",
    "slip",
)
# Rows of a table of accuracy
ROWS: dict[str, Callable[[Row], bool]] = {
    "calibration": lambda row: bool(row["used"] == "calibration"),
    "prediction": lambda row: bool(row["used"] == "prediction"),
    "all": lambda row: True,
    "220 kg/m3": table11.has_calibration_density,
    "other densities": lambda row: not table11.has_calibration_density(row),
}
COMPUTED = {  # model of rows.csv -> name, colour, mark
    "tyre": ("tyre on field snow", "tab:blue", "s"),
    "flowing": ("the same with K0 0.41", "tab:orange", "^"),
    "spreading": ("K0 0.72, depth of the rut", "tab:green", "v"),
}
# Model -> of ROWS
IDENTIFIED_ON = {"tyre": "calibration", "flowing": "220 kg/m3", "spreading": "calibration"}
RUTS = ("spreading",)  # models whose rut is held against the measured sinkage
SECTIONS = {  # runs that are drawn -> title
    cases.ERROR_BASE: "tyre on field snow, 220 kg/m3",
    "rigid_towed": "rigid wheel on fresh_snow, towed",
    "report_towed": "rigid wheel on fresh_snow_shoop, towed",
}


# ---- measured rows


def row_table(found: Found) -> list[Row]:
    """The shared rows of Table 11, computed with the tyre on field snow, on snow that flows aside
    more easily, and by NRMM.

    NRMM: from its own and from the measured sinkage.
    """
    return [measured_row(found, r) for r in table11.reference()]


def measured_row(found: Found, r: Mapping[str, float]) -> Row:
    depth, density, sinkage = r["depth_m"], r["density_kgm3"], r["sinkage_m"]
    row: Row = {
        "row": int(r["row"]),
        "used": "calibration" if table11.is_calibration(r) else "prediction",
        "depth_m": depth,
        "density_kgm3": int(density),
        "sinkage_m": sinkage,
        "resistance": r["resistance"],
    }
    for model, name in (
        ("tyre", cases.row_name(density, depth)),
        ("flowing", cases.flowing_name(density, depth)),
        ("spreading", cases.spreading_name(snow.SPREADING, density, depth)),
    ):
        computed = found(name)
        for what in COMPARED:
            row[f"{model}_{what}"] = computed.get(what, "")
    own = empirical.nrmm_sinkage(depth, density, cases.PRESSURE)
    from_own, from_measured = (
        empirical.nrmm_resistance(density, cases.WIDTH, RADIUS, z) / LOAD for z in (own, sinkage)
    )
    row["nrmm_sinkage_m"], row["nrmm_resistance"] = round(own, 3), round(from_own, 3)
    row["nrmm_resistance_measured_sinkage"] = round(from_measured, 3)
    return row


def accuracy(table: Sequence[Row], used: str, model: str) -> Row:
    """rms and mean of computed minus measured over those of ROWS that were run; rut: of the depth
    that is left minus the measured sinkage."""
    chosen = [r for r in table if ROWS[used](r) and r[f"{model}_sinkage_m"] != ""]
    out: Row = {"model": model, "rows": f"{used}: {len(chosen)}"}
    for what in ("sinkage_m", "resistance"):
        errors = [r[f"{model}_{what}"] - r[what] for r in chosen]
        out[f"{what}_rms"] = round(rms(errors), 4)
        out[f"{what}_mean"] = round(sum(errors) / max(len(errors), 1), 4)
    if model in COMPUTED:
        errors = [r[f"{model}_rut_depth_m"] - r["sinkage_m"] for r in chosen]
        out["rut_m_rms"] = round(rms(errors), 4)
        out["rut_m_mean"] = round(sum(errors) / max(len(errors), 1), 4)
    if model == "nrmm":
        errors = [r["nrmm_resistance_measured_sinkage"] - r["resistance"] for r in chosen]
        out["resistance_rms_from_measured_sinkage"] = round(rms(errors), 4)
    return out


def computed(found: Found, names: Sequence[Sequence[str]], sinkage: str) -> Mapping[str, Floats]:
    """Quantity of slope.GOAL -> values of these runs; empty where one is missing or failed.
    sinkage: the column that is read as such."""
    runs = [[found(name) for name in line] for line in names]
    if not all(run and not run["error"] for line in runs for run in line):
        return {}
    columns = {what: sinkage if what == "sinkage_m" else what for what in slope.GOAL}
    return {
        what: np.array([[run[column] for run in line] for line in runs])
        for what, column in columns.items()
    }


def readings(found: Found) -> list[slope.Reading]:
    """Of the measured sinkages, as far as their runs are there."""
    hub = [[cases.slope_name(m, h) for h in cases.SLOPE_DEPTHS] for m in cases.SLOPES]
    rut = [
        [cases.spreading_name(m, table11.CALIBRATION_DENSITY, h) for h in cases.SPREADING_DEPTHS]
        for m in cases.SPREADING_SLOPES
    ]
    slopes = {snow.FLOWING: "flowing", snow.CRUSHED: "tyre"}
    made = []
    for name, runs, tried, depths, models, column in (
        ("hub", hub, cases.SLOPES, cases.SLOPE_DEPTHS, slopes, "sinkage_m"),
        (
            "rut",
            rut,
            cases.SPREADING_SLOPES,
            cases.SPREADING_DEPTHS,
            {snow.SPREADING: "spreading"},
            "rut_depth_m",
        ),
    ):
        if values := computed(found, runs, column):
            of_runs = slope.Computed(tried, depths, values)
            made.append(slope.Reading(name, of_runs, models, column))
    return made


def slope_table(found: Found, table: Sequence[Row]) -> list[Row]:
    """Empty where a run of the rows is missing or failed."""
    if any(row[f"{model}_sinkage_m"] == "" for row in table for model in COMPUTED):
        return []
    return slope.table(table, readings(found))


def column_of(model: str, what: str) -> str:
    """Of rows.csv, that is held against the measured quantity."""
    return f"{model}_rut_depth_m" if what == "sinkage_m" and model in RUTS else f"{model}_{what}"


def draw_comparison(table: Sequence[Row], path: Path) -> None:
    """Computed over measured; open: the rows that the snow was identified on."""
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.8), constrained_layout=True)
    for axes, what, title in (
        (panels[0], "sinkage_m", "sinkage [m]"),
        (panels[1], "resistance", "resistance over load"),
    ):
        columns = {model: column_of(model, what) for model in COMPUTED}
        sources = (what, f"nrmm_{what}", *columns.values())
        top = 1.08 * max(r[source] or 0 for r in table for source in sources)
        axes.plot([0, top], [0, top], color="0.5", lw=0.8)
        for model, (name, colour, mark) in COMPUTED.items():
            identified = ROWS[IDENTIFIED_ON[model]]
            for used, how, fill in ((True, "identified on", "none"), (False, "others", colour)):
                mine = [r for r in table if identified(r) is used and r[columns[model]] != ""]
                places = [r[what] for r in mine], [r[columns[model]] for r in mine]
                look = {"ms": 5, "color": colour, "mfc": fill}
                axes.plot(*places, mark, **look, label=f"{name}, {how}")
        nrmm = [r[what] for r in table], [r[f"nrmm_{what}"] for r in table]
        axes.plot(*nrmm, "x", ms=4, color="0.4", label="NRMM")
        axes.set(xlabel=f"measured {title}", ylabel=f"computed {title}")
        axes.set(xlim=(0, top), ylim=(0, top))
        axes.legend(frameon=False, fontsize=8)
        axes.grid(alpha=0.3)
    save(figure, path, dpi=90)


# ---- design


def design_table(found: Found) -> list[Row]:
    """Rigid wheels of other sizes beside the closed form."""
    table = []
    for case, (diameter, width) in zip(cases.designs(), cases.DESIGNS):
        if not (row := found(case.name)):
            continue
        expected = closed_form.rigid(diameter, width, 0.20, 220.0, LOAD)
        table.append(
            {
                "diameter_m": diameter,
                "width_m": width,
                **row,
                "closed_form_sinkage_m": round(expected.sinkage, 4),
                "closed_form_resistance": round(expected.resistance, 4),
            }
        )
    return table


def pressure_table(found: Found) -> list[Row]:
    """The tyre at other pressures on 0.20 m of 220 kg/m3, beside NRMM."""
    table = []
    for pressure, name in cases.PRESSURES.items():
        row = found(name)
        if not row or row["error"]:
            continue
        sinkage = empirical.nrmm_sinkage(0.20, 220.0, pressure)
        resistance = empirical.nrmm_resistance(220.0, cases.WIDTH, RADIUS, sinkage) / LOAD
        table.append(
            {
                "pressure_kPa": round(pressure / 1e3),
                **{what: row[what] for what in ("run", "user_s", "sinkage_m", "resistance")},
                "nrmm_sinkage_m": round(sinkage, 4),
                "nrmm_resistance": round(resistance, 4),
            }
        )
    return table


def pass_table(runner: Runner) -> list[Row]:
    """Sinkage and resistance of each pass in one rut, over the last WINDOW of its cruise."""
    case = cases.passes()
    record = runner.record(case)
    if record is None:
        return []
    wheel = Results(runner.folder(case)).columns
    table = []
    for number in range(1, cases.PASSES + 1):
        cruise = (wheel["pass"] == number) & (wheel["stage"] == CRUISE)
        mine = {name: wheel[name][cruise] for name in ("x", "hub_drop", "slip", *FORCES)}
        end = float(mine["x"][-1])
        middle = end - cases.WINDOW / 2
        value = means(mine, mine["x"], end - cases.WINDOW, end)
        halves = [
            means(mine, mine["x"], low, low + cases.WINDOW / 2)
            for low in (end - cases.WINDOW, middle)
        ]
        change = 0.5 * np.abs(halves[1] - halves[0])
        table.append(
            {
                "run": f"{case.name}_{number}",
                "user_s": round(record.cpu_time / cases.PASSES, 1),
                "sinkage_m": round(value[0], 4),
                "sinkage_change_m": round(change[0], 4),
                "resistance": round(value[1], 4),
                "resistance_change": round(change[1], 4),
                "slip": round(value[2], 3),
            }
        )
    return table


# ---- all


def run_table(found: Found) -> list[Row]:
    """Every run of the stages predict, rows, flowing, slope and spreading."""
    staged = [("predict", case) for case in cases.predictions()]
    staged += [("rows", case) for case in cases.rows()]
    staged += [("flowing", case) for case in cases.flowing_rows()]
    staged += [("slope", case) for case in cases.slopes()]
    staged += [("spreading", case) for case in cases.spreading_rows()]
    return [
        {"stage": stage, "what": case.what, **row}
        for stage, case in staged
        if (row := found(case.name))
    ]


def report(runner: Runner, output: Output) -> list[str]:
    """Writes the tables and figures and prints the tables."""
    found = Found(runner)
    output.table("results.csv", run_table(found))
    table = row_table(found)
    output.table("rows.csv", table)
    draw_comparison(table, output.path("comparison.png"))
    scores = [
        accuracy(table, used, model)
        for model in (*COMPUTED, "nrmm")
        for used in ROWS
    ]
    output.table("accuracy.csv", scores)
    output.table("slope.csv", slope_table(found, table))
    measured = table11.reference()
    choices = {
        "prediction": [row for row in measured if not table11.is_calibration(row)],
        "other_densities": [row for row in measured if not table11.has_calibration_density(row)],
        "all": measured,
    }
    output.table("mass_balance.csv", mass_balance.table(choices))
    start, density, off = mass_balance.trend(measured)
    print(f"measured h - z: {start:.4f} m + mass/({density:.0f} kg/m3), rms {off:.4f} m")
    changes, limits = error_study.error_table(found)
    output.table("error.csv", changes)
    for what, series in limits.items():
        way = series.reason or f"extrapolated, order {series.order:.2f}"
        print(f"{what}: best estimate {series.value:.4f} ± {series.error:.4f} ({way})")
    if limits:
        error_study.draw_errors(changes, limits, output.path("error.png"))
    output.table("design.csv", design_table(found))
    output.table("pressures.csv", pressure_table(found))
    output.table("passes.csv", pass_table(runner))
    for name, title in SECTIONS.items():
        if runner.record(found.cases[name]):
            picture = output.path(f"section_{name}.png")
            draw_terrain(runner.folder(found.cases[name]), title, "", picture, dpi=75)
    return []
