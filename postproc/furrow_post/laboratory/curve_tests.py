# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests with a curve: oedometer, triaxial, extension, plane strain, free sides and tension of a periodic cell; a
sheared layer; a plate.

Stress and strain: compression positive. The standard errors of means are those of blocks of the curve, those of fits
come from the covariance of the residuals.
"""

import math

import numpy as np

from ..laws.fitter import Parameter, fit
from ..uncertainty.statistics import block_mean, line_fit
from ..arrays import Booleans, Floats
from ..read.laboratory import LaboratoryTest, cell_curve
from ..read.soil_card import mobilised_share
from .quantity import LaboratoryQuantity

quantity = LaboratoryQuantity  # short name for the lists below

REACHED = 0.95  # of the peak: a strength that is then kept, or grows slowly, has been reached there


def oedometer(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    strain, stress, density = cell_curve(test.curve())
    _require_compressed(strain, stress)
    axial = stress[:, 2]
    loading = slice(0, int(np.argmax(axial)) + 1)
    lateral = 0.5 * (stress[loading, 0] + stress[loading, 1]) / np.maximum(axial[loading], 1e-30)
    late = axial[loading] > 0.5 * axial.max()
    quantities = [
        quantity("initial_density", density[0], 0.0, "kg/m3", "at the start of the test"),
        quantity("K0", *block_mean(lateral[late]), "", "lateral over axial stress, upper half of the stress"),
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
            quantities.append(quantity(f"modulus_{name}", slope, error, "Pa", "confined modulus"))
        value = float(np.interp(np.log(level), rising, density[loading]))
        quantities.append(quantity(f"density_{name}", value, 0.0, "kg/m3", "under this axial stress"))
    return quantities


def triaxial(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    rows = test.curve()
    strain, stress, density = cell_curve(rows)
    _require_compressed(strain, stress)
    lateral, axial = 0.5 * (stress[:, 0] + stress[:, 1]), stress[:, 2]
    deviator = axial - lateral
    peak, window, largest = around_peak(deviator)
    around = slice(max(peak - window, 0), peak + window + 1)
    last_strain = 0.85 * strain[-1, 2]
    end = strain[:, 2] > last_strain
    angle = np.arcsin(np.clip(deviator / np.maximum(axial + lateral, 1e-30), -1, 1))
    half = int(np.argmax(deviator > 0.5 * largest))
    secant = float(deviator[half] / max(strain[half, 2], 1e-12))
    slope, _, covariance = line_fit(strain[around, 2], strain.sum(axis=1)[around])
    inertial = float(np.mean(rows[1:, 8]))
    at_strain = f"at an axial strain of {strain[peak, 2]:.3f}"
    no_cohesion = "without cohesion: sin = (s1 - s3)/(s1 + s3)"
    over_strains = f"mean over strains above {last_strain:.3f}"
    growth = "volume growth per axial strain at the peak"
    dilation_error = float(np.sqrt(covariance[0, 0]))
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        quantity("peak_deviator", *block_mean(deviator[around]), "Pa", at_strain),
        quantity("friction_angle_peak", *degrees(angle[around]), "deg", no_cohesion),
        quantity("friction_angle_end", *degrees(angle[end]), "deg", over_strains),
        quantity("lateral_stress_end", *block_mean(lateral[end]), "Pa", "there"),
        quantity("deviator_end", *block_mean(deviator[end]), "Pa", "there"),
        quantity("stress_ratio_end", *block_mean(_stress_ratio(stress)[end]), "", "q/p, there"),
        _dilation_at_end(strain, end, 2),
        quantity("E50", secant, 0.0, "Pa", "secant modulus to half of the peak"),
        quantity("dilation", -slope, dilation_error, "", growth),
        quantity("density_end", *block_mean(density[end]), "kg/m3", "there"),
        quantity("inertial_number", inertial, 0.0, "", "below 1e-3: quasi-static"),
    ]


def extension(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Driven along x and y, the axial stress held."""
    strain, stress, _ = cell_curve(test.curve())
    axial, lateral = stress[:, 2], 0.5 * (stress[:, 0] + stress[:, 1])
    return [
        *_strength(test, 0, lateral, axial),
        quantity("axial_stress_end", *block_mean(axial[_end(strain, 0)]), "Pa", "the smallest, there"),
    ]


def plane_strain(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Driven along z, the stress along x held, nothing moving along y."""
    strain, stress, _ = cell_curve(test.curve())
    end = _end(strain, 2)
    across, middle, axial = stress[:, 0], stress[:, 1], stress[:, 2]
    share = (middle - across) / np.maximum(axial - across, 1e-30)
    of_middle = "(s2 - s3)/(s1 - s3), there; s2 is that of the width kept"
    return [
        *_strength(test, 2, axial, across),
        quantity("lateral_stress_end", *block_mean(across[end]), "Pa", "the smallest, there"),
        quantity("intermediate_stress_ratio_end", *block_mean(share[end]), "", of_middle),
    ]


def unconfined(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Stress and lateral strain where the axial strain has grown to levels."""
    strain, stress, density = cell_curve(test.curve())
    _require_compressed(strain, stress)
    axial, lateral = strain[:, 2], strain[:, :2].mean(axis=1)
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
    at_strain = f"at an axial strain of {pulled[peak]:.2g}"
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "at the start of the test"),
        quantity("tensile_strength", float(pull[peak]), math.nan, "Pa", at_strain),
    ]


