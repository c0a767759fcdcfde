# SPDX-License-Identifier: GPL-2.0-or-later
"""The input of calibrate.py: read by calibration.schema.yaml, and refused with key, form and remedy."""

import difflib
import json
from pathlib import Path
from typing import Any

import furrow_post  # first: reports which of the next ones are missing

import jsonschema
import yaml
from checks import HERE, SERIES, require_ground, require_value, require_variables

from furrow_post.errors import ResultsError
from furrow_post.json_text import parse_json
from furrow_post.read.laboratory import read_oedometer_reference

Task = dict[str, Any]

SCHEMA: Task = yaml.safe_load((HERE / "calibration.schema.yaml").read_text(encoding="utf-8"))
OF_TEST = tuple(SCHEMA["$defs"]["of_test"])


def read_task(path: Path) -> Task:
    """Reads a calibration with one or more "tests", each with all its "variables". @raises ResultsError; OSError without the file"""
    form = f"a calibration is {SCHEMA['description']}"
    try:
        task = parse_json(path.read_text(encoding="utf-8"), object_pairs_hook=_without_repetition)
    except (ValueError, ResultsError) as error:
        raise ResultsError(f"{path}: is no JSON ({error}); {form}") from error
    found = jsonschema.Draft202012Validator(SCHEMA).iter_errors(task)
    if first := min(found, key=lambda error: (len(error.path) == 0, error.validator == "oneOf"), default=None):
        raise ResultsError(f"{path}: {_fault(first)}")
    common = task.get("variables", {})
    tests = task.get("tests", [{key: task[key] for key in OF_TEST if key in task}])
    task["tests"] = [{**test, "variables": {**common, **test.get("variables", {})}} for test in tests]
    try:
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


def _fault(error: Any) -> str:
    """Text of the fault of a value in the file, with the requirement."""
    while error.context and len(error.context[-1].path) > 0:  # of a value below
        error = error.context[-1]
    schema, key = error.schema, ".".join(str(part) for part in error.absolute_path)
    if error.validator == "additionalProperties" and isinstance(error.instance, dict) and "properties" in schema:
        unknown = next(name for name in error.instance if name not in schema["properties"])
        near = difflib.get_close_matches(unknown, schema["properties"], n=1)
        hint = f"did you mean '{near[0]}'?" if near else f"allowed are {', '.join(schema['properties'])}"
        return f"there is no key '{unknown}'{f' in {key}' if key else ''}; {hint}"
    if error.validator == "required":
        missing = next(name for name in error.validator_value if name not in error.instance)
        return f"{f'{key}: ' if key else ''}'{missing}' is missing; give {schema['description']}"
    if error.validator == "oneOf" and ("tests" in error.schema.get("properties", {}) or "test" in schema.get("properties", {})):
        if not key and "tests" in error.instance:
            extra = next(name for name in ("test", "series", "reference", "quantities") if name in error.instance)
            return f"'{extra}' stands beside 'tests'; write it for each of them"
        if "test" not in error.instance:
            return f"'test' is missing; give {schema['description']}"
        return f"{f'{key}: ' if key else ''}one of 'reference', with 'lowest' and 'highest', and 'quantities' is needed"
    text = json.dumps(error.instance, ensure_ascii=False)
    shown = text if len(text) < 60 else text[:57] + "..."
    node, form = SCHEMA, SCHEMA["description"]
    for part in error.absolute_schema_path:  # the innermost form that is described
        node = node[part]
        form = node["description"] if isinstance(node, dict) and isinstance(node.get("description"), str) else form
    name = f"'{key}'" if key else "the file"
    return f"{name} is {shown}; needed is {form}"


def _check(task: Task) -> None:
    """Checks what spans several keys, or the scripts of a test. @raises ResultsError"""
    require_ground(task["ground"])
    for seed in task["seeds"]:
        require_value("seed", str(seed))
    for name, (start, lower, upper, *_) in task["parameters"].items():
        if not lower < upper or not lower <= start <= upper:
            form = SCHEMA["properties"]["parameters"]["additionalProperties"]["description"]
            raise ResultsError(f"parameter '{name}' starts at {start:g}, and goes from {lower:g} to {upper:g}; needed is {form}")
        if name == "seed" or any(name in test["variables"] for test in task["tests"]):
            raise ResultsError(f"'{name}' is a parameter and a variable; give it once, seeds in 'seeds'")
    for test in task["tests"]:
        _check_test(task, test)


def _check_test(task: Task, test: Task) -> None:
    values = {name: str(value) for name, value in test["variables"].items()}
    if "seed" in values:
        raise ResultsError("variable 'seed': seeds stand in 'seeds'")
    if test.get("series") and SERIES[test["test"]] != "confinement":
        raise ResultsError(f"'series' is of confinements; the test {test['test']} has none")
    for value in test.get("series", []):
        require_value("confinement", str(value))
    starts = {name: str(value[0]) for name, value in task["parameters"].items()}
    require_variables(test["test"], task["ground"], list({**values, **starts}.items()))
    if "reference" not in test:
        return
    file, low, high = HERE / test["reference"], test["lowest"], test["highest"]
    if test["test"] != "oedometer":
        raise ResultsError("'reference' is of an oedometer; other tests have 'quantities'")
    if not low < high:
        raise ResultsError(f"'lowest' is {low:g}, not below 'highest', {high:g} Pa")
    if not file.is_file():
        raise ResultsError(f"'reference': {file} is no file; the path is relative to {HERE}")
    if not any(low <= stress <= high for _, stress in read_oedometer_reference(file)):
        raise ResultsError(f"'reference': {file} has no row with a stress of {low:g} to {high:g} Pa")
