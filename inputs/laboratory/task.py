# SPDX-License-Identifier: GPL-2.0-or-later
"""The input of calibrate.py: read, and refused with key and remedy where it cannot be run."""

import argparse
import difflib
import json
import math
from pathlib import Path
from typing import Any

from checks import HERE, SERIES, require_ground, require_value, require_variables

from furrow_post.arguments import fraction
from furrow_post.errors import ResultsError
from furrow_post.json_text import parse_json
from furrow_post.read.laboratory import read_oedometer_reference

Task = dict[str, Any]

NEEDED = ("ground", "parameters", "seeds")
FURTHER = ("title", "variables", "iterations", "tests")
TARGET = ("reference", "lowest", "highest", "deviation", "quantities")
OF_TEST = ("test", "variables", "series", *TARGET)
FORM = (
    'a calibration is a JSON object with "test", "ground", "parameters" {name: [start, lower, '
    'upper]}, "seeds" [...] and "reference" with "lowest" and "highest", or "quantities" {name: '
    '[value, deviation]}; for several tests "tests" [...] with "test" and target of each; see '
    "calibrations/snow.json and snow_bonded_slab.json"
)


def read_task(path: Path) -> Task:
    """With "tests", a list of one or more, each with all its "variables".

    @raises ResultsError; OSError without the file
    """
    try:
        task = parse_json(path.read_text(encoding="utf-8"), object_pairs_hook=_without_repetition)
    except (ValueError, ResultsError) as error:
        raise ResultsError(f"{path}: is no JSON ({error}); {FORM}") from error
    try:
        _check_keys(task)
        common = _object(task, "variables")
        tests = task.get("tests", [{key: task[key] for key in OF_TEST if key in task}])
        task["tests"] = [
            {**test, "variables": {**common, **_object(test, "variables")}} for test in tests
        ]
        _check(task)
    except ResultsError as error:
        raise ResultsError(f"{path}: {error}") from error
    return dict(task)


