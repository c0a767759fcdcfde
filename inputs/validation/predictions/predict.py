#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Predictions: runs the conditions of conditions.csv with frozen set-ups. See README.md.

Every run keeps its folder below --results. A repeated command makes the missing runs only. Values go
to predictions.csv with the columns id, quantity, value, standard_error. With --fine the tests on snow
run in finer cells with another snow, and their values go to fine_value and fine_standard_error.

The standard error is the root of a sum of squares. Its parts are the time average, the packing (two
pours of grains), the difference to a coarser cell size, and the model error. MODEL_ERROR lists the rms
error of each model on tests whose results were known.
"""

import argparse
import csv
import math
import re
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
INPUTS = HERE.parents[1]

# Rms errors on tests that were known when the models were fixed; the README of each study has them.
MODEL_ERROR = {
    ("T11", "hub_drop"): 0.030,  # [m] snow_wheel, read as hub drop
    ("T11", "rut_depth"): 0.011,  # [m] snow_wheel, read as rut depth
    ("T11", "resistance_coefficient"): 0.017,
    # --fine, on the twelve tests outside its fit: snow_wheel. The fit was made in these cells, so the error
    # of the cells is part of it.
    ("T11-fine", "hub_drop"): 0.039,
    ("T11-fine", "rut_depth"): 0.010,
    ("T11-fine", "resistance_coefficient"): 0.023,
    ("CMU-smooth", "fx_over_fz"): 0.082,  # cmu_sand, slip angle 0
    ("CMU-smooth", "fy_over_fz"): 0.082,  # none known; as fx_over_fz
    ("CMU-smooth", "sinkage"): 0.0027,  # [m]
    ("CMU-grouser", "fx_over_fz"): 0.119,
    ("CMU-grouser", "fy_over_fz"): 0.119,
    ("CMU-grouser", "sinkage"): 0.0058,  # [m]
}
DEFLECTION_ERROR, WIDTH_ERROR = 0.07, 0.06  # relative; tyre_brick, Table 6 at four pressures
SLIP_ERROR = 0.10  # assumed: no slope test was known
# Standard deviation from one pour of grains to the next, of one run: cmu_sand
POUR_SCATTER = {"fx_over_fz": 0.06, "fy_over_fz": 0.03, "sinkage": 0.002}

ANGLES, SLIPS = (15, 30, 45), (-0.5, 0.0, 0.23, 0.5)  # of the CMU tests that are predicted
SEEDS = (86028121, 67867967)  # two pours
FASTEST = 0.4  # [m/s] the larger of travel and rim speed in the runs on grains
GRAIN = 0.010  # [m]
LOAD_STEPS = (0.4, 0.6, 0.75, 0.85, 0.93, 1.0)  # of the load on the plane: each starts from the last
WHEEL = 0.38  # [m] radius of the wheel in the tests that the tyre file describes

COLUMNS = ("id", "quantity", "value", "standard_error", "fine_value", "fine_standard_error")

Values = dict[str, tuple[float, float]]  # quantity -> value, standard error of the time average


@dataclass(frozen=True)
class Run:
    """One run of furrow: a script, its variables and the travel [m] that is averaged."""

    folder: str
    script: Path
    variables: dict[str, str]
    window: tuple[float, float]


def number(text: str) -> float:
    return float(text)


def snow_material(row: dict[str, str], folder: Path, fine: bool) -> Path:
    """The snow of one density; one compaction curve serves all of them."""
    path = folder / f"snow_{row['density_kgm3']}{'_fine' if fine else ''}.yaml"
    base = INPUTS / "materials/variants/field_snow_rut.yaml" if fine else HERE / "materials/field_snow_spreading.yaml"
    path.write_text(
        f"title: Field snow, {row['density_kgm3']} kg/m3\nbase: {base}\n"
        f"law: {{density: {row['density_kgm3']}}}\n"
    )
    return path


def scaled_tyre(radius: float, folder: Path) -> tuple[Path, float]:
    """The tyre file with all lengths scaled to a wheel of another radius [m], and the scale.

    Curvatures scale inversely. Stiffnesses, mass per area and pressure stay those of the same plies.
    """
    scale = radius / WHEEL
    text = (INPUTS / "tyres/p235_75r15.yaml").read_text()
    powers = {"bead_radius": 1, "bead_spacing": 1, "radius": 1, "half_width": 1, "length": 1, "curvature": -1}

    def scaled(match: "re.Match[str]") -> str:
        power = powers[match[2]]
        values = re.sub(r"\d+\.?\d*(e-?\d+)?", lambda n: f"{float(n[0]) * scale**power:.6g}", match[3])
        return f"{match[1]}{match[2]}:{values}"

    text = re.sub(rf"(?m)^(  )({'|'.join(powers)}):([^#\n]*)", scaled, text)
    path = folder / f"tyre_{radius:g}.yaml"
    path.write_text(text)
    return path, scale


def snow_runs(row: dict[str, str], folder: Path, fine: bool) -> list[Run]:
    """The towed tyre in cells of a fifth and a quarter of 0.20 m; fine: in cells of 2.5 to 3 cm."""
    depth, radius = number(row["snow_depth_m"]), number(row["wheel_radius_m"])
    tyre, scale = scaled_tyre(radius, folder)
    deep = depth > 0.3
    distance = 2.0 if deep else 1.2
    runs = []
    sizes = (0.03 if deep else 0.026,) if fine else (0.04, 0.05)
    for cell in sizes:
        cells = max(3, round(depth / cell))
        variables = {
            "body": f"tyre/darnell file {tyre} pressure 179e3 mesh 4 36 half yes mass 30 inertia 1",
            "load": f"load_force {row['load_N']}",
            "radius": f"{0.3483 * scale:.5g}",
            "depth": f"{depth:g}",
            "cell": f"{depth / cells:.6g}",
            "material": str(snow_material(row, folder, fine)),
            "mode": "towed",
            "speed": "2.235",
            "settle": "0.4",
            "accelerate": "0.2",
            "distance": f"{distance:g}",
            "damping": "2000",
            "length": "1.6",
            "width": "1.0" if deep else "0.8",
            "fine_width": "0.4",
            "clearance_above": "0.6" if deep else "0.4",
            "particles": "2",
            "friction": "0.3",
            "stiffness": "0.4",
            "enforcement": "penalty",
            "remap_interval": "16",
            "modulus_scale": "1.0",
        }
        script = HERE.parent / "snow_wheel/wheel.lig"
        runs.append(Run(f"cell_{cell:g}", script, variables, (distance - 0.5, distance)))
    return runs


def in_wheel_frame(slip: float, angle: float) -> tuple[float, float]:
    """Rim and travel speed over the larger of them, from the slip by total travel speed; and the slip
    that the rig takes, by the speed in the wheel plane."""
    rim, travel = (1.0, 1 - slip) if slip >= 0 else (1 + slip, 1.0)
    forward = travel * math.cos(math.radians(angle))
    return travel, (rim - forward) / max(rim, forward)


def sand_runs(row: dict[str, str]) -> list[Run]:
    """The wheel at a slip angle on grains that were calibrated on plates alone; two pours."""
    angle = number(row["slip_angle_deg"])
    travel, slip = in_wheel_frame(number(row["slip"]), angle)
    grousers = "grouser" in row["id"]
    bars = "grousers 24 grouser_height 0.005 grouser_thickness 0.00165" if grousers else "grousers 0"
    variables = {
        "diameter": f"{GRAIN:g}",
        "young": "2.5e6",
        "density": "2440",
        "friction": "0.5",
        "rolling": "0.2",
        "pour_friction": "0.5",
        "step": f"{8e-5 * GRAIN / 0.010 * 2:.3g}",
        "length": "0.46",
        "width": "0.22",
        "depth": "0.07",
        "wall_friction": "0.7",
        "grousers": bars,
        "grouser_height": "0.005" if grousers else "0",
        "slip": f"{slip:.6g}",
        "load": row["load_N"],
        "speed": f"{FASTEST * travel:.5g}",
        "travel": "0.24",
        "slip_angle": f"{angle:g}",
    }
    script = HERE.parent / "cmu_sand/wheel.lig"
    return [
        Run(f"pour_{k + 1}", script, {**variables, "seed": str(seed)}, (0.14, 0.239))
        for k, seed in enumerate(SEEDS)
    ]


def rover_runs(row: dict[str, str]) -> list[Run]:
    return [
        Run(f"cell_{cell}", HERE / "rover.lig", {"slope": row["slope_deg"], "cell": f"{cell}"}, (0.0, 0.0))
        for cell in (0.02, 0.025)
    ]


def sinkage_of_mass_level(row: dict[str, str]) -> float:
    """Height of the sand's effective surface above the level of its mass [m]: 0.6 grains (cmu_sand)."""
    return 0.6 * GRAIN if row["id"].startswith("CMU") else 0.0


