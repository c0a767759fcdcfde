# SPDX-License-Identifier: GPL-2.0-or-later
"""Comparison of curves: pressure against sinkage of plates, compression against stress of oedometers; grains, continuum, measured.

A plate's folder has curve.txt (fix ave/time: step, sinkage [m], force [N], pressure [Pa]) and facts.txt (name value pairs); an oedometer's is
one of inputs/laboratory, or one of furrow-point (point.csv).
"""

import csv
import math
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from .laboratory import Point, Test, cell_curve
from .results import ResultsError
from .style import annotate_panel, save, use_style

PLATE_LEVELS = (0.05, 0.1, 0.2, 0.3, 0.5)          # sinkage over depth of the ground
STRESS_LEVELS = (2e3, 1e4, 5e4, 1e5, 2e5, 5e5)     # Pa
COVERAGE = 2.0                                     # standard deviations within which two values agree
VAGUE = 0.4                                        # beyond this uncertainty of ln(y), 50 %, agreement says nothing
TOLERANCES = {"size": 0.02, "depth": 0.06, "density": 0.1, "speed": 0.02}


@dataclass
class Curve:
    """x rising, y; kind "plate" (sinkage [m], pressure [Pa]) or "oedometer" (axial stress [Pa], density over that at the start)."""

    label: str
    kind: str
    ground: str
    x: np.ndarray
    y: np.ndarray
    facts: dict
    noise: np.ndarray  # standard deviation about the smoothed curve


def is_curve(folder):
    folder = Path(folder)
    return (folder / "facts.txt").is_file() or (folder / "point.csv").is_file()


def _smoothed(x, y, parts=40):
    """Means over equal stretches and the standard error of each."""
    groups = [g for g in np.array_split(np.arange(len(x)), min(parts, len(x))) if len(g)]
    mean = lambda v: np.array([v[g].mean() for g in groups])
    error = np.array([y[g].std(ddof=1) / math.sqrt(len(g)) if len(g) > 1 else 0.0 for g in groups])
    return mean(x), mean(y), error


def read(folder, label=None):
    folder = Path(folder)
    if (folder / "point.csv").is_file():
        point = Point(folder)
        stress, rho = point.columns["axial_stress"], point.columns["density"]
        end = int(np.argmax(stress)) + 1
        rising = np.maximum.accumulate(stress[:end])
        keep = rising > 1.0
        facts = {"density": float(rho[0])}
        return Curve(label or point.label, "oedometer", "continuum", rising[keep], (rho[:end] / rho[0])[keep], facts, np.zeros(keep.sum()))
    test = Test(folder)
    facts = {key: float(value) for key, value in test.facts.items() if _number(value)}
    if test.kind == "plate":
        rows = test.curve()
        rows = rows[rows[:, 1] > 0]
        x, y, noise = _smoothed(rows[:, 1], rows[:, 3])
        return Curve(label or folder.name, "plate", test.facts.get("family", "grains"), x, y, facts, noise)
    if test.kind == "oedometer":
        _, stress, density = cell_curve(test.curve())
        axial = np.maximum.accumulate(np.maximum(stress[:, 2], 1e-3))
        end = int(np.argmax(stress[:, 2])) + 1
        facts["density"] = float(density[0])  # "density" of the facts is that of a grain's substance
        return Curve(label or test.label, "oedometer", "grains", axial[:end], density[:end] / density[0], facts, np.zeros(end))
    raise ResultsError(f"{folder}: compare takes plates and oedometers, not '{test.kind}'")


def _number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


@dataclass
class Result:
    curves: list
    levels: list
    values: np.ndarray   # (levels, curves)
    errors: np.ndarray
    verdicts: list = field(default_factory=list)
    differences: list = field(default_factory=list)


