# SPDX-License-Identifier: GPL-2.0-or-later
"""A material file from what a user knows of a soil, by three routes.

All three give the cap law with the section of Matsuoka and Nakai. Its strength is that of
Mohr-Coulomb in triaxial compression and extension (inputs/guide/soil_files.md).
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from ..arrays import Floats
from ..errors import ResultsError
from ..read.soil_card import EARTH, INDEX_DEPTH, Range
from .material import NewMaterial, Parameter, require_plausible
from .oedometer import Confined

POISSON = Parameter(0.25, "0.2 to 0.35 for soil", guessed=True)
# Ratio of elastic to oedometric modulus: unloading modulus 3 times the secant modulus E_50, T. Schanz,
# P. A. Vermeer and P. G. Bonnier, Beyond 2000 in Computational Geotechnics (1999), 281-296
UNLOADING = 3.0
REFERENCE = 1e5  # [Pa] of the oedometric modulus
EXPONENT = 0.5  # M = M_ref (sigma/REFERENCE)^EXPONENT, N. Janbu, ECSMFE (1963), sand
STRESSES = (5e2, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5)  # [Pa] of a table
SMALLEST_COHESION = 100.0  # [Pa] d that keeps a free surface together
QUARTZ = 2650.0  # [kg/m3] density without voids, at which a table ends
# density [kg/m3]
LOOSE_SAND = Parameter(1600.0, "loose dry sand, K. Terzaghi and R. B. Peck (1967), Table 6.3", guessed=True)
CAP = Parameter(0.02, "a steep cap: compression at the shear strength", guessed=True)  # R


@dataclass(frozen=True)
class Strength:
    """Cohesion [Pa] and friction angle [degrees] of Mohr-Coulomb."""

    c: float
    phi: float

    @property
    def sine(self) -> float:
        return math.sin(math.radians(self.phi))

    @property
    def tangent(self) -> float:
        """tan(beta) of the cap law in triaxial compression."""
        return 6 * self.sine / (3 - self.sine)

    @property
    def d(self) -> float:
        cosine = math.cos(math.radians(self.phi))
        return max(6 * self.c * cosine / (3 - self.sine), SMALLEST_COHESION)

    @property
    def K(self) -> float:
        return (3 - self.sine) / (3 + self.sine)

    def mean_stress(self, axial: Floats) -> Floats:
        """Mean stress of confined compression at the corner of shear line and cap: q = d + p tan(beta)."""
        p: Floats = (np.asarray(axial) - 2 / 3 * self.d) / (1 + 2 / 3 * self.tangent)
        return p

    def yield_strength(self, mean: Floats) -> Floats:
        """Hydrostatic yield strength of the cap with its corner at a mean stress."""
        p: Floats = mean + float(CAP.value) * (self.d + mean * self.tangent)
        return p


def confined_of_modulus(modulus: float, reference: float = REFERENCE) -> Confined:
    """Confined curve of an oedometric modulus [Pa] at a reference stress [Pa]; it grows with the root of stress."""
    stress = np.array(STRESSES)
    strain = reference / modulus / (1 - EXPONENT) * (stress / reference) ** (1 - EXPONENT)
    return Confined(
        STRESSES,
        tuple(strain),
        f"Janbu (1963) with an oedometric modulus of {modulus:.3g} Pa at {reference:.3g} Pa",
        guessed=True,
    )


def confined_of_plate(k_c: float, k_phi: float, n: float, radius: float) -> Confined:
    """Confined curve that gives Bekker's curve of a plate. A rigid plate on an elastic half-space sinks as if a layer as
    thick as 0.96 diameters were confined below it (Timoshenko and Goodier, eq 217, nu 0.3)."""
    modulus = k_c / radius + k_phi
    if modulus <= 0:
        raise ResultsError(
            f"k_c/b + k_phi is {modulus:g} for a plate of radius {radius:g} m; it must be above 0"
        )
    thickness = 0.96 * 2 * radius
    strain = np.geomspace(2e-3, 0.6, 12)
    stress = modulus * (strain * thickness) ** n
    return Confined(
        tuple(stress),
        tuple(strain),
        f"k_c, k_phi and n at a plate of {2e3 * radius:g} mm, over a layer 0.96 times as thick",
        guessed=True,
    )


def material_of(
    title: str,
    strength: Strength,
    density: Parameter,
    confined: Confined,
    young: Parameter,
    strength_origin: str,
    guessed_strength: bool = False,
    head: Sequence[str] = (),
) -> NewMaterial:
    """Law with this curve in confined compression."""
    nu = float(POISSON.value)
    elastic = float(young.value)
    bulk = elastic / (3 * (1 - 2 * nu))
    stress, strain = np.array(confined.stress), np.array(confined.strain)
    above = strength.mean_stress(stress) > 0
    if above.sum() < 2:
        raise ResultsError(
            f"all of the {confined.origin} lies below the cohesion of {strength.c:g} Pa; give "
            "higher stresses or a smaller cohesion"
        )
    p = strength.mean_stress(stress[above])
    plastic = -np.log1p(-strain[above]) - p / bulk
    rising = np.flatnonzero((plastic > 0) & (float(density.value) * np.exp(plastic) < QUARTZ))
    if rising.size < 2 or np.any(np.diff(plastic[rising]) <= 0):
        raise ResultsError(
            f"E = {elastic:g} Pa is softer than the {confined.origin}; give the modulus of unloading"
        )
    first = 0.2 * p[rising[0]]
    pressures = strength.yield_strength(np.array([first, *p[rising]]))
    strains = [0.0, *plastic[rising]]

    def computed(value: float) -> Parameter:
        return Parameter(value, strength_origin, guessed_strength)

    law = {
        "density": density,
        "d": computed(strength.d)
        if strength.d > SMALLEST_COHESION
        else Parameter(SMALLEST_COHESION, "keeps a free surface together", True),
        "beta": computed(math.degrees(math.atan(strength.tangent))),
        "R": CAP,
        "K": computed(strength.K),
        "section": Parameter("matsuoka_nakai", "Mohr-Coulomb in compression and extension"),
    }
    return NewMaterial(
        title,
        tuple(head),
        law,
        {"E": young, "nu": POISSON},
        tuple(float(value) for value in pressures),
        tuple(float(value) for value in strains),
        Parameter("table", confined.origin, confined.guessed),
    )


def young_of(confined: Confined) -> Parameter:
    """Young's modulus from the unloading of a test; a guess for a curve without unloading."""
    if math.isfinite(confined.unloading):
        nu = float(POISSON.value)
        young = confined.unloading * (1 + nu) * (1 - 2 * nu) / (1 - nu)
        return Parameter(young, f"unloading of the {confined.origin}, with nu {nu:g}")
    stress, strain = np.array(confined.stress), np.array(confined.strain)
    steepest = float(np.max(np.diff(stress) / np.diff(strain)))
    return Parameter(UNLOADING * steepest, f"{UNLOADING:g} times the steepest modulus", True)


