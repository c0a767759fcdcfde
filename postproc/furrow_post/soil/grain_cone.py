# SPDX-License-Identifier: GPL-2.0-or-later
"""Cones on grains: the index of the widest one, with the error of the grain size.

The standard cone of 20 mm would need grains of 2 mm. Wider cones of one shape, to a depth of one diameter in beds of
one shape, have an index in proportion to bulk density, gravity and diameter where grains are rigid and do not stick.
So the index over these three shows what the size of the grains changes.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from ..uncertainty.grid_convergence import Convergence, grid_convergence, noise_of, pooled_scatter
from ..read.soil_card import Cone, Fitted
from .fits import ConeCurve, cone_index


@dataclass(frozen=True)
class GrainCone:
    """A run: its curve, diameter of the base in grains, and bulk density times gravity times diameter [Pa]."""

    curve: ConeCurve
    grains: float
    weight: float

    def scaled(self) -> Fitted:
        """Cone index over the weight per volume [m]."""
        index = cone_index(self.curve).index
        return Fitted(index.value / self.weight, index.error / self.weight)


def widest(cones: Sequence[GrainCone]) -> list[GrainCone]:
    """Cones in the widest bed, one for each packing."""
    return [cone for cone in cones if cone.grains == max(each.grains for each in cones)]


def convergence(cones: Sequence[GrainCone]) -> Convergence:
    """Convergence of the scaled index over the size of a grain in diameters of the base."""
    found = [cone.scaled() for cone in cones]
    groups: dict[float, list[float]] = {}
    for cone, each in zip(cones, found):
        groups.setdefault(cone.grains, []).append(each.value)
    scatter = pooled_scatter(groups.values())
    errors = [noise_of(each.value, each.error, scatter) for each in found]
    return grid_convergence([1 / cone.grains for cone in cones], [each.value for each in found], errors)


def fit_grain_cones(cones: Sequence[GrainCone]) -> Cone:
    """Index of the widest cone, mean of the packings. Its error has their scatter and that of the grain size."""
    fine, series = widest(cones), convergence(cones)
    fits = [cone_index(cone.curve) for cone in fine]
    weight = sum(cone.weight for cone in fine) / len(fine)
    slopes = [fit.gradient for fit in fits]
    gradient = sum(slope.value for slope in slopes) / len(slopes)
    spread = max(abs(slope.value - gradient) for slope in slopes)
    error = sum(slope.error for slope in slopes) / len(slopes)
    return Cone(
        Fitted(float(series.values[0] * weight), float(series.size_error(1 / fine[0].grains) * weight)),
        Fitted(gradient, (error**2 + spread**2) ** 0.5),
        fits[0].depth,
        fits[0].size,
        fits[0].angle,
    )


def cone_notes(cones: Sequence[GrainCone]) -> tuple[str, ...]:
    if not cones:
        return ()
    fine, series = widest(cones)[0], convergence(cones)
    values = ", ".join(f"{value:.3g} with {1 / size:.2g} grains" for size, value in zip(series.sizes, series.values))
    end = (
        f"extrapolated to zero grain size {series.value:.3g} ± {series.error:.2g}"
        if series.extrapolated
        else f"not extrapolated to zero grain size: {series.reason}"
    )
    return (
        f"cone of {1e3 * fine.curve.size:g} mm, {fine.grains:g} grains wide; the index of another size, the standard one "
        "included, was not computed",
        f"index over bulk density, gravity and diameter of the cone: {values}; {end}; the error of the index has the "
        "effect of the grain size",
    )
