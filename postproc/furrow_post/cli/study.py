# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post study: experiments.csv, and the values of studies in pages."""

import argparse
from pathlib import Path

from ..errors import ResultsError
from ..study import pages
from ..study.experiments import experiments_text, path_of
from ..study.launch import project_root
from ..study.values import Registry


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--pages",
        action="store_true",
        help="write inputs/validation/experiments.csv and the values that pages name",
    )
    parser.add_argument(
        "--check", action="store_true", help="with --pages: write nothing, fail where a value is another"
    )


def run(arguments: argparse.Namespace) -> None:
    if arguments.pages:
        write_pages(project_root(Path.cwd() / "inputs"), arguments.check)


def write_pages(root: Path, check: bool) -> None:
    """@raises ResultsError with check, where a file is not what the tables of the studies give"""
    registry = Registry.of(root)
    stale = pages.stale_pages(root, registry)
    table, text = path_of(root), experiments_text(registry)
    if not table.is_file() or table.read_text(encoding="utf-8") != text:
        stale[table] = text
    if check and stale:
        names = ", ".join(str(path.relative_to(root)) for path in stale)
        raise ResultsError(f"{names}: values are not those of the studies; run furrow-post study --pages")
    for path, made in stale.items():
        path.write_text(made, encoding="utf-8")
        print(f"{path.relative_to(root)}: written")
