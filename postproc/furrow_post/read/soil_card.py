# SPDX-License-Identifier: GPL-2.0-or-later
"""A soil card: parameters of vehicle codes with standard errors and the range where they hold.

A card that a person writes may have the values alone, in other units too. The terrain file of Chrono's SCM is
a card as well. The fields of the classes below are the keys of the file; their metadata have units and meanings.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import yaml

from ..arrays import Floats
from ..csv_table import markdown as markdown_table
from ..errors import ResultsError, content_of
from ..json_text import parse_json

REMEDY = "write it with furrow-post card make"
SCALES = {"": 1.0, "k": 1e3, "M": 1e6}  # factors of the prefixes of a unit
OTHER_UNITS = {  # unit of a parameter -> others, and their size
    "degree": {"degrees": 1.0, "deg": 1.0, "°": 1.0, "rad": math.degrees(1)},
    "m": {"cm": 1e-2, "mm": 1e-3, "in": 0.0254},
    "Pa": {"psi": 6894.757, "bar": 1e5, "kN/m^2": 1e3},
}
STIFFNESS = 1e8  # [Pa/m] of a card that has none, as of fix terrain/scm
CHRONO = {  # key of Chrono's "Soil parameters" -> name
    "Bekker Kphi": "k_phi",
    "Bekker Kc": "k_c",
    "Bekker n exponent": "n",
    "Mohr cohesive limit": "c",
    "Mohr friction limit": "phi",
    "Janosi shear coefficient": "K",
    "Elastic stiffness": "stiffness",
    "Damping": "damping",
}
EARTH = 9.80665  # [m/s2]
RFT_PLATE = 0.875  # stress under a level plate over strength and depth, resistive force theory [Agarwal2023]
SMALLEST_K = 5e-4  # least K of a soil [m]
INDEX_DEPTH = 0.15  # [m] over which a cone index is a mean, ASABE EP542
REACHED = 0.98  # least depth of the tests over INDEX_DEPTH
STANDARD_CONE = 0.02027  # [m] base of 323 mm2, ASABE S313.3


@dataclass(frozen=True)
class Fitted:
    """A parameter with its standard error."""

    value: float
    error: float


@dataclass(frozen=True)
class Range:
    """Range of a variable in the tests."""

    low: float
    high: float


@dataclass(frozen=True)
class PressureSinkage:
    """p = (k_c/b + k_phi) z^n of M. G. Bekker (1969); b is the radius of a round plate."""

    instrument: ClassVar[str] = "plates"
    k_c: Fitted = field(metadata={"unit": "N/m^(n+1)"})
    k_phi: Fitted = field(metadata={"unit": "N/m^(n+2)"})
    n: Fitted = field(metadata={"unit": ""})
    sinkage: Range = field(metadata={"meaning": "sinkage of the plates", "unit": "m"})
    pressure: Range = field(metadata={"meaning": "pressure under the plates", "unit": "Pa"})
    radii: Range = field(metadata={"meaning": "radius of the plates", "unit": "m"})
    residual: float  # rms, over the greatest pressure of each plate

    def at(self, sinkage: Floats, radius: float) -> Floats:
        modulus = self.k_c.value / radius + self.k_phi.value
        pressure: Floats = modulus * np.asarray(sinkage) ** self.n.value
        return pressure

    def rft_strength(self, sinkage: float, radius: float) -> tuple[float, float]:
        """xi of contact/rft [N/m^3], of the line through zero with the least squared deviation from the curve down to
        this sinkage (theory: rft, eq. 6), and the rms of that deviation over the greatest pressure."""
        n = self.n.value
        top = float(self.at(np.array(sinkage), radius))
        slope = 3 * top / (sinkage * (n + 2))
        return slope / RFT_PLATE, abs(n - 1) / (n + 2) / math.sqrt(2 * n + 1)


def mobilised_share(displacement: Floats, length: float) -> Floats:
    """Shear stress over strength after a shear displacement j: 1 - exp(-j/K) of Z. Janosi and B. Hanamoto (1961)."""
    share: Floats = 1 - np.exp(-displacement / length)
    return share


@dataclass(frozen=True)
class Shear:
    """tau = (c + sigma tan phi)(1 - exp(-j/K)), with the mobilised_share()."""

    instrument: ClassVar[str] = "ring"
    c: Fitted = field(metadata={"unit": "Pa"})
    phi: Fitted = field(metadata={"unit": "degree"})
    K: Fitted = field(metadata={"unit": "m"})
    speed_stress: Fitted = field(metadata={"unit": "Pa"})  # of the grid at the speed of the ring; a part of the fit
    normal: Range = field(metadata={"meaning": "normal stress under the ring", "unit": "Pa"})
    displacement: Range = field(metadata={"meaning": "shear displacement", "unit": "m"})
    residual: float  # rms, over the greatest shear stress

    def at(self, displacement: Floats, normal: Floats) -> Floats:
        strength = self.c.value + normal * math.tan(math.radians(self.phi.value))
        stress: Floats = strength * mobilised_share(displacement, self.K.value)
        return stress


@dataclass(frozen=True)
class Cone:
    """Cone index: mean pressure on the base of a cone. Another size has another index."""

    instrument: ClassVar[str] = "cone"
    index: Fitted = field(metadata={"unit": "Pa"})  # mean over `depth`
    gradient: Fitted = field(metadata={"unit": "Pa/m"})  # of the pressure over depth
    depth: Range = field(metadata={"meaning": "depth of the cone of {0.size_mm:.4g} mm and {0.angle:g}°", "unit": "m"})
    size: float  # diameter of the base [m]
    angle: float  # of the tip [degrees]

    @property
    def size_mm(self) -> float:
        return 1e3 * self.size

    @property
    def spread(self) -> float:
        """Standard deviation of the pressure over the depth [Pa]: of a straight line."""
        return abs(self.gradient.value) * (self.depth.high - self.depth.low) / math.sqrt(12)

    def mean_text(self) -> str:
        """Depth over which the index is a mean, with the spread; and where formulas cannot take it."""
        depth = f"0 to {1e3 * self.depth.high:.0f} mm"
        text = f"cone index: mean over {depth}, spread over the depth {self.spread:.2g} Pa"
        if self.size == STANDARD_CONE and self.depth.high < REACHED * INDEX_DEPTH:
            text += f"; formulas need the mean over 0 to {1e3 * INDEX_DEPTH:.0f} mm: push the cone deeper"
        return text


SECTIONS: dict[str, Any] = {"pressure_sinkage": PressureSinkage, "shear": Shear, "cone": Cone}
PARAMETERS = [one for part in SECTIONS.values() for one in fields(part) if one.type is Fitted]
UNITS = {one.name: str(one.metadata["unit"]) for one in PARAMETERS}


@dataclass(frozen=True)
class NoResult:
    """Reason why an instrument failed on this ground."""

    reason: str


@dataclass(frozen=True)
class SoilCard:
    """Content of a card. density [kg/m3]; stiffness: elastic, under a rigid plate [Pa/m]; gravity: of the tests,
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
    c1: float = math.nan  # place of the greatest stress under a wheel, (c1 + c2 slip) of the entry angle
    c2: float = math.nan
    contact: Mapping[str, Any] | None = None  # with steel and rubber, as a material file has it

    @property
    def parts(self) -> dict[str, PressureSinkage | Shear | Cone | NoResult]:
        """Results of the card by section."""
        return {name: getattr(self, name) for name in SECTIONS}

    def failures(self) -> dict[str, str]:
        """Instrument -> why it has no result."""
        parts = self.parts.items()
        return {SECTIONS[name].instrument: part.reason for name, part in parts if isinstance(part, NoResult)}

    def bekker_and_shear(self) -> tuple[PressureSinkage, Shear]:
        """Pressure-sinkage and shear, which vehicle codes need. @raises ResultsError where plates or ring failed"""
        plate, shear = self.pressure_sinkage, self.shear
        for instrument, reason in self.failures().items():
            if instrument != Cone.instrument:
                raise ResultsError(f"{self.title}: has no values of the {instrument} ({reason}); give them by hand")
        assert isinstance(plate, PressureSinkage) and isinstance(shear, Shear)
        return plate, shear

    def index_text(self) -> list[str]:
        return [self.cone.mean_text()] if isinstance(self.cone, Cone) else []

    def require_usable(self) -> None:
        """@raises ResultsError for a parameter that the tests of the card do not determine"""
        shear = self.shear
        if isinstance(shear, Shear) and shear.K.value < SMALLEST_K:
            raise ResultsError(
                f"{self.title}: K is {1e3 * shear.K.value:.2g} mm, that of a law which mobilises its strength at once; "
                f"soils have 5 to 25 mm. A shear ring on grains determines it ('furrow-post card make GROUND.lig'), or a "
                f"shear test of the soil: give it as --K"
            )

    def condition(self) -> str:
        """Text of the range of validity, for the reader and for files of other codes."""
        return f"holds in a gravity of {self.gravity:g} m/s2 only"

    def warnings(self) -> list[str]:
        """Warnings to read before a vehicle code takes the values."""
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
        found = {one.name: getattr(part, one.name) for part in self.parts.values() for one in fields(part)}
        return {name: value for name, value in found.items() if isinstance(value, Fitted)}

    def texts(self) -> dict[str, str]:
        """Parameter -> text of value and error."""
        return {name: shown(fitted) for name, fitted in self.parameters().items()}

    def ranges(self) -> list[tuple[str, Range, str]]:
        """Meaning, range and unit of the tested variables."""
        found = [
            (str(one.metadata["meaning"]).format(part), getattr(part, one.name), str(one.metadata["unit"]))
            for part in self.parts.values()
            for one in fields(part)
            if one.type is Range
        ]
        return [one for one in found if math.isfinite(one[1].high)]

    def report(self) -> str:
        """Lines of the printed report."""
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
    head = ["ground", *(f"`{name}`" + (f" [{UNITS[name]}]" if UNITS[name] else "") for name in names)]
    rows = [[Path(card.ground).stem, *(card.texts().get(name, "none") for name in names)] for card in cards]
    return "\n".join(markdown_table(head, rows))


