# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: a row of numbers of each, measured rows beside them, the slope M of Cam
clay that the rows ask for, what mass alone allows, errors of one choice, designs, passes."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import trapezoid
from scipy.optimize import brentq

from furrow_post.analyse import empirical
from furrow_post.analyse.evaluations import steady_columns
from furrow_post.analyse.grid_convergence import Convergence, grid_convergence
from furrow_post.analyse.rut import bow_wave, rut_densities, rut_depth, share_left
from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_matrix, read_numbers, read_rows
from furrow_post.figures.style import save
from furrow_post.figures.terrain import draw_terrain
from furrow_post.read.results import Results
from furrow_post.read.terrain import Outline, Terrain, read_terrain_history
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

Row = dict[str, Any]  # of a table

LOAD = 636.0 * 9.80665  # [N] [Shoop2001] p. 27
WIDTH, MEASURED_RADIUS = 0.272, 0.38  # [m] Table 11
PRESSURE = 179e3  # [Pa] of the measured tyre
WINDOW = 0.5  # [m] of travel at the end that is averaged
TIME_STEP = 2e-4  # [s] of wheel.lig
ERROR_BASE = "row_220_20cm"
PRESSURES = {103e3: "error_pressure_103", PRESSURE: ERROR_BASE, 241e3: "error_pressure_241"}  # [Pa]
DESIGNS = ((0.74, 0.18), (0.74, 0.272), (0.74, 0.40), (0.56, 0.272), (1.00, 0.272))  # diameter, width [m]
CRUISE, PASSES = 2, 3  # stage of a history; passes in one rut

# ---- the field's snow: one compaction curve for every initial density

# Final densities [kg/m3] under wheels of such pressures [Pa], as the sinkage formula of [CRREL95-7]
# takes them, which was fitted to tests: its classes of pressure, and middles of their densities
FINAL_DENSITIES = {525.0: 210e3, 575.0: 350e3, 625.0: 700e3, 660.0: 1400e3}
IDENTIFIED_DENSITIES = (380.0, 450.0, 490.0)  # [kg/m3] of the beginning, which is searched
START = (100.0, 15.0)  # [kg/m3], [Pa]: below the lightest snow of the rows, hardly any strength
# Slopes M of Cam clay
CRUSHED = 3.3  # K0 = 0.12 [Shoop2001] eq 24
FLOWING = 2.0  # K0 = 0.41: round; slope.csv has 1.84 (1.73 to 1.98) on all rows of 220 kg/m3
SOFTEST = 1.4  # K0 = 0.61: beyond what it finds
SPREADING = 1.1  # K0 = 0.72: with sinkages read as depths of ruts, in cells of 5 cm
FINE = 1.25  # K0 = 0.67: the same in cells of 2.5 cm
TENSION_RATIO = 0.1  # of fresh_snow_cam_clay.yaml

# Axial stresses [Pa] at the first of IDENTIFIED_DENSITIES; from the last of them on straight in ln p
Beginning = tuple[float, ...]

# Rounded from what identify.py found; inputs/materials/field_snow.yaml
FIELD_SNOW: Beginning = (4e3, 25e3, 100e3)
TWO_STRESSES: Beginning = FIELD_SNOW[:2]  # without the one that the tests determine least


def confined(slope: float) -> tuple[float, float]:
    """K0, and p0 over axial stress, in confined compression: closed form of
    cohesive_cam_clay.h."""
    beta = TENSION_RATIO
    ratio = slope / math.sqrt(1 + 2 * beta)
    root = math.sqrt(9 + 4 * ratio**2)
    centre, half = (1 - beta) / 2, (1 + beta) / 2  # of the ellipse, over p0
    p, q = centre + 3 * half / root, 2 * ratio**2 * half / root
    axial = p + 2 * q / 3
    return (p - q / 3) / axial, round(1 / axial, 3)


