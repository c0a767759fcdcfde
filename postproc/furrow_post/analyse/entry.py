# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that are compared: of runs, best estimates, of formulas; each with its uncertainty.

Uncertainties are standard deviations: of the time average from the run itself; of the size of
elements or grains, of the domain and of the packing from a table of runs of the scene
(cost_table.py), which also gives the best estimate that each run comes to.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ..formatting import value_text
from ..read.wheel_run import GROUNDS_OF_CELLS, WheelRun
from .cost_table import Components, Family, FamilyKey
from .prediction import Prediction
from .verdict import QUANTITIES, Quantity

# Kinds of entries; BEST: what a run comes to by the sizes of its family (grid_convergence.py)
RUN, BEST, FORMULA, MEASURED = "run", "best estimate", "formula", "measured"
NAME_IN_RUN = {"sinkage": "hub_drop", "coefficient": "resistance_coefficient"}


@dataclass(frozen=True)
class Entry:
    """One value of one quantity in the comparison, SI."""

    quantity: Quantity
    source: str  # label of a run, name of a formula, "measured"
    value: float
    parts: Components
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
        """Parts of its uncertainty that are not known."""
        if not self.of_run:
            return []
        moving = [] if self.steady or "time" in self.parts.unknown else ["time"]
        return [*moving, *self.parts.unknown]

    def text(self) -> str:
        """The value with its uncertainty in the unit of the quantity."""
        scale = self.quantity.scale
        return value_text(scale * self.value, scale * self.uncertainty)


def parts_without_table(run: WheelRun, time: float) -> Components:
    """Parts of an error that a run knows by itself: nothing in cells is random, a road has no end."""
    road = run.ground == "none"
    packing = 0.0 if road or run.ground in GROUNDS_OF_CELLS else math.nan
    return Components(time=time, domain=0.0 if road else math.nan, packing=packing)


def entries_of_run(run: WheelRun, families: Mapping[FamilyKey, Family]) -> list[Entry]:
    """Each quantity of a run, with the parts of its error that a table's families know."""
    entries = []
    family = families.get(FamilyKey(run.ground, run.model, run.wheel))
    for quantity in QUANTITIES:
        value = run.values[NAME_IN_RUN[quantity.key]]
        if family:
            parts = family.components(quantity.key, run.size, value.standard_error)
        else:
            parts = parts_without_table(run, value.standard_error)
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
            Components(time=scatter) if scatter > 0 else Components(),
            FORMULA,
            note,
        )
        for quantity, (value, scatter) in zip(QUANTITIES, values)
    ]
