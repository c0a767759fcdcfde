# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: tables, accuracy, the picture."""
import csv, json, math, subprocess

import matplotlib
import numpy as np

import study

matplotlib.use("Agg")
import matplotlib.pyplot as plt

RADIUS = 58.0   # mm
SURFACES = np.arange(0.0, 0.601, 0.025)  # of the grain diameter: from the level of the mass to the top of the highest grains


def finished(folder):
    """What run wrote about a finished run, or None."""
    done = folder / "done.json"
    return json.loads(done.read_text()) if done.exists() else None


# ---- plates

def plate_curve(folder):
    """Sinkage [mm] below the level of the bed's mass and force [N], smoothed over 1.1 mm: a tenth of a grain."""
    table = np.loadtxt(folder / "curve.txt")
    width = 11
    force = np.convolve(np.pad(table[:, 2], width // 2, "edge"), np.ones(width) / width, "valid")
    return 1000 * table[:, 1], force


def log_errors(curve, size, surface):
    """ln(computed/measured force) at the measured sinkages of one plate, counted from a surface [mm] above the level of the mass."""
    sinkage, force = curve
    points = [r for r in study.reference() if r["kind"] == "plate" and r["size_mm"] == size]
    return [math.log(np.interp(r["sinkage_mm"], sinkage + surface, force) / r["force_N"]) for r in points]


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def fit_plates(curves, diameter):
    """Effective surface [mm] of the smallest rms of ln(force), that rms, and the rms with the level of the mass as surface."""
    def error(surface):
        return rms(sum((log_errors(curve, size, surface) for size, curve in curves.items()), []))
    surface = min(diameter * SURFACES, key=error)
    return float(surface), error(surface), error(0.0)


def homogeneous_floor():
    """Least rms of ln(pressure) that p = rho g B f(z/B), the only form a dry frictional half-space has, can reach; ln f quadratic."""
    rows = [r for r in study.reference() if r["kind"] == "plate"]
    size, sinkage, force = (np.array([r[k] for r in rows]) for k in ("size_mm", "sinkage_mm", "force_N"))
    x, y = np.log(sinkage / size), np.log(force / size**3)
    return rms(y - np.polyval(np.polyfit(x, y, 2), x))


def calibration_table(results):
    """One row a candidate, then the chosen one with one thing changed; plates that were not run are left out and show as empty."""
    rows = []
    for name in [*study.CANDIDATES, *(study.CHOSEN + what for what in study.PLATE_CHECKS)]:
        folders = {size: results / f"plate_{name}_{size}" for size in study.PLATES}
        folders = {size: folder for size, folder in folders.items() if finished(folder)}
        if not folders:
            continue
        runs = {size: finished(folder) for size, folder in folders.items()}
        curves = {size: plate_curve(folder) for size, folder in folders.items()}
        run = next(iter(runs.values()))
        surface, best, plain = fit_plates(curves, 1000 * run["job"]["variables"]["diameter"])
        values, facts = run["job"]["variables"], run["facts"]
        row = dict(candidate=name, grain_mm=1000 * values["diameter"], friction=values["friction"], rolling=values["rolling"],
                   pour_friction=values["pour_friction"], speed=values["speed"], solid_fraction=round(facts["solid_fraction"], 4),
                   bulk_density_kgm3=round(facts["bulk_density"], 1), surface_mm=round(surface, 3),
                   surface_over_grain=round(surface / 1000 / values["diameter"], 2),
                   rms_ln_force=round(best, 3), rms_ln_force_surface_0=round(plain, 3))
        for size in study.PLATES:
            row[f"rms_{size}"] = round(rms(log_errors(curves[size], size, surface)), 3) if size in curves else ""
        row["cpu_s"] = round(sum(r["cost"]["cpu_s"] for r in runs.values()), 1)
        rows.append(row)
    return rows


# ---- wheels

def steady(folder, evaluate):
    """Furrow's own evaluation over the last part of the travel, a row of furrow-resistance --csv."""
    command = [str(evaluate), "--csv", "--distance", *map(str, study.WINDOW), str(folder)]
    rows = csv.DictReader(subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines())
    return {k: v if k == "folder" else float(v) for k, v in next(rows).items()}


def wheel_row(name, folder, kind, point, surface, evaluate):
    done, values = finished(folder), steady(folder, evaluate)
    return dict(run=name, wheel=kind, slip=point["slip"], load_N=point["load_N"],
                measured_fx_over_fz=round(point["force_N"] / point["load_N"], 4),
                measured_error=round(point["force_std_N"] / point["load_N"], 4),
                fx_over_fz=round(-values["resistance_coefficient"], 4), fx_over_fz_error=round(values["resistance_coefficient_error"], 4),
                measured_sinkage_mm=point["sinkage_mm"], measured_sinkage_error_mm=point["sinkage_std_mm"],
                sinkage_from_mass_mm=round(1000 * values["sinkage"], 2), sinkage_mm=round(1000 * values["sinkage"] + surface, 2),
                sinkage_error_mm=round(1000 * values["sinkage_error"], 2), steady="yes" if values["steady"] else "no",
                grains=int(done["facts"]["grains"]), steps=int(done["facts"]["steps"]), cpu_s=done["cost"]["cpu_s"])


def accuracy(rows):
    """RMS over the slips: Fx over mean Fz, sinkage over radius, the latter with both surfaces."""
    pull = rms([r["fx_over_fz"] - r["measured_fx_over_fz"] for r in rows])
    sinkage = {k: rms([(r[k] - r["measured_sinkage_mm"]) / RADIUS for r in rows]) for k in ("sinkage_mm", "sinkage_from_mass_mm")}
    return pull, sinkage["sinkage_mm"], sinkage["sinkage_from_mass_mm"]


# ---- all

def write_table(path, rows):
    if not rows:
        return
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def show(rows):
    if not rows:
        return
    widths = {k: max(len(k), *(len(str(r[k])) for r in rows)) for k in rows[0]}
    print("  ".join(k.rjust(w) for k, w in widths.items()))
    for row in rows:
        print("  ".join(str(row[k]).rjust(w) for k, w in widths.items()))
    print()


def report(results, folder, evaluate):
    """Writes calibration.csv, results.csv, checks.csv, comparison.png; returns what misses the accuracy once reached."""
    calibration = calibration_table(results)
    chosen = next(row for row in calibration if row["candidate"] == study.CHOSEN)
    show(calibration)
    write_table(folder / "calibration.csv", calibration)
    reached = {"plates: rms of ln(force)": chosen["rms_ln_force"]}

    rows = []
    for kind in ("smooth", "grouser"):
        for point in study.wheel_points(kind):
            name = study.wheel_name(kind, point)
            if finished(results / name):
                rows.append(wheel_row(name, results / name, kind, point, chosen["surface_mm"], evaluate))
    show(rows)
    write_table(folder / "results.csv", rows)
    for kind in ("smooth", "grouser"):
        mine = [r for r in rows if r["wheel"] == kind]
        if mine:
            pull, sinkage, from_mass = accuracy(mine)
            reached[f"{kind} wheel: rms of Fx/Fz"] = pull
            reached[f"{kind} wheel: rms of sinkage/r"] = sinkage
            reached[f"{kind} wheel: rms of sinkage/r, from the level of the mass"] = from_mass

    checks = check_table(results, chosen["surface_mm"], evaluate)
    if checks:
        show(checks)
        write_table(folder / "checks.csv", checks)
    picture(results, folder / "comparison.png", chosen["surface_mm"], rows)

    finer = [r for r in checks if r["run"].startswith("check_grain_8")]
    if finer:
        slips = [r["slip"] for r in finer]
        same = [r for r in rows if r["wheel"] == "smooth" and r["slip"] in slips]
        for what, mine in (("8", finer), ("10", same)):
            pull, sinkage, _ = accuracy(mine)
            reached[f"smooth wheel, {len(slips)} slips with grains of {what} mm: rms of Fx/Fz"] = pull
            reached[f"smooth wheel, {len(slips)} slips with grains of {what} mm: rms of sinkage/r"] = sinkage

    missed = []
    print(f"least rms of ln(force) of any dry frictional half-space on these plates: {homogeneous_floor():.3f}")
    for name, value in reached.items():
        limit = study.REACHED.get(name)
        goal = study.GOALS.get(name)
        verdict = f"  (goal {goal}: {'reached' if value <= goal else 'not reached'})" if goal else ""
        print(f"{name}: {value:.3f}{verdict}" + (f"  limit {limit}" if limit else ""))
        if limit and not value <= limit:
            missed.append(f"{name} is {value:.3f}, limit {limit}")
    return missed


def check_table(results, surface, evaluate):
    rows = []
    for name, (kind, point, what) in study.check_points().items():
        if finished(results / name):
            diameter = finished(results / name)["job"]["variables"]["diameter"]  # the surface is a share of the grain
            row = wheel_row(name, results / name, kind, point, surface * diameter / study.BASE["diameter"], evaluate)
            rows.append(dict(run=name, what=what, **{k: v for k, v in row.items() if k not in ("run", "load_N", "measured_error")}))
    return rows


def picture(results, path, surface, rows):
    figure, (plates, pull, sink) = plt.subplots(1, 3, figsize=(13, 4.2), constrained_layout=True)
    for size, colour in zip(study.PLATES, ("tab:blue", "tab:orange", "tab:green")):
        points = [r for r in study.reference() if r["kind"] == "plate" and r["size_mm"] == size]
        area = math.pi / 4 * size**2 / 1000  # mm2 to kPa
        plates.errorbar([r["sinkage_mm"] for r in points], [r["force_N"] / area for r in points],
                        [np.nan_to_num(r["force_std_N"]) / area for r in points],
                        fmt="o", ms=3, color=colour, label=f"{size} mm measured")  # scatter of the tests
        folder = results / f"plate_{study.CHOSEN}_{size}"
        if finished(folder):
            sinkage, force = plate_curve(folder)
            plates.plot(sinkage + surface, force / area, color=colour, label=f"{size} mm computed")
    plates.set(xlabel="sinkage [mm]", ylabel="mean pressure [kPa]", xlim=(0, 21), ylim=(0, 40), title="plates (calibration)")
    for kind, colour in (("smooth", "tab:blue"), ("grouser", "tab:red")):
        measured = [r for r in study.reference() if r["kind"] == kind and -0.75 < r["slip"] < 0.95]
        slips = [r["slip"] for r in measured]
        dots = dict(fmt="o", ms=4, color=colour)
        pull.errorbar(slips, [r["force_N"] / r["load_N"] for r in measured], [r["force_std_N"] / r["load_N"] for r in measured],
                      label=f"{kind} measured", **dots)
        sink.errorbar(slips, [r["sinkage_mm"] for r in measured], [r["sinkage_std_mm"] for r in measured], **dots)
        mine = sorted((r for r in rows if r["wheel"] == kind), key=lambda r: r["slip"])
        slips = [r["slip"] for r in mine]
        squares = dict(marker="s", mfc="none", capsize=3, color=colour)
        pull.errorbar(slips, [r["fx_over_fz"] for r in mine], [2 * r["fx_over_fz_error"] for r in mine],
                      label=f"{kind} computed", **squares)
        sink.errorbar(slips, [r["sinkage_mm"] for r in mine], [2 * r["sinkage_error_mm"] for r in mine], **squares)
        sink.plot(slips, [r["sinkage_from_mass_mm"] for r in mine], ":", color=colour, label=f"{kind}, from the level of the mass")
    pull.axhline(0, color="grey", lw=0.5)
    pull.set(xlabel="slip", ylabel="Fx/Fz", title="wheel: tractive force")
    sink.set(xlabel="slip", ylabel="sinkage [mm]", title="wheel: sinkage", ylim=(0, None))
    for axes in (plates, pull, sink):
        axes.legend(fontsize=7)
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=75)
    plt.close(figure)