def compare(curves, anyway=False):
    """Values at common levels, first curve against the others. @raises ResultsError where tests are not the same"""
    if len({c.kind for c in curves}) > 1:
        raise ResultsError("these tests are not comparable: " + ", ".join(f"{c.label} is a {c.kind}" for c in curves))
    differences = []
    for name, relative in TOLERANCES.items():
        have = [(c.label, c.facts[name]) for c in curves if name in c.facts]
        if len(have) > 1 and max(v for _, v in have) - min(v for _, v in have) > relative * max(v for _, v in have):
            texts = "; ".join(f"{label}: {value:.4g}" for label, value in have)
            differences.append(f"{name}: {texts} (they may differ by {100 * relative:g} %)")
    if differences and not anyway:
        raise ResultsError("these tests are not comparable:\n  " + "\n  ".join(differences) +
                           "\n  --anyway compares them all the same, and says so")
    kind = curves[0].kind
    depth = curves[0].facts.get("depth", 1.0)
    wanted = [s * depth for s in PLATE_LEVELS] if kind == "plate" else list(STRESS_LEVELS)
    levels = [v for v in wanted if all(c.x[0] <= v <= c.x[-1] for c in curves)]
    if not levels:
        raise ResultsError("these tests have no common range: " + "; ".join(f"{c.label}: {c.x[0]:.3g} to {c.x[-1]:.3g}" for c in curves))
    at = np.log if kind == "oedometer" else (lambda v: v)
    values = np.array([[np.interp(at(v), at(c.x), c.y) for c in curves] for v in levels])
    errors = np.array([[np.interp(at(v), at(c.x), c.noise) for c in curves] for v in levels])
    result = Result(curves, levels, values, errors, differences=differences)
    for k, curve in enumerate(curves[1:], 1):
        ratio = np.log(values[:, k] / values[:, 0])
        rms = float(np.sqrt(np.mean(ratio**2)))
        worst = int(np.argmax(np.abs(ratio)))
        what = "pressure at equal sinkage" if kind == "plate" else "compression (density over that at the start) at equal stress"
        percent = lambda logarithm: f"{100 * (math.exp(logarithm) - 1):+.0f} %"
        result.verdicts.append(f"{what}: {curve.label} differs from {curves[0].label} by {percent(ratio.mean())} on average, rms ln-ratio {rms:.3f}, "
                               f"most at {_level(kind, levels[worst])}: {percent(ratio[worst])}")
    return result


def numerical_errors(base, checks, levels):
    """Relative standard deviation of base's y at levels by what checks vary: {"size": .., "domain": .., "packing": ..} of arrays, NaN: not known.

    checks are curves of the same test; a check with another size (facts cell or diameter) and base's seed gives the error of the size, of first
    order as in cost_table; one with another box the error of the domain; else it is another packing. The last two are differences from the
    curve of the same size.
    """
    size = lambda c: c.facts.get("cell", c.facts.get("diameter", math.nan))
    box = lambda c: c.facts.get("box", math.nan)
    # of no size and box: facts that are not numbers, or are not there, differ in nothing
    same = lambda a, b: not abs(a - b) > 0.02 * abs(a)

    def log(curve):
        """ln y at the levels; NaN beyond the curve's ends and where it carries nothing yet."""
        y = np.interp(levels, curve.x, curve.y, left=math.nan, right=math.nan)
        return np.log(np.where(y > 0, y, math.nan))

    found = {name: np.full(len(levels), np.nan) for name in ("size", "domain", "packing")}
    series = [base]
    for check in checks:
        if not same(size(base), size(check)) and all(not same(size(c), size(check)) for c in series):
            series.append(check)
    if len(series) > 1:
        h = np.array([size(c) for c in series])
        slope = (h - h.mean()) @ np.array([log(c) for c in series]) / np.sum((h - h.mean()) ** 2)
        found["size"] = np.abs(slope) * size(base)
    for check in checks:
        if any(check is c for c in series):
            continue
        twin = next((c for c in series if same(size(c), size(check))), None)
        if twin is None:
            continue
        difference = np.abs(log(check) - log(twin))
        # two packings: the standard deviation of one is the difference over sqrt(2)
        name, value = ("packing", difference / math.sqrt(2)) if same(box(twin), box(check)) else ("domain", difference)
        found[name] = np.fmax(found[name], value)
    if base.ground == "continuum":
        found["packing"] = np.zeros(len(levels))  # a lattice: nothing is random
    return found


