# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks before a test of the laboratory runs: grounds, variables and their values."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import furrow_post  # first: says which of the next ones are missing

import yaml

from furrow_post.errors import ResultsError
from furrow_post.run.script import check_variables, script_variables

HERE = Path(__file__).resolve().parent

SERIES = {  # test -> the variable of which several values make a series
    "oedometer": "seed",
    "triaxial": "confinement",
    "extension": "confinement",
    "plane_strain": "confinement",
    "unconfined": "seed",
    "tension": "seed",
    "shear": "confinement",
    "plate": "size",
    "repose": "seed",
    "collapse": "aspect",
}
RESERVED = {
    "results": "-o for the results folder",
    "ground": "--ground for the ground",
    "here": "the tests of the source tree",
}
MAY_VANISH = {"adhesion", "compaction", "damping", "face_friction", "friction", "pour_friction", "restitution", "rolling"}
# Beyond, a test has no end within days, or leaves what the quantity can be.
LIMITS = {  # variable -> lowest, highest, unit, reason
    "strain": (0.0, 3.0, "", "a cell keeps a twentieth of its height"),
    "rate": (1e-3, 100.0, "1/s", "slower tests take days, faster ones are impacts"),
    "speed": (1e-4, 10.0, "m/s", "slower tests take days, faster ones are impacts"),
    "density": (10.0, 8000.0, "kg/m3", "steel has 7850"),
    "friction": (0.0, 5.0, "", "a coefficient, neither degrees nor percent"),
    "rolling": (0.0, 5.0, "", "a coefficient, neither degrees nor percent"),
    "face_friction": (0.0, 5.0, "", "a coefficient, neither degrees nor percent"),
    "pour_friction": (0.0, 5.0, "", "a coefficient, neither degrees nor percent"),
    "pack_friction": (0.0, 5.0, "", "a coefficient, neither degrees nor percent"),
}
DENSITY_OF_ICE = 917.0  # kg/m3
FEWEST_GRAINS = 50  # a cell must be wider than the reach of its contacts
MOST_GRAINS = 5_000_000
LARGEST_START_FRACTION = 0.4  # of a cell, filled by grains at random places
# LIGGGHTS wants primes above this, and these are taken: parts/grains.lig
SMALLEST_SEED, TAKEN_SEEDS = 10000, (15485863, 15485867, 32452843, 32452867)


def grounds() -> list[str]:
    return sorted(path.stem for path in (HERE / "grounds").glob("*.lig"))


def require_ground(ground: str) -> None:
    """Requires the name of a known ground. @raises ResultsError"""
    if ground not in grounds():
        raise ResultsError(f"there is no ground '{ground}'; there are {', '.join(grounds())}")


def require_preparation(test: str, ground: str) -> None:
    """Clusters of sintered snow need a cell or a bed, not a box. @raises ResultsError"""
    if ground.startswith("snow_bonded") and test in ("repose", "collapse"):
        raise ResultsError(
            f"the test {test} has no sintered clusters: {ground} is for cells and plates; take "
            "--ground snow"
        )


def require_variables(test: str, ground: str, given: Sequence[tuple[str, str]]) -> None:
    """Checks that the scripts of a test read each variable, and that its value is in range. @raises ResultsError"""
    require_preparation(test, ground)
    script = HERE / f"{test}.lig"
    surroundings = {"here": str(HERE), "ground": ground}
    check_variables(script, given, RESERVED, surroundings)
    defaults = script_variables(script, surroundings).defaults
    for name, value in given:
        if is_number(defaults.get(name, "")):
            require_value(name, value)
    values = {**defaults, **dict(given)}
    require_loading(values)
    if test == "plate":
        require_size(values["size"], values)
    if ground.startswith("snow"):
        require_snow(values)


def require_loading(values: Mapping[str, str]) -> None:
    """Checks that an oedometer goes from its confinement to a larger stress. @raises ResultsError"""
    start, end = values.get("confinement", ""), values.get("stress", "")
    if is_number(start) and is_number(end) and float(end) <= float(start):
        raise ResultsError(
            f"variable stress: {end} Pa is not above the confinement at the start, {start} Pa"
        )