def given(name: str, value: float | None, otherwise: Parameter) -> Parameter:
    """A number of the user, or one in its place. @raises ResultsError for a value that soils do not have"""
    if value is None:
        return otherwise
    require_plausible(name, value)
    return Parameter(value, "given")


def compression(oedometer: Confined | None, young: float | None) -> Confined:
    """@raises ResultsError where neither is given"""
    if oedometer:
        return oedometer
    if young is None:
        raise ResultsError("furrow-post card material needs --oedometer FILE or --E for the compression")
    return confined_of_modulus(young / UNLOADING)


def from_strength(
    title: str, c: float, phi: float, density: float, oedometer: Confined | None, young: float | None
) -> NewMaterial:
    """c [Pa], phi [degrees], density [kg/m3], and an oedometer, E [Pa] or both."""
    for name, value in {"c": c, "phi": phi, "density": density, "E": young}.items():
        if value is not None:
            require_plausible(name, value)
    confined = compression(oedometer, young)
    elastic = Parameter(young, "given") if young is not None else young_of(confined)
    origin = f"c {c:g} Pa, phi {phi:g} degrees"
    return material_of(title, Strength(c, phi), Parameter(density, "given"), confined, elastic, origin)


def from_bekker(
    title: str,
    k_c: float,
    k_phi: float,
    n: float,
    c: float,
    phi: float,
    K: float,
    radius: float,
    density: float | None,
) -> NewMaterial:
    """k_c [N/m^(n+1)], k_phi [N/m^(n+2)], c [Pa], phi [degrees], K [m]; radius [m] of the plate at
    which the material shall have the curve."""
    for name, value in (("k_c", k_c), ("k_phi", k_phi), ("Bekker's n", n), ("c", c), ("phi", phi), ("K", K)):
        require_plausible(name, value)
    known = given("density", density, LOOSE_SAND)
    confined = confined_of_plate(k_c, k_phi, n, radius)
    head = (f"K = {K:g} m is not used: the law has no length. The displacement follows from E.",)
    origin = f"c {c:g} Pa, phi {phi:g} degrees"
    return material_of(title, Strength(c, phi), known, confined, young_of(confined), origin, head=head)


