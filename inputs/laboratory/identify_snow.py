#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A law for the continuum from the laboratory tests of a snow of clusters, and what it is worth.

Laws: cohesive Cam clay, the Drucker-Prager cap, the crushable foam. Two numbers give each its shape
(--law names them). Least squares fits them to all tests but shear and triaxial at once. Each quantity
of each test has the same weight. Deviations are logarithms of stresses, logarithms of densities over
0.1, and differences of K0 over 0.1 and of lateral over axial strain over 0.2. Where the law has no
state, the deviation is that of a factor of 20. For each shape the hardening is that with which the law
follows the oedometer. E is the mean of the moduli in tension, nu 0.
"""

import sys
import tempfile
import textwrap
from collections.abc import Sequence
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import click

from snow_laws import LAWS, Material, compared_rows, deviation, fit, is_fitted, is_ratio
from snow_paths import Points, predicted
from snow_record import Row, Values, read_record, record_of, write_record

from furrow_post.uncertainty.statistics import rms
from furrow_post.arguments import path
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, argument, command, option
from furrow_post.formatting import yaml_text
from furrow_post.read.laboratory import LaboratoryTest
from furrow_post.run.tools import Tools
from furrow_post.csv_table import markdown

TESTS = (  # of a record
    "tests of a record: run.py TEST --ground snow_bonded -v slenderness 3 -v rate 2 OPTIONS -o results/snow/TEST",
    "  oedometer -v grains 300 -v stress 1.1e6 -v strain 1.25 --series 86028121,49979687",
    "  tension -v grains 200 -v rate 0.5 -v compaction C --series 86028121,49979687",
    "  unconfined -v grains 200 -v strain 0.25 -v compaction C --series 86028121,49979687",
    "  triaxial -v grains 200 -v strain 0.22 --confinement 2e2,6e2,2e3,6e3,1e4,2e4,3e4",
    "  shear -v grains 200 -v speed 0.02 -v travel 0.5 -v compaction C --confinement P",
    "  C: 0, 0.41, 0.70, 0.93; P: 1e2,3e2,1e3 and 1e2,1e3,3e3 and 1e2,5e3,2e4 and 1e2,3e4,1e5",
)


def sections_of(path: Path) -> str:
    """A material file without its title and the file of its contact. @raises OSError"""
    lines = path.read_text(encoding="utf-8").splitlines()
    return "\n".join(line for line in lines if not line.startswith(("title:", "contact:"))) + "\n"


def deviations(rows: Sequence[Row], values: Values) -> dict[tuple[str, str], tuple[float, int]]:
    """(test, quantity) -> rms of the deviations, and how many rows have no state."""
    found = {}
    for kind in dict.fromkeys((row.test, row.quantity) for row in rows):
        each = [deviation(r, values[r.place]) for r in rows if (r.test, r.quantity) == kind]
        states = [value for value in each if value == value]
        found[kind] = (rms(states), len(each) - len(states))
    return found


def cell(found: tuple[float, int]) -> str:
    value, missing = found
    text = f"{value:.2f}" if value == value else "-"
    return f"{text}, {missing} without a state" if missing else text


def meaning(kind: tuple[str, str]) -> str:
    test, quantity = kind
    what = "difference" if is_ratio(quantity) else "ln"
    how = "" if is_fitted(test) else ", predicted"
    return f"{test}: {quantity.replace('_', ' ')} ({what}{how})"


def material_text(
    title: str, record: Path, material: Material, rows: Sequence[Row], values: Values
) -> str:
    """The file, which states how far the law is from the tests."""
    found = deviations(rows, values)
    worth = "; ".join(f"{meaning(kind)} {cell(value)}" for kind, value in found.items())
    said = (
        f"Written by inputs/laboratory/identify_snow.py from the tests of {record.name}: "
        f"{material.law.title}. rms of law over grains: {worth}."
    )
    for shape, value in zip(material.law.shapes, material.shape):
        if not 1.01 * shape.lower < value < 0.99 * shape.upper:
            said += f" {shape.name} stands at a bound."
    comment = textwrap.fill(said, 100, initial_indent="# ", subsequent_indent="# ")
    return f"title: {yaml_text(title)}\n{comment}\n{material.sections()}"


def place_of(row: Row) -> str:
    parts = [row.test]
    if row.compaction:
        parts.append(f"after {row.compaction:g} of compression")
    if row.confinement:
        parts.append(f"at {row.confinement / 1e3:g} kPa")
    if row.level and row.test == "oedometer":
        parts.append(f"{row.level / 1e3:g} kPa")
    elif row.level:
        parts.append(f"strain {row.level:g}")
    return f"{', '.join(parts)}: {row.quantity.replace('_', ' ')}"


def tables(rows: Sequence[Row], laws: dict[str, Values]) -> str:
    """Markdown: every value, then the deviations."""
    each = [
        [
            place_of(row),
            f"{row.value:.3g} ± {row.scatter:.1g}",
            *(f"{values[row.place]:.3g}" for values in laws.values()),
        ]
        for row in rows
    ]
    all_found = [deviations(rows, values) for values in laws.values()]
    rest = [[meaning(kind), *(cell(found[kind]) for found in all_found)] for kind in all_found[0]]
    return "\n".join([*markdown(["", "grains", *laws], each), "", *markdown(["", *laws], rest)])


BUILD = option("--build", parse=path, help="default: $FURROW_BUILD, or build in the tree")

@command(
    argument("tests", "results folders", path, nargs=-1, required=True),
    option("-o", "--output", required=True, parse=path, metavar="RECORD.csv", help="file to write"),
    name="record",
    help="Tests -> RECORD.csv: means and scatter over packings.",
)
def record(given: Given) -> None:
    write_record(given.output, record_of(LaboratoryTest(folder) for folder in given.tests))


@command(
    argument("record", "RECORD.csv", path),
    option(
        "--law",
        choices=sorted(LAWS),
        default="cam_clay",
        show_default=True,
        help="; ".join(f"{n}: {', '.join(s.name for s in law.shapes)}" for n, law in LAWS.items()),
    ),
    option("--title", help="of the material"),
    option("-o", "--output", required=True, parse=path, metavar="MATERIAL.yaml", help="file to write"),
    BUILD,
    name="fit",
    help="RECORD.csv -> MATERIAL.yaml.",
)
def fit_law(given: Given) -> None:
    rows = read_record(given.record)
    judged_rows = compared_rows(rows)
    with tempfile.TemporaryDirectory() as name, Points(Tools.of(Path(__file__), given.build), Path(name)) as points:
        material = fit(LAWS[given.law], rows, points)
        values = predicted(material.sections(), judged_rows, points)
    title = given.title or f"Snow of {given.record.stem}, {material.law.title}"
    text = material_text(title, given.record, material, judged_rows, values)
    given.output.write_text(text, encoding="utf-8")
    print(text)


@command(
    argument("record", "RECORD.csv", path),
    argument("materials", "MATERIAL.yaml", path, nargs=-1, required=True),
    BUILD,
    name="compare",
    help="RECORD.csv, MATERIAL.yaml ... -> tables of all values and deviations.",
)
def compare(given: Given) -> None:
    judged_rows = compared_rows(read_record(given.record))
    with tempfile.TemporaryDirectory() as name, Points(Tools.of(Path(__file__), given.build), Path(name)) as points:
        laws = {file.stem: predicted(sections_of(file), judged_rows, points) for file in given.materials}
    print(tables(judged_rows, laws))


def main() -> int:
    steps = click.Group(commands=[record, fit_law, compare], help=__doc__, epilog="\b\n" + "\n".join(TESTS))
    return start(steps, "laboratory/identify_snow.py")


if __name__ == "__main__":
    sys.exit(main())
