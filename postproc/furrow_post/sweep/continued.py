# SPDX-License-Identifier: GPL-2.0-or-later
"""The script of a run that goes on until it is steady."""

from pathlib import Path

from ..errors import ResultsError

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