def field_snow(
    density: float, beginning: Beginning = FIELD_SNOW, title: str = "", slope: float = CRUSHED
) -> str:
    """A material file; density [kg/m3] at the start; slope: M."""
    _, share = confined(slope)
    rows = [START]
    curve = {**dict(zip(IDENTIFIED_DENSITIES, beginning)), **FINAL_DENSITIES}
    rows += [(rho, share * stress) for rho, stress in curve.items()]
    return (
        f"title: {title or 'Field snow'}\n"
        f"law: {{type: cohesive_cam_clay, density: {density:g}, M: {slope:g}, "
        f"tension_ratio: {TENSION_RATIO:g}}}\n"
        "elasticity: {type: linear, E: 13.79e6, nu: 0.3}\n"
        "hardening:\n"
        "  type: by_density\n"
        f"  rho: [{', '.join(f'{rho:g}' for rho, _ in rows)}]\n"
        f"  p: [{', '.join(f'{p:.6g}' for _, p in rows)}]\n"
        "  interpolation: log\n"
        "  beyond: extrapolate\n"
    )


# ---- the measured rows, and which of them an identification may see

# The rows of reference.csv that the identification may see: density [kg/m3], depths [m]
CALIBRATION_DENSITY = 220.0
CALIBRATION_DEPTHS = (0.18, 0.22)
GOAL = {"sinkage_m": 0.012, "resistance": 0.031}  # rms over rows
DENSITY_UNDER, WITHIN = 510.0, 0.05  # under the wheel [kg/m3] [Shoop2001], and its goal


def reference() -> list[dict[str, float]]:
    """Rows of reference.csv."""
    return read_numbers(Path(__file__).resolve().parent / "reference.csv")


def is_calibration(row: Mapping[str, Any]) -> bool:
    low, high = CALIBRATION_DEPTHS
    return has_calibration_density(row) and bool(low <= row["depth_m"] <= high)


def has_calibration_density(row: Mapping[str, Any]) -> bool:
    """In snow of any depth."""
    return bool(row["density_kgm3"] == CALIBRATION_DENSITY)


# Choices of rows that the slope is identified on; all others are predicted
SLOPE_ROWS: dict[str, Callable[[Mapping[str, Any]], bool]] = {
    "220 kg/m3, 0.20 m: 3": lambda row: has_calibration_density(row) and row["depth_m"] == 0.20,
    "220 kg/m3, 0.18 to 0.22 m: 12": is_calibration,
    "220 kg/m3, with 0.38 m: 13": has_calibration_density,
}


# ---- one run


def row_of(run: Run) -> Row:
    """Means over the last WINDOW of travel with their changes between its halves; densities.

    Energies are those of both halves of the model per metre, over the load. A failed run has its
    error alone.
    """
    row: Row = {
        "run": run.name.rpartition("/")[2],
        "user_s": run.seconds,
        "failure": run.error,
        "remap_interval": int(run.record.variable("remap_interval")),
    }
    if run.error:
        return row
    wheel, terrain = Results(run.folder).columns, read_terrain_history(run.folder)
    contact = read_matrix(run.folder / "contact.txt", 3)
    x = wheel["x"] - wheel["x"][0]
    end = float(x[-1])
    start = end - WINDOW
    row.update(steady_columns(wheel, WINDOW))

    def per_metre(time: Floats, energy: Floats) -> float:
        """Of the window, over the load."""
        ends = np.interp(np.interp([start, end], x, wheel["time"]), time, energy)
        return round(float((ends[1] - ends[0]) / WINDOW / LOAD), 4)

    taken = terrain["stored_energy"] + terrain["dissipated_energy"]
    row["snow"] = per_metre(terrain["time"], 2 * taken)
    row["numerical"] = per_metre(terrain["time"], 2 * terrain["numerical_loss"])
    row["friction"] = per_metre(contact[:, 0] * TIME_STEP, contact[:, 1])
    snow = Terrain.read(run.folder)
    body = Outline(run.folder, snow)
    densities = rut_densities(snow, body)
    row["density_under"] = round(densities.under)
    row["density_shoulder"] = round(densities.shoulder)
    row["density_behind"] = round(densities.in_rut)
    row["rut_depth_m"] = round(rut_depth(snow, body), 3)
    row["mass_left"] = round(share_left(snow, body), 3)
    row["bow_wave_m"] = round(bow_wave(snow, body), 3)
    row["particles"] = int(run.record.facts["particles"])
    row["penetration_mm"] = round(1000 * run.record.facts["deepest_penetration"], 1)
    return row


