# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits of bevameter and cone tests: Bekker's k_c, k_phi, n, the c, phi, K of Janosi, cone index.

Neighbouring points of a curve deviate from a fit together. So the standard errors count one point
in as many as the residuals are correlated over.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from ..laws.fitter import fit, plain
from ..uncertainty.statistics import line_fit
from ..arrays import Floats
from ..errors import ResultsError
from ..read.soil_card import INDEX_DEPTH, Cone, Fitted, PressureSinkage, Range, Shear, mobilised_share

FIRST = 0.05  # of the greatest sinkage: where a fit begins, behind first touch
LARGEST_CONDITION = 1e14  # of the normal equations
DISTINCT_LOADS = 1.5  # greatest over smallest normal stress, as the ground carried them
LARGEST_OFF_LOAD = 2.0  # ratio of what a ring carries and its load
LARGEST_SINKING = 0.4  # of the shear displacement: the correction was checked up to 0.3
LARGEST_SPEED_STRESS = 0.5  # of the shear stress under the first load
LARGEST_RESIDUAL = 0.1  # rms over the largest value of a curve


@dataclass(frozen=True)
class PlateCurve:
    """Pressure [Pa] under a round plate of a radius [m] over its sinkage [m]."""

    radius: float
    sinkage: Floats
    pressure: Floats

    def used(self) -> "PlateCurve":
        """Curve without first touch and without the rows after the greatest sinkage."""
        use = (self.sinkage > FIRST * self.sinkage.max()) & (self.pressure > 0)
        return PlateCurve(self.radius, self.sinkage[use], self.pressure[use])


@dataclass(frozen=True)
class ShearCurve:
    """Normal and shear stress [Pa] over the shear displacement [m] of one load; speed [m/s]."""

    displacement: Floats
    normal: Floats
    shear: Floats
    speed: float = 0.0
    load: float = 0.0  # [Pa] target pressure of the drive; 0 if not known
    sinking: float = 0.0  # sinkage over shear displacement in its second half
    widening: float = 1.0  # of the sheared area, as cells next to the ring shear too: a factor of the cohesion
    compacts: bool = False  # sinks as its strength grows, where the correction of share() does not hold

    def late(self) -> npt.NDArray[np.bool_]:
        """Points in the second half of the displacement, where the strength is mobilised."""
        late: npt.NDArray[np.bool_] = self.displacement > 0.5 * self.displacement.max()
        return late

    def growth(self) -> float:
        """Growth of the shear stress in the second half of the displacement, over its mean there."""
        x, y = self.displacement[self.late()], self.shear[self.late()]
        return float(line_fit(x - x.mean(), y)[0] * (x.max() - x.min()) / y.mean())

    def share(self, sine: float) -> float:
        """Share of the strength that a sinking ring measures. A ground of friction angle phi' that flows down by
        tan(psi) of its shear carries sigma sin(phi') cos(psi)/(1 + sin(phi') sin(psi)) in plane strain, E. H.
        Davis (1968), and sigma sin(phi') where psi is 0. The law of friction holds for cohesion too.

        @param sine  sin(phi')
        """
        psi = 0.0 if self.compacts else math.atan(self.sinking)
        return math.cos(psi) / (1 + sine * math.sin(psi))


@dataclass(frozen=True)
class ConeCurve:
    """Pressure on the base [Pa] over the depth of the base [m]; size of the base [m], angle of the tip [degrees]."""

    depth: Floats
    pressure: Floats
    size: float
    angle: float

    def down_to(self, depth: float) -> "ConeCurve":
        """Curve down to a sinkage [m]."""
        use = self.depth <= depth
        return ConeCurve(self.depth[use], self.pressure[use], self.size, self.angle)


