# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post study: makes studies, repeats them, writes experiments.csv and the values in pages."""

import importlib
import sys
from pathlib import Path

from ..arguments import at_least, path
from ..errors import ResultsError
from ..formatting import duration
from ..study import pages
from ..study.experiments import counts, experiments_text, path_of, report_items
from ..run.tools import project_root
from ..study.repeat import known_cost, missed
from ..study.study import carry_out
from ..study.values import DEFINITION, Registry, load_yaml, values_of
from ..study.values import study_folders as all_folders
from .parameters import Given, argument, command, flag, option


@command(
    argument("study", "folder of a study.yaml, or its name; default: list them", required=False),
    argument(
        "names",
        "stages or runs to make, also as patterns such as 'row_220*' (default: all)",
        nargs=-1,
        metavar="[RUN]...",
    ),
    flag("--list", help="print which runs are there"),
    flag("--evaluate", help="make no runs, only the tables"),
    flag("--merge", help="put the rows of the runs that are there into the stored tables and leave the others"),
    flag("--again", help="make failed runs again"),
    option("--jobs", parse=at_least(1), default=1, show_default=True, help="runs at a time"),
    flag(
        "--check",
        help="runs by the present program, tables in the results folder; exit status 1 when a limit is missed",
    ),
    option("--results", parse=path, help="where runs are kept (default: results/<study> in the source tree)"),
    option(
        "--build",
        parse=path,
        help="build folder with the programs (default: $FURROW_BUILD, or build in the source tree)",
    ),
    flag("--whole", help="with --check: all runs, not those of seconds alone"),
    flag(
        "--pages",
        help="write inputs/validation/experiments.csv and the values that pages name; with --check write nothing, "
        "fail where a value is another",
    ),
)
def study(given: Given) -> int:
    root = project_root(Path.cwd() / "inputs")
    if given.pages:
        write_pages(root, given.check)
        return 0
    if given.study is None:
        list_studies(root)
        return 0
    folder = folder_of(root, given.study)
    status = make(folder, given)
    if given.check:
        status += repeated(folder, given)
    return 1 if status else 0


def study_folders(root: Path) -> list[Path]:
    """Folders of all studies that have a title, and runs."""
    return [folder for folder in all_folders(root) if "title" in load_yaml(folder / DEFINITION)]


def folder_of(root: Path, name: str) -> Path:
    """Folder of a name, or a folder anywhere that has a study.yaml. @raises ResultsError where there is no such study"""
    given = Path(name).resolve()
    if (given / DEFINITION).is_file():
        return given
    known = study_folders(root)
    for folder in known:
        if folder.name == name:
            return folder
    raise ResultsError(f"there is no study '{name}'; there are {', '.join(folder.name for folder in known)}")


def make(folder: Path, given: Given) -> int:
    """Makes the runs that are missing and evaluates them; the exit status."""
    if given.check and given.whole:
        given.names = ["*"]
    # A list of studies does not wait for pandas and matplotlib
    engine = importlib.import_module("..tables.engine", __package__)
    return carry_out(engine.load_study(folder), given)


def repeated(folder: Path, given: Given) -> int:
    """The number of values that the runs in the results folder have otherwise than stored."""
    if not given.results:
        raise ResultsError("--check needs --results, the folder of its runs and tables")
    sentences = list(missed(values_of(folder), given.results, given.whole))
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
    table, text = path_of(root), experiments_text(registry, report_items(root))
    if not table.is_file() or table.read_text(encoding="utf-8") != text:
        stale[table] = text
    if check and stale:
        names = ", ".join(str(file.relative_to(root)) for file in stale)
        raise ResultsError(f"{names}: values are not those of the studies; run furrow-post study --pages")
    for file, made in stale.items():
        file.write_text(made, encoding="utf-8")
        print(f"{file.relative_to(root)}: written")
    print(counts(registry))
