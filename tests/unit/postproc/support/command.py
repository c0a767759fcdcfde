# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow-post as a user does, in a copy of this process that has their modules."""

import os
import subprocess
from pathlib import Path

from copied import run_both
from furrow_post.cli import main

SOURCE = Path(os.environ["FURROW_SOURCE"])
FURROW_POST = SOURCE / "postproc" / "furrow-post"


def run_post(*arguments: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """folder: where it is run."""
    return run_both(main.main, [FURROW_POST, *arguments], folder)


def run_card(*arguments: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    return run_post("card", *arguments, folder=folder)