@dataclass(frozen=True)
class SoilClass:
    """Typical values of a class of the USCS.

    density [kg/m3] dry and compacted, c [Pa] saturated and compacted, phi [degrees] effective: NAVFAC DM-7.02 (1986),
    Table 1. friction: range of phi, SN 670 010b (1999). moduli: oedometric modulus over cone index up to a cone index [Pa].
    """

    density: Range
    c: float
    phi: float
    friction: Range
    moduli: tuple[tuple[float, Range], ...] = ()
    moduli_source: str = ""

    @property
    def coarse(self) -> bool:
        """True for ground without cohesion, in which the cone index measures the friction angle."""
        return self.c == 0

    def modulus(self, cone_index: float) -> Range | None:
        """Range of the oedometric modulus over the cone index [Pa]; None where no source has one."""
        return next((ratio for most, ratio in self.moduli if cone_index <= most), None)

    def modulus_ratio(self, cone_index: float) -> float:
        """Ratio that a file has: that of sand, or the middle of the range of fine soil."""
        known = self.modulus(cone_index)
        return MODULUS_RATIO if known is None or self.coarse else middle(known)


def middle(values: Range) -> float:
    return 0.5 * (values.low + values.high)


def _pounds(low: float, high: float) -> Range:
    """Density [kg/m3] of pounds per cubic foot."""
    return Range(low * PCF, high * PCF)


POUND = 47.880258  # [Pa] per square foot
PCF = 16.018463  # [kg/m3] per pound per cubic foot
COMPACTED = "NAVFAC DM-7.02 (1986), Table 1"
FRICTION = "SN 670 010b (1999)"
# Young's modulus over cone resistance of sand: J. H. Schmertmann, J. Soil Mech. Found. Div. ASCE 96
# (1970), 1011-1043
MODULUS_RATIO = 2.0
SAND = ((math.inf, Range(2, 4)),)
SAND_SOURCE = "J. E. Bowles (1996), Table 5-6"
# Oedometric modulus over cone resistance of fine soil, G. Sanglerat (1972)
LOW_CLAY = ((7e5, Range(3, 8)), (2e6, Range(2, 5)), (math.inf, Range(1, 2.5)))
LOW_SILT = ((2e6, Range(3, 6)), (math.inf, Range(1, 2)))
PLASTIC = ((2e6, Range(2, 6)),)
FINE_SOURCE = "EN 1997-2 (2007), Table D.2"
CLASSES = {
    "GW": SoilClass(_pounds(125, 135), 0, 38, Range(33, 40)),
    "GP": SoilClass(_pounds(115, 125), 0, 37, Range(32, 44)),
    "GM": SoilClass(_pounds(120, 135), 0, 34, Range(30, 40)),
    "GC": SoilClass(_pounds(115, 130), 0, 31, Range(28, 35)),
    "SW": SoilClass(_pounds(110, 130), 0, 38, Range(33, 43), SAND, SAND_SOURCE),
    "SP": SoilClass(_pounds(100, 120), 0, 37, Range(30, 39), SAND, SAND_SOURCE),
    "SM": SoilClass(_pounds(110, 125), 420 * POUND, 34, Range(32, 35)),
    "SC": SoilClass(_pounds(105, 125), 230 * POUND, 31, Range(30, 40)),
    "ML": SoilClass(_pounds(95, 120), 190 * POUND, 32, Range(27, 41), LOW_SILT, FINE_SOURCE),
    "CL": SoilClass(_pounds(95, 120), 270 * POUND, 28, Range(27, 35), LOW_CLAY, FINE_SOURCE),
    "MH": SoilClass(_pounds(70, 95), 420 * POUND, 25, Range(23, 33), PLASTIC, FINE_SOURCE),
    "CH": SoilClass(_pounds(75, 105), 230 * POUND, 19, Range(17, 31), PLASTIC, FINE_SOURCE),
}
# Resistance of the virtual cone, two cells across, over that of the cavity in coarse soil. Chosen so that the cone
# shows 0.87 to 1.11 of the index of three sands of 60 to 250 kPa: inputs/soils/cone_on_estimated_sand.csv
CONE_OVER_CAVITY = 1.33


