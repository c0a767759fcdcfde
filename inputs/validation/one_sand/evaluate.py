# SPDX-License-Identifier: GPL-2.0-or-later
"""The matrix of tests on sand: a critical-state law, a cap law and grains, each with one parameter set."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.evaluations import (
    fine_grains,
    last_piece_of,
    mean_of_packings,
    pressure_near,
    steady_columns,
    whole_plate_curve,
)
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_columns, read_rows
from furrow_post.figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from furrow_post.laboratory.deposit import outer_radius, slope_angle
from furrow_post.laboratory.evaluation import values_of
from furrow_post.read.laboratory import LaboratoryTest, cell_curve
from furrow_post.read.results import Results
from furrow_post.read.soil_card import Cone, read_card
from furrow_post.read.terrain import Terrain
from furrow_post.soil.fits import cone_index
from furrow_post.soil.instruments import cone_curve, read_curve
from furrow_post.run.case import FOLDER, Case, Value, laboratory_case, point_case, script_case
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
PRESSURES = (2e3, 5e3, 20e3, 100e3)  # [Pa] of triaxial compression
PRESSURE = 20e3  # [Pa] of the other tests
STRAINS = {"triaxial": 0.25, "extension": 0.2, "plane_strain": 0.2}
RATES = {"triaxial": 0.7, "extension": 0.5, "plane_strain": 0.5}  # [1/s] of the grains from PRESSURE on
SOFTENS = 0.0385  # lateral strain just before dense NorSand falls too steeply for a constant axial stress
LEVELS = (0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.14, 0.18, 0.22)  # axial strains of triaxial compression that laws are fitted to
STRESSES = (2e3, 5e3, 10e3, 20e3, 50e3, 100e3, 200e3)  # [Pa] axial stresses of the oedometer, for the same
AROUND = 0.15  # of a level, whose mean is taken
LATE = 0.85  # of the strain, from which on the end is averaged
PRESSED = -0.003  # strain across a plane, about that of consolidation
SETTLED = -0.002  # strain in which preloaded loose sand gives way and is denser
SLIDING = 0.6  # shear strain of the law
AXIAL = (10e3, 100e3)  # [Pa] of the oedometer at which it is compared
STEPS = 400
PLATES = (0.06, 0.08, 0.10)  # [m]
BED = (0.30, 0.12)  # [m] width, depth
CELLS: dict[str, tuple[float, float]] = {  # [m] fine, coarse; of the cone: across its base
    "plate": (0.01, 0.015),
    "cone": (4, 3),
    "collapse": (0.01, 0.015),
    "wheel": (0.03, 0.04),
}
SINKAGES = (0.01, 0.02)  # [m]
CONE = 0.08  # [m] base, to which depth it goes; as the widest one of the card of the grains
CONE_AT = f"{1e3 * CONE:.0f} mm wide"
COLUMNS = {1: 0.42, 2: 0.60}  # height over radius of a column -> length of the layer [m]
COLUMN_RADIUS, LAYER, MAP_STEP = 0.08, 0.03, 0.005  # [m]
THIN = 0.005  # [m], half a grain: the deposit ends where it is thinner
RING = 0.01  # [m] width of the rings of its profile
NEAR = 1e-3  # [m] of sinkage around it that is averaged
WINDOW = 0.5  # [m] of travel
WHEEL: dict[str, tuple[dict[str, float], str]] = {  # -> variables, place in the results of the cross-check
    "slip 0": ({}, "base"),
    "slip 0.15": ({"slip": 0.15}, "slip=0.15"),
    "slip 0.3": ({"slip": 0.3, "stiffness": 1}, "slip=0.3"),  # NorSand is soft where it has opened
    "half load": ({"load": 1560}, "load=1560"),
    "1.5 times the load": ({"load": 4680}, "load=4680"),
    "twice the speed": ({"speed": 2}, "speed=2"),
}  # fmt: skip
ANGLE = 15  # [degrees] of slip of the whole wheel
ANGLE_AT = f"slip angle {ANGLE} degrees"
ANGLE_GRAINS = {0.03: SEEDS, 0.04: SEEDS}  # [m] -> packings
ANGLED: dict[str, Value] = {"slip_angle": ANGLE, "distance": 0.8}  # [degree], [m]
GOALS = {  # quantity -> allowed difference, and how it is measured
    "sin phi at peak": (0.10, "relative"),
    "sin phi at end": (0.10, "relative"),
    "shear over normal stress at peak": (0.10, "relative"),
    "the same at end": (0.10, "relative"),
    "K0": (0.05, "absolute"),
    "axial strain": (0.15, "relative"),
    "pressure": (0.20, "relative"),
    "index": (0.20, "relative"),
    "run-out over height": (0.20, "relative"),
    "height over radius": (0.20, "relative"),
    "slope": (0.10, "relative"),
    "hub drop": (0.03, "relative"),
    "lateral force over load": (0.15, "relative"),
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
    rows = f"[{{strain_zz: {SETTLED}}}, {{stress_zz: {-PRESSURE:g}}}, {{strain_xz: {SLIDING}}}]"
    yield f"shear_{packing}_{PRESSURE:.0f}", f"{{type: table, motion: shear, steps: {STEPS}, rows: {rows}}}"
    rows = f"[{{strain_zz: {SETTLED}}}, {{stress_zz: -1e4}}, {{stress_zz: -1e5}}, {{stress_zz: -3e5}}]"
    yield f"oedometer_{packing}", f"{{type: table, steps: {STEPS}, rows: {rows}}}"


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
                    slow = min(1.0, math.sqrt(pressure / PRESSURE))  # the same inertial number
                    variables = laboratory_variables(
                        packing, seed, confinement=pressure, rate=round(RATES[test] * slow, 3), strain=strain
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
    for aspect in COLUMNS:
        for seed in SEEDS:
            pile: dict[str, Value] = {"ground": "sand_dry", "seed": seed, "aspect": aspect}
            yield laboratory_case(f"collapse_{aspect}/grains_{seed}", "collapse", root, pile, stage="collapse")


def heightmap(length: float, height: float) -> str:
    """A cylinder on level ground, as ESRI ASCII grid."""
    count = round(length / MAP_STEP) + 1
    places = (np.arange(count) - (count - 1) / 2) * MAP_STEP
    corner = f"xllcenter {places[0]:g}\nyllcenter {places[0]:g}\n"
    heights = np.where(np.hypot(*np.meshgrid(places, places)) < COLUMN_RADIUS, height, 0.0)
    rows = "\n".join(" ".join(f"{value:g}" for value in row) for row in heights)
    return f"ncols {count}\nnrows {count}\n{corner}cellsize {MAP_STEP}\n{rows}\n"


def body_cases() -> Iterator[Case]:
    """Plate, column and wheel on the laws, of medium density."""
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
        for cells in CELLS["cone"]:
            cone: dict[str, Value] = {"material": given["material"], "size": CONE, "depth_of_base": CONE}
            cone |= {"cells": cells, "speed": 0.4}
            script = INPUTS / "soils" / "instruments" / "cone.lig"
            yield script_case(f"cone/{law}_{cells}", script, cone, files=files, stage="cone")
        for aspect, length in COLUMNS.items():
            for cell in CELLS["collapse"]:
                height = aspect * COLUMN_RADIUS
                column: dict[str, Value] = {"material": given["material"], "column": f"{FOLDER}/column.txt"}
                column |= {"cell": cell, "length": length, "depth": LAYER, "height": height}
                column |= {"time": round(8 * math.sqrt(height / 9.81), 2)}
                texts = {**files, "column.txt": heightmap(length, height)}
                name = f"collapse_{aspect}/{law}_{cell}"
                yield script_case(name, HERE / "collapse.lig", column, files=texts, stage="collapse")
        for number, (variables, _) in enumerate(WHEEL.values()):
            for cell in CELLS["wheel"]:
                wheel: dict[str, Value] = {**given, "cell": cell, **variables}
                name = f"wheel_{number}/{law}_{cell}"
                yield script_case(name, CROSSCHECK / "wheel_continuum.lig", wheel, files=files, stage="wheel")
        for cell in CELLS["wheel"]:
            turned: dict[str, Value] = {**given, **ANGLED, "cell": cell, "symmetry": "no"}
            yield script_case(f"angle/{law}_{cell}", CROSSCHECK / "wheel_continuum.lig", turned, files=files, stage="angle")


def angle_of_grains_cases() -> Iterator[Case]:
    for size, seeds in ANGLE_GRAINS.items():
        for seed in seeds:
            turned: dict[str, Value] = {"here": CROSSCHECK, **ANGLED, "diameter": size, "seed": seed}
            yield script_case(f"angle/grains_{size}_{seed}", CROSSCHECK / "wheel_sand_grains.lig", turned, stage="angle")


def cases() -> list[Case]:
    return [*law_cases(), *grain_cases(), *body_cases(), *angle_of_grains_cases()]


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
        axial = np.maximum.accumulate(-columns["stress_zz"])
        return compression(axial, -columns["stress_xx"], columns["density"])
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


def triaxial_curve(run: Run) -> tuple[Floats, Floats]:
    """(levels) q/p and void ratio of grains at LEVELS."""
    strain, stress, density = cell_curve(LaboratoryTest(run.folder).curve())
    axial, q = strain[:, 2] - strain[0, 2], stress[:, 2] - stress[:, :2].mean(axis=1)
    ratio = q / stress.mean(axis=1)
    near = [abs(axial - level) < AROUND * level for level in LEVELS]
    voids = GRAIN_DENSITY / density - 1
    return np.array([ratio[rows].mean() for rows in near]), np.array([voids[rows].mean() for rows in near])


def oedometer_curve(run: Run) -> tuple[Floats, Floats]:
    """(stresses) p [Pa] and void ratio of grains at STRESSES."""
    _, stress, density = cell_curve(LaboratoryTest(run.folder).curve())
    loading = slice(0, int(np.argmax(stress[:, 2])) + 1)
    axial = np.maximum.accumulate(stress[loading, 2])
    p = np.interp(STRESSES, axial, stress[loading].mean(axis=1))
    return p, np.interp(STRESSES, axial, GRAIN_DENSITY / density[loading] - 1)


def curves_of_grains(runs: Runs, test: str) -> list[dict[str, str]]:
    """What laws are fitted to: means over the packings. Columns: strain or stress of the axis, then q/p
    or p, and the void ratio, of each packing and lateral stress."""
    axis, first, curve = {
        "triaxial": (("axial_strain", LEVELS), "stress_ratio", triaxial_curve),
        "oedometer": (("axial_stress_Pa", STRESSES), "p_Pa", oedometer_curve),
    }[test]
    found: dict[str, list[tuple[Floats, Floats]]] = {}
    for run in runs.done("element"):
        name, _, column = run.name.partition("/")
        if name.startswith(test) and column.startswith("grains"):
            found.setdefault(name.removeprefix(f"{test}_"), []).append(curve(run))
    rows = [{axis[0]: f"{level:g}"} for level in axis[1]]
    for name, packings in found.items():
        for quantity, values in zip((first, "void_ratio"), np.mean(packings, axis=0)):
            for row, value in zip(rows, values):
                row[f"{quantity}_{name}"] = f"{value:.4g}"
    return rows


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


def cone_values(run: Run) -> Iterator[tuple[Key, float]]:
    curve = cone_curve(read_curve(run.folder), CONE).down_to(CONE)
    yield ("cone", CONE_AT, "index"), cone_index(curve).index.value


def cone_of_grains() -> Iterator[tuple[Key, float, float]]:
    """Of their soil card."""
    cone = read_card(INPUTS / "soils" / "sand_dry.yaml").cone
    if isinstance(cone, Cone) and math.isclose(cone.size, CONE):
        yield ("cone", CONE_AT, "index"), cone.index.value, cone.index.error


def deposit_of_law(run: Run) -> dict[str, float]:
    """Of a column: distance from its edge to where the deposit is thin, height of its middle, and slope [degrees]."""
    terrain = Terrain.read(run.folder)
    aspect = int(run.name.partition("/")[0].partition("_")[2])
    edges = np.arange(0.0, COLUMNS[aspect] / 2, RING)
    radius = np.hypot(terrain.x[:, 0], terrain.x[:, 1])
    volume = np.histogram(radius, edges, weights=terrain.volume)[0]
    thickness = volume / (np.pi * np.diff(edges**2)) - LAYER
    runout = outer_radius(thickness, edges, THIN) - COLUMN_RADIUS
    middle = volume[:2].sum() / (np.pi * edges[2] ** 2) - LAYER
    return {
        "run-out over height": runout / (aspect * COLUMN_RADIUS),
        "height over radius": middle / COLUMN_RADIUS,
        "slope": slope_angle(thickness, edges)[0],
    }


def collapse_values(run: Run) -> Iterator[tuple[Key, float]]:
    name, _, column = run.name.partition("/")
    at = f"height {name.partition('_')[2]} radii"
    if column.startswith("grains"):
        found = values_of(LaboratoryTest(run.folder))
        values = {"run-out over height": found["runout"] / found["aspect"], "height over radius": found["height_over_r0"]}
        values["slope"] = found["slope"]
    else:
        values = deposit_of_law(run)
    for quantity, value in values.items():
        yield ("collapse", at, quantity), value


def wheel_values(run: Run) -> Iterator[tuple[Key, float]]:
    angled = run.case.stage == "angle"
    at = ANGLE_AT if angled else list(WHEEL)[int(run.name.partition("/")[0].partition("_")[2])]
    columns = Results(run.folder).columns
    means = steady_columns(columns, WINDOW)
    yield ("wheel", at, "hub drop"), means["sinkage_m"]
    yield ("wheel", at, "resistance coefficient"), means["resistance"]
    if angled:
        last = columns["x"] > columns["x"][-1] - WINDOW
        side = abs(float((columns["lateral_force"][last] / columns["load"][last]).mean()))
        yield ("wheel", at, "lateral force over load"), side


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
    sizes: dict[Key, dict[str, list[float]]] = {}  # of grains at the slip angle -> values of the packings
    values_of_stage = {"plate": plate_values, "cone": cone_values, "collapse": collapse_values}
    values_of_stage |= {"wheel": wheel_values, "angle": wheel_values}
    for run in runs.done(*values_of_stage):
        column, size, *_ = run.name.partition("/")[2].split("_")
        for key, value in values_of_stage[run.case.stage](run):
            if column != "grains":
                (laws if float(size) == CELLS[key[0]][0] else coarse)[column][key] = value
            elif run.case.stage == "angle":
                sizes.setdefault(key, {}).setdefault(size, []).append(value)
            else:
                packings.setdefault(key, []).append(value)
    grains = {key: mean_of_packings(values) for key, values in packings.items()}
    grains |= {key: fine_grains(values) for key, values in sizes.items() if len(values) > 1}
    grains |= {key: (value, error) for key, value, error in (*wheel_of_grains(), *cone_of_grains())}
    rows = matrix(laws, coarse, grains)
    output.table("results.csv", rows)
    for test in ("triaxial", "oedometer"):
        output.table(f"{test}.csv", curves_of_grains(runs, test))
    draw(rows, output.path("matrix.png"))
    return []
