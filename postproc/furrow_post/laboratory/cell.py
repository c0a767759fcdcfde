# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests in a periodic cell: oedometer, triaxial, extension, plane strain, free sides, tension.

Stress and strain: compression positive.
"""

import math

import numpy as np

from ..uncertainty.statistics import block_mean, line_fit
from ..arrays import Booleans, Floats
from ..read.laboratory import LaboratoryTest, cell_curve
from .quantity import LaboratoryQuantity, around_peak, degrees


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
    quantity = LaboratoryQuantity
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
    quantity = LaboratoryQuantity
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
    return LaboratoryQuantity("dilation_end", -slope, float(np.sqrt(covariance[0, 0])), "", meaning)


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
