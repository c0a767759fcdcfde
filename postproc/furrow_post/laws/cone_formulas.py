# SPDX-License-Identifier: GPL-2.0-or-later
"""Traction, resistance and sinkage of a tyre, and the vehicle cone index, from the cone index of the soil.

All take the cone index CI [Pa] as mean of the first 15 cm. b: width, d: diameter, h: section
height, delta: deflection of the tyre on hard ground, W: load.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ..errors import ResultsError
from .prediction import Limit, report_of, require_positive, require_range, require_wheel
from .tyre_size import INCH

POUND_FORCE = 4.4482216152605  # [N]
PSI = POUND_FORCE / INCH**2  # [Pa]
HORSEPOWER = 745.69987  # [W]
SHORT_TON = 2000.0  # [lb]


@dataclass(frozen=True)
class Traction:
    """Result of a formula at a slip; coefficients are forces over the load."""

    method: str
    source: str
    numeric: float  # mobility number
    slip: float
    load: float  # [N]
    gross: float  # torque over rolling radius and load
    resistance: float  # motion resistance over load, at this slip
    outside: tuple[str, ...] = ()
    sinkage: float = math.nan  # [m] at this slip
    towed_resistance: float = math.nan  # motion resistance over load of a towed wheel
    towed_sinkage: float = math.nan  # [m]
    mark: str = ""  # assumptions of the formula, and parts that were not checked with the source

    @property
    def net(self) -> float:
        """Drawbar pull over load."""
        return self.gross - self.resistance

    def report(self) -> str:
        rows = (
            ("mobility number", f"{self.numeric:.3f}"),
            ("slip", f"{self.slip:.3f}"),
            ("gross traction coefficient", f"{self.gross:.4f}"),
            ("resistance coefficient", f"{self.resistance:.4f}"),
            ("net traction coefficient", f"{self.net:.4f}"),
            ("drawbar pull", f"{self.net * self.load:.4g} N"),
            ("motion resistance", f"{self.resistance * self.load:.4g} N"),
            ("sinkage", f"{1e3 * self.sinkage:.4g} mm"),
            ("towed: resistance", f"{self.towed_resistance:.4f}"),
            ("towed: sinkage", f"{1e3 * self.towed_sinkage:.4g} mm"),
        )
        known = [(name, value) for name, value in rows if not value.startswith("nan")]
        notes = [f"MARK: {self.mark}"] if self.mark else []
        notes += [f"EXTRAPOLATED: {limit}" for limit in self.outside]
        return report_of(self.method, self.source, known, 27, notes)


@dataclass(frozen=True)
class Tyre:
    """Load [N]; diameter, width, section height and deflection [m]."""

    load: float
    diameter: float
    width: float
    section_height: float = math.nan
    deflection: float = math.nan
    radial: bool = field(default=False, kw_only=True)

    @property
    def deflection_ratio(self) -> float:
        return self.deflection / self.section_height

    @property
    def width_ratio(self) -> float:
        """Width over diameter."""
        return self.width / self.diameter

    def clay_number(self, cone_index: float) -> float:
        """CI b d/W"""
        return cone_index * self.width * self.diameter / self.load

    def require_deflection(self, method: str) -> None:
        """@raises ResultsError where the deflection is not known, or exceeds the section height"""
        require_positive(method, section_height=self.section_height, deflection=self.deflection)
        if self.deflection >= self.section_height:
            raise ResultsError(
                f"{method}: deflection is {self.deflection:g} m, and the section height "
                f"{self.section_height:g} m; give a smaller deflection"
            )


# Limits of a formula -> those that are not met, in words. @raises OutOfRange unless they may be left
Within = Callable[..., tuple[str, ...]]
# Cone index [Pa], tyre, slip, limits -> numeric, gross, resistance and what else Traction has
Equations = Callable[[float, Tyre, float, Within], dict[str, float]]


@dataclass(frozen=True)
class ConeFormula:
    """A formula; call it with the cone index [Pa], a tyre and the slip."""

    method: str
    source: str
    equations: Equations
    deflected: bool  # the formula needs the deflection of the tyre
    mark: str

    def __call__(self, cone_index: float, tyre: Tyre, slip: float, extrapolate: bool = False) -> Traction:
        """@raises OutOfRange outside of its range, unless told to extrapolate; ResultsError"""
        require_wheel(self.method, tyre.load, tyre.diameter, tyre.width)
        if self.deflected:
            tyre.require_deflection(self.method)
        require_positive(self.method, cone_index=cone_index)
        outside: list[str] = []

        def within(*limits: Limit) -> tuple[str, ...]:
            outside.extend(require_range(self.method, limits, extrapolate))
            return tuple(outside)

        values: dict[str, Any] = {**self.equations(cone_index, tyre, slip, within), "outside": tuple(outside)}
        return Traction(self.method, self.source, slip=slip, load=tyre.load, mark=self.mark, **values)


def _formula(method: str, source: str, deflected: bool = True, mark: str = "") -> Callable[[Equations], ConeFormula]:
    return lambda equations: ConeFormula(method, source, equations, deflected, mark)


def _slip_limit(slip: float) -> Limit:
    return Limit("slip", slip, 0.0, 1.0, "", "driving")


@_formula("Wismer-Luth", "R. D. Wismer and H. J. Luth, Trans. ASAE 17(1), 8-10 (1974)", deflected=False)
def wismer_luth(cone_index: float, tyre: Tyre, slip: float, within: Within) -> dict[str, float]:
    """GT/W = 0.75 (1 - exp(-0.3 C_n s)), R/W = 1.2/C_n + 0.04."""
    number = tyre.clay_number(cone_index)
    within(_slip_limit(slip), Limit("width over diameter", tyre.width_ratio, 0.2, 0.4, "", "tyres of about 0.3"))
    gross = 0.75 * (1 - math.exp(-0.3 * number * slip))
    return {"numeric": number, "gross": gross, "resistance": 1.2 / number + 0.04}


@_formula("Brixius", "W. W. Brixius, ASAE paper 87-1622 (1987); ASAE D497")
def brixius(cone_index: float, tyre: Tyre, slip: float, within: Within) -> dict[str, float]:
    """B_n = C_n (1 + 5 delta/h)/(1 + 3 b/d); GT/W = 0.88 (1 - exp(-0.1 B_n))(1 - exp(-7.5 s)) + 0.04,
    R/W = 1/B_n + 0.04 + 0.5 s/sqrt(B_n). A radial tyre has 9.5, 0.0325 and 0.9/B_n."""
    number = tyre.clay_number(cone_index) * (1 + 5 * tyre.deflection_ratio) / (1 + 3 * tyre.width_ratio)
    pressure = tyre.load / (tyre.width * tyre.diameter)
    why = "ASAE D497"
    within(
        _slip_limit(slip),
        Limit("width over diameter", tyre.width_ratio, 0.1, 0.7, "", why),
        Limit("deflection over section height", tyre.deflection_ratio, 0.1, 0.3, "", why),
        Limit("load over width and diameter", pressure, 15e3, 55e3, "Pa", why),
    )
    rate, rolling, sinking = (9.5, 0.0325, 0.9) if tyre.radial else (7.5, 0.04, 1.0)
    gross = 0.88 * (1 - math.exp(-0.1 * number)) * (1 - math.exp(-rate * slip)) + rolling
    resistance = sinking / number + rolling + 0.5 * slip / math.sqrt(number)
    return {"numeric": number, "gross": gross, "resistance": resistance}


@_formula("Gee-Clough", "D. Gee-Clough et al., J. Terramechanics 15(2), 81-94 (1978)")
def gee_clough(cone_index: float, tyre: Tyre, slip: float, within: Within) -> dict[str, float]:
    """M = C_n sqrt(delta/h)/(1 + b/(2 d)); net NT/W = C (1 - exp(-k s)), C = 0.796 - 0.92/M, k C =
    4.838 + 0.061 M, R/W = 0.049 + 0.287/M. Field tyres on farm land."""
    number = tyre.clay_number(cone_index) * math.sqrt(tyre.deflection_ratio) / (1 + 0.5 * tyre.width_ratio)
    largest = 0.796 - 0.92 / number
    if largest <= 0:
        raise ResultsError(
            f"Gee-Clough: the mobility number is {number:.3g}, for which the tyre has no traction; allowed: above 1.16"
        )
    within(_slip_limit(slip))
    rate = (4.838 + 0.061 * number) / largest
    resistance = 0.049 + 0.287 / number
    return {"numeric": number, "gross": largest * (1 - math.exp(-rate * slip)) + resistance, "resistance": resistance}


@_formula(
    "VTI, clay",
    "Vehicle-Terrain Interface of ERDC, in MAVS (2024), vehicles/vti/fine_grained.cpp",
    mark="the source gives sinkage without a unit; read as a share of the diameter",
)
def vti_clay(rating: float, tyre: Tyre, slip: float, within: Within) -> dict[str, float]:
    """Fine-grained soil by its rating cone index RCI [Pa]: N_c = RCI b d/(W (1 - delta/h)^1.5 (1 +
    b/d)^0.75), self-propelled slip s_0 = 21/N_c^2.5 + 0.005, GT/W = 0.5 log10(s/s_0) (1 + b/d)^0.25 +
    12/N_c^2 + 0.007 up to 1, R/W = 5.07/N_c^1.71 + 0.011. With N_z = N_c (1 + b/d)^0.75 the sinkage is 1.64 d
    (s_0^0.19/N_z)^1.21, of a towed wheel d (2.66/N_z^1.64 - 0.0063)."""
    shape = 1 + tyre.width_ratio
    softness = (1 - tyre.deflection_ratio) ** 1.5
    number = tyre.clay_number(rating) / (softness * shape**0.75)
    free = 21 / number**2.5 + 0.005
    within(Limit("slip", slip, free, 1.0, "", "below it the tyre does not propel itself"))
    require_positive("VTI, clay", slip=slip)
    deep = number * shape**0.75
    return {
        "numeric": number,
        "gross": min(0.5 * math.log10(slip / free) * shape**0.25 + 12 / number**2 + 0.007, 1.0),
        "resistance": 5.07 / number**1.71 + 0.011,
        "sinkage": 1.64 * tyre.diameter * (free**0.19 / deep) ** 1.21,
        "towed_sinkage": tyre.diameter * max(2.66 / deep**1.64 - 0.0063, 0.0),
    }


@_formula(
    "DROVE, sand",
    "Mason et al. (2016, 2018), Williams et al. (2017), DROVE records of dry sand, in MAVS (2024), "
    "vehicles/vti/coarse_grained.cpp",
)
def drove_sand(cone_index: float, tyre: Tyre, slip: float, within: Within) -> dict[str, float]:
    """Dry sand. Contact pressure CP = W/(2 b sqrt(d a - a^2) (b/h)^0.52) with a = delta + 0.026 d, q = CP/CI,
    GT/W = -0.5 + (T + 0.5)/(1 + A exp(-7 s))^(1/C), T = 0.42 + 0.009/q, A = 0.76 + 0.014/q, C = 1.56 - 0.022/q;
    R/W = 0.4 q + 0.6 s - 0.03, towed 0.21 q + 0.04. Sinkage 14 d/N, towed 22 d/(N/(1 - b/d))^1.125 with
    N = CI (b d)^1.5/((1 - delta/h) W), in inches."""
    b, d = tyre.width, tyre.diameter
    chord = tyre.deflection + 0.026 * d
    contact = tyre.load / (2 * b * math.sqrt(d * chord - chord**2) * (b / tyre.section_height) ** 0.52)
    q = contact / cone_index
    outside = within(
        _slip_limit(slip),
        Limit("contact pressure over cone index", q, 0.03, 1.0, "", "firmer sand has no largest traction"),
        Limit("width over diameter", b / d, 0.0, 0.9, "", "a towed wheel sinks without limit at 1"),
    )
    exponent = 1.56 - 0.022 / q
    if exponent <= 0 or b >= d:
        raise ResultsError(f"DROVE, sand: has no value here: {'; '.join(outside)}")
    most, steep = 0.42 + 0.009 / q, 0.76 + 0.014 / q
    number = cone_index * (b * d) ** 1.5 / ((1 - tyre.deflection_ratio) * tyre.load) / INCH
    return {
        "numeric": number,
        "gross": -0.5 + (most + 0.5) / (1 + steep * math.exp(-7 * slip)) ** (1 / exponent),
        "resistance": 0.4 * q + 0.6 * slip - 0.03,
        "sinkage": 14 * d / number,
        "towed_resistance": 0.21 * q + 0.04,
        "towed_sinkage": 22 * d / (number / (1 - b / d)) ** 1.125,
    }


@_formula(
    "Maclaurin",
    "E. B. Maclaurin (1990, 1997), after M. Saarilahti (2002)",
    mark="traction and resistance from memory",
)
def maclaurin(cone_index: float, tyre: Tyre, slip: float, within: Within) -> dict[str, float]:
    """N = CI b^0.8 d^0.8 delta^0.4/W; R/W = 0.017 + 0.453/N; at 20 % slip NT/W = 0.817 - 3.2/(N + 1.91), at
    other slips none; rut of the first pass 0.224 d/N^1.25."""
    size = (tyre.width * tyre.diameter) ** 0.8 * tyre.deflection**0.4
    number = cone_index * size / tyre.load
    within(_slip_limit(slip), Limit("mobility number", number, 1.85, math.inf, "", "below it a tyre is stuck"))
    resistance = 0.017 + 0.453 / number
    gross = 0.817 - 3.2 / (number + 1.91) + resistance if math.isclose(slip, 0.2) else math.nan
    sinkage = 0.224 * tyre.diameter / number**1.25
    return {"numeric": number, "gross": gross, "resistance": resistance, "sinkage": sinkage}


FORMULAS = {"clay": (wismer_luth, brixius, gee_clough, vti_clay, maclaurin), "sand": (drove_sand,)}
# Column of a table -> heading, factor to its unit, decimals
COLUMNS = {
    "gross": ("gross", 1.0, 3),
    "resistance": ("resistance", 1.0, 3),
    "net": ("net", 1.0, 3),
    "sinkage": ("sinkage [mm]", 1e3, 0),
    "towed_resistance": ("towed", 1.0, 3),
    "towed_sinkage": ("towed [mm]", 1e3, 0),
}


@dataclass(frozen=True)
class Formulas:
    """All formulas of a kind of soil for one tyre."""

    soil: str
    answers: tuple[Traction, ...]
    refused: tuple[str, ...]  # formulas without an answer, with the cause

    def band(self, quantity: str) -> tuple[float, float, float] | None:
        """Mean, minimum and maximum of the formulas within their ranges; None if no formula is in its range."""
        values = [getattr(answer, quantity) for answer in self.answers if not answer.outside]
        values = [value for value in values if math.isfinite(value)]
        return (sum(values) / len(values), min(values), max(values)) if values else None

    def report(self) -> str:
        bands = zip(*(self.band(name) or (math.nan,) * 3 for name in COLUMNS))
        marks = {a.method: "!" if a.outside else "*" if a.mark else "" for a in self.answers}
        rows = {f"{a.method} {marks[a.method]}": [getattr(a, name) for name in COLUMNS] for a in self.answers}
        rows |= {title: list(band) for title, band in zip(("mean", "least", "greatest"), bands)}
        lines = [f"{'':16}" + "".join(f"{heading:>13}" for heading, _, _ in COLUMNS.values())]
        for title, values in rows.items():
            shown = (
                f"{unit * value:.{digits}f}" if math.isfinite(value) else "-"
                for value, (_, unit, digits) in zip(values, COLUMNS.values())
            )
            lines.append(f"{title:16}" + "".join(f"{cell:>13}" for cell in shown))
        lines.append("Forces over the load. Mean, least and greatest are those of the formulas within their range.")
        lines += [f"* {answer.method}: {answer.mark}" for answer in self.answers if answer.mark]
        lines += [f"! {a.method}: EXTRAPOLATED: {limit}" for a in self.answers for limit in a.outside]
        return "\n".join([*lines, *(f"! {cause}" for cause in self.refused)])


def formulas_for(soil: str, cone_index: float, tyre: Tyre, slip: float) -> Formulas:
    """soil: of FORMULAS. A formula answers outside of its range too, with a mark.

    @raises ResultsError without any answer
    """
    answers, refused = [], []
    for formula in FORMULAS[soil]:
        try:
            answers.append(formula(cone_index, tyre, slip, extrapolate=True))
        except ResultsError as error:
            refused.append(str(error))
    if not answers:
        raise ResultsError("; ".join(refused))
    return Formulas(soil, tuple(answers), tuple(refused))


VCI_SOURCE = "J. D. Priddy and W. E. Willoughby, J. Terramechanics (2006), doi 10.1016/j.jterra.2004.10.001"
# Weight of an axle up to [lb], slope per kip, intercept of the weight factor
WEIGHT_FACTORS = (
    (2000.0, 0.553, 0.0),
    (13500.0, 0.033, 1.05),
    (20000.0, 0.142, -0.42),
    (math.inf, 0.278, -3.115),
)


@dataclass(frozen=True)
class WheeledVehicle:
    """Weight [N], clearance [m], power [W]; every axle is driven."""

    weight: float
    axles: int
    tyres: int
    tyre: Tyre  # its load is not used
    clearance: float
    power: float
    manual: bool = False  # transmission
    chains: bool = False


@dataclass(frozen=True)
class VehicleConeIndex:
    """Rating cone index [Pa] that a vehicle needs for one pass."""

    mobility_index: float
    one_pass: float

    def report(self) -> str:
        one_pass = f"{self.one_pass / PSI:.2f} psi, {1e-3 * self.one_pass:.4g} kPa"
        rows = [("mobility index", f"{self.mobility_index:.2f}"), ("VCI of one pass", one_pass)]
        return report_of("Vehicle cone index, fine-grained soil", VCI_SOURCE, rows, 27)


def weight_factor(kips: float) -> float:
    """Factor of the weight of an axle [1000 lb]."""
    slope, intercept = next(row[1:] for row in WEIGHT_FACTORS if 1000 * kips <= row[0])
    return slope * kips + intercept


def vehicle_cone_index(vehicle: WheeledVehicle) -> VehicleConeIndex:
    """MI = (CPF WF/(TF GF) + WLF - CF) EF TF', in pounds and inches; VCI_1 = 11.48 + 0.2 MI - 39.2/(MI
    + 3.74) up to MI = 115, 4.1 MI^0.446 above; times (0.15/(delta/h))^0.25 where the deflection is
    known. @raises ResultsError"""
    method, tyre = "vehicle cone index", vehicle.tyre
    numbers = {"weight": vehicle.weight, "axles": vehicle.axles, "tyres": vehicle.tyres}
    require_positive(method, **numbers, clearance=vehicle.clearance, power=vehicle.power)
    require_positive(method, width=tyre.width, diameter=tyre.diameter)
    pounds, width = vehicle.weight / POUND_FORCE, tyre.width / INCH
    radius, kips = 0.5 * tyre.diameter / INCH, pounds / 1000
    contact = pounds / (width * radius * vehicle.tyres)
    grip = (10 + width) / 100 * (1.05 if vehicle.chains else 1.0)
    load, clearance = kips / (2 * vehicle.axles), vehicle.clearance / INCH / 10
    engine = 1.0 if vehicle.power / HORSEPOWER / (pounds / SHORT_TON) >= 10 else 1.05
    transmission = 1.05 if vehicle.manual else 1.0
    index = (contact * weight_factor(kips / vehicle.axles) / grip + load - clearance) * engine * transmission
    if index <= 0:
        raise ResultsError(f"{method}: the mobility index is {index:.3g}, below 0; check weight, tyres and clearance")
    psi = 11.48 + 0.2 * index - 39.2 / (index + 3.74) if index <= 115 else 4.1 * index**0.446
    if math.isfinite(tyre.deflection_ratio):
        psi *= (0.15 / tyre.deflection_ratio) ** 0.25
    return VehicleConeIndex(index, psi * PSI)
