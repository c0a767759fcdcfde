#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cross-checks: the same test on grains and on continuum, side by side.

  inputs/crosscheck/run [CASE...] [--ground continuum|grains] [--results FOLDER] [--furrow-build FOLDER] [--evaluate]

Makes the runs of cases.csv that are not there yet (it may be stopped and started again at any time), lays both grounds beside each other with
furrow-post and writes results.csv, README.md's tables and the figures of this folder. --ground: makes the runs of one ground only.
--evaluate: only what is there, no runs.
"""
import argparse, csv, dataclasses, hashlib, json, math, os, pathlib, resource, subprocess, sys, time

here = pathlib.Path(__file__).resolve().parent
project = here.parents[1]
sys.path.insert(0, str(project / "postproc"))

import numpy as np

from furrow_post import compare, compare_figures, conditions, cost_table, curves, empirical
from furrow_post.results import ResultsError
from furrow_post.summary import with_error

MEASURED_OEDOMETER = project / "inputs" / "validation" / "snow_oedometer" / "reference.csv"
CHECKS = ("base", "size", "packing", "domain")  # runs that say how sure the base is
PRESSURE = 179e3  # Pa, for NRMM
BEKKER = ("LLL dry sand", "LETE sand")                                  # grounds of postproc/furrow_post/terrains.csv for cases on sand
WONG_REECE = ("Wong-Reece loose sand", "Wong-Reece compact sand")


def cases():
    with open(here / "cases.csv", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def folder_of(row, results):
    return results / row["case"] / f"{row['ground']}_{row['role'].replace('=', '_')}"


def finished(folder):
    return (folder / "run.json").is_file()


def program_of(folder):
    """First digits of the SHA-256 of the executable that made a run."""
    return json.loads((folder / "run.json").read_text()).get("program", "")


def formulas(case, run):
    """short name -> Prediction of the case's formulas, None where they are out of range."""
    c, found = run.conditions, {}
    if "snow" in case:
        wanted = [("NRMM", lambda: empirical.nrmm(c["load"].value, run.radius, c["wheel_width"].value, c["depth"].value, c["density"].value, PRESSURE))]
    else:
        place = (c["load"].value, c["wheel_diameter"].value, c["wheel_width"].value)
        wanted = [(f"Bekker, {name}", lambda name=name: empirical.bekker(*place, empirical.terrain(name))) for name in BEKKER]
        wanted += [(name, lambda name=name: empirical.wong_reece(*place, 0.0, empirical.terrain(name))) for name in WONG_REECE]
    for name, formula in wanted:
        try:
            found[name] = dataclasses.replace(formula(), method=name)
        except ResultsError:  # out of range, or the ground does not carry the load
            found[name] = None
    return found


def make(row, folder, build):
    """Runs one line; writes run.json with its CPU time when it came to its end."""
    folder.mkdir(parents=True, exist_ok=True)
    variables = dict(word.split("=", 1) for word in row["variables"].split())
    if row["script"] == "point":
        path = folder / "path.yaml"
        path.write_text(f"title: {variables['material']}\nmaterial: {project / 'inputs' / 'materials' / variables['material']}.yaml\n"
                        f"path: {{type: confined, stress: [1e3, 1e4, 1e5, {variables.get('stress', '5e5')}], steps: 80}}\n")
        command = [str(build / "bin" / "furrow-point"), "run", str(path), "-o", str(folder), "--no-plot"]
    else:
        source = project / "inputs" / "laboratory" if row["script"] == "laboratory" else here
        script = source / ("oedometer.lig" if row["script"] == "laboratory" else row["script"] + ".lig")
        command = [str(build / "bin" / "furrow"), "-in", str(script), "-log", str(folder / "log.liggghts"), "-var", "here", str(source),
                   "-var", "results", str(folder)]
        for name, value in variables.items():
            command += ["-var", name, value]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.time()
    with open(folder / "screen.txt", "w", encoding="utf-8") as screen:
        status = subprocess.run(command, cwd=folder, stdout=screen, stderr=subprocess.STDOUT).returncode
    if status:
        sys.exit(f"{folder} failed; the last lines of its screen.txt:\n" + "\n".join((folder / "screen.txt").read_text().splitlines()[-5:]))
    cpu = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    program = hashlib.sha256(pathlib.Path(command[0]).read_bytes()).hexdigest()[:12]
    (folder / "run.json").write_text(json.dumps({"cpu_time": round(cpu, 3), "wall_time": round(time.time() - start, 3), "program": program}))
    print(f"{folder.parent.name}/{folder.name}: {cpu:.0f} s", flush=True)


