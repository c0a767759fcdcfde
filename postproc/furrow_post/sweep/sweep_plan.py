# SPDX-License-Identifier: GPL-2.0-or-later
"""Plan of a sweep: sweep.json in its folder, from which every other program takes it."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from ..errors import ResultsError, content_of
from ..json_text import parse_json
from ..whole_file import replaced
from .sweep_values import folder_name

FILE = "sweep.json"


@dataclass(frozen=True)
class PlannedRun:
    """One run of a sweep."""

    folder: str  # below that of the sweep
    values: Mapping[str, str]  # of the variables of the sweep
    seed: str = ""  # of a further packing of grains


@dataclass(frozen=True)
class SweepPlan:
    """The runs of a sweep."""

    script: str  # absolute path
    variables: tuple[str, ...]  # names, as they were given
    fixed: Mapping[str, str] = field(default_factory=dict)  # further variables of the script
    points: tuple[PlannedRun, ...] = ()
    ranks: int = 1
    until_steady: float = 0.0  # relative error; 0: as long as the script says
    time_limit: float = 0.0  # [s] of one run; 0: none

    def joined(self, other: "SweepPlan") -> "SweepPlan":
        """Plan with the points of another plan of the same scene added."""
        if other.settings() != self.settings():
            return self
        points = {point.folder: point for point in (*other.points, *self.points)}
        return replace(self, points=tuple(points.values()))

    def settings(self) -> tuple[object, ...]:
        """Settings that all points have in common."""
        return self.script, self.variables, dict(self.fixed), self.until_steady

    def write(self, folder: Path) -> None:
        """Writes the plan in one step: a killed program leaves the earlier file."""
        folder.mkdir(parents=True, exist_ok=True)
        with replaced(folder / FILE) as part:
            part.write_text(json.dumps(asdict(self), indent=1) + "\n", encoding="utf-8")


def read_plan(folder: Path) -> SweepPlan | None:
    """Plan of a sweep; None for another folder. @raises ResultsError for a damaged file"""
    path = folder / FILE
    if not path.is_file():
        return None
    with content_of(path, "start the sweep again, which writes it"):
        content = parse_json(path.read_text(encoding="utf-8"))
        points = tuple(PlannedRun(**point) for point in content.pop("points"))
        variables = tuple(content.pop("variables"))
        return SweepPlan(variables=variables, points=points, **content)


def points_of(rows: Sequence[Mapping[str, str]], seeds: Sequence[int]) -> tuple[PlannedRun, ...]:
    """rows: values of each; seeds: of further packings, the first one is that of the script."""
    points = []
    for values in rows:
        points.append(PlannedRun(folder_name(values), values))
        for seed in seeds:
            points.append(PlannedRun(folder_name({**values, "seed": str(seed)}), values, str(seed)))
    folders = [point.folder for point in points]
    twice = [folder for folder in folders if folders.count(folder) > 1]
    if twice:
        raise ResultsError(f"two points of the sweep would share the folder {twice[0]}")
    return tuple(points)
