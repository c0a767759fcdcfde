# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: tables, accuracy, the figure."""

import csv
import math
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

import cases
from cases import Point

from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_matrix
from furrow_post.figures.style import save
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner

RADIUS = 58.0  # [mm]
# Of the grain diameter: from the level of the mass to the top of the highest grains
SURFACES = np.arange(0.0, 0.601, 0.025)

Curve = tuple[Floats, Floats]  # sinkage [mm] below the level of the bed's mass, force [N]
Row = dict[str, Any]  # of a table


def diameter_of(case: Case) -> float:
    """Of the grains [m]."""
    return float(str(case.variables["diameter"]))


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
        for p in cases.plate_points(size)
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
    points = [p for p in cases.reference() if p.kind == "plate"]
    size, sinkage, force = (
        np.array([p[key] for p in points]) for key in ("size_mm", "sinkage_mm", "force_N")
    )
    x, y = np.log(sinkage / size), np.log(force / size**3)
    return rms(y - np.polyval(np.polyfit(x, y, 2), x))


def calibration_table(runner: Runner) -> list[Row]:
    """One row per candidate, then the chosen one with one thing changed.

    Plates that were not run are left out and show as empty.
    """
    known = cases.all_cases()
    names = [*cases.CANDIDATES, *(cases.CHOSEN + check for check in cases.PLATE_CHECKS)]
    return [row for name in names if (row := calibration_row(runner, name, known))]


def calibration_row(runner: Runner, name: str, known: Mapping[str, Case]) -> Row:
    """Empty where no plate of the candidate was run."""
    plates = {size: known[f"plate_{name}_{size}"] for size in cases.PLATES}
    records = {size: r for size, case in plates.items() if (r := runner.record(case))}
    if not records:
        return {}
    curves = {size: plate_curve(runner.folder(plates[size])) for size in records}
    case, record = plates[min(records)], records[min(records)]
    diameter = diameter_of(case)
    surface, best, plain = fit_plates(curves, 1000 * diameter)
    row = {
        "candidate": name,
        "grain_mm": 1000 * diameter,
        **{key: case.variables[key] for key in ("friction", "rolling", "pour_friction", "speed")},
        "solid_fraction": round(record.facts["solid_fraction"], 4),
        "bulk_density_kgm3": round(record.facts["bulk_density"], 1),
        "surface_mm": round(surface, 3),
        "surface_over_grain": round(surface / 1000 / diameter, 2),
        "rms_ln_force": round(best, 3),
        "rms_ln_force_surface_0": round(plain, 3),
    }
    for size in cases.PLATES:
        error = round(rms(log_errors(curves[size], size, surface)), 3) if size in curves else ""
        row[f"rms_{size}"] = error
    row["cpu_s"] = round(sum(cpu_time(r) for r in records.values()), 1)
    return row


def cpu_time(record: Record) -> float:
    """User and system time [s]."""
    return round(record.cpu_time + record.system_time, 1)


# ---- wheels