def command_of(run: Run, folder: Path, build: Path) -> list[str]:
    words = [str(build / "bin/furrow"), "-in", str(run.script), "-log", "none"]
    for name, value in {"results": str(folder), **run.variables}.items():
        words += ["-var", name, value]
    return words


def made(run: Run, folder: Path, build: Path) -> Path:
    """The folder of a run, which is made if it is missing."""
    if not (folder / "summary.json").is_file():
        folder.mkdir(parents=True, exist_ok=True)
        with (folder / "screen.txt").open("w") as screen:
            subprocess.run(command_of(run, folder, build), stdout=screen, stderr=subprocess.STDOUT, check=True)
    return folder


def steady(run: Run, folder: Path, build: Path) -> dict[str, str]:
    """Row of furrow-resistance over the window of a run."""
    begin, end = run.window
    window = ["--distance", str(begin), str(end)] if end else []
    done = subprocess.run(
        [build / "bin/furrow-resistance", "--csv", *window, folder], capture_output=True, text=True, check=True
    )
    return next(csv.DictReader(done.stdout.splitlines()))


def value_of(row: dict[str, str], name: str) -> tuple[float, float]:
    return number(row[name]), number(row[f"{name}_error"])


def in_wheel_axes(row: dict[str, str], angle: float) -> Values:
    """Forces along the heading and along the axle over F_z (src/theory/symbols.md). The drawbar pull is
    the force along the travel, F_x = F_T cos(angle) - F_S sin(angle); the lateral force is F_S."""
    (fx, ex), (fs, es), (fz, _) = (value_of(row, name) for name in ("drawbar_pull", "lateral_force", "force_z"))
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return {
        "fx_over_fz": ((fx + fs * s) / c / fz, math.hypot(ex, es * s) / c / fz),
        "fy_over_fz": (fs / fz, es / fz),
    }


