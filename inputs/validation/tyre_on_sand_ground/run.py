#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""TR's tyre pressed into and rolling over sand, elastic and with a cap: where the stress in the ground is. See README.md.

Runs whatever is not in the results folder yet, one run at a time, then writes results.csv and stress.png beside this file.

  run [case ...]       cases: see CASES below (default: all)
  --results FOLDER     where runs are kept (default results/tyre_on_sand_ground in the project)
  --furrow PROGRAM     default: $FURROW_BUILD/bin/furrow or build/bin/furrow in the project; made by 'bash inputs/run'
"""
import argparse, csv, json, os, pathlib, subprocess, time

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
project = here.parents[2]
MATERIALS = project / "inputs" / "materials"
PRESSED = dict(roll=0, start=0)
ELASTIC = dict(material=MATERIALS / "mccormick_sand_elastic.yaml")
CAP = dict(material=MATERIALS / "mccormick_sand.yaml")
# name -> what it is, variables of inputs/scenes/tyre_on_continuum.lig
CASES = {
    "elastic_pressed": ("elastic, pressed", {**ELASTIC, **PRESSED}),
    "elastic_rolled": ("elastic, rolling", ELASTIC),
    "cap_pressed": ("cap law, pressed", {**CAP, **PRESSED}),
    "cap_rolled": ("cap law, rolling", CAP),
}
LAYERS = (0.0, 0.025, 0.05, 0.1, 0.15, 0.2)  # m: the sections of the table
CRUISE = 0.3                                 # m of travel before the end over which forces are averaged
NEAR = 0.2                                   # m before and behind the axle that are counted: beyond lies the load's past


def launch(furrow, folder, variables):
    done = folder / "done.json"
    job = {name: pathlib.Path(value).name if name == "material" else str(value) for name, value in variables.items()}
    if done.exists() and json.loads(done.read_text())["job"] == job:
        return
    folder.mkdir(parents=True, exist_ok=True)
    scene = project / "inputs/scenes/tyre_on_continuum.lig"
    command = ["nice", "-n", "10", str(furrow), "-in", str(scene), "-log", "none", "-var", "results", str(folder)]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    before = os.times()
    with open(folder / "screen.txt", "w") as screen:
        status = subprocess.run(command, stdout=screen, stderr=subprocess.STDOUT, cwd=folder).returncode
    user = round(os.times().children_user - before.children_user, 1)
    if status:
        text = (folder / "screen.txt").read_text()
        raise SystemExit(f"{folder.name}: " + next((line for line in text.splitlines() if "ERROR" in line), f"stopped: {status}"))
    done.write_text(json.dumps({"job": job, "user_s": user}, indent=1))
    print(f"{time.strftime('%H:%M:%S')}  {folder.name:16} {user:7.1f} s user", flush=True)


class Run:
    """Ground at the end, x counted from the axle; vertical stress [Pa], compression positive; the half that was computed."""

    def __init__(self, folder):
        self.user = json.loads((folder / "done.json").read_text())["user_s"]
        with h5py.File(folder / "history.h5") as file:
            self.history = {name: data[()] for name, data in file["history"].items()}
        with h5py.File(folder / "ground.h5") as file:
            ground = {name: data[()] for name, data in file["ground"].items()}
        self.axle = self.history["x"][-1]
        self.home, self.volume, self.mises = ground["home"], ground["volume"], ground["mises"]
        self.stress, self.pressure, self.compaction = -ground["vertical_stress"], ground["pressure"], ground["compaction"]
        self.x, self.y, self.depth = ground["x"][:, 0] - self.axle, ground["x"][:, 1], -ground["home"][:, 2]
        self.displacement = ground["x"] - ground["home"]

    def layer(self, depth):
        """Particles of the sheet nearest to a depth."""
        depths = np.unique(np.round(self.depth, 6))
        nearest = depths[np.argmin(np.abs(depths - depth))]
        return np.abs(self.depth - nearest) < 1e-5, nearest

    def sheet(self, depth, field):
        """Centroid [m], share of the front half, largest value and its place [m] in a sheet."""
        inside, at = self.layer(depth)
        weight = np.maximum(field[inside], 0.0) * self.volume[inside]  # one sheet: all particles have its height
        x = self.x[inside]
        near = np.abs(x) < NEAR
        weight, x, values = weight[near], x[near], field[inside][near]
        place = np.argmax(values)
        total = weight.sum()
        return dict(depth=at, centroid=(weight * x).sum() / total, front=weight[x > 0].sum() / total, peak=values[place], place=x[place])

    def forces(self):
        """dict of means over the end of the cruise: resistance coefficient and where the ground's pressure acts before the axle [m], each with the
        standard error of eight blocks; height of the axle [m], load [N] and its fluctuation."""
        h = self.history
        last = h["x"] > h["x"][-1] - CRUISE if h["x"][-1] - h["x"][0] > CRUISE else h["time"] > h["time"][-1] - 0.03
        load = h["force_z"][last].mean()
        arm = -(h["moment_y"][last] + h["z"][last] * h["force_x"][last]) / load
        blocks = lambda values: np.std([block.mean() for block in np.array_split(values, 8)], ddof=1) / 8**0.5
        return dict(coefficient=-h["force_x"][last].mean() / load, coefficient_error=blocks(h["force_x"][last] / load), arm=arm.mean(), arm_error=blocks(arm),
                    height=h["z"][last].mean(), load=load, fluctuation=h["force_z"][last].std() / load)

    def carried(self, depth):
        """Vertical force through a sheet, of both halves [N]; in equilibrium the load, less what the sides hold."""
        inside, at = self.layer(depth)
        under = inside & (np.abs(self.x) < 0.1) & (self.y < 0.05)  # evenly divided
        spacing = np.median(np.diff(np.unique(np.round(self.home[under, 0], 6))))
        thickness = np.median(self.volume[under]) / spacing**2
        return 2 * (self.stress[inside] * self.volume[inside]).sum() / thickness

    def reach(self, share):
        """Depth where the largest vertical stress of a sheet has fallen to a share of that in the uppermost [m]."""
        depths = np.unique(np.round(self.depth, 6))
        peaks = np.array([self.stress[np.abs(self.depth - d) < 1e-5].max() for d in depths])
        below = np.argmax(peaks < share * peaks[0])
        return np.interp(share * peaks[0], [peaks[below], peaks[below - 1]], [depths[below], depths[below - 1]])

    def boussinesq(self, depths):
        """Vertical stress under the axle that the uppermost sheet's makes in an elastic half space (J. Boussinesq, 1885) [Pa]."""
        top, z0 = self.layer(0.0)
        spacing = np.sqrt(self.volume[top] / (2 * z0))
        load = self.stress[top] * spacing**2
        result = []
        for z in depths:
            total = 0.0
            for mirror in (1, -1):
                total += (3 * load * (z - z0)**3 / (2 * np.pi * (self.x[top]**2 + (mirror * self.y[top])**2 + (z - z0)**2)**2.5)).sum()
            result.append(total)
        return np.array(result)