class Found:
    """Rows of the runs that are there, evaluated once; of others those that are stored."""

    def __init__(self, runs: Runs, stored: Sequence[Mapping[str, str]] = ()) -> None:
        self.runs = {run.name: run for run in runs.ended("*")}
        self.rows: dict[str, Row] = {row["run"]: numbers_of(row) for row in stored}
        self.rows.update({name: row_of(run) for name, run in self.runs.items()})

    def __call__(self, name: str) -> Row:
        """Empty where the run is not there."""
        return self.rows.get(name, {})


def numbers_of(row: Mapping[str, str]) -> Row:
    """The values of a stored row that are numbers, as such."""
    found: Row = dict(row)
    for name in row.keys() - {"run", "stage", "what", "change", "failure"}:
        found[name] = float(row[name]) if row[name] else ""
    return found


def stored_rows(output: Output) -> list[dict[str, str]]:
    """Of all runs, where others are merged into the stored tables."""
    names = ("results.csv", "error.csv") if output.merge else ()
    return [row for name in names for row in read_rows(output.folder / name)]


# ---- the slope M of Cam clay, and so K0, that the measured rows ask for, all else the same
#
# A measured sinkage is read as the hub's, or as the depth of the rut that is left. Sinkage,
# resistance and density under the wheel of runs with three slopes are interpolated, over the slope by
# a parabola in 1/M^2, of which they are nearly straight lines, and over the depth by straight lines;
# the slope is the one of the least sum of squares over the goals. Its range: where that sum exceeds
# the least one by no more than the share 1/(N - 1) of it, N the number of its terms; one standard
# error where the tests' scatter is all that is left. A slope at an end of those that were run is a
# bound.

TRIED = 1901  # slopes between the ends
SLOPE_GOAL = {**GOAL, "density_under": WITHIN * DENSITY_UNDER}


class Computed(NamedTuple):
    """Of the runs: quantity of SLOPE_GOAL -> values (slope, depth)."""

    slopes: Sequence[float]  # three
    depths: Sequence[float]  # [m], increasing
    values: Mapping[str, Floats]

    def tried(self) -> Floats:
        return np.linspace(min(self.slopes), max(self.slopes), TRIED)

    def reaches(self, depths: Sequence[float]) -> bool:
        """Whether all of them lie between those that were run."""
        return bool(self.depths[0] <= min(depths) and max(depths) <= self.depths[-1])

    def at(self, what: str, depths: Sequence[float]) -> Floats:
        """(slope of tried(), depth of a row)"""
        rows = np.array([np.interp(depths, self.depths, line) for line in self.values[what]])
        fits = np.polyfit(np.array(self.slopes) ** -2, rows, 2)
        return np.array([np.polyval(fit, self.tried() ** -2) for fit in fits.T]).T


class Identified(NamedTuple):
    """The slope, its range, and what is left of each quantity, rms."""

    slope: float
    low: float
    high: float
    left: dict[str, float]


class Reading(NamedTuple):
    """Of the measured sinkages."""

    name: str
    computed: Computed
    models: Mapping[float, str]  # slope -> the model of the rows that was run with it, increasing
    column: str  # that a model's sinkage has there

    def predicted(self, row: Row, what: str, slope: float) -> float:
        """Of a row, straight between its models."""
        column = self.column if what == "sinkage_m" else what
        values = [row[f"{model}_{column}"] for model in self.models.values()]
        return float(np.interp(slope, list(self.models), values))


def identify(rows: Sequence[Mapping[str, float]], computed: Computed) -> Identified:
    """From measured rows."""
    depths, tried = [row["depth_m"] for row in rows], computed.tried()
    wrong = {
        what: computed.at(what, depths)
        - np.array([row.get(what, DENSITY_UNDER) for row in rows])
        for what in SLOPE_GOAL
    }
    total = sum(np.mean((wrong[what] / goal) ** 2, axis=1) for what, goal in SLOPE_GOAL.items())
    best = int(np.argmin(total))
    terms = len(GOAL) * len(rows) + 1  # one density was measured
    inside = tried[total <= total[best] * (1 + 1 / (terms - 1))]
    left = {what: rms(errors[best]) for what, errors in wrong.items()}
    return Identified(float(tried[best]), float(inside[0]), float(inside[-1]), left)


