# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow-post and furrow-soil as a user does, in a copy of this process that has their modules."""

import os
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Callable
from pathlib import Path

from furrow_post.cli import main, report, soil

SOURCE = Path(os.environ["FURROW_SOURCE"])
FURROW_POST = SOURCE / "postproc" / "furrow-post"
LOADED = (report, soil)  # with what they import: most of what the other commands need


def run_post(*arguments: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """folder: where it is run."""
    return _run_copy(main.main, [FURROW_POST, *arguments], folder)


def run_soil(*arguments: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    return _run_copy(soil.main, [FURROW_POST.with_name("furrow-soil"), *arguments], folder)


def _run_copy(
    program: Callable[[], int], words: list[object], folder: Path | None
) -> subprocess.CompletedProcess[str]:
    command = [str(word) for word in words]
    sys.stdout.flush()
    sys.stderr.flush()
    with tempfile.TemporaryFile() as printed, tempfile.TemporaryFile() as said:
        copy = os.fork()
        if copy == 0:
            _become(program, command, folder, (printed.fileno(), said.fileno()))
        status = os.waitstatus_to_exitcode(os.waitpid(copy, 0)[1])
        printed.seek(0)
        said.seek(0)
        texts = printed.read().decode(), said.read().decode()
    return subprocess.CompletedProcess(command, status, *texts)


def _become(
    program: Callable[[], int], command: list[str], folder: Path | None, files: tuple[int, int]
) -> None:
    """Does not return: this process ends with the status of the program."""
    status = 1
    try:
        for descriptor, file in enumerate((os.open(os.devnull, os.O_RDONLY), *files)):
            os.dup2(file, descriptor)
        sys.stdout, sys.stderr = os.fdopen(1, "w"), os.fdopen(2, "w")
        sys.argv = command
        if folder is not None:
            os.chdir(folder)
        status = program()
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else 1
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
