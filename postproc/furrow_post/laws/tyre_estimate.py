# SPDX-License-Identifier: GPL-2.0-or-later
"""A tyre file of tyre/darnell from what a catalogue gives.

A value that a catalogue does not give is scaled from the tyre of [Shoop2001]
(inputs/tyres/p235_75r15.yaml) as if both were similar: bending stiffnesses grow with the cube of a
length, springs per width with its square, and all moduli with the pressure, for cords that carry
more of it.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from scipy.optimize import brentq

from ..errors import ResultsError
from .tyre_size import INCH, TyreSize

# The tyre of [Shoop2001], Tables 6 and 8, as inputs/tyres/p235_75r15.yaml has it
_SECTION_WIDTH = 0.229  # [m] of the sidewalls without pressure
_BELT_RADIUS = 0.3475  # [m]
_THICKNESS = 1.11e-3  # [m] of the equivalent shell of the belts
_E1, _E2, _G12 = 3.62e10, 1.98e10, 1e10  # [Pa]
_BENDING = (1.5, 0.15, 0.04, 0.04, 0.04, 0.04, 0.15, 0.5, 1.0)  # [N m]
_RIM_STIFFNESS, _TREAD_STIFFNESS = 50.0, 10.0  # [N m/rad/m]
_PRESSURE = 241e3  # [Pa] reference pressure of the moduli
_AREAL_MASS = 19.6  # [kg/m2] of a tread of 21 mm
_TREAD_THICKNESS = 0.021  # [m]
TREAD_OVER_DIAMETER = 0.0285  # thickness of the tread, 21 mm of 0.737 m
_TREAD_OVER_SECTION = 0.72  # width: 0.67 of [Shoop2001] Table 6 to 0.8 of truck tyres
_RIM_OVER_SECTION = 0.70  # width of the measuring rim
FLANGE = 0.017  # [m] height of the flange of a rim for cars
_TREAD_MASS_SHARE = 0.5  # of the tyre's mass, in belts and tread
_NU12 = 0.3

Values = Mapping[str, float]


@dataclass(frozen=True)
class Catalogue:
    """Catalogue data of a tyre; None where a value is not given. SI units."""

    size: TyreSize
    pressure: float
    rim_width: float | None = None
    diameter: float | None = None
    section_width: float | None = None
    tread_width: float | None = None
    tread_thickness: float | None = None
    flange: float | None = None
    mass: float | None = None

    @property
    def known_diameter(self) -> float:
        return self.size.diameter if self.diameter is None else self.diameter

    @property
    def known_thickness(self) -> float:
        """Thickness of the tread."""
        return TREAD_OVER_DIAMETER * self.known_diameter if self.tread_thickness is None else self.tread_thickness

    @property
    def height(self) -> float:
        """Height of the section."""
        return 0.5 * (self.known_diameter - self.size.rim_diameter)


@dataclass(frozen=True)
class Guess:
    """A parameter before the fit: its logarithm is normal about the value with this deviation."""

    value: float
    spread: float
    source: str


def guesses(known: Catalogue) -> dict[str, Guess]:
    """The parameters that a fit may change, by name."""
    width = Guess(known.size.width, 0.04, "of the size")
    if known.section_width is not None:
        width = Guess(known.section_width, 0.02, "given")
    half_width = Guess(0.5 * _TREAD_OVER_SECTION * width.value, 0.1, f"{_TREAD_OVER_SECTION} of the section width")
    if known.tread_width:
        half_width = Guess(0.5 * known.tread_width, 0.02, "half the given tread width")
    thickness = known.known_thickness
    tread = f"{1e3 * thickness:.0f} mm of tread" if known.tread_thickness is None else "the given tread"
    radius = 0.5 * known.known_diameter - thickness
    # the error of the size's diameter, and a third of the tread's thickness where it is guessed
    guessed = 0.0 if known.tread_thickness else thickness / 3.0
    error = math.hypot(guessed, 0.0 if known.diameter else 0.5 * known.size.diameter_error)
    return {
        "belt_radius": Guess(radius, max(error / radius, 0.003), f"half the diameter less {tread}"),
        "half_width": half_width,
        "section_width": width,
        "belt_stiffness": Guess(1.0, 0.5, "similar to [Shoop2001]'s tyre"),
        "sidewall_stiffness": Guess(1.0, 1.0, "similar to [Shoop2001]'s tyre"),
    }


def tyre_text(title: str, comments: list[str], known: Catalogue, values: Values, notes: Mapping[str, str]) -> str:
    """A tyre file with a comment for every value. notes: where each fitted parameter's value comes from.

    @raises ResultsError where rim, tread and section do not fit together
    """
    rim, rim_source = known.rim_width or 0.0, "given rim"
    if known.rim_width is None:
        inches = round(2.0 * _RIM_OVER_SECTION * known.size.width / INCH) / 2.0  # half inches
        rim, rim_source = inches * INCH, f"rim of {inches:g} inches, {_RIM_OVER_SECTION} of the width: guess"
    flange, flange_source = known.flange or 0.0, "the given flange"
    if known.flange is None:
        flange, flange_source = FLANGE, "17 mm, guess"
    bead = 0.5 * known.size.rim_diameter + flange
    arc = _sidewall(0.5 * rim, bead, values)
    areal_mass = _AREAL_MASS * known.known_thickness / _TREAD_THICKNESS
    mass_source = f"{_AREAL_MASS} of [Shoop2001]'s tyre by the tread's thickness: guess"
    if known.mass is not None:
        area = 2.0 * math.pi * values["belt_radius"] * 2.0 * values["half_width"]
        areal_mass, mass_source = _TREAD_MASS_SHARE * known.mass / area, f"{_TREAD_MASS_SHARE} of the given mass: guess"
    scale = values["section_width"] / _SECTION_WIDTH
    strength = max(1.0, known.pressure / _PRESSURE)
    belts, sidewall = (strength * values[f"{part}_stiffness"] for part in ("belt", "sidewall"))
    bending, springs = _listed([sidewall * scale**3 * b for b in _BENDING]), sidewall * scale**2
    thickness = _THICKNESS * values["belt_radius"] / _BELT_RADIUS
    similar = "[Shoop2001] Table 8, scaled"
    head = "\n".join([f"title: {title}", *(f"# {comment}".rstrip() for comment in comments)])
    return f"""{head}
