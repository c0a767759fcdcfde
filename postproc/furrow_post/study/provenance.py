# SPDX-License-Identifier: GPL-2.0-or-later
"""Provenance of tables and figures of a study: a row per file in provenance.csv next to them."""

import shlex
import sys
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from datetime import date
from pathlib import Path

from ..csv_table import read_comments, read_rows, write_rows
from ..run.record import Record

FILE = "provenance.csv"
HEAD = (
    "# Where the files of this folder come from. program: name and SHA-256 (first digits) of the",
    "# executable; commit: of the source tree when the runs were made, + with changes; runs and",
    "# written: days. What is not known is empty.",
)


@dataclass(frozen=True)
class Origin:
    """Origin of one file."""

    file: str
    program: str = ""
    commit: str = ""
    runs: str = ""  # day, or first and last day of the runs
    written: str = ""  # day
    command: str = ""  # command that wrote the file
    note: str = ""

    def joined(self, former: "Origin | None") -> "Origin":
        """Origin of a file that keeps rows of former runs."""
        if former is None:
            return self
        programs = sorted({*former.program.split("; "), *self.program.split("; ")} - {""})
        commits = sorted({*former.commit.split(), *self.commit.split()})
        days = sorted({*former.runs.split(" to "), *self.runs.split(" to ")} - {""})
        return replace(
            self,
            program="; ".join(programs),
            commit=" ".join(commits),
            runs=" to ".join(dict.fromkeys((days[0], days[-1]))) if days else "",
            note=former.note,
        )


def origin(file: str, records: Iterable[Record], root: Path) -> Origin:
    """Origin of a file that the present command writes from these runs; root: of the project."""
    known = list(records)
    days = sorted({record.started[:10] for record in known})
    programs = {f"{record.name_of_program} {record.program}" for record in known}
    command = shlex.join(sys.argv).replace(f"{root}/", "")
    return Origin(
        file,
        "; ".join(sorted(programs)),
        " ".join(sorted({record.commit for record in known} - {""})),
        " to ".join(dict.fromkeys((days[0], days[-1]))) if days else "",
        date.today().isoformat(),
        command,
    )


def read_origins(folder: Path) -> dict[str, Origin]:
    """Origin of each file in provenance.csv."""
    path = folder / FILE
    return {row["file"]: Origin(**row) for row in read_rows(path)} if path.is_file() else {}


def update_origins(folder: Path, origins: Sequence[Origin]) -> None:
    """Puts origins into provenance.csv and leaves those of other files."""
    merged = {**read_origins(folder), **{one.file: one for one in origins}}
    path = folder / FILE
    head = read_comments(path) if path.is_file() else HEAD
    write_rows(path, [asdict(merged[file]) for file in sorted(merged)], head)
