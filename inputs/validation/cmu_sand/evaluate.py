# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates and the wheels of CMU's tests with the measurements; finer grains, other laws and the
continuum; the wheel with grousers; the smooth wheel at a slip angle."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from furrow_post.analyse.grid_convergence import grid_convergence
from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_matrix, read_rows
from furrow_post.figures.style import save
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

HERE = Path(__file__).resolve().parent
RADIUS = 58.0  # [mm]
CHOSEN, CANDIDATES = "A", ("A", "B", "C", "E")
PLATE_CHECKS = ("12.5", "8", "seed", "fast")  # of the chosen candidate
PLATES = (60, 80, 100)  # [mm]
WHEELS = ("smooth", "grouser")
WALL_FRICTION, WIDTH_OF_BED, SEED = 0.7, 0.16, 86028121  # of the base; [m]
BASE_DIAMETER = 0.010  # [m] of grains
WINDOW = (0.14, 0.239)  # [m] of travel, for the steady values of the first stages
# The same from the end of the travel, of the other stages: the window above ends beyond the last row
# of some of these runs
GROUND_WINDOW = (0.1, 0.002)
# Of the grain diameter: from the level of the mass to the top of the highest grains
SURFACES = np.arange(0.0, 0.601, 0.025)
BASE_OF_CHECKS = (
    "base: grains of 10 mm, bed 0.46 x 0.16 x 0.07 m, 0.2 m/s, friction of wheel and sand 0.7"
)
GOAL = 0.10  # rms of Fx/Fz
FINER = "smooth wheel, 5 slips with grains of 8 mm"
GOALS = {
    f"{what}: rms of {quantity}": 0.10
    for what in ("smooth wheel", "grouser wheel", FINER)
    for quantity in ("Fx/Fz", "sinkage/r")
}
# What was reached, plus the scatter from one pour to the next (0.04 for the plates, 0.02 to 0.03
# for a wheel's rms, README.md): the limits of the test. The goals stand next to them and are not all
# reached.
REACHED = {
    "plates: rms of ln(force)": 0.32,
    "smooth wheel: rms of Fx/Fz": 0.11,
    "smooth wheel: rms of sinkage/r": 0.07,
    "grouser wheel: rms of Fx/Fz": 0.14,
    "grouser wheel: rms of sinkage/r": 0.12,
    f"{FINER}: rms of Fx/Fz": 0.18,
    f"{FINER}: rms of sinkage/r": 0.10,
}
# The same of the other grounds: ground and size [mm] -> rms
GROUNDS_REACHED = {
    ("grains", 8.0): 0.15,
    ("grains, rolling friction 0.35", 6.0): 0.10,
    ("grains, rolling friction 0.5", 8.0): 0.13,
    ("continuum", 7.0): 0.10,
}
GROUSERS_REACHED = {8.0: 0.15, 6.0: 0.12}
QUANTITIES = {"fx_over_fz": "fx_over_fz_error", "sinkage_mm": "sinkage_error_mm"}
LIMIT_COLUMNS = tuple(
    column
    for key, error in QUANTITIES.items()
    for column in ("measured_" + key, key, error, f"{key}_order")
)
GRAINS, CONTINUUM = "grains", "continuum"
STRONG, BETWEEN = (f", rolling friction {value:g}" for value in (0.5, 0.35))
COLOURS = {
    GRAINS: "tab:blue",
    CONTINUUM: "tab:red",
    GRAINS + BETWEEN: "tab:cyan",
    GRAINS + STRONG: "tab:green",
    CONTINUUM + STRONG: "tab:orange",
}

# ---- at a slip angle
WHEEL_WIDTH = 50.0  # [mm]
SIDE_COLOURS = {
    "grains, rolling friction 0.35": "tab:cyan",
    "grains, rolling friction 0.5": "tab:green",
    "continuum, rolling friction 0.5": "tab:orange",
}
LABELS = {"fy_over_fz": "Fy/Fz", "fx_over_fz": "Fx/Fz", "sinkage_mm": "sinkage [mm]"}
# Fy/Fz with the finest grains that were run, less and plus twice the scatter of pours
SIDE_REACHED = {
    "grains, rolling friction 0.35": (0.25, 0.37),
    "grains, rolling friction 0.5": (0.31, 0.43),
    "continuum, rolling friction 0.5": (0.2, 0.6),
}
ERRORS = {"fy_over_fz": "fy_over_fz_error", **QUANTITIES}

