# SPDX-License-Identifier: GPL-2.0-or-later
"""Laws for crushed snow, fitted to the record of laboratory tests on grains: two numbers that give
a law its shape by least squares, and for each shape the hardening that follows the oedometer."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from snow_paths import Points, confined, end_of, predicted
from snow_record import Place, Row

from furrow_post.laws.fitter import Parameter, Search
from furrow_post.laws.fitter import fit as least_squares
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError

CRUSHED = 1.02  # density over that at the start, from which on the oedometer shows hardening
PASSES = 5  # iterations over the hardening; the remaining error of the density is below 1e-3
# Differences, or logarithms of densities, that weigh as much as a factor of e in a stress
SCALE = {"K0": 0.1, "lateral_ratio": 0.2, "density": 0.1}
NO_STATE = 3.0  # residual of a value where the law has no state: a factor of 20
SEARCH = Search(step=0.02, central=False, ftol=1e-4, xtol=1e-3, scale=1.0, evaluations=30)

Table = list[tuple[float, float]]  # (density without load [kg/m3], strength [Pa])


class Elastic(NamedTuple):
    E: float  # [Pa]
    nu: float


@dataclass(frozen=True)
class SnowLaw:
    title: str
    shapes: tuple[Parameter, Parameter]
    keys: Callable[[Sequence[float], Table], dict[str, float | str]]  # of the section "law"


def cam_clay_keys(shape: Sequence[float], _: Table) -> dict[str, float | str]:
    return {"type": "cohesive_cam_clay", "M": shape[0], "tension_ratio": shape[1]}


def cap_keys(shape: Sequence[float], _: Table) -> dict[str, float | str]:
    return {"type": "drucker_prager_cap", "beta": shape[0], "d": shape[1], "R": 0.02}


def foam_keys(shape: Sequence[float], table: Table) -> dict[str, float | str]:
    return {"type": "crushable_foam", "sigma0": shape[0] * table[0][1], "pt": shape[1]}


LAWS = {
    "cam_clay": SnowLaw(
        "cohesive Cam clay",
        (Parameter("M", "", 3.0, 0.5, 6.0), Parameter("tension_ratio", "", 0.1, 1e-3, 1.0)),
        cam_clay_keys,
    ),
    "cap": SnowLaw(
        "Drucker-Prager cap",
        (Parameter("beta", "degrees", 62.0, 20.0, 70.0), Parameter("d", "Pa", 1e3, 50.0, 1e5)),
        cap_keys,
    ),
    "foam": SnowLaw(
        "crushable foam",
        (Parameter("sigma0/pc0", "", 1.5, 0.3, 2.8), Parameter("pt", "Pa", 500.0, 10.0, 1e4)),
        foam_keys,
    ),
}


@dataclass(frozen=True)
class Material:
    """Parameters of a law of snow."""

    law: SnowLaw
    shape: tuple[float, ...]
    elastic: Elastic
    density: float  # [kg/m3]
    table: Table

    def sections(self) -> str:
        """The sections of a material file."""
        keys = self.law.keys(self.shape, self.table)
        texts = {k: v if isinstance(v, str) else f"{v:.4g}" for k, v in keys.items()}
        rest = "".join(f"  {key}: {text}\n" for key, text in texts.items())
        rho, p = (", ".join(f"{row[k]:.4g}" for row in self.table) for k in (0, 1))
        return (
            f"law:\n{rest}  density: {self.density:.4g}\n"
            f"elasticity:\n  type: linear\n  E: {self.elastic.E:.3g}\n  nu: {self.elastic.nu:g}\n"
            f"hardening:\n  type: by_density\n  rho: [{rho}]\n  p:   [{p}]\n"
            "  interpolation: log\n  beyond: extrapolate\n"
        )


def starting_density(record: Sequence[Row]) -> float:
    for row in record:
        if row.place == Place("oedometer", 0.0, 0.0, 0.0, "density"):
            return row.value
    raise ResultsError("the record has no density at the start of an oedometer; make it again")


def elasticity(record: Sequence[Row]) -> Elastic:
    """The geometric mean of the moduli in tension. Lateral strain is nothing, as in the grains'
    contacts, which are as stiff across as along."""
    moduli = [row.value for row in record if row.quantity == "modulus"]
    if not moduli:
        raise ResultsError("the record has no modulus, which tension tests give")
    return Elastic(float(np.exp(np.mean(np.log(moduli)))), 0.0)


def compression(record: Sequence[Row]) -> Table:
    """(density under load, axial stress) of the oedometer from the beginning of crushing on."""
    density = starting_density(record)
    found = [
        (row.value, row.level)
        for row in record
        if row.test == "oedometer" and row.quantity == "density" and row.value > CRUSHED * density
    ]
    if len(found) < 3:
        raise ResultsError("the oedometer of the record shows fewer than three levels of crushing")
    return sorted(found)


def hardened(
    law: SnowLaw, shape: tuple[float, ...], record: Sequence[Row], points: Points
) -> Material | None:
    """The law whose confined compression is that of the record; None where it has none.

    Under a stress of the oedometer the law has another strength and plastic strain; the
    table is moved by what its density is short of, and found again.
    """
    rows, density = compression(record), starting_density(record)
    rho, sigma = np.array(rows).T
    strain, strength = np.log(rho / density), 0.5 * sigma
    for _ in range(PASSES):
        # Straight in ln p, as the law reads it; the first row is the snow as it is at the start
        first = strength[0] * (strength[1] / strength[0]) ** (-strain[0] / (strain[1] - strain[0]))
        all_strain, all_strength = np.append(0.0, strain), np.append(first, strength)
        table = list(zip(density * np.exp(all_strain), all_strength))
        material = Material(law, shape, elasticity(record), density, table)
        columns = points.run(material.sections(), confined(sigma))
        if columns is None:
            return None
        ends = [end_of(columns, k + 1) for k in range(len(sigma))]
        plastic = np.maximum(columns["eps_vol_pl"][ends], 1e-4)
        strength = np.exp(_through(plastic, all_strain, np.log(all_strength)))
        strain = plastic + np.log(rho / columns["density"][ends])
        # one elastic modulus can make the strain fall; it then grows by a thousandth instead
        for k in range(len(strain)):
            strain[k] = max(strain[k], (strain[k - 1] if k else 0.0) + 1e-3)
            strength[k] = max(strength[k], 1.01 * (strength[k - 1] if k else all_strength[0]))
    return material


def _through(x: Floats, known: Floats, values: Floats) -> Floats:
    """Straight between rows, and on along the last two."""
    inside: Floats = np.interp(x, known, values)
    slope = (values[-1] - values[-2]) / (known[-1] - known[-2])
    beyond = x > known[-1]
    inside[beyond] = values[-1] + slope * (x[beyond] - known[-1])
    return inside


def is_ratio(quantity: str) -> bool:
    """May be zero or negative: compared by difference, others by logarithm."""
    return quantity in ("K0", "lateral_ratio")


def deviation(row: Row, value: float) -> float:
    """Deviation of a law from a row: difference of ratios, or ln of law over grains; NaN without a state."""
    if is_ratio(row.quantity):
        return value - row.value
    return math.log(value / row.value) if value > 0 else math.nan


def residual(row: Row, value: float) -> float:
    found = deviation(row, value) / SCALE.get(row.quantity, 1.0)
    return max(-NO_STATE, min(NO_STATE, found)) if math.isfinite(found) else NO_STATE


def compared_rows(record: Sequence[Row]) -> list[Row]:
    """The rows that a law is compared with: all but the moduli, which are elasticity's."""
    return [row for row in record if row.quantity != "modulus"]


