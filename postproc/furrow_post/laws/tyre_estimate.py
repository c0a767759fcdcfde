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
_PRESSURE = 241e3  # [Pa] from which the moduli grow
_AREAL_MASS = 19.6  # [kg/m2] of a tread of 21 mm
_TREAD_THICKNESS = 0.021  # [m]
_TREAD_OVER_DIAMETER = 0.0285  # thickness of the tread, 21 mm of 0.737 m
_TREAD_OVER_SECTION = 0.72  # width: 0.67 of [Shoop2001] Table 6 to 0.8 of truck tyres
_RIM_OVER_SECTION = 0.70  # width of the measuring rim
_FLANGE = 0.017  # [m] height of the flange of a rim for cars
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
    def height(self) -> float:
        """Height of the section."""
        return 0.5 * (_diameter(self) - self.size.rim_diameter)


@dataclass(frozen=True)
class Guess:
    """A parameter before the fit: its logarithm is normal about the value with this deviation."""

    value: float
    spread: float
    source: str


def guesses(known: Catalogue) -> dict[str, Guess]:
    """The parameters that a fit may change, by name."""
    width, width_source, width_spread = _section_width(known)
    tread = known.tread_width
    thickness, thickness_source = _tread_thickness(known)
    diameter = _diameter(known)
    radius = 0.5 * diameter - thickness
    # the error of the size's diameter, and a third of the tread's thickness where it is guessed
    guessed = 0.0 if known.tread_thickness else thickness / 3.0
    error = math.hypot(guessed, 0.0 if known.diameter else 0.5 * known.size.diameter_error)
    return {
        "belt_radius": Guess(
            radius, max(error / radius, 0.003), f"half the diameter less {thickness_source}"
        ),
        "half_width": Guess(
            0.5 * (tread or _TREAD_OVER_SECTION * width),
            0.02 if tread else 0.1,
            "half the given tread width"
            if tread
            else f"{_TREAD_OVER_SECTION} of the section width",
        ),
        "section_width": Guess(width, width_spread, width_source),
        "belt_stiffness": Guess(1.0, 0.5, "similar to [Shoop2001]'s tyre"),
        "sidewall_stiffness": Guess(1.0, 1.0, "similar to [Shoop2001]'s tyre"),
    }


@dataclass(frozen=True)
class Entry:
    """A line of a tyre file; the note says where the value comes from."""

    key: str
    text: str
    note: str


Sections = dict[str, list[Entry]]


def tyre_sections(known: Catalogue, values: Values, notes: Mapping[str, str]) -> Sections:
    """Sections of the tyre file. notes: where each fitted parameter's value comes from.

    @raises ResultsError where rim, tread and section do not fit together
    """
    rim, rim_source = _rim_width(known)
    bead = 0.5 * known.size.rim_diameter + (_FLANGE if known.flange is None else known.flange)
    flange_source = "17 mm, guess" if known.flange is None else "the given flange"
    arc = _sidewall(0.5 * rim, bead, values)
    scale = values["section_width"] / _SECTION_WIDTH
    strength = max(1.0, known.pressure / _PRESSURE)
    belts = strength * values["belt_stiffness"]
    sidewall = strength * values["sidewall_stiffness"]
    bending = [sidewall * scale**3 * b for b in _BENDING]
    springs = sidewall * scale**2
    thickness = _THICKNESS * values["belt_radius"] / _BELT_RADIUS
    similar = "[Shoop2001] Table 8, scaled"
    entry = Entry
    return {
        "tyre": [
            entry("pressure", f"{known.pressure:.6g}", "given"),
            entry("bead_radius", f"{bead:.4g}", f"half the rim diameter and {flange_source}"),
            entry("bead_spacing", f"{rim:.4g}", rim_source),
        ],
        "tread": [
            entry("radius", f"{values['belt_radius']:.4g}", notes["belt_radius"]),
            entry("half_width", f"{values['half_width']:.4g}", notes["half_width"]),
            entry("thickness", f"{thickness:.4g}", f"{similar} with the radius"),
            entry(
                "E1",
                f"{belts * _E1:.4g}",
                f"{similar} times {belts:.3g}; {notes['belt_stiffness']}",
            ),
            entry("E2", f"{belts * _E2:.4g}", "the same"),
            entry("nu12", f"{_NU12}", "guess"),
            entry("G12", f"{_G12:.4g}", "guess, its influence is negligible"),
            entry("areal_mass", f"{_areal_mass(known, values):.4g}", _mass_source(known)),
        ],
        "sidewall": [
            entry(
                "length", f"{arc.length:.4g}", f"arc of the section width: {notes['section_width']}"
            ),
            entry(
                "bending",
                _listed(bending),
                f"{similar} times {sidewall:.3g}; {notes['sidewall_stiffness']}",
            ),
            entry("curvature", _listed([arc.curvature] * len(bending)), "of the arc"),
            entry("rim_angle", f"{arc.rim_angle:.4g}", "of the arc"),
            entry("tread_angle", f"{arc.tread_angle:.4g}", "of the arc"),
            entry("rim_stiffness", f"{springs * _RIM_STIFFNESS:.4g}", "as bending"),
            entry("tread_stiffness", f"{springs * _TREAD_STIFFNESS:.4g}", "as bending"),
            entry("strip", "even", "as [Shoop2001]'s tyre"),
        ],
    }


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
    return _Arc(
        2.0 * radius * half_angle,
        1.0 / radius,
        math.degrees(direction - half_angle),
        math.degrees(direction + half_angle),
    )


def _diameter(known: Catalogue) -> float:
    return known.size.diameter if known.diameter is None else known.diameter


def _section_width(known: Catalogue) -> tuple[float, str, float]:
    if known.section_width is not None:
        return known.section_width, "given", 0.02
    return known.size.width, "of the size", 0.04


def _tread_thickness(known: Catalogue) -> tuple[float, str]:
    if known.tread_thickness is not None:
        return known.tread_thickness, "the given tread"
    thickness = _TREAD_OVER_DIAMETER * _diameter(known)
    return thickness, f"{1e3 * thickness:.0f} mm of tread"


def _rim_width(known: Catalogue) -> tuple[float, str]:
    if known.rim_width is not None:
        return known.rim_width, "given rim"
    width = round(2.0 * _RIM_OVER_SECTION * known.size.width / INCH) / 2.0  # half inches
    return width * INCH, f"rim of {width:g} inches, {_RIM_OVER_SECTION} of the width: guess"


def _areal_mass(known: Catalogue, values: Values) -> float:
    if known.mass is None:
        return _AREAL_MASS * _tread_thickness(known)[0] / _TREAD_THICKNESS
    area = 2.0 * math.pi * values["belt_radius"] * 2.0 * values["half_width"]
    return _TREAD_MASS_SHARE * known.mass / area


def _mass_source(known: Catalogue) -> str:
    if known.mass is None:
        return f"{_AREAL_MASS} of [Shoop2001]'s tyre by the tread's thickness: guess"
    return f"{_TREAD_MASS_SHARE} of the given mass: guess"


def _listed(numbers: list[float]) -> str:
    return "[" + ", ".join(f"{number:.3g}" for number in numbers) + "]"


def tyre_text(title: str, comments: list[str], sections: Sections) -> str:
    """A tyre file with a comment for every value."""
    lines = [f"title: {title}", *(f"# {comment}".rstrip() for comment in comments)]
    for name, entries in sections.items():
        lines.append(f"{name}:")
        lines += [f"  {entry.key}: {entry.text}   # {entry.note}" for entry in entries]
    return "\n".join(lines) + "\n"