def fit_plates(curves: Sequence[PlateCurve]) -> PressureSinkage:
    """Least squares in p over the greatest pressure of each plate, which J. Y. Wong (1980) prefers
    to least squares in ln p: there the first millimetres rule.

    @raises ResultsError for fewer than two sizes or curves that carry nothing
    """
    _require(len({round(curve.radius, 6) for curve in curves}) > 1, "plates of two sizes or more")
    for curve in curves:
        _require(curve.pressure.size > 0 and curve.pressure.max() > 0, "a plate that carries load")
    used = [curve.used() for curve in curves]
    tops = [float(curve.pressure.max()) for curve in used]
    deepest = max(float(curve.sinkage.max()) for curve in used)
    scale = float(np.mean(tops))  # of p at the deepest sinkage
    length = float(np.mean([curve.radius for curve in used]))

    def residuals(x: Floats) -> list[Floats]:
        """x: k_c/(length scale), k_phi/scale at the deepest sinkage, n."""
        return [
            scale * (x[0] * length / curve.radius + x[1]) * (curve.sinkage / deepest) ** x[2] / top
            - curve.pressure / top
            for curve, top in zip(used, tops)
        ]

    x, covariance, rms = _fit(residuals, (0.1, 1.0, 0.8), ((-50, -50, 0.0), (50, 50, 3.0)))
    _require(rms < LARGEST_RESIDUAL, f"curves within {LARGEST_RESIDUAL:.0%} of Bekker's law")
    # To k_c and k_phi in the units of n, with the error of n in both
    unit = scale * deepest ** -x[2]
    jacobian = np.diag((unit * length, unit, 1.0))
    jacobian[0, 2] = -x[0] * length * unit * math.log(deepest)
    jacobian[1, 2] = -x[1] * unit * math.log(deepest)
    errors = np.sqrt(np.diag(jacobian @ covariance @ jacobian.T))
    return PressureSinkage(
        Fitted(float(x[0] * length * unit), float(errors[0])),
        Fitted(float(x[1] * unit), float(errors[1])),
        Fitted(float(x[2]), float(errors[2])),
        Range(min(float(c.sinkage.min()) for c in used), deepest),
        Range(min(float(c.pressure.min()) for c in used), max(tops)),
        Range(min(c.radius for c in used), max(c.radius for c in used)),
        rms,
    )


def fit_shear(curves: Sequence[ShearCurve], fast: ShearCurve | None = None) -> Shear:
    """All loads at once, with the normal stress that each point has and the sinking of each ring.

    Transfers between particles and grid diffuse momentum with a diffusivity D. Below a ring the ground
    then yields down to a depth where this stress is used up by the weight above, so that
    v = stress^2/(2 rho D gamma sin(phi)), as for a Bingham fluid: the stress grows with the root of the
    speed, and the load does not matter. Two speeds under one load give it.

    @param fast  a faster run under the load of the first curve: the speed stress is a part of the fit
    @raises ResultsError for fewer than two loads or no shear stress
    """
    means = [float(np.mean(curve.normal)) for curve in curves]
    for curve, mean in zip(curves, means):
        held = not curve.load or curve.load / LARGEST_OFF_LOAD < mean < curve.load * LARGEST_OFF_LOAD
        _require(held, f"a ring that holds its load: it carries {mean:.0f} Pa in place of {curve.load:.0f} Pa")
        _require(
            curve.sinking < LARGEST_SINKING,
            f"a ring that sinks by less than {LARGEST_SINKING:g} of its shear displacement: under {mean:.0f} Pa "
            f"it sinks by {curve.sinking:.2f} of it",
        )
    distinct = len(curves) > 1 and max(means) > DISTINCT_LOADS * min(means)
    _require(distinct, f"a ring under loads that differ by a factor of {DISTINCT_LOADS:g}")
    top = max(float(curve.shear.max()) for curve in curves)
    _require(top > 0, "a shear stress above 0")
    longest = max(float(curve.displacement.max()) for curve in curves)
    slow = curves[0]
    every = [*curves, fast] if fast else curves

    def residuals(x: Floats) -> list[Floats]:
        """x: c/top, tan phi, K/longest, and with two speeds the speed stress of the slow one over top."""
        parts = []
        for curve in every:
            strength = (x[0] * curve.widening + curve.normal / top * x[1]) * curve.share(x[1])
            if fast:
                strength = strength + x[3] * math.sqrt(curve.speed / slow.speed)
            parts.append(strength * mobilised_share(curve.displacement, longest * x[2]) - curve.shear / top)
        return parts

    count = 4 if fast else 3
    start, low, high = (0.1, 0.5, 0.05, 0.1), (0.0, 0.0, 1e-5, 0.0), (2.0, 3.0, 10.0, 2.0)
    x, covariance, rms = _fit(residuals, start[:count], (low[:count], high[:count]))
    _require(rms < LARGEST_RESIDUAL, f"curves within {LARGEST_RESIDUAL:.0%} of Janosi's law")
    scales = np.array((top, math.degrees(1 / (1 + x[1] ** 2)), longest, top))[:count]
    errors = scales * np.sqrt(np.diag(covariance))
    speed_stress = Fitted(float(x[3] * top), float(errors[3])) if fast else Fitted(0.0, 0.0)
    _require(
        speed_stress.value < LARGEST_SPEED_STRESS * float(slow.shear[slow.late()].mean()),
        f"a speed stress below {LARGEST_SPEED_STRESS:g} of the shear stress",
    )
    return Shear(
        Fitted(float(x[0] * top), float(errors[0])),
        Fitted(math.degrees(math.atan(x[1])), float(errors[1])),
        Fitted(float(x[2] * longest), float(errors[2])),
        speed_stress,
        Range(min(means), max(means)),
        Range(0.0, longest),
        rms,
    )


