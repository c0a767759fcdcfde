# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of scenes, also of one that goes on until it is steady."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..errors import ResultsError
from ..run.case import FOLDER, Case, script_case
from ..run.script import as_word, script_variables

RESULTS = "results"  # the variable of a script that is its results folder
CONTINUED = "until_steady.lig"  # the script of a run that goes on until it is steady


def continued_script(script: Path, error: float, time_limit: float) -> str:
    """A script that runs another one, and on until hub drop and resistance are steady.

    @raises ResultsError for a path that LIGGGHTS cannot include
    """
    if len(str(script).split()) > 1:
        raise ResultsError(
            f"--until-steady: {script} has blanks in its path, from which LIGGGHTS cannot include; "
            "move it"
        )
    limit = f" wall_time {time_limit:.10g}" if time_limit else ""
    return f"include {script}\nrun_until_steady error {error:.10g}{limit}\n"


def scene_case(
    name: str,
    script: Path,
    variables: Mapping[str, str],
    until_steady: float,
    steady_limit: float,
    **more: Any,
) -> Case:
    """A run of a scene; until_steady: relative error, 0: as long as the script lasts; steady_limit: its time
    limit [s], 0: none; more: further members of the Case"""
    run: Path | str = script
    if until_steady:
        run = f"{FOLDER}/{CONTINUED}"
        more["reads"] = (script,)
        more["files"] = {CONTINUED: continued_script(script, until_steady, steady_limit)}
    known = script_variables(script, variables)
    case = script_case(
        name,
        run,
        {name: as_word(script, value) for name, value in variables.items()},
        log=True,
        **more,
    )
    if RESULTS in known.settable:
        return case
    return replace(case, variables={name: value for name, value in case.variables.items() if name != RESULTS})