tyre:
  pressure: {known.pressure:.6g}   # given
  bead_radius: {bead:.4g}   # half the rim diameter and {flange_source}
  bead_spacing: {rim:.4g}   # {rim_source}
tread:
  radius: {values["belt_radius"]:.4g}   # {notes["belt_radius"]}
  half_width: {values["half_width"]:.4g}   # {notes["half_width"]}
  thickness: {thickness:.4g}   # {similar} with the radius
  E1: {belts * _E1:.4g}   # {similar} times {belts:.3g}; {notes["belt_stiffness"]}
  E2: {belts * _E2:.4g}   # the same
  nu12: {_NU12}   # guess
  G12: {_G12:.4g}   # guess, its influence is negligible
  areal_mass: {areal_mass:.4g}   # {mass_source}
sidewall:
  length: {arc.length:.4g}   # arc of the section width: {notes["section_width"]}
  bending: {bending}   # {similar} times {sidewall:.3g}; {notes["sidewall_stiffness"]}
  curvature: {_listed([arc.curvature] * len(_BENDING))}   # of the arc
  rim_angle: {arc.rim_angle:.4g}   # of the arc
  tread_angle: {arc.tread_angle:.4g}   # of the arc
  rim_stiffness: {springs * _RIM_STIFFNESS:.4g}   # as bending
  tread_stiffness: {springs * _TREAD_STIFFNESS:.4g}   # as bending
  strip: even   # as [Shoop2001]'s tyre
"""


def _listed(numbers: list[float]) -> str:
    return "[" + ", ".join(f"{number:.3g}" for number in numbers) + "]"


def hub_mass(known: Catalogue) -> float | None:
    """Part of the tyre's mass that the rim carries [kg]; None where the mass is not given."""
    return None if known.mass is None else (1.0 - _TREAD_MASS_SHARE) * known.mass


@dataclass(frozen=True)
class _Arc:
    length: float  # [m]
    curvature: float  # [1/m]
    rim_angle: float  # [degree]
    tread_angle: float


def _sidewall(bead_axial: float, bead_radius: float, values: Values) -> _Arc:
    """The arc from bead to edge of the tread whose widest place is half the section width."""
    across = values["half_width"] - bead_axial
    up = values["belt_radius"] - bead_radius
    widest = 0.5 * values["section_width"]
    needed = max(bead_axial, values["half_width"])
    if up <= 0.0 or widest <= needed:
        raise ResultsError(
            f"the section is {2e3 * widest:.0f} mm wide and {1e3 * up:.0f} mm high from bead to "
            f"belts, and rim or tread {2e3 * needed:.0f} mm wide; a section is wider than both. "
            "Check --section-width, --tread-width, --rim and --diameter"
        )
    chord = math.hypot(across, up)

    def excess(half_angle: float) -> float:
        radius = 0.5 * chord / math.sin(half_angle)
        outwards = up / chord  # axial part of the chord's normal
        centre = bead_axial + 0.5 * across - outwards * radius * math.cos(half_angle)
        return centre + radius - widest

    flat, round_ = 0.02, 2.2  # [rad]; the reader of tyre files takes a length up to 3 chords
    if not excess(flat) < 0.0 < excess(round_):
        raise ResultsError(
            f"no arc from bead to tread is {1e3 * widest:.0f} mm from the mid-plane at its widest; "
            "check --section-width, --tread-width and --rim"
        )
    half_angle = float(brentq(excess, flat, round_))
    radius = 0.5 * chord / math.sin(half_angle)
    direction = math.atan2(up, across)
    angles = (math.degrees(direction + side * half_angle) for side in (-1, 1))
    return _Arc(2.0 * radius * half_angle, 1.0 / radius, *angles)
