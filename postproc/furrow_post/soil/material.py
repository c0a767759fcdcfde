# SPDX-License-Identifier: GPL-2.0-or-later
"""Material files of a continuum: what the virtual tests need of one, and writing one; values that soils have."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from ..errors import ResultsError, content_of
from ..formatting import yaml_text
from ..json_text import parse_json
from ..programs import find_program, inputs_folder
from ..read.soil_card import contact_of
from ..run.tools import answer

OF_GRAINS = ".lig"  # ending of a ground of grains
TYPICAL_PRESSURE = 1e4  # [Pa] pressure of the elastic constants of laws with pressure-dependent stiffness


@dataclass(frozen=True)
class Material:
    """density [kg/m3], elastic constants [Pa] at 10 kPa."""

    title: str
    density: float
    young: float
    poisson: float
    linear: bool = True  # whether the file has Young's modulus, which modulus_scale needs

    @property
    def wave_speed(self) -> float:
        """Speed of pressure waves [m/s]."""
        nu = self.poisson
        modulus = self.young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return math.sqrt(modulus / self.density)

    def punch_stiffness(self, radius: float) -> float:
        """Elastic pressure over sinkage under a rigid round plate: F = 2 E a w/(1 - nu^2), S. P.
        Timoshenko and J. N. Goodier, Theory of Elasticity (1970), eq 217 [Pa/m]."""
        return 2 * self.young / (math.pi * radius * (1 - self.poisson**2))


def find_ground(name: str) -> Path:
    """A file, or one of inputs/materials or of the laboratory's grounds of grains by its name.
    @raises ResultsError"""
    if Path(name).is_file():
        return Path(name).resolve()
    inputs = inputs_folder()
    known = []
    if inputs:
        every = [*(inputs / "materials").glob("*.yaml"), *(inputs / "laboratory" / "grounds").glob(f"*{OF_GRAINS}")]
        for file in every:
            if Path(name).stem == file.stem:
                return file
        known = sorted({file.stem for file in every})
    raise ResultsError(f"there is no ground '{name}'; name a file, or one of {', '.join(known) or 'none'}")


def read_material(path: Path) -> Material:
    """A material file with its bases, as furrow-point reads it. @raises ResultsError"""
    content = parse_json(
        answer([find_program("furrow-point"), "show", path, "--json", "--pressure", TYPICAL_PRESSURE])
    )
    elastic = content["elastic"]
    # NorSand has its own elasticity
    linear = content["sections"].get("elasticity", {}).get("type") == "linear"
    return Material(content["title"], elastic["density"], elastic["young"], elastic["poisson"], linear)


def read_contact(path: Path) -> dict[str, Any] | None:
    """The section `contact` with those of the bases below it. @raises ResultsError"""
    with content_of(path, "a material file is YAML, inputs/guide/soil_files.md"):
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
        below = read_contact(path.parent / str(content["base"])) if "base" in content else None
        own = contact_of(path, content)
        return {**(below or {}), **own} if own else below


@dataclass(frozen=True)
class Parameter:
    """A number of a material file and where it comes from; guessed: not from the user's data."""

    value: float | str
    origin: str
    guessed: bool = False

    def comment(self) -> str:
        return f"GUESSED: {self.origin}" if self.guessed else self.origin


@dataclass(frozen=True)
class NewMaterial:
    """A cap law with linear elasticity and a table of hardening."""

    title: str
    head: tuple[str, ...]
    law: Mapping[str, Parameter]
    elasticity: Mapping[str, Parameter]
    pressure: tuple[float, ...]  # [Pa]
    strain: tuple[float, ...]  # plastic volume strain
    hardening: Parameter  # origin of the table
    bands: tuple[str, ...] = ()  # ranges of what is not known

    def text(self) -> str:
        """Text of the material file."""
        lines = [f"title: {yaml_text(self.title)}", *(f"# {line}" for line in (*self.head, *self.bands))]
        lines += ["law:", "  type: drucker_prager_cap"]
        lines += [_line(name, parameter) for name, parameter in self.law.items()]
        lines += ["elasticity:", "  type: linear"]
        lines += [_line(name, parameter) for name, parameter in self.elasticity.items()]
        lines += [
            "hardening:",
            "  type: table",
            f"  # {self.hardening.comment()}",
            f"  p: [{', '.join(f'{p:.6g}' for p in self.pressure)}]",
            f"  eps_vol_pl: [{', '.join(f'{e:.6g}' for e in self.strain)}]",
            "  interpolation: linear",
            "  beyond: extrapolate",
        ]
        return "\n".join(lines) + "\n"

    def guesses(self) -> list[str]:
        """ "name: origin" of each guessed parameter."""
        every = {**self.law, **self.elasticity, "hardening": self.hardening}
        return [f"{name}: {p.origin}" for name, p in every.items() if p.guessed]


def _line(name: str, parameter: Parameter) -> str:
    value = parameter.value
    shown = value if isinstance(value, str) else f"{value:.6g}"
    return f"  {name}: {shown}".ljust(24) + f"  # {parameter.comment()}"


@dataclass(frozen=True)
class UsualRange:
    """Values of soils and snow in a unit, and what a value outside may be in."""

    unit: str
    lower: float
    upper: float
    zero: bool  # 0 is usual too
    hint: str


@cache
def usual_ranges() -> dict[str, UsualRange]:
    """Usual range of each key, from furrow-point. @raises ResultsError without the program"""
    table = parse_json(answer([find_program("furrow-point"), "usual"]))
    return {key: UsualRange(**row) for key, row in table.items()}


def require_plausible(name: str, value: float) -> None:
    """name: a key of usual_ranges(). @raises ResultsError that names unit and remedy"""
    known = usual_ranges()[name]
    if known.lower <= value <= known.upper or (known.zero and value == 0):
        return
    unit = f" {known.unit}" if known.unit else ""
    zero = " or 0" if known.zero else ""
    raise ResultsError(
        f"{name} is {value:g}{unit}; soils and snow have {known.lower:g} to {known.upper:g}{unit}{zero}. "
        f"Give SI units: {known.hint}."
    )
