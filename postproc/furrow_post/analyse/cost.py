# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post cost: error against cost of the runs of one scene, and which to take for a wanted error."""

import csv
import math
from dataclasses import dataclass

import numpy as np

from . import cost_table
from .compare import duration
from .results import ResultsError


@dataclass
class Assessed:
    """A run with its relative numerical error, worst of sinkage and coefficient."""

    row: cost_table.Row
    errors: dict       # quantity -> relative error, NaN: not known
    parts: dict        # quantity -> Components
    references: dict   # quantity -> value at size zero, of the wanted wheel
    models: dict       # quantity -> relative error of standing in for the wanted wheel; 0 of that wheel itself
    pareto: bool = False

    @property
    def error(self):
        return max(self.errors.values()) if all(math.isfinite(e) for e in self.errors.values()) else math.nan

    @property
    def worst(self):
        return max(self.errors, key=lambda q: self.errors[q])


def assess(rows, wheel=""):
    """Every base run of every family, with its error against the value at size zero of its own family.

    wheel: the one that is wanted. A run of another wheel errs besides by the difference of the two families' values at size zero on its ground.
    """
    found = []
    families = cost_table.families(rows)
    for family in families.values():
        ground, kind = family.rows[0].ground, family.rows[0].wheel
        target = family if kind == (wheel or kind) else next((f for key, f in families.items() if (key[0], key[2]) == (ground, wheel)), None)
        for row in family.bases:
            errors, parts, references, models = {}, {}, {}, {}
            for quantity in cost_table.QUANTITIES:
                value, time_error = row.value(quantity)
                component = family.components(quantity, row.size, time_error)
                own, own_error = family.reference(quantity)
                reference, reference_error = target.reference(quantity) if target else (own, math.nan)
                models[quantity] = abs(own - reference) / abs(reference)
                if target is not family:
                    reference_error = math.hypot(reference_error, own_error)
                parts[quantity], references[quantity] = component, reference
                # A value at size zero that noise leaves open by more than half of itself says nothing about errors.
                resolved = math.isfinite(component.size) and reference_error < 0.5 * abs(reference)
                total = math.hypot(component.total, reference_error, own - reference) if resolved else math.nan
                errors[quantity] = total / abs(reference)
            found.append(Assessed(row, errors, parts, references, models))
    ordered = sorted((a for a in found if math.isfinite(a.error)), key=lambda a: (a.row.cpu_time, a.error))
    best = math.inf
    for a in ordered:
        a.pareto = a.error < best
        best = min(best, a.error)
    return sorted(found, key=lambda a: (a.row.family, a.row.cpu_time))


def recommend(assessed, error, grounds=None):
    """(cheapest run within the relative error, or the one with the least error; whether it is within)."""
    known = [a for a in assessed if math.isfinite(a.error) and (grounds is None or a.row.ground in grounds)]
    if not known:
        raise ResultsError("no family of the table has two sizes whose difference stands out from their noise, so that no error is known; "
                           "add a run of another size, or longer runs")
    within = [a for a in known if a.error <= error]
    return (min(within, key=lambda a: a.row.cpu_time), True) if within else (min(known, key=lambda a: a.error), False)


def needed(assessed, error):
    """(ground, model, wheel), size [m] and CPU time [s] at which a family's fits come down to this error, cheapest first; the time by a
    power law through the family's runs. Beyond the table: an extrapolation."""
    found = []
    for key, family in cost_table.families([a.row for a in assessed]).items():
        finest = min((a for a in assessed if a.row.family == key), key=lambda a: a.row.size)
        if not math.isfinite(finest.error) or len({row.size for row in family.bases}) < 2:
            continue
        sizes = []
        for quantity, parts in finest.parts.items():
            rest = math.sqrt(max((finest.errors[quantity] * finest.references[quantity]) ** 2 - parts.size**2, 0.0))
            room = (error * finest.references[quantity]) ** 2 - rest**2
            sizes.append(finest.row.size * math.sqrt(room) / parts.size if room > 0 and parts.size > 0 else 0.0)
        if min(sizes) > 0:
            h, t = np.log([row.size for row in family.bases]), np.log([row.cpu_time for row in family.bases])
            slope, level = np.polyfit(h, t, 1)
            found.append((key, min(sizes), float(np.exp(level + slope * math.log(min(sizes))))))
    return sorted(found, key=lambda item: item[2])


def describe(a):
    kind = "cells" if a.row.ground == "continuum" else "grains"
    return f"{a.row.ground}, {kind} of {1e3 * a.row.size:.3g} mm, {a.row.model} model, {a.row.wheel}"


def advice(assessed, error, grounds=None):
    """Sentences: the choice and why."""
    try:
        choice, within = recommend(assessed, error, grounds)
    except ResultsError as trouble:
        return [f"No recommendation: {trouble}."]
    lines = [f"For {100 * error:g} % error use {describe(choice)}: it takes {duration(choice.row.cpu_time)} of one core, "
             f"error {100 * choice.error:.0f} % ({choice.worst})." if within else
             f"No run of the table reaches {100 * error:g} %; the best is {describe(choice)}: {100 * choice.error:.0f} % "
             f"({choice.worst}), {duration(choice.row.cpu_time)} of one core."]
    if not within:
        for (ground, model, wheel), size, seconds in needed(assessed, error)[:1]:
            lines.append(f"By its fit, {ground} would need {'cells' if ground == 'continuum' else 'grains'} of about {1e3 * size:.2g} mm and "
                         f"{duration(seconds)} of one core: an extrapolation.")
    for ground in sorted({a.row.ground for a in assessed} - {choice.row.ground}):
        try:
            other, ok = recommend(assessed, error, {ground})
        except ResultsError:
            lines.append(f"{ground.capitalize()}: error not known.")
            continue
        lines.append(f"{ground.capitalize()}: {'at the least' if ok else 'at best'} {describe(other)}, {100 * other.error:.0f} %, "
                     f"{duration(other.row.cpu_time)}.")
    return lines


