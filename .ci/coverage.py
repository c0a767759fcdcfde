# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares a summary of gcovr with the recorded coverage, folder by folder.

coverage.py SUMMARY.json RECORD.csv [--update]. The record has the columns folder, lines and branches [%].
Exit status 1 if the whole of src and coupling covers more than one point less than the record.
"""

import csv
import json
import re
import sys
from collections import defaultdict
from pathlib import Path

ALLOWED_DROP = 1.0  # points


def shares(summary: Path) -> dict[str, tuple[float, float]]:
    """Covered lines and branches in percent of each folder below src and coupling, and of "all"."""
    counts: dict[str, list[int]] = defaultdict(lambda: [0, 0, 0, 0])
    for file in json.loads(summary.read_text())["files"]:
        # gcovr gives headers of the library the path of the link in the build.
        name = re.sub(r"^.*/include/furrow/", "src/", file["filename"])
        for key in ("/".join(name.split("/")[:2]), "all"):
            for k, column in enumerate(("line_covered", "line_total", "branch_covered", "branch_total")):
                counts[key][k] += file[column]
    return {
        key: (100 * lines / max(1, all_lines), 100 * branches / max(1, all_branches))
        for key, (lines, all_lines, branches, all_branches) in sorted(counts.items())
    }


def main(summary: Path, record: Path, update: bool) -> int:
    now = shares(summary)
    for folder, (lines, branches) in now.items():
        print(f"{folder:24} lines {lines:5.1f} %  branches {branches:5.1f} %")
    if update:
        rows = [(folder, f"{lines:.1f}", f"{branches:.1f}") for folder, (lines, branches) in now.items()]
        with record.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([("folder", "lines", "branches"), *rows])
        return 0
    if not record.is_file():
        print(f"there is no record {record}: write it with bash .ci/coverage --update")
        return 1
    with record.open() as file:
        recorded = {row["folder"]: (float(row["lines"]), float(row["branches"])) for row in csv.DictReader(file)}
    status = 0
    for name, value, before in zip(("line", "branch"), now["all"], recorded["all"]):
        if value < before - ALLOWED_DROP:
            print(f"{name} coverage fell from {before:.1f} % to {value:.1f} %: add tests, or run bash .ci/coverage --update")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2]), "--update" in sys.argv))