def slope_lines(measured: Sequence[Row], readings: Sequence[Reading]) -> list[Row]:
    """For each reading, and each choice of rows whose depths its slopes were run for. measured:
    rows of rows.csv; the others are predicted with the slope that is found, as far as models with
    such slopes were run."""
    found = []
    for reading in readings:
        for name, chosen in SLOPE_ROWS.items():
            mine = [row for row in measured if chosen(row)]
            if mine and reading.computed.reaches([row["depth_m"] for row in mine]):
                others = [row for row in measured if not chosen(row)]
                found.append({"rows": name, **_line(reading, mine, others)})
    return found


def _line(reading: Reading, mine: Sequence[Row], others: Sequence[Row]) -> Row:
    one = identify(mine, reading.computed)
    row: Row = {"reading": reading.name}
    for place, slope in (("", one.slope), ("_low", one.low), ("_high", one.high)):
        row[f"slope{place}"] = round(slope, 2)
        row[f"k0{place}"] = round(confined(slope)[0], 2)
    used = float(np.clip(one.slope, min(reading.models), max(reading.models)))
    row["others_slope"] = round(used, 2)
    for what in GOAL:
        row[f"{what}_rms"] = round(one.left[what], 4)
        wrong = [reading.predicted(other, what, used) - other[what] for other in others]
        row[f"others_{what}_rms"] = round(rms(wrong), 4)
    return row


# ---- what mass alone allows, whatever the law
#
# Snow of depth h and density rho_0 that is left in the track at density rho, a share phi of its mass,
# is phi h rho_0/rho thick. The hub comes down by the rest of h and by the tyre's deflection delta:
#     z = h - phi h rho_0/rho + delta.

SHARES = (1.0, 0.9)  # of the mass that is left
DEFLECTIONS = (0.0, 0.045)  # [m]; 0.045: on a plane under the load [Shoop2001] Table 6, 179 kPa

def thickness(rows: Sequence[Mapping[str, float]]) -> Floats:
    """h - z as measured [m]."""
    return np.array([row["depth_m"] - row["sinkage_m"] for row in rows])


def areal_mass(rows: Sequence[Mapping[str, float]]) -> Floats:
    """[kg/m2] of the snow before."""
    return np.array([row["depth_m"] * row["density_kgm3"] for row in rows])


def least_error(
    rows: Sequence[Mapping[str, float]], density: float, share: float
) -> tuple[float, float]:
    """Least rms error of z [m]: with the best single deflection, and with the best of each row
    within DEFLECTIONS."""
    wanted = share * areal_mass(rows) / density - thickness(rows)  # delta that meets the row
    own = wanted - np.clip(wanted, *DEFLECTIONS)
    return rms(wanted - np.clip(wanted.mean(), *DEFLECTIONS)), rms(own)


def mass_table(choices: Mapping[str, Sequence[Mapping[str, float]]]) -> list[Row]:
    """Least errors over each choice of rows, for densities within the goal."""
    found = []
    for density in (DENSITY_UNDER * (1 - WITHIN), DENSITY_UNDER, DENSITY_UNDER * (1 + WITHIN)):
        for share in SHARES:
            row: Row = {"density_kgm3": round(density), "mass_left": share}
            for name, rows in choices.items():
                single, own = least_error(rows, density, share)
                row[f"{name}_rms_one_deflection_m"] = round(single, 4)
                row[f"{name}_rms_any_deflection_m"] = round(own, 4)
            found.append(row)
    return found


# ---- a rigid wheel where snow is only compressed, by integrals along its rim
#
# A column of snow under the rim at depth z has the density rho_0 h/(h - z) (h: depth of the snow),
# and presses with the axial stress p of the compaction curve. With the front half alone, from the
# first touch to the lowest point, and width b,
#     W = b int p dx,   c = b int p dz / W:
# the work of compaction in a metre of track, over the load.