def require_snow(values: Mapping[str, str]) -> None:
    """Clusters are of ice and air. @raises ResultsError"""
    for name in ("density", "bulk"):
        text = values.get(name, "")
        if is_number(text) and float(text) > DENSITY_OF_ICE:
            raise ResultsError(
                f"variable {name}: {text} kg/m3 is denser than ice, {DENSITY_OF_ICE:g} kg/m3; snow "
                "has 50 to 600"
            )


def require_size(text: str, values: Mapping[str, str]) -> None:
    """Checks that a plate is narrower than its bed. @raises ResultsError"""
    width = values.get("width", "")
    if is_number(width) and float(text) >= float(width):
        raise ResultsError(
            f"variable size: a plate of {text} m is no smaller than its bed, {width} m wide; give "
            "both in m, and a width of three sizes or more"
        )


def is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def require_value(name: str, text: str) -> None:
    """Checks a variable that is a number. @raises ResultsError outside of its range"""
    if not is_number(text):
        raise ResultsError(f"variable {name}: '{text}' is not a number")
    value = float(text)
    if value < 0 or (value == 0 and name not in MAY_VANISH):
        least = "0 or more" if name in MAY_VANISH else "above 0"
        raise ResultsError(f"variable {name}: {text} is not {least}")
    if name in LIMITS and not LIMITS[name][0] <= value <= LIMITS[name][1]:
        lowest, highest, unit, reason = LIMITS[name]
        raise ResultsError(
            f"variable {name}: {text} is outside of {lowest:g} to {highest:g} {unit}".rstrip()
            + f"; {reason}"
        )
    if name == "grains" and (value < FEWEST_GRAINS or value != int(value)):
        raise ResultsError(
            f"variable grains: {text} is not a whole number from {FEWEST_GRAINS} on; fewer make a "
            "cell narrower than its contacts reach"
        )
    if name == "grains" and value > MOST_GRAINS:
        raise ResultsError(
            f"variable grains: {text} is above {MOST_GRAINS}, some gigabytes of memory; a cell of "
            "some thousands has the properties of a large one"
        )
    if name == "start_fraction" and value > LARGEST_START_FRACTION:
        raise ResultsError(
            f"variable start_fraction: {text} is above {LARGEST_START_FRACTION}; grains that are "
            "put at random places must not overlap"
        )
    if name == "seed" and not is_seed(value):
        raise ResultsError(
            f"variable seed: {text} is no prime above {SMALLEST_SEED}, or one of those in "
            "parts/grains.lig; take e.g. 86028121, 67867967, 49979687"
        )


def is_seed(value: float) -> bool:
    number = int(value)
    if value != number or number <= SMALLEST_SEED or number in TAKEN_SEEDS or number >= 2**31:
        return False
    return all(number % divisor for divisor in range(2, math.isqrt(number) + 1))


def require_law(material: Path) -> None:
    """@raises ResultsError for a file without the sections of a law"""
    try:
        content = yaml.safe_load(material.read_text(encoding="utf-8"))
    except (OSError, ValueError, yaml.YAMLError) as error:
        raise ResultsError(
            f"--continuum {material}: is no YAML; name a material of inputs/materials"
        ) from error
    if not isinstance(content, dict) or not ("law" in content or "base" in content):
        raise ResultsError(
            f"--continuum {material}: has neither 'law' nor 'base'; name a file of inputs/materials"
        )


def require_series(test: str, values: Sequence[str], ground: str, given: Mapping[str, str]) -> None:
    """Values of --series. @raises ResultsError for one that is empty, twice or out of range"""
    name = SERIES[test]
    if name in given:
        raise ResultsError(f"{name} is given by -v and by --series; give it once")
    for value in values:
        if not value.strip():
            raise ResultsError(f"--series has an empty value of {name}; separate values by commas")
        require_value(name, value)
    if test == "plate":
        surroundings = {"here": str(HERE), "ground": ground}
        known = {**script_variables(HERE / "plate.lig", surroundings).defaults, **given}
        for value in values:
            require_size(value, known)
    if len({float(value) for value in values}) < len(values):
        raise ResultsError(f"--series has a value of {name} twice; give each once")
