# SPDX-License-Identifier: GPL-2.0-or-later
"""One run of a scene: what is run, and its results folder."""

import json
import shlex
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import ResultsError
from ..json_text import parse_json
from ..programs import PACKAGE, find_program
from ..read.script import as_word, script_variables
from ..study.launch import is_busy
from ..sweep.continued import CONTINUED, RESULTS, continued_script
from .catalogue import Variables, is_shipped
from .process import Failed, Runs, Stopped
from .restart import continuation, write_command

RECORD = "run.json"  # of a run that came to its end


@dataclass(frozen=True)
class SceneRun:
    """A run of a scene; of a variable that is given twice the first value counts, as in LIGGGHTS."""

    script: Path
    folder: Path  # of the results
    variables: Variables
    ranks: int = 1
    until_steady: float = 0.0  # relative error; 0: as long as the script lasts
    time_limit: float = 0.0  # [s] of until_steady; 0: none
    checkpoint_every: float = 0.0  # [s]; 0: no checkpoints but those of the script
    continue_from: Path | None = None  # a checkpoint
    words: str = ""  # the scene and its options, for tables of runs


def require_folder(folder: Path) -> None:
    """Makes a results folder that no other run writes to. @raises ResultsError"""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".writable").touch()
        (folder / ".writable").unlink()
    except OSError as error:
        raise ResultsError(
            f"-o {folder}: there is a file of this name, or no right to write ({error.strerror}); name "
            "another folder"
        ) from error
    if is_busy(folder):
        raise ResultsError(
            f"results go to {folder}, which another run is writing to; wait until it has ended, or name "
            "another folder with -o"
        )


def run_scene(run: SceneRun, runs: Runs, label: str = "") -> None:
    """@raises ResultsError, Stopped, Failed"""
    require_folder(run.folder)
    (run.folder / RECORD).unlink(missing_ok=True)
    folder = run.folder.resolve()
    # LIGGGHTS splits lines at blanks: a folder with blanks has the name "." from inside. A script of
    # the user may name files that are relative to where it is started.
    has_blanks = len(str(folder).split()) > 1
    start = folder if has_blanks or is_shipped(run.script) else Path.cwd()
    command: list[object] = ["mpirun", "-n", run.ranks] if run.ranks > 1 else []
    command += [find_program("furrow"), "-in", _script(run, folder), "-log", folder / "log.liggghts"]
    for name, value in _values(run, Path(".") if has_blanks else folder).items():
        command += ["-var", name, value]
    if not run.continue_from:
        write_command(folder, run.script.resolve(), run.variables, run.ranks)
    cost = runs.run(command, start, folder, label, run.checkpoint_every)
    record: dict[str, object] = {
        "cpu_time": round(cost.cpu_time, 3),
        "wall_time": round(cost.wall_time, 3),
        "ranks": run.ranks,
        "words": run.words,
    }
    if run.continue_from:
        record["continued"] = True  # the times are those of the last part
    (folder / RECORD).write_text(json.dumps(record) + "\n", encoding="utf-8")


def _script(run: SceneRun, folder: Path) -> Path:
    """The scene, or a script that runs it and goes on. @raises ResultsError"""
    script = run.script.resolve()
    if not run.until_steady:
        return script
    text = continued_script(script, run.until_steady, run.time_limit)
    (folder / CONTINUED).write_text(text, encoding="utf-8")
    return folder / CONTINUED


def _values(run: SceneRun, folder: Path) -> dict[str, str]:
    """Of the variables, as LIGGGHTS gets them; folder: of the results as it is called from there."""
    given = [(name, as_word(run.script, value)) for name, value in run.variables]
    if run.continue_from:
        given.insert(0, continuation(run.script, str(folder / run.continue_from.name)))
    values = dict(reversed(given))
    if RESULTS in script_variables(run.script, dict(run.variables)).settable:
        values[RESULTS] = str(folder)
    return values


def post(*commands: Sequence[object], shown: bool = True) -> None:
    """Runs commands of furrow-post in one process, which imports matplotlib once. @raises Failed"""
    code = (
        f"import json, sys; sys.path.insert(0, {str(PACKAGE.parent)!r}); from furrow_post.cli.main import main; "
        "sys.exit(next(filter(None, map(main, json.loads(sys.argv[1]))), 0))"
    )
    words = json.dumps([[str(word) for word in command] for command in commands])
    sys.stdout.flush()
    done = subprocess.run(
        [sys.executable, "-c", code, words], stdout=None if shown else subprocess.DEVNULL
    )
    if done.returncode:
        raise Failed(done.returncode)


def show(folder: Path, quick: bool, shown: bool = True) -> None:
    """Pictures of a run with a history; those of a quick run are small."""
    if not (folder / "history.h5").is_file():
        return
    commands: list[Sequence[object]] = [("plot", folder)]
    # Neither a rigid plane nor a height field has grains or particles to draw
    cost = parse_json((folder / "summary.json").read_text()).get("cost", {})
    if cost.get("grains") or (folder / "terrain.h5").is_file():
        commands.append(("picture", folder, *(("--pixels", 500) if quick else ())))
    post(*commands, shown=shown)


def words_of(scene: str, variables: Sequence[tuple[str, str]]) -> str:
    """The scene and its options as they are typed."""
    return shlex.join([scene, *(word for pair in variables for word in ("-v", *pair))])
