# SPDX-License-Identifier: GPL-2.0-or-later
"""Size designations of tyres: 235/75R15, 31x10.50R15, 16.00R20, 18.4R38.

A designation gives the width of the section, the diameter and the rim of a new tyre. Where it has
no aspect ratio, the height of the section follows from the width by a rule, and so has an error.
"""

import re
from dataclasses import dataclass

from ..errors import ResultsError

INCH = 0.0254  # [m]

_RIM = r"\s*(?:ZR|R|D|B|-)\s*(?P<rim>\d{1,2}(?:\.\d)?)(?:LT|C)?"
_RADIAL = re.compile(r"\d\s*Z?R\s*\d")
_METRIC = re.compile(r"(?:P|LT|ST|IF|VF)?(?P<width>\d{3})/(?P<aspect>\d{2,3})" + _RIM)
_FLOTATION = re.compile(
    r"(?P<diameter>\d{2}(?:\.\d+)?)[xX×](?P<width>\d{1,2}(?:\.\d{1,2})?)" + _RIM
)
_NUMERIC = re.compile(r"(?P<width>\d{1,2}(?:\.\d{1,2})?)L?" + _RIM)

# Height over width of sections that have no aspect ratio in their designation, and its error:
# of widths with two decimals (trucks: 9.00R20), with one (farm and earthmoving: 18.4R38), and
# without (15 degree rims: 11R22.5). inputs/tyres/catalogue.csv has tyres that follow them.
_HEIGHT_OVER_WIDTH = {2: (1.03, 0.05), 1: (0.83, 0.04), 0: (0.85, 0.05)}
_LOW_HEIGHT_OVER_WIDTH = (0.70, 0.03)  # of skid steers on rims of 16.5 inches: 12-16.5
_LOW_RIM = 16.5  # [inch]


@dataclass(frozen=True)
class TyreSize:
    """A new tyre on its rim, without load [m]; the error of the diameter is that of the rule."""

    designation: str
    width: float  # of the section
    diameter: float
    rim_diameter: float
    diameter_error: float

    @property
    def height(self) -> float:
        """Height of the section [m]."""
        return 0.5 * (self.diameter - self.rim_diameter)


def read_size(designation: str) -> TyreSize:
    """@raises ResultsError for a text that is no size designation, or gives no tyre"""
    text = designation.strip()
    matches = (kind.fullmatch(text.replace(" ", "")) for kind in (_METRIC, _FLOTATION, _NUMERIC))
    found = next(filter(None, matches), None)
    if not found:
        raise ResultsError(
            f"'{designation}' is no size designation; write it as on the sidewall, for example "
            "235/75R15, 31x10.50R15, 16.00R20 or 18.4R38"
        )
    rim, width = float(found["rim"]), float(found["width"]) * (1e-3 if found.re is _METRIC else INCH)
    if found.re is _METRIC:
        return _checked(text, width, width * float(found["aspect"]) / 100.0, rim, 0.0)
    if found.re is _FLOTATION:
        return _checked(text, width, 0.5 * INCH * (float(found["diameter"]) - rim), rim, 0.0)
    decimals = len(found["width"].partition(".")[2])
    low = decimals == 0 and rim == _LOW_RIM
    ratio, error = _LOW_HEIGHT_OVER_WIDTH if low else _HEIGHT_OVER_WIDTH[decimals]
    return _checked(text, width, ratio * width, rim, 2.0 * error * width)


def is_radial(text: str) -> bool:
    """True of a text with the designation of a radial tyre."""
    return bool(_RADIAL.search(text.upper()))


def _checked(text: str, width: float, height: float, rim: float, error: float) -> TyreSize:
    if not (0.2 * width <= height <= 1.3 * width):
        raise ResultsError(
            f"'{text}' gives a section {1e3 * width:.0f} mm wide and {1e3 * height:.0f} mm high; "
            "no tyre has this shape. Check width, diameter and rim of the designation"
        )
    return TyreSize(text, width, INCH * rim + 2.0 * height, INCH * rim, error)
