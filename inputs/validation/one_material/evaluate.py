# SPDX-License-Identifier: GPL-2.0-or-later
"""The matrix of tests and materials: two laws, friction that slip mobilises, grains, measurements."""

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.empirical import snow_traction
from furrow_post.analyse.evaluations import (
    fine_grains,
    last_piece_of,
    path_states,
    pressure_near,
    steady_columns,
    whole_plate_curve,
)
from furrow_post.csv_table import read_rows
from furrow_post.figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from furrow_post.read.laboratory import LaboratoryTest, cell_curve
from furrow_post.read.results import Results
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

HERE = Path(__file__).resolve().parent
# End of a run's name -> legend. 4 cm: slip length of the contact with the wheel
LAWS = {"snow": "snow", "clay": "Cam clay", "snow4cm": "snow, 4 cm", "clay4cm": "Cam clay, 4 cm"}
GRAINS = "grains"  # the same of runs on clusters, whose names go on with "/diameter_seed"
STRESSES = (10, 50, 100, 200, 500, 1000)  # [kPa] of the oedometer
PRESSURES = (2, 10, 30)  # [kPa] from all sides
STEPS, STRAIN = 200, 0.2
SINKAGES = (25, 50, 100, 228)  # [mm]
NEAR = 2.5  # [mm] of sinkage around it that is averaged
MODES = {"towed": "towed", "slip_0": "slip 0", "slip_10": "slip 0.1", "slip_30": "slip 0.3", "slip_60": "slip 0.6"}
WINDOW, WINDOW_ON_GRAINS = 0.5, 2.0  # [m] of travel; single grains make the forces scatter
LOAD, RADIUS, WIDTH = 6237.0, 0.37, 0.272  # [N], [m] of the wheel
TYRE_LOAD, TYRE_RADIUS = 6227.0, 0.3483  # [N], [m]
TYRE_AREA = 0.03645  # [m2] on a hard surface at 179 kPa [Shoop2001] Table 6
MEASURED_SNOW = 220.0  # [kg/m3] of the field tests that the stage field repeats
Key = tuple[str, str, str]  # test, at, quantity
Values = dict[Key, float]
Row = Mapping[str, Any]


def subject(name: str) -> str:
    """Of a run: "slip_10_grains" of "slip_10_grains/0.05_86028121"."""
    return name.partition("/")[0]


def oedometer(run: Run) -> Values:
    found: Values = {}
    for state, stress in zip(path_states(run.folder, STEPS, len(STRESSES)), STRESSES):
        found["oedometer", f"{stress} kPa", "density"] = state["density"]
        found["oedometer", f"{stress} kPa", "K0"] = state["stress_xx"] / state["stress_zz"]
    return found


def hydrostatic(run: Run) -> Values:
    states = path_states(run.folder, STEPS, len(PRESSURES))
    return {("all-round", f"{p} kPa", "density"): state["density"] for state, p in zip(states, PRESSURES)}


def triaxial(run: Run) -> Values:
    piece = last_piece_of(run.folder)
    deviator = float(piece["stress_xx"][-1] - piece["stress_zz"][-1])
    return {("triaxial", "600 Pa", "deviator at 0.2"): deviator}


def density_of(run: Run) -> str:
    return f"{run.name.split('_')[1]} kg/m3"


def shear(run: Run) -> Values:
    return {("shear", density_of(run), "strength"): float(np.abs(last_piece_of(run.folder)["stress_xz"]).max())}


def free_sides(run: Run) -> Values:
    piece = last_piece_of(run.folder)
    axial = piece["strain_zz"][0] - piece["strain_zz"]
    lateral = piece["strain_xx"] - piece["strain_xx"][0]
    end = min(STRAIN, float(axial.max()))
    return {
        ("free sides", density_of(run), "stress at 0.2"): float(np.interp(end, axial, -piece["stress_zz"])),
        ("free sides", density_of(run), "lateral strain ratio"): float(np.interp(end, axial, lateral)) / end,
    }


def tension(run: Run) -> Values:
    return {("tension", density_of(run), "strength"): float(last_piece_of(run.folder)["stress_zz"].max())}


