# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of one scene in a table: what each gave, its discretisation and cost; and their errors.

A family is one ground, whole or half model, one kind of wheel. Its runs that differ in size and
packing give the best estimate of each quantity and the error of each size (grid_convergence.py):
extrapolated to zero size where the series allows it, else the value of the finest size. Runs in
another domain or with another packing (seed) give those two components beside runs of the same size:
of a domain the mean difference, of packings the standard deviation of one run.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, NamedTuple

from ..csv_table import in_cells, read_comments, read_rows, write_rows
from ..errors import ResultsError, content_of
from ..formatting import duration
from ..read.ground_kinds import ground_kind
from ..read.wheel_run import WheelRun
from .budget import Budget
from .grid_convergence import Convergence, grid_convergence, mean_shift, noise_of, pooled_scatter, same_size
from .statistics import commonest, grouped
from .verdict import QUANTITIES

QUANTITY_KEYS = tuple(quantity.key for quantity in QUANTITIES)


class FamilyKey(NamedTuple):
    """Properties that the runs of a family have in common."""

    ground: str
    model: str
    wheel: str


@dataclass
class Row:
    """One run of the table."""

    run: str
    ground: str  # continuum, grains, hybrid
    model: str  # whole, half
    wheel: str  # rigid wheel, tyre
    size: float  # cell or grain [m]
    domain: str  # length x width [m]
    seed: str  # of the packing
    sinkage: float  # [m]
    sinkage_error: float  # standard error of the time average
    coefficient: float  # resistance coefficient
    coefficient_error: float  # standard error of the time average of the coefficient
    cpu_time: float  # [s]

    @property
    def family(self) -> FamilyKey:
        return FamilyKey(self.ground, self.model, self.wheel)

    def value(self, key: str) -> tuple[float, float]:
        """A quantity and the standard error of its time average. key: of QUANTITY_KEYS"""
        value, error = getattr(self, key), getattr(self, f"{key}_error")
        return float(value), float(error)


HEADER = [f.name for f in fields(Row)]
NUMERIC = {f.name for f in fields(Row) if f.type is float}


def row_of(run: WheelRun) -> Row:
    values = [run.values[name] for name in ("hub_drop", "resistance_coefficient")]
    numbers = [number for value in values for number in (value.mean, value.standard_error)] + [run.cpu_time]
    domain = "x".join(f"{edge:.4g}" for edge in run.domain)
    return Row(run.label, run.ground, run.model, run.wheel, run.size, domain, run.seed, *numbers)


def read_table(path: Path) -> tuple[list[Row], list[str]]:
    """Rows of a table, and its comments. @raises ResultsError"""
    try:
        comments, rows = read_comments(path), read_rows(path)
    except OSError as error:
        remedy = f"a table is written by 'furrow-post cost RESULTS... --write {path}'"
        raise ResultsError(f"{path}: cannot be read ({error.strerror}); {remedy}") from error
    missing = [name for name in HEADER if not rows or name not in rows[0]]
    if missing:
        lacking = "rows" if not rows else f"column {missing[0]}"
        raise ResultsError(f"{path}: has no {lacking}; columns are {', '.join(HEADER)}")
    with content_of(path, "write the table again with 'furrow-post cost RESULTS... --write TABLE'"):
        return [parsed_row(row) for row in rows], comments


def parsed_row(row: Mapping[str, str]) -> Row:
    """@raises ValueError where a number is none, or a size is not above 0"""
    values: dict[str, Any] = {name: row[name] for name in HEADER}
    values.update({name: float(row[name]) for name in NUMERIC})
    for name in ("sinkage", "coefficient"):
        if not math.isfinite(values[name]):
            raise ValueError(f"run '{row['run']}': {name} is {row[name]}")
    if values["size"] <= 0 or math.isinf(values["size"]):  # NaN: a run without terrain
        raise ValueError(f"run '{row['run']}': size is {row['size']}")
    return Row(**values)


def write_table(path: Path, rows: Iterable[Row], comments: Sequence[str] = ()) -> None:
    texts = [{name: f"{v:.6g}" if isinstance(v, float) else v for name, v in vars(row).items()} for row in rows]
    write_rows(path, texts, comments)


