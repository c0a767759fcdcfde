# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post laboratory: what the tests of inputs/laboratory say: moduli, strengths, repose, run-out, each with its error.

Stress and strain: compression positive. A result is a Quantity; the standard errors of means are those of eight blocks of
the curve, those of fits come from the covariance of the residuals.
"""

import csv
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .results import ResultsError

GRAVITY = 9.80665


@dataclass
class Quantity:
    name: str
    value: float
    error: float
    unit: str
    meaning: str

    def line(self):
        return f"  {self.name:26} {self.value:12.5g} ± {self.error:<10.3g} {self.unit:6} {self.meaning}"


def block_mean(values, blocks=8):
    """Mean and its standard error from the means of blocks."""
    parts = [part.mean() for part in np.array_split(values, min(blocks, len(values)))]
    return float(np.mean(values)), float(np.std(parts, ddof=1) / np.sqrt(len(parts))) if len(parts) > 1 else float("nan")


def line_fit(x, y):
    """Slope, intercept and their covariance (2, 2) by least squares; two points have no residual, so no error: NaN."""
    design = np.column_stack((x, np.ones_like(x)))
    solution, *_ = np.linalg.lstsq(design, y, rcond=None)
    if len(x) < 3:
        return solution[0], solution[1], np.full((2, 2), np.nan)
    variance = np.sum((y - design @ solution) ** 2) / (len(x) - 2)
    return solution[0], solution[1], variance * np.linalg.inv(design.T @ design)


class Test:
    """One results folder of a laboratory scene: facts.txt (name value pairs) and its curve or dumps."""

    def __init__(self, folder):
        self.folder = Path(folder)
        try:
            words = (self.folder / "facts.txt").read_text().split()
        except OSError as error:
            raise ResultsError(f"{self.folder}: has no facts.txt; name the results folder of a laboratory test that came to its "
                               "end") from error
        self.facts = dict(zip(words[::2], words[1::2]))
        self.kind = self.facts.get("test", "")
        if self.kind not in EVALUATIONS:
            raise ResultsError(f"{self.folder / 'facts.txt'}: test '{self.kind}' is not one of {', '.join(EVALUATIONS)}")

    def number(self, name):
        return float(self.facts[name])

    @property
    def label(self):
        text = self.facts.get("ground", self.folder.name)
        return text + (f", {self.number('confinement') / 1e3:g} kPa" if "confinement" in self.facts else "")

    def curve(self):
        """Rows of curve.txt (fix ave/time) without the first, which has no forces yet."""
        rows = np.loadtxt(self.folder / "curve.txt")
        if rows.ndim != 2 or len(rows) < 10:
            raise ResultsError(f"{self.folder / 'curve.txt'}: has fewer than ten rows; was the run stopped?")
        return rows[1:]

    def grains(self, name):
        """(n, 4): x, y, z, radius [m] of a dump."""
        return np.loadtxt(self.folder / f"{name}.dump", skiprows=9)[:, 1:5]

    def evaluate(self):
        return EVALUATIONS[self.kind](self)


def cell_curve(rows):
    """Columns of a curve of fix cell/servo: strains (n, 3), stresses (n, 3), density (n)."""
    edges = rows[:, 1:4]
    return -np.log(edges / edges[0]), rows[:, 4:7], rows[:, 7]


def oedometer(test):
    strain, stress, density = cell_curve(test.curve())
    axial = stress[:, 2]
    loading = slice(0, int(np.argmax(axial)) + 1)
    quantities = [Quantity("initial_density", density[0], 0.0, "kg/m3", "at the start of the test")]
    lateral = 0.5 * (stress[loading, 0] + stress[loading, 1]) / np.maximum(axial[loading], 1e-30)
    late = axial[loading] > 0.5 * axial.max()
    quantities.append(Quantity("K0", *block_mean(lateral[late]), "", "lateral over axial stress, upper half of the stress"))
    for level in np.geomspace(1e3, 1e6, 7):
        if not axial[0] < level < axial.max():
            continue
        near = np.flatnonzero((axial[loading] > 0.7 * level) & (axial[loading] < 1.4 * level))
        if len(near) > 4:
            slope, _, covariance = line_fit(strain[loading, 2][near], axial[loading][near])
            quantities.append(Quantity(f"modulus_{level / 1e3:.3g}kPa", slope, np.sqrt(covariance[0, 0]), "Pa", "confined modulus"))
        value = np.interp(np.log(level), np.log(np.maximum.accumulate(np.maximum(axial[loading], 1.0))), density[loading])
        quantities.append(Quantity(f"density_{level / 1e3:.3g}kPa", value, 0.0, "kg/m3", "under this axial stress"))
    return quantities


def reference_error(test, reference, lowest=5e4, highest=1e6):
    """rms ln-errors of stress at given density, and of density at given stress, over [lowest, highest] Pa of a measured curve."""
    _, stress, density = cell_curve(test.curve())
    axial = np.maximum.accumulate(np.maximum(stress[:, 2], 1e-3))
    end = int(np.argmax(stress[:, 2])) + 1
    wanted = [(rho, sigma) for rho, sigma in reference if lowest <= sigma <= highest]
    measured = [(rho, sigma) for rho, sigma in wanted if sigma <= axial[end - 1] and rho <= density[end - 1]]
    if len(measured) < 2:
        raise ResultsError(f"{test.folder}: ends at {axial[end - 1]:.3g} Pa and {density[end - 1]:.3g} kg/m3, before two points of the reference")
    of_stress = [np.log(np.interp(rho, density[:end], axial[:end]) / sigma) for rho, sigma in measured]
    of_density = [np.log(np.interp(sigma, axial[:end], density[:end]) / rho) for rho, sigma in measured]
    rms = lambda values: float(np.sqrt(np.mean(np.square(values))))
    return [Quantity("rms_ln_stress", rms(of_stress), 0.0, "", f"of stress at the measured densities, {len(measured)} of {len(wanted)} points"),
            Quantity("rms_ln_density", rms(of_density), 0.0, "", "of density at the measured stresses")]


def triaxial(test):
    strain, stress, density = cell_curve(test.curve())
    lateral, axial = 0.5 * (stress[:, 0] + stress[:, 1]), stress[:, 2]
    deviator = axial - lateral
    window = max(len(deviator) // 40, 3)
    smooth = np.convolve(deviator, np.ones(window) / window, mode="valid")
    peak = int(np.argmax(smooth)) + window // 2
    around = slice(max(peak - window, 0), peak + window + 1)
    end = strain[:, 2] > 0.85 * strain[-1, 2]
    sine = deviator / np.maximum(axial + lateral, 1e-30)
    degrees = lambda part: tuple(np.degrees(np.array(block_mean(np.arcsin(np.clip(sine[part], -1, 1))))))
    half = int(np.argmax(deviator > 0.5 * smooth.max()))
    volume = strain.sum(axis=1)
    slope, _, covariance = line_fit(strain[around, 2], volume[around])
    return [
        Quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        Quantity("peak_deviator", *block_mean(deviator[around]), "Pa", f"at an axial strain of {strain[peak, 2]:.3f}"),
        Quantity("friction_angle_peak", *degrees(around), "deg", "without cohesion: sin = (s1 - s3)/(s1 + s3)"),
        Quantity("friction_angle_end", *degrees(end), "deg", f"mean over strains above {0.85 * strain[-1, 2]:.3f}"),
        Quantity("lateral_stress_end", *block_mean(lateral[end]), "Pa", "there"),
        Quantity("deviator_end", *block_mean(deviator[end]), "Pa", "there"),
        Quantity("E50", deviator[half] / max(strain[half, 2], 1e-12), 0.0, "Pa", "secant modulus to half of the peak"),
        Quantity("dilation", -slope, np.sqrt(covariance[0, 0]), "", "volume growth per axial strain at the peak"),
        Quantity("density_end", *block_mean(density[end]), "kg/m3", "there"),
        Quantity("inertial_number", float(np.mean(test.curve()[1:, 8])), 0.0, "", "below 1e-3: quasi-static"),
    ]


def shear(test):
    from scipy.optimize import curve_fit

    rows = test.curve()
    _, stress, density = cell_curve(rows)
    travel, tau, normal = rows[:, 8], rows[:, 9], stress[:, 2]
    window = max(len(tau) // 40, 3)
    smooth = np.convolve(tau, np.ones(window) / window, mode="valid")
    peak = int(np.argmax(smooth)) + window // 2
    around, end = slice(max(peak - window, 0), peak + window + 1), travel > 0.6 * travel[-1]
    degrees = lambda part: tuple(np.degrees(np.array(block_mean(np.arctan2(tau[part], normal[part])))))
    rise = slice(0, peak + 1)
    janosi = lambda j, top, length: top * (1 - np.exp(-j / length))
    (top, length), covariance = curve_fit(janosi, travel[rise], tau[rise], p0=(smooth.max(), max(travel[peak] / 3, 1e-6)),
                                          bounds=((0, 1e-9), (np.inf, np.inf)))
    return [
        Quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        Quantity("normal_stress", *block_mean(normal), "Pa", "mean of the test"),
        Quantity("peak_shear", *block_mean(tau[around]), "Pa", f"at a displacement of {travel[peak] * 1e3:.2f} mm"),
        Quantity("residual_shear", *block_mean(tau[end]), "Pa", "over the last 40 % of the travel"),
        Quantity("friction_angle_peak", *degrees(around), "deg", "without cohesion: tan = tau/sigma"),
        Quantity("friction_angle_end", *degrees(end), "deg", "the same, residual"),
        Quantity("janosi_K", length, float(np.sqrt(covariance[1, 1])), "m", "of tau_max (1 - exp(-j/K)), fitted up to the peak"),
        Quantity("janosi_tau_max", top, float(np.sqrt(covariance[0, 0])), "Pa", "of that fit"),
    ]


def thickness_profile(grains, distance, edges, areas, solid_fraction):
    """Solid volume over area in the bins, over the solid fraction of the bed: the height of the deposit [m]."""
    volume, _ = np.histogram(distance, bins=edges, weights=4 / 3 * np.pi * grains[:, 3] ** 3)
    return volume / areas / solid_fraction


def collapse(test):
    column, deposit = test.grains("column"), test.grains("deposit")
    diameter, r0 = test.number("diameter"), test.number("radius")
    volume = np.sum(4 / 3 * np.pi * column[:, 3] ** 3)
    # The column is uniform, so that its middle lies at half its height.
    h0 = 2.0 * np.average(column[:, 2], weights=column[:, 3] ** 3)
    fraction = volume / (np.pi * r0**2 * h0)
    middle = np.average(deposit[:, :2], axis=0)
    distance = np.hypot(*(deposit[:, :2] - middle).T)
    edges = np.arange(0.0, distance.max() + 2 * diameter, diameter)
    height = thickness_profile(deposit, distance, edges, np.pi * np.diff(edges**2), fraction)
    centre = 0.5 * (edges[1:] + edges[:-1])

    def radius_at(level):
        above = np.flatnonzero(height > level)
        last = above[-1]
        if last + 1 == len(height):
            return edges[-1]
        return centre[last] + diameter * (height[last] - level) / (height[last] - height[last + 1])

    final, wide, narrow = (radius_at(share * diameter) for share in (0.5, 0.25, 1.0))
    near = deposit[distance < 2 * diameter]
    top = np.percentile(near[:, 2] + near[:, 3], 95)
    aspect = h0 / r0
    expected = 1.24 * aspect if aspect < 1.7 else 1.6 * np.sqrt(aspect)
    runout, error = final / r0 - 1, 0.5 * (wide - narrow) / r0
    result = [
        Quantity("aspect", aspect, 0.0, "", "height over radius of the column"),
        Quantity("solid_fraction", fraction, 0.0, "", "of the column"),
        Quantity("runout", runout, error, "", "(r - r0)/r0; r where the deposit is half a grain thick (error: 1/4 to 1 grain)"),
        Quantity("runout_over_Lube", runout / expected, error / expected, "", "1.24 a (a < 1.7), 1.6 sqrt(a): Lube et al. 2004"),
        Quantity("height_over_r0", top / r0, 0.5 * diameter / r0, "", "top of the deposit"),
    ]
    if aspect > 1.7:
        result.append(Quantity("height_over_Lube", top / r0 / (0.88 * aspect ** (1 / 6)), 0.5 * diameter / r0, "", "0.88 a^(1/6)"))
    return result


def repose(test):
    deposit, diameter = test.grains("deposit"), test.number("diameter")
    length = test.number("length")
    bins = np.arange(0.0, length, 1.5 * diameter)
    x, y = deposit[:, 0], deposit[:, 1]

    def angle(part):
        where, top = [], []
        for low, high in zip(bins[:-1], bins[1:]):
            inside = part & (x >= low) & (x < high)
            if inside.any():
                where.append(0.5 * (low + high))
                top.append(np.max(deposit[inside, 2] + deposit[inside, 3]))
        where, top = np.array(where), np.array(top)
        slope = (where > 0.15 * length) & (where < 0.9 * length) & (top > 2 * diameter)
        return -np.degrees(np.arctan(np.polyfit(where[slope], top[slope], 1)[0]))

    thirds = np.array_split(np.argsort(y), 3)
    parts = [angle(np.isin(np.arange(len(x)), third)) for third in thirds]
    return [Quantity("angle_of_repose", angle(np.full(len(x), True)), float(np.std(parts, ddof=1) / np.sqrt(3)), "deg",
                     "slope of the highest grains; error from three slices")]


def plate(test):
    """Bekker's p = k z^n of one plate, on the rows of plate_on_sand's curve.txt."""
    rows = test.curve()
    z, pressure = rows[:, 1], rows[:, 3]
    size = test.number("size")
    late = (z > 0.1 * z.max()) & (pressure > 0)
    n, logk, covariance = line_fit(np.log(z[late]), np.log(pressure[late]))
    k = np.exp(logk)
    return [Quantity("bekker_n", n, np.sqrt(covariance[0, 0]), "", "of p = k z^n, from 10 % of the sinkage on"),
            Quantity("bekker_k", k, k * np.sqrt(covariance[1, 1]), "Pa/m^n", f"plate of {size * 1e3:g} mm"),
            Quantity("pressure_end", float(pressure[-1]), float("nan"), "Pa", f"at {z[-1] * 1e3:.1f} mm")]


EVALUATIONS = {"oedometer": oedometer, "triaxial": triaxial, "shear": shear, "collapse": collapse, "repose": repose, "plate": plate}


def together(tests):
    """What several tests of one kind give: cohesion and friction angle by regression, Bekker's k_c and k_phi."""
    kinds = {test.kind for test in tests}
    if len(tests) < 2 or len(kinds) != 1:
        return []
    values = [{q.name: q.value for q in test.evaluate()} for test in tests]
    column = lambda name: np.array([value[name] for value in values])
    kind = kinds.pop()
    quantities = []
    if kind == "shear":
        for what in ("peak", "residual"):
            slope, cohesion, covariance = line_fit(column("normal_stress"), column(f"{what}_shear"))
            quantities += [
                Quantity(f"friction_angle_{what}", np.degrees(np.arctan(slope)), np.degrees(np.sqrt(covariance[0, 0]) / (1 + slope**2)), "deg",
                         f"of tau = c + sigma tan(phi), {len(tests)} tests"),
                Quantity(f"cohesion_{what}", cohesion, np.sqrt(covariance[1, 1]), "Pa", "of that line")]
    if kind == "triaxial":
        # s1 = s3 N + 2 c sqrt(N), N = tan(45 + phi/2)^2
        for what, deviator in (("peak", "peak_deviator"), ("end", "deviator_end")):
            slope, intercept, covariance = line_fit(column("lateral_stress_end"), column("lateral_stress_end") + column(deviator))
            root = np.sqrt(slope)
            quantities += [
                Quantity(f"friction_angle_{what}", np.degrees(2 * np.arctan(root) - np.pi / 2),
                         np.degrees(np.sqrt(covariance[0, 0]) / (root * (1 + slope))), "deg", f"of s1 = s3 N + 2 c sqrt(N), {len(tests)} tests"),
                Quantity(f"cohesion_{what}", intercept / (2 * root), np.sqrt(covariance[1, 1]) / (2 * root), "Pa", "of that line")]
    if kind == "plate" and len({test.facts["size"] for test in tests}) > 1:
        # Bekker: p = (k_c/b + k_phi) z^n with one n; b is the radius of a round plate
        from scipy.optimize import least_squares

        rows = [(test.number("size") / 2, test.curve()) for test in tests]
        data = [(np.full(len(r), b), r[:, 1], r[:, 3]) for b, r in rows]
        b, z, p = (np.concatenate(part) for part in zip(*data))
        use = (z > 0.1 * z.max()) & (p > 0)
        b, z, p = b[use], z[use], p[use]
        model = lambda q: (q[0] / b + q[1]) * z ** q[2]
        start = (0.0, np.median(p / z), 1.0)
        fit = least_squares(lambda q: np.log(np.maximum(model(q), 1e-9) / p), start, x_scale=(abs(start[1]) * 0.01, abs(start[1]), 1.0))
        spread = np.sqrt(np.diag(2 * fit.cost / (len(p) - 3) * np.linalg.inv(fit.jac.T @ fit.jac)))
        names = (("bekker_kc", "N/m^(n+1)"), ("bekker_kphi", "N/m^(n+2)"), ("bekker_n", ""))
        quantities += [Quantity(name, value, error, unit, f"of p = (kc/b + kphi) z^n, {len(tests)} plates")
                       for (name, unit), value, error in zip(names, fit.x, spread)]
    return quantities