def plate(run: Run) -> Values:
    curve = whole_plate_curve(run.folder)
    return {("plate", f"{mm} mm", "pressure"): pressure_near(curve, 1e-3 * mm, 1e-3 * NEAR) for mm in SINKAGES}


def wheel(run: Run, test: str = "wheel") -> Values:
    history = Results(run.folder).columns
    mode, _, ground = subject(run.name).removeprefix("tyre_").rpartition("_")
    window, at = WINDOW_ON_GRAINS if ground == GRAINS else WINDOW, MODES[mode]
    means = steady_columns(history, window)
    x = history["x"] - history["x"][0]
    found: Values = {
        (test, at, "hub drop"): means["sinkage_m"],
        (test, at, "traction"): -means["resistance"],
    }
    if at != "towed":
        found[test, at, "torque"] = float(history["drive_torque"][x > x[-1] - window].mean())
    return found


def tyre(run: Run) -> Values:
    return wheel(run, "tyre")


def cell_of_grains(run: Run) -> Values:
    """Triaxial compression, or where it starts: pressed from all sides."""
    strain, stress, density = cell_curve(LaboratoryTest(run.folder).curve())
    confinement = run.number("confinement")
    if run.number("strain") < STRAIN:
        return {("all-round", f"{1e-3 * confinement:.0f} kPa", "density"): float(density[0])}
    near = np.abs(strain[:, 2] - STRAIN) < 0.05 * STRAIN
    deviator = stress[near, 2] - 0.5 * (stress[near, 0] + stress[near, 1])
    return {("triaxial", f"{confinement:.0f} Pa", "deviator at 0.2"): float(deviator.mean())}


def field_tests(runs: Sequence[Run]) -> list[dict[str, Any]]:
    """The towed tyre by every law, a row for each test in snow of this density."""
    means = {}
    for run in runs:
        law = run.name.rpartition("_")[2]
        means[law, run.number("depth")] = steady_columns(Results(run.folder).columns, WINDOW)
    laws = dict.fromkeys(law for law, _ in means)
    rows = []
    for test in read_rows(HERE.parent / "snow_wheel" / "reference.csv"):
        depth = float(test["depth_m"])
        if float(test["density_kgm3"]) != MEASURED_SNOW or any((law, depth) not in means for law in laws):
            continue
        row: dict[str, Any] = {name: test[name] for name in ("row", "depth_m", "sinkage_m", "resistance")}
        for law in laws:
            row |= {f"{law}_{name}": means[law, depth][name] for name in ("sinkage_m", "resistance")}
        rows.append(row)
    return rows


def field_errors(rows: Sequence[Row], law: str) -> Values:
    """Root mean squares over the tests."""
    found: Values = {}
    for name, quantity in (("sinkage_m", "rms of hub drop"), ("resistance", "rms of traction")):
        if rows and f"{law}_{name}" in rows[0]:
            off = np.array([float(row[f"{law}_{name}"]) - float(row[name]) for row in rows])
            found["tyre", f"{MEASURED_SNOW:.0f} kg/m3", quantity] = float(np.sqrt(np.mean(off**2)))
    return found


def choice_row(run: Run) -> dict[str, Any]:
    """A towed wheel or tyre on another reading of the tests."""
    means = steady_columns(Results(run.folder).columns, WINDOW)
    row: dict[str, Any] = {"run": run.name, "what": run.what or "`snow`"}
    return row | {name: means[name] for name in ("sinkage_m", "resistance")}


EVALUATIONS: dict[str, Callable[[Run], Values]] = {
    "oedometer": oedometer,
    "hydrostatic": hydrostatic,
    "triaxial": triaxial,
    "shear": shear,
    "unconfined": free_sides,
    "tension": tension,
    "plate": plate,
    "wheel": wheel,
    "wheel_clay": wheel,
    "wheel_mobilised": wheel,
    "tyre": tyre,
    "wheel_grains": wheel,
    "tyre_grains": tyre,
    "plate_grains": plate,
    "cell_grains": cell_of_grains,
}