# ---- the wheel with grousers
GROUSER_PANELS = (
    ("fx_over_fz", "Fx/Fz", "force_N", "force_std_N"),
    ("sinkage_mm", "sinkage [mm]", "sinkage_mm", "sinkage_std_mm"),
)

Curve = tuple[Floats, Floats]  # sinkage [mm] below the level of the bed's mass, force [N]
Row = dict[str, Any]  # of a table


@dataclass(frozen=True)
class Point:
    """A row of reference.csv; NaN where it has nothing."""

    kind: str  # plate, smooth or grouser
    values: dict[str, float]

    def __getitem__(self, key: str) -> float:
        return self.values[key]


def reference() -> list[Point]:
    return [
        Point(row["kind"], {k: float(v) if v else math.nan for k, v in row.items() if k != "kind"})
        for row in read_rows(HERE / "reference.csv")
    ]


def plate_points(size: int) -> list[Point]:
    """Measured on the plate of this size [mm]."""
    return [p for p in reference() if p.kind == "plate" and p["size_mm"] == size]


def wheel_points(kind: str) -> list[Point]:
    """Measured points that are computed."""
    return [p for p in reference() if p.kind == kind and -0.55 < p["slip"] < 0.8]


def nearest_point(kind: str, slip: float) -> Point:
    return min(wheel_points(kind), key=lambda p: abs(p["slip"] - slip))


def cpu_time(run: Run) -> float:
    """User and system time [s]."""
    return round(run.record.cpu_time + run.record.system_time, 1)


def steady_values(runs: Runs, run: Run, window: Sequence[float]) -> dict[str, float]:
    """furrow-resistance's own evaluation over a part of the travel [m]."""
    (row,) = runs.resistance(run, "--csv", "--distance", *(f"{end:.4g}" for end in window))
    return row


# ---- plates


