# SPDX-License-Identifier: GPL-2.0-or-later
"""The evaluations of the studies under inputs."""

from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

import click
import pandas

from furrow_post.cli import study_command
from furrow_post.cli.main import message_of
from furrow_post.cli.parameters import Given
from furrow_post.errors import ResultsError
from furrow_post.program import run_program
from furrow_post.run.case import Case
from furrow_post.run.executor import Run
from furrow_post.run.record import Record
from furrow_post.study.definition import cases_of, evaluation_of
from furrow_post.study.study import Study, carry_out
from furrow_post.tables.frames import read_frame

from .command import SOURCE

VALIDATION = SOURCE / "inputs" / "validation"


def evaluation(study: str) -> ModuleType:
    module = evaluation_of(VALIDATION / study)
    assert module, study
    return module


def stored(study: str, table: str) -> pandas.DataFrame:
    """A table of a study as it is kept."""
    return read_frame(VALIDATION / study / f"{table}.csv")


def run_in(folder: Path) -> Run:
    """A run whose results are in a folder, for measures that need nothing else of it."""
    return Run(Case("made", "furrow"), folder, Record({}, "", {}, "", "", 1.0, 1.0, 0.1))


def cases(study: str) -> dict[str, Case]:
    return {case.name: case for case in cases_of(VALIDATION / study)}


def run_study(study: Study, words: Sequence[str]) -> int:
    """The exit status of the command on a study that is already read."""
    return run_program("study", lambda: carry_out(study, options("study", study_command.study, ["made", *words])))


def options(name: str, command: click.Command, words: Sequence[str]) -> Given:
    """Options that a command gets. @raises ResultsError for words that it refuses"""
    try:
        return Given(**command.make_context(name, list(words)).params)
    except click.UsageError as error:
        raise ResultsError(message_of(error)) from error