class Family:
    """The rows of one family; its bases differ in size alone."""

    def __init__(self, rows: Sequence[Row]) -> None:
        self.rows = rows
        self.domain = commonest([r.domain for r in rows])
        self.seed = commonest([r.seed for r in rows])
        bases = [r for r in rows if r.domain == self.domain and r.seed == self.seed]
        self.bases = sorted(bases, key=lambda r: -r.size)  # from the coarsest to the finest
        self._series: dict[str, Convergence | None] = {}

    @property
    def key(self) -> FamilyKey:
        return self.rows[0].family

    @property
    def rows_of_series(self) -> list[Row]:
        """Rows of all sizes and packings in the common domain."""
        return [row for row in self.rows if row.domain == self.domain]

    def convergence(self, key: str) -> Convergence | None:
        """Convergence over the sizes; None with fewer than two sizes."""
        if key not in self._series:
            several = len({row.size for row in self.bases}) > 1
            self._series[key] = self._converged(key) if several else None
        return self._series[key]

    def _converged(self, key: str) -> Convergence:
        rows = self.rows_of_series
        packing = self.packing(key)
        values, errors = zip(*(row.value(key) for row in rows))
        noise = [noise_of(f, u, packing) for f, u in zip(values, errors)]
        return grid_convergence([row.size for row in rows], values, noise)

    def reference(self, key: str) -> tuple[float, float]:
        """The best estimate with its error; of one size the finest run, whose error is NaN."""
        series = self.convergence(key)
        if series:
            return series.value, series.error
        return self.bases[-1].value(key)[0], math.nan

    def packing(self, key: str) -> float:
        """Standard deviation of one packing; 0 of a lattice, NaN where there is one alone."""
        if not ground_kind(self.key.ground).random:
            return 0.0
        return pooled_scatter(self._values_of(key, base.size) for base in self.bases)

    def domain_error(self, key: str) -> float:
        """Mean difference of a domain from the common one; of several the largest, NaN of none.

        Each run counts against the mean of all packings of its size in the common domain.
        """
        others = grouped((row for row in self.rows if row.domain != self.domain), lambda row: row.domain)
        pairs = ([(row.value(key)[0], self._values_of(key, row.size)) for row in rows] for rows in others.values())
        return max((shift for shift in map(mean_shift, pairs) if math.isfinite(shift)), default=math.nan)

    def components(self, key: str, size: float, time_error: float = math.nan) -> Budget:
        """Parts of the error of a run of this size [m].

        That of the size is its distance from the best estimate and the error of that, or more
        where the table has a run of this size that lies further off than by its noise.
        """
        series, packing = self.convergence(key), self.packing(key)
        of_size = math.nan
        if series:
            scatter = packing if math.isfinite(packing) else 0.0
            values = (row.value(key) for row in self._bases_of(size))
            beyond = [(value - series.value) ** 2 - error**2 - scatter**2 for value, error in values]
            of_size = max(series.size_error(size), math.sqrt(max([0.0, *beyond])))
        return Budget(time_error, of_size, self.domain_error(key), packing, elements=self._elements)

    @property
    def _elements(self) -> str:
        return ground_kind(self.rows[0].ground).sizes

    def _bases_of(self, size: float) -> list[Row]:
        return [base for base in self.bases if same_size(base.size, size)]

    def _values_of(self, key: str, size: float) -> list[float]:
        """Values of all packings of this size in the common domain."""
        return [row.value(key)[0] for row in self.rows_of_series if same_size(row.size, size)]

    def best_estimate(self, key: str, size: float, value: float, time_error: float) -> tuple[float, Budget] | None:
        """Best estimate from a run of this size [m] and value, with the parts of its error.

        A run of the table has the family's best estimate, whose error has those of times and
        packings in it. Another, which may have another load or speed, moves by as much as the
        family does from this size. None with fewer than two sizes.
        """
        series = self.convergence(key)
        if series is None:
            return None
        if any(math.isclose(row.value(key)[0], value, rel_tol=1e-5) for row in self._bases_of(size)):
            return series.value, Budget(0.0, series.error, self.domain_error(key), 0.0, elements=self._elements)
        parts = self.components(key, size, time_error)
        return value - (series.at(size) - series.value), replace(parts, size=series.error)


def families(rows: Iterable[Row]) -> dict[FamilyKey, Family]:
    return {key: Family(group) for key, group in grouped(rows, lambda row: row.family).items()}


# ---- output as text


def numerical_errors(rows: Iterable[Row]) -> list[tuple[Row, dict[str, Budget]]]:
    """Every base run of every family, the cheapest first, with the error of each quantity."""
    found = []
    for family in families(rows).values():
        for row in sorted(family.bases, key=lambda row: row.cpu_time):
            found.append((row, {key: family.components(key, row.size, row.value(key)[1]) for key in QUANTITY_KEYS}))
    return found


def cost_report(rows: Iterable[Row]) -> str:
    """Values with their numerical errors, parts and cost."""
    lines = []
    for row, errors in numerical_errors(rows):
        kind = f"{row.ground}, {ground_kind(row.ground).sizes} of {1e3 * row.size:.3g} mm, {row.model} model, {row.wheel}"
        lines.append(f"{row.run}: {kind}, {duration(row.cpu_time)} of one core")
        for quantity in QUANTITIES:
            error = errors[quantity.key].scaled(quantity.scale)
            text = error.text(quantity.scale * row.value(quantity.key)[0], quantity.unit, error.NUMERICAL)
            lines.append(f"  {quantity.name:24} {text}")
    return "\n".join([*lines, "", "Errors are numerical. They do not hold what the model or the soil lacks."])


def write_errors(path: Path, rows: Iterable[Row]) -> None:
    """The runs with their numerical errors as a table."""
    lines = []
    for row, errors in numerical_errors(rows):
        line: dict[str, object] = {"run": row.run, **row.family._asdict(), "size_m": row.size, "cpu_time_s": row.cpu_time}
        for key, error in errors.items():
            line |= {key: row.value(key)[0], f"{key}_error": error.total}
            line |= {f"{key}_error_{part}": error.part(part) for part in error.NUMERICAL}
        lines.append(in_cells(line, 6))
    write_rows(path, lines, ["# numerical standard errors, SI units, CPU seconds of one core; empty: not known"])