def _as_yaml(part: Any) -> dict[str, Any]:
    """Section of a part; unknown numbers are left out."""
    if isinstance(part, NoResult):
        return {"failed": part.reason}
    content: dict[str, Any] = {}
    for one in fields(part):
        value = getattr(part, one.name)
        if isinstance(value, Fitted):
            known = {"error": value.error} if math.isfinite(value.error) else {}
            unit = {"unit": UNITS[one.name]} if UNITS[one.name] else {}
            content[one.name] = {"value": value.value, **known, **unit}
        elif math.isfinite(value.high if isinstance(value, Range) else value):
            content[one.name] = [value.low, value.high] if isinstance(value, Range) else value
    return content


def write_card(card: SoilCard, path: Path) -> None:
    head = ("title", "ground", "density", "stiffness", "gravity")
    content: dict[str, Any] = {name: getattr(card, name) for name in head}
    content |= {name: _as_yaml(part) for name, part in card.parts.items()} | {"notes": list(card.notes)}
    content |= {"contact": dict(card.contact)} if card.contact else {}
    comment = (
        "# Soil card, SI units and degrees, written by furrow-post card make. value and error: fit and\n"
        "# standard error. Lists of two numbers: range of the tests. inputs/soils/README.md\n"
        "# explains every key.\n"
    )
    text = yaml.safe_dump(content, sort_keys=False, default_flow_style=None, width=100)
    path.write_text(comment + text, encoding="utf-8")