POINTS = 4000  # along the rim


class RigidWheel(NamedTuple):
    sinkage: float  # [m]
    resistance: float  # coefficient c


def axial_stress(density: Floats) -> Floats:
    """[Pa] of the field's snow in confined compression; straight in ln p between its points."""
    densities = [*IDENTIFIED_DENSITIES, *FINAL_DENSITIES]
    logs = np.log([*FIELD_SNOW, *FINAL_DENSITIES.values()])
    start, first = START
    stress: Floats = np.exp(np.interp(density, [start, *densities], [np.log(first), *logs]))
    return stress


def compacted(
    diameter: float,
    width: float,
    depth: float,
    density: float,
    load: float,
    stress: Callable[[Floats], Floats] = axial_stress,
) -> RigidWheel:
    """Lengths [m], density [kg/m3] at the start, load [N]; stress [Pa] over density."""
    radius = 0.5 * diameter

    def bearing(sinkage: float) -> tuple[float, float]:
        """Load [N], and work in a metre of track [N]."""
        z = np.linspace(0.0, sinkage, POINTS)
        x = -np.sqrt(np.maximum(radius**2 - (radius - sinkage + z) ** 2, 0.0))
        pressure = stress(density * depth / (depth - z))
        return width * trapezoid(pressure, x), width * trapezoid(pressure, z)

    deepest = depth * (1 - density / max(FINAL_DENSITIES))
    sinkage = brentq(lambda z: bearing(z)[0] - load, 0.05 * depth, deepest)
    found, work = bearing(sinkage)
    return RigidWheel(float(sinkage), float(work / found))


# ---- measured rows with computed ones

# Of a run, for each measured row
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
    "220 kg/m3": has_calibration_density,
    "other densities": lambda row: not has_calibration_density(row),
}
COMPUTED = {  # model of rows.csv -> name, colour, mark
    "tyre": ("tyre on field snow", "tab:blue", "s"),
    "flowing": ("the same with K0 0.41", "tab:orange", "^"),
    "spreading": ("K0 0.72, depth of the rut", "tab:green", "v"),
    "fine": ("K0 0.67, depth of the rut", "tab:red", "D"),
}
# Model -> of ROWS
IDENTIFIED_ON = {
    "tyre": "calibration", "flowing": "220 kg/m3", "spreading": "calibration", "fine": "calibration",
}  # fmt: skip
DRAWN = ("tyre", "flowing", "fine")
RUTS = ("spreading", "fine")  # models whose rut is compared with the measured sinkage
SECTIONS = {  # runs that are drawn -> title
    ERROR_BASE: "tyre on field snow, 220 kg/m3",
    "rigid_towed": "rigid wheel on fresh_snow, towed",
    "report_towed": "rigid wheel on fresh_snow_shoop, towed",
}


def place_of(row: Mapping[str, Any]) -> str:
    """Density and depth of a measured row, in the names of its runs."""
    return f"{row['density_kgm3']:.0f}_{100 * row['depth_m']:.0f}cm"


