#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""TR's tyre and a rigid wheel of its outline on 20 cm of fresh snow: sinkage, resistance and the tyre's deflection. See README.md.

Runs whatever is not in the results folder yet, one run at a time, then writes results.csv beside this file.

  run [case ...]       cases: see CASES below (default: all)
  --results FOLDER     where runs are kept (default results/tyre_on_snow in the project)
  --furrow PROGRAM     default: $FURROW_BUILD/bin/furrow or build/bin/furrow in the project; made by 'bash inputs/run'
"""
import argparse, csv, json, os, pathlib, subprocess, sys, time

import h5py
import numpy as np

here = pathlib.Path(__file__).resolve().parent
project = here.parents[2]
# The rigid wheel has the unloaded tyre's outline: radius, section width, shoulders of the sidewalls' bulge. Mass and inertia of rim and tread.
RIGID = "wheel/rigid diameter 0.6966 width 0.256 shoulder 0.0495 mass 36.7 inertia 1.81 segments 72"
TYRE = f"tyre/darnell file {project}/inputs/tyres/p235_75r15.yaml mesh 6 72 half yes mass 30 inertia 1 pressure "
SECTION_HEIGHT = 0.3475 - 0.208  # m, inputs/tyres/p235_75r15.yaml


def rigid(**more):
    return dict(body=RIGID, watch="f_touch[3]", **more)


def tyre(pressure, **more):
    return dict(body=TYRE + f"{pressure}e3", watch="f_wheel[1] f_wheel[3]", **more)


# name -> what it is, variables of roll.lig
CASES = {
    "rigid_50": ("rigid, cells of 5 cm", rigid(cell=0.05)),
    "rigid_40": ("rigid, cells of 4 cm", rigid()),
    "rigid_33": ("rigid, cells of 3.3 cm", rigid(cell=0.2 / 6)),
    "tyre_241_50": ("241 kPa, cells of 5 cm", tyre(241, cell=0.05)),
    "tyre_241_40": ("241 kPa, cells of 4 cm", tyre(241)),
    "tyre_241_33": ("241 kPa, cells of 3.3 cm", tyre(241, cell=0.2 / 6)),
    "tyre_103_50": ("103 kPa, cells of 5 cm", tyre(103, cell=0.05)),
    "rigid_towed_50": ("rigid, towed, cells of 5 cm", rigid(mode="towed", cell=0.05)),
    "tyre_241_towed_50": ("241 kPa, towed, cells of 5 cm", tyre(241, mode="towed", cell=0.05)),
}
WINDOW = 0.35  # m of travel before the end over which is averaged


def launch(furrow, folder, variables):
    done = folder / "done.json"
    job = {name: str(value).replace(f"{project}/", "") for name, value in variables.items()}
    if done.exists() and json.loads(done.read_text())["job"] == job:
        return
    folder.mkdir(parents=True, exist_ok=True)
    command = ["nice", "-n", "10", str(furrow), "-in", str(here / "roll.lig"), "-log", "none", "-var", "here", str(here),
               "-var", "results", str(folder)]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    before = os.times()
    with open(folder / "screen.txt", "w") as screen:
        status = subprocess.run(command, stdout=screen, stderr=subprocess.STDOUT, cwd=folder).returncode
    user = round(os.times().children_user - before.children_user, 1)
    if status:
        text = (folder / "screen.txt").read_text()
        sys.exit(f"{folder.name}: " + next((line for line in text.splitlines() if "ERROR" in line), f"stopped: {status}"))
    done.write_text(json.dumps({"job": job, "user_s": user}, indent=1))
    print(f"{time.strftime('%H:%M:%S')}  {folder.name:16} {user:7.1f} s user", flush=True)


def row_of(name, folder):
    with h5py.File(folder / "history.h5") as file:
        history = {key: data[()] for key, data in file["history"].items()}
        nodes = file["surface/x"][()]
    last = history["x"] > history["x"][-1] - WINDOW
    load = history["force_z"][last].mean()
    row = dict(case=name, what=CASES[name][0], user_s=json.loads((folder / "done.json").read_text())["user_s"],
               sinkage_mm=round(1e3 * history["sinkage"][last].mean(), 1), sinkage_drift_mm=round(1e3 * drift(history, "sinkage", last), 1),
               coefficient=round(-history["force_x"][last].mean() / load, 4), coefficient_error=round(scatter(-history["force_x"][last] / load), 4),
               load_N=round(load), slip=round(history["slip"][last].mean(), 3))
    with h5py.File(folder / "ground.h5") as file:
        ground = {key: data[()] for key, data in file["ground"].items()}
    x = ground["x"][:, 0] - history["x"][-1]
    middle = (np.abs(ground["home"][:, 2] - 0.075) < 0.025) & (np.abs(x) < 0.4)  # 10 to 15 cm below the undisturbed surface
    stress = np.maximum(-ground["vertical_stress"][middle], 0.0) * ground["volume"][middle]
    row.update(stress_front_share=round(stress[x[middle] > 0].sum() / stress.sum(), 3),
               stress_centroid_mm=round(1e3 * (stress * x[middle]).sum() / stress.sum()))
    if name.startswith("tyre"):
        watch = np.loadtxt(folder / "watch.txt")
        watched = watch[:, 0] * 1e-4 > history["time"][last][0]
        lowest, width = watch[watched, 2].mean(), watch[:, 3]
        # At the end: how far the tread's middle has come in towards the axle, all around
        axle = np.array([history["x"][-1], history["z"][-1]])
        rows = 72
        tread = nodes[: rows * 4].reshape(rows, 4, 3)[:, 0]  # half a model: column 0 is the middle
        radius = np.hypot(tread[:, 0] - axle[0], tread[:, 2] - axle[1])
        angle = np.degrees(np.arctan2(tread[:, 0] - axle[0], axle[1] - tread[:, 2]))  # from straight down, forward
        come_in = np.median(radius[np.abs(angle) > 120]) - radius
        most = np.argmax(come_in)
        row.update(deflection_mm=round(1e3 * lowest, 2), deflection_share_diameter=round(lowest / 0.6966, 4),
                   deflection_share_section=round(lowest / SECTION_HEIGHT, 4), largest_mm=round(1e3 * come_in[most], 2),
                   at_degrees=round(angle[most]))
    return row


def drift(history, channel, last):
    """Second half of the window less the first."""
    values = history[channel][last]
    middle = values.size // 2
    return values[middle:].mean() - values[:middle].mean()


def scatter(values):
    """Standard error of the mean from eight blocks."""
    blocks = [block.mean() for block in np.array_split(values, 8)]
    return np.std(blocks, ddof=1) / 8**0.5


def evaluate(results):
    rows = [row_of(name, results / name) for name in CASES if (results / name / "done.json").exists()]
    if not rows:
        return
    keys = list(dict.fromkeys(key for row in rows for key in row))
    with open(here / "results.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, keys, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        print(row)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="case")
    parser.add_argument("--results", type=pathlib.Path, default=project / "results" / "tyre_on_snow")
    build = pathlib.Path(os.environ.get("FURROW_BUILD", project / "build"))
    parser.add_argument("--furrow", type=pathlib.Path, default=build / "bin" / "furrow")
    arguments = parser.parse_args()
    cases = arguments.cases or list(CASES)
    unknown = set(cases) - {*CASES, "report"}
    if unknown:
        parser.error(f"unknown case {', '.join(sorted(unknown))}")
    for name in cases:
        if name != "report":
            launch(arguments.furrow.resolve(), arguments.results.resolve() / name, CASES[name][1])
    evaluate(arguments.results.resolve())


if __name__ == "__main__":
    main()
