# SPDX-License-Identifier: GPL-2.0-or-later
"""The evaluations of the studies under inputs."""

import argparse
from collections.abc import Sequence
from types import ModuleType

from furrow_post.program import run_program
from furrow_post.run.case import Case
from furrow_post.study.definition import cases_of, evaluation_of
from furrow_post.study.study import Study, add_study_arguments, carry_out

from .command import SOURCE

VALIDATION = SOURCE / "inputs" / "validation"


def evaluation(study: str) -> ModuleType:
    return evaluation_of(VALIDATION / study)


def cases(study: str) -> dict[str, Case]:
    return {case.name: case for case in cases_of(VALIDATION / study)}


def run_study(study: Study, words: Sequence[str]) -> int:
    """The exit status of the command on a study that is already read."""
    parser = argparse.ArgumentParser()
    add_study_arguments(parser)
    return run_program("study", lambda: carry_out(study, parser.parse_args(words)))
