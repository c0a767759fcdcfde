# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: tables, accuracy, pictures."""
import csv, json, math, pathlib, sys

import h5py
import matplotlib
import numpy as np

import study

matplotlib.use("Agg")
import matplotlib.pyplot as plt

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "postproc"))
from furrow_post import empirical, ground as furrow_ground

LOAD = study.LOAD_MASS * 9.80665  # N
RADIUS = 0.38                     # m, Table 11
PRESSURE = 179e3                  # Pa, contact pressure of the measured wheel's tyre, for NRMM


def finished(folder):
    """What run wrote about a run, or None."""
    done = folder / "done.json"
    return json.loads(done.read_text()) if done.exists() else None


def columns(path):
    with h5py.File(path, "r") as content:
        return {name: data[()] for name, data in content["history"].items()}


def evaluate(folder):
    """Means over the last WINDOW of travel; their errors from its two halves; energies a metre over the load; densities. None for a failed run."""
    done = finished(folder)
    if done is None:
        return None
    row = dict(run=folder.name, user_s=done["cost"]["user_s"], error=done["error"], cycle=done.get("remap_interval", done["job"]["variables"]["remap_interval"]))
    if done["error"]:
        return row
    wheel, ground, contact = columns(folder / "history.h5"), columns(folder / "ground.h5"), np.loadtxt(folder / "contact.txt")
    x = wheel["x"] - wheel["x"][0]
    start, end = x[-1] - study.WINDOW, x[-1]

    def means(low, high):
        part = (x >= low) & (x <= high)
        return np.array([wheel["sinkage"][part].mean(), -wheel["force_x"][part].sum() / wheel["force_z"][part].sum(), wheel["slip"][part].mean()])
    value, halves = means(start, end), [means(start, start + study.WINDOW / 2), means(start + study.WINDOW / 2, end)]
    error = 0.5 * np.abs(halves[1] - halves[0])
    row.update(sinkage_m=round(value[0], 4), sinkage_change_m=round(error[0], 4), resistance=round(value[1], 4),
               resistance_change=round(error[1], 4), slip=round(value[2], 3))

    def per_metre(time, energy):
        """Of the last WINDOW of travel, both halves of the model, over the load."""
        return round(float(np.diff(np.interp(np.interp([start, end], x, wheel["time"]), time, energy))[0] / study.WINDOW / LOAD), 4)
    row["snow"] = per_metre(ground["time"], 2 * (ground["stored_energy"] + ground["dissipated_energy"]))
    row["numerical"] = per_metre(ground["time"], 2 * ground["numerical_loss"])
    row["friction"] = per_metre(contact[:, 0] * 2e-4, contact[:, 1])
    snow = furrow_ground.Ground.read(folder)
    body = furrow_ground.Body(folder, snow)
    density = furrow_ground.densities(snow, body)
    row.update(density_under=round(density["under the wheel"]), density_shoulder=round(density["at the shoulder"]),
               density_behind=round(density["in the rut behind"]), rut_depth_m=round(rut_depth(snow, body), 3),
               particles=int(done["facts"]["particles"]), penetration_mm=round(1000 * done["facts"]["deepest_penetration"], 1))
    return row


def rut_depth(snow, body):
    """Of the finished rut, from the surface before to the highest particles in the middle half of its width [m]."""
    x, y = snow.x[:, 0] - body.centre[0] - furrow_ground.rut_place(snow, body), np.abs(snow.x[:, 1])
    inside = (np.abs(x) < furrow_ground.UNDER) & (y < 0.5 * body.half_width)
    squeeze = snow.undisturbed / snow.density[inside]
    return float(snow.level - (snow.x[inside, 2] + 0.5 * snow.spacing * squeeze).max())


# ---- measured rows ----------------------------------------------------------------------------------------------------------------------


