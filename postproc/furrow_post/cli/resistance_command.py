# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post resistance: becomes the program furrow-resistance."""

import os
from pathlib import Path

from ..programs import find_program
from ..read.results import require_different
from .parameters import Given, argument, command


@command(
    argument("words", "arguments of furrow-resistance", str, nargs=-1),
    add_help_option=False,
    context_settings={"ignore_unknown_options": True},
)
def resistance(given: Given) -> None:
    """Does not return. @raises ResultsError without the program, or for a folder that is given twice"""
    require_different([word for word in given.words if Path(word).is_dir()])
    program = str(find_program("furrow-resistance"))
    os.execv(program, [program, *given.words])
