# SPDX-License-Identifier: GPL-2.0-or-later
"""Continuing a run from the last checkpoint in its results folder."""

import json
import shutil
from dataclasses import dataclass
from pathlib import Path

from ..errors import ResultsError, content_of
from ..json_text import parse_json
from ..run.script import script_variables
from ..run.process import FORCED, PARTICLES
from ..run.record import FINISHED
from .catalogue import Variables

COMMAND = "command.json"  # arguments of the run
FROM, BEGIN = "from", "begin"  # variables of scripts: a checkpoint for a bed; what makes the box
REMEDY = "start without --continue"


@dataclass(frozen=True)
class Former:
    """A run that was stopped."""

    variables: Variables
    ranks: int
    checkpoint: Path | None  # None for a run killed before its first checkpoint
    finished: bool = False  # true for a run that reached its end


def write_command(folder: Path, script: Path, variables: Variables, ranks: int) -> None:
    """Record of a run that begins; removes checkpoints of another run, unless it continues from one."""
    if not any(str(folder) in value for name, value in variables if name in (FROM, BEGIN)):
        for file in _checkpoints(folder):
            file.unlink()
            shutil.rmtree(f"{file}{PARTICLES}", ignore_errors=True)
    content = {"script": str(script), "variables": variables, "ranks": ranks}
    (folder / COMMAND).write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def read_former(folder: Path, script: Path) -> Former:
    """@raises ResultsError where there is nothing to continue"""
    path = folder / COMMAND
    if not path.is_file():
        raise ResultsError(f"{folder}: has no run to continue ({COMMAND}); {REMEDY}")
    with content_of(path, REMEDY):
        content = parse_json(path.read_text(encoding="utf-8"))
        ranks, variables = int(content["ranks"]), [(str(n), str(v)) for n, v in content["variables"]]
        of = str(content["script"])
    if Path(of) != script.resolve():
        raise ResultsError(f"{folder}: has the results of {of}, not of {script}; name its folder with -o")
    found = _checkpoints(folder)
    last = max(found, key=lambda file: file.stat().st_mtime_ns) if found else None
    return Former(variables, ranks, last, (folder / FINISHED).is_file())


def _checkpoints(folder: Path) -> list[Path]:
    """Checkpoints of the script, of --checkpoint, and of a run whose command was killed."""
    found = [*folder.glob("checkpoint*"), *folder.glob(FORCED)]
    return [file for file in found if file.suffix != ".part" and file.is_file()]


def continuation(script: Path, checkpoint: str) -> tuple[str, str]:
    """The variable of a script, and its value, with which it continues. @raises ResultsError"""
    settable = script_variables(script, {}).settable
    if FROM in settable:
        return FROM, checkpoint
    if BEGIN in settable:
        return BEGIN, f"read_restart {checkpoint}"
    raise ResultsError(
        f"{script}: has no variable '{FROM}' for its bed or '{BEGIN}' for its box, so it cannot continue; "
        f"""write 'variable {BEGIN} index "create_box 1 box"', and a line '${{{BEGIN}}}' for create_box"""
    )
