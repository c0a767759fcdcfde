#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plate of 20.32 cm into 50 cm of fresh snow, continuum, against the measured peak load. See README.md.

Runs whatever is not in the results folder yet, one run at a time, then writes results.csv, curves.png, foam.png and density.png beside this
file.

  run [case ...]       cases: see CASES below (default: all)
  --results FOLDER     where runs are kept (default results/snow_plate in the project)
  --furrow PROGRAM     default: $FURROW_BUILD/bin/furrow or build/bin/furrow in the project; made by 'bash inputs/run'
"""
import argparse, csv, json, math, os, pathlib, re, subprocess, sys, time

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = pathlib.Path(__file__).resolve().parent
project = here.parents[2]
sys.path.append(str(project / "postproc"))
from furrow_post import ground as furrow_ground

TIME_LIMIT = 3600  # s, of one run
MATERIALS = project / "inputs" / "materials"
FRESH, FOAM, FITTED = (MATERIALS / f"fresh_snow{name}.yaml" for name in ("", "_foam", "_foam_oedometer"))


def foam(**more):
    return dict(dict(material=FOAM, soften=1), **more)


def steep(beta):
    """Text of a material file: the oedometer's cap law with a steeper cone, and p_b such that confined compression stays as it was,
    sigma_1 = p_b (1 + 2/3 tan beta) + 2/3 d."""
    rise = lambda angle: 1 + 2 / 3 * math.tan(math.radians(angle))
    text = FRESH.read_text()
    p, eps = (re.search(rf"^  {key}: *(\[.*\])", text, re.M)[1] for key in ("p", "eps_vol_pl"))
    p = [float(value) * rise(22.53) / rise(beta) for value in p.strip("[]").split(",")]
    return (f"title: Fresh snow, beta {beta}\nbase: {FRESH}\nlaw: {{beta: {beta}, R: {0.95 * p[0] / 5e3:.4g}}}\n"
            f"hardening: {{type: table, p: {p}, eps_vol_pl: {eps}, interpolation: linear, beyond: extrapolate}}\n")


def linear(material):
    """Text of a material file: with TR's linear elasticity instead of the porous one, which takes a third of the time."""
    return f"title: Foam law, linear elasticity\nbase: {material}\nelasticity: {{type: linear, E: 13.79e6, nu: 0.3}}\n"


# name -> what it is, variables of inputs/scenes/plate_on_snow.lig; a material is a file, or the text of one
CASES = {
    "oedometer": ("cap law from the oedometer, friction 0.3", {}),
    "smooth": ("the same, no friction on plate and edge", dict(friction=0)),
    "log": ("the same, hardening straight in ln p", dict(material=MATERIALS / "fresh_snow_log.yaml")),
    "p_0413": ("the same, hardening read as p = 0.413 sigma1", dict(material=MATERIALS / "fresh_snow_p_0413.yaml")),
    "field": ("identified on wheels", dict(material=MATERIALS / "field_snow_identified.yaml")),
    "slow": ("the oedometer's, half the speed", dict(speed=0.25)),
    "fine": ("the oedometer's, cells of 3.1 cm", dict(cell=0.03125)),
    "finer": ("the oedometer's, cells of 2.5 cm", dict(cell=0.025)),
    "beta_45": ("the oedometer's, beta 45 degrees, same confined compression", dict(material=steep(45))),
    "beta_60": ("the oedometer's, beta 60 degrees, same confined compression", dict(material=steep(60))),
    "foam": ("foam law", foam()),
    "foam_fine": ("foam law, cells of 3.1 cm", foam(cell=0.03125)),
    "foam_weightless": ("foam law, no weight", foam(gravity=0)),
    "foam_fitted": ("foam law, lambda from the oedometer", foam(material=FITTED)),
    "foam_fitted_weightless": ("foam law, lambda from the oedometer, no weight", foam(material=FITTED, gravity=0)),
    "foam_deep": ("foam law, 80 cm of snow", foam(depth=0.8)),
    "foam_box": ("foam law, walls 1 m apart", foam(box=1.0)),
    "foam_linear": ("foam law, linear elasticity", foam(material=linear(FOAM))),
    "foam_linear_finer": ("foam law, linear elasticity, cells of 2.5 cm", foam(material=linear(FOAM), cell=0.025)),
    "foam_smooth": ("foam law, no friction on plate and edge", foam(friction=0)),
    "foam_cycle_1": ("foam law, cycle 1", foam(cycle=1)),
    "foam_column": ("foam law, plate as wide as the box", foam(shape="square", size=0.6, friction=0, cell=0.05)),
}
IN_FOAM_PICTURE = ("foam", "foam_fine", "foam_linear_finer", "foam_weightless", "foam_fitted", "foam_fitted_weightless", "foam_deep",
                   "foam_box", "foam_cycle_1")


