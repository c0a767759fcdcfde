# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of scenes: their cases, their results folders and their pictures."""

import importlib
import os
import shlex
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import ResultsError
from ..run.case import FOLDER, Case, scene_case
from ..run.record import is_busy
from ..run.executor import Executor, Failed
from ..run.tools import Tools
from .catalogue import Variables, is_shipped
from .restart import continuation, write_command


# values of inputs/guide/howto/cluster.md
GAIN_FROM_PARTICLES, GAIN_FROM_GRAINS = 30_000, 20_000
SHARE_OF_A_CORE = 0.3  # busy share of a core that does not exclude a rank


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

    def case(self, name: str) -> Case:
        """The run; name: of its folder below that of the executor. @raises ResultsError"""
        given = list(self.variables)
        if self.continue_from:
            given.insert(0, continuation(self.script, f"{FOLDER}/{self.continue_from.name}"))
        script = self.script.resolve()
        return scene_case(
            name,
            script,
            dict(reversed(given)),
            self.until_steady,
            self.time_limit,
            ranks=self.ranks,
            # A script of the user may name files that are relative to where it is started
            start=None if is_shipped(self.script) else Path.cwd(),
            keeps_checkpoint=True,
            checkpoint=self.checkpoint_every,
            continued=self.continue_from is not None or self.begins_inside,
            words=self.words,
        )

    @property
    def begins_inside(self) -> bool:
        """True where a variable names a file of the results folder."""
        return any(str(self.folder.resolve()) in value for _, value in self.variables)


def ranks_remark(ranks: int) -> str:
    """Remark on whether several ranks can gain anything on this machine now."""
    cores, load = len(os.sched_getaffinity(0)), os.getloadavg()[0]
    free = max(0.0, cores - load)
    machine = f"{ranks} ranks on {cores} core{'s' if cores > 1 else ''}, of which {min(load, cores):.1f} are busy"
    if ranks > cores or free < ranks - SHARE_OF_A_CORE:
        return f"{machine}: ranks wait for each other, so expect no gain over one rank; results differ by rounding"
    return (
        f"{machine}: continua of more than {GAIN_FROM_PARTICLES:,} particles and beds of more than "
        f"{GAIN_FROM_GRAINS:,} grains gain; smaller scenes, tyres and height fields do not"
    )


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


def run_scenes(
    folder: Path, scenes: Sequence[SceneRun], jobs: int = 1, ended: Callable[[Case], None] | None = None
) -> None:
    """Makes runs whose folders are below a folder, or are this one; ended: see Executor.run.

    @raises ResultsError, Interrupted, Failed
    """
    executor, cases = _prepared(folder, scenes, jobs)
    for scene in scenes:
        if not scene.continue_from:
            write_command(scene.folder.resolve(), scene.script.resolve(), scene.variables, scene.ranks)
    executor.repeat(cases, ended)
    _require_done(executor, cases)


def run_missing(folder: Path, scenes: Sequence[SceneRun], jobs: int = 1) -> None:
    """Runs the cases that are not stored with the same inputs. @raises ResultsError, Interrupted, Failed"""
    executor, cases = _prepared(folder, scenes, jobs)
    executor.run(cases)
    _require_done(executor, cases)


def _prepared(folder: Path, scenes: Sequence[SceneRun], jobs: int) -> tuple[Executor, list[Case]]:
    for scene in scenes:
        require_folder(scene.folder)
    names = ("" if scene.folder == folder else str(scene.folder.relative_to(folder)) for scene in scenes)
    executor = Executor(folder, Tools.found(), jobs, low_priority=False, watch=True)
    return executor, [scene.case(name) for scene, name in zip(scenes, names)]


def _require_done(executor: Executor, cases: Sequence[Case]) -> None:
    """@raises Failed for the first run that stopped with an error"""
    for case in cases:
        if (run := executor.ended(case)) and run.error:
            raise Failed(run)


def show(folder: Path, quick: bool, shown: bool = True) -> None:
    """Draws a run with a history; shown: prints the names of the pictures."""
    if not (folder / "history.h5").is_file():
        return
    # Other runs do not wait for matplotlib
    pictures = importlib.import_module(".pictures", __package__)
    for file in pictures.draw_run(folder, quick):
        if shown:
            print(file)


def words_of(scene: str, variables: Sequence[tuple[str, str]]) -> str:
    """Arguments of the command line for the scene and its options."""
    return shlex.join([scene, *(word for pair in variables for word in ("-v", *pair))])
