# SPDX-License-Identifier: GPL-2.0-or-later
"""The steady values of a run as summary.json has them; they are computed by furrow-resistance, never here."""

import json
import math

from .results import ResultsError


def with_error(mean, error):
    """"10.8 ± 0.5": two digits of the error when they start with 1, else one, and the mean to the same place."""
    if not error > 0:
        return f"{mean:.3g}"
    exponent = math.floor(math.log10(error))
    digits = max(-exponent + (error < 2 * 10.0**exponent), 0)
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


class Summary:
    """summary.json of a results folder; empty where there is none."""

    def __init__(self, folder):
        try:
            self.content = json.loads((folder / "summary.json").read_text())
        except FileNotFoundError:
            self.content = {}
        except (OSError, ValueError) as error:
            raise ResultsError(f"{folder / 'summary.json'}: cannot be read ({error}); write it anew with "
                               f"'furrow-post resistance --write {folder}'") from error
        if not isinstance(self.content, dict):
            raise ResultsError(f"{folder / 'summary.json'}: is not a summary of Furrow; write it anew with "
                               f"'furrow-post resistance --write {folder}'")

    @property
    def window(self):
        """(begin, end) of the steady window [s], or None."""
        window = self.content.get("window")
        return (window["start"], window["end"]) if window else None

    def quantity(self, name):
        """dict with mean, standard_error, unit, steady; or None, also where a number is null."""
        value = self.content.get("quantities", {}).get(name)
        return None if value is None or None in (value["mean"], value["standard_error"]) else value

    def line(self):
        """One line for a title: "sinkage 15.8 ± 1.9 mm, resistance coefficient 0.330 ± 0.007, ..."."""
        parts = []
        sinkage, coefficient, torque, slip = map(self.quantity, ("sinkage", "resistance_coefficient", "drive_torque", "slip"))
        if sinkage:
            parts.append(f"sinkage {with_error(1e3 * sinkage['mean'], 1e3 * sinkage['standard_error'])} mm")
        if coefficient:
            parts.append(f"resistance coefficient {with_error(coefficient['mean'], coefficient['standard_error'])}")
        if torque and (torque["mean"] or torque["standard_error"]):  # a towed wheel has none
            parts.append(f"torque {with_error(torque['mean'], torque['standard_error'])} N m")
        if slip:
            parts.append(f"slip {with_error(100 * slip['mean'], 100 * slip['standard_error'])} %")
        if parts and not self.content.get("steady", False):
            parts.append("not all steady, see summary.txt")
        return ", ".join(parts)
