#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Gain and error of active ground: runs with sleep_tolerance against the same run without.

    tests/benchmarks/active_ground.py FURROW CASE [--tolerance T ...] [--cell M] [--distance M] [--repeat N] [--keep FOLDER]

FURROW is the path of the program. CASE is
    track     a wheel of 74 cm on 20 m of snow, half model
    axles     two such wheels, 1.5 m apart, in one rut on 20 m, half model
    vehicle   four of them under a rigid body on 8 m x 2.4 m, whole model
All wheels drive at slip 0.2. Runs with and without sleep_tolerance alternate. The gain is the ratio of their
processor times, the mean over N repetitions. The error is the mean difference of pull over load, and of hub
drop, in the second half of the cruise. Its standard error is that of ten block means. FOLDER keeps the results:
finished runs are not repeated.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

SNOW = Path(__file__).resolve().parents[2] / "inputs" / "materials" / "fresh_snow.yaml"
SPEED, LOAD, DEPTH, RADIUS, STEP = 2.235, 6237.0, 0.2, 0.37, 2e-4  # m/s, N, m, m, s
SETTLE, ACCELERATE = 0.5, 0.25  # s
BLOCKS = 10
WHEELS = {  # places x y [m]
    "track": {"a": (0, 0)},
    "axles": {"a": (0, 0), "b": (-1.5, 0)},
    "vehicle": {"a": (0, 0.7), "b": (0, -0.7), "c": (-1.5, 0.7), "d": (-1.5, -0.7)},
}
GROUND = {  # length, width, lower end along x [m], symmetry
    "track": (20.0, 0.8, -1.5, "yes"),
    "axles": (20.0, 0.8, -3.0, "yes"),
    "vehicle": (8.0, 2.4, -3.0, "no"),
}


def script(case: str, tolerance: float, cell: float, distance: float, folder: Path) -> str:
    length, width, lower, symmetry = GROUND[case]
    lines = [
        "units si", "atom_style granular", "atom_modify sort 0 0", "newton off", "communicate single vel yes",
        "processors * 1 1", "region box block -4 25 -2 2 -0.1 1.5 units box", "create_box 1 box",
        "neighbor 0.05 bin", f"timestep {STEP}",
    ]
    suspension = "suspension_stiffness 50000 suspension_damping 3000" if case == "vehicle" else "damping 6000"
    mass = 60 if case == "vehicle" else 636
    for name, (x, y) in WHEELS[case].items():
        load = f"load_mass {LOAD / 9.80665}" if case == "vehicle" else f"load_force {LOAD}"
        lines += [
            f"fix {name} all wheel/rigid diameter {2 * RADIUS} width 0.272 shoulder 0.051 mass {mass} inertia 2.15 "
            f"axle {x} {y} {DEPTH + RADIUS + 0.002}",
            f"fix rig_{name} all wheel/rig wheel {name} {load} speed {SPEED} mode slip slip 0.2 settle_time {SETTLE} "
            f"accelerate_time {ACCELERATE} ground_level {DEPTH} {suspension}",
        ]
    if case == "vehicle":
        rigs = ",".join(f"rig_{name}" for name in WHEELS[case])
        lines.append(f"fix body all wheel/chassis rigs {rigs} roll_inertia 800 pitch_inertia 1500 height 0.4")
    sleep = f"sleep_tolerance {tolerance}" if tolerance else ""
    lines.append(
        f"fix soil all terrain/continuum material {SNOW} length {length} width {width} depth {DEPTH} surface {DEPTH} "
        f"centre {lower + 0.5 * length} 0 cell {cell} clearance_above 0.3 cfl 0.65 symmetry {symmetry} {sleep}")
    for name in WHEELS[case]:
        lines.append(f"fix touch_{name} all contact/continuum body {name} terrain soil friction 0.3")
    for name in WHEELS[case]:
        lines.append(f"fix out_{name} all wheel/history rig rig_{name} folder {folder}/{name} every 5 vtk 0 title {name}")
    if tolerance:
        lines.append(f"fix sums all ave/time 1 1 100 f_soil[5] f_soil[15] f_soil[16] f_soil[17] f_soil[18] "
                     f"file {folder}/sums.txt")
    lines += ["thermo 2000", f"run {round((SETTLE + ACCELERATE + distance / SPEED - 0.5 * ACCELERATE) / STEP)}"]
    return "\n".join(lines) + "\n"


