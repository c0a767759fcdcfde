# SPDX-License-Identifier: GPL-2.0-or-later
"""Destination of tables, figures and page sections of a study, with their provenance."""

import shutil
import tempfile
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..csv_table import aligned, read_rows, write_rows
from .provenance import origin, read_origins, update_origins
from ..run.record import Record

PAGE, SECTION = "README.md", "tables.md"
BEGIN, END = "<!-- written by the study -->", "<!-- end -->"
COLUMNS = 100  # of a page
OF_RUNS = ("case", "law")  # first column of a table by run that has no column "run"


def _wrapped(line: str) -> str:
    """Prose and items of a list in lines of a page's width; tables and images stay as they are."""
    if len(line) <= COLUMNS or line.startswith(("|", "![", "#")):
        return line
    indent = "  " if line.startswith("- ") else ""
    return textwrap.fill(
        line,
        COLUMNS,
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )


def with_section(page: str, lines: Sequence[str], begin: str = BEGIN, end: str = END) -> str:
    """Page with these lines between its marks; marks are added to a page without."""
    text = "\n".join(_wrapped(line) for line in lines).strip()
    before, found, rest = page.partition(begin)
    after = rest.partition(end)[2] if end in rest else "\n"
    return f"{before}{found or begin}\n\n{text}\n\n{end}{after}"


def column_of_run(path: Path) -> str:
    """Column that names the run of a row; empty: a stored file without a row for each run."""
    rows = read_rows(path) if path.suffix == ".csv" else []
    columns = list(rows[0]) if rows else []
    return "run" if "run" in columns else next((name for name in columns[:1] if name in OF_RUNS), "")


def merged(path: Path, rows: Sequence[Mapping[str, Any]]) -> Sequence[Mapping[str, Any]]:
    """The stored rows with these in the place of those of the same run; new ones come last.

    Without new rows a table stays, also one that does not name its runs.
    """
    if not rows and path.is_file():
        return read_rows(path)
    key = column_of_run(path) if path.is_file() else ""
    if not key:
        return rows
    fresh: dict[str, list[Mapping[str, Any]]] = {}
    for row in rows:
        fresh.setdefault(str(row[key]), []).append(row)
    kept: dict[str, list[Mapping[str, Any]]] = {}
    for old in read_rows(path):
        kept.setdefault(old[key], []).append(old)
    return [row for group in {**kept, **fresh}.values() for row in group]


class Output:
    """Files of a study for one folder, where publish() puts them together: an evaluation that
    breaks off replaces nothing. To be used in a with statement.

    page: README.md is there and gets the section between its marks; else the section is a
    separate file. merge: only tables with a row for each run are written, and files that are named
    by of_all_runs(); rows of these runs replace those that are stored, and the others stay.
    """

    def __init__(self, folder: Path, page: bool, merge: bool = False) -> None:
        self.folder, self.page, self.merge = folder, page, merge
        self.files: list[str] = []
        self._of_all_runs: set[str] = set()
        self._written = tempfile.TemporaryDirectory()
        folder.mkdir(parents=True, exist_ok=True)

    def __enter__(self) -> "Output":
        return self

    def __exit__(self, *problem: object) -> None:
        self._written.cleanup()

    def path(self, name: str) -> Path:
        """Path at which the study writes a file."""
        if name not in self.files:
            self.files.append(name)
        return Path(self._written.name) / name

    def of_all_runs(self, name: str) -> str:
        """Names a file that is made of the rows of all runs, stored ones too: merge writes it."""
        self._of_all_runs.add(name)
        return name

    def table(
        self, name: str, rows: Sequence[Mapping[str, Any]], comments: Sequence[str] = ()
    ) -> None:
        """Prints a table and writes it; nothing for no rows."""
        if rows:
            print(aligned(rows), end="\n\n")
            write_rows(self.path(name), self.known(name, rows), comments)

    def known(self, name: str, rows: Sequence[Mapping[str, Any]]) -> Sequence[Mapping[str, Any]]:
        """Rows that table() writes: these, and with merge stored rows of other runs too."""
        joins = self.merge and name not in self._of_all_runs
        return merged(self.folder / name, rows) if joins else rows

    def section(self, lines: Sequence[str]) -> None:
        """Writes the generated part of the study's page."""
        if not self.page:
            text = "\n".join(_wrapped(line) for line in lines).strip()
            self.path(SECTION).write_text(text + "\n", encoding="utf-8")
            return
        page = (self.folder / PAGE).read_text(encoding="utf-8")
        self.path(PAGE).write_text(with_section(page, lines), encoding="utf-8")

    def _joins(self, file: str, known: Mapping[str, Any]) -> bool:
        """True where a file may be put beside stored ones: of all runs, or a table by run, stored
        before or new."""
        if file in self._of_all_runs:
            return True
        stored = self.folder / file
        return bool(file in known and column_of_run(stored) if stored.is_file() else column_of_run(self.path(file)))

    def publish(self, records: Sequence[Record], root: Path) -> None:
        """Puts all files into the folder, with their provenance: they were made of these runs;
        root: of the project."""
        known = read_origins(self.folder) if self.merge else {}
        files = [file for file in self.files if not self.merge or self._joins(file, known)]
        for file in files:
            shutil.move(Path(self._written.name) / file, self.folder / file)
        made = [origin(file, records, root) for file in files]
        update_origins(self.folder, [one.joined(known.get(one.file)) for one in made])
