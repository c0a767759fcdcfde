# SPDX-License-Identifier: GPL-2.0-or-later
"""Material files of a continuum: what the virtual tests need of one, and writing one."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from ..errors import ResultsError, content_of
from ..formatting import yaml_text
from ..programs import inputs_folder

MOST_BASES = 8
OF_GRAINS = ".lig"  # ending of a ground of grains
SECTIONS = ("law", "elasticity", "hardening")
TYPICAL_PRESSURE = 1e4  # [Pa] where laws whose stiffness grows with pressure have the constants below
NORSAND_PRESSURE = 1e5  # [Pa] of G, src/material/models/norsand


@dataclass(frozen=True)
class Material:
    """density [kg/m3], elastic constants [Pa] at the start, or at 10 kPa if they grow with pressure."""

    title: str
    density: float
    young: float
    poisson: float
    linear: bool = True  # whether the file has Young's modulus, which modulus_scale needs

    @property
    def wave_speed(self) -> float:
        """Of pressure waves [m/s]."""
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
    """Follows `base`, as furrow does; whether the file is right, furrow says. @raises ResultsError"""
    content = _with_base(path, 0)
    with content_of(path, "furrow-soil needs density, and E and nu or kappa, e0 and nu"):
        law = content["law"]
        norsand = law.get("type") == "norsand"  # which has its own elasticity
        linear = not norsand and content["elasticity"]["type"] == "linear"
        if norsand:
            poisson = float(law["nu"])
            shear = float(law["G"]) * (TYPICAL_PRESSURE / NORSAND_PRESSURE) ** float(law["n"])
            young = 2 * shear * (1 + poisson)
        elif linear:
            young, poisson = float(content["elasticity"]["E"]), float(content["elasticity"]["nu"])
        else:
            elasticity = content["elasticity"]
            poisson = float(elasticity.get("nu", 0.25))
            bulk = (1 + float(elasticity["e0"])) * TYPICAL_PRESSURE / float(elasticity["kappa"])
            young = 3 * bulk * (1 - 2 * poisson)
        title = str(content.get("title", path.stem))
        return Material(title, float(law["density"]), young, poisson, linear)


def content_with_bases(path: Path) -> str:
    """Equal for equal grounds, whichever of their files changed. @raises ResultsError"""
    text: str = yaml.safe_dump(_with_base(path, 0))
    return text


def _with_base(path: Path, count: int) -> dict[str, Any]:
    if count > MOST_BASES:
        raise ResultsError(f"{path}: is the base of {MOST_BASES} files; is one its own base?")
    with content_of(path, "a material file is YAML, inputs/guide/soil_files.md"):
        try:
            content = yaml.safe_load(path.read_text(encoding="utf-8"))
        except yaml.YAMLError as error:
            raise ValueError(" ".join(str(error).split())) from error
        if not isinstance(content, dict):
            raise ValueError("has no keys")
        if "base" not in content:
            return content
        whole = _with_base(path.parent / str(content["base"]), count + 1)
        for name in SECTIONS:
            section = content.get(name, {})
            same = section.get("type", whole.get(name, {}).get("type")) == whole.get(name, {}).get("type")
            whole[name] = {**(whole.get(name, {}) if same else {}), **section}
        whole["title"] = content.get("title", whole.get("title"))
        return whole


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

    def text(self) -> str:
        """The material file."""
        lines = [f"title: {yaml_text(self.title)}", *(f"# {line}" for line in self.head)]
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
