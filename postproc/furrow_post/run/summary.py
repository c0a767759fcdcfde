# SPDX-License-Identifier: GPL-2.0-or-later
"""The steady values of a run as summary.json has them; furrow-resistance computes them."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import ResultsError, content_of
from ..json_text import parse_json


@dataclass(frozen=True)
class SteadyValue:
    """A mean over the steady window, SI, with the standard error of the time average."""

    mean: float
    standard_error: float
    unit: str
    steady: bool
    imposed: bool = False  # an input of the run


@dataclass(frozen=True)
class ResistanceParts:
    """Parts of the resistance over the window [N]: whole = sum of forces + unexplained."""

    whole: float
    forces: Mapping[str, float]  # by the name of the part, in the order of the summary
    unexplained: float


# quantity in files of earlier versions -> its name
FORMER_NAMES = {"sinkage": "hub_drop", "drawbar_coefficient": "net_traction_coefficient"}


BUDGET = "budget.json"  # whole errors with their parts, which furrow-post run writes


def whole_errors(folder: Path) -> dict[str, float]:
    """Quantity -> whole standard error; empty where none are stored. @raises ResultsError"""
    path = folder / BUDGET
    if not path.is_file():
        return {}
    with content_of(path, "write it again with 'furrow-post budget --write'"):
        return {name: float(one["error"]) for name, one in parse_json(path.read_text(encoding="utf-8")).items()}


class Summary:
    """summary.json of a results folder; empty where there is none."""

    def __init__(self, folder: Path) -> None:
        """@raises ResultsError where the file is not a summary"""
        path = self._path = folder / "summary.json"
        remedy = self._remedy = (
            f"write it again with 'furrow-post resistance --write {folder}'"
        )
        content: Any = {}
        try:
            content = parse_json(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            pass
        except (OSError, ValueError) as error:
            raise ResultsError(f"{path}: cannot be read ({error}); {remedy}") from error
        if not isinstance(content, dict):
            raise ResultsError(f"{path}: is not a summary of Furrow; {remedy}")
        self.content: dict[str, Any] = content

    @property
    def window(self) -> tuple[float, float] | None:
        """Begin and end of the steady window [s]."""
        window = self.content.get("window")
        with content_of(self._path, self._remedy):
            return (float(window["start"]), float(window["end"])) if window else None

    @property
    def quantities(self) -> dict[str, dict[str, Any]]:
        """Name -> what the file has of it: mean, standard_error, unit, steady, verdict."""
        found: dict[str, dict[str, Any]] = self.content.get("quantities", {})
        return {FORMER_NAMES.get(name, name): value for name, value in found.items()}

    def quantity(self, name: str) -> SteadyValue | None:
        """None where the file has no such quantity or no number for it."""
        with content_of(self._path, self._remedy):
            value = dict(self.quantities).get(name)
            if value is None or None in (value["mean"], value["standard_error"]):
                return None
            mean, error = float(value["mean"]), float(value["standard_error"])
            imposed = bool(value.get("imposed", False))
            return SteadyValue(mean, error, str(value["unit"]), bool(value["steady"]), imposed)

    @property
    def headline(self) -> list[str]:
        """Names of the quantities that a run is made for. A towed wheel has no torque and a resistance coefficient, a
        driven one has a net traction coefficient."""
        torque = self.quantity("drive_torque")
        towed = torque is None or not (torque.mean or torque.standard_error)
        wanted = ("hub_drop", "tyre_deflection", "rut_depth", "resistance_coefficient" if towed else "net_traction_coefficient",
                  "" if towed else "drive_torque", "slip")  # fmt: skip
        return [name for name in wanted if self.quantity(name)]

    @property
    def verdict(self) -> str:
        """Verdict of one line; empty in files of earlier versions."""
        return str(self.content.get("verdict", ""))

    @property
    def parts(self) -> ResistanceParts | None:
        """Parts of the resistance; None in a file without them."""
        return self._parts_in(self.content)

    @property
    def parts_of_passes(self) -> list[ResistanceParts | None]:
        """Parts of each pass of several in one rut; empty for a single one."""
        with content_of(self._path, self._remedy):
            return [self._parts_in(dict(one)) for one in list(self.content.get("passes", []))]

    def _parts_in(self, content: Mapping[str, Any]) -> ResistanceParts | None:
        with content_of(self._path, self._remedy):
            found = content.get("resistance_parts")
            if found is None:
                return None
            forces = {str(name): float(force) for name, force in dict(found["parts"]).items()}
            return ResistanceParts(float(found["whole"]), forces, float(found["unexplained"]))