def plate_curve(folder: Path) -> Curve:
    """Smoothed over 1.1 mm: a tenth of a grain."""
    table = read_matrix(folder / "curve.txt", 3)
    width = 11
    padded = np.pad(table[:, 2], width // 2, "edge")
    return 1000 * table[:, 1], np.convolve(padded, np.ones(width) / width, "valid")


def log_errors(curve: Curve, size: int, surface: float) -> list[float]:
    """ln(computed/measured force) at the measured sinkages of one plate.

    Counted from a surface [mm] above the level of the mass.
    """
    sinkage, force = curve
    return [
        math.log(np.interp(p["sinkage_mm"], sinkage + surface, force) / p["force_N"])
        for p in plate_points(size)
    ]


def fit_plates(curves: Mapping[int, Curve], diameter: float) -> tuple[float, float, float]:
    """Effective surface [mm] of the smallest rms of ln(force), that rms, and the rms at surface 0.

    diameter: of the grains [mm]
    """

    def error(surface: float) -> float:
        parts = [log_errors(curve, size, surface) for size, curve in curves.items()]
        return rms([e for part in parts for e in part])

    surface = float(min(diameter * SURFACES, key=error))
    return surface, error(surface), error(0.0)


def homogeneous_floor() -> float:
    """Least rms of ln(pressure) that p = rho g B f(z/B) can reach, ln f quadratic.

    The only form that a dry frictional half-space has.
    """
    points = [p for p in reference() if p.kind == "plate"]
    size, sinkage, force = (
        np.array([p[key] for p in points]) for key in ("size_mm", "sinkage_mm", "force_N")
    )
    x, y = np.log(sinkage / size), np.log(force / size**3)
    return rms(y - np.polyval(np.polyfit(x, y, 2), x))


def calibration_table(runs: Runs) -> list[Row]:
    """One row per candidate, then the chosen one with one thing changed.

    Plates that were not run are left out and show as empty.
    """
    names = [*CANDIDATES, *(CHOSEN + check for check in PLATE_CHECKS)]
    return [row for name in names if (row := calibration_row(runs, name))]


def calibration_row(runs: Runs, name: str) -> Row:
    """Empty where no plate of the candidate was run."""
    plates = {size: run for size in PLATES if (run := runs.one(f"plate_{name}_{size}"))}
    if not plates:
        return {}
    curves = {size: plate_curve(run.folder) for size, run in plates.items()}
    first = plates[min(plates)]
    diameter, facts = first.number("diameter"), first.record.facts
    surface, best, plain = fit_plates(curves, 1000 * diameter)
    row = {
        "candidate": name,
        "grain_mm": 1000 * diameter,
        **{key: first.case.variables[key] for key in ("friction", "rolling", "pour_friction", "speed")},
        "solid_fraction": round(facts["solid_fraction"], 4),
        "bulk_density_kgm3": round(facts["bulk_density"], 1),
        "surface_mm": round(surface, 3),
        "surface_over_grain": round(surface / 1000 / diameter, 2),
        "rms_ln_force": round(best, 3),
        "rms_ln_force_surface_0": round(plain, 3),
    }
    for size in PLATES:
        error = round(rms(log_errors(curves[size], size, surface)), 3) if size in curves else ""
        row[f"rms_{size}"] = error
    row["cpu_s"] = round(sum(cpu_time(run) for run in plates.values()), 1)
    return row


# ---- wheels


def wheel_row(runs: Runs, run: Run, point: Point, surface: float) -> Row:
    """surface [mm]: effective surface above the level of the mass."""
    values = steady_values(runs, run, WINDOW)
    return {
        "run": run.name,
        "wheel": point.kind,
        "slip": point["slip"],
        "load_N": point["load_N"],
        "measured_fx_over_fz": round(point["force_N"] / point["load_N"], 4),
        "measured_error": round(point["force_std_N"] / point["load_N"], 4),
        "fx_over_fz": round(-values["resistance_coefficient"], 4),
        "fx_over_fz_error": round(values["resistance_coefficient_error"], 4),
        "measured_sinkage_mm": point["sinkage_mm"],
        "measured_sinkage_error_mm": point["sinkage_std_mm"],
        "sinkage_from_mass_mm": round(1000 * values["hub_drop"], 2),
        "sinkage_mm": round(1000 * values["hub_drop"] + surface, 2),
        "sinkage_error_mm": round(1000 * values["sinkage_error"], 2),
        "steady": "yes" if values["steady"] else "no",
        "grains": int(run.record.facts["grains"]),
        "steps": int(run.record.facts["steps"]),
        "cpu_s": cpu_time(run),
    }


def wheel_name(point: Point) -> str:
    return f"{point.kind}_{point['slip']:+.3f}"


def wheel_table(runs: Runs, surface: float) -> list[Row]:
    return [
        wheel_row(runs, run, point, surface)
        for kind in WHEELS
        for point in wheel_points(kind)
        if (run := runs.one(wheel_name(point)))
    ]


def check_table(runs: Runs, surface: float) -> list[Row]:
    """The base points of the checks, then every change of them."""
    bases = [runs.one(wheel_name(point)) for point in wheel_points("smooth")[:-1]]
    checked = [(run, BASE_OF_CHECKS) for run in bases if run]
    checked += [(run, run.what) for run in runs.done("check_*")]
    rows = []
    for run, what in checked:
        # the surface is a share of the grain
        share = run.number("diameter") / BASE_DIAMETER
        row = wheel_row(runs, run, nearest_point("smooth", run.number("slip")), surface * share)
        left_out = ("run", "load_N", "measured_error")
        kept = {key: value for key, value in row.items() if key not in left_out}
        rows.append({"run": run.name, "what": what, **kept})
    return rows


def accuracy_of_wheel(rows: Sequence[Row]) -> dict[str, float]:
    """rms over the slips: Fx over mean Fz, sinkage over radius, the latter with both surfaces."""
    measured = np.array([row["measured_sinkage_mm"] for row in rows])
    sinkage, from_mass = (
        rms((np.array([row[key] for row in rows]) - measured) / RADIUS)
        for key in ("sinkage_mm", "sinkage_from_mass_mm")
    )
    pull = rms([row["fx_over_fz"] - row["measured_fx_over_fz"] for row in rows])
    return {
        "rms of Fx/Fz": pull,
        "rms of sinkage/r": sinkage,
        "rms of sinkage/r, from the level of the mass": from_mass,
    }


def sized_wheels(rows: Sequence[Row], checks: Sequence[Row]) -> Iterator[tuple[str, str, int, list[Row]]]:
    """Case, what it is, grain size [mm] and rows: both wheels on grains of 10 mm, and the smooth one
    on grains of 8 mm and of 10 mm at the same slips."""
    for kind in WHEELS:
        yield f"{kind}_10", f"{kind} wheel", 10, [row for row in rows if row["wheel"] == kind]
    finer = [row for row in checks if row["run"].startswith("check_grain_8")]
    slips = [row["slip"] for row in finer]
    same = [row for row in rows if row["wheel"] == "smooth" and row["slip"] in slips]
    for size, mine in ((8, finer), (10, same)):
        what = f"smooth wheel, {len(slips)} slips with grains of {size} mm"
        yield f"smooth_{size}_slips_of_8", what, size, mine


def accuracy_of_wheels(rows: Sequence[Row], checks: Sequence[Row]) -> list[Row]:
    """A row for each of sized_wheels that was run."""
    return [
        {
            "case": case,
            "what": what,
            "grain_mm": size,
            "slips": len(mine),
            **{
                column: round(accuracy_of_wheel(mine)[f"rms of {quantity}"], 3)
                for column, quantity in (("rms_fx_over_fz", "Fx/Fz"), ("rms_sinkage_over_r", "sinkage/r"))
            },
        }
        for case, what, size, mine in sized_wheels(rows, checks)
        if mine
    ]


def draw_rows(
    axes: Axes, rows: Sequence[Row], x: str, key: str, bars: float = 1.0, **look: Any
) -> None:
    """A quantity of ERRORS over a column, 0 where a row has none. bars: in standard errors"""
    y, errors = ([row[name] for row in rows] for name in (key, ERRORS[key]))
    axes.errorbar([row.get(x, 0.0) for row in rows], y, bars * np.array(errors, float), **look)


def draw_comparison(runs: Runs, path: Path, surface: float, rows: Sequence[Row]) -> None:
    figure, (plates, pull, sink) = plt.subplots(1, 3, figsize=(13, 4.2), constrained_layout=True)
    draw_plates(plates, runs, surface)
    for kind, colour in (("smooth", "tab:blue"), ("grouser", "tab:red")):
        draw_measured_wheels(pull, sink, kind, colour)
        mine = sorted(
            (row for row in rows if row["wheel"] == kind), key=lambda row: float(row["slip"])
        )
        draw_computed_wheels(pull, sink, kind, colour, mine)
    pull.axhline(0, color="grey", lw=0.5)
    pull.set(xlabel="slip", ylabel="Fx/Fz", title="wheel: tractive force")
    sink.set(xlabel="slip", ylabel="sinkage [mm]", title="wheel: sinkage", ylim=(0, None))
    for axes in (plates, pull, sink):
        axes.legend(fontsize=7)
        axes.grid(alpha=0.3)
    save(figure, path, dpi=75)


def draw_plates(axes: Axes, runs: Runs, surface: float) -> None:
    for size, colour in zip(PLATES, ("tab:blue", "tab:orange", "tab:green")):
        points = plate_points(size)
        area = math.pi / 4 * size**2 / 1000  # [mm2], for kPa
        pressure = [p["force_N"] / area for p in points]
        scatter = [np.nan_to_num(p["force_std_N"]) / area for p in points]  # of the tests
        look = {"fmt": "o", "ms": 3, "color": colour, "label": f"{size} mm measured"}
        axes.errorbar([p["sinkage_mm"] for p in points], pressure, scatter, **look)
        if run := runs.one(f"plate_{CHOSEN}_{size}"):
            sinkage, force = plate_curve(run.folder)
            label = f"{size} mm computed"
            axes.plot(sinkage + surface, force / area, color=colour, label=label)
    axes.set(
        xlabel="sinkage [mm]",
        ylabel="mean pressure [kPa]",
        xlim=(0, 21),
        ylim=(0, 40),
        title="plates (calibration)",
    )


def draw_measured_wheels(pull: Axes, sink: Axes, kind: str, colour: str) -> None:
    points = [p for p in reference() if p.kind == kind and -0.75 < p["slip"] < 0.95]
    slips = [p["slip"] for p in points]
    look = {"fmt": "o", "ms": 4, "color": colour}
    force = [p["force_N"] / p["load_N"] for p in points]
    scatter = [p["force_std_N"] / p["load_N"] for p in points]
    pull.errorbar(slips, force, scatter, label=f"{kind} measured", **look)
    sinkage = [p["sinkage_mm"] for p in points]
    sink.errorbar(slips, sinkage, [p["sinkage_std_mm"] for p in points], **look)


def draw_computed_wheels(
    pull: Axes, sink: Axes, kind: str, colour: str, rows: Sequence[Row]
) -> None:
    """Bars: two standard errors."""
    look = {"marker": "s", "mfc": "none", "capsize": 3, "color": colour}
    draw_rows(pull, rows, "slip", "fx_over_fz", 2.0, label=f"{kind} computed", **look)
    draw_rows(sink, rows, "slip", "sinkage_mm", 2.0, **look)
    from_mass = [row["sinkage_from_mass_mm"] for row in rows]
    slips = [row["slip"] for row in rows]
    sink.plot(slips, from_mass, ":", color=colour, label=f"{kind}, from the level of the mass")


def of_wheels(runs: Runs, output: Output) -> Iterator[str]:
    """Writes calibration.csv, results.csv, checks.csv, wheels.csv, comparison.png; missed limits."""
    calibration = calibration_table(runs)
    output.table("calibration.csv", calibration)
    chosen = next((row for row in calibration if row["candidate"] == CHOSEN), None)
    if chosen is None:
        yield "no plate was run with the chosen grains"
        return
    surface = chosen["surface_mm"]
    rows, checks = wheel_table(runs, surface), check_table(runs, surface)
    output.table("results.csv", rows)
    output.table("checks.csv", checks)
    draw_comparison(runs, output.path("comparison.png"), surface, rows)
    reached = {"plates: rms of ln(force)": chosen["rms_ln_force"]}
    output.table("wheels.csv", accuracy_of_wheels(rows, checks))
    for _, label, _, mine in sized_wheels(rows, checks):
        found = accuracy_of_wheel(mine) if mine else {}
        reached |= {f"{label}: {what}": value for what, value in found.items()}
    floor = homogeneous_floor()
    print(f"least rms of ln(force) of any dry frictional half-space on these plates: {floor:.3f}")
    for name, value in reached.items():
        limit, goal = REACHED.get(name), GOALS.get(name)
        verdict = ""
        if goal:
            verdict = f"  (goal {goal}: {'reached' if value <= goal else 'not reached'})"
        print(f"{name}: {value:.3f}{verdict}" + (f"  limit {limit}" if limit else ""))
        if limit and not value <= limit:
            yield f"{name} is {value:.3f}, limit {limit}"


# ---- finer grains, other laws, the continuum


def surface_over_grain() -> float:
    """Effective surface above the level of the mass, fitted on the plates by run.py."""
    rows = {row["candidate"]: row for row in read_rows(HERE / "calibration.csv")}
    return float(rows[CHOSEN]["surface_over_grain"])


def ground_of(run: Run) -> str:
    ground = GRAINS if "rolling" in run.case.variables else CONTINUUM
    named = {"rolling_0.5": STRONG, "rolling_0.35": BETWEEN}
    return ground + "".join(words for part, words in named.items() if part in run.name)


def wheel_of(run: Run) -> str:
    """One of WHEELS."""
    return "grouser" if run.number("grouser_height") else "smooth"


def what_of(run: Run) -> str:
    """What is changed in addition to size and slip."""
    changed = [
        f"{words} {run.case.variables[key]}"
        for key, base, words in (
            ("slip_angle", 0.0, "slip angle"),
            ("wall_friction", WALL_FRICTION, "friction of wheel and sand"),
            ("width", WIDTH_OF_BED, "width"),
        )
        if run.case.variables.get(key, base) != base
    ]
    if run.case.variables.get("seed", SEED) != SEED:
        changed.append("another pour")
    return ", ".join(changed)


def along_heading(along_travel: float, lateral: float, slip_angle: float) -> float:
    """F_T from F_x and F_S, by equation 3 of src/theory/symbols.md; the angle in degrees."""
    angle = math.radians(slip_angle)
    return (along_travel + lateral * math.sin(angle)) / math.cos(angle)


def error_along_heading(along_travel: float, lateral: float, slip_angle: float) -> float:
    """Standard error of F_T from those of F_x and F_S, taken as independent."""
    angle = math.radians(slip_angle)
    return math.hypot(along_travel, lateral * math.sin(angle)) / math.cos(angle)


def row_of(runs: Runs, run: Run) -> Row:
    """Both forces are in the wheel's frame, as those of [Pavlov2024]."""
    travel = run.number("travel")
    values = steady_values(runs, run, [travel - end for end in GROUND_WINDOW])
    ground = ground_of(run)
    size = 1000 * run.number("diameter" if ground.startswith(GRAINS) else "cell")
    surface = surface_over_grain() * size if ground.startswith(GRAINS) else 0.0
    point = nearest_point(wheel_of(run), run.number("slip"))
    sideways = "slip_angle" in run.case.variables
    fz = values["force_z"]
    lateral, lateral_error = 0.0, 0.0
    if sideways:
        lateral, lateral_error = values["lateral_force"] / fz, values["lateral_force_error"] / fz
    angle = run.number("slip_angle")
    traction = along_heading(-values["resistance_coefficient"], lateral, angle)
    traction_error = error_along_heading(values["resistance_coefficient_error"], lateral_error, angle)
    return {
        "run": run.name,
        "ground": ground,
        "size_mm": round(size, 2),
        "changed": what_of(run),
        "slip": point["slip"],
        "measured_fx_over_fz": "" if sideways else round(point["force_N"] / point["load_N"], 4),
        "fx_over_fz": round(traction, 4),
        "fx_over_fz_error": round(traction_error, 4),
        "measured_sinkage_mm": "" if sideways else point["sinkage_mm"],
        "sinkage_mm": round(1000 * values["hub_drop"] + surface, 2),
        "sinkage_error_mm": round(1000 * values["sinkage_error"], 2),
        "fy_over_fz": round(lateral, 4) if sideways else "",
        "fy_over_fz_error": round(lateral_error, 4) if sideways else "",
        "torque_over_fz_r": round(1000 * values["drive_torque"] / fz / RADIUS, 4),
        "cpu_s": cpu_time(run),
    }


def straight(rows: Sequence[Row]) -> list[Row]:
    """Those with nothing changed but size, slip, law and pour."""
    return [row for row in rows if row["changed"] in ("", "another pour")]


def scatter_of_pours(rows: Sequence[Row], key: str) -> float:
    """Standard deviation of one run, from pairs of pours."""
    pairs = [
        one[key] - other[key]
        for one, other in combinations(rows, 2)
        if all(one[same] == other[same] for same in ("ground", "size_mm", "slip"))
    ]
    return rms(pairs) / math.sqrt(2.0) if pairs else math.nan


def limit_of(
    rows: Sequence[Row], pours: Mapping[str, float], errors: Mapping[str, str] = QUANTITIES
) -> Row:
    """Of one ground at one slip: the best estimate of all its sizes.

    pours: standard deviation of a run on grains from one pour to the next, by quantity; a continuum
    has none, and its error in time counts. errors: columns of the quantities' errors.
    """
    poured = rows[0]["ground"].startswith(GRAINS)
    sizes = [row["size_mm"] for row in rows]
    found: Row = {}
    for key, error in errors.items():
        scatter = pours[key] if poured else rms([row[error] for row in rows])
        series = grid_convergence(sizes, [row[key] for row in rows], [scatter] * len(rows))
        found.update({key: round(series.value, 4), error: round(series.error, 4)})
        found[f"{key}_order"] = round(series.used_order, 2) if series.extrapolated else ""
    return found


def limit_table(rows: Sequence[Row]) -> list[Row]:
    """A row for each ground and slip with two sizes or more."""
    rows = straight(rows)
    pours = {key: scatter_of_pours(rows, key) for key in QUANTITIES}
    found = []
    for ground in COLOURS:
        for slip in sorted({row["slip"] for row in rows}):
            mine = [row for row in rows if row["ground"] == ground and row["slip"] == slip]
            sizes = [row["size_mm"] for row in mine]
            if len(set(sizes)) < 2:
                continue
            head = {"ground": ground, "slip": slip, "runs": len(mine), "finest_mm": min(sizes)}
            limit = {**mine[0], **limit_of(mine, pours)}
            found.append({**head, **{name: limit[name] for name in LIMIT_COLUMNS}})
    return found


def accuracy(rows: Sequence[Row]) -> float:
    """rms of Fx/Fz over all rows; pours of one point count as their mean."""
    points: dict[float, list[Row]] = {}
    for row in rows:
        points.setdefault(row["slip"], []).append(row)
    return rms(
        [
            float(np.mean([row["fx_over_fz"] for row in mine])) - mine[0]["measured_fx_over_fz"]
            for mine in points.values()
        ]
    )


def accuracy_table(rows: Sequence[Row], limits: Sequence[Row]) -> list[Row]:
    """A row for each ground and size that has all slips."""
    slips = {row["slip"] for row in rows}
    sized = [*rows, *({**row, "size_mm": 0.0} for row in limits)]
    found = []
    for ground in COLOURS:
        for size in sorted({row["size_mm"] for row in sized}, reverse=True):
            mine = [r for r in sized if r["ground"] == ground and r["size_mm"] == size]
            if {row["slip"] for row in mine} == slips:
                found.append(
                    {"ground": ground, "size_mm": size, "rms_fx_over_fz": round(accuracy(mine), 3)}
                )
    return found


def draw_grounds(path: Path, rows: Sequence[Row], limits: Sequence[Row]) -> None:
    """A column for each slip: Fx/Fz above, sinkage below, against the size."""
    slips = sorted({row["slip"] for row in limits})
    figure, axes = plt.subplots(
        2, len(slips), figsize=(4 * len(slips), 6), sharex=True, sharey="row", squeeze=False
    )
    for line, key, label in zip(axes, QUANTITIES, ("Fx/Fz", "sinkage [mm]")):
        for panel, slip in zip(line, slips):
            for ground, colour in COLOURS.items():
                for table, marker in ((rows, "o"), (limits, "D")):
                    mine = [r for r in table if r["ground"] == ground and r["slip"] == slip]
                    look: dict[str, Any] = {"fmt": marker, "color": colour, "ms": 5, "capsize": 3}
                    label_of_ground = ground if marker == "o" and mine else None
                    draw_rows(panel, mine, "size_mm", key, label=label_of_ground, **look)
            measured = next(r["measured_" + key] for r in rows if r["slip"] == slip)
            panel.axhline(measured, color="black", lw=1, label="measured")
            panel.grid(alpha=0.3)
        line[0].set_ylabel(label)
    for panel, slip in zip(axes[0], slips):
        panel.set_title(f"slip {slip:g}")
    for panel in axes[1]:
        panel.set_xlabel("grains or cells [mm]; 0: best estimate")
    axes[0][0].legend(fontsize=7)
    save(figure, path, dpi=75)


def of_grounds(runs: Runs, output: Output) -> Iterator[str]:
    rows = [row_of(runs, run) for run in runs.done("sizes", "laws", "side", "continuum")]
    output.table("grounds.csv", rows)
    limits = limit_table(rows)
    output.table("best_estimates.csv", limits)
    reached = accuracy_table(straight(rows), limits)
    output.table("accuracy.csv", reached)
    if limits:
        draw_grounds(output.path("grounds.png"), straight(rows), limits)
    for row in reached:
        limit = GROUNDS_REACHED.get((row["ground"], row["size_mm"]), math.inf)
        if row["rms_fx_over_fz"] > limit:
            yield (
                f"{row['ground']}, {row['size_mm']:g} mm: rms of Fx/Fz is {row['rms_fx_over_fz']}, "
                f"limit {limit}"
            )


# ---- the wheel with grousers


def by_size(rows: Sequence[Row]) -> dict[float, list[Row]]:
    found: dict[float, list[Row]] = {}
    for row in rows:
        found.setdefault(row["size_mm"], []).append(row)
    return found


def grouser_accuracy(rows: Sequence[Row]) -> list[Row]:
    """A row for each size: rms over the slips that were run."""
    found = []
    for size, mine in by_size(rows).items():
        sinkages = [row["sinkage_mm"] - row["measured_sinkage_mm"] for row in mine]
        found.append(
            {
                "ground": mine[0]["ground"],
                "size_mm": size,
                "slips": len(mine),
                "rms_fx_over_fz": round(accuracy(mine), 3),
                "rms_sinkage_over_r": round(rms(sinkages) / RADIUS, 3),
            }
        )
    return found


def scatter_of_smooth(key: str) -> float:
    """Standard deviation of one run from one pour to the next, of the smooth wheel on these grains:
    the wheel with grousers has one pour."""
    rows = [row for row in read_rows(HERE / "grounds.csv") if not row["fy_over_fz"]]
    mine = [row for row in rows if row["ground"] == GRAINS + BETWEEN]
    return scatter_of_pours([{**row, key: float(row[key])} for row in mine], key)


def grouser_limits(rows: Sequence[Row]) -> list[Row]:
    """Best estimates: a row for each slip that has all sizes."""
    pours = {key: scatter_of_smooth(key) for key in QUANTITIES}
    found = []
    for slip in sorted({row["slip"] for row in rows}):
        mine = [row for row in rows if row["slip"] == slip]
        if len(mine) == 3:
            found.append({**mine[0], "size_mm": 0.0, **limit_of(mine, pours)})
    return found


def draw_grousers(path: Path, rows: Sequence[Row]) -> None:
    """Fx/Fz and sinkage over the slip, measured and computed."""
    measured = sorted(wheel_points("grouser"), key=lambda point: point["slip"])
    slips = [point["slip"] for point in measured]
    figure, panels = plt.subplots(1, 2, figsize=(10, 4))
    for panel, (key, label, column, scatter) in zip(panels, GROUSER_PANELS):
        loads = [point["load_N"] if key == "fx_over_fz" else 1.0 for point in measured]
        values = [point[column] / load for point, load in zip(measured, loads)]
        errors = [point[scatter] / load for point, load in zip(measured, loads)]
        panel.errorbar(slips, values, errors, fmt="s-", color="black", capsize=3, label="measured")
        for size, unsorted in by_size(rows).items():
            mine = sorted(unsorted, key=lambda row: float(row["slip"]))
            name = f"{mine[0]['ground']}, {f'{size:g} mm' if size else 'best estimate'}"
            mark = "o--" if size else "D"
            draw_rows(panel, mine, "slip", key, fmt=mark, ms=4, capsize=3, label=name)
        panel.set(xlabel="slip", ylabel=label)
        panel.grid(alpha=0.3)
    panels[0].legend(fontsize=7)
    save(figure, path, dpi=75)


def of_grousers(runs: Runs, output: Output) -> Iterator[str]:
    rows, assumed = (
        [{**row_of(runs, run), "changed": run.what} for run in runs.done(stage)]
        for stage in ("grousers", "assumed")
    )
    output.table("grousers_assumed.csv", assumed)
    output.table("grousers.csv", rows)
    if not rows:
        return
    limits = grouser_limits(rows)
    columns = ("ground", "slip", *LIMIT_COLUMNS)
    output.table("grousers_best_estimates.csv", [{k: row[k] for k in columns} for row in limits])
    reached = grouser_accuracy([*rows, *limits])
    output.table("grousers_accuracy.csv", reached)
    draw_grousers(output.path("grousers.png"), [*rows, *limits])
    for row in reached:
        if row["rms_fx_over_fz"] > (limit := GROUSERS_REACHED.get(row["size_mm"], 1.0)):
            yield f"{row['size_mm']:g} mm: rms of Fx/Fz is {row['rms_fx_over_fz']}, limit {limit}"


# ---- the smooth wheel at a slip angle


def draw_slip_angle(path: Path, rows: Sequence[Row], limits: Sequence[Row]) -> None:
    """Lateral and longitudinal force and sinkage over the size of the grains."""
    figure, panels = plt.subplots(1, len(LABELS), figsize=(11, 3.6), layout="constrained")
    best = [{**limit, "size_mm": 0.0} for limit in limits]
    for panel, (key, label) in zip(panels, LABELS.items()):
        for ground, colour in SIDE_COLOURS.items():
            for found, marker, name in ((rows, "o", ground), (best, "D", None)):
                mine = [row for row in found if row["ground"] == ground]
                look: dict[str, Any] = {"fmt": marker, "color": colour, "ms": 5, "label": name}
                draw_rows(panel, mine, "size_mm", key, capsize=3, **look)
        panel.set(xlabel="grains [mm]; 0: best estimate", ylabel=label)
        panel.grid(alpha=0.3)
    panels[1].legend(fontsize=7)
    save(figure, path, dpi=75)


def of_slip_angle(runs: Runs, output: Output) -> Iterator[str]:
    rows = [row_of(runs, run) for run in runs.done("slip_angle")]
    if not rows:
        return
    for row in rows:
        row["grains_in_width"] = round(WHEEL_WIDTH / row["size_mm"], 1)
    output.table("slip_angle.csv", rows)
    scatter = {key: scatter_of_pours(rows, key) for key in ERRORS}
    by_law = [[row for row in rows if row["ground"] == ground] for ground in SIDE_COLOURS]
    limits = []
    for mine in by_law:
        if len({row["size_mm"] for row in mine}) > 1:
            last = min(mine, key=lambda row: float(row["size_mm"]))
            head = {"ground": last["ground"], "finest_mm": last["size_mm"], "runs": len(mine)}
            limits.append({**head, **limit_of(mine, scatter, ERRORS)})
            low, high = SIDE_REACHED[last["ground"]]
            if not low <= last["fy_over_fz"] <= high:
                yield (
                    f"{last['ground']}, {last['size_mm']:g} mm: Fy/Fz is {last['fy_over_fz']}, not "
                    f"{low} to {high}"
                )
    output.table("slip_angle_best_estimates.csv", limits)
    draw_slip_angle(output.path("slip_angle.png"), rows, limits)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    parts = (of_wheels, of_grounds, of_grousers, of_slip_angle)
    return [sentence for part in parts for sentence in part(runs, output)]
