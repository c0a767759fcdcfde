# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of one scene in a table: what each gave, with what discretisation, at what cost; and what that says about errors.

A family is one ground, whole or half model, one kind of wheel. Within a family the value at size h is taken as f0 + C h (first order in
the size of cells or grains), fitted by least squares to the runs that differ in size alone: f0 is the value at size zero, |f - f0| the
error of the size. Runs in another domain or with another packing (seed) give those two components, as differences from the run of the
same size; a packing's standard deviation is that of one run.
"""

import csv
import math
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from .results import ResultsError

QUANTITIES = ("sinkage", "coefficient")


@dataclass
class Row:
    run: str
    ground: str           # continuum, grains
    model: str            # whole, half
    wheel: str            # rigid wheel, tyre
    size: float           # m, cell or grain
    domain: str           # length x width [m]
    seed: str
    sinkage: float        # m
    sinkage_error: float  # standard error of the time average
    coefficient: float
    coefficient_error: float
    cpu_time: float       # s
    options: str          # words for inputs/run that make this run; empty where there are none

    @property
    def family(self):
        return (self.ground, self.model, self.wheel)

    def value(self, quantity):
        return getattr(self, quantity), getattr(self, quantity + "_error")


HEADER = [f.name for f in fields(Row)]


def row_of(run, options=""):
    """Row of a conditions.WheelRun."""
    z, c = run.values["sinkage"], run.values["resistance_coefficient"]
    domain = "x".join(f"{edge:.4g}" for edge in run.domain)
    return Row(run.label, run.ground, "half" if run.half else "whole", run.wheel, run.size, domain, run.seed, z.mean, z.error,
               c.mean, c.error, run.cpu_time, options)


def read(path):
    """Rows of a table and its comments. @raises ResultsError"""
    path = Path(path)
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise ResultsError(f"{path}: cannot be read ({error.strerror}); "
                           f"a table is written by 'furrow-post cost RESULTS... --write {path}'") from error
    comments = [line for line in lines if line.startswith("#")]
    rows = list(csv.DictReader(line for line in lines if line and not line.startswith("#")))
    missing = [name for name in HEADER if not rows or name not in rows[0]]
    if missing:
        raise ResultsError(f"{path}: has no {'rows' if not rows else 'column ' + missing[0]}; columns are {', '.join(HEADER)}")
    numeric = {f.name for f in fields(Row) if f.type in (float, "float")}
    try:
        return [Row(**{name: float(row[name]) if name in numeric else row[name] for name in HEADER}) for row in rows], comments
    except ValueError as error:
        raise ResultsError(f"{path}: {error}") from error


def wanted_wheel(comments):
    """The wheel that a table is about, from its comment "# wheel: tyre"; empty where every wheel is judged by itself."""
    found = [line.partition(":")[2].strip() for line in comments if line.startswith("# wheel:")]
    return found[0] if found else ""


def write(path, rows, comments=()):
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write("".join(line.rstrip() + "\n" for line in comments))
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        for row in rows:
            writer.writerow([f"{v:.6g}" if isinstance(v, float) else v for v in (getattr(row, name) for name in HEADER)])


@dataclass
class Components:
    """Parts of a numerical uncertainty, standard deviations in the quantity's unit; NaN: not known."""

    time: float = math.nan
    size: float = math.nan
    domain: float = math.nan
    packing: float = math.nan

    NAMES = ("time", "size", "domain", "packing")

    @property
    def known(self):
        return [name for name in self.NAMES if math.isfinite(getattr(self, name))]

    @property
    def total(self):
        return math.sqrt(sum(getattr(self, name) ** 2 for name in self.known)) if self.known else math.nan


class Family:
    """The rows of one family."""

    def __init__(self, rows):
        self.rows = rows
        most = lambda values: max(sorted(set(values)), key=list(values).count)
        self.domain, self.seed = most([r.domain for r in rows]), most([r.seed for r in rows])
        self.bases = sorted((r for r in rows if r.domain == self.domain and r.seed == self.seed), key=lambda r: -r.size)
        self.variants = [r for r in rows if r not in self.bases]

    def fit(self, quantity):
        """(f0, C, standard error of f0), or None with fewer than two sizes. Two sizes: the error is that of their time averages."""
        h = np.array([r.size for r in self.bases])
        if len(set(h)) < 2:
            return None
        f, u = (np.array(column) for column in zip(*(r.value(quantity) for r in self.bases)))
        weight = 1 / np.maximum(u, 1e-3 * np.abs(f))
        design = np.column_stack([np.ones_like(h), h]) * weight[:, None]
        inverse = np.linalg.inv(design.T @ design)
        f0, C = inverse @ design.T @ (f * weight)
        spread = 1.0
        if len(h) > 2:
            spread = max(np.sum(((f - f0 - C * h) * weight) ** 2) / (len(h) - 2), 1.0)
        return float(f0), float(C), float(np.sqrt(spread * inverse[0, 0]))

    def reference(self, quantity):
        """Value at size zero with its error; the finest run where there is but one size (error NaN: not known)."""
        fit = self.fit(quantity)
        if fit:
            return fit[0], fit[2]
        return self.bases[-1].value(quantity)[0], math.nan

    def components(self, quantity, size, time_error=math.nan):
        """Components at a size [m]."""
        fit = self.fit(quantity)
        found = Components(time=time_error, size=abs(fit[1]) * size if fit else math.nan)
        differences = {"domain": [], "packing": []}
        for row in self.variants:
            same = [b for b in self.bases if abs(b.size - row.size) < 0.02 * row.size]
            if same:
                what = "packing" if row.domain == self.domain else "domain"
                differences[what].append(row.value(quantity)[0] - same[0].value(quantity)[0])
        if differences["domain"]:
            found.domain = max(abs(d) for d in differences["domain"])
        if differences["packing"]:
            values = np.array([0.0] + differences["packing"])
            found.packing = float(np.std(values, ddof=1))
        if self.rows[0].ground == "continuum":
            found.packing = 0.0  # a lattice: nothing is random
        return found


def families(rows):
    """family -> Family."""
    groups = {}
    for row in rows:
        groups.setdefault(row.family, []).append(row)
    return {key: Family(group) for key, group in groups.items()}