def shear(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    rows = test.curve()
    _, stress, density = cell_curve(rows)
    travel, tau, normal = rows[:, 8], rows[:, 9], stress[:, 2]
    peak, window, largest = around_peak(tau)
    first = max(peak - window // 2, 0)
    around, end = slice(first, first + window), travel > 0.6 * travel[-1]
    angle = np.arctan2(tau, normal)
    rise = slice(0, peak + 1)
    start = (float(largest), float(max(travel[peak] / 3, 1e-6)))
    janosi = [Parameter("tau_max", "Pa", start[0], 0.0, np.inf), Parameter("K", "m", start[1], 1e-9, np.inf)]
    top, length = fit(janosi, lambda x: float(x[0]) * mobilised_share(travel[rise], x[1]) - tau[rise], known=False).parameters
    reached = float(travel[np.argmax(tau > REACHED * largest)])
    gap = test.numbers.get("gap", math.nan)  # of results before there was one: none
    at_travel = f"at a displacement of {travel[peak] * 1e3:.2f} mm"
    of_gap = f"displacement over gap where {REACHED:.0%} of the peak are first borne"
    fitted = "of tau_max (1 - exp(-j/K)), fitted up to the peak"
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        quantity("normal_stress", *block_mean(normal), "Pa", "mean of the test"),
        quantity("peak_shear", *block_mean(tau[around]), "Pa", at_travel),
        quantity("strain_at_peak", reached / gap, math.nan, "", of_gap),
        quantity("residual_shear", *block_mean(tau[end]), "Pa", "over the last 40 % of the travel"),
        quantity("friction_angle_peak", *degrees(angle[around]), "deg", "without cohesion: tan = tau/sigma"),
        quantity("friction_angle_end", *degrees(angle[end]), "deg", "the same, residual"),
        quantity("janosi_K", length.value, length.deviation, "m", fitted),
        quantity("janosi_tau_max", top.value, top.deviation, "Pa", "of that fit"),
    ]


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
    return [
        quantity("bekker_n", n, n_error, "", "of p = k z^n, from 10 % of the sinkage on"),
        quantity("bekker_k", k, k * log_k_error, "Pa/m^n", f"plate of {size * 1e3:g} mm"),
        quantity("pressure_end", float(pressure[-1]), math.nan, "Pa", at_end),
    ]


def _strength(
    test: LaboratoryTest, driven: int, largest: Floats, smallest: Floats
) -> list[LaboratoryQuantity]:
    """Quantities of extension and plane strain alike. driven: the axis of the strain that is given."""
    rows = test.curve()
    strain, stress, density = cell_curve(rows)
    _require_compressed(strain, stress, driven)
    angle = np.arcsin(
        np.clip((largest - smallest) / np.maximum(largest + smallest, 1e-30), -1, 1)
    )
    peak, window, _ = around_peak(angle)
    around = slice(max(peak - window, 0), peak + window + 1)
    end = _end(strain, driven)
    no_cohesion = "without cohesion: sin = (s1 - s3)/(s1 + s3)"
    at_strain = f"{no_cohesion}, at a strain of {strain[peak, driven]:.3f}"
    over_strains = f"{no_cohesion}, mean over the last 15 % of strain"
    inertial = float(np.mean(rows[1:, 8]))
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        quantity("friction_angle_peak", *degrees(angle[around]), "deg", at_strain),
        quantity("friction_angle_end", *degrees(angle[end]), "deg", over_strains),
        quantity("stress_ratio_end", *block_mean(_stress_ratio(stress)[end]), "", "q/p, there"),
        _dilation_at_end(strain, end, driven),
        quantity("density_end", *block_mean(density[end]), "kg/m3", "there"),
        quantity("inertial_number", inertial, 0.0, "", "below 1e-3: quasi-static"),
    ]


def _dilation_at_end(strain: Floats, end: Booleans, driven: int) -> LaboratoryQuantity:
    slope, _, covariance = line_fit(strain[end, driven], strain.sum(axis=1)[end])
    meaning = "volume growth per driven strain at the end"
    return quantity("dilation_end", -slope, float(np.sqrt(covariance[0, 0])), "", meaning)


def _end(strain: Floats, driven: int) -> Booleans:
    """The last 15 % of the driven strain."""
    end: Booleans = strain[:, driven] > 0.85 * strain[-1, driven]
    return end


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


def degrees(radians: Floats) -> tuple[float, float]:
    """Mean and standard error in degrees."""
    mean, error = block_mean(radians)
    return float(np.degrees(mean)), float(np.degrees(error))


def around_peak(values: Floats) -> tuple[int, int, float]:
    """Place of the peak of a smoothed curve, half the width about it, and the smoothed peak."""
    window = max(len(values) // 40, 3)
    smooth = np.convolve(values, np.ones(window) / window, mode="valid")
    return int(np.argmax(smooth)) + window // 2, window, float(smooth.max())
