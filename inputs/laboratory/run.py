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

from furrow_post.analyse.laboratory import report_tests
from furrow_post.errors import ResultsError
from furrow_post.figures.laboratory import draw_laboratory
from furrow_post.study.case import Case, Value
from furrow_post.study.furrow_cases import laboratory_case, point_case
from furrow_post.study.launch import Interrupted, Tools, launch

SERIES = {  # test -> the variable of which several values make a series
    "oedometer": "seed",
    "triaxial": "confinement",
    "shear": "confinement",
    "plate": "size",
    "repose": "seed",
    "collapse": "aspect",
}
CONFINEMENT = "2e4"  # [Pa] of the law's triaxial path where no series is given


def grounds() -> list[str]:
    return sorted(path.stem for path in (HERE / "grounds").glob("*.lig"))


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


def make(case: Case, output: Path, tools: Tools) -> Path:
    """The folder of the run. @raises ResultsError where it failed"""
    folder = output / case.name if case.name else output
    record = launch(case, folder, tools)
    if record.error:
        raise ResultsError(f"{folder} failed: {record.error}; see screen.txt there")
    return folder


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("test", nargs="?", choices=sorted(SERIES))
    parser.add_argument("--list", action="store_true", help="tests and grounds")
    parser.add_argument("--ground", default="sand_dry", help=f"one of {', '.join(grounds())}")
    series = ", ".join(f"{test}: {name}" for test, name in SERIES.items())
    parser.add_argument(
        "--series", "--confinement", dest="series", help=f"values, with commas: {series}"
    )
    parser.add_argument(
        "--continuum",
        type=Path,
        action="append",
        default=[],
        metavar="MATERIAL.yaml",
        help="the same path on a law, to lay beside",
    )
    parser.add_argument("--reference", type=Path, help="reference.csv of an oedometer")
    parser.add_argument(
        "-v", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"), dest="variables"
    )
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--build", type=Path, help="default: $FURROW_BUILD, or build in the tree")
    parsed = parser.parse_args()
    if parsed.ground not in grounds():
        parser.error(f"there is no ground {parsed.ground}; there are {', '.join(grounds())}")
    return parsed


def run_test(parsed: argparse.Namespace) -> None:
    test: str = parsed.test
    tools = Tools.of(Path(__file__), parsed.build)
    default = PROJECT / "results" / "laboratory" / f"{test}_{parsed.ground}"
    output: Path = (parsed.output or default).resolve()
    series: list[str] = parsed.series.split(",") if parsed.series else [""]
    folders = []
    for value in series:
        variables: dict[str, Value] = {"ground": parsed.ground}
        if value:
            variables[SERIES[test]] = value
        variables.update(parsed.variables)
        name = f"{SERIES[test]}_{value}" if value else ""
        folders.append(make(laboratory_case(name, test, PROJECT, variables), output, tools))
    points = []
    for material in parsed.continuum:
        for value in series if test == "triaxial" else [""]:
            name = f"point_{material.stem}_{value}"
            case = law_case(name, test, material, value or CONFINEMENT)
            points.append(str(make(case, output, tools)))
    found = report_tests(folders, parsed.reference, points)
    print(found.report)
    target = output / "laboratory.png"
    draw_laboratory(found, target)
    print(target)


if __name__ == "__main__":
    arguments = parse()
    if arguments.list or not arguments.test:
        print("tests:", ", ".join(sorted(SERIES)), "\ngrounds:", ", ".join(grounds()))
        sys.exit()
    try:
        run_test(arguments)
    except (ResultsError, Interrupted, OSError) as error:
        sys.exit(f"inputs/laboratory/run.py: {error}")