def reference():
    with open(here / "reference.csv") as file:
        return {k: float(v) for k, v in next(csv.DictReader(line for line in file if not line.startswith("#"))).items()}


def launch(furrow, folder, variables):
    done = folder / "done.json"
    job = {name: str(value) for name, value in variables.items()}
    material = job.get("material", "")
    job["material"] = material if "\n" in material else pathlib.Path(material).name
    job["material"] = job["material"].replace(f"{project}/", "")
    if done.exists() and json.loads(done.read_text())["job"] == job:
        return
    folder.mkdir(parents=True, exist_ok=True)
    if "\n" in material:
        (folder / "material.yaml").write_text(material)
        variables = dict(variables, material=folder / "material.yaml")
    scene = project / "inputs/scenes/plate_on_snow.lig"
    command = ["nice", "-n", "10", str(furrow), "-in", str(scene), "-log", "none", "-var", "results", str(folder)]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    before = os.times()
    with open(folder / "screen.txt", "w") as screen:
        try:
            status = subprocess.run(command, stdout=screen, stderr=subprocess.STDOUT, cwd=folder, timeout=TIME_LIMIT).returncode
        except subprocess.TimeoutExpired:
            status = "time limit"
    text = (folder / "screen.txt").read_text()
    error = next((line for line in text.splitlines() if "ERROR" in line), f"stopped: {status}") if status != 0 else ""
    user = round(os.times().children_user - before.children_user, 1)
    done.write_text(json.dumps({"job": job, "user_s": user, "error": error}, indent=1))
    print(f"{time.strftime('%H:%M:%S')}  {folder.name:12} {user:7.1f} s user  {error}", flush=True)


def curve_of(folder):
    """Columns: step, sinkage [m], load [N], pressure [Pa]; empty where there is none."""
    file = folder / "curve.txt"
    curve = np.loadtxt(file, ndmin=2) if file.exists() else np.empty((0, 4))
    return curve if curve.size else np.empty((0, 4))


