# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands for shells and programs, which import little: completion of commands, options and scenes; variables of a
script; figures of furrow-point, furrow-sidewall and furrow-tyre --modes, which call figure."""

import importlib
import sys
from collections.abc import Sequence
from pathlib import Path

from ..arguments import path
from ..errors import ResultsError
from ..run.script import RESERVED, check_variables, script_variables
from .parameters import Given, argument, command

LINES = {
    "bash": 'eval "$(_FURROW_POST_COMPLETE=bash_source furrow-post)"',
    "zsh": 'eval "$(_FURROW_POST_COMPLETE=zsh_source furrow-post)"',
    "fish": "_FURROW_POST_COMPLETE=fish_source furrow-post | source",
}
FIGURES = ("point", "sidewall", "modes")  # of modules and functions


@command(argument("shell", ", ".join(LINES), choices=LINES))
def completion(given: Given) -> None:
    print(f"# Add this line to the start file of {given.shell}; furrow-post must be on the PATH")
    print(LINES[given.shell])


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


@command(
    argument("name", ", ".join(FIGURES[:-1]) + f" or {FIGURES[-1]}", choices=FIGURES),
    argument("results", "results folder of the program", path),
)
def figure(given: Given) -> None:
    module = importlib.import_module(f"..figures.{given.name}_figure", __package__)
    for file in getattr(module, f"draw_{given.name}")(given.results):
        print(f"  figure        {file}")