def cone_resistance(strength: Strength, density: float, shear_modulus: float, depth: float) -> float:
    """Pressure on a cone at a depth [m], by the spherical cavity of A. S. Vesic (1977): q = c N_c +
    s N_s with the mean stress s of the weight [Pa]."""
    weight = density * EARTH * depth
    sine = strength.sine
    at_rest = 1 - sine  # K0 of J. Jaky (1944)
    mean = (1 + 2 * at_rest) / 3 * weight
    tangent = math.tan(math.radians(strength.phi))
    rigidity = max(shear_modulus / (strength.c + mean * tangent), 3.0)
    if strength.phi < 0.1:
        return strength.c * (4 / 3 * (math.log(rigidity) + 1) + math.pi / 2 + 1) + mean
    angle = math.radians(strength.phi)
    factor = (
        3
        / (3 - sine)
        * math.exp((math.pi / 2 - angle) * tangent)
        * math.tan(math.pi / 4 + angle / 2) ** 2
        * rigidity ** (4 * sine / (3 * (1 + sine)))
    )
    return float(strength.c * (factor - 1) / tangent + mean * factor)


@dataclass(frozen=True)
class Estimate:
    """A soil of a cone index [Pa]. density [kg/m3]; ratio: oedometric modulus over cone index."""

    cone_index: float
    strength: Strength
    density: float
    ratio: float

    def confined(self) -> Confined:
        reference = self.strength.c + self.density * EARTH * 0.5 * INDEX_DEPTH
        return confined_of_modulus(self.ratio * self.cone_index, reference)

    def results(self) -> dict[str, float]:
        """Results of the cone index and the class, by name and unit."""
        confined = self.confined()
        tangent = math.tan(math.radians(self.strength.phi))
        return {
            PHI: self.strength.phi,
            "cohesion, Pa": self.strength.c,
            "shear strength over a pressure of 100 kPa": self.strength.c / BAND_PRESSURE + tangent,
            "E, Pa": float(young_of(confined).value),
            "compression under 100 kPa, %": 100 * float(np.interp(BAND_PRESSURE, confined.stress, confined.strain)),
        }


PHI = "friction angle, degrees"
BAND_PRESSURE = 1e5  # [Pa] of a tyre, at which a band has strength and compression
NOT_IN_BANDS = "not in the bands: error of the cone's formula, peak of the strength, form of the compression, water"


def _over_cavity(typical: SoilClass, phi: float | None) -> float:
    """Factor on the cavity: that of coarse soil without cohesion."""
    return CONE_OVER_CAVITY if typical.coarse and phi is None else 1.0


def estimate_of(cone_index: float, typical: SoilClass, density: float, ratio: float, phi: float | None) -> Estimate:
    """Soil with this cone index. phi [degrees]: its cohesion is searched; None: its friction angle.
    @raises ResultsError where no strength gives the index"""
    shear_modulus = ratio * cone_index / (2 * (1 + float(POISSON.value)))
    over_cavity = _over_cavity(typical, phi)
    low, high = (5.0, 48.0) if phi is None else (20.0, 1e6)

    def strength_of(x: float) -> Strength:
        return Strength(SMALLEST_COHESION / 2, x) if phi is None else Strength(x, phi)

    def excess(x: float) -> float:
        q = cone_resistance(strength_of(x), density, shear_modulus, 0.5 * INDEX_DEPTH)
        return math.log(over_cavity * q / cone_index)

    if excess(low) > 0 or excess(high) < 0:
        what = "friction angle" if phi is None else "cohesion"
        raise ResultsError(
            f"no {what} of {low:g} to {high:g} gives a cone index of {cone_index:g} Pa in this class; check the class, and "
            f"the unit: {cone_index:g} Pa{'. Of moist sand give --phi' if phi is None else ''}"
        )
    return Estimate(cone_index, strength_of(float(brentq(excess, low, high))), density, ratio)


