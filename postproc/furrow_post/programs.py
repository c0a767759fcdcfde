# SPDX-License-Identifier: GPL-2.0-or-later
"""Folders of Furrow's programs and inputs: in the source tree, or installed."""

import importlib
import os
import shutil
import sys
from pathlib import Path
from typing import Any

from .errors import ResultsError

CALLED = "FURROW_CALLED"  # environment variable: how the user started furrow-post run
PACKAGE = Path(__file__).resolve().parent
TREE = PACKAGE.parents[1]  # of the sources, if the package lies in one


def source_tree() -> Path | None:
    """The source tree that the package lies in, or None where it is installed."""
    return TREE if (TREE / "CMakeLists.txt").is_file() and (TREE / "inputs").is_dir() else None


def inputs_folder() -> Path | None:
    """The folder with scenes, materials and tyres; None where only the package is installed."""
    for folder in (TREE / "inputs", PACKAGE.parent / "inputs"):
        if (folder / "scenes").is_dir():
            return folder
    return None


def results_folder(name: str) -> Path:
    """Default folder of results: in the source tree, or in the current folder without a source tree."""
    return (source_tree() or Path.cwd()) / "results" / name


def find_program(name: str) -> Path:
    """Path of a program in the build folder of FURROW_BUILD, next to furrow-post, in the source tree's build
    folder, or on the PATH: a program of one build finds the others of this build.

    @raises ResultsError where there is none
    """
    command = Path(sys.argv[0])
    folders = [command.absolute().parent, command.resolve().parent]
    if "FURROW_BUILD" in os.environ:
        folders.insert(0, Path(os.environ["FURROW_BUILD"]).resolve() / "bin")
    elif source_tree():
        folders.append(TREE / "build" / "bin")
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    found = shutil.which(name)
    if not found:
        raise ResultsError(
            f"there is no program {name}; run 'bash inputs/run' once, which builds it, or put it on "
            "the PATH"
        )
    return Path(found)


def optional_module(name: str, package: str) -> Any:
    """A library that few commands need. package: of Debian. @raises ResultsError where it is missing"""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise ResultsError(
            f"{sys.executable} has no {name.partition('.')[0]}; write 'apt install {package}' and use "
            "Debian's /usr/bin/python3"
        ) from None
