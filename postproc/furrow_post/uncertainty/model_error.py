# SPDX-License-Identifier: GPL-2.0-or-later
"""Error of the model: how far computed values were from measurements, by regime.

A test is one measured comparison, or a group of which only rms and mean are known. Its difference is computed
less measured, over the computed value for depths, deflections and loads of plates, else absolute. e is the
standard error of both values. The error of a regime follows from

    model error^2 = (t/2)^2 mean over studies of [mean over tests of (difference^2 - e^2)],

not below a quarter of the mean of difference^2. Tests of one study share soil and rig: n of them count as
1/(r^2 + (1 - r^2)/n) independent ones, where r is the correlation of two tests of a study. Studies weigh by this number.
t is Student's for their sum, such that two errors hold 95 % also where few tests are independent. A case at the distance
d from the nearest tests has the error of these times sqrt(1 + d^2). d^2 is the sum of the squares of MISMATCH for
each word that differs, and of (how far a number is outside of that of the tests)/SCALES. Beyond FARTHEST it is unknown.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import stdtrit

from .statistics import grouped
from .validation_table import Rows, ValidationTable

# Steps by which the words of a regime differ, and the ranges that count as one step outside of the tests
MISMATCH = {"ground": 2.0, "wheel": 1.0, "motion": 1.0, "grousers": 1.0}
SCALES = {"slip": 0.2, "slip_angle": 20.0, "slope": 10.0, "sinkage": math.log(2), "radius": math.log(2)}
LOGARITHMIC = ("sinkage", "radius")
FARTHEST = 3.0
LEAST_SHARE = 0.25  # of the mean square of the differences
UPPER = 0.97725  # below mean and two standard deviations of a normal distribution
# Quantities of a run -> quantity of the tests; a rigid wheel's depths have one name
OF_RUN = {
    "hub_drop": "hub drop",
    "rut_depth": "depth",
    "tyre_deflection": "deflection",
    "resistance_coefficient": "coefficient",
    "net_traction_coefficient": "coefficient",
    "lateral_force": "lateral",  # over the vertical force
    "slip": "slip",
}
RELATIVE = ("depth", "hub drop", "deflection", "plate load")


@dataclass(frozen=True)
class Case:
    """Conditions that decide how near tests are. NaN: not known, or without a meaning."""

    ground: str  # snow, sand, road
    wheel: str  # rigid wheel, tyre, plate
    motion: str  # towed, driven, braked, pressed
    grousers: str  # yes, no
    slip: float = math.nan
    slip_angle: float = math.nan  # [deg], without sign
    slope: float = math.nan  # [deg]
    sinkage: float = math.nan  # over the radius
    radius: float = math.nan  # [m]

    def text(self) -> str:
        bars = " with grousers" if self.grousers == "yes" else ""
        slope = ", slope" if self.slope > 0 else ""
        return f"{self.wheel}{bars} {self.motion} on {self.ground}{slope}"


@dataclass(frozen=True)
class Test:
    """A measured comparison, or a group of them whose difference is a rms."""

    study: str
    label: str  # known, held out, blind; not fitted
    quantity: str
    case: Case
    tests: int
    difference: float
    error: float  # of computed and measured value, as the difference
    mean: float = math.nan  # of a group
    computed: float = math.nan  # a depth over the radius; NaN: not kept, or of a group

    @property
    def _scale(self) -> float:
        """Scale of difference and error, in the unit of the computed value."""
        return self.computed if self.quantity in RELATIVE else 1.0

    @property
    def measured(self) -> float:
        return self.computed - self._scale * self.difference

    @property
    def error_of_value(self) -> float:
        return self._scale * self.error

    @property
    def bias(self) -> float:
        return self.difference if self.tests == 1 else self.mean


@dataclass(frozen=True)
class Regime:
    """Tests of one kind, and the error of the model that they show."""

    quantity: str
    words: Mapping[str, str]  # of MISMATCH
    ranges: Mapping[str, tuple[float, float]]  # of SCALES
    tests: int
    studies: tuple[str, ...]
    bias: float
    scatter: float  # about the bias
    independent: float  # number of independent tests
    model: float

    def distance(self, case: Case) -> float:
        steps = [MISMATCH[name] for name, word in self.words.items() if word != getattr(case, name)]
        for name, (low, high) in self.ranges.items():
            value = getattr(case, name)
            if name in LOGARITHMIC:
                value, low, high = (math.log(max(one, 1e-3)) for one in (value, low, high))
            outside = max(low - value, value - high, 0.0)
            steps.append(outside / SCALES[name] if math.isfinite(outside) else 0.0)
        return math.hypot(*steps)

    def has(self, test: Test) -> bool:
        alike = all(getattr(test.case, name) == word for name, word in self.words.items())
        return test.quantity == self.quantity and alike and (test.case.slope > 0) == (self.ranges["slope"][1] > 0)

    def text(self) -> str:
        words: dict[str, Any] = {**self.words}
        case = Case(**words, slope=self.ranges["slope"][1])
        count = f"{self.tests} tests" if self.tests > 1 else "1 test"
        return f"{count}: {case.text()} ({', '.join(self.studies)})"


@dataclass(frozen=True)
class ModelError:
    """Model error of one quantity of a case: relative for RELATIVE ones."""

    value: float
    distance: float
    nearest: Regime

    def source(self) -> str:
        far = f", {self.distance:.1f} steps away" if self.distance > 0 else ""
        return self.nearest.text() + far


def regimes_of(tests: Iterable[Test]) -> list[Regime]:
    """Tests by quantity, ground, wheel, motion, grousers, and whether there is a slope."""

    def kind(test: Test) -> tuple[object, ...]:
        return (test.quantity, *(getattr(test.case, name) for name in MISMATCH), test.case.slope > 0)

    groups = grouped(tests, kind)
    alike = correlation([_studies(group) for group in groups.values()])
    return [_regime(group, alike) for group in groups.values()]


def _studies(tests: Sequence[Test]) -> list[list[Test]]:
    return list(grouped(tests, lambda test: test.study).values())


def correlation(regimes: Iterable[Sequence[Sequence[Test]]]) -> float:
    """Correlation of two tests of a study: share of the bias of studies in the mean square. 1 where no study shows it.

    regimes: tests by study; each counts over its own mean square
    """
    biases, squares = 0.0, 0.0
    for studies in regimes:
        of_regime = sum(_mean(study, lambda test: test.difference**2) for study in studies) / len(studies)
        for tests in studies:
            count, square, bias = _count(tests), _mean(tests, lambda test: test.difference**2), _mean(tests, lambda test: test.bias)
            if count > 1 and of_regime > 0 and math.isfinite(bias):
                biases += (bias**2 - (square - bias**2) / (count - 1)) / of_regime
                squares += square / of_regime
    return min(max(biases / squares, 0.0), 1.0) if squares else 1.0


def _regime(tests: Sequence[Test], alike: float) -> Regime:
    first, studies = tests[0], _studies(tests)
    weights = [1.0 / (alike**2 + (1.0 - alike**2) / _count(study)) for study in studies]
    independent = sum(weights)
    squares, noise = (
        sum(weight * _mean(study, value) for weight, study in zip(weights, studies)) / independent
        for value in (lambda test: test.difference**2, lambda test: test.error**2)
    )
    few = float(stdtrit(independent, UPPER)) / 2.0
    known = [test for test in tests if math.isfinite(test.bias)]
    bias = _mean(known, lambda test: test.bias)
    return Regime(
        first.quantity,
        {name: getattr(first.case, name) for name in MISMATCH},
        {name: _range([getattr(test.case, name) for test in tests]) for name in SCALES},
        _count(tests),
        tuple(study[0].study for study in studies),
        bias,
        math.sqrt(max(_mean(known, lambda test: test.difference**2) - bias**2, 0.0)) if known else math.nan,
        independent,
        few * math.sqrt(max(squares - noise, LEAST_SHARE * squares)),
    )


def _count(tests: Sequence[Test]) -> int:
    return sum(test.tests for test in tests)


def _mean(tests: Sequence[Test], value: Callable[[Test], float]) -> float:
    """Mean of numbers; NaN without any."""
    return sum(test.tests * value(test) for test in tests) / _count(tests) if tests else math.nan


def _range(values: Iterable[float]) -> tuple[float, float]:
    known = [value for value in values if math.isfinite(value)]
    return (min(known), max(known)) if known else (math.nan, math.nan)


def model_error(regimes: Sequence[Regime], quantity: str, case: Case) -> ModelError | None:
    """Error by the nearest tests of a quantity, the larger one of equally near tests; None without a near test."""
    known = [(round(regime.distance(case), 6), regime) for regime in regimes if regime.quantity == quantity]
    if not known:
        return None
    distance, nearest = min(known, key=lambda pair: (pair[0], -pair[1].model))
    if distance > FARTHEST:
        return None
    return ModelError(nearest.model * math.hypot(1.0, distance), distance, nearest)


# ---- calibration: each study predicted from the others


@dataclass(frozen=True)
class Scored:
    """A test with its error by the rule, from the other studies."""

    test: Test
    error: float  # of the model, of the computed and the measured value

    @property
    def normalised(self) -> float:
        return self.test.difference / self.error


def leave_one_study_out(tests: Sequence[Test]) -> list[Scored]:
    """Tests with the error that the other studies predict for them."""
    found = []
    for study in _studies(tests):
        others = regimes_of(test for test in tests if test.study != study[0].study)
        errors = ((test, model_error(others, test.quantity, test.case)) for test in study)
        found += [Scored(test, math.hypot(error.value, test.error)) for test, error in errors if error]
    return found


def calibration_rows(tests: Sequence[Test]) -> list[dict[str, object]]:
    """Regime by regime, and all: rms of the normalised differences, and the share within two errors.

    The share is of single tests alone: of a group only the rms is known.
    """
    scored = leave_one_study_out(tests)

    def regime(one: Scored) -> tuple[str, str]:
        case = one.test.case
        return one.test.quantity, f"{case.ground}, {case.motion}{', slope' if case.slope > 0 else ''}"

    groups = grouped(scored, regime) | {("all", "all"): scored}
    return [_calibration(quantity, name, group) for (quantity, name), group in groups.items()]


def _calibration(quantity: str, name: str, scored: Sequence[Scored]) -> dict[str, object]:
    counts = [one.test.tests for one in scored]
    square = np.average([one.normalised**2 for one in scored], weights=counts)
    single = [abs(one.normalised) for one in scored if one.test.tests == 1]
    return {
        "quantity": quantity,
        "regime": name,
        "tests": sum(counts),
        "rms": round(math.sqrt(square), 2),
        "single_tests": len(single),
        "inside_two_errors": round(sum(z <= 2 for z in single) / len(single), 2) if single else "",
    }


# ---- the tables of inputs/validation


def test_of(row: Mapping[str, str]) -> Test:
    """Test from a row of measured.csv."""
    case = case_of_row(row)
    values = (int(row["tests"]), float(row["difference"]), float(row["error"]), _number(row["mean"]), _number(row["computed"]))
    return Test(row["study"], row["label"], row["quantity"], case, *values)


def scored_error(regimes: Sequence[Regime], row: Mapping[str, Any]) -> str:
    """Error of a prediction with the columns of a case, what (quantity), noise and over (scale); empty: no test is near."""
    error = model_error(regimes, row["what"], case_of_row(row))
    return f"{math.hypot(error.value, row['noise']) * row['over']:.2g}" if error else ""


def case_of_row(row: Mapping[str, Any]) -> Case:
    """Case from the columns of measured.csv."""
    features: dict[str, Any] = {name: row[name] for name in MISMATCH}
    features.update({name: _number(str(row[name])) for name in SCALES})
    return Case(**features)


def _number(text: str) -> float:
    return float(text) if text else math.nan


def regime_rows(tests: Iterable[Test]) -> list[dict[str, object]]:
    """Rows of model_errors.csv."""
    rows = []
    for regime in regimes_of(tests):
        row: dict[str, object] = {"quantity": regime.quantity, **regime.words, "tests": regime.tests}
        row |= {"studies": " ".join(regime.studies)}
        row |= {name: _cell(getattr(regime, name)) for name in ("bias", "scatter", "independent", "model")}
        for name, ends in regime.ranges.items():
            row |= {f"{name}_{end}": _cell(value) for end, value in zip(("low", "high"), ends)}
        rows.append(row)
    return rows


def _cell(value: float) -> str:
    return f"{value:.4g}" if math.isfinite(value) else ""


def _regimes_from(rows: Rows) -> tuple[Regime, ...]:
    """Regimes from the rows of model_errors.csv."""
    found = []
    for row in rows:
        ranges = {name: (_number(row[f"{name}_low"]), _number(row[f"{name}_high"])) for name in SCALES}
        numbers = [_number(row[name]) for name in ("bias", "scatter", "independent", "model")]
        words, studies = {name: row[name] for name in MISMATCH}, tuple(row["studies"].split())
        found.append(Regime(row["quantity"], words, ranges, int(row["tests"]), studies, *numbers))
    return tuple(found)


TESTS = ValidationTable("measured.csv", lambda rows: [test_of(row) for row in rows])
REGIMES = ValidationTable("model_errors.csv", _regimes_from)  # of these tests
