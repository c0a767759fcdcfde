# SPDX-License-Identifier: GPL-2.0-or-later
"""Python programs in copies of this process, which has their modules: no start waits for its imports."""

import gc
import os
import re
import runpy
import shlex
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from furrow_post.cli import comparison_commands, soil_commands

LOADED = (comparison_commands, soil_commands)  # with what they import: most of what other commands need
POST = re.compile(r"postproc/furrow-(post|soil) |(/usr/bin/python3 )?inputs/[\w/]+\.py( |$)")
SHELL = re.compile(r"[][$*?|&;<>`(){}~!]")  # what only a shell understands


def is_python(command: str) -> bool:
    """True if a command of a page can run in a copy: a Python program of the tree, without a shell."""
    return bool(POST.match(command)) and not SHELL.search(command)


def run_command(command: str, folder: Path, build: Path, seconds: float) -> tuple[int, str]:
    """The status of a command of a page with the programs of a build, and all that it printed."""
    environment = {"FURROW_BUILD": str(build)}
    if is_python(command):
        return _run_script(command, folder, environment)
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env={**os.environ, **environment, "PATH": f"{build}/bin:{os.environ['PATH']}"},
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=seconds,
    )
    return done.returncode, done.stdout


def file_program(script: Path) -> Callable[[], None]:
    """Program that does what Python does with a file."""

    def program() -> None:
        sys.path.insert(0, str(script.resolve().parent))
        runpy.run_path(str(script), run_name="__main__")

    return program


def _run_script(command: str, folder: Path, environment: Mapping[str, str]) -> tuple[int, str]:
    words = shlex.split(command.removeprefix("/usr/bin/python3 "))
    script = folder / words[0]
    with tempfile.TemporaryFile() as printed:
        files = printed.fileno(), printed.fileno()
        status = run_copy(file_program(script), [str(script), *words[1:]], folder, files, environment)
        printed.seek(0)
        return status, printed.read().decode()


def run_both(
    program: Callable[[], int | None], words: Sequence[object], folder: Path | None = None
) -> subprocess.CompletedProcess[str]:
    """Runs a function with the command line sys.argv; its status is what it returns."""
    command = [str(word) for word in words]
    with tempfile.TemporaryFile() as printed, tempfile.TemporaryFile() as said:
        status = run_copy(program, command, folder, (printed.fileno(), said.fileno()), {})
        printed.seek(0)
        said.seek(0)
        texts = printed.read().decode(), said.read().decode()
    return subprocess.CompletedProcess(command, status, *texts)


def run_copy(
    program: Callable[[], int | None],
    command: list[str],
    folder: Path | None,
    files: tuple[int, int],
    environment: Mapping[str, str],
) -> int:
    """The status. files: descriptors of the standard output and of that of errors"""
    sys.stdout.flush()
    sys.stderr.flush()
    gc.freeze()  # or a search for unused objects would write to all pages that the copy shares
    copy = os.fork()
    if copy == 0:
        _become(program, command, folder, files, environment)
    return os.waitstatus_to_exitcode(os.waitpid(copy, 0)[1])


def _become(
    program: Callable[[], int | None],
    command: list[str],
    folder: Path | None,
    files: tuple[int, int],
    environment: Mapping[str, str],
) -> None:
    """Does not return: this process ends with the status of the program."""
    status = 1
    try:
        for descriptor, file in enumerate((os.open(os.devnull, os.O_RDONLY), *files)):
            os.dup2(file, descriptor)
        sys.stdout, sys.stderr = os.fdopen(1, "w"), os.fdopen(2, "w")
        sys.argv = command
        os.environ.update(environment)
        if folder is not None:
            os.chdir(folder)
        status = program() or 0
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