def text(assessed, error):
    wide = max(len(a.row.run) for a in assessed)
    lines = [f"{'run':{wide}}  {'ground':10} {'model':6} {'wheel':12} {'size':>7} {'sinkage':>9} {'error':>7} {'coeff.':>8} {'error':>7} "
             f"{'cost':>9}"]
    percent = lambda e: f"{100 * e:.1f} %" if math.isfinite(e) else "?"
    for a in assessed:
        r = a.row
        lines.append(f"{r.run:{wide}}  {r.ground:10} {r.model:6} {r.wheel:12} {1e3 * r.size:4.3g} mm {1e3 * r.sinkage:6.1f} mm "
                     f"{percent(a.errors['sinkage']):>7} {r.coefficient:8.4f} {percent(a.errors['coefficient']):>7} "
                     f"{duration(r.cpu_time):>9}{'  *' if a.pareto else ''}")
    lines += ["", "Errors are numerical: time average, size (against the value at size zero of the same ground, first order), domain and packing",
              "where the table has runs for them. They do not hold what the law or the grains' contact lack. * nothing is cheaper and better,",
              "? the value at size zero is lost in the noise of the time averages, or there is one size only.",
              "", *advice(assessed, error)]
    return "\n".join(lines)


def write_csv(path, assessed):
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write("# relative numerical errors, CPU seconds of one core; empty: not known\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["run", "ground", "model", "wheel", "size_m", "cpu_time_s", "pareto", "error_sinkage", "error_coefficient"] +
                        [f"{q}_{part}" for q in cost_table.QUANTITIES for part in cost_table.Components.NAMES])
        number = lambda v: f"{v:.6g}" if math.isfinite(v) else ""
        for a in assessed:
            writer.writerow([a.row.run, *a.row.family, number(a.row.size), number(a.row.cpu_time), int(a.pareto)] +
                            [number(a.errors[q]) for q in cost_table.QUANTITIES] +
                            [number(getattr(a.parts[q], part)) for q in cost_table.QUANTITIES for part in cost_table.Components.NAMES])


def draw(assessed, error, target):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import LogLocator, NullFormatter

    from .compare_figures import COLOURS
    from .style import annotate_panel, save, use_style

    use_style()
    families = sorted({a.row.family for a in assessed})
    colour = {f: COLOURS[k % len(COLOURS)] for k, f in enumerate(families)}
    figure, panels = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
    for a in assessed:
        if math.isfinite(a.error):
            place, shade = (a.row.cpu_time, 100 * a.error), colour[a.row.family]
            panels[0].plot(*place, "o", ms=7, color=shade, mfc=shade if a.pareto else "white")
            panels[0].annotate(f"{1e3 * a.row.size:.3g} mm", place, (6, 4), textcoords="offset points", fontsize=8, color="0.3")
    front = sorted((a for a in assessed if a.pareto), key=lambda a: a.row.cpu_time)
    panels[0].plot([a.row.cpu_time for a in front], [100 * a.error for a in front], color="0.6", lw=1, zorder=0, drawstyle="steps-post")
    panels[0].axhline(100 * error, color="0.4", lw=0.8, ls=(0, (6, 4)))
    panels[0].set(xscale="log", yscale="log", xlabel="CPU time of one core [s]", ylabel="numerical error [%], worst of both")
    panels[0].margins(0.15)
    for axis in (panels[0].xaxis, panels[0].yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(NullFormatter())
    annotate_panel(panels[0], "a", "error against cost")
    panels[0].text(0.03, 0.03, "filled: nothing is cheaper and better; dashed: wanted", transform=panels[0].transAxes, fontsize=7, color="0.4")
    for axes, quantity, letter, name, scale in ((panels[1], "sinkage", "b", "sinkage [mm]", 1e3),
                                                (panels[2], "coefficient", "c", "resistance coefficient", 1.0)):
        for key, family in cost_table.families([a.row for a in assessed]).items():
            h = np.array([r.size for r in family.bases])
            f, u = (scale * np.array(column) for column in zip(*(r.value(quantity) for r in family.bases)))
            axes.errorbar(1e3 * h, f, yerr=2 * u, fmt="o", color=colour[key], capsize=3, label=", ".join(key))
            fit = family.fit(quantity)
            if fit:
                line = np.array([0, h.max()])
                axes.plot(1e3 * line, scale * (fit[0] + fit[1] * line), color=colour[key], lw=1, ls="--")
                axes.errorbar(0, scale * fit[0], yerr=2 * scale * fit[2], fmt="D", mfc="white", color=colour[key], capsize=3)
        axes.set(xlabel="size of cells or grains [mm]", ylabel=name)
        annotate_panel(axes, letter, f"{name.split(' [')[0]} to size zero")
    panels[1].legend(fontsize=8)
    save(figure, target)