def read_card(path: Path | str) -> SoilCard:
    """@raises OSError; ResultsError where the file is no card"""
    path = Path(path)
    with content_of(path, REMEDY):
        text = path.read_text(encoding="utf-8-sig")
        try:
            content = _of_chrono(path, text) if path.suffix == ".json" else yaml.safe_load(text)
        except yaml.YAMLError as error:
            raise ResultsError(f"{path}: is no YAML; {REMEDY}") from error
        if not isinstance(content, dict):
            raise ResultsError(f"{path}: has no keys; {REMEDY}")
        parts = {name: _read_part(path, kind, name, content.get(name)) for name, kind in SECTIONS.items()}
        _refuse_others(path, "the card", content, [*(one.name for one in fields(SoilCard)), "damping"])
        numbers: dict[str, Any] = {"density": math.nan, "stiffness": STIFFNESS, "c1": math.nan, "c2": math.nan}
        given = [name for name in numbers if name in content]
        numbers |= {name: _finite(f"{path}: {name}", content[name]) for name in (*given, "gravity")}
        if numbers["gravity"] <= 0:
            raise ResultsError(
                f"{path}: gravity is {content['gravity']}; allowed: a number > 0 [m/s2], 9.80665 on the Earth; {REMEDY}"
            )
        return SoilCard(
            str(content.get("title", path.stem)),
            str(content.get("ground", "")),
            **numbers,
            **parts,
            notes=tuple(str(note) for note in content.get("notes", ())),
            contact=contact_of(path, content),
        )