def row_table(results):
    """The shared rows of Table 11, computed with the laws identified at zero slip and towed, and by NRMM (from its own and measured sinkage)."""
    table = []
    for r in study.reference():
        h, rho, z = r["depth_m"], r["density_kgm3"], r["sinkage_m"]
        own = empirical.nrmm_sinkage(h, rho, PRESSURE)
        row = dict(row=int(r["row"]), used="calibration" if study.is_calibration(r) else "prediction", depth_m=h, density_kgm3=int(rho),
                   sinkage_m=z, resistance=r["resistance"])
        for mode in study.LAWS:
            found = evaluate(results / study.row_name(mode, rho, h)) or {}
            row.update({f"{mode}_{what}": found.get(what, "") for what in ("sinkage_m", "resistance", "density_under", "density_shoulder")})
        row.update(nrmm_sinkage_m=round(own, 3), nrmm_resistance=round(empirical.nrmm_resistance(rho, study.WIDTH, RADIUS, own) / LOAD, 3),
                   nrmm_resistance_measured_sinkage=round(empirical.nrmm_resistance(rho, study.WIDTH, RADIUS, z) / LOAD, 3))
        table.append(row)
    return table


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


def accuracy(table, used, model):
    """rms and mean of computed minus measured over the rows of one use that were run."""
    chosen = [r for r in table if used in ("all", r["used"]) and r[f"{model}_sinkage_m"] != ""]
    out = dict(model=model, rows=f"{used}: {len(chosen)}")
    for what in ("sinkage_m", "resistance"):
        errors = [r[f"{model}_{what}"] - r[what] for r in chosen]
        out[f"{what}_rms"], out[f"{what}_mean"] = round(rms(errors), 4), round(sum(errors) / max(len(errors), 1), 4)
    if model == "nrmm":
        out["resistance_rms_from_measured_sinkage"] = round(rms([r["nrmm_resistance_measured_sinkage"] - r["resistance"] for r in chosen]), 4)
    return out


def compare(table, path):
    marks = {"zero_slip": ("o", "tab:red", "zero slip"), "towed": ("s", "tab:blue", "towed")}
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.8), constrained_layout=True)
    for axes, what, title in ((panels[0], "sinkage_m", "sinkage [m]"), (panels[1], "resistance", "resistance over load")):
        top = 1.08 * max(max(r[what], r[f"nrmm_{what}"], *(r[f"{mode}_{what}"] or 0 for mode in marks)) for r in table)
        axes.plot([0, top], [0, top], color="0.5", lw=0.8)
        for mode, (mark, colour, label) in marks.items():
            for used, fill in (("calibration", "none"), ("prediction", colour)):
                mine = [r for r in table if r["used"] == used and r[f"{mode}_{what}"] != ""]
                axes.plot([r[what] for r in mine], [r[f"{mode}_{what}"] for r in mine], mark, ms=5, color=colour, mfc=fill,
                          label=f"{label}, {'identified on' if fill == 'none' else 'predicted'}")
        axes.plot([r[what] for r in table], [r[f"nrmm_{what}"] for r in table], "x", ms=4, color="0.4", label="NRMM")
        axes.set(xlabel=f"measured {title}", ylabel=f"computed {title}", xlim=(0, top), ylim=(min(0, axes.get_ylim()[0]), top))
        axes.legend(frameon=False, fontsize=8)
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=90)
    plt.close(figure)


# ---- error against cost -------------------------------------------------------------------------------------------------------------------


def extrapolated(sizes, values):
    """Value at size zero, mean of the straight line in h and in h^2, and its uncertainty: half their difference plus the scatter about both."""
    guesses, scatter = [], 0.0
    for order in (1, 2):
        fit = np.polyfit(np.array(sizes) ** order, values, 1)
        guesses.append(fit[1])
        left = values - np.polyval(fit, np.array(sizes) ** order)
        scatter = max(scatter, float(np.sqrt((left**2).sum() / max(len(sizes) - 2, 1))))
    return float(np.mean(guesses)), 0.5 * abs(guesses[1] - guesses[0]) + scatter


