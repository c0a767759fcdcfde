# SPDX-License-Identifier: GPL-2.0-or-later
"""The head of a script: what its small version is, and what must come out of it."""

import math
import re
import shlex
import sys
from pathlib import Path


class Expectations:
    """Quantities that a run must give: "hub drop 0.15 to 0.17 m, resistance coefficient 0.16 to 0.20"."""

    def __init__(self, script, text):
        self.script = script
        self.gives = [self._expectation(part) for part in text.split(", ")]

    def _expectation(self, text):
        """(name, lowest, highest, unit) of "hub drop 0.15 to 0.17 m"."""
        parts = re.fullmatch(r"(.+?) (\S+) to (\S+)(?: (\S+))?", text)
        assert parts, f"{self.script}: '{text}' is not 'name lowest to highest unit'"
        lowest, highest = float(parts[2]), float(parts[3])
        assert lowest < highest, f"{self.script}: '{text}' is an empty range"
        return parts[1], lowest, highest, parts[4] or ""

    def check(self, found):
        """Every quantity lies in its range. found: (value, unit) by name."""
        missed = []
        for name, lowest, highest, unit in self.gives:
            assert name in found, f"{self.script}: '{name}' is not among {', '.join(sorted(found))}"
            value, its_unit = found[name]
            assert unit == its_unit, f"{self.script}: the unit of '{name}' is '{its_unit}', not '{unit}'"
            value = math.nan if value is None else float(value)
            print(f"  {name}: {value:.6g} {unit}, expected {lowest:g} to {highest:g}")
            if not lowest <= value <= highest:
                missed.append(f"{name} is {value:.6g} {unit}, not {lowest:g} to {highest:g}")
        assert not missed, f"{self.script}: {'; '.join(missed)}"


class Head(Expectations):
    """The comment at the top of a script: title, words of the small version, what it gives."""

    def __init__(self, script):
        self.script = Path(script)
        self.lines = []
        for line in self.script.read_text().splitlines():
            if not line.startswith("#"):
                break
            self.lines.append(line)
        self.title = self.lines[0].lstrip("# ")
        self.quick = shlex.split(self._entry("Quick"))
        super().__init__(self.script, self._entry("Gives"))

    def _entry(self, name):
        start = f"# {name}:"
        found = [line[len(start):].strip() for line in self.lines if line.startswith(start)]
        if len(found) != 1 or not found[0]:
            sys.exit(f"{self.script}: its head needs one line '{start} ...', it has {len(found)}; "
                     "see tests/scenes/scene_test.py")
        return found[0]
