# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of one scene in a table: what each gave, its discretisation and cost; and their errors.

A family is one ground, whole or half model, one kind of wheel. Within a family the value at size h
is taken as f0 + C h (first order in the size of cells or grains), fitted by least squares to the
runs that differ in size alone: f0 is the value at size zero, |f - f0| the error of the size. Runs
in another domain or with another packing (seed) give those two components, as differences from the
run of the same size; a packing's standard deviation is that of one run.
"""

import csv
import math
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..csv_table import read_comments, read_rows
from ..errors import ResultsError, content_of
from ..read.wheel_run import WheelRun
from .statistics import commonest
from .verdict import QUANTITIES

QUANTITY_KEYS = tuple(quantity.key for quantity in QUANTITIES)


class FamilyKey(NamedTuple):
    """What the runs of a family have in common."""

    ground: str
    model: str
    wheel: str


@dataclass
class Row:
    """One run of the table."""

    run: str
    ground: str  # continuum, grains
    model: str  # whole, half
    wheel: str  # rigid wheel, tyre
    size: float  # cell or grain [m]
    domain: str  # length x width [m]
    seed: str  # of the packing
    sinkage: float  # [m]
    sinkage_error: float  # standard error of the time average
    coefficient: float  # resistance coefficient
    coefficient_error: float  # the same
    cpu_time: float  # [s]
    options: str  # scene and options of inputs/run that make this run; empty: none

    @property
    def family(self) -> FamilyKey:
        return FamilyKey(self.ground, self.model, self.wheel)

    def value(self, key: str) -> tuple[float, float]:
        """A quantity and the standard error of its time average. key: of QUANTITY_KEYS"""
        if key == "sinkage":
            return self.sinkage, self.sinkage_error
        return self.coefficient, self.coefficient_error


HEADER = [f.name for f in fields(Row)]
NUMERIC = {f.name for f in fields(Row) if f.type is float}


def row_of(run: WheelRun, options: str = "") -> Row:
    sinkage, coefficient = run.values["sinkage"], run.values["resistance_coefficient"]
    return Row(
        run.label,
        run.ground,
        run.model,
        run.wheel,
        run.size,
        "x".join(f"{edge:.4g}" for edge in run.domain),
        run.seed,
        sinkage.mean,
        sinkage.standard_error,
        coefficient.mean,
        coefficient.standard_error,
        run.cpu_time,
        options,
    )


def read_table(path: Path) -> tuple[list[Row], list[str]]:
    """Rows of a table, and its comments. @raises ResultsError"""
    try:
        comments = read_comments(path)
        rows = read_rows(path)
    except OSError as error:
        raise ResultsError(
            f"{path}: cannot be read ({error.strerror}); "
            f"a table is written by 'furrow-post cost RESULTS... --write {path}'"
        ) from error
    missing = [name for name in HEADER if not rows or name not in rows[0]]
    if missing:
        lacking = "rows" if not rows else f"column {missing[0]}"
        raise ResultsError(f"{path}: has no {lacking}; columns are {', '.join(HEADER)}")
    with content_of(path, "write the table again with 'furrow-post cost RESULTS... --write TABLE'"):
        return [_parsed(row) for row in rows], comments


def _parsed(row: dict[str, str]) -> Row:
    """@raises ValueError where a number is none, or a size is not above 0"""
    values: dict[str, Any] = {name: row[name] for name in HEADER}
    values.update({name: float(row[name]) for name in NUMERIC})
    for name in ("sinkage", "coefficient"):
        if not math.isfinite(values[name]):
            raise ValueError(f"run '{row['run']}': {name} is {row[name]}")
    if values["size"] <= 0 or math.isinf(values["size"]):  # NaN: a run without terrain
        raise ValueError(f"run '{row['run']}': size is {row['size']}")
    shlex.split(row["options"])
    return Row(**values)


def wanted_wheel(comments: Iterable[str]) -> str:
    """The wheel that a table is about, from its comment "# wheel: tyre".

    Empty where every wheel is judged by itself.
    """
    found = [line.partition(":")[2].strip() for line in comments if line.startswith("# wheel:")]
    return found[0] if found else ""


def write_table(path: Path, rows: Iterable[Row], comments: Sequence[str] = ()) -> None:
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write("".join(line.rstrip() + "\n" for line in comments))
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        for row in rows:
            values = (getattr(row, name) for name in HEADER)
            writer.writerow([f"{v:.6g}" if isinstance(v, float) else v for v in values])


@dataclass(frozen=True)
class Components:
    """Parts of an uncertainty: standard deviations in the quantity's unit; NaN: unknown."""

    time: float = math.nan
    size: float = math.nan
    domain: float = math.nan
    packing: float = math.nan

    NAMES: ClassVar[tuple[str, ...]] = ("time", "size", "domain", "packing")

    def part(self, name: str) -> float:
        value: float = getattr(self, name)
        return value

    def parts(self) -> list[float]:
        """In the order of NAMES."""
        return [self.part(name) for name in self.NAMES]

    @property
    def known(self) -> list[str]:
        return [name for name in self.NAMES if math.isfinite(self.part(name))]

    @property
    def unknown(self) -> list[str]:
        return [name for name in self.NAMES if not math.isfinite(self.part(name))]

    @property
    def total(self) -> float:
        """Root of the sum of the squares of what is known; NaN where nothing is."""
        if not self.known:
            return math.nan
        return math.sqrt(sum(self.part(name) ** 2 for name in self.known))