def measured_row(found: Found, r: Mapping[str, float]) -> Row:
    depth, density, sinkage = r["depth_m"], r["density_kgm3"], r["sinkage_m"]
    place = place_of(r)
    row: Row = {
        "row": int(r["row"]),
        "used": "calibration" if is_calibration(r) else "prediction",
        "depth_m": depth,
        "density_kgm3": int(density),
        "sinkage_m": sinkage,
        "resistance": r["resistance"],
    }
    for model, name in (
        ("tyre", f"row_{place}"),
        ("flowing", f"flowing_{place}"),
        ("spreading", f"m_1.1_{place}"),
        ("fine", f"m_1.25_{place}"),
    ):
        computed = found(name)
        for what in COMPARED:
            row[f"{model}_{what}"] = computed.get(what, "")
    own = empirical.nrmm_sinkage(depth, density, PRESSURE)
    from_own, from_measured = (
        empirical.nrmm_resistance(density, WIDTH, MEASURED_RADIUS, z) / LOAD for z in (own, sinkage)
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
    """Quantity of SLOPE_GOAL -> values of these runs; empty where one is missing or failed.
    sinkage: the column that is read as such."""
    runs = [[found(name) for name in line] for line in names]
    if not all(run and not run["failure"] for line in runs for run in line):
        return {}
    columns = {what: sinkage if what == "sinkage_m" else what for what in SLOPE_GOAL}
    return {
        what: np.array([[run[column] for run in line] for line in runs])
        for what, column in columns.items()
    }


def readings(found: Found) -> list[Reading]:
    """Of the measured sinkages, as far as their runs are there."""
    made = []
    for name, slopes, depths, models, column in (
        (
            "hub",
            (SOFTEST, FLOWING, CRUSHED),
            (0.18, 0.20, 0.22, 0.38),
            {FLOWING: "flowing", CRUSHED: "tyre"},
            "sinkage_m",
        ),
        ("rut", (1.0, SPREADING, 1.4), (0.20,), {SPREADING: "spreading"}, "rut_depth_m"),
        ("rut, cells of 2.5 cm", (SPREADING, FINE, 1.4), (0.20,), {FINE: "fine"}, "rut_depth_m"),
    ):
        names = [[slope_run(name, slope, depth) for depth in depths] for slope in slopes]
        if values := computed(found, names, column):
            made.append(Reading(name, Computed(slopes, depths, values), models, column))
    return made


def slope_run(reading: str, slope: float, depth: float) -> str:
    """Name of the run in 220 kg/m3 with this slope, in cells of about 5 cm or as the reading says."""
    place = f"220_{100 * depth:.0f}cm"
    if reading == "rut, cells of 2.5 cm":
        return f"m_{slope:g}_{place}" + ("" if slope == FINE else "_2.5cm")
    if reading == "rut":
        return f"m_{slope:g}_{place}"
    elsewhere = {(CRUSHED, 0.18): f"row_{place}", (CRUSHED, 0.20): "error_cell_5cm"}
    of_rows = f"flowing_{place}" if slope == FLOWING else f"slope_{slope:g}_{100 * depth:.0f}cm"
    return elsewhere.get((slope, depth), of_rows)


def slope_table(found: Found, table: Sequence[Row]) -> list[Row]:
    """Empty where a run of the rows is missing or failed."""
    if any(row[f"{model}_sinkage_m"] == "" for row in table for model in COMPUTED):
        return []
    return slope_lines(table, readings(found))


def column_of(model: str, what: str) -> str:
    """Of rows.csv, that is compared with the measured quantity."""
    return f"{model}_rut_depth_m" if what == "sinkage_m" and model in RUTS else f"{model}_{what}"


def draw_comparison(table: Sequence[Row], path: Path) -> None:
    """Computed over measured; open: the rows that the snow was identified on."""
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.8), constrained_layout=True)
    for axes, what, title in (
        (panels[0], "sinkage_m", "sinkage [m]"),
        (panels[1], "resistance", "resistance over load"),
    ):
        columns = {model: column_of(model, what) for model in DRAWN}
        sources = (what, f"nrmm_{what}", *columns.values())
        top = 1.08 * max(r[source] or 0 for r in table for source in sources)
        axes.plot([0, top], [0, top], color="0.5", lw=0.8)
        for model in DRAWN:
            name, colour, mark = COMPUTED[model]
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


# ---- what the cells take

CELL_SERIES = {  # runs that differ in the cells alone, the coarsest first
    "hub reading, 0.20 m": (
        "error_cell_5cm", ERROR_BASE, "error_cell_3.3cm", "error_cell_2.5cm",
    ),
    "rut reading, 0.20 m": (
        "m_1.1_220_20cm", "m_1.1_220_20cm_fine", "m_1.1_220_20cm_3.3cm", "m_1.1_220_20cm_2.5cm",
    ),
    "rut reading, 0.38 m": ("m_1.1_160_38cm", "m_1.1_160_38cm_3.8cm"),
    "M = 1.25, 0.20 m": ("m_1.25_220_20cm_5cm", "m_1.25_220_20cm_3.3cm", "m_1.25_220_20cm"),
}  # fmt: skip
CELL_COLUMNS = ("sinkage_m", "rut_depth_m", "resistance", "numerical", "density_under", "user_s")


