# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases of the programs: a LIGGGHTS script, a laboratory test, a path of a material point."""

import shlex
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..formatting import yaml_text
from .case import FOLDER, Case, Value


def named_values(text: str) -> dict[str, Value]:
    """Variables of a script from "name=value name='two words'", as tables of runs have them."""
    pairs = (word.partition("=") for word in shlex.split(text))
    return {name: value for name, _, value in pairs}


def script_case(
    name: str, script: Path | str, variables: Mapping[str, Value], log: bool = False, **more: Any
) -> Case:
    """A script run by furrow; variables: of the script, beside results, which is the run's folder.

    script: also a text with FOLDER in it; log: keeps LIGGGHTS's log; more: further members of the
    Case
    """
    log_file = f"{FOLDER}/log.liggghts" if log else "none"
    arguments = ("-in", script, "-log", log_file)
    return Case(name, "furrow", arguments, {"results": FOLDER, **variables}, **more)


def laboratory_case(
    name: str, test: str, root: Path, variables: Mapping[str, Value], **more: Any
) -> Case:
    """A test of inputs/laboratory; root: of the project."""
    folder = root / "inputs" / "laboratory"
    given: dict[str, Value] = {"here": folder, **variables}
    return script_case(name, folder / f"{test}.lig", given, log=True, **more)


def point_text(title: str, material: Path, path: str) -> str:
    """An input of furrow-point; path: its YAML mapping, "{type: ..., ...}"."""
    return f"title: {yaml_text(title)}\nmaterial: {yaml_text(str(material))}\npath: {path}\n"


def point_case(name: str, title: str, material: Path, path: str, **more: Any) -> Case:
    """A path of a material point by furrow-point; path: its YAML mapping, "{type: ..., ...}"."""
    arguments = ("run", f"{FOLDER}/path.yaml", "-o", FOLDER, "--no-plot")
    return Case(name, "furrow-point", arguments, files={"path.yaml": point_text(title, material, path)}, **more)
