# SPDX-License-Identifier: GPL-2.0-or-later
"""One parameter of a material from measured rows, by runs with three of its values.

Quantities of the runs are interpolated: over the parameter M by a parabola in 1/M^2, of which they are nearly straight
lines, and over the place of a row by straight lines. The parameter is the one of the least sum of squares over the
goals. Its range is where that sum exceeds the least one by no more than the share 1/(N - 1) of it, N the number of its
terms: one standard error where the tests' scatter is all that is left. An end of the values that were run is a bound.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..uncertainty.statistics import rms

TRIED = 1901  # values between the ends


@dataclass(frozen=True)
class Identified:
    """Identified parameter, its range, and the rms residual of each quantity."""

    value: float
    low: float
    high: float
    left: Mapping[str, float]


@dataclass(frozen=True)
class Response:
    """Runs with three values of the parameter: quantity -> (values, places), places increasing."""

    values: Sequence[float]
    places: Sequence[float]
    quantities: Mapping[str, Floats]

    def reaches(self, places: Sequence[float]) -> bool:
        """True where all places lie between those that were run."""
        return bool(self.places[0] <= min(places) and max(places) <= self.places[-1])

    def tried(self) -> Floats:
        return np.linspace(min(self.values), max(self.values), TRIED)

    def at(self, quantity: str, places: Sequence[float]) -> Floats:
        """Response of quantities at a tried value, for each place."""
        rows = np.array([np.interp(places, self.places, line) for line in self.quantities[quantity]])
        fits = np.polyfit(np.array(self.values) ** -2.0, rows, 2)
        return np.array([np.polyval(fit, self.tried() ** -2.0) for fit in fits.T]).T

    def identify(self, places: Sequence[float], measured: Mapping[str, Sequence[float] | float], goals: Mapping[str, float]) -> Identified:
        """measured: quantity -> a value for each place, or a single one that was measured once."""
        wrong = {what: self.at(what, places) - np.asarray(measured[what]) for what in goals}
        total = sum(np.mean((wrong[what] / goal) ** 2, axis=1) for what, goal in goals.items())
        best = int(np.argmin(total))
        terms = sum(1 if np.isscalar(measured[what]) else len(places) for what in goals)
        inside = self.tried()[total <= total[best] * (1 + 1 / (terms - 1))]
        left = {what: rms(errors[best]) for what, errors in wrong.items()}
        return Identified(float(self.tried()[best]), float(inside[0]), float(inside[-1]), left)
