# SPDX-License-Identifier: GPL-2.0-or-later
"""What to model for a wanted error against a measurement or another reference, from a table whose
runs were compared with it.

A comment "# measured: WHAT" or "# reference: WHAT" names it. Columns are run, wheel or ground, cpu_time,
options and one or more NAME_error: largest relative error of that quantity, without sign.
"""

import math
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..csv_table import read_rows
from ..errors import ResultsError, content_of
from ..formatting import duration

SUFFIX = "_error"


@dataclass(frozen=True)
class Compared:
    """A run whose errors against the reference are known."""

    run: str
    kind: str  # of the wheel or of the ground
    errors: dict[str, float]  # relative, by quantity
    cpu_time: float  # [s] of one core
    options: str  # scene and options of inputs/run, or a command of furrow-post; {inputs}: the folder

    @property
    def error(self) -> float:
        return max(self.errors.values())

    def describe(self) -> str:
        errors = ", ".join(f"{what} {100 * error:.1f} %" for what, error in self.errors.items())
        return f"{self.kind} ({self.run}): {errors}; {duration(self.cpu_time)} of one core"


def measurement(comments: Iterable[str]) -> str:
    """What the table was compared with; empty where it holds numerical errors."""
    heads = ("# measured:", "# reference:")
    found = [line.partition(":")[2].strip() for line in comments if line.startswith(heads)]
    return found[0] if found else ""


def read_compared(path: Path) -> list[Compared]:
    """Rows of such a table. @raises ResultsError"""
    columns = f"columns are run, wheel or ground, NAME{SUFFIX}, cpu_time, options"
    with content_of(path, columns):
        found = [_parsed(row) for row in read_rows(path)]
    if not found:
        raise ResultsError(f"{path}: has no rows; {columns}")
    return found


def _parsed(row: dict[str, str]) -> Compared:
    """@raises KeyError, ValueError"""
    errors = {
        name.removesuffix(SUFFIX).replace("_", " "): float(text)
        for name, text in row.items()
        if name.endswith(SUFFIX)
    }
    if not errors or not all(0 <= error < math.inf for error in errors.values()):
        raise ValueError(f"run '{row['run']}' needs errors of 0 or more in columns NAME{SUFFIX}")
    if not shlex.split(row["options"]):
        raise ValueError(f"run '{row['run']}' has no options that say how to run it")
    cpu_time = float(row["cpu_time"])
    if not 0 < cpu_time < math.inf:
        raise ValueError(f"run '{row['run']}' needs a cpu_time above 0")
    kind = row["ground"] if "ground" in row else row["wheel"]
    return Compared(row["run"], kind, errors, cpu_time, row["options"])


def recommend(runs: Sequence[Compared], error: float) -> Compared:
    """The cheapest run all of whose errors are this small, else that of least error."""
    within = [run for run in runs if run.error <= error]
    return min(within, key=lambda r: r.cpu_time) if within else min(runs, key=lambda r: r.error)


def reasons(runs: Sequence[Compared], error: float, measured: str) -> list[str]:
    """Sentences: the choice, and why no other kind of wheel or ground."""
    chosen = recommend(runs, error)
    reached = chosen.error <= error
    lines = [
        f"For {100 * error:g} % error against {measured} use {chosen.describe()}."
        if reached
        else f"No run of the table reaches {100 * error:g} % against {measured}; "
        f"the best is {chosen.describe()}."
    ]
    for kind in sorted({run.kind for run in runs} - {chosen.kind}):
        other = recommend([run for run in runs if run.kind == kind], error)
        why = "dearer" if other.error <= error else "at best"
        lines.append(f"  not {kind}, {why}: {other.describe()}")
    return lines
