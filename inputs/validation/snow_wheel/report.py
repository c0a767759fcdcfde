# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: tables, accuracy, figures."""

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

import cases
import closed_form
import mass_balance
import slope
import snow
import table11

from furrow_post.analyse import empirical
from furrow_post.analyse.rut import bow_wave, rut_densities, rut_depth, share_left
from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_matrix
from furrow_post.figures.style import save
from furrow_post.figures.terrain import draw_terrain
from furrow_post.read.results import Results
from furrow_post.read.terrain import Outline, Terrain, read_terrain_history
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner

LOAD = cases.LOAD_MASS * 9.80665  # [N]
RADIUS = 0.38  # [m] Table 11
TIME_STEP = 2e-4  # [s] of wheel.lig
CRUISE = 2  # stage of a history
FORCES = ("force_x", "force_z")

Row = dict[str, Any]  # of a table

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


# ---- one run


def row_of(case: Case, folder: Path, record: Record) -> Row:
    """Means over the last WINDOW of travel with their changes between its halves; densities.

    Energies are those of both halves of the model per metre, over the load. A failed run has its
    error alone.
    """
    row: Row = {
        "run": case.name.rpartition("/")[2],
        "user_s": round(record.cpu_time, 1),
        "error": record.error,
        "remap_interval": int(record.variable("remap_interval")),
    }
    if record.error:
        return row
    wheel, terrain = Results(folder).columns, read_terrain_history(folder)
    contact = read_matrix(folder / "contact.txt", 3)
    x = wheel["x"] - wheel["x"][0]
    end = float(x[-1])
    start, middle = end - cases.WINDOW, end - cases.WINDOW / 2
    value = means(wheel, x, start, end)
    change = 0.5 * np.abs(means(wheel, x, middle, end) - means(wheel, x, start, middle))
    row["sinkage_m"], row["sinkage_change_m"] = round(value[0], 4), round(change[0], 4)
    row["resistance"], row["resistance_change"] = round(value[1], 4), round(change[1], 4)
    row["slip"] = round(value[2], 3)

    def per_metre(time: Floats, energy: Floats) -> float:
        """Of the window, over the load."""
        ends = np.interp(np.interp([start, end], x, wheel["time"]), time, energy)
        return round(float((ends[1] - ends[0]) / cases.WINDOW / LOAD), 4)

    taken = terrain["stored_energy"] + terrain["dissipated_energy"]
    row["snow"] = per_metre(terrain["time"], 2 * taken)
    row["numerical"] = per_metre(terrain["time"], 2 * terrain["numerical_loss"])
    row["friction"] = per_metre(contact[:, 0] * TIME_STEP, contact[:, 1])
    snow = Terrain.read(folder)
    body = Outline(folder, snow)
    densities = rut_densities(snow, body)
    row["density_under"] = round(densities.under)
    row["density_shoulder"] = round(densities.shoulder)
    row["density_behind"] = round(densities.in_rut)
    row["rut_depth_m"] = round(rut_depth(snow, body), 3)
    row["mass_left"] = round(share_left(snow, body), 3)
    row["bow_wave_m"] = round(bow_wave(snow, body), 3)
    row["particles"] = int(record.facts["particles"])
    row["penetration_mm"] = round(1000 * record.facts["deepest_penetration"], 1)
    return row


def means(wheel: Mapping[str, Floats], x: Floats, low: float, high: float) -> Floats:
    """(3) Sinkage [m], resistance coefficient, slip over a part of the travel [m]."""
    part = (x >= low) & (x <= high)
    resistance = -wheel["force_x"][part].sum() / wheel["force_z"][part].sum()
    return np.array([wheel["sinkage"][part].mean(), resistance, wheel["slip"][part].mean()])


class Found:
    """Rows of the runs that are there, evaluated once."""

    def __init__(self, runner: Runner) -> None:
        self.runner, self.cases = runner, cases.all_cases()
        self.rows: dict[str, Row] = {}

    def __call__(self, name: str) -> Row:
        """Empty where the run is not there."""
        case = self.cases[name]
        if name not in self.rows:
            record = self.runner.ended(case)
            self.rows[name] = row_of(case, self.runner.folder(case), record) if record else {}
        return self.rows[name]


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


