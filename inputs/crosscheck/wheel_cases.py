# SPDX-License-Identifier: GPL-2.0-or-later
"""Wheels and tyres on both grounds, with formulas and measurements."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import NamedTuple

from cases import BASE, CHECKS, FLOW, HERE, INPUTS, LAW, Made
from lines import OutputRow, line_of, number_line

from furrow_post.laws import empirical
from furrow_post.uncertainty import cost_table
from furrow_post.analyse.comparison import Comparison, compare, formula_entries
from furrow_post.analyse.flow import compare_flows
from furrow_post.laws.prediction import Prediction
from furrow_post.laws.terrain_values import terrain
from furrow_post.uncertainty.verdict import BEST, QUANTITIES, RUN, Entry
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.figures.comparison_figure import draw_comparison
from furrow_post.figures.flow_figure import draw_flow
from furrow_post.read.wheel_run import WheelRun, read_wheel_run
from furrow_post.study.study_files import Output

GROUNDS = ("continuum", "grains")  # grounds that every case has
HYBRID = "hybrid"
MEASURED_WHEELS = INPUTS / "validation" / "snow_wheel" / "reference.csv"
PRESSURE = 179e3  # [Pa] for NRMM
BEKKER = ("LLL dry sand", "LETE sand")  # for cases on sand


class Test(NamedTuple):
    """Data that formulas need, SI."""

    load: float
    wheel_diameter: float
    wheel_width: float
    depth: float
    density: float

    @classmethod
    def of(cls, run: WheelRun) -> "Test":
        return cls(*(run.number(name) for name in cls._fields))


def formulas(case: str, test: Test) -> list[Prediction]:
    """Predictions of the formulas of the case, those in their range."""
    wheel = (test.load, test.wheel_diameter, test.wheel_width)
    if "snow" in case:
        snow = (test.depth, test.density, PRESSURE)
        wanted = {
            "NRMM": partial(
                empirical.nrmm, test.load, 0.5 * test.wheel_diameter, test.wheel_width, *snow
            )
        }
    else:
        wanted = {
            f"Bekker, {name}": partial(empirical.bekker, *wheel, terrain(name))
            for name in BEKKER
        }
    found = []
    for name, formula in wanted.items():
        try:
            found.append(replace(formula(), method=name))
        except ResultsError:  # out of range, or the ground does not carry the load
            continue
    return found


class WheelCase:
    """Pairs of wheel runs, and a hybrid where there is one, with the errors of the case's own checks."""

    def __init__(self, case: str, made: Made) -> None:
        self.case, self.made = case, made
        self.plans = {(planned.ground, planned.role): planned for planned in made.plans}
        self.runs = {
            key: read_wheel_run(made.folder(planned), planned.ground)
            for key, planned in self.plans.items()
        }
        self.table = [
            cost_table.row_of(self.runs[key])
            for key, planned in self.plans.items()
            if planned.kind in CHECKS
        ]

    @property
    def complete(self) -> bool:
        """True if there is a pair to compare."""
        return all((ground, BASE) in self.runs for ground in GROUNDS)

    def compared(self, role: str) -> Comparison:
        """The continuum's run of this role next to the base of the grains; its base next to the hybrid's."""
        runs = [self.runs["continuum", role], self.runs["grains", BASE]]
        if role == BASE and (HYBRID, BASE) in self.runs:
            runs.append(self.runs[HYBRID, BASE])
        measured = MEASURED_WHEELS if "tyre" in self.case else None
        beside = formulas(self.case, Test.of(runs[0]))
        return compare(runs, self.table, beside, measured, anyway=True)

    def lines(self) -> Iterator[OutputRow]:
        roles = [role for ground, role in self.plans if role.startswith(LAW)]
        for role in (BASE, *roles):
            place = role.rpartition("=")[2]
            result = self.compared(role)
            own = {"continuum": role, "grains": BASE, HYBRID: BASE}
            for entry in result.entries:
                if entry.kind == BEST and role != BASE:
                    continue  # the slope in the size is that of the base's law
                if entry.kind in (RUN, BEST):
                    key = entry.source, own[entry.source]
                    program = self.made.program(self.plans[key])
                    yield line_of(self.case, place, entry, self.runs[key].size, program)
                else:
                    yield line_of(self.case, place, entry)

    def flow(self, output: Output) -> Iterator[OutputRow]:
        """How differently the grounds move and bear, where the case has a run for it; draws it."""
        if ("grains", FLOW) not in self.runs:
            return
        result = compare_flows([self.runs["continuum", BASE], self.runs["grains", FLOW]])
        draw_flow(result, output.path(f"{self.case}_flow.png"))
        for field in ("displacement", "density", "stress"):
            name = f"{field}_difference"
            yield number_line(self.case, FLOW, name, getattr(result, name))

    def draw(self, output: Output) -> None:
        """Draws the figure of a case and writes the table of its runs for furrow-post cost."""
        draw_comparison(self.compared(BASE), output.path(f"{self.case}.png"))
        comment = "# Runs of the case with their size, domain, packing: what its errors come from."
        cost_table.write_table(output.path(f"{self.case}_runs.csv"), self.table, [comment])


def cited_table(case: str) -> list[cost_table.Row]:
    """Runs of a case that cited.csv names, of all its grounds; empty of another case."""
    tables = {line["table"] for line in read_rows(HERE / "cited.csv") if line["case"] == case}
    read = (cost_table.read_table(INPUTS / "costs" / f"{name}.csv") for name in sorted(tables))
    return [row for rows, _ in read for row in rows]


def cited_lines() -> Iterator[OutputRow]:
    """Lines of the cases of cited.csv, a family of a table of inputs/costs each."""
    cited = read_rows(HERE / "cited.csv")
    for line in cited:
        rows, _ = cost_table.read_table(INPUTS / "costs" / f"{line['table']}.csv")
        row = next(row for row in rows if row.run == line["run"])
        family = cost_table.families(rows)[row.family]
        for quantity in QUANTITIES:
            value, error = row.value(quantity.key)
            parts = family.components(quantity.key, row.size, error)
            entry = Entry(quantity, row.ground, value, parts, RUN, cpu_time=row.cpu_time)
            yield line_of(line["case"], BASE, entry, row.size)
            limit = family.best_estimate(quantity.key, row.size, value, error)
            if limit:
                yield line_of(line["case"], BASE, Entry(quantity, row.ground, *limit, BEST))
    for case in dict.fromkeys(line["case"] for line in cited):
        first = next(line for line in cited if line["case"] == case)
        test = Test(*(float(first[name]) for name in Test._fields))
        for prediction in formulas(case, test):
            for entry in formula_entries(prediction):
                yield line_of(case, BASE, entry)
