# SPDX-License-Identifier: GPL-2.0-or-later
"""The evaluations of the studies under inputs."""

from types import ModuleType

from furrow_post.study.case import Case
from furrow_post.study.definition import cases_of, evaluation_of

from .command import SOURCE

VALIDATION = SOURCE / "inputs" / "validation"


def evaluation(study: str) -> ModuleType:
    return evaluation_of(VALIDATION / study)


def cases(study: str) -> dict[str, Case]:
    return {case.name: case for case in cases_of(VALIDATION / study)}
