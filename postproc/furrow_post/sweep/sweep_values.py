# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of the option --sweep: "slip=-0.3:0.6:10", "material=a.yaml,b.yaml"."""

import hashlib
import itertools
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ..errors import ResultsError

HOW = "write NAME=FIRST:LAST:COUNT, or NAME=VALUE,VALUE,..."
MOST_POINTS = 10000
UNSAFE = re.compile(r"[^A-Za-z0-9.+-]+")  # in the name of a folder


@dataclass(frozen=True)
class Variable:
    """A variable of a script with the values that it takes, as LIGGGHTS gets them."""

    name: str
    values: tuple[str, ...]


def parse_variable(text: str) -> Variable:
    """Values of NAME=FIRST:LAST:COUNT, both ends included, or NAME=VALUE,VALUE,... @raises ResultsError"""
    name, equals, values = (part.strip() for part in text.partition("="))
    if not equals or not name:
        raise ResultsError(f"--sweep '{text}' has no {'name' if equals else '='}; {HOW}")
    if not values:
        raise ResultsError(f"--sweep {name} has no values; {HOW}")
    fields = values.split(":")
    is_range = number_of(fields[0]) is not None or re.fullmatch(r"[^/:]+:[^/:]+:\s*\d+\s*", values)
    if len(fields) > 1 and "," not in values and is_range:
        return Variable(name, tuple(_range(name, values, fields)))
    listed = [value.strip() for value in values.split(",")]
    if not all(listed):
        raise ResultsError(f"--sweep {name}: '{values}' has an empty value; {HOW}")
    for value in listed:
        if value.lower().lstrip("+-") in ("nan", "inf", "infinity"):
            raise ResultsError(f"--sweep {name}: {value} is no finite number; {HOW}")
    twice = [value for value in listed if listed.count(value) > 1]
    if twice:
        raise ResultsError(f"--sweep {name} has {twice[0]} twice; give each value once")
    return Variable(name, tuple(listed))


def number_of(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _range(name: str, text: str, fields: Sequence[str]) -> Iterator[str]:
    """Values of a range FIRST:LAST:COUNT. @raises ResultsError"""
    ends = [number_of(field) for field in fields[:2]]
    if len(fields) != 3 or None in ends:
        raise ResultsError(f"--sweep {name}: '{text}' is no range FIRST:LAST:COUNT; {HOW}")
    first, last = (end for end in ends if end is not None)
    if not re.fullmatch(r"\+?\d+", fields[2].strip()) or int(fields[2]) < 2:
        raise ResultsError(
            f"--sweep {name}: {fields[2]} is no number of points, which are at least 2; "
            "FIRST:LAST:COUNT has the number of points, not the step"
        )
    count = int(fields[2])
    if first == last:
        raise ResultsError(f"--sweep {name}: the range {text} begins and ends at {first:g}")
    if count > MOST_POINTS:
        raise ResultsError(f"--sweep {name}: {count} points; at most {MOST_POINTS}")
    step = (last - first) / (count - 1)
    for k in range(count):
        value = first + k * step
        yield f"{0.0 if abs(value) < 1e-9 * abs(step) else value:.10g}"


def parse_variables(texts: Sequence[str]) -> tuple[Variable, ...]:
    """Variables of --sweep with their values. @raises ResultsError, also for a variable that is given twice or too many points"""
    variables = tuple(map(parse_variable, texts))
    require_once([variable.name for variable in variables])
    points = math.prod(len(variable.values) for variable in variables)
    if points > MOST_POINTS:
        raise ResultsError(f"--sweep asks for {points} points; at most {MOST_POINTS}")
    return variables


def require_once(names: Sequence[str]) -> None:
    for name in names:
        if names.count(name) > 1:
            raise ResultsError(f"--sweep {name} is given {names.count(name)} times; give it once")


def product(variables: Sequence[Variable]) -> list[dict[str, str]]:
    """Name -> value of each point; the last variable changes fastest."""
    names = [variable.name for variable in variables]
    combinations = itertools.product(*(variable.values for variable in variables))
    return [dict(zip(names, values)) for values in combinations]


def folder_name(values: Mapping[str, str]) -> str:
    """ "slip_0.1_load_200"; of a value that no name can have, as much as it can and a digest."""
    return "_".join(f"{name}_{_safe(value)}" for name, value in values.items())


def _safe(value: str) -> str:
    safe = UNSAFE.sub("-", value).strip("-.") if UNSAFE.search(value) else value
    if safe == value and safe not in (".", ".."):
        return safe
    return f"{safe[-40:]}-{hashlib.sha256(value.encode()).hexdigest()[:6]}"


def further_seeds(first: int, count: int) -> list[int]:
    """The next primes: seeds of LIGGGHTS are prime numbers."""
    return list(itertools.islice(filter(_is_prime, itertools.count(first + 1)), count))


def _is_prime(n: int) -> bool:
    return n > 1 and all(n % divisor for divisor in range(2, math.isqrt(n) + 1))
