# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/experiments.csv: every value of every study, and how many have which verdict."""

from collections.abc import Iterable
from fnmatch import fnmatchcase
from pathlib import Path

from ..csv_table import read_rows, rows_text
from .provenance import read_origins
from .values import AGREE, VERDICTS, Registry, StudyValue

HEAD = (
    "# Every value of the studies. error: standard error, or that it is not estimated; error_of: its",
    "# parts, or the table of the study that has it. reference_of: measured, report (computed by the",
    "# source), formula, ours, program (another one). label: fitted (the value was used in a fit), known",
    "# (measured value known before the model was fixed), held out (in a source that this project has,",
    "# kept apart), blind (nobody here has it), scored (predicted after a score). verdict: agrees, within",
    "# 10 % or twice the error of the reference; near, within 25 %; differs; met or missed; inconclusive,",
    "# where twice the errors decide, allow more than 25 %, or are not estimated. reason: of the verdict; for",
    "# nothing to compare, what a comparison needs. program: commit of the source tree that made the runs, +",
    "# with uncommitted changes. audit: items of report_items.csv that the value answers. Written by",
    "# furrow-post study --pages.",
)


def path_of(root: Path) -> Path:
    return root / "inputs" / "validation" / "experiments.csv"


def commits(value: StudyValue) -> str:
    """Commits of the source trees that made the table of a value, "+" with changes; empty where not known."""
    if value.stored is None:
        return ""
    table = value.stored.table
    origin = read_origins(table.parent).get(table.name)
    return " ".join(dict.fromkeys(origin.commit.split())) if origin else ""


def report_items(root: Path) -> list[dict[str, str]]:
    """Items of [Shoop2001]. @raises ResultsError"""
    return read_rows(path_of(root).with_name("report_items.csv"))


def answers(value: StudyValue, item: dict[str, str]) -> bool:
    """True if a pattern of the item fits the value's id."""
    return any(fnmatchcase(value.id, pattern) for pattern in item["rows"].split())


def experiments_text(registry: Registry, items: list[dict[str, str]]) -> str:
    """The content of the file. @raises ResultsError"""
    return rows_text(
        [
            {
                **value.row(),
                "program": commits(value),
                "audit": " ".join(item["item"] for item in items if answers(value, item)),
            }
            for value in registry
        ],
        HEAD,
    )


def counts(values: Iterable[StudyValue]) -> str:
    """How many values have which verdict, and how many of those that agree are a test."""
    rows = [(value, value.verdict()) for value in values]
    found = [verdict for _, verdict in rows]
    parts = [f"{found.count(name)} {name}" for name in VERDICTS if name in found]
    tests = [
        value
        for value, verdict in rows
        if verdict == AGREE and value.label != "fitted" and value.reference_of == "measured"
    ]
    return (
        f"{len(found)} values: {', '.join(parts)}. Of those that agree {len(tests)} were not fitted and "
        "are compared with a measurement."
    )