def cone_index(curve: ConeCurve) -> Cone:
    """Mean pressure from the surface to 15 cm, or to the end of a shorter test, and its slope.

    @raises ResultsError for a cone whose base has not come into the ground
    """
    use = (curve.depth >= 0) & (curve.depth <= INDEX_DEPTH)
    _require(int(use.sum()) > 9, "a cone whose base is below the surface")
    depth, pressure = curve.depth[use], curve.pressure[use]
    below = depth - depth.mean()
    gradient, index, covariance = line_fit(below, pressure)
    residual = pressure - index - gradient * below
    freedom = max(depth.size / _correlation(residual) - 2, 1.0)
    errors = np.sqrt(np.diag(covariance) * (depth.size - 2) / freedom)
    return Cone(
        Fitted(index, float(errors[1])),
        Fitted(gradient, float(errors[0])),
        Range(float(depth.min()), float(depth.max())),
        curve.size,
        curve.angle,
    )


def _require(met: bool, needed: str) -> None:
    if not met:
        raise ResultsError(f"the fit needs {needed}")


def _fit(
    residuals: Callable[[Floats], list[Floats]],
    start: Sequence[float],
    bounds: tuple[Sequence[float], Sequence[float]],
) -> tuple[Floats, Floats, float]:
    """Parameters, their covariance and the rms of the residuals, which come curve by curve.

    The covariance is J^-1 (sum over curves of the autocovariance) J^-T, where the residuals of a
    curve are correlated and those of two curves are not.
    """
    found = fit(plain(start, *bounds), lambda x: np.concatenate(residuals(x)), known=False)
    parts, slope = residuals(found.values), found.value_slope
    normal = slope.T @ slope
    _require(np.linalg.cond(normal) < LARGEST_CONDITION, "curves that determine every parameter")
    inverse = np.linalg.inv(normal)
    count, middle, first = sum(part.size for part in parts), np.zeros_like(inverse), 0
    for part in parts:
        jacobian = slope[first : first + part.size]
        first += part.size
        middle += jacobian.T @ jacobian * float(np.mean(part**2)) * _correlation(part)
    freedom = count / max(count - len(start), 1)
    return found.values, inverse @ middle @ inverse * freedom, found.rms


def _correlation(residual: Floats) -> float:
    """Points that share a deviation: 1 + 2 sum of the autocorrelation, up to its first zero."""
    variance = float(np.mean(residual**2))
    if variance == 0:
        return 1.0
    total = 1.0
    for lag in range(1, residual.size // 2):
        share = float(np.mean(residual[lag:] * residual[:-lag])) / variance
        if share <= 0:
            break
        total += 2 * share
    return total
