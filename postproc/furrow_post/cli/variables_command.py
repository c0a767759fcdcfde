# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post variables: what -v may set in a script; with names and values, whether it may."""

import sys
from collections.abc import Sequence
from pathlib import Path

from ..errors import ResultsError
from ..run.script import RESERVED, check_variables, script_variables
from .parameters import Given, argument, command


@command(
    argument("script", "path of a LIGGGHTS script", Path),
    argument("given", "refuses a name that no line reads", str, nargs=-1, metavar="[NAME VALUE]..."),
)
def variables(given: Given) -> None:
    script: Path = given.script
    words: Sequence[str] = given.given
    if not words:
        known = script_variables(script, {})
        for name in known.settable:
            print(f"{name:20} {known.defaults.get(name, '(no default)')}")
        return
    if len(words) % 2:
        raise ResultsError(f"-v {words[-1]} has no value")
    for warning in check_variables(script, list(zip(words[::2], words[1::2])), RESERVED):
        print(f"WARNING: {warning}", file=sys.stderr)
