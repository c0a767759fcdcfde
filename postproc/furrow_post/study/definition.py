# SPDX-License-Identifier: GPL-2.0-or-later
"""study.yaml: the runs of a study. engine.py of tables has the keys of its tables and figures.

    title: what the study is about
    checked: [run, ...]             # what --check makes; without it every run
    texts: {snow: "law: ..."}       # of files, which name them
    defaults: {script: wheel.lig, variables: {depth: 0.2, ...}, time_limit: 3600, ...}
    runs:
      stage:
        defaults: {...}             # of this stage, over those above
        run name: {what: words, variables: {cell: 0.1}, ...}

A run is a LIGGGHTS script (script, variables, log), a path of a material point (point: {title,
material, path}), or a program with its arguments. Other keys are those of a Case; shares lists the
variables that make equal what runs with the same script share. In texts {here} is the folder of
the study, {inputs}, {materials}, {scenes}, {tyres} are those folders, {folder} that of the run,
{run} its name, {what} its words, and every key of `with` stands for its value. A file's text that
begins with "=" is an expression of the functions in evaluate.py. An entry with `for: {key: [value,
...]}` is a run for each combination of the values; {key} stands for the value, in the run's name
too. A value may give further keys: `for: {key: {value: {other: ...}}}`. `for: = function()` takes
the keys of each run from evaluate.py. A study whose runs are rows of a table has a function
cases() in its evaluate.py in the place of `runs`.
"""

import importlib.util
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product
from pathlib import Path
from types import ModuleType
from typing import Any

from ..errors import ResultsError, refuse_others
from ..run.case import FOLDER, Case, Value, point_case, script_case
from ..run.tools import project_root
from .values import DEFINITION, load_yaml

EVALUATION = "evaluate.py"
FOLDERS = ("materials", "scenes", "tyres")
KEYS = {
    "what", "program", "script", "arguments", "variables", "files", "point", "with", "time_limit",
    "may_fail", "fallback", "log", "ranks", "shares", "reads", "for",
}  # fmt: skip
MERGED = ("variables", "files", "point", "with", "fallback")  # key by key; of others the last counts


def evaluation_of(folder: Path) -> ModuleType | None:
    """The module of a study's own functions, evaluate.py; None where it needs none."""
    file = folder / EVALUATION
    if not file.is_file():
        return None
    name = f"evaluation_of_{folder.name}"
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def cases_of(folder: Path, content: Mapping[str, Any] | None = None) -> tuple[Case, ...]:
    """The runs that the study.yaml of a folder lists. @raises ResultsError"""
    content = content or load_yaml(folder / DEFINITION)
    common = content.get("defaults") or {}
    texts = content.get("texts") or {}
    found = []
    for stage, runs in (content.get("runs") or {}).items():
        own = _merged(common, runs.get("defaults") or {})
        for name, run in runs.items():
            if name != "defaults":
                each = _each(folder, str(name), _merged(own, run or {}))
                found += [_case(folder, str(stage), *one, texts) for one in each]
    return tuple(found)


def _each(folder: Path, name: str, run: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """The runs of an entry with `for`, one for each combination of its values; of another entry itself."""
    for keys in _keys(folder, run.pop("for", None) or {}):
        given = {**(run.get("with") or {}), **keys}
        own = name
        for key, value in given.items():
            own = own.replace(f"{{{key}}}", str(value))
        yield own, {**run, "with": given}


def _keys(folder: Path, values: Any) -> Iterator[dict[str, Any]]:
    """Values of the keys of `for` in each run."""
    if isinstance(values, str):
        yield from eval(values.removeprefix("="), dict(vars(evaluation_of(folder))))
        return
    several = [one if isinstance(one, Mapping) else dict.fromkeys(one, {}) for one in values.values()]
    for combination in product(*(one.items() for one in several)):
        given: dict[str, Any] = {}
        for key, (value, more) in zip(values, combination):
            given |= {key: value, **more}
        yield given


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    merged = {**base, **over}
    for key in MERGED:
        if key in base or key in over:
            both = {**(base.get(key) or {}), **(over.get(key) or {})}
            merged[key] = {name: value for name, value in both.items() if value is not None}
    return merged


def _case(
    folder: Path, stage: str, name: str, run: Mapping[str, Any], texts: Mapping[str, str]
) -> Case:
    where = f"{folder / DEFINITION}: run '{name}'"
    refuse_others(where, run, KEYS)
    if sum(run.get(key) is not None for key in ("script", "point", "program")) != 1:
        raise ResultsError(f"{where}: give one of script, point, program")
    inputs = project_root(folder / DEFINITION) / "inputs"
    named = {"run": name, "what": str(run.get("what", ""))}
    named |= {"here": str(folder), "inputs": str(inputs)}
    named |= {kind: str(inputs / kind) for kind in FOLDERS}
    named |= {key: str(value) for key, value in (run.get("with") or {}).items()}

    def filled(value: Any) -> Any:
        if not isinstance(value, str):
            return value
        text = value
        for key, replacement in named.items():
            text = text.replace(f"{{{key}}}", replacement)
        is_path = value.startswith("{") and text.startswith("/") and " " not in text
        return Path(text) if is_path else text

    def all_filled(key: str) -> dict[str, Any]:
        return {name: filled(value) for name, value in (run.get(key) or {}).items()}

    variables: dict[str, Value] = all_filled("variables")
    files = {name: str(filled(texts.get(text, text))) for name, text in all_filled("files").items()}
    for name_of_file, text in files.items():
        if text.startswith("="):  # a study can contain programs
            files[name_of_file] = str(eval(text[1:], dict(vars(evaluation_of(folder)))))
    more: dict[str, Any] = {key: run[key] for key in ("what", "time_limit", "may_fail", "ranks") if key in run}
    more |= {"stage": "" if stage == "all" else stage, "fallback": all_filled("fallback"), "files": files}
    more["reads"] = tuple(filled(value) for value in run.get("reads") or ())
    if names := run.get("shares"):
        own = run.get("variables") or {}
        more["shares"] = (run.get("script"), *(str(own.get(key, "")) for key in names))
    if run.get("script") is not None:
        script = filled(run["script"])
        script = script if isinstance(script, Path) or FOLDER in str(script) else folder / script
        return script_case(name, script, variables, log=bool(run.get("log")), **more)
    if run.get("point") is not None:
        point = all_filled("point")
        del more["files"]
        case = point_case(name, str(point.get("title", name)), Path(point["material"]), str(point["path"]), **more)
        return replace(case, files={**case.files, **files})
    arguments = tuple(filled(word) for word in run.get("arguments") or ())
    return Case(name, run["program"], arguments, variables, **more)
