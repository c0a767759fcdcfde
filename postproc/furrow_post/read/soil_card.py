# SPDX-License-Identifier: GPL-2.0-or-later
"""A soil card: parameters of vehicle codes with standard errors and the range where they hold."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from ..arrays import Floats
from ..errors import ResultsError, content_of

UNITS = {  # of the parameters; lists of two numbers have the unit of the last column of the page
    "k_c": "N/m^(n+1)",
    "k_phi": "N/m^(n+2)",
    "n": "",
    "c": "Pa",
    "phi": "degree",
    "K": "m",
    "speed_stress": "Pa",
    "index": "Pa",
    "gradient": "Pa/m",
}
REMEDY = "write it with furrow-soil card"


INDEX_DEPTH = 0.15  # [m] over which a cone index is a mean, ASABE EP542
REACHED = 0.98  # of it, by the last row of a test
STANDARD_CONE = 0.02027  # [m] base of 323 mm2, ASABE S313.3


@dataclass(frozen=True)
class Fitted:
    """A parameter with its standard error."""

    value: float
    error: float


@dataclass(frozen=True)
class Range:
    """Where the tests were made."""

    low: float
    high: float


@dataclass(frozen=True)
class PressureSinkage:
    """p = (k_c/b + k_phi) z^n of M. G. Bekker (1969); b is the radius of a round plate."""

    k_c: Fitted  # [N/m^(n+1)]
    k_phi: Fitted  # [N/m^(n+2)]
    n: Fitted
    sinkage: Range  # [m]
    pressure: Range  # [Pa]
    radii: Range  # [m]
    residual: float  # rms, over the greatest pressure of each plate

    def at(self, sinkage: Floats, radius: float) -> Floats:
        modulus = self.k_c.value / radius + self.k_phi.value
        pressure: Floats = modulus * np.asarray(sinkage) ** self.n.value
        return pressure


@dataclass(frozen=True)
class Shear:
    """tau = (c + sigma tan phi)(1 - exp(-j/K)) of Z. Janosi and B. Hanamoto (1961)."""

    c: Fitted  # [Pa]
    phi: Fitted  # [degrees]
    K: Fitted  # [m]
    speed_stress: Fitted  # [Pa] of the grid at the speed of the ring; a part of the fit
    normal: Range  # [Pa]
    displacement: Range  # [m]
    residual: float  # rms, over the greatest shear stress

    def at(self, displacement: Floats, normal: Floats) -> Floats:
        strength = self.c.value + normal * math.tan(math.radians(self.phi.value))
        stress: Floats = strength * (1 - np.exp(-displacement / self.K.value))
        return stress


@dataclass(frozen=True)
class Cone:
    """Cone index: mean pressure on the base of a cone. Another size has another index."""

    index: Fitted  # [Pa] mean over `depth`
    gradient: Fitted  # [Pa/m] of the pressure over depth
    depth: Range  # [m]
    size: float  # diameter of the base [m]
    angle: float  # of the tip [degrees]

    @property
    def spread(self) -> float:
        """Standard deviation of the pressure over the depth [Pa]: of a straight line."""
        return abs(self.gradient.value) * (self.depth.high - self.depth.low) / math.sqrt(12)

    def mean_text(self) -> str:
        """What the index is a mean of, with the spread; and where formulas cannot take it."""
        depth = f"0 to {1e3 * self.depth.high:.0f} mm"
        text = f"cone index: mean over {depth}, spread over the depth {self.spread:.2g} Pa"
        if self.size == STANDARD_CONE and self.depth.high < REACHED * INDEX_DEPTH:
            text += f"; formulas need the mean over 0 to {1e3 * INDEX_DEPTH:.0f} mm: push the cone deeper"
        return text


SECTIONS: dict[str, tuple[type, str]] = {
    "pressure_sinkage": (PressureSinkage, "plates"),
    "shear": (Shear, "ring"),
    "cone": (Cone, "cone"),
}


@dataclass(frozen=True)
class NoResult:
    """Of an instrument that failed on this ground."""

    reason: str


@dataclass(frozen=True)
class SoilCard:
    """What a card holds. density [kg/m3]; stiffness: elastic, under a rigid plate [Pa/m]; gravity: of the tests,
    in which alone the values hold [m/s2]."""

    title: str
    ground: str
    density: float
    stiffness: float
    gravity: float
    pressure_sinkage: PressureSinkage | NoResult
    shear: Shear | NoResult
    cone: Cone | NoResult
    notes: tuple[str, ...] = ()

    def failures(self) -> dict[str, str]:
        """Instrument -> why it has no result."""
        parts = {instrument: getattr(self, name) for name, (_, instrument) in SECTIONS.items()}
        return {name: part.reason for name, part in parts.items() if isinstance(part, NoResult)}

    def bekker_and_shear(self) -> tuple[PressureSinkage, Shear]:
        """What vehicle codes need. @raises ResultsError where plates or ring failed"""
        plate, shear = self.pressure_sinkage, self.shear
        for part, (_, instrument) in zip((plate, shear), SECTIONS.values()):
            if isinstance(part, NoResult):
                raise ResultsError(
                    f"{self.title}: has no values of the {instrument} ({part.reason}); give them by hand"
                )
        assert isinstance(plate, PressureSinkage) and isinstance(shear, Shear)
        return plate, shear

    def index_text(self) -> list[str]:
        return [self.cone.mean_text()] if isinstance(self.cone, Cone) else []

    def condition(self) -> str:
        """Where the values hold, for a person and for the files of other codes."""
        return f"holds in a gravity of {self.gravity:g} m/s2 only"

    def doubts(self) -> list[str]:
        """What a vehicle code should know before it takes the values."""
        plate = self.pressure_sinkage
        if isinstance(plate, NoResult) or plate.k_c.value >= 0.0:
            return []
        width = -plate.k_c.value / plate.k_phi.value
        return [
            f"{self.title}: k_c is negative, so a contact of b = {width:.2g} m or less carries nothing; "
            f"the plates had {plate.radii.low:.3g} m or more"
        ]

    def parameters(self) -> dict[str, Fitted]:
        """Name -> value and standard error, of the instruments that have a result."""
        found = {}
        for part in (self.pressure_sinkage, self.shear, self.cone):
            for field in fields(part):
                value = getattr(part, field.name)
                if isinstance(value, Fitted):
                    found[field.name] = value
        return found

    def texts(self) -> dict[str, str]:
        """Name -> value and error for a person."""
        return {name: shown(fitted) for name, fitted in self.parameters().items()}

    def ranges(self) -> list[tuple[str, Range, str]]:
        """Meaning, range, unit."""
        plate, shear, cone = self.pressure_sinkage, self.shear, self.cone
        spans: list[tuple[str, Range, str]] = []
        if isinstance(plate, PressureSinkage):
            spans += [
                ("sinkage of the plates", plate.sinkage, "m"),
                ("pressure under the plates", plate.pressure, "Pa"),
                ("radius of the plates", plate.radii, "m"),
            ]
        if isinstance(shear, Shear):
            spans += [
                ("normal stress under the ring", shear.normal, "Pa"),
                ("shear displacement", shear.displacement, "m"),
            ]
        if isinstance(cone, Cone):
            spans.append((f"depth of the cone of {1e3 * cone.size:.4g} mm and {cone.angle:g}°", cone.depth, "m"))
        return spans

    def report(self) -> str:
        """Lines for a person."""
        lines = [self.title]
        for name, text in self.texts().items():
            lines.append(f"  {name:12} {text:>22} {UNITS[name]}")
        lines += [f"  {instrument}: no result, {why}" for instrument, why in self.failures().items()]
        for meaning, span, unit in self.ranges():
            lines.append(f"  {meaning:38} {span.low:.3g} to {span.high:.3g} {unit}")
        notes = [*self.index_text(), *self.notes]
        return "\n".join([*lines, f"  {self.condition()}", *(f"  note: {note}" for note in notes)])


def shown(fitted: Fitted) -> str:
    """Value and error, both to two digits of the error."""
    if not (fitted.error > 0 and math.isfinite(fitted.error)):
        return f"{fitted.value:.3g}"
    digits = 1 - math.floor(math.log10(fitted.error))
    return f"{round(fitted.value, digits):.7g} ± {round(fitted.error, digits):.7g}"


def markdown(cards: Sequence[SoilCard]) -> str:
    """A table of cards: value and error of each parameter, cards as rows."""
    names = [name for name in UNITS if name not in ("gradient", "speed_stress")]
    units = [f" [{UNITS[name]}]" if UNITS[name] else "" for name in names]
    lines = [
        "| ground | " + " | ".join(f"`{n}`{unit}" for n, unit in zip(names, units)) + " |",
        "|---" * (len(names) + 1) + "|",
    ]
    for card in cards:
        texts = card.texts()
        cells = [Path(card.ground).stem, *(texts.get(name, "none") for name in names)]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _as_yaml(part: Any) -> dict[str, Any]:
    if isinstance(part, NoResult):
        return {"failed": part.reason}
    content: dict[str, Any] = {}
    for field in fields(part):
        value = getattr(part, field.name)
        if isinstance(value, Fitted):
            content[field.name] = {"value": value.value, "error": value.error}
            if UNITS[field.name]:
                content[field.name]["unit"] = UNITS[field.name]
        elif isinstance(value, Range):
            content[field.name] = [value.low, value.high]
        else:
            content[field.name] = value
    return content


def write_card(card: SoilCard, path: Path) -> None:
    content = {
        "title": card.title,
        "ground": card.ground,
        "density": card.density,
        "stiffness": card.stiffness,
        "gravity": card.gravity,
        **{name: _as_yaml(getattr(card, name)) for name in SECTIONS},
        "notes": list(card.notes),
    }
    head = (
        "# Soil card, SI units and degrees, written by furrow-soil card. value and error: fit and\n"
        "# standard error. Lists of two numbers: range of the tests. inputs/soils/README.md\n"
        "# explains every key.\n"
    )
    text = yaml.safe_dump(content, sort_keys=False, default_flow_style=None, width=100)
    path.write_text(head + text, encoding="utf-8")


def read_card(path: Path | str) -> SoilCard:
    """@raises OSError; ResultsError where the file is no card"""
    path = Path(path)
    with content_of(path, REMEDY):
        try:
            content = yaml.safe_load(path.read_text(encoding="utf-8"))
        except yaml.YAMLError as error:
            raise ResultsError(f"{path}: is no YAML; {REMEDY}") from error
        if not isinstance(content, dict):
            raise ResultsError(f"{path}: has no keys; {REMEDY}")
        parts = {
            name: _read_part(path, kind, name, content[name]) for name, (kind, _) in SECTIONS.items()
        }
        return SoilCard(
            str(content["title"]),
            str(content["ground"]),
            float(content["density"]),
            float(content["stiffness"]),
            _gravity(path, content["gravity"]),
            **parts,
            notes=tuple(str(note) for note in content.get("notes", ())),
        )


def _gravity(path: Path, given: object) -> float:
    number = _finite(f"{path}: gravity", given)
    if number <= 0:
        raise ResultsError(f"{path}: gravity is {given}; allowed: a number > 0 [m/s2], 9.80665 on the Earth; {REMEDY}")
    return number


def _read_part(path: Path, kind: Any, section: str, content: dict[str, Any]) -> Any:
    if "failed" in content:
        return NoResult(str(content["failed"]))
    values: dict[str, Any] = {}
    for field in fields(kind):
        given = content[field.name]
        where = f"{path}: {section}.{field.name}"
        if field.type is Fitted:
            unit = given.get("unit", "")
            if unit != UNITS[field.name]:
                raise ResultsError(
                    f"{where} has the unit '{unit}'; allowed: '{UNITS[field.name]}'; {REMEDY}"
                )
            values[field.name] = Fitted(_finite(where, given["value"]), float(given["error"]))
        elif field.type is Range:
            low, high = (_finite(where, number) for number in given)
            values[field.name] = Range(low, high)
        else:
            values[field.name] = _finite(where, given)
    return kind(**values)


def _finite(where: str, value: object) -> float:
    number = float(str(value))
    if not math.isfinite(number):
        raise ResultsError(f"{where} is {value}, a finite number is needed; {REMEDY}")
    return number