def wheels(case, rows, results, lines, out):
    """Pairs of wheel runs with the errors of the case's own checks; series against NRMM."""
    runs = {}
    for row in rows:
        folder = folder_of(row, results)
        if finished(folder):
            runs[row["ground"], row["role"]] = conditions.read(folder, row["ground"])
    table = [cost_table.row_of(run) for (ground, role), run in runs.items() if role.split("=")[0] in CHECKS]
    if ("continuum", "base") not in runs or ("grains", "base") not in runs:
        return
    for _, role in [key for key in runs if key[1].startswith("law=")]:  # another law: beside the same grains
        runs.setdefault(("grains", role), runs["grains", "base"])
    roles = [role for role in dict.fromkeys(row["role"] for row in rows) if ("continuum", role) in runs and ("grains", role) in runs
             and (role == "base" or role.split("=")[0] not in CHECKS)]
    named = list(formulas(case, runs["continuum", "base"]))
    lines += [f"## {case.replace('_', ' ')}", ""]
    head = "NRMM" if named == ["NRMM"] else "by formula"
    lines += [f"| | sinkage mm: continuum | grains | {head} | coefficient: continuum | grains | {head} | agree in |", "|---" * 8 + "|"]
    for role in roles:
        pair = [runs["continuum", role], runs["grains", role]]
        predicted = formulas(case, pair[0])
        formula = [p for p in predicted.values() if p]
        result = compare.compare(pair, table, formula, anyway=True)
        for difference in result.differences:
            lines.append(f"| {role}: {difference[0]} differs: {difference[1]} | | | | | | | |")
        cells = [role.replace("=", " ")]
        for quantity, (_, _, scale) in compare.QUANTITIES.items():
            for entry in result.of(quantity, "run"):
                cells.append(with_error(scale * entry.value, scale * entry.uncertainty))
                out.append([case, role, entry.source, quantity, f"{entry.value:.6g}", f"{entry.uncertainty:.3g}"] +
                           [f"{getattr(entry.parts, p):.3g}" if math.isfinite(getattr(entry.parts, p)) else "" for p in entry.parts.NAMES] +
                           [f"{entry.cpu_time:.4g}", program_of(runs[entry.source, role].folder)])
            found = {e.source: f"{scale * e.value:.3g}" for e in result.of(quantity, "formula")}
            cells.append(", ".join(found.get(name, "out of range") for name in named))
            out += [[case, role, name, quantity, f"{e.value:.6g}"] + [""] * 7 for name in named for e in result.of(quantity, "formula") if e.source == name]
        open_ = [text.split(":")[0] for text, _ in result.verdicts if "cannot be told apart" in text]
        agree = [text.split(":")[0] for text, yes in result.verdicts if yes and text.split(":")[0] not in open_]
        cells.append((" and ".join(agree) or ("" if open_ else "neither")) + (f" too uncertain: {' and '.join(open_)}" if open_ else ""))
        lines.append("| " + " | ".join(cells) + " |")
        if role == "base":
            compare_figures.draw(result, here / f"{case}.png")
            base = result
    if len(named) > 1:
        lines += ["", "By formula: " + "; ".join(named) + "."]
    lines += ["", f"![{case}]({case}.png)", ""]
    if series_figure(case, runs, table):
        lines += [f"![{case}, series]({case}_series.png)", ""]
    lines += [compare.overall(base), ""] + [f"- {text}" for text, _ in base.verdicts] + [f"- besides: {t}" for t in base.besides] + [""]
    if len(table) > 2:
        cost_table.write(here / f"{case}_runs.csv", table, ["# Runs of the case with their size, domain, packing: what the errors above come from."])