def evaluate(results, furrow):
    measured, rows = reference(), []
    figure, axes = plt.subplots(figsize=(7, 4.5), constrained_layout=True)
    for name, (what, _) in CASES.items():
        done = results / name / "done.json"
        if not done.exists():
            continue
        record = json.loads(done.read_text())
        curve = curve_of(results / name)
        reached = curve[:, 1].max() if curve.size else 0.0
        row = dict(case=name, what=what, user_s=record["user_s"], sinkage_reached_m=round(reached, 4), error=record["error"])
        if not record["error"]:
            peak = curve[:, 2].max()
            last = curve[:, 1] > reached - 0.005  # the load at the end, over half a centimetre
            with h5py.File(results / name / "ground.h5") as file:
                loss = file["history/numerical_loss"][-1] / file["history/contact_work"][-1]
            row.update(peak_N=round(peak), peak_over_measured=round(peak / measured["peak_load_N"], 3), end_N=round(curve[last, 2].mean()),
                       inertia_N=round(float(record["job"].get("speed", 0.5)) ** 2 * 200 * np.pi / 4 * measured["diameter_m"] ** 2, 1),
                       numerical_loss=round(loss, 4))
        if not name.startswith("foam_"):
            axes.plot(100 * curve[:, 1], curve[:, 2] / 1e3, lw=1.1, ls=":" if record["error"] else "-", label=what,
                      color="k" if name == "foam" else None)
        rows.append(row)
    mark_measured(axes, measured)
    axes.set(xlabel="sinkage [cm]", ylabel="load [kN]", ylim=(0, 5), xlim=(0, 24))
    axes.legend(frameon=False, fontsize=8)
    figure.savefig(here / "curves.png", dpi=90)
    plt.close(figure)
    keys = list(dict.fromkeys(key for row in rows for key in row))
    with open(here / "results.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, keys, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        print(row)
    density_picture(results)
    foam_picture(results, furrow, measured)


def mark_measured(axes, measured):
    axes.plot(100 * measured["sinkage_m"], measured["peak_load_N"] / 1e3, "k*", ms=12, label="measured peak")
    axes.axhspan(0.75 * measured["peak_load_N"] / 1e3, 1.25 * measured["peak_load_N"] / 1e3, color="0.9", zorder=0, label="goal: 25 %")


def confined_compression(material, folder, furrow):
    """density [kg/m3] and sigma_1 [Pa] of a law at one point, by furrow-point."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "path.yaml").write_text(f"title: {material.stem}\nmaterial: {material}\npath: {{type: confined, strain: [1.1], steps: 400}}\n")
    command = [furrow.with_name("furrow-point"), "run", folder / "path.yaml", "-o", folder, "--no-plot"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with open(folder / "point.csv") as file:
        table = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return (np.array([float(row[key]) for row in table]) for key in ("density", "axial_stress"))


def foam_picture(results, furrow, measured):
    """The laws in confined compression; loads of the foam law, and of a column of it under the plate."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(14, 4.6), width_ratios=(1, 1.2), constrained_layout=True)
    area = math.pi / 4 * measured["diameter_m"] ** 2
    sinkage = np.linspace(0, measured["sinkage_m"], 200)
    laws = (FRESH, "cap law", "C0"), (FOAM, "foam law", "C1"), (FITTED, "foam law, lambda from the oedometer", "C2")
    for material, label, colour in laws:
        density, stress = confined_compression(material, results / "confined" / material.stem, furrow)
        left.semilogy(density[1:], stress[1:] / 1e3, color=colour, label=label)
        column = area * np.interp(200 / (1 - sinkage / 0.5), density, stress)
        right.semilogy(100 * sinkage[1:], column[1:] / 1e3, "--", color=colour, lw=1, label=f"column under the plate, {label}")
    with open(here.parent / "snow_oedometer" / "reference.csv") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        points = np.array([[float(x) for x in row.values()] for row in table])
    left.plot(points[:, 1], points[:, 0] / 1e3, "k*", ms=10, label="measured (Abele and Gow)")
    left.set(xlabel="density [kg/m3]", ylabel="axial stress in confined compression [kPa]", xlim=(200, 600), ylim=(0.3, 3000))
    left.legend(frameon=False, fontsize=8)
    for name in IN_FOAM_PICTURE:
        curve = curve_of(results / name)
        if curve.size:
            right.semilogy(100 * curve[:, 1], np.maximum(curve[:, 2], 1) / 1e3, lw=1.1, label=CASES[name][0])
    mark_measured(right, measured)
    right.set(xlabel="sinkage [cm]", ylabel="load [kN]", xlim=(0, 24), ylim=(0.1, 12))
    right.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(here / "foam.png", dpi=90)
    plt.close(figure)


def density_picture(results):
    """Density under the plate at the end, of the laws that came to the end."""
    shown = [name for name in ("oedometer", "log", "foam", "field") if (results / name / "done.json").exists()
             and not json.loads((results / name / "done.json").read_text())["error"]]
    if not shown:
        return
    figure, panels = plt.subplots(1, len(shown), figsize=(4.6 * len(shown), 4.4), constrained_layout=True, squeeze=False)
    for axes, name in zip(panels[0], shown):
        snow = furrow_ground.Ground.read(results / name)
        furrow_ground.density_section(figure, axes, snow, 0, 0.5 * snow.spacing)
        axes.set_title(CASES[name][0], fontsize=9)
    figure.savefig(here / "density.png", dpi=90)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="case")
    parser.add_argument("--results", type=pathlib.Path, default=project / "results" / "snow_plate")
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
    evaluate(arguments.results.resolve(), arguments.furrow.resolve())


if __name__ == "__main__":
    main()
