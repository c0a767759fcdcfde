# SPDX-License-Identifier: GPL-2.0-or-later
"""The matrix of tests on sand: a critical-state law, a cap law and grains, each with one parameter set."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from statistics import mean, stdev
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.evaluations import last_piece_of, pressure_near, steady_columns, whole_plate_curve
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_columns, read_rows
from furrow_post.figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from furrow_post.laboratory.evaluation import values_of
from furrow_post.read.laboratory import LaboratoryTest, cell_curve
from furrow_post.read.results import Results
from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import laboratory_case, point_case, script_case
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

HERE = Path(__file__).resolve().parent
INPUTS = HERE.parents[1]
CROSSCHECK = INPUTS / "crosscheck"
LAWS = {"norsand": "norsand_dry", "cap": "dry_sand_smooth"}
LEGEND = {"norsand": "NorSand", "cap": "cap law", "grains": "grains"}
GRAIN_DENSITY = 2650.0  # [kg/m3] of the ground sand_dry
# Name -> friction of the grains while they are packed, density [kg/m3] without load: mean of the packings
PACKINGS = {"dense": (0.02, 1674.0), "medium": (0.3, 1516.0), "loose": (1.0, 1426.0)}
SEEDS = (86028121, 67867967)
PRESSURES = (20e3, 100e3)  # [Pa] of triaxial compression
PRESSURE = 20e3  # [Pa] of the other tests
STRAINS = {"triaxial": 0.25, "extension": 0.2, "plane_strain": 0.2}
RATES = {"triaxial": 0.7, "extension": 0.5, "plane_strain": 0.5}  # [1/s] of the grains
SOFTENS = 0.0385  # lateral strain just before dense NorSand falls too steeply for a constant axial stress
LATE = 0.85  # of the strain, from which on the end is averaged
PRESSED = -0.003  # strain across a plane, about that of consolidation
SLIDING = 0.6  # shear strain of the law
AXIAL = (10e3, 100e3)  # [Pa] of the oedometer at which it is compared
STEPS = 400
PLATES = (0.06, 0.08, 0.10)  # [m]
BED = (0.30, 0.12)  # [m] width, depth
CELLS = {"plate": (0.01, 0.015), "wheel": (0.04, 0.05)}  # [m] fine, coarse
SINKAGES = (0.01, 0.02)  # [m]
NEAR = 1e-3  # [m] of sinkage around it that is averaged
WINDOW = 0.5  # [m] of travel
WHEEL: dict[str, tuple[dict[str, float], str]] = {  # -> variables, place in the results of the cross-check
    "slip 0": ({}, "base"),
    "slip 0.15": ({"slip": 0.15}, "slip=0.15"),
    "slip 0.3": ({"slip": 0.3}, "slip=0.3"),
    "half load": ({"load": 1560}, "load=1560"),
    "1.5 times the load": ({"load": 4680}, "load=4680"),
    "twice the speed": ({"speed": 2}, "speed=2"),
}  # fmt: skip
GOALS = {  # quantity -> allowed difference, and how it is measured
    "sin phi at peak": (0.10, "relative"),
    "sin phi at end": (0.10, "relative"),
    "shear over normal stress at peak": (0.10, "relative"),
    "the same at end": (0.10, "relative"),
    "K0": (0.05, "absolute"),
    "axial strain": (0.15, "relative"),
    "pressure": (0.20, "relative"),
    "hub drop": (0.03, "relative"),
    "resistance coefficient": (0.01, "absolute"),
}
FITTED = {  # what each law was fitted to
    "norsand": {("triaxial", packing) for packing in PACKINGS} | {("oedometer", "medium")},
    "cap": {(test, "medium") for test in ("triaxial", "extension", "plane strain", "oedometer")},
}
Key = tuple[str, str, str]  # test, at, quantity
Values = dict[Key, float]


def material_text(law: str, density: float) -> str:
    """One set of parameters; the density of the packing is the only change."""
    void_ratio = f", e0: {GRAIN_DENSITY / density - 1:.4f}" if law == "norsand" else ""
    base = INPUTS / "materials" / f"{LAWS[law]}.yaml"
    return f"title: {law}, {density:g} kg/m3\nbase: {base}\nlaw: {{density: {density:g}{void_ratio}}}\n"


def paths(law: str, packing: str) -> Iterator[tuple[str, str]]:
    """Name and path of each element test on a law."""
    alike = f"{{stress_xx: {-PRESSURE:g}, stress_yy: {-PRESSURE:g}, stress_zz: {-PRESSURE:g}}}"
    for pressure in PRESSURES:
        strain = STRAINS["triaxial"]
        path = f"{{type: triaxial, confinement: {pressure:g}, axial_strain: [{strain}], steps: {STEPS}}}"
        yield f"triaxial_{packing}_{pressure:.0f}", path
    sides = -(SOFTENS if (law, packing) == ("norsand", "dense") else STRAINS["extension"])
    rows = f"[{alike}, {{strain_xx: {sides}, strain_yy: {sides}}}]"
    yield f"extension_{packing}_{PRESSURE:.0f}", f"{{type: table, steps: {STEPS}, rows: {rows}}}"
    level = f"{{stress_xx: {-PRESSURE:g}, strain_yy: {PRESSED}, stress_zz: {-PRESSURE:g}}}"
    rows = f"[{level}, {{strain_zz: {-STRAINS['plane_strain']}}}]"
    yield f"plane_strain_{packing}_{PRESSURE:.0f}", f"{{type: table, steps: {STEPS}, rows: {rows}}}"
    rows = f"[{{stress_zz: {-PRESSURE:g}}}, {{strain_xz: {SLIDING}}}]"
    yield f"shear_{packing}_{PRESSURE:.0f}", f"{{type: table, motion: shear, steps: {STEPS}, rows: {rows}}}"
    yield f"oedometer_{packing}", f"{{type: confined, stress: [1e4, 1e5, 3e5], steps: {STEPS}}}"


def law_cases() -> Iterator[Case]:
    for law in LAWS:
        for packing, (_, density) in PACKINGS.items():
            files = {"material.yaml": material_text(law, density)}
            for name, path in paths(law, packing):
                case = point_case(f"{name}/{law}", law, Path("material.yaml"), path, stage="element")
                yield replace(case, files={**case.files, **files})


def laboratory_variables(packing: str, seed: int, **more: Any) -> dict[str, Any]:
    return {"ground": "sand_dry", "pour_friction": PACKINGS[packing][0], "seed": seed, "grains": 800, **more}


def grain_cases() -> Iterator[Case]:
    root = INPUTS.parent
    for packing in PACKINGS:
        for seed in SEEDS:
            for test, strain in STRAINS.items():
                for pressure in PRESSURES if test == "triaxial" else (PRESSURE,):
                    variables = laboratory_variables(
                        packing, seed, confinement=pressure, rate=RATES[test], strain=strain
                    )
                    name = f"{test}_{packing}_{pressure:.0f}/grains_{seed}"
                    yield laboratory_case(name, test, root, variables, stage="element")
            variables = laboratory_variables(packing, seed, confinement=PRESSURE, grains=1200)
            name = f"shear_{packing}_{PRESSURE:.0f}/grains_{seed}"
            yield laboratory_case(name, "shear", root, variables, stage="element")
            variables = laboratory_variables(packing, seed, stress=3e5, strain=0.16, rate=0.7)
            yield laboratory_case(f"oedometer_{packing}/grains_{seed}", "oedometer", root, variables, stage="element")
    width, depth = BED
    for size in PLATES:
        for seed in SEEDS:
            bed: dict[str, Value] = {"ground": "sand_dry", "seed": seed, "size": size, "speed": 0.1}
            bed |= {"width": width, "depth": depth}
            yield laboratory_case(f"plate_{size}/grains_{seed}", "plate", root, bed, stage="plate")


def body_cases() -> Iterator[Case]:
    """Plate and wheel on the laws, of medium density."""
    density = PACKINGS["medium"][1]
    for law in LAWS:
        files = {"material.yaml": material_text(law, density)}
        given: dict[str, Value] = {"here": CROSSCHECK, "material": f"{FOLDER}/material.yaml"}
        for size in PLATES:
            for cell in CELLS["plate"]:
                plate: dict[str, Value] = {"material": given["material"], "size": size, "cell": cell}
                plate |= {"width": BED[0], "depth": BED[1]}
                name = f"plate_{size}/{law}_{cell}"
                yield script_case(name, HERE / "plate.lig", plate, files=files, stage="plate")
        for number, (variables, _) in enumerate(WHEEL.values()):
            for cell in CELLS["wheel"]:
                wheel: dict[str, Value] = {**given, "cell": cell, **variables}
                name = f"wheel_{number}/{law}_{cell}"
                yield script_case(name, CROSSCHECK / "wheel_continuum.lig", wheel, files=files, stage="wheel")


def cases() -> list[Case]:
    return [*law_cases(), *grain_cases(), *body_cases()]


def strength_of_law(run: Run, driven: str) -> dict[str, float]:
    columns = last_piece_of(run.folder)
    stresses = np.array([-columns[f"stress_{axis}"] for axis in ("xx", "yy", "zz")])
    largest, smallest = stresses.max(axis=0), stresses.min(axis=0)
    sine = (largest - smallest) / np.maximum(largest + smallest, 1e-30)
    strain = -columns[driven]
    found = {"sin phi at peak": float(sine.max())}
    if strain[-1] > 2 * SOFTENS:
        found["sin phi at end"] = float(sine[strain > LATE * strain[-1]].mean())
    return found


def shear_of_law(run: Run) -> dict[str, float]:
    columns = last_piece_of(run.folder)
    ratio = np.abs(columns["stress_xz"] / columns["stress_zz"])
    sliding = np.abs(columns["strain_xz"])
    late = sliding > LATE * sliding[-1]
    return {"shear over normal stress at peak": float(ratio.max()), "the same at end": float(ratio[late].mean())}


def compression(axial: Floats, lateral: Floats, density: Floats) -> dict[str, float]:
    """K0 and axial strain at the stresses of AXIAL; all rows loading."""
    found = {}
    for stress in AXIAL:
        at = f", {stress / 1e3:.0f} kPa"
        found[f"K0{at}"] = float(np.interp(stress, axial, lateral / np.maximum(axial, 1e-30)))
        found[f"axial strain{at}"] = float(np.interp(stress, axial, np.log(density / density[0])))
    return found


def law_values(run: Run) -> dict[str, float]:
    test = run.name.partition("/")[0]
    if test.startswith("oedometer"):
        columns = read_columns(run.folder / "point.csv")
        return compression(-columns["stress_zz"], -columns["stress_xx"], columns["density"])
    if test.startswith("shear"):
        return shear_of_law(run)
    return strength_of_law(run, "strain_xx" if test.startswith("extension") else "strain_zz")


def grain_values(run: Run) -> dict[str, float]:
    test = LaboratoryTest(run.folder)
    if run.name.startswith("oedometer"):
        _, stress, density = cell_curve(test.curve())
        loading = slice(0, int(np.argmax(stress[:, 2])) + 1)
        axial = np.maximum.accumulate(stress[loading, 2])
        return compression(axial, stress[loading, :2].mean(axis=1), density[loading])
    found = values_of(test)
    if run.name.startswith("shear"):
        normal = found["normal_stress"]
        return {
            "shear over normal stress at peak": found["peak_shear"] / normal,
            "the same at end": found["residual_shear"] / normal,
        }
    sines = (math.sin(math.radians(found[f"friction_angle_{name}"])) for name in ("peak", "end"))
    return dict(zip(("sin phi at peak", "sin phi at end"), sines))


def element_key(run: Run, quantity: str) -> Key:
    """Of "triaxial_dense_20000/norsand" and "sin phi at peak", or "oedometer_dense/norsand" and
    "K0, 10 kPa"."""
    words = run.name.partition("/")[0].split("_")
    quantity, _, level = quantity.partition(", ")
    level = level or f"{float(words.pop()) / 1e3:.0f} kPa"
    return " ".join(words[:-1]), f"{words[-1]}, {level}", quantity


def plate_values(run: Run) -> Iterator[tuple[Key, float]]:
    size = float(run.name.partition("/")[0].partition("_")[2])
    curve = whole_plate_curve(run.folder)
    for sinkage in SINKAGES:
        yield ("plate", f"{1e3 * size:.0f} mm at {1e3 * sinkage:.0f} mm", "pressure"), pressure_near(curve, sinkage, NEAR)


def wheel_values(run: Run) -> Iterator[tuple[Key, float]]:
    at = list(WHEEL)[int(run.name.partition("/")[0].partition("_")[2])]
    means = steady_columns(Results(run.folder).columns, WINDOW)
    yield ("wheel", at, "hub drop"), means["sinkage_m"]
    yield ("wheel", at, "resistance coefficient"), means["resistance"]


def wheel_of_grains() -> Iterator[tuple[Key, float, float]]:
    """Values of the cross-check for fine grains, with their standard errors."""
    rows = {
        (row["place"], row["quantity"]): row
        for row in read_rows(CROSSCHECK / "results.csv")
        if (row["case"], row["source"], row["kind"]) == ("wheel_on_sand", "grains", "best estimate")
    }
    for at, (_, place) in WHEEL.items():
        for name, quantity in (("sinkage", "hub drop"), ("coefficient", "resistance coefficient")):
            row = rows[place, name]
            parts = (float(row[f"error_{part}"]) for part in ("time", "size", "domain", "packing"))
            yield ("wheel", at, quantity), float(row["value"]), math.hypot(*parts)


def relative(off: float, value: float, kind: str) -> float:
    return off / value if kind == "relative" else off


def verdict(off: float, error: float, goal: float) -> str:
    """Of law and grains: missed where two errors do not explain it, met where the error is small."""
    if abs(off) > goal + 2 * error:
        return "missed"
    return "met" if abs(off) <= goal and error <= goal else "inconclusive"


def matrix(
    laws: Mapping[str, Values], coarse: Mapping[str, Values], grains: Mapping[Key, tuple[float, float]]
) -> list[dict[str, Any]]:
    rows = []
    for key in dict.fromkeys(key for values in laws.values() for key in values):
        test, at, quantity = key
        goal, kind = GOALS[quantity]
        value, error = grains.get(key, (math.nan, math.nan))
        row: dict[str, Any] = {"test": test, "at": at, "quantity": quantity}
        found = {law: laws[law].get(key, math.nan) for law in LAWS}
        errors = {law: abs(found[law] - coarse[law].get(key, found[law])) for law in LAWS}
        for law in LAWS:
            row |= {law: f"{found[law]:.4g}", f"{law}_error": f"{errors[law]:.2g}"}
        row |= {"grains": f"{value:.4g}", "grains_error": f"{error:.2g}", "goal": goal, "kind": kind}
        for law in LAWS:
            row[f"{law}_label"] = "fitted" if (test, at.partition(",")[0]) in FITTED[law] else "known"
        for law in LAWS:
            off = relative(found[law] - value, value, kind)
            share = relative(math.hypot(error, errors[law]), value, kind)
            row[f"{law}_off"] = "" if math.isnan(off) else round(off, 3)
            row[f"{law}_verdict"] = "" if math.isnan(off) else verdict(off, share, goal)
        rows.append(row)
    return rows


def mean_of_packings(values: Sequence[float]) -> tuple[float, float]:
    """Mean and its standard error; NaN of one packing alone."""
    return mean(values), stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def draw(rows: Sequence[Mapping[str, Any]], target: Path) -> None:
    use_style()
    figure, grid = plt.subplots(1, 3, figsize=(10.5, 3.6), layout="constrained")
    columns = dict(zip((*LAWS, "grains"), RUN_COLOURS))
    panels = (
        ("triaxial", "sin phi at peak", "triaxial: sin φ at the peak, 20 kPa", ", 20 kPa"),
        ("plate", "pressure", "pressure of a plate at 20 mm, Pa", " at 20 mm"),
        ("wheel", "hub drop", "hub drop of the wheel, m", ""),
    )
    for axes, (test, quantity, text, level), letter in zip(grid, panels, panel_letters()):
        chosen = [r for r in rows if (r["test"], r["quantity"]) == (test, quantity) and r["at"].endswith(level)]
        places = np.arange(len(chosen))
        for k, (column, colour) in enumerate(columns.items()):
            values = [float(row[column]) for row in chosen]
            if not np.isfinite(values).any():  # not run
                continue
            errors = [float(row[f"{column}_error"]) for row in chosen]
            axes.errorbar(places + 0.12 * (k - 1), values, errors, fmt="o", color=colour, label=LEGEND[column])
        names = [row["at"].removesuffix(level) for row in chosen]
        axes.set_xticks(places, names, rotation=30 if test == "wheel" else 0, ha="right" if test == "wheel" else "center")
        axes.set_ylim(bottom=0)
        annotate_panel(axes, letter, text)
    if grid[0].has_data():
        grid[0].legend(loc="lower left")
    save(figure, target, dpi=110)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    laws: dict[str, Values] = {law: {} for law in LAWS}
    coarse: dict[str, Values] = {law: {} for law in LAWS}
    packings: dict[Key, list[float]] = {}
    for run in runs.done("element"):
        column = run.name.partition("/")[2]
        if column in LAWS:
            laws[column] |= {element_key(run, name): value for name, value in law_values(run).items()}
            continue
        for name, value in grain_values(run).items():
            packings.setdefault(element_key(run, name), []).append(value)
    for run in runs.done("plate", "wheel"):
        column, _, cell = run.name.partition("/")[2].partition("_")
        for key, value in plate_values(run) if run.case.stage == "plate" else wheel_values(run):
            if column == "grains":
                packings.setdefault(key, []).append(value)
            else:
                (laws if float(cell) == CELLS[key[0]][0] else coarse)[column][key] = value
    grains = {key: mean_of_packings(values) for key, values in packings.items()}
    grains |= {key: (value, error) for key, value, error in wheel_of_grains()}
    rows = matrix(laws, coarse, grains)
    output.table("results.csv", rows)
    draw(rows, output.path("matrix.png"))
    return []
