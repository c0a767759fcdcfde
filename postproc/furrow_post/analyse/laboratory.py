# SPDX-License-Identifier: GPL-2.0-or-later
"""What the tests of inputs/laboratory say: moduli, strengths, repose, run-out, with their errors.

Stress and strain: compression positive. The standard errors of means are those of blocks of the
curve, those of fits come from the covariance of the residuals.
"""

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import curve_fit, least_squares

from ..arrays import Booleans, Floats
from ..errors import ResultsError, content_of
from ..read.laboratory import LaboratoryTest, PointRun, cell_curve, read_oedometer_reference
from ..read.results import require_different
from .statistics import block_mean, line_fit, rms

Oedometer = list[tuple[float, float]]  # (density [kg/m3], axial stress [Pa]), rising


@dataclass(frozen=True)
class LaboratoryQuantity:
    """A number that a test gives; error: standard error, NaN where it is not known."""

    name: str
    value: float
    error: float
    unit: str
    meaning: str

    def line(self) -> str:
        return (
            f"  {self.name:26} {self.value:12.5g} ± {self.error:<10.3g} {self.unit:6} "
            f"{self.meaning}"
        )


def evaluate(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """What one test gives. @raises ResultsError where its curve or deposit is no such test's"""
    remedy = "was the run stopped, or too short? Make it again"
    with content_of(test.folder, remedy), np.errstate(all="ignore"):
        return EVALUATIONS[test.kind](test)


def values_of(test: LaboratoryTest) -> dict[str, float]:
    """Name -> value of what a test gives."""
    return {quantity.name: quantity.value for quantity in evaluate(test)}


def _degrees(radians: Floats) -> tuple[float, float]:
    """Mean and standard error in degrees."""
    mean, error = block_mean(radians)
    return float(np.degrees(mean)), float(np.degrees(error))


def _around_peak(values: Floats) -> tuple[int, int, float]:
    """Place of the peak of a smoothed curve, half the width about it, and the smoothed peak."""
    window = max(len(values) // 40, 3)
    smooth = np.convolve(values, np.ones(window) / window, mode="valid")
    return int(np.argmax(smooth)) + window // 2, window, float(smooth.max())


def _require_compressed(strain: Floats, stress: Floats, axis: int = 2) -> None:
    """@raises ValueError where a cell was not compressed along an axis, or carried nothing"""
    if not (strain[:, axis].max() > 0 and stress[:, axis].max() > 0):
        raise ValueError("the cell is not compressed, or carries nothing")


def _stress_ratio(stress: Floats) -> Floats:
    """q/p of normal stresses (n, 3) without shear."""
    p = stress.mean(axis=1)
    q = np.sqrt(1.5) * np.linalg.norm(stress - p[:, None], axis=1)
    ratio: Floats = q / np.maximum(p, 1e-30)
    return ratio


def oedometer(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    strain, stress, density = cell_curve(test.curve())
    _require_compressed(strain, stress)
    axial = stress[:, 2]
    loading = slice(0, int(np.argmax(axial)) + 1)
    lateral = 0.5 * (stress[loading, 0] + stress[loading, 1]) / np.maximum(axial[loading], 1e-30)
    late = axial[loading] > 0.5 * axial.max()
    quantities = [
        LaboratoryQuantity("initial_density", density[0], 0.0, "kg/m3", "at the start of the test"),
        LaboratoryQuantity(
            "K0",
            *block_mean(lateral[late]),
            "",
            "lateral over axial stress, upper half of the stress",
        ),
    ]
    rising = np.log(np.maximum.accumulate(np.maximum(axial[loading], 1.0)))
    for level in np.geomspace(1e3, 1e6, 7):
        if not axial[0] < level < axial.max():
            continue
        name = f"{level / 1e3:.3g}kPa"
        near = np.flatnonzero((axial[loading] > 0.7 * level) & (axial[loading] < 1.4 * level))
        if len(near) > 4:
            slope, _, covariance = line_fit(strain[loading, 2][near], axial[loading][near])
            error = float(np.sqrt(covariance[0, 0]))
            quantities.append(
                LaboratoryQuantity(f"modulus_{name}", slope, error, "Pa", "confined modulus")
            )
        value = float(np.interp(np.log(level), rising, density[loading]))
        quantities.append(
            LaboratoryQuantity(f"density_{name}", value, 0.0, "kg/m3", "under this axial stress")
        )
    return quantities


def reference_error(
    test: LaboratoryTest, reference: Oedometer, lowest: float = 5e4, highest: float = 1e6
) -> list[LaboratoryQuantity]:
    """rms ln-errors of stress at given density, and of density at given stress, from a measurement.

    Over [lowest, highest] Pa. @raises ResultsError where the test reaches fewer than two points
    """
    _, stress, density = cell_curve(test.curve())
    axial = np.maximum.accumulate(np.maximum(stress[:, 2], 1e-3))
    end = int(np.argmax(stress[:, 2])) + 1
    wanted = [(rho, sigma) for rho, sigma in reference if lowest <= sigma <= highest]
    measured = [
        (rho, sigma) for rho, sigma in wanted if sigma <= axial[end - 1] and rho <= density[end - 1]
    ]
    if len(measured) < 2:
        raise ResultsError(
            f"{test.folder}: ends at {axial[end - 1]:.3g} Pa and {density[end - 1]:.3g} kg/m3, "
            "before two points of the reference"
        )
    points = np.array(measured)
    of_stress = np.log(np.interp(points[:, 0], density[:end], axial[:end]) / points[:, 1])
    of_density = np.log(np.interp(points[:, 1], axial[:end], density[:end]) / points[:, 0])
    counted = f"of stress at the measured densities, {len(measured)} of {len(wanted)} points"
    return [
        LaboratoryQuantity("rms_ln_stress", rms(of_stress), 0.0, "", counted),
        LaboratoryQuantity(
            "rms_ln_density", rms(of_density), 0.0, "", "of density at the measured stresses"
        ),
    ]


def triaxial(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    rows = test.curve()
    strain, stress, density = cell_curve(rows)
    _require_compressed(strain, stress)
    lateral, axial = 0.5 * (stress[:, 0] + stress[:, 1]), stress[:, 2]
    deviator = axial - lateral
    peak, window, largest = _around_peak(deviator)
    around = slice(max(peak - window, 0), peak + window + 1)
    last_strain = 0.85 * strain[-1, 2]
    end = strain[:, 2] > last_strain
    angle = np.arcsin(np.clip(deviator / np.maximum(axial + lateral, 1e-30), -1, 1))
    half = int(np.argmax(deviator > 0.5 * largest))
    secant = float(deviator[half] / max(strain[half, 2], 1e-12))
    slope, _, covariance = line_fit(strain[around, 2], strain.sum(axis=1)[around])
    inertial = float(np.mean(rows[1:, 8]))
    quantity = LaboratoryQuantity
    at_strain = f"at an axial strain of {strain[peak, 2]:.3f}"
    no_cohesion = "without cohesion: sin = (s1 - s3)/(s1 + s3)"
    over_strains = f"mean over strains above {last_strain:.3f}"
    growth = "volume growth per axial strain at the peak"
    dilation_error = float(np.sqrt(covariance[0, 0]))
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        quantity("peak_deviator", *block_mean(deviator[around]), "Pa", at_strain),
        quantity("friction_angle_peak", *_degrees(angle[around]), "deg", no_cohesion),
        quantity("friction_angle_end", *_degrees(angle[end]), "deg", over_strains),
        quantity("lateral_stress_end", *block_mean(lateral[end]), "Pa", "there"),
        quantity("deviator_end", *block_mean(deviator[end]), "Pa", "there"),
        quantity("stress_ratio_end", *block_mean(_stress_ratio(stress)[end]), "", "q/p, there"),
        _dilation_at_end(strain, end, 2),
        quantity("E50", secant, 0.0, "Pa", "secant modulus to half of the peak"),
        quantity("dilation", -slope, dilation_error, "", growth),
        quantity("density_end", *block_mean(density[end]), "kg/m3", "there"),
        quantity("inertial_number", inertial, 0.0, "", "below 1e-3: quasi-static"),
    ]


def _dilation_at_end(strain: Floats, end: Booleans, driven: int) -> LaboratoryQuantity:
    slope, _, covariance = line_fit(strain[end, driven], strain.sum(axis=1)[end])
    meaning = "volume growth per driven strain at the end"
    return LaboratoryQuantity("dilation_end", -slope, float(np.sqrt(covariance[0, 0])), "", meaning)


def extension(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Driven along x and y, the axial stress held."""
    strain, stress, _ = cell_curve(test.curve())
    axial, lateral = stress[:, 2], 0.5 * (stress[:, 0] + stress[:, 1])
    return [
        *_strength(test, 0, lateral, axial),
        LaboratoryQuantity(
            "axial_stress_end", *block_mean(axial[_end(strain, 0)]), "Pa", "the smallest, there"
        ),
    ]


def plane_strain(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Driven along z, the stress along x held, nothing moving along y."""
    strain, stress, _ = cell_curve(test.curve())
    end = _end(strain, 2)
    across, middle, axial = stress[:, 0], stress[:, 1], stress[:, 2]
    share = (middle - across) / np.maximum(axial - across, 1e-30)
    quantity = LaboratoryQuantity
    of_middle = "(s2 - s3)/(s1 - s3), there; s2 is that of the width kept"
    return [
        *_strength(test, 2, axial, across),
        quantity("lateral_stress_end", *block_mean(across[end]), "Pa", "the smallest, there"),
        quantity("intermediate_stress_ratio_end", *block_mean(share[end]), "", of_middle),
    ]


def _end(strain: Floats, driven: int) -> Booleans:
    """The last 15 % of the driven strain."""
    end: Booleans = strain[:, driven] > 0.85 * strain[-1, driven]
    return end


def _strength(
    test: LaboratoryTest, driven: int, largest: Floats, smallest: Floats
) -> list[LaboratoryQuantity]:
    """What extension and plane strain give alike. driven: the axis of the strain that is given."""
    rows = test.curve()
    strain, stress, density = cell_curve(rows)
    _require_compressed(strain, stress, driven)
    angle = np.arcsin(
        np.clip((largest - smallest) / np.maximum(largest + smallest, 1e-30), -1, 1)
    )
    peak, window, _ = _around_peak(angle)
    around = slice(max(peak - window, 0), peak + window + 1)
    end = _end(strain, driven)
    quantity = LaboratoryQuantity
    no_cohesion = "without cohesion: sin = (s1 - s3)/(s1 + s3)"
    at_strain = f"{no_cohesion}, at a strain of {strain[peak, driven]:.3f}"
    over_strains = f"{no_cohesion}, mean over the last 15 % of strain"
    inertial = float(np.mean(rows[1:, 8]))
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        quantity("friction_angle_peak", *_degrees(angle[around]), "deg", at_strain),
        quantity("friction_angle_end", *_degrees(angle[end]), "deg", over_strains),
        quantity("stress_ratio_end", *block_mean(_stress_ratio(stress)[end]), "", "q/p, there"),
        _dilation_at_end(strain, end, driven),
        quantity("density_end", *block_mean(density[end]), "kg/m3", "there"),
        quantity("inertial_number", inertial, 0.0, "", "below 1e-3: quasi-static"),
    ]


def unconfined(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Stress and lateral strain where the axial strain has grown to levels."""
    strain, stress, density = cell_curve(test.curve())
    _require_compressed(strain, stress)
    axial, lateral = strain[:, 2], strain[:, :2].mean(axis=1)
    quantity = LaboratoryQuantity
    quantities = [quantity("initial_density", density[0], 0.0, "kg/m3", "at the start of the test")]
    for level in (0.05, 0.1, 0.2, 0.4):
        near = np.flatnonzero(np.abs(axial - level) < 0.1 * level)
        if axial[-1] < 1.05 * level or len(near) < 3:
            continue
        name = f"{100 * level:.0f}%"
        ratio = -lateral[near] / axial[near]
        mean_stress, error = block_mean(stress[near, 2])
        at_strain = f"at an axial strain of {level:g}"
        quantities += [
            quantity(f"stress_{name}", mean_stress, error, "Pa", f"axial, {at_strain}"),
            quantity(f"lateral_ratio_{name}", *block_mean(ratio), "", "lateral growth over axial"),
            quantity(f"density_{name}", float(density[near].mean()), 0.0, "kg/m3", at_strain),
        ]
    return quantities


def tension(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Peak of the tensile stress."""
    strain, stress, density = cell_curve(test.curve())
    pulled, pull = -strain[:, 2], -stress[:, 2]
    if not (pulled.max() > 0 and pull.max() > 0):
        raise ValueError("the cell is not pulled, or bears nothing")
    peak = int(np.argmax(pull))
    quantity = LaboratoryQuantity
    at_strain = f"at an axial strain of {pulled[peak]:.2g}"
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "at the start of the test"),
        quantity("tensile_strength", float(pull[peak]), math.nan, "Pa", at_strain),
    ]


def _janosi(travel: Floats, top: float, length: float) -> Floats:
    """tau = tau_max (1 - exp(-j/K)) of Z. Janosi and B. Hanamoto (1961)."""
    tau: Floats = top * (1 - np.exp(-travel / length))
    return tau


def shear(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    rows = test.curve()
    _, stress, density = cell_curve(rows)
    travel, tau, normal = rows[:, 8], rows[:, 9], stress[:, 2]
    peak, window, largest = _around_peak(tau)
    around, end = slice(max(peak - window, 0), peak + window + 1), travel > 0.6 * travel[-1]
    angle = np.arctan2(tau, normal)
    rise = slice(0, peak + 1)
    start = (largest, max(travel[peak] / 3, 1e-6))
    bounds = ((0, 1e-9), (np.inf, np.inf))
    (top, length), covariance = curve_fit(_janosi, travel[rise], tau[rise], p0=start, bounds=bounds)
    top_error, length_error = (float(e) for e in np.sqrt(np.diag(covariance)))
    quantity = LaboratoryQuantity
    at_travel = f"at a displacement of {travel[peak] * 1e3:.2f} mm"
    fitted = "of tau_max (1 - exp(-j/K)), fitted up to the peak"
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        quantity("normal_stress", *block_mean(normal), "Pa", "mean of the test"),
        quantity("peak_shear", *block_mean(tau[around]), "Pa", at_travel),
        quantity("residual_shear", *block_mean(tau[end]), "Pa", "over the last 40 % of the travel"),
        quantity(
            "friction_angle_peak",
            *_degrees(angle[around]),
            "deg",
            "without cohesion: tan = tau/sigma",
        ),
        quantity("friction_angle_end", *_degrees(angle[end]), "deg", "the same, residual"),
        quantity("janosi_K", float(length), length_error, "m", fitted),
        quantity("janosi_tau_max", float(top), top_error, "Pa", "of that fit"),
    ]


def thickness_profile(
    grains: Floats, distance: Floats, edges: Floats, areas: Floats, solid_fraction: float
) -> Floats:
    """Height of a deposit in bins of distance [m]: solid volume over area and solid fraction.

    grains (n, 4): x, y, z, radius; distance (n) [m]; edges (m + 1) [m], areas (m) [m2] of the bins
    """
    solid = 4 / 3 * np.pi * grains[:, 3] ** 3
    volume, _ = np.histogram(distance, bins=edges, weights=solid)
    height: Floats = volume / areas / solid_fraction
    return height


def _outer_radius(height: Floats, edges: Floats, level: float, diameter: float) -> float:
    """Where a profile of heights falls below a level for the last time [m]."""
    centre = 0.5 * (edges[1:] + edges[:-1])
    last = int(np.flatnonzero(height > level)[-1])
    if last + 1 == len(height):
        return float(edges[-1])
    share = (height[last] - level) / (height[last] - height[last + 1])
    return float(centre[last] + diameter * share)


def collapse(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Run-out and height of a column, beside G. Lube et al. (2004)."""
    column, deposit = test.grains("column"), test.grains("deposit")
    diameter, r0 = test.number("diameter"), test.number("radius")
    volume = np.sum(4 / 3 * np.pi * column[:, 3] ** 3)
    # The column is uniform, so that its middle lies at half its height.
    h0 = float(2.0 * np.average(column[:, 2], weights=column[:, 3] ** 3))
    fraction = float(volume / (np.pi * r0**2 * h0))
    middle = np.average(deposit[:, :2], axis=0)
    distance = np.hypot(*(deposit[:, :2] - middle).T)
    edges = np.arange(0.0, distance.max() + 2 * diameter, diameter)
    height = thickness_profile(deposit, distance, edges, np.pi * np.diff(edges**2), fraction)
    final, wide, narrow = (
        _outer_radius(height, edges, share * diameter, diameter) for share in (0.5, 0.25, 1.0)
    )
    near = deposit[distance < 2 * diameter]
    top = float(np.percentile(near[:, 2] + near[:, 3], 95))
    aspect = h0 / r0
    expected = 1.24 * aspect if aspect < 1.7 else 1.6 * math.sqrt(aspect)
    runout, error = final / r0 - 1, 0.5 * (wide - narrow) / r0
    height_error = 0.5 * diameter / r0
    quantity = LaboratoryQuantity
    thick = "(r - r0)/r0; r where the deposit is half a grain thick (error: 1/4 to 1 grain)"
    lube = "1.24 a (a < 1.7), 1.6 sqrt(a): Lube et al. 2004"
    result = [
        quantity("aspect", aspect, 0.0, "", "height over radius of the column"),
        quantity("solid_fraction", fraction, 0.0, "", "of the column"),
        quantity("runout", runout, error, "", thick),
        quantity("runout_over_Lube", runout / expected, error / expected, "", lube),
        quantity("height_over_r0", top / r0, height_error, "", "top of the deposit"),
    ]
    if aspect > 1.7:
        ratio = top / r0 / (0.88 * aspect ** (1 / 6))
        result.append(quantity("height_over_Lube", ratio, height_error, "", "0.88 a^(1/6)"))
    return result


def repose(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Slope of the highest grains of a deposit."""
    deposit, diameter = test.grains("deposit"), test.number("diameter")
    length = test.number("length")
    bins = np.arange(0.0, length, 1.5 * diameter)
    x, y = deposit[:, 0], deposit[:, 1]

    def angle(part: Booleans) -> float:
        """Of some grains [degrees]."""
        where, top = [], []
        for low, high in zip(bins[:-1], bins[1:]):
            inside = part & (x >= low) & (x < high)
            if inside.any():
                where.append(0.5 * (low + high))
                top.append(np.max(deposit[inside, 2] + deposit[inside, 3]))
        middles, tops = np.array(where), np.array(top)
        on_slope = (middles > 0.15 * length) & (middles < 0.9 * length) & (tops > 2 * diameter)
        slope = np.polyfit(middles[on_slope], tops[on_slope], 1)[0]
        return float(-np.degrees(np.arctan(slope)))

    thirds = np.array_split(np.argsort(y), 3)
    parts = [angle(np.isin(np.arange(len(x)), third)) for third in thirds]
    whole, error = angle(np.full(len(x), True)), float(np.std(parts, ddof=1) / np.sqrt(3))
    meaning = "slope of the highest grains; error from three slices"
    return [LaboratoryQuantity("angle_of_repose", whole, error, "deg", meaning)]


def plate(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Bekker's p = k z^n of one plate."""
    rows = test.curve()
    z, pressure = rows[:, 1], rows[:, 3]
    if not (z.max() > 0 and pressure.max() > 0):
        raise ValueError("the plate does not come into the ground, or carries nothing")
    size = test.number("size")
    late = (z > 0.1 * z.max()) & (pressure > 0)
    n, log_k, covariance = line_fit(np.log(z[late]), np.log(pressure[late]))
    k = math.exp(log_k)
    n_error, log_k_error = (float(e) for e in np.sqrt(np.diag(covariance)))
    at_end = f"at {z[-1] * 1e3:.1f} mm"
    quantity = LaboratoryQuantity
    return [
        quantity("bekker_n", n, n_error, "", "of p = k z^n, from 10 % of the sinkage on"),
        quantity("bekker_k", k, k * log_k_error, "Pa/m^n", f"plate of {size * 1e3:g} mm"),
        quantity("pressure_end", float(pressure[-1]), math.nan, "Pa", at_end),
    ]


EVALUATIONS: dict[str, Callable[[LaboratoryTest], list[LaboratoryQuantity]]] = {
    "oedometer": oedometer,
    "triaxial": triaxial,
    "extension": extension,
    "plane_strain": plane_strain,
    "unconfined": unconfined,
    "tension": tension,
    "shear": shear,
    "collapse": collapse,
    "repose": repose,
    "plate": plate,
}


def together(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """What several tests of one kind give: cohesion and friction angle; Bekker's k_c and k_phi.

    Nothing of a single test, or of tests of several kinds.
    """
    kinds = {test.kind for test in tests}
    if len(tests) < 2 or len(kinds) != 1:
        return []
    kind = kinds.pop()
    remedy = "lay tests of different sizes or stresses together"
    with content_of(", ".join(str(test.folder) for test in tests), remedy):
        if kind == "shear":
            return _shear_strength(tests)
        if kind == "triaxial":
            return _triaxial_strength(tests)
        if kind == "plate" and len({test.number("size") for test in tests}) > 1:
            return _bekker_of_plates(tests)
    return []


def _column(values: Sequence[dict[str, float]], name: str) -> Floats:
    return np.array([value[name] for value in values])


def _shear_strength(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """tau = c + sigma tan(phi)."""
    values = [values_of(test) for test in tests]
    quantities = []
    for what in ("peak", "residual"):
        normal, tau = _column(values, "normal_stress"), _column(values, f"{what}_shear")
        slope, cohesion, covariance = line_fit(normal, tau)
        angle = float(np.degrees(np.arctan(slope)))
        angle_error = float(np.degrees(np.sqrt(covariance[0, 0]) / (1 + slope**2)))
        cohesion_error = float(np.sqrt(covariance[1, 1]))
        fit = f"of tau = c + sigma tan(phi), {len(tests)} tests"
        quantities += [
            LaboratoryQuantity(f"friction_angle_{what}", angle, angle_error, "deg", fit),
            LaboratoryQuantity(f"cohesion_{what}", cohesion, cohesion_error, "Pa", "of that line"),
        ]
    return quantities


def _triaxial_strength(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """s1 = s3 N + 2 c sqrt(N), N = tan(45 + phi/2)^2."""
    values = [values_of(test) for test in tests]
    lateral = _column(values, "lateral_stress_end")
    quantities = []
    for what, deviator in (("peak", "peak_deviator"), ("end", "deviator_end")):
        slope, intercept, covariance = line_fit(lateral, lateral + _column(values, deviator))
        root = math.sqrt(slope)
        angle = float(np.degrees(2 * np.arctan(root) - np.pi / 2))
        angle_error = float(np.degrees(np.sqrt(covariance[0, 0]) / (root * (1 + slope))))
        cohesion_error = float(np.sqrt(covariance[1, 1]) / (2 * root))
        fit = f"of s1 = s3 N + 2 c sqrt(N), {len(tests)} tests"
        cohesion = intercept / (2 * root)
        quantities += [
            LaboratoryQuantity(f"friction_angle_{what}", angle, angle_error, "deg", fit),
            LaboratoryQuantity(f"cohesion_{what}", cohesion, cohesion_error, "Pa", "of that line"),
        ]
    return quantities


def _bekker_of_plates(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """Bekker: p = (k_c/b + k_phi) z^n with one n; b is the radius of a round plate."""
    curves = [(test.number("size") / 2, test.curve()) for test in tests]
    b = np.concatenate([np.full(len(rows), radius) for radius, rows in curves])
    z = np.concatenate([rows[:, 1] for _, rows in curves])
    p = np.concatenate([rows[:, 3] for _, rows in curves])
    use = (z > 0.1 * z.max()) & (p > 0)
    b, z, p = b[use], z[use], p[use]

    def log_ratio(q: Floats) -> Floats:
        """Of the model to the pressure; q: k_c, k_phi, n."""
        model = (q[0] / b + q[1]) * z ** q[2]
        ratio: Floats = np.log(np.maximum(model, 1e-9) / p)
        return ratio

    start = (0.0, float(np.median(p / z)), 1.0)
    scale = (abs(start[1]) * 0.01, abs(start[1]), 1.0)
    fit = least_squares(log_ratio, start, x_scale=scale)
    variance = 2 * fit.cost / (len(p) - 3) * np.linalg.inv(fit.jac.T @ fit.jac)
    spread = np.sqrt(np.diag(variance))
    names = (("bekker_kc", "N/m^(n+1)"), ("bekker_kphi", "N/m^(n+2)"), ("bekker_n", ""))
    meaning = f"of p = (kc/b + kphi) z^n, {len(tests)} plates"
    return [
        LaboratoryQuantity(name, float(value), float(error), unit, meaning)
        for (name, unit), value, error in zip(names, fit.x, spread)
    ]


@dataclass
class LaboratoryReport:
    """Tests of one kind, what they are laid beside, and what they say."""

    tests: list[LaboratoryTest]
    measured: Oedometer | None
    points: list[PointRun]
    report: str


def report_tests(
    folders: Sequence[Path | str], reference: Path | None = None, points: Sequence[str] = ()
) -> LaboratoryReport:
    """Evaluates results folders and writes laboratory.json into each.

    reference: of an oedometer; points: results folders of furrow-point. @raises ResultsError
    """
    require_different(folders)
    tests = [LaboratoryTest(folder) for folder in folders]
    measured = read_oedometer_reference(reference) if reference else None
    lines = []
    for test in tests:
        quantities = evaluate(test)
        if measured and test.kind == "oedometer":
            quantities += reference_error(test, measured)
        lines += [f"{test.kind}: {test.folder}", *(q.line() for q in quantities)]
        write_json(test, quantities)
    shared = together(tests)
    if shared:
        lines += ["all together", *(q.line() for q in shared)]
    return LaboratoryReport(tests, measured, [PointRun(p) for p in points], "\n".join(lines))


def write_json(test: LaboratoryTest, quantities: Sequence[LaboratoryQuantity]) -> None:
    """laboratory.json in the folder of the test; what is not known is null: NaN is no JSON."""

    def number(value: float) -> float | None:
        return float(value) if math.isfinite(value) else None

    content = {
        q.name: {
            "value": number(q.value),
            "error": number(q.error),
            "unit": q.unit,
            "meaning": q.meaning,
        }
        for q in quantities
    }
    text = json.dumps({"facts": test.facts, "quantities": content}, indent=1, allow_nan=False)
    (test.folder / "laboratory.json").write_text(text, encoding="utf-8")
