#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A law for the continuum from the laboratory tests of a snow of clusters, and what it is worth.

  record RESULTS ... -o RECORD.csv                           means and scatter over packings
  fit RECORD.csv --law LAW [--title TITLE] -o MATERIAL.yaml  the law
  compare RECORD.csv MATERIAL.yaml ...                       all values, and the deviations

Laws: cohesive Cam clay, the Drucker-Prager cap, the crushable foam. Two numbers give each its shape
(--law names them). Least squares fits them to all tests but shear and triaxial at once. Each quantity
of each test has the same weight. Deviations are logarithms of stresses, logarithms of densities over
0.1, and differences of K0 over 0.1 and of lateral over axial strain over 0.2. Where the law has no
state, the deviation is that of a factor of 20. For each shape the hardening is that with which the law
follows the oedometer. E is the mean of the moduli in tension, nu 0.
"""

import argparse
import sys
import tempfile
import textwrap
from collections.abc import Sequence
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

from snow_laws import LAWS, Material, deviation, fit, is_fitted, is_ratio, judged
from snow_paths import Points, predicted
from snow_record import Row, Values, read_record, record_of, write_record

from furrow_post.analyse.statistics import rms
from furrow_post.arguments import path, words
from furrow_post.formatting import yaml_text
from furrow_post.program import run_program
from furrow_post.read.laboratory import LaboratoryTest
from furrow_post.run.tools import Tools
from furrow_post.study.tables import markdown

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
    """A material file without its title. @raises OSError"""
    lines = path.read_text(encoding="utf-8").splitlines()
    return "\n".join(line for line in lines if not line.startswith("title:")) + "\n"


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
    """The file, which says how far the law is from the tests."""
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


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        epilog="\n".join(TESTS),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--build", type=path, help="default: $FURROW_BUILD, or build in the tree")
    commands = parser.add_subparsers(dest="command", required=True)
    record = commands.add_parser("record", help="tests -> RECORD.csv")
    record.add_argument("tests", nargs="+", type=path, help="results folders")
    record.add_argument("-o", "--output", required=True, type=path, metavar="RECORD.csv")
    fitted = commands.add_parser("fit", help="RECORD.csv -> MATERIAL.yaml")
    fitted.add_argument("record", type=path)
    shapes = "; ".join(f"{n}: {', '.join(s.name for s in law.shapes)}" for n, law in LAWS.items())
    fitted.add_argument("--law", choices=sorted(LAWS), default="cam_clay", help=shapes)
    fitted.add_argument("--title", type=words)
    fitted.add_argument("-o", "--output", required=True, type=path, metavar="MATERIAL.yaml")
    compared = commands.add_parser("compare", help="RECORD.csv, MATERIAL.yaml ... -> tables")
    compared.add_argument("record", type=path)
    compared.add_argument("materials", nargs="+", type=path)
    return parser.parse_args()


def run(parsed: argparse.Namespace) -> None:
    if parsed.command == "record":
        write_record(parsed.output, record_of(LaboratoryTest(folder) for folder in parsed.tests))
        return
    rows = read_record(parsed.record)
    judged_rows = judged(rows)
    tools = Tools.of(Path(__file__), parsed.build)
    with tempfile.TemporaryDirectory() as name, Points(tools, Path(name)) as points:
        if parsed.command == "fit":
            material = fit(LAWS[parsed.law], rows, points)
            values = predicted(material.sections(), judged_rows, points)
            title = parsed.title or f"Snow of {parsed.record.stem}, {material.law.title}"
            text = material_text(title, parsed.record, material, judged_rows, values)
            parsed.output.write_text(text, encoding="utf-8")
            print(text)
            return
        laws = {
            file.stem: predicted(sections_of(file), judged_rows, points)
            for file in parsed.materials
        }
    print(tables(judged_rows, laws))


def main() -> None:
    run(parse())


if __name__ == "__main__":
    sys.exit(run_program("laboratory/identify_snow.py", main))