def evaluate(results):
    rows = []
    runs = {name: Run(results / name) for name in CASES if (results / name / "done.json").exists()}
    for name, run in runs.items():
        f = run.forces()
        row = dict(case=name, user_s=run.user, load_N=round(f["load"]), load_fluctuation=round(f["fluctuation"], 3),
                   coefficient=round(f["coefficient"], 5), coefficient_error=round(f["coefficient_error"], 5),
                   pressure_before_axle_mm=round(1e3 * f["arm"], 2), pressure_before_axle_error_mm=round(1e3 * f["arm_error"], 2),
                   moment_balance_mm=round(1e3 * f["coefficient"] * f["height"], 2), axle_height_mm=round(1e3 * f["height"], 2),
                   load_at_0_over_load=round(run.carried(0.0) / f["load"], 3), load_at_100_over_load=round(run.carried(0.1) / f["load"], 3),
                   reach_half_mm=round(1e3 * run.reach(0.5)), reach_tenth_mm=round(1e3 * run.reach(0.1)),
                   largest_pressure_kPa=round(run.pressure.max() / 1e3), largest_compaction=round(run.compaction.max(), 5))
        track = np.abs(run.y) < 0.03
        top, _ = run.layer(0.0)
        for label, where in (("behind", run.x < -0.2), ("under", np.abs(run.x) < 0.05), ("before", run.x > 0.15)):
            inside = top & track & where & (np.abs(run.x) < 0.3)
            row[f"settlement_{label}_mm"] = round(-1e3 * run.displacement[inside, 2].mean(), 3) if inside.any() else ""
        for depth in LAYERS:
            for field, short in ((run.stress, "sz"), (run.mises, "q")):
                sheet = run.sheet(depth, field)
                at = f"{short}_{1e3 * depth:.0f}"
                row.update({f"{at}_centroid_mm": round(1e3 * sheet["centroid"], 1), f"{at}_front": round(sheet["front"], 3),
                            f"{at}_peak_kPa": round(sheet["peak"] / 1e3, 1), f"{at}_place_mm": round(1e3 * sheet["place"])})
        depths = np.array([0.1, 0.2])
        under = []
        for z in depths:
            inside, at = run.layer(z)
            close = inside & (np.hypot(run.x, run.y) < 0.03)
            under.append((run.stress[close].mean(), run.boussinesq([at])[0]))
        row.update({f"sz_{1e3 * z:.0f}_over_boussinesq": round(s / b, 3) for z, (s, b) in zip(depths, under)})
        rows.append(row)
    keys = list(dict.fromkeys(key for row in rows for key in row))
    with open(here / "results.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["quantity", *[row["case"] for row in rows]])
        for key in keys[1:]:
            writer.writerow([key, *[row.get(key, "") for row in rows]])
    for key in keys:
        print(f"{key:28}", *[f"{row.get(key, '')!s:>16}" for row in rows])
    picture(runs)


def picture(runs):
    figure, panels = plt.subplots(len(runs), 2, figsize=(10, 2.5 * len(runs)), constrained_layout=True, squeeze=False)
    for line, (name, run) in zip(panels, runs.items()):
        slab = (run.y < np.unique(np.round(run.y, 6))[1] + 1e-4) & (np.abs(run.x) < 0.32) & (run.depth < 0.25)
        for axes, field, label, levels in ((line[0], run.stress, "vertical stress", np.arange(0, 301, 25)),
                                           (line[1], run.mises, "Mises stress q", np.arange(0, 401, 40))):
            shown = axes.tricontourf(run.x[slab], -run.depth[slab], field[slab] / 1e3, levels=levels, cmap="viridis", extend="both")
            axes.axvline(0, color="w", lw=0.8, ls="--")
            axes.set(aspect="equal", title=f"{CASES[name][0]}: {label}", ylabel="z [m]")
            figure.colorbar(shown, ax=axes, label="kPa", shrink=0.9)
    for axes in panels[-1]:
        axes.set_xlabel("x from the axle [m], travel to the right")
    figure.savefig(here / "stress.png", dpi=80)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="case")
    parser.add_argument("--results", type=pathlib.Path, default=project / "results" / "tyre_on_sand_ground")
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
