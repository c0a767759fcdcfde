"""The steady values of a run as summary.json has them; they are computed by furrow-resistance, never here."""

import json


class Summary:
    """summary.json of a results folder; empty where there is none."""

    def __init__(self, folder):
        try:
            self.content = json.loads((folder / "summary.json").read_text())
        except (OSError, ValueError):
            self.content = {}

    @property
    def window(self):
        """(begin, end) of the steady window [s], or None."""
        window = self.content.get("window")
        return (window["start"], window["end"]) if window else None

    def quantity(self, name):
        """dict with mean, standard_error, unit, steady; or None."""
        return self.content.get("quantities", {}).get(name)

    def line(self):
        """One line for a title: "sinkage 15.8 ± 1.9 mm, resistance coefficient 0.330 ± 0.007, ..."."""
        parts = []
        sinkage, coefficient, torque, slip = map(self.quantity, ("sinkage", "resistance_coefficient", "drive_torque", "slip"))
        if sinkage:
            parts.append(f"sinkage {1e3 * sinkage['mean']:.1f} ± {1e3 * sinkage['standard_error']:.1f} mm")
        if coefficient:
            parts.append(f"resistance coefficient {coefficient['mean']:.3f} ± {coefficient['standard_error']:.3f}")
        if torque:
            parts.append(f"torque {torque['mean']:.2f} ± {torque['standard_error']:.2f} N m")
        if slip:
            parts.append(f"slip {100 * slip['mean']:.1f} ± {100 * slip['standard_error']:.1f} %")
        if parts and not self.content.get("steady", False):
            parts.append("not all steady, see summary.txt")
        return ", ".join(parts)