def cell_table(cells: Mapping[str, float], known: Mapping[str, Mapping[str, Any]]) -> list[Row]:
    """Of CELL_SERIES. cells: size [m] of each run; known: rows of results.csv and error.csv by run.

    without_loss: resistance less what grid resets take, both over the load.
    """
    return [
        {
            "case": f"{name}, {100 * cells[run]:.3g} cm",
            "cell_m": round(cells[run], 4),
            **{column: float(known[run][column]) for column in CELL_COLUMNS},
            "loss_share": round(float(known[run]["numerical"]) / float(known[run]["resistance"]), 3),
            "without_loss": round(float(known[run]["resistance"]) - float(known[run]["numerical"]), 4),
        }
        for name, runs in CELL_SERIES.items()
        for run in runs
        if run in known and not known[run]["failure"]
    ]


def numerical_table(table: Sequence[Row], found: Callable[[str], Mapping[str, Any]]) -> list[Row]:
    """Accuracy of the rut readings as run, and with the grid's loss subtracted row by row.

    table: rows of rows.csv; found: rows of results.csv by run
    """
    lines = []
    for model, slope in (("spreading", SPREADING), ("fine", FINE)):
        for used in ("prediction", "all"):
            rows = [row for row in table if ROWS[used](row) and row[f"{model}_resistance"] != ""]
            if not rows:
                continue
            loss = np.array([found(f"m_{slope:g}_{place_of(row)}")["numerical"] for row in rows])
            c = np.array([row[f"{model}_resistance"] for row in rows])
            wrong = c - np.array([row["resistance"] for row in rows])
            lines.append(
                {
                    "case": f"M = {slope:g}, {used}: {len(rows)}",
                    "resistance_rms": round(rms(wrong), 4),
                    "resistance_mean": round(float(wrong.mean()), 4),
                    "without_loss_rms": round(rms(wrong - loss), 4),
                    "without_loss_mean": round(float((wrong - loss).mean()), 4),
                    "least_loss_share": round(float((loss / c).min()), 3),
                    "greatest_loss_share": round(float((loss / c).max()), 3),
                }
            )
    return lines


# ---- errors of one choice, designs, passes


def error_table(found: Found) -> tuple[list[Row], dict[str, Convergence]]:
    """Each change of one choice with the base; and what the sizes of cells come to."""
    if ERROR_BASE not in found.runs or found(ERROR_BASE)["failure"]:
        return [], {}
    names = [ERROR_BASE, *(name for name, run in found.runs.items() if run.case.stage == "error")]
    table = [
        {
            "change": found.runs[name].what or "base: cells of 4 cm, tyre of 4 x 36 elements",
            "cell_m": round(found.runs[name].number("cell"), 4),
            **found(name),
        }
        for name in names
    ]
    grids = grid_series(table)
    if len(grids) < 3:
        return table, {}
    sizes = [row["cell_m"] for row in grids]
    return table, {
        what: grid_convergence(sizes, [row[what] for row in grids])
        for what in ("sinkage_m", "resistance")
    }


def grid_series(table: Sequence[Row]) -> list[Row]:
    """Rows that differ in the cells alone: the base, and other sizes."""
    sound = [r for r in table if not r["failure"]]
    return [r for r in sound if r["cell_m"] != 0.04 or r is table[0]]


def draw_errors(table: Sequence[Row], limits: Mapping[str, Convergence], path: Path) -> None:
    """Distance from the best estimate over cost, one point per size of cell."""
    grids = sorted(grid_series(table), key=lambda r: -float(r["cell_m"]))
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for axes, what, label in (
        (panels[0], "sinkage_m", "sinkage"),
        (panels[1], "resistance", "resistance coefficient"),
    ):
        limit, uncertain = limits[what].value, limits[what].error
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
            title=f"{label}: {limit:.3f} ± {uncertain:.3f}, best estimate",
            ylim=(0, None),
        )
        axes.grid(alpha=0.3, which="both")
    save(figure, path, dpi=90)