def is_fitted(test: str) -> bool:
    """Shear is predicted. So is triaxial compression: it begins with pressure from all sides, which
    crushes clusters at far lower stress than the axial one that hardening is taken from."""
    return test not in ("shear", "triaxial")


def weights(rows: Sequence[Row]) -> Floats:
    """Weights of rows that give each quantity of each test the same weight."""
    kinds = [(row.test, row.quantity) for row in rows]
    return np.array([1 / math.sqrt(kinds.count(kind)) for kind in kinds])


def fit(
    law: SnowLaw, record: Sequence[Row], points: Points, start: Sequence[float] | None = None
) -> Material:
    """@raises ResultsError where no law is found at the start"""
    rows = [row for row in compared_rows(record) if is_fitted(row.test)]
    weight = weights(rows)

    def residuals(shape: Floats) -> Floats:
        material = hardened(law, tuple(shape), record, points)
        if material is None:
            return NO_STATE * weight
        found = predicted(material.sections(), rows, points)
        each: Floats = weight * np.array([residual(row, found[row.place]) for row in rows])
        return each

    shapes = law.shapes if start is None else [replace(s, start=one) for s, one in zip(law.shapes, start)]
    best = least_squares(shapes, residuals, SEARCH)
    material = hardened(law, tuple(best.values), record, points)
    if material is None:
        raise ResultsError(f"{law.title}: follows no oedometer of this record")
    return material