def bands_of(soil: Estimate, typical: SoilClass, density: float | None, phi: float | None) -> list[str]:
    """Ranges of what the class leaves open, and of what follows at this cone index. density [kg/m3] and phi [degrees]:
    those of the user, None for those of the class."""
    lines = []
    modulus = typical.modulus(soil.cone_index)
    densities = Range(soil.density, soil.density) if density is not None else typical.density
    ratios = modulus or Range(soil.ratio, soil.ratio)
    angles: tuple[float | None, ...] = (phi,)
    if density is None:
        lines.append(f"{_band('density, kg/m3', soil.density, densities)}: compacted, {COMPACTED}; loose soil is lighter")
    name = "compression modulus over cone index"
    source = f": {typical.moduli_source}" if modulus else ", no range known for this class"
    lines.append(f"{_band(name, soil.ratio, ratios)}{source}")
    end_of = estimate_of
    if not typical.coarse and phi is None:
        angles, end_of = (typical.friction.low, typical.friction.high), _end
    ends, lost = [soil.results()], 0
    for corner in itertools.product((densities.low, densities.high), (ratios.low, ratios.high), angles):
        try:
            ends.append(end_of(soil.cone_index, typical, *corner).results())
        except ResultsError:
            lost += 1
    for name, value in soil.results().items():
        values = [end[name] for end in ends]
        if max(values) > min(values):
            usual = f"; the class has {typical.friction.low:g} to {typical.friction.high:g}, {FRICTION}" if name == PHI else ""
            lines.append(f"{_band(name, value, Range(min(values), max(values)))} at this cone index{usual}")
    if lost:
        lines.append(f"ends of the ranges without a strength of this cone index, not in the bands: {lost}")
    return [*lines, NOT_IN_BANDS]


def _end(cone_index: float, typical: SoilClass, density: float, ratio: float, phi: float | None) -> Estimate:
    """Fine soil at an end of the ranges. Where friction alone exceeds the cone index, it has less of it, and no cohesion.
    @raises ResultsError where this friction is below that of the class"""
    try:
        return estimate_of(cone_index, typical, density, ratio, phi)
    except ResultsError:
        weaker = estimate_of(cone_index, typical, density, ratio, None)
        if weaker.strength.phi < typical.friction.low:
            raise
        return weaker


def _band(name: str, value: float, band: Range) -> str:
    value, low, high = (float(f"{x:.3g}") for x in (value, band.low, band.high))
    return f"{name}: {value:g}" if low == high else f"{name}: {value:g}, {low:g} to {high:g}"


def from_cone(
    title: str, cone_index: float, soil_class: str, density: float | None, phi: float | None = None
) -> NewMaterial:
    """cone_index [Pa] mean of the first 15 cm; soil_class: of CLASSES; phi [degrees].

    The cone gives the friction angle of a coarse soil. It gives the cohesion of a fine one, and of one whose phi is known.
    """
    require_plausible("cone_index", cone_index)
    if soil_class not in CLASSES:
        raise ResultsError(
            f"there is no soil class '{soil_class}'; allowed: {', '.join(CLASSES)} of the USCS"
        )
    if phi is not None:
        require_plausible("phi", phi)
    typical = CLASSES[soil_class]
    source = f"typical of {soil_class}, {COMPACTED}"
    known = given("density", density, Parameter(middle(typical.density), source, True))
    angle = typical.phi if phi is None and not typical.coarse else phi
    soil = estimate_of(cone_index, typical, float(known.value), typical.modulus_ratio(cone_index), angle)
    strength, confined = soil.strength, soil.confined()
    over_cavity = _over_cavity(typical, phi)
    factor = f" times {over_cavity:g}" if over_cavity != 1 else ""
    head = (
        f"cone index {cone_index:g} Pa in {soil_class}: c {strength.c:.4g} Pa, phi "
        f"{strength.phi:.4g} degrees, by the cavity of Vesic (1977){factor}",
    )
    origin = f"cone index {cone_index:g} Pa and {source if phi is None else f'phi {phi:g} degrees'}"
    made = material_of(title, strength, known, confined, young_of(confined), origin, guessed_strength=True, head=head)
    return replace(made, bands=tuple(bands_of(soil, typical, density, phi)))