def series_figure(case, runs, table):
    """Sinkage and coefficient of both grounds against what was varied; formulas where they are valid. False: nothing was varied."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from furrow_post.style import annotate_panel, save, use_style
    use_style()
    units = {"load": "load [N]", "depth": "depth [m]", "speed": "speed [m/s]"}
    units = {name: label for name, label in units.items() if any(role.startswith(name + "=") for _, role in runs)}
    if not units:
        return False
    known = cost_table.families(table)
    figure, panels = plt.subplots(2, len(units), figsize=(1 + 3.4 * len(units), 6), layout="constrained", sharex="col", squeeze=False)
    for column, (name, label) in enumerate(units.items()):
        for ground, colour in zip(("continuum", "grains"), compare_figures.COLOURS):
            picked = sorted((run.conditions[name].value, run) for (g, role), run in runs.items()
                            if g == ground and (role == "base" or role.startswith(name + "=")))
            for row, (quantity, (_, _, scale)) in enumerate(compare.QUANTITIES.items()):
                entries = [[e for e in compare.entries_of_run(run, known) if e.quantity == quantity][0] for _, run in picked]
                panels[row, column].errorbar([v for v, _ in picked], [scale * e.value for e in entries],
                                             [2 * scale * e.uncertainty for e in entries], fmt="o-", capsize=3, lw=1, color=colour, label=ground)
        points = {}
        for value, run in picked:
            for formula, prediction in formulas(case, run).items():
                if prediction:
                    points.setdefault(formula, []).append((value, prediction))
        for row, pick in enumerate((lambda p: 1e3 * p.sinkage, lambda p: p.coefficient)):
            for (formula, found), marker in zip(points.items(), "s^vD"):
                panels[row, column].plot([v for v, _ in found], [pick(p) for _, p in found], marker, mfc="white", color="0.4", label=formula)
            panels[row, column].set_ylim(0, None)
        panels[1, column].set_xlabel(label)
        annotate_panel(panels[0, column], "abc"[column], f"against {name}")
    panels[0, 0].set_ylabel("sinkage [mm]")
    panels[1, 0].set_ylabel("resistance coefficient")
    panels[0, 0].legend(fontsize=8)
    save(figure, here / f"{case}_series.png", dpi=110)
    return True


def curve_case(case, rows, results, lines, out):
    read = lambda row: curves.read(folder_of(row, results), f"{row['ground']}{'' if row['role'] == 'base' else ' ' + row['role'].split('=')[-1]}")
    is_check = lambda row: row["role"] != "base" and row["role"].split("=")[0] in CHECKS
    done = [row for row in rows if finished(folder_of(row, results))]
    shown = [row for row in done if not is_check(row)]
    found = [read(row) for row in shown]
    if len(found) < 2:
        return
    result = curves.compare(found, anyway=True)
    errors = [curves.numerical_errors(c, [read(r) for r in done if is_check(r) and r["ground"] == row["ground"] and row["role"] == "base"], result.levels)
              for c, row in zip(found, shown)]
    measured, beside = None, []
    if found[0].kind == "oedometer":
        from furrow_post.laboratory import read_reference
        # Log strains of the measurements are counted from 210 kg/m3
        measured = [(rho / 210, s) for rho, s in read_reference(MEASURED_OEDOMETER) if s <= 5e5] if "snow" in case else None
    elif "sand" in case:
        z = np.linspace(1e-3, found[0].x[-1], 60)
        # b of a round plate is its radius
        beside = [(f"Bekker, {name}", z, empirical.terrain(name).plate_pressure(z, 0.5 * found[0].facts["size"])) for name in BEKKER]
    curves.draw(result, here / f"{case}.png", measured, beside)
    plate = found[0].kind == "plate"
    heads = [f"{c.label}, {'kPa' if plate else 'density ratio'}" for c in result.curves] + [f"{label}, kPa" for label, _, _ in beside]
    lines += [f"## {case.replace('_', ' ')}", "", f"| {'sinkage mm' if plate else 'axial stress kPa'} | " + " | ".join(heads) + " |",
              "|---" * (len(heads) + 1) + "|"]
    totals = [np.sqrt(np.nansum([np.square(e) for e in error.values()] + [(n / v) ** 2], axis=0)) if np.isfinite(error["size"]).any() else None
              for error, n, v in zip(errors, result.errors.T, result.values.T)]
    totals = [None if t is None else np.where(np.isfinite(error["size"]), t, np.nan) for t, error in zip(totals, errors)]
    for level, values, row in zip(result.levels, result.values, range(len(result.levels))):
        cells = [f"{1e-3 * v:.3g}" if plate else f"{v:.4g}" for v in values]
        cells = [with_error(1e-3 * v, 1e-3 * v * t[row]) if plate and t is not None and t[row] > 0 else cell for cell, v, t in zip(cells, values, totals)]
        cells += [f"{1e-3 * np.interp(level, x, y):.3g}" for _, x, y in beside]
        lines.append(f"| {1e3 * level if plate else 1e-3 * level:.3g} | " + " | ".join(cells) + " |")
        for k, (c, v) in enumerate(zip(result.curves, values)):
            parts = [v * errors[k][name][row] for name in ("size", "domain", "packing")]
            total = totals[k]
            out.append([case, f"{level:.4g}", c.label, "pressure" if plate else "density_ratio", f"{v:.6g}", f"{v * total[row]:.3g}" if total is not None and total[row] >= 0 else "",
                        f"{result.errors[row, k]:.3g}" if plate else ""] + [f"{p:.3g}" if math.isfinite(p) else "" for p in parts] +
                       [f"{json.loads((folder_of(shown[k], results) / 'run.json').read_text())['cpu_time']:.4g}", program_of(folder_of(shown[k], results))])
        out += [[case, f"{level:.4g}", label, "pressure", f"{np.interp(level, x, y):.6g}"] + [""] * 7 for label, x, y in beside]
    lines += [""] + [f"- differs: {d}" for d in result.differences] + [f"- {v}" for v in result.verdicts]
    lines += [f"- {curves.judge(result, k, errors)}" for k in range(1, len(found)) if plate and totals[0] is not None and totals[k] is not None]
    lines += ["", f"![{case}]({case}.png)", ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    table = cases()
    names = list(dict.fromkeys(row["case"] for row in table))
    parser.add_argument("cases", nargs="*", metavar="CASE", help=", ".join(names))
    parser.add_argument("--results", type=pathlib.Path, default=project / "results" / "crosscheck")
    parser.add_argument("--furrow-build", type=pathlib.Path, default=pathlib.Path(os.environ.get("FURROW_BUILD", project / "build")))
    parser.add_argument("--ground", choices=("continuum", "grains"))
    parser.add_argument("--evaluate", action="store_true")
    arguments = parser.parse_args()
    unknown = set(arguments.cases) - set(names)
    if unknown:
        parser.error(f"there is no case {', '.join(sorted(unknown))}; there are {', '.join(names)}")
    results = arguments.results.resolve()
    table = [row for row in table if not arguments.cases or row["case"] in arguments.cases]
    if not arguments.evaluate:
        for row in table:
            if arguments.ground in (None, row["ground"]) and not finished(folder_of(row, results)):
                make(row, folder_of(row, results), arguments.furrow_build)
    lines, out = [], []
    for case in dict.fromkeys(row["case"] for row in table):
        rows = [row for row in table if row["case"] == case]
        (wheels if any(row["script"].startswith(("wheel", "tyre")) for row in rows) else curve_case)(case, rows, results, lines, out)
    if arguments.cases:
        print("\n".join(lines))
        return
    with open(here / "results.csv", "w", encoding="utf-8", newline="") as file:
        file.write("# written by ./run; SI units, uncertainties are standard deviations; empty: not known; program: of the executable, SHA-256\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow("case,place,ground,quantity,value,uncertainty,time,size,domain,packing,cpu_time,program".split(","))
        writer.writerows(out)
    page = here / "README.md"
    head = page.read_text(encoding="utf-8").split("<!-- written by ./run -->")[0]
    page.write_text(head + "<!-- written by ./run -->\n\n" + "\n".join(lines) + "\n", encoding="utf-8")
    print(page)


if __name__ == "__main__":
    try:
        main()
    except ResultsError as error:
        sys.exit(f"inputs/crosscheck/run: {error}")
