# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the lines of cases.csv, and the lines of results.csv that they give."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from furrow_post.analyse.cost_table import Components
from furrow_post.csv_table import read_rows
from furrow_post.study.case import Case, Value
from furrow_post.study.furrow_cases import laboratory_case, point_case, script_case
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
MATERIALS = PROJECT / "inputs" / "materials"
BASE = "base"
CHECKS = (BASE, "size", "packing", "domain")  # kinds of roles that say how sure the base is

OutputRow = dict[str, str]  # of results.csv


@dataclass(frozen=True)
class Planned:
    """A line of cases.csv."""

    case: str
    ground: str  # continuum or grains
    script: str
    role: str  # base, a point of a series, another law, or a check of the base's error
    run: Case

    @property
    def kind(self) -> str:
        """The role without its value: base, size, packing, domain, load, depth, speed, law."""
        return self.role.partition("=")[0]

    @property
    def is_check(self) -> bool:
        """Of the base, which is none of itself."""
        return self.role != BASE and self.kind in CHECKS

    @property
    def of_wheel(self) -> bool:
        return self.script.startswith(("wheel", "tyre"))


def plan() -> list[Planned]:
    return [
        Planned(row["case"], row["ground"], row["script"], row["role"], make_case(row))
        for row in read_rows(HERE / "cases.csv")
    ]


def make_case(row: Mapping[str, str]) -> Case:
    """script of a row: one of this folder, "laboratory" or "point", the oedometer on either."""
    name = f"{row['case']}/{row['ground']}_{row['role'].replace('=', '_')}"
    pairs = (word.partition("=") for word in row["variables"].split())
    variables: dict[str, Value] = {key: value for key, _, value in pairs}
    if row["script"] == "point":
        material, stress = str(variables["material"]), variables.get("stress", "5e5")
        path = f"{{type: confined, stress: [1e3, 1e4, 1e5, {stress}], steps: 80}}"
        file = MATERIALS / f"{material}.yaml"
        return point_case(name, material, file, path, stage=row["case"])
    if row["script"] == "laboratory":
        return laboratory_case(name, "oedometer", PROJECT, variables, stage=row["case"])
    script = HERE / f"{row['script']}.lig"
    return script_case(name, script, {"here": HERE, **variables}, log=True, stage=row["case"])


class Made:
    """The runs of a case that are there, with their records."""

    def __init__(self, runner: Runner, plans: Sequence[Planned]) -> None:
        self.runner = runner
        self.records: dict[str, Record] = {}
        for planned in plans:
            record = runner.record(planned.run)
            if record:
                self.records[planned.run.name] = record
        self.plans = [planned for planned in plans if planned.run.name in self.records]

    def folder(self, planned: Planned) -> Path:
        return self.runner.folder(planned.run)

    def cost_cells(self, planned: Planned) -> dict[str, str]:
        record = self.records[planned.run.name]
        return {"cpu_time": f"{record.cpu_time:.4g}", "program": record.program}


def output_row(case: str, place: str, ground: str, quantity: str, **numbers: str) -> OutputRow:
    keys = ("value", "uncertainty", *Components.NAMES, "cpu_time", "program")
    head = {"case": case, "place": place, "ground": ground, "quantity": quantity}
    return {**head, **{key: numbers.get(key, "") for key in keys}}


def known(number: float) -> str:
    return f"{number:.3g}" if math.isfinite(number) else ""