def judge(result, k, errors):
    """A sentence: at which levels curve k agrees with the first within twice the known errors, or cannot be told from it. errors: one dict of numerical_errors a curve."""
    total = np.zeros(len(result.levels))
    lacking = []
    for c, column in ((0, errors[0]), (k, errors[k])):
        for name, value in column.items():
            total += np.nan_to_num(value) ** 2
            if np.isnan(value).all():
                lacking.append(f"{name} of {result.curves[c].label}")
        total += (result.errors[:, c] / result.values[:, c]) ** 2
    allowed = COVERAGE * np.sqrt(total)
    near = np.abs(np.log(result.values[:, k] / result.values[:, 0])) <= allowed
    vague = near & (allowed > VAGUE)
    words = []
    for which, text in ((near & ~vague, "agree within their uncertainty"), (vague, "cannot be told apart"), (~near, "differ")):
        if which.any():
            where = "every level" if which.all() else ", ".join(_level(result.curves[0].kind, v) for v, yes in zip(result.levels, which) if yes)
            words.append(f"{text} at {where}")
    words = "; ".join(words)
    span = f"{100 * allowed.min():.0f}" + (f" to {100 * allowed.max():.0f}" if f"{100 * allowed.min():.0f}" != f"{100 * allowed.max():.0f}" else "")
    return f"{result.curves[0].label} and {result.curves[k].label} {words} (allowed {span} %)" + \
        (f"; not known: {', '.join(lacking)}" if lacking else "")


def _level(kind, value):
    return f"{1e3 * value:.3g} mm" if kind == "plate" else f"{value / 1e3:.3g} kPa"


def text(result):
    kind = result.curves[0].kind
    wide = max([len(c.label) for c in result.curves] + [12])
    scale, unit = (1e-3, "kPa") if kind == "plate" else (1.0, "density over that at the start")
    head = "".join(f"{c.label:>{wide + 2}}" for c in result.curves)
    lines = [f"{'sinkage' if kind == 'plate' else 'axial stress':14}{head}   [{unit}]"]
    for level, row in zip(result.levels, result.values):
        lines.append(f"{_level(kind, level):14}" + "".join(f"{scale * v:{wide + 2}.4g}" for v in row))
    lines += [""] + [f"COMPARED ALTHOUGH THEY DIFFER: {d}" for d in result.differences] + ["Verdict"] + [f"  - {v}" for v in result.verdicts]
    return "\n".join(lines)


def write(result, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "compare.txt").write_text(text(result) + "\n", encoding="utf-8")
    with open(folder / "compare.csv", "w", encoding="utf-8", newline="") as file:
        file.write("# plate: sinkage [m], pressure [Pa]; oedometer: axial stress [Pa], density over that at the start\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["level"] + [c.label for c in result.curves])
        for level, row in zip(result.levels, result.values):
            writer.writerow([f"{level:.6g}"] + [f"{v:.6g}" for v in row])
    with h5py.File(folder / "compare.h5", "w") as content:
        for c in result.curves:
            group = content.create_group(f"curves/{c.label.replace('/', '_')}")
            group["x"], group["y"] = c.x, c.y
            group.attrs["kind"], group.attrs["ground"] = c.kind, c.ground


def draw(result, target, measured=None, formulas=()):
    """measured: (density ratio, stress) of an oedometer; formulas: (label, x, y) of lines to lay beside."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from .compare_figures import COLOURS

    use_style()
    kind = result.curves[0].kind
    figure, axes = plt.subplots(figsize=(6.4, 4.4), layout="constrained")
    for c, colour in zip(result.curves, COLOURS):
        if kind == "plate":
            axes.plot(1e3 * c.x, 1e-3 * c.y, color=colour, lw=1.4, label=c.label)
            axes.fill_between(1e3 * c.x, 1e-3 * (c.y - 2 * c.noise), 1e-3 * (c.y + 2 * c.noise), color=colour, alpha=0.2, lw=0)
        else:
            axes.semilogx(1e-3 * c.x, c.y, color=colour, lw=1.4, label=c.label)
    for (label, x, y), dashes in zip(formulas, ((6, 2), (2, 2), (6, 2, 1, 2), (1, 2))):
        axes.plot(1e3 * x, 1e-3 * y, color="0.45", lw=1.1, dashes=dashes, label=label)
    if formulas:  # a formula may lie far above: the runs keep their room
        axes.set_ylim(0, 1e-3 * 1.6 * max(c.y.max() for c in result.curves))
    if measured:
        axes.plot([1e-3 * s for _, s in measured], [ratio for ratio, _ in measured], "ko", ms=5, label="measured")
    axes.set(xlabel="sinkage [mm]" if kind == "plate" else "axial stress [kPa]",
             ylabel="mean pressure [kPa]" if kind == "plate" else "density over that at the start")
    axes.legend(fontsize=8)
    annotate_panel(axes, "a", "plate sinkage" if kind == "plate" else "confined compression")
    save(figure, target)