def steady_values(runner: Runner, folder: Path) -> dict[str, float]:
    """furrow-resistance's own evaluation over the last part of the travel."""
    program = runner.tools.program("furrow-resistance")
    window = [str(end) for end in cases.WINDOW]
    command = [str(program), "--csv", "--distance", *window, str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    row = next(csv.DictReader(done.stdout.splitlines()))
    return {key: float(value) for key, value in row.items() if key != "folder"}


def wheel_row(runner: Runner, case: Case, record: Record, point: Point, surface: float) -> Row:
    """surface [mm]: effective surface above the level of the mass."""
    values = steady_values(runner, runner.folder(case))
    return {
        "run": case.name,
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
        "grains": int(record.facts["grains"]),
        "steps": int(record.facts["steps"]),
        "cpu_s": cpu_time(record),
    }


def wheel_table(runner: Runner, surface: float) -> list[Row]:
    known = cases.all_cases()
    return [
        wheel_row(runner, known[cases.wheel_name(point)], record, point, surface)
        for kind in cases.WHEELS
        for point in cases.wheel_points(kind)
        if (record := runner.record(known[cases.wheel_name(point)]))
    ]


def check_table(runner: Runner, surface: float) -> list[Row]:
    """The base points of the checks, then every change of them."""
    known = cases.all_cases()
    points = [
        (known[cases.wheel_name(point)], point, cases.BASE_OF_CHECKS)
        for point in cases.wheel_points("smooth")[:-1]
    ]
    for name, check in cases.CHECKS.items():
        point = cases.nearest_point("smooth", check.slip)
        points.append((known[f"check_{name}"], point, check.what))
    rows = []
    for case, point, what in points:
        record = runner.record(case)
        if record:
            # the surface is a share of the grain
            share = diameter_of(case) / float(str(cases.BASE["diameter"]))
            row = wheel_row(runner, case, record, point, surface * share)
            left_out = ("run", "load_N", "measured_error")
            kept = {key: value for key, value in row.items() if key not in left_out}
            rows.append({"run": case.name, "what": what, **kept})
    return rows


def accuracy(rows: Sequence[Row]) -> dict[str, float]:
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


# ---- all


def report(runner: Runner, output: Output) -> list[str]:
    """Writes calibration.csv, results.csv, checks.csv, comparison.png; returns missed limits."""
    calibration = calibration_table(runner)
    output.table("calibration.csv", calibration)
    chosen = next((row for row in calibration if row["candidate"] == cases.CHOSEN), None)
    if chosen is None:
        return ["no plate was run with the chosen grains"]
    surface = chosen["surface_mm"]
    rows = wheel_table(runner, surface)
    output.table("results.csv", rows)
    checks = check_table(runner, surface)
    output.table("checks.csv", checks)
    draw_comparison(runner, output.path("comparison.png"), surface, rows)

    reached = {"plates: rms of ln(force)": chosen["rms_ln_force"]}
    for kind in cases.WHEELS:
        mine = [row for row in rows if row["wheel"] == kind]
        if mine:
            reached |= {f"{kind} wheel: {what}": value for what, value in accuracy(mine).items()}
    reached |= finer_grains(rows, checks)
    floor = homogeneous_floor()
    print(f"least rms of ln(force) of any dry frictional half-space on these plates: {floor:.3f}")
    missed = []
    for name, value in reached.items():
        limit, goal = cases.REACHED.get(name), cases.GOALS.get(name)
        verdict = ""
        if goal:
            verdict = f"  (goal {goal}: {'reached' if value <= goal else 'not reached'})"
        print(f"{name}: {value:.3f}{verdict}" + (f"  limit {limit}" if limit else ""))
        if limit and not value <= limit:
            missed.append(f"{name} is {value:.3f}, limit {limit}")
    return missed


def finer_grains(rows: Sequence[Row], checks: Sequence[Row]) -> dict[str, float]:
    """Accuracy of the smooth wheel on grains of 8 mm, and on those of 10 mm at the same slips."""
    finer = [row for row in checks if row["run"].startswith("check_grain_8")]
    if not finer:
        return {}
    slips = [row["slip"] for row in finer]
    same = [row for row in rows if row["wheel"] == "smooth" and row["slip"] in slips]
    reached = {}
    for size, mine in (("8", finer), ("10", same)):
        values = accuracy(mine)
        label = f"smooth wheel, {len(slips)} slips with grains of {size} mm"
        for what in ("rms of Fx/Fz", "rms of sinkage/r"):
            reached[f"{label}: {what}"] = values[what]
    return reached


def draw_comparison(runner: Runner, path: Path, surface: float, rows: Sequence[Row]) -> None:
    figure, (plates, pull, sink) = plt.subplots(1, 3, figsize=(13, 4.2), constrained_layout=True)
    draw_plates(plates, runner, surface)
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


def draw_plates(axes: Axes, runner: Runner, surface: float) -> None:
    known = cases.all_cases()
    for size, colour in zip(cases.PLATES, ("tab:blue", "tab:orange", "tab:green")):
        points = cases.plate_points(size)
        area = math.pi / 4 * size**2 / 1000  # [mm2], for kPa
        pressure = [p["force_N"] / area for p in points]
        scatter = [np.nan_to_num(p["force_std_N"]) / area for p in points]  # of the tests
        look = {"fmt": "o", "ms": 3, "color": colour, "label": f"{size} mm measured"}
        axes.errorbar([p["sinkage_mm"] for p in points], pressure, scatter, **look)
        case = known[f"plate_{cases.CHOSEN}_{size}"]
        if runner.record(case):
            sinkage, force = plate_curve(runner.folder(case))
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
    points = [p for p in cases.reference() if p.kind == kind and -0.75 < p["slip"] < 0.95]
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
    slips = [row["slip"] for row in rows]
    look = {"marker": "s", "mfc": "none", "capsize": 3, "color": colour}
    force, force_error = (
        [factor * row[key] for row in rows]
        for key, factor in (("fx_over_fz", 1), ("fx_over_fz_error", 2))
    )
    sinkage, sinkage_error = (
        [factor * row[key] for row in rows]
        for key, factor in (("sinkage_mm", 1), ("sinkage_error_mm", 2))
    )
    pull.errorbar(slips, force, force_error, label=f"{kind} computed", **look)
    sink.errorbar(slips, sinkage, sinkage_error, **look)
    from_mass = [row["sinkage_from_mass_mm"] for row in rows]
    sink.plot(slips, from_mass, ":", color=colour, label=f"{kind}, from the level of the mass")
