# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that are compared: of runs, best estimates, of formulas; each with its whole error.

Errors of runs are those of whole_error.py. A table of runs of the scene (cost_table.py) also gives the best
estimate that each run comes to.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ..formatting import value_text
from ..read.wheel_run import WheelRun
from .budget import Budget
from .cost_table import Family, FamilyKey
from .prediction import Prediction
from .verdict import QUANTITIES, Quantity
from .whole_error import budgets

# Kinds of entries; BEST: what a run comes to by the sizes of its family (grid_convergence.py)
RUN, BEST, FORMULA, MEASURED = "run", "best estimate", "formula", "measured"
NAME_IN_RUN = {"sinkage": "hub_drop", "coefficient": "resistance_coefficient"}


@dataclass(frozen=True)
class Entry:
    """One value of one quantity in the comparison, SI."""

    quantity: Quantity
    source: str  # label of a run, name of a formula, "measured"
    value: float
    parts: Budget
    kind: str  # RUN, BEST, FORMULA, MEASURED
    note: str = ""
    cpu_time: float = math.nan
    steady: bool = True  # else the time average has no error that is known

    @property
    def label(self) -> str:
        """The source, "grains, best estimate" of one."""
        return f"{self.source}, {BEST}" if self.kind == BEST else self.source

    @property
    def of_run(self) -> bool:
        """Whether its uncertainty has the parts of a run's."""
        return self.kind in (RUN, BEST)

    @property
    def uncertainty(self) -> float:
        """NaN where nothing of it is known."""
        return self.parts.total

    @property
    def unknown(self) -> list[str]:
        """Parts of its numerical uncertainty that are not known."""
        if not self.of_run:
            return []
        missing = [name for name in self.parts.NUMERICAL if name in self.parts.unknown]
        return missing if self.steady or "time" in missing else ["time", *missing]

    def text(self) -> str:
        """The value with its uncertainty in the unit of the quantity."""
        scale = self.quantity.scale
        return value_text(scale * self.value, scale * self.uncertainty)


def entries_of_run(run: WheelRun, families: Mapping[FamilyKey, Family]) -> list[Entry]:
    """Each quantity of a run with its whole error. families: of a table of runs of the scene, may be empty"""
    entries = []
    errors = budgets(run, families)
    for quantity in QUANTITIES:
        value = run.values[NAME_IN_RUN[quantity.key]]
        parts = errors[NAME_IN_RUN[quantity.key]]
        note = "" if value.steady else "not called steady"
        entries.append(Entry(quantity, run.label, value.mean, parts, RUN, note, run.cpu_time, value.steady))
    return entries


def best_estimates(run: WheelRun, families: Mapping[FamilyKey, Family]) -> list[Entry]:
    """Best estimates of each quantity, as far as a table's families have more than one size."""
    entries = []
    family = families.get(FamilyKey(run.ground, run.model, run.wheel))
    for quantity in QUANTITIES:
        steady = run.values[NAME_IN_RUN[quantity.key]]
        best = family and family.best_estimate(
            quantity.key, run.size, steady.mean, steady.standard_error
        )
        if best:
            value, parts = best
            entries.append(Entry(quantity, run.label, value, parts, BEST, steady=steady.steady))
    return entries


def formula_entries(prediction: Prediction) -> list[Entry]:
    note = "extrapolated" if prediction.outside else ""
    values = (
        (prediction.sinkage, prediction.sinkage_scatter),
        (prediction.coefficient, prediction.coefficient_scatter),
    )
    return [
        Entry(
            quantity,
            prediction.method,
            value,
            Budget(time=scatter) if scatter > 0 else Budget(),
            FORMULA,
            note,
        )
        for quantity, (value, scatter) in zip(QUANTITIES, values)
    ]