def values_of_runs(runs: Runs, tests: Sequence[Row]) -> list[dict[str, Any]]:
    """A row for each run and value; the runs of the field tests have one together for each law."""
    found = [(run.name, EVALUATIONS[stage](run)) for stage in EVALUATIONS for run in runs.done(stage)]
    found += [(f"field_{law}", field_errors(tests, law)) for law in LAWS]
    return [
        {"run": name, "test": test, "at": at, "quantity": quantity, "value": f"{value:.6g}"}
        for name, values in found
        for (test, at, quantity), value in values.items()
    ]


def values_of_laws(rows: Sequence[Row]) -> dict[str, Values]:
    laws: dict[str, Values] = {law: {} for law in LAWS}
    for row in rows:
        if (law := str(row["run"]).rpartition("_")[2]) in laws:
            laws[law][row["test"], row["at"], row["quantity"]] = float(row["value"])
    return laws


def values_of_grains(rows: Sequence[Row]) -> dict[Key, tuple[float, float]]:
    """Means of the packings of the finest clusters, with their errors."""
    found: dict[Key, dict[str, list[float]]] = {}  # -> diameter -> packings
    for row in rows:
        name, _, packing = str(row["run"]).partition("/")
        if name.endswith(f"_{GRAINS}"):
            sizes = found.setdefault((row["test"], row["at"], row["quantity"]), {})
            sizes.setdefault(packing.partition("_")[0], []).append(float(row["value"]))
    return {key: fine_grains(sizes) for key, sizes in found.items()}


def references(grains: Mapping[Key, tuple[float, float]]) -> list[dict[str, str]]:
    """The rows of reference.csv; grains have their own values where it has none."""
    rows = read_rows(HERE / "reference.csv")
    for row in rows:
        key = row["test"], row["at"], row["quantity"]
        if key in grains and not row[GRAINS]:
            row[GRAINS], row[f"{GRAINS}_error"] = (f"{value:.4g}" for value in grains[key])
    return rows


def rounded(value: float) -> float:
    """Four digits."""
    return float(f"{value:.4g}") if math.isfinite(value) else value


def number(text: str) -> float:
    return float(text) if text else math.nan


def measured_range(row: Mapping[str, str]) -> tuple[float, float]:
    """Least and largest measured value, the same where there is one; NaN where there is none."""
    return number(row["measured"]), number(row["measured_to"] or row["measured"])


def distance(value: float, row: dict[str, str]) -> float:
    """From the grains, else from the measurement or its range, in the measure of the goal."""
    low = number(row["grains"])
    high = low
    if math.isnan(low):
        low, high = measured_range(row)
    if math.isnan(low):
        return low
    off = value - min(max(value, low), high)
    if row["kind"] == "relative":
        return off / low
    return off / (LOAD * RADIUS) if row["kind"] == "load" else off


def verdict(value: float, row: dict[str, str]) -> str:
    if math.isnan(value):
        return ""
    off = distance(value, row)
    return "" if math.isnan(off) else ("met" if abs(off) <= float(row["goal"]) else "missed")


def matrix(laws: dict[str, Values], beside: Sequence[dict[str, str]]) -> list[dict[str, Any]]:
    rows = []
    for reference in beside:
        key: Key = (reference["test"], reference["at"], reference["quantity"])
        row: dict[str, Any] = {name: reference[name] for name in ("test", "at", "quantity", "unit")}
        for law, values in laws.items():
            row[law] = rounded(values[key]) if key in values else ""
        row |= {name: reference[name] for name in ("grains", "grains_error", "measured", "measured_to")}
        row |= {name: reference[name] for name in ("goal", "kind", "label")}
        for law, values in laws.items():
            value = values.get(key, math.nan)
            off = distance(value, reference)
            row[f"{law}_off"] = "" if math.isnan(off) else round(off, 3)
            row[f"{law}_verdict"] = verdict(value, reference)
        rows.append(row)
    return rows


