#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""One test of the virtual soil laboratory: grains, evaluation, figure, and a continuum law beside
them.

Several confinements (plate: sizes in m; collapse: aspects) make several runs and one evaluation.
Variables of a scene or ground (its head and grounds/NAME.lig) are set with -v.
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
sys.path.insert(0, str(PROJECT / "postproc"))

from checks import (
    SERIES,
    grounds,
    require_ground,
    require_law,
    require_series,
    require_variables,
)

from furrow_post.arguments import at_least, path, shield_negative_numbers, words
from furrow_post.errors import ResultsError
from furrow_post.figures.laboratory_figure import draw_laboratory
from furrow_post.laboratory.report import report_tests
from furrow_post.program import run_program
from furrow_post.read.laboratory import read_oedometer_reference
from furrow_post.run.case import Case, Value, laboratory_case, point_case
from furrow_post.run.executor import Executor
from furrow_post.run.tools import Tools

CONFINEMENT = "2e4"  # [Pa] of the law's triaxial path where no series is given


def law_case(name: str, test: str, material: Path, confinement: str) -> Case:
    """The path of a test on a material point. @raises ResultsError where it has none"""
    paths = {
        "oedometer": "{type: confined, stress: [1e3, 1e4, 1e5, 4e5, 1e6], steps: 50}",
        "triaxial": f"{{type: triaxial, confinement: {confinement}, axial_strain: [0.25], "
        "steps: 400}",
    }
    if test not in paths:
        raise ResultsError(
            f"--continuum is for {' and '.join(paths)}; other tests have no path of a point"
        )
    what = f", {float(confinement) / 1e3:g} kPa" if test == "triaxial" else ""
    return point_case(name, f"{material.stem}{what}", material.resolve(), paths[test])


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("test", nargs="?", choices=sorted(SERIES))
    parser.add_argument("--list", action="store_true", help="tests and grounds")
    parser.add_argument("--ground", default="sand_dry", help=f"one of {', '.join(grounds())}")
    series = ", ".join(f"{test}: {name}" for test, name in SERIES.items())
    parser.add_argument(
        "--series", type=words, metavar="VALUES", help=f"values, with commas: {series}"
    )
    parser.add_argument(
        "--confinement", type=words, metavar="VALUES", help="the series of triaxial, extension, plane_strain and shear"
    )
    parser.add_argument(
        "--continuum",
        type=path,
        action="append",
        default=[],
        metavar="MATERIAL.yaml",
        help="the same path on a law, to lay beside",
    )
    parser.add_argument("--reference", type=path, help="reference.csv of an oedometer")
    parser.add_argument(
        "-v", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"), dest="variables"
    )
    parser.add_argument("-o", "--output", type=path)
    parser.add_argument("--jobs", type=at_least(1), default=1, help="runs at a time (default: 1)")
    parser.add_argument("--build", type=path, help="default: $FURROW_BUILD, or build in the tree")
    parsed = parser.parse_args(shield_negative_numbers(sys.argv[1:]))
    parsed.variables = [(name, value.strip()) for name, value in parsed.variables]
    return parsed


def series_of(parsed: argparse.Namespace) -> list[str]:
    """Values of the series, or none. @raises ResultsError"""
    name = SERIES[parsed.test]
    if parsed.confinement and name != "confinement":
        raise ResultsError(f"--confinement: the series of {parsed.test} is {name}; use --series")
    if parsed.confinement and parsed.series:
        raise ResultsError("--confinement and --series are the same here; give one of them")
    text: str = parsed.confinement or parsed.series or ""
    return [value.strip() for value in text.split(",")] if text else []


def check(parsed: argparse.Namespace, series: list[str]) -> None:
    """Before anything runs. @raises ResultsError"""
    test: str = parsed.test
    require_ground(parsed.ground)
    require_variables(test, parsed.ground, parsed.variables)
    require_series(test, series, parsed.ground, dict(parsed.variables))
    for material in parsed.continuum:
        if not material.is_file():
            raise ResultsError(f"--continuum {material}: no such file; name a material (YAML)")
        law_case("", test, material, CONFINEMENT)  # has this test a path of a point?
        require_law(material)
    if parsed.reference:
        read_oedometer_reference(parsed.reference)
        if test != "oedometer":
            raise ResultsError("--reference is for oedometers; leave it out")


def run_test(parsed: argparse.Namespace) -> None:
    test: str = parsed.test
    series = series_of(parsed)
    check(parsed, series)
    tools = Tools.of(Path(__file__), parsed.build)
    default = PROJECT / "results" / "laboratory" / f"{test}_{parsed.ground}"
    output: Path = (parsed.output or default).resolve()
    executor = Executor(output, tools, parsed.jobs, again=True)
    cases = []
    for value in series or [""]:
        variables: dict[str, Value] = {"ground": parsed.ground}
        if value:
            variables[SERIES[test]] = value
        variables.update(parsed.variables)
        name = f"{SERIES[test]}_{value}" if value else ""
        cases.append(laboratory_case(name, test, PROJECT, variables))
    paths = []
    for material in parsed.continuum:
        for value in (series if test == "triaxial" else []) or [""]:
            name = f"point_{material.stem}_{value}"
            paths.append(law_case(name, test, material, value or CONFINEMENT))
    folders = [run.folder for run in executor.completed([*cases, *paths])]
    points = [str(folder) for folder in folders[len(cases) :]]
    found = report_tests(folders[: len(cases)], parsed.reference, points)
    print(found.report)
    target = output / "laboratory.png"
    draw_laboratory(found, target)
    print(target)


def main() -> None:
    parsed = parse()
    if parsed.list or not parsed.test:
        print("tests:", ", ".join(sorted(SERIES)), "\ngrounds:", ", ".join(grounds()))
        return
    run_test(parsed)


if __name__ == "__main__":
    sys.exit(run_program("laboratory/run.py", main))