def design_table(found: Found) -> Iterator[Row]:
    """Rigid wheels of other sizes with the closed form."""
    for diameter, width in DESIGNS:
        if row := found(f"design_{100 * diameter:.0f}x{100 * width:.0f}cm"):
            expected = compacted(diameter, width, 0.20, 220.0, LOAD)
            yield {
                "diameter_m": diameter,
                "width_m": width,
                **row,
                "closed_form_sinkage_m": round(expected.sinkage, 4),
                "closed_form_resistance": round(expected.resistance, 4),
            }


def pressure_table(found: Found) -> Iterator[Row]:
    """The tyre at other pressures on 0.20 m of 220 kg/m3, with NRMM."""
    for pressure, name in PRESSURES.items():
        row = found(name)
        if row and not row["failure"]:
            sinkage = empirical.nrmm_sinkage(0.20, 220.0, pressure)
            resistance = empirical.nrmm_resistance(220.0, WIDTH, MEASURED_RADIUS, sinkage) / LOAD
            yield {
                "pressure_kPa": round(pressure / 1e3),
                **{what: row[what] for what in ("run", "user_s", "sinkage_m", "resistance")},
                "nrmm_sinkage_m": round(sinkage, 4),
                "nrmm_resistance": round(resistance, 4),
            }


def pass_table(run: Run) -> Iterator[Row]:
    """Sinkage and resistance of each pass in one rut, over the last WINDOW of its cruise."""
    wheel = Results(run.folder).columns
    for number in range(1, PASSES + 1):
        cruise = (wheel["pass"] == number) & (wheel["stage"] == CRUISE)
        columns = ("x", "hub_drop", "slip", "force_x", "force_z")
        mine = {name: wheel[name][cruise] for name in columns}
        seconds = round(run.record.cpu_time / PASSES, 1)
        yield {"run": f"{run.name}_{number}", "user_s": seconds, **steady_columns(mine, WINDOW)}


# ---- all


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    found = Found(runs, stored_rows(output))
    staged = runs.ended("predict", "rows", "flowing", "slope", "spreading", "fine")
    results = [{"run": "", "stage": run.case.stage, "what": run.what, **found(run.name)} for run in staged]
    output.table("results.csv", results)
    measured = reference()
    table = [measured_row(found, row) for row in measured]
    output.table(output.of_all_runs("rows.csv"), table)
    draw_comparison(table, output.path(output.of_all_runs("comparison.png")))
    scores = [accuracy(table, used, model) for model in (*COMPUTED, "nrmm") for used in ROWS]
    output.table(output.of_all_runs("accuracy.csv"), scores)
    output.table(output.of_all_runs("slope.csv"), slope_table(found, table))
    choices = {
        "prediction": [row for row in measured if not is_calibration(row)],
        "other_densities": [row for row in measured if not has_calibration_density(row)],
        "all": measured,
    }
    output.table("mass_balance.csv", mass_table(choices))
    changes, limits = error_table(found)
    output.table("error.csv", changes)
    cells = {case.name: float(str(case.variables["cell"])) for case in runs.cases}
    output.table(output.of_all_runs("cells.csv"), cell_table(cells, found.rows))
    output.table(output.of_all_runs("numerical.csv"), numerical_table(table, found))
    for what, series in limits.items():
        way = series.reason or f"extrapolated, order {series.order:.2f}"
        print(f"{what}: best estimate {series.value:.4f} ± {series.error:.4f} ({way})")
    if limits:
        draw_errors(changes, limits, output.path("error.png"))
    output.table("design.csv", list(design_table(found)))
    output.table("pressures.csv", list(pressure_table(found)))
    output.table("passes.csv", [row for run in runs.done("passes") for row in pass_table(run)])
    for name, title in SECTIONS.items():
        if run := runs.one(name):
            picture = output.path(f"section_{name}.png")
            draw_terrain(run.folder, title, "", picture, dpi=75)
    return []