def _without_repetition(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    names = [name for name, _ in pairs]
    for name in names:
        if names.count(name) > 1:
            raise ResultsError(f"the key '{name}' stands there {names.count(name)} times")
    return dict(pairs)


def _check_keys(task: Any) -> None:
    """Of the whole and of each of its tests. @raises ResultsError"""
    if not isinstance(task, dict):
        raise ResultsError(f"is no object; {FORM}")
    _refuse_unknown(task, (*NEEDED, *FURTHER, *OF_TEST))
    for key in NEEDED:
        if not task.get(key):
            raise ResultsError(f"'{key}' is missing or empty; {FORM}")
    if "tests" not in task:
        if not task.get("test"):
            raise ResultsError(f"'test' is missing or empty; {FORM}")
        return
    for key in ("test", "series", *TARGET):
        if key in task:
            raise ResultsError(f"'{key}' stands beside 'tests'; write it for each of them")
    tests = task["tests"]
    if not isinstance(tests, list) or not tests or not all(isinstance(t, dict) for t in tests):
        raise ResultsError(f"'tests' is {_shown(tests)}, a list of objects is needed; {FORM}")
    for test in tests:
        _refuse_unknown(test, OF_TEST)
        if not test.get("test"):
            raise ResultsError(f"'test' is missing or empty in one of 'tests'; {FORM}")


def _refuse_unknown(task: Task, known: tuple[str, ...]) -> None:
    for key in task:
        if key not in known:
            near = difflib.get_close_matches(key, known, n=1)
            hint = f"did you mean '{near[0]}'?" if near else FORM
            raise ResultsError(f"there is no key '{key}'; {hint}")


def _check(task: Task) -> None:
    """@raises ResultsError"""
    if not isinstance(task["ground"], str):
        raise ResultsError(f"'ground' is {_shown(task['ground'])}, the name of a ground is needed")
    for test in task["tests"]:
        if test["test"] not in list(SERIES):
            raise ResultsError(f"'test' is {_shown(test['test'])}; tests are {', '.join(SERIES)}")
    require_ground(task["ground"])
    _check_parameters(task)
    for test in task["tests"]:
        _check_variables(task, test)
        _check_target(test)
    _check_seeds(task)
    iterations = task.get("iterations", 1)
    if not isinstance(iterations, int) or isinstance(iterations, bool) or iterations < 1:
        raise ResultsError(f"'iterations' is {_shown(iterations)}, a whole number from 1 is needed")


def _check_parameters(task: Task) -> None:
    parameters = _object(task, "parameters")
    for name, values in parameters.items():
        if not (_is_numbers(values, 3) and 0 < values[1] < values[2]):
            raise ResultsError(
                f"parameter '{name}' is {_shown(values)}; [start, lower, upper] with 0 < lower < "
                "upper is needed"
            )
        if not values[1] <= values[0] <= values[2]:
            raise ResultsError(
                f"parameter '{name}' starts at {values[0]:g}, outside of {values[1]:g} to "
                f"{values[2]:g}"
            )
        if name == "seed":
            raise ResultsError("parameter 'seed': seeds stand in 'seeds'")
        if any(name in test["variables"] for test in task["tests"]):
            raise ResultsError(f"'{name}' is a parameter and a variable; give it once")


def _check_variables(task: Task, test: Task) -> None:
    """Variables, parameters and series with what the test's scripts read."""
    values = {name: str(value) for name, value in test["variables"].items()}
    series = test.get("series", [])
    name = SERIES[test["test"]]
    if series and name != "confinement":
        raise ResultsError(f"'series' is of confinements; the test {test['test']} has none")
    if not isinstance(series, list) or not all(_is_number(value) for value in series):
        raise ResultsError(f"'series' is {_shown(series)}, a list of confinements [Pa] is needed")
    for value in series:
        require_value(name, str(value))
    if "seed" in values:
        raise ResultsError("variable 'seed': seeds stand in 'seeds'")
    starts = {name: str(value[0]) for name, value in task["parameters"].items()}
    require_variables(test["test"], task["ground"], list({**values, **starts}.items()))


def _check_seeds(task: Task) -> None:
    seeds = task["seeds"]
    if not isinstance(seeds, list) or not all(isinstance(seed, int) for seed in seeds):
        raise ResultsError(f"'seeds' is {_shown(seeds)}, a list of whole numbers is needed")
    for seed in seeds:
        require_value("seed", str(seed))
    if len(set(seeds)) < len(seeds):
        raise ResultsError("'seeds' has a seed twice: its packings would not scatter")


def _check_target(test: Task) -> None:
    if ("reference" in test) == ("quantities" in test):
        raise ResultsError(f"one of 'reference' and 'quantities' is needed; {FORM}")
    if "quantities" in test:
        for name, values in _object(test, "quantities").items():
            if not _is_quantity(values):
                raise ResultsError(
                    f"quantity '{name}' is {_shown(values)}; [value, deviation] with a deviation "
                    "above 0 is needed, or [value, \"30%\"] with a value above 0"
                )
        if not test["quantities"]:
            raise ResultsError("'quantities' is empty; name at least one with [value, deviation]")
        return
    limits: list[Any] = [test.get("lowest"), test.get("highest")]
    if not (_is_numbers(limits, 2) and 0 < limits[0] < limits[1]):
        raise ResultsError(
            f"'lowest' and 'highest' are {_shown(limits[0])} and {_shown(limits[1])}; stresses "
            "[Pa] with 0 < lowest < highest are needed"
        )
    deviation = test.get("deviation", 1)
    if not _is_number(deviation) or deviation <= 0:
        raise ResultsError(
            f"'deviation' is {_shown(deviation)}; one of the stresses' logarithms, above 0, is needed"
        )
    if test["test"] != "oedometer":
        raise ResultsError("'reference' is of an oedometer; other tests have 'quantities'")
    file = HERE / str(test["reference"])
    if not file.is_file():
        raise ResultsError(f"'reference': {file} is no file; the path is relative to {HERE}")
    rows = read_oedometer_reference(file)
    if not any(limits[0] <= stress <= limits[1] for _, stress in rows):
        raise ResultsError(
            f"'reference': {file} has no row with a stress of {limits[0]:g} to {limits[1]:g} Pa"
        )


def _object(task: Task, key: str) -> dict[str, Any]:
    value = task.get(key, {})
    if not isinstance(value, dict):
        raise ResultsError(f"'{key}' is {_shown(value)}, an object {{name: ...}} is needed")
    return value


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _is_numbers(value: Any, count: int) -> bool:
    return isinstance(value, list) and len(value) == count and all(map(_is_number, value))


def _is_quantity(values: Any) -> bool:
    """[value, deviation], or [value above 0, "30%"]"""
    if _is_numbers(values, 2):
        return bool(values[1] > 0)
    if not (isinstance(values, list) and len(values) == 2 and isinstance(values[1], str)):
        return False
    try:
        fraction(values[1])
    except argparse.ArgumentTypeError:
        return False
    return values[1].endswith("%") and _is_number(values[0]) and values[0] > 0


def _shown(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) < 60 else text[:57] + "..."
