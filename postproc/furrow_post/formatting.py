# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers as people write them; texts as YAML reads them."""

import json
import math

MOST_DECIMALS = 8
ROUNDING = 1e-12  # of a value


def with_error(mean: float, error: float, short: bool = False) -> str:
    """ "10.8 ± 0.5": two digits of the error when they start with 1, else one; the mean as far.
    short: two digits below 1.5 alone, and zeros in place of digits beyond, for titles.
    Rounding, of which no digit would be seen, in powers of ten: "6.1e-13 ± 2e-13". A prescribed
    value, whose error is rounding of it, stands alone: "10"."""
    if not error > ROUNDING * abs(mean):
        return f"{mean:.3g}"
    exponent = math.floor(math.log10(error))
    digits = (error < (1.5 if short else 2) * 10.0**exponent) - exponent
    if digits > MOST_DECIMALS:
        return f"{mean:.1e} ± {error:.0e}"
    if short:
        mean, error = round(mean, digits), round(error, digits)
    digits = max(digits, 0)
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


def value_text(value: float, error: float) -> str:
    """Text of a value with its error; three digits where the error is not known (NaN or infinite)."""
    return with_error(value, error) if math.isfinite(error) else f"{value:.3g}"


def duration(seconds: float) -> str:
    """ "0.4 s", "90 s", "12.5 min", "2.1 h"; empty where it is not known."""
    if not math.isfinite(seconds):
        return ""
    if seconds < 1:
        return f"{seconds:.1g} s"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.1f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def yaml_text(text: str) -> str:
    """Text in quotes, which keep a colon, a blank at the end and the word "no"."""
    return json.dumps(text, ensure_ascii=False)


def in_unit(unit: str) -> str:
    """ " [mm]", or nothing for a pure number: to be put behind a name."""
    return f" [{unit}]" if unit else ""


def percent(fraction: float) -> str:
    """ "+12 %" of 0.12."""
    return f"{100 * fraction:+.0f} %"