def traction(rows: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Torque over radius and load, from rows of the matrix, and the formula for the traction of
    vehicles. Its contact pressure is the load over the arc of the wheel that touches the snow of the
    first law, or over the area of the tyre on a hard surface."""
    found = {(row["test"], row["at"], row["quantity"]): row for row in rows}
    table = []
    for test, load, radius in (("wheel", LOAD, RADIUS), ("tyre", TYRE_LOAD, TYRE_RADIUS)):
        for at in ("slip 0.1", "slip 0.3", "slip 0.6"):
            torque, drop = (found.get((test, at, quantity)) for quantity in ("torque", "hub drop"))
            depth = number(str(drop[next(iter(LAWS))])) if drop else math.nan
            if torque is None or math.isnan(depth):  # not run
                continue
            row: dict[str, Any] = {"test": test, "at": at, "label": "known"}
            for name in (*LAWS, "grains"):
                value = number(str(torque[name]))
                row[name] = "" if math.isnan(value) else round(value / (load * radius), 3)
            area = TYRE_AREA if test == "tyre" else WIDTH * radius * math.acos(1 - depth / radius)
            row["formula"] = round(snow_traction("undisturbed", load, area).coefficient, 3)
            table.append(row)
    return table


def position(at: str) -> float:
    return float(next(word for word in at.split() if word.replace(".", "").isdigit()))


def draw(laws: dict[str, Values], beside: Sequence[dict[str, str]], target: Path) -> None:
    use_style()
    figure, grid = plt.subplots(2, 2, figsize=(8.4, 6.4), layout="constrained")
    panels = (
        ("shear", "strength", 1e-3, "density, kg/m³", "shear strength, kPa"),
        ("oedometer", "K0", 1.0, "axial stress, kPa", "K0"),
        ("plate", "pressure", 1e-3, "sinkage, mm", "pressure of the plate, kPa"),
        ("wheel", "torque", 1.0, "slip", "torque of the wheel, N m"),
    )
    for axes, (test, quantity, scale, x_label, text), letter in zip(grid.flat, panels, panel_letters()):
        for (law, values), colour in zip(laws.items(), RUN_COLOURS):
            found = [(position(at), scale * v) for (t, at, q), v in values.items() if (t, q) == (test, quantity)]
            if found:
                axes.plot(*zip(*sorted(found)), "o-", color=colour, label=LAWS[law])
        shown = [row for row in beside if (row["test"], row["quantity"]) == (test, quantity)]
        points = [[scale * number(row[name]) for row in shown] for name in (GRAINS, f"{GRAINS}_error")]
        places = [position(row["at"]) for row in shown]
        axes.errorbar(places, points[0], np.nan_to_num(points[1]), fmt="s", color=RUN_COLOURS[4], label="grains")
        ranges = [(position(row["at"]), *measured_range(row)) for row in shown if row["measured"]]
        if ranges:
            place, low, high = np.array(ranges).T
            middle, half = scale * (low + high) / 2, scale * (high - low) / 2
            axes.errorbar(place, middle, half, fmt="*", color="0.5", lw=4, alpha=0.7, label="measured")
        axes.set(xlabel=x_label)
        annotate_panel(axes, letter, text)
    grid[0, 0].set(yscale="log")
    grid[0, 1].set(xscale="log", ylim=(0, 0.5))
    grid[1, 0].set(ylim=(0, None))
    for axes in grid.flat:
        axes.legend()
    save(figure, target, dpi=110)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    tests = field_tests(runs.done("field"))
    output.table("tyre_tests.csv", tests)
    values = values_of_runs(runs, tests)
    output.table("values.csv", values)
    known = output.known("values.csv", values)
    laws, beside = values_of_laws(known), references(values_of_grains(known))
    rows = matrix(laws, beside)
    output.table(output.of_all_runs("results.csv"), rows)
    output.table(output.of_all_runs("traction.csv"), traction(rows))
    output.table("choices.csv", [choice_row(run) for run in runs.done("choices", "towed_snow")])
    field = runs.done("field_choices", "field_20cm_*")
    output.table("field_choices.csv", [choice_row(run) for run in field])
    draw(laws, beside, output.path(output.of_all_runs("matrix.png")))
    return []