class Fit(NamedTuple):
    """f = at_zero + slope h."""

    at_zero: float
    slope: float
    at_zero_error: float  # standard error


class Family:
    """The rows of one family: bases differ in size alone, variants in domain or seed too."""

    def __init__(self, rows: Sequence[Row]) -> None:
        self.rows = rows
        self.domain = commonest([r.domain for r in rows])
        self.seed = commonest([r.seed for r in rows])
        bases = [r for r in rows if r.domain == self.domain and r.seed == self.seed]
        self.bases = sorted(bases, key=lambda r: -r.size)  # the finest last
        self.variants = [r for r in rows if r not in self.bases]

    @property
    def key(self) -> FamilyKey:
        return self.rows[0].family

    def fit(self, key: str) -> Fit | None:
        """None with fewer than two sizes. Two sizes: the error is that of their time averages."""
        h = np.array([row.size for row in self.bases])
        if len(set(h)) < 2:
            return None
        f, u = (np.array(column) for column in zip(*(row.value(key) for row in self.bases)))
        weight = 1 / np.maximum(u, 1e-3 * np.abs(f))
        design = np.column_stack([np.ones_like(h), h]) * weight[:, None]
        inverse = np.linalg.inv(design.T @ design)
        at_zero, slope = inverse @ design.T @ (f * weight)
        spread = 1.0
        if len(h) > 2:
            residuals = (f - at_zero - slope * h) * weight
            spread = max(np.sum(residuals**2) / (len(h) - 2), 1.0)
        return Fit(float(at_zero), float(slope), float(np.sqrt(spread * inverse[0, 0])))

    def reference(self, key: str) -> tuple[float, float]:
        """Value at size zero with its error; of one size the finest run, whose error is NaN."""
        fit = self.fit(key)
        if fit:
            return fit.at_zero, fit.at_zero_error
        return self.bases[-1].value(key)[0], math.nan

    def components(self, key: str, size: float, time_error: float = math.nan) -> Components:
        """Parts of the error of a run of this size [m]."""
        fit = self.fit(key)
        differences: dict[str, list[float]] = {"domain": [], "packing": []}
        for row in self.variants:
            same = [b for b in self.bases if abs(b.size - row.size) < 0.02 * row.size]
            if same:
                what = "packing" if row.domain == self.domain else "domain"
                differences[what].append(row.value(key)[0] - same[0].value(key)[0])
        domain = max((abs(d) for d in differences["domain"]), default=math.nan)
        packing = math.nan
        if self.key.ground == "continuum":
            packing = 0.0  # a lattice: nothing is random
        elif differences["packing"]:
            packing = float(np.std(np.array([0.0] + differences["packing"]), ddof=1))
        return Components(time_error, abs(fit.slope) * size if fit else math.nan, domain, packing)


def families(rows: Iterable[Row]) -> dict[FamilyKey, Family]:
    groups: dict[FamilyKey, list[Row]] = {}
    for row in rows:
        groups.setdefault(row.family, []).append(row)
    return {key: Family(group) for key, group in groups.items()}
