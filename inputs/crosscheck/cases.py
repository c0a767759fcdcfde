# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the cross-check: the lines of cases.csv."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from furrow_post.csv_table import read_rows
from furrow_post.run.case import Case, named_values, script_case
from furrow_post.run.record import Record
from furrow_post.run.executor import Executor

HERE = Path(__file__).resolve().parent
INPUTS = HERE.parent
BASE, LAW, FLOW = "base", "law", "flow"
SERIES = "at "  # "at load=3120"
CHECKS = (BASE, "size", "packing", "domain")  # kinds of roles that say how sure the base is


@dataclass(frozen=True)
class Planned:
    """A line of cases.csv."""

    case: str
    ground: str  # continuum, grains or hybrid
    script: str
    role: str  # base, a check of the base's error, another law, flow, or a point of a series
    run: Case

    @property
    def kind(self) -> str:
        """The role without its value: base, size, packing, domain, law, flow, at load."""
        return self.role.partition("=")[0]

    @property
    def is_check(self) -> bool:
        """True for a run that checks the base; false for the base."""
        return self.role != BASE and self.kind in CHECKS

    @property
    def is_point(self) -> bool:
        """True for a point of a series: as the base, but for one condition."""
        return self.role.startswith(SERIES)

    @property
    def of_wheel(self) -> bool:
        return not self.script.startswith("plate")


def plan() -> list[Planned]:
    return [
        Planned(row["case"], row["ground"], row["script"], row["role"], make_case(row))
        for row in read_rows(HERE / "cases.csv")
    ]


def make_case(row: Mapping[str, str]) -> Case:
    """Case of a script of this folder, whose path the variable `here` has for its include lines."""
    role = row["role"].replace("=", "_").replace(" ", "_")
    name = f"{row['case']}/{row['ground']}_{role}"
    script = (HERE / f"{row['script']}.lig").resolve()
    variables = named_values(row["variables"])
    if script.parent == HERE:
        variables["here"] = HERE
    return script_case(name, script, variables, log=True, stage=row["case"])


class Made:
    """The runs of a case that are there, with their records."""

    def __init__(self, executor: Executor, plans: Sequence[Planned]) -> None:
        self.executor = executor
        self.records: dict[str, Record] = {}
        for planned in plans:
            run = executor.ended(planned.run)
            if run and not run.error:
                self.records[run.name] = run.record
        self.plans = [planned for planned in plans if planned.run.name in self.records]

    def folder(self, planned: Planned) -> Path:
        return self.executor.folder(planned.run)

    def program(self, planned: Planned) -> str:
        return self.records[planned.run.name].program
