# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow-post as a user does."""

import os
import subprocess
import sys
from pathlib import Path

SOURCE = Path(os.environ["FURROW_SOURCE"])
FURROW_POST = SOURCE / "postproc" / "furrow-post"


def run_post(*arguments: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """With the Python that runs the tests; folder: where it is run."""
    return subprocess.run(
        [sys.executable, str(FURROW_POST), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=240,
        cwd=folder,
    )
