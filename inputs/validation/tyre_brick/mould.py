# SPDX-License-Identifier: GPL-2.0-or-later
"""The outline of the carcass as the mould leaves it: four arcs that meet without a corner, and the
tyre files with it.

The radius of the crown is identified; where the arcs end is assumed. Everything else is measured:
[Shoop2001] Table 8 has the radii of belts and bead, Table 6 the widths of tread and section.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import asin, cos, pi, radians, sin
from pathlib import Path

BELT_RADIUS = 0.3475  # [m] Table 8: diameter of the belts 69.5 cm
BEAD = (0.0825, 0.2080)  # [m] axial: half of the 6.5 inch rim; radius: Table 8
SHOULDER_END = 60.0  # [degrees] of the outline against the axle, assumed
POINTS = (4, 4, 2, 3)  # of each arc
UPPER_END = 0.108  # [m] along the outline, where the upper sidewall ends
BEAD_ZONES = (0.046, 0.030, 0.0)  # [m] before the bead, where the last zones end


@dataclass(frozen=True)
class Mould:
    """What an outline is made of, beside what is measured."""

    crown: float = 1.5  # [m] radius, identified
    crown_end: float = 0.066  # [m] axial, assumed
    shoulder: float = 0.045  # [m] radius, assumed
    widest: float = 0.1115  # [m] Table 6: section 22.9 cm without air, less walls of 3 mm
    # [m] along the outline: belts, and the tread's full thickness, end where its outside is 7.85 cm
    # from the mid-plane (Table 6: 15.7 cm wide); the tread ends
    belt_end: float = 0.0735
    tread_end: float = 0.084


@dataclass(frozen=True)
class Outline:
    axial: list[float]  # [m]
    radius: list[float]  # [m]
    length: float  # [m]


def outline(mould: Mould) -> Outline:
    """Points of the four arcs: crown, shoulder, upper sidewall to the widest place, the lower one
    to the bead. The angle is that of the outline against the axle."""
    axial, radius, length = [0.0], [BELT_RADIUS], 0.0

    def add(start: float, end: float, of_arc: float, points: int) -> None:
        nonlocal length
        a, r = axial[-1], radius[-1]
        for k in range(1, points + 1):
            angle = start + (end - start) * k / points
            axial.append(a + of_arc * (sin(angle) - sin(start)))
            radius.append(r - of_arc * (cos(start) - cos(angle)))
        length += of_arc * (end - start)

    crown, shoulder = asin(mould.crown_end / mould.crown), radians(SHOULDER_END)
    add(0.0, crown, mould.crown, POINTS[0])
    add(crown, shoulder, mould.shoulder, POINTS[1])
    add(shoulder, pi / 2, (mould.widest - axial[-1]) / (1.0 - sin(shoulder)), POINTS[2])
    across, down = mould.widest - BEAD[0], radius[-1] - BEAD[1]
    lower = (across**2 + down**2) / (2.0 * across)
    add(pi / 2, pi / 2 + asin(down / lower), lower, POINTS[3])
    return Outline([round(a, 5) for a in axial], [round(r, 5) for r in radius], length)


def zone_ends(mould: Mould) -> list[float]:
    """[m] of belts, shoulder, upper sidewall, sidewall, lower sidewall, bead."""
    length = outline(mould).length
    last = (round(length - before, 4) for before in BEAD_ZONES)
    return [mould.belt_end, mould.tread_end, UPPER_END, *last]


def replaced(text: str, key: str, values: Sequence[float]) -> str:
    """The text of a tyre file with another list of values for a key."""
    listed = ", ".join(f"{value:.6g}" for value in values)
    changed, count = re.subn(rf"(?m)^( +{key}: *)\[[^]]*\]", rf"\g<1>[{listed}]", text)
    if count != 1:
        raise ValueError(f"{count} lines of the tyre file have {key}")
    return changed


def listed(text: str, key: str) -> list[float]:
    """The values of a key in the text of a tyre file. @raises ValueError"""
    found = re.findall(rf"(?m)^ +{key}: *\[([^]]*)\]", text)
    if len(found) != 1:
        raise ValueError(f"{len(found)} lines of the tyre file have {key}")
    return [float(value) for value in found[0].split(",")]


def tyre_text(
    file: Path, mould: Mould, belt: float, shear: float, rubber: float | None = None
) -> str:
    """The text of a tyre file, without comments, with another mould, belts that are stretched along
    [N/m], sidewalls that are sheared [N/m] and rubber's C10 [Pa]; None: the file's."""
    text = re.sub(r" *#.*|\n(?= *#)", "", file.read_text(encoding="utf-8"))
    shape = outline(mould)
    along, sheared = listed(text, "stretch_along"), listed(text, "shear")
    along[0] = belt
    sheared[2:5] = [shear] * 3  # upper sidewall, sidewall, lower sidewall
    for key, values in (
        ("axial", shape.axial),
        ("radius", shape.radius),
        ("zone_end", zone_ends(mould)),
        ("stretch_along", along),
        ("shear", sheared),
        ("at", [0, mould.belt_end, mould.tread_end]),
    ):
        text = replaced(text, key, values)
    return text if rubber is None else re.sub(r"(?m)^( +C10: *).*", rf"\g<1>{rubber:.6g}", text)