def run(furrow: str, case: str, tolerance: float, cell: float, distance: float, folder: Path) -> float:
    """Processor time [s]."""
    done = folder / "time.json"
    if not done.exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "scene.lig").write_text(script(case, tolerance, cell, distance, folder))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        made = subprocess.run([furrow, "-in", folder / "scene.lig", "-log", "none"], capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if made.returncode:
            sys.exit(made.stdout[-2000:] + made.stderr[-2000:])
        done.write_text(json.dumps(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime))
    return json.loads(done.read_text())


def read(case: str, tolerance: float, folder: Path) -> dict:
    """Histories of the wheels and sums of the ground."""
    wheels = {}
    for name in WHEELS[case]:
        with h5py.File(folder / name / "history.h5") as file:
            history = file["history"]
            wheels[name] = {key: history[key][:] for key in ("time", "hub_drop", "force_x", "force_z")}
    return {"wheels": wheels, "sums": np.loadtxt(folder / "sums.txt", ndmin=2) if tolerance else None}


def difference(one: dict, reference: dict, name: str, value) -> tuple[float, float]:
    """Mean and standard error of the difference in the second half of the cruise."""
    time = reference["wheels"][name]["time"]
    start = SETTLE + ACCELERATE
    late = time > 0.5 * (start + time[-1])
    change = (value(one["wheels"][name]) - value(reference["wheels"][name]))[late]
    means = [block.mean() for block in np.array_split(change, BLOCKS)]
    return float(np.mean(means)), float(np.std(means, ddof=1) / np.sqrt(BLOCKS))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("furrow")
    parser.add_argument("case", choices=WHEELS)
    parser.add_argument("--tolerance", type=float, nargs="*", default=[0.001, 0.01])
    parser.add_argument("--cell", type=float, default=0.05)
    parser.add_argument("--distance", type=float, default=2.0)
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    tolerances = [0.0, *options.tolerance]
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or Path(temporary)
        of_run = lambda t, n: folder / f"{options.case}_{t:g}_{n}"
        times = {t: [] for t in tolerances}
        for n in range(options.repeat):
            for t in tolerances:
                times[t].append(run(options.furrow, options.case, t, options.cell, options.distance, of_run(t, n)))
        runs = {t: read(options.case, t, of_run(t, 0)) for t in tolerances}
    print(f"{options.case}: without sleep_tolerance {np.mean(times[0.0]):.0f} s of processor time")
    cruise = (SETTLE + ACCELERATE) / STEP
    for tolerance in options.tolerance:
        step, work, share, _, force, energy = runs[tolerance]["sums"].T
        gains = np.array(times[0.0]) / np.array(times[tolerance])
        print(f"tolerance {tolerance:g}: gain {gains.mean():.2f} ({', '.join(f'{gain:.2f}' for gain in gains)}); "
              f"particles computed {100 * share.mean():.1f} % in the mean, {100 * share[step > cruise].mean():.1f} % in "
              f"the cruise; largest neglected force {force[-1]:.3g} N, neglected energy {energy[-1]:.3g} J of "
              f"{work[-1]:.4g} J")
        for name in WHEELS[options.case]:
            pull = difference(runs[tolerance], runs[0.0], name, lambda wheel: wheel["force_x"] / LOAD)
            drop = difference(runs[tolerance], runs[0.0], name, lambda wheel: 1000 * wheel["hub_drop"])
            print(f"    wheel {name}: pull/load {pull[0]:+.1e} +- {pull[1]:.0e}, hub drop {drop[0]:+.1e} +- "
                  f"{drop[1]:.0e} mm")


if __name__ == "__main__":
    main()
