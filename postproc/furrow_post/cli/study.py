# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post study: makes studies, repeats them, writes experiments.csv and the values in pages."""

import argparse
import sys
from pathlib import Path

from ..arguments import words
from ..errors import ResultsError
from ..formatting import duration
from ..study import pages
from ..study.experiments import counts, experiments_text, path_of
from ..run.tools import project_root
from ..study.repeat import known_cost, missed
from ..study.study import add_study_arguments, carry_out
from ..study.values import DEFINITION, Registry, load_yaml, values_of
from ..study.values import study_folders as all_folders
from ..tables.loading import load_study


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "study", nargs="?", type=words, help="folder of a study.yaml, or its name; default: list them"
    )
    add_study_arguments(parser)
    parser.add_argument(
        "--whole", action="store_true", help="with --check: all runs, not those of seconds alone"
    )
    parser.add_argument(
        "--pages",
        action="store_true",
        help="write inputs/validation/experiments.csv and the values that pages name; with --check "
        "write nothing, fail where a value is another",
    )


def run(arguments: argparse.Namespace) -> None:
    root = project_root(Path.cwd() / "inputs")
    if arguments.pages:
        write_pages(root, arguments.check)
    elif arguments.study is None:
        list_studies(root)
    else:
        folder = folder_of(root, arguments.study)
        status = make(folder, arguments)
        if arguments.check:
            status += repeated(folder, arguments)
        if status:
            raise SystemExit(1)


def study_folders(root: Path) -> list[Path]:
    """Of all studies that have a title, and runs."""
    return [folder for folder in all_folders(root) if "title" in load_yaml(folder / DEFINITION)]


def folder_of(root: Path, name: str) -> Path:
    """Of a name, or a folder anywhere that has a study.yaml. @raises ResultsError where there is no such study"""
    given = Path(name).resolve()
    if (given / DEFINITION).is_file():
        return given
    known = study_folders(root)
    for folder in known:
        if folder.name == name:
            return folder
    raise ResultsError(
        f"there is no study '{name}'; there are {', '.join(folder.name for folder in known)}"
    )


def make(folder: Path, arguments: argparse.Namespace) -> int:
    """Makes the runs that are missing and evaluates them; the exit status."""
    if arguments.check and arguments.whole:
        arguments.names = ["*"]
    return carry_out(load_study(folder), arguments)


def repeated(folder: Path, arguments: argparse.Namespace) -> int:
    """The number of values that the runs in the results folder have otherwise than stored."""
    if not arguments.results:
        raise ResultsError("--check needs --results, the folder of its runs and tables")
    sentences = list(missed(values_of(folder), arguments.results, arguments.whole))
    for sentence in sentences:
        print(f"MISSED: {sentence}", file=sys.stderr)
    return len(sentences)


def list_studies(root: Path) -> None:
    for folder in study_folders(root):
        cost = known_cost(folder)
        about = f"about {duration(cost)} of one core in all" if cost else "cost not stored"
        print(f"{folder.name:22} {about}")


def write_pages(root: Path, check: bool) -> None:
    """@raises ResultsError with check, where a file is not what the tables of the studies give"""
    registry = Registry.of(root)
    stale = pages.stale_pages(root, registry)
    table, text = path_of(root), experiments_text(registry)
    if not table.is_file() or table.read_text(encoding="utf-8") != text:
        stale[table] = text
    if check and stale:
        names = ", ".join(str(file.relative_to(root)) for file in stale)
        raise ResultsError(f"{names}: values are not those of the studies; run furrow-post study --pages")
    for file, made in stale.items():
        file.write_text(made, encoding="utf-8")
        print(f"{file.relative_to(root)}: written")
    print(counts(registry))