def _refuse_others(path: Path, where: str, content: dict[str, Any], known: Sequence[str]) -> None:
    others = [str(key) for key in content if key not in known]
    if others:
        raise ResultsError(
            f"{path}: {where} has the key '{others[0]}', which no program of Furrow uses; allowed: {', '.join(known)}"
        )


def _of_chrono(path: Path, text: str) -> dict[str, Any]:
    """Content of a card from the terrain file of Chrono's co-simulation, whose comments are no JSON."""
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("//")]
    try:
        content = parse_json("\n".join(lines))
    except ValueError as error:
        raise ResultsError(f"{path}: is no JSON: {error}") from error
    soil = content.get("Soil parameters") if isinstance(content, dict) else None
    if not isinstance(soil, dict):
        raise ResultsError(f"{path}: has no \"Soil parameters\"; allowed: a terrain file of Chrono's SCM, or a card in YAML")
    _refuse_others(path, '"Soil parameters"', soil, list(CHRONO))
    lacking = [key for key, name in CHRONO.items() if key not in soil and name in UNITS]
    if lacking:
        raise ResultsError(f"{path}: \"Soil parameters\" have no \"{lacking[0]}\"")
    values = {CHRONO[key]: _finite(f"{path}: {key}", value) for key, value in soil.items()}
    found = {
        name: {one.name: values.pop(one.name) for one in fields(kind) if one.name in values}
        for name, kind in SECTIONS.items()
    }
    notes = ["of Chrono, which states no gravity: that of the Earth"]
    return {**values, **{name: part for name, part in found.items() if part}, "gravity": EARTH, "notes": notes}


def contact_of(path: Path, content: Mapping[str, Any]) -> dict[str, Any] | None:
    """Section `contact` of a card or material file, which may name a file. @raises ResultsError where that is absent"""
    contact: dict[str, Any] | str | None = content.get("contact")
    if not isinstance(contact, str):
        return contact
    file = path.parent / contact
    if not file.is_file():
        raise ResultsError(
            f"{path}: contact names the file {file}, which is not there; copy it along with this one, or remove the line"
        )
    found: dict[str, Any] = yaml.safe_load(file.read_text(encoding="utf-8"))
    return found


def _read_part(path: Path, kind: Any, section: str, content: dict[str, Any] | None) -> Any:
    """Part of a card from its section. Errors, ranges and residuals that a person leaves out are unknown."""
    if content is None and kind is Cone:
        return NoResult("the card has none")
    if not isinstance(content, dict):
        raise ResultsError(f"{path}: has no '{section}'; {REMEDY}")
    if "failed" in content:
        return NoResult(str(content["failed"]))
    _refuse_others(path, section, content, [one.name for one in fields(kind)])
    given: dict[str, Any] = {**content, "speed_stress": content.get("speed_stress") or 0.0}
    values: dict[str, Any] = {}
    for one in fields(kind):
        where, value = f"{path}: {section}.{one.name}", given.get(one.name)
        if one.type is Fitted:
            if value is None:
                raise ResultsError(f"{where} is missing; {REMEDY}")
            values[one.name] = _fitted(where, UNITS[one.name], value if isinstance(value, dict) else {"value": value})
        elif one.type is Range:
            values[one.name] = _range(where, value) if value else Range(0.0, math.inf)
        else:
            values[one.name] = math.nan if value is None and kind is not Cone else _finite(where, value)
    return kind(**values)


def _range(where: str, value: Any) -> Range:
    low, high = value
    return Range(_finite(where, low), _finite(where, high))


def _fitted(where: str, unit: str, given: dict[str, Any]) -> Fitted:
    """Value and error in the unit of the parameter."""
    known = {prefix + unit: scale for prefix, scale in SCALES.items()} if unit[:1] in ("N", "P") else {unit: 1.0}
    known |= OTHER_UNITS.get(unit, {})
    of = str(given.get("unit", unit))
    if of not in known:
        raise ResultsError(f"{where} has the unit '{of}'; allowed: {', '.join(map(repr, known))}; {REMEDY}")
    return Fitted(known[of] * _finite(where, given["value"]), known[of] * float(given.get("error", math.nan)))


def _finite(where: str, value: object) -> float:
    number = float(str(value))
    if not math.isfinite(number):
        raise ResultsError(f"{where} is {value}, a finite number is needed; {REMEDY}")
    return number