def error_table(results):
    """Each change of one numerical choice beside the base; and size zero, for sinkage and resistance. Then the oedometer's law."""
    base = evaluate(results / study.ERROR_BASE)
    if not base or base["error"]:
        return [], {}

    def line(law, change, cells, found):
        return dict(law=law, change=change, cell_m=round(0.20 / cells, 4), **{k: v for k, v in found.items() if k != "run"})
    table = [line("towed", "base: cells of 4 cm, 8 particles", study.CELLS, base)]
    changed = {f"error_{name}": change for name, change in study.ERRORS.items()}
    changed |= {f"error_contact_{factor:g}": (f"contact springs times {factor:g}", {}) for factor in study.SPRINGS}
    table += [line("towed", what, changes.get("cells", study.CELLS), found) for name, (what, changes) in changed.items()
              if (found := evaluate(results / name))]
    grids = [r for r in table if not r["error"] and (r["cell_m"] != 0.04 or r is table[0])]
    limits = {}
    if len(grids) >= 3:
        for what in ("sinkage_m", "resistance"):
            limits[what] = extrapolated([r["cell_m"] for r in grids], np.array([r[what] for r in grids]))
    others = {"oedometer_towed": ("base: modulus softened by 0.25, springs 0.4", None)}
    others |= {f"error_oedometer_{name}": case for name, case in study.oedometer_errors().items()}
    table += [line("oedometer", what, round(0.20 / job["variables"]["cell"]) if job else study.CELLS, found) for name, (what, job) in others.items()
              if (found := evaluate(results / name))]
    return table, limits


def error_picture(table, limits, path):
    grids = sorted((r for r in table if r["law"] == "towed" and not r["error"] and (r["cell_m"] != 0.04 or r is table[0])), key=lambda r: -r["cell_m"])
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for axes, what, label in ((panels[0], "sinkage_m", "sinkage"), (panels[1], "resistance", "resistance coefficient")):
        limit, uncertain = limits[what]
        axes.errorbar([r["user_s"] for r in grids], [abs(r[what] - limit) / limit for r in grids], uncertain / limit, fmt="o-", capsize=3)
        for r in grids:
            axes.annotate(f"{100 * r['cell_m']:.3g} cm", (r["user_s"], abs(r[what] - limit) / limit), textcoords="offset points", xytext=(6, 6))
        axes.set(xscale="log", xlabel="cost [core seconds]", ylabel=f"error of {label}, relative",
                 title=f"{label}: {limit:.3f} ± {uncertain:.3f} at size zero", ylim=(0, None))
        axes.grid(alpha=0.3, which="both")
    figure.savefig(path, dpi=90)
    plt.close(figure)


# ---- all ------------------------------------------------------------------------------------------------------------------------------------


def write_table(path, rows):
    if not rows:
        return
    keys = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, keys, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def show(rows):
    if not rows:
        return
    keys = list(dict.fromkeys(key for row in rows for key in row))
    widths = {k: max(len(k), *(len(str(row.get(k, ""))) for row in rows)) for k in keys}
    print("  ".join(k.rjust(w) for k, w in widths.items()))
    for row in rows:
        print("  ".join(str(row.get(k, "")).rjust(w) for k, w in widths.items()))
    print()


def report(results, folder):
    """Writes results.csv, rows.csv, error.csv and the pictures into folder and prints them."""
    runs = [dict(stage="predict", **found) for name in study.prediction() if (found := evaluate(results / name))]
    runs += [dict(stage="check", **found) for name in ("towed_law_zero_slip", "zero_slip_law_towed") if (found := evaluate(results / name))]
    for mode in study.LAWS:
        runs += [dict(stage="rows", **found) for r in sorted({(r["density_kgm3"], r["depth_m"]) for r in study.reference()}, reverse=True)
                 if (found := evaluate(results / study.row_name(mode, *r)))]
    show(runs)
    write_table(folder / "results.csv", runs)
    table = row_table(results)
    show(table)
    write_table(folder / "rows.csv", table)
    compare(table, folder / "comparison.png")
    scores = [accuracy(table, used, model) for model in (*study.LAWS, "nrmm") for used in ("calibration", "prediction", "all")]
    show(scores)
    write_table(folder / "accuracy.csv", scores)
    errors, limits = error_table(results)
    print()
    show(errors)
    write_table(folder / "error.csv", errors)
    for what, (value, uncertain) in limits.items():
        print(f"size zero: {what} {value:.4f} +- {uncertain:.4f}")
    if limits:
        error_picture(errors, limits, folder / "error.png")
    section = results / study.row_name("towed", 220, 0.20)
    if finished(section):
        furrow_ground.draw(section, "field snow, identified; rigid wheel, towed", "", folder / "section.png", dpi=75)