# ---- error against cost


def extrapolated(sizes: Sequence[float], values: Floats) -> tuple[float, float]:
    """Value at size zero, mean of the straight lines in h and in h^2, and its uncertainty.

    Half their difference plus the scatter about both.
    """
    guesses, scatter = [], 0.0
    for order in (1, 2):
        powers = np.array(sizes) ** order
        fit = np.polyfit(powers, values, 1)
        guesses.append(float(fit[1]))
        left = values - np.polyval(fit, powers)
        scatter = max(scatter, math.sqrt((left**2).sum() / max(len(sizes) - 2, 1)))
    return float(np.mean(guesses)), 0.5 * abs(guesses[1] - guesses[0]) + scatter


Limits = dict[str, tuple[float, float]]  # quantity -> value at size zero, its uncertainty


def error_table(found: Found) -> tuple[list[Row], Limits]:
    """Each change of one choice beside the base; and size zero."""
    base = found(cases.ERROR_BASE)
    if not base or base["error"]:
        return [], {}
    lines = [("base: cells of 4 cm, tyre of 4 x 36 elements", cases.ERROR_BASE)]
    lines += [(case.what, case.name) for case in cases.errors()]
    table = []
    for what, name in lines:
        if computed := found(name):
            cell = float(str(found.cases[name].variables["cell"]))
            table.append({"change": what, "cell_m": round(cell, 4), **computed})
    grids = grid_series(table)
    limits = {}
    if len(grids) >= 3:
        for what in ("sinkage_m", "resistance"):
            sizes, values = [r["cell_m"] for r in grids], np.array([r[what] for r in grids])
            limits[what] = extrapolated(sizes, values)
    return table, limits


def grid_series(table: Sequence[Row]) -> list[Row]:
    """Rows that differ in the cells alone: the base, and other sizes."""
    sound = [r for r in table if not r["error"]]
    return [r for r in sound if r["cell_m"] != 0.04 or r is table[0]]


def draw_errors(table: Sequence[Row], limits: Limits, path: Path) -> None:
    """Distance from size zero over cost, one point per size of cell."""
    grids = sorted(grid_series(table), key=lambda r: -float(r["cell_m"]))
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for axes, what, label in (
        (panels[0], "sinkage_m", "sinkage"),
        (panels[1], "resistance", "resistance coefficient"),
    ):
        limit, uncertain = limits[what]
        places = [(r["user_s"], abs(r[what] - limit) / limit) for r in grids]
        cost, error = zip(*places)
        axes.errorbar(cost, error, uncertain / limit, fmt="o-", capsize=3)
        for r, place in zip(grids, places):
            text = f"{100 * r['cell_m']:.3g} cm"
            axes.annotate(text, place, textcoords="offset points", xytext=(6, 6))
        axes.set(
            xscale="log",
            xlabel="cost [core seconds]",
            ylabel=f"error of {label}, relative",
            title=f"{label}: {limit:.3f} ± {uncertain:.3f} at size zero",
            ylim=(0, None),
        )
        axes.grid(alpha=0.3, which="both")
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
        mine = {name: wheel[name][cruise] for name in ("x", "sinkage", "slip", *FORCES)}
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
    errors, limits = error_table(found)
    output.table("error.csv", errors)
    for what, (value, uncertain) in limits.items():
        print(f"size zero: {what} {value:.4f} +- {uncertain:.4f}")
    if limits:
        draw_errors(errors, limits, output.path("error.png"))
    output.table("design.csv", design_table(found))
    output.table("pressures.csv", pressure_table(found))
    output.table("passes.csv", pass_table(runner))
    for name, title in SECTIONS.items():
        if runner.record(found.cases[name]):
            picture = output.path(f"section_{name}.png")
            draw_terrain(runner.folder(found.cases[name]), title, "", picture, dpi=75)
    return []
