# SPDX-License-Identifier: GPL-2.0-or-later
"""Every experiment of the report [Shoop2001] beside ours: makes the studies that are missing, one
after the other, and writes the table of this folder's README.md from their stored tables.

It may be stopped and started again at any time: a study makes only the runs that are not there.
"""

import argparse
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import experiments
import guards
import overview

from furrow_post.arguments import path, words
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.formatting import duration
from furrow_post.study.output import with_section

HERE = Path(__file__).resolve().parent
PAGE = HERE / "README.md"
COSTS = ("user_s", "cpu_s")  # columns of a study's tables with the core seconds of a run
LISTED = "costs.csv"  # table of a study with every run's


def studies() -> list[str]:
    """Folders with a driver."""
    return sorted(driver.parent.name for driver in HERE.glob("*/run.py"))


def driver(study: str, *options: str) -> "subprocess.CompletedProcess[str]":
    """Runs a study's driver; what it prints goes to the screen but for --list."""
    return subprocess.run(
        [sys.executable, str(HERE / study / "run.py"), *options],
        stdout=subprocess.PIPE if "--list" in options else None,
        text=True,
    )


def missing(study: str, options: Sequence[str]) -> tuple[int, int]:
    """Runs that are missing in the results folder, and all. @raises ResultsError"""
    listed = driver(study, "--list", *options)
    if listed.returncode:
        raise ResultsError(f"{study}/run.py --list does not work; see above")
    lines = listed.stdout.splitlines()
    return sum(line.startswith("missing") for line in lines), len(lines)


def known_cost(study: str) -> float:
    """Core seconds of all runs of a study, as its stored tables have them; 0: not known.

    A run that stands in several tables counts once: by its name, or where the study lists its costs
    by that list alone.
    """
    folder, per_run = HERE / study, dict[str, float]()
    tables = [folder / LISTED] if (folder / LISTED).is_file() else sorted(folder.glob("*.csv"))
    for table in tables:
        for index, row in enumerate(read_rows(table)):
            if row.get("quantity") in COSTS:  # a table with a column for each run
                runs = {run: text for run, text in row.items() if run != "quantity" and text}
                per_run.update({run: float(text) for run, text in runs.items()})
                continue
            name = row.get("run") or row.get("case") or f"{table.name} {index}"
            name = f"{row.get('family', '')}/{name}"  # grains has runs of one name in several
            for column in COSTS:
                if row.get(column):
                    per_run[name] = float(row[column])
    return sum(per_run.values())


def list_studies(chosen: Sequence[str], options: Sequence[str]) -> None:
    for study in chosen:
        absent, runs = missing(study, options)
        cost = known_cost(study)
        about = f"about {duration(cost)} of one core in all" if cost else "cost not stored"
        print(f"{study:22} {runs - absent:3} of {runs:3} runs are there; {about}")


def make(chosen: Sequence[str], options: Sequence[str]) -> int:
    """Runs the studies that miss something; the number that failed."""
    left = {study: missing(study, options) for study in chosen}
    seconds = {study: known_cost(study) * lost / max(of, 1) for study, (lost, of) in left.items()}
    failed = 0
    for index, study in enumerate(chosen):
        if not left[study][0]:
            continue
        rest = sum(seconds[other] for other in chosen[index:])
        print(f"{time.strftime('%H:%M:%S')}  {study}: about {duration(rest)} left", flush=True)
        failed += driver(study, *options).returncode != 0
    return failed


def check(study: str, whole: bool, results: Path, options: Sequence[str]) -> int:
    """Repeats the cheap runs of a study, or all: the number of what is not as it is stored."""
    every = ["*"] if whole else []
    failed = driver(study, "--check", *every, "--results", str(results), *options).returncode != 0
    sentences = list(guards.missed(study, results, whole))
    for sentence in sentences:
        print(f"MISSED: {sentence}", file=sys.stderr)
    return failed + len(sentences)


def page_of(text: str) -> str:
    """The page with the table as the stored results have it. @raises ResultsError"""
    return with_section(text, overview.section(experiments.GROUPS), overview.BEGIN, overview.END)


def write_page() -> None:
    text = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(page_of(text), encoding="utf-8")
    print(f"{PAGE}: {overview.counts(experiments.GROUPS)}")


def parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    made.add_argument("names", nargs="*", type=words, metavar="STUDY", help="default: all")
    made.add_argument("--list", action="store_true", help="say what is there, make nothing")
    made.add_argument("--table", action="store_true", help="only write the table of README.md")
    made.add_argument(
        "--check",
        action="store_true",
        help="repeat the runs of one study that cost seconds; status 1 where a number of the table "
        "is no longer what is stored",
    )
    made.add_argument("--whole", action="store_true", help="with --check: all runs of the study")
    made.add_argument("--results", type=path, help="with --check: where runs are kept")
    made.add_argument("--build", type=path, help="build folder with the programs")
    return made


def main() -> int:
    parsed = parser().parse_args()
    options = ["--build", str(parsed.build)] if parsed.build else []
    known = studies()
    for name in parsed.names:
        if name not in known:
            raise ResultsError(f"there is no study '{name}'; there are {', '.join(known)}")
    chosen = parsed.names or known
    if (parsed.whole or parsed.results) and not parsed.check:
        raise ResultsError("--whole and --results go with --check")
    if parsed.list:
        list_studies(chosen, options)
        return 0
    if parsed.check:
        if len(chosen) != 1 or parsed.results is None:
            raise ResultsError("--check takes the name of one study, and --results")
        return 1 if check(chosen[0], parsed.whole, parsed.results, options) else 0
    failed = 0 if parsed.table else make(chosen, options)
    write_page()
    return 1 if failed else 0