def combined(parts: list[Values], model: str) -> Values:
    """First run's values, or the mean of the pours, with the standard error of the whole."""
    result = {}
    for name, (value, time_error) in parts[0].items():
        others = [part[name][0] for part in parts]
        if model.startswith("CMU"):
            value = statistics.mean(others)
            scatter = statistics.stdev(others) if len(others) > 1 else POUR_SCATTER[name]
            numerical = scatter / math.sqrt(len(others))
        else:
            numerical = abs(others[0] - others[-1])
        error = MODEL_ERROR.get((model, name), SLIP_ERROR)
        result[name] = (value, math.sqrt(time_error**2 + numerical**2 + error**2))
    return result


def group_of(name: str) -> str:
    return "-".join(name.split("-")[:2]) if name.startswith("CMU") else name.split("-")[0]


def runs_of(row: dict[str, str], group: str, folder: Path, pours: int, fine: bool) -> list[Run]:
    if group == "T11":
        return snow_runs(row, folder, fine)
    return rover_runs(row) if group == "MGRU3" else sand_runs(row)[:pours]


def predict(row: dict[str, str], build: Path, results: Path, pours: int, fine: bool) -> Values:
    """Values of one condition."""
    folder, group = results / row["id"], group_of(row["id"])
    folder.mkdir(parents=True, exist_ok=True)
    if group == "DEF":
        return deflection(row, build)
    parts: list[Values] = []
    for run in runs_of(row, group, folder, pours, fine):
        found = steady(run, made(run, folder / run.folder, build), build)
        if group == "T11":
            wanted = ("hub_drop", "rut_depth", "resistance_coefficient")
            parts.append({name: value_of(found, name) for name in wanted})
        elif group == "MGRU3":
            parts.append({"slip": value_of(found, "slip")})
        else:
            drop, error = value_of(found, "hub_drop")
            forces = in_wheel_axes(found, number(row["slip_angle_deg"]))
            parts.append({**forces, "sinkage": (drop + sinkage_of_mass_level(row), error)})
    return combined(parts, f"{group}-fine" if fine else group)