def read_reference(path):
    """Rows of a reference.csv with columns rho_kgm3 and sigma1_Pa: [(density, stress)], rising."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    try:
        return sorted((float(row["rho_kgm3"]), float(row["sigma1_Pa"])) for row in rows)
    except KeyError as error:
        raise ResultsError(f"{path}: has no column {error}; a reference of an oedometer needs rho_kgm3 and sigma1_Pa") from error


class Point:
    """A run of furrow-point with the same path, to lay beside."""

    def __init__(self, folder):
        self.folder = Path(folder)
        path = self.folder / "point.csv"
        if not path.is_file():
            raise ResultsError(f"{path}: no such file; name the results folder of 'furrow-point run'")
        with open(path, encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
        first = path.read_text(encoding="utf-8").splitlines()[0]
        self.label = first.lstrip("# ").split(" (")[0]


def report(folders, reference=None, points=()):
    """Evaluates the folders; returns the text and writes laboratory.json into each."""
    tests = [Test(folder) for folder in folders]
    measured = read_reference(reference) if reference else None
    lines = []
    for test in tests:
        quantities = test.evaluate()
        if measured and test.kind == "oedometer":
            quantities += reference_error(test, measured)
        lines += [f"{test.kind}: {test.folder}"] + [q.line() for q in quantities]
        content = {q.name: {"value": q.value, "error": q.error, "unit": q.unit, "meaning": q.meaning} for q in quantities}
        # NaN is no JSON: an error that is not known is null
        for entry in content.values():
            entry.update({k: None for k in ("value", "error") if not np.isfinite(entry[k])})
        (test.folder / "laboratory.json").write_text(json.dumps({"facts": test.facts, "quantities": content}, indent=1, allow_nan=False))
    shared = together(tests)
    if shared:
        lines += ["all together"] + [q.line() for q in shared]
    return tests, measured, [Point(p) for p in points], "\n".join(lines)