def deflection(row: dict[str, str], build: Path) -> Values:
    """The brick tyre pressed on a plane, 120 sections."""
    done = subprocess.run(
        [
            *(build / "bin/furrow-tyre", INPUTS / "tyres/p235_75r15_equivalent.yaml", "--half", "--sections", "120"),
            *("--pressure", row["pressure_kPa"], "--load", *(f"{share * number(row['load_N']):g}" for share in LOAD_STEPS)),
        ],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    found = list(csv.DictReader(done.stdout.splitlines()))[-1]
    drop, width = number(found["deflection_cm"]) / 100, number(found["section_width_cm"]) / 100
    return {"deflection": (drop, DEFLECTION_ERROR * drop), "width": (width, WIDTH_ERROR * width)}


def is_predicted(row: dict[str, str]) -> bool:
    if not row["id"].startswith("CMU"):
        return True
    near = any(abs(number(row["slip"]) - slip) < 0.01 for slip in SLIPS)
    return near and number(row["slip_angle_deg"]) in ANGLES


def merged(rows: list[dict[str, str]], new: dict[tuple[str, str], dict[str, str]]) -> None:
    """Writes the values of new to predictions.csv, in the order of rows. The other values stay."""
    file_name = HERE / "predictions.csv"
    kept: dict[tuple[str, str], dict[str, str]] = {}
    if file_name.is_file():
        with file_name.open() as file:
            kept = {(row["id"], row["quantity"]): row for row in csv.DictReader(file)}
    for key, values in new.items():
        kept[key] = {"id": key[0], "quantity": key[1], **kept.get(key, {}), **values}
    order = [row["id"] for row in rows]
    with file_name.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(kept.values(), key=lambda row: order.index(row["id"])))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("groups", nargs="*", help="T11, CMU, MGRU3, DEF or ids; all without it")
    parser.add_argument("--build", type=Path, default=INPUTS.parent / "build")
    parser.add_argument("--results", type=Path, default=INPUTS.parent / "results/predictions")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--pours", type=int, choices=(1, 2), default=2, help="of each bed of grains")
    parser.add_argument("--fine", action="store_true", help="T11 alone, in fine cells")
    options = parser.parse_args()
    with (HERE / "conditions.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if is_predicted(row)]
    chosen = set(options.groups)
    wanted = [row for row in rows if not chosen or chosen & {row["id"], row["id"].split("-")[0]}]
    if options.fine:
        wanted = [row for row in wanted if row["id"].startswith("T11")]
    prefix = "fine_" if options.fine else ""
    results = options.results / "fine" if options.fine else options.results
    with ThreadPoolExecutor(options.jobs) as pool:
        found = pool.map(lambda row: predict(row, options.build, results, options.pours, options.fine), wanted)
        new = {
            (row["id"], name): {f"{prefix}value": f"{value:.4g}", f"{prefix}standard_error": f"{error:.2g}"}
            for row, values in zip(wanted, found)
            for name, (value, error) in values.items()
        }
    merged(rows, new)
    return 0


if __name__ == "__main__":
    sys.exit(main())
