#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""One test of the virtual soil laboratory: grains, evaluation, figure, and a continuum law beside
them.

Several confinements (plate: sizes in m; collapse: aspects) make several runs and one evaluation.
Variables of a scene or ground (its head and grounds/NAME.lig) are set with -v.
"""

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

from furrow_post.arguments import at_least, path
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, argument, command, flag, option
from furrow_post.errors import ResultsError
from furrow_post.figures.laboratory_figure import draw_laboratory
from furrow_post.laboratory.report import report_tests
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


def series_of(given: Given) -> list[str]:
    """Values of the series, or none. @raises ResultsError"""
    name = SERIES[given.test]
    if given.confinement and name != "confinement":
        raise ResultsError(f"--confinement: the series of {given.test} is {name}; use --series")
    if given.confinement and given.series:
        raise ResultsError("--confinement and --series are the same here; give one of them")
    text: str = given.confinement or given.series or ""
    return [value.strip() for value in text.split(",")] if text else []


def check(given: Given, series: list[str]) -> None:
    """Checks the arguments before any run. @raises ResultsError"""
    test: str = given.test
    require_ground(given.ground)
    require_variables(test, given.ground, given.variables)
    require_series(test, series, given.ground, dict(given.variables))
    for material in given.continuum:
        if not material.is_file():
            raise ResultsError(f"--continuum {material}: no such file; name a material (YAML)")
        law_case("", test, material, CONFINEMENT)  # has this test a path of a point?
        require_law(material)
    if given.reference:
        read_oedometer_reference(given.reference)
        if test != "oedometer":
            raise ResultsError("--reference is for oedometers; leave it out")


def run_test(given: Given) -> None:
    test: str = given.test
    series = series_of(given)
    check(given, series)
    tools = Tools.of(Path(__file__), given.build)
    default = PROJECT / "results" / "laboratory" / f"{test}_{given.ground}"
    output: Path = (given.output or default).resolve()
    executor = Executor(output, tools, given.jobs, again=True)
    cases = []
    for value in series or [""]:
        variables: dict[str, Value] = {"ground": given.ground}
        if value:
            variables[SERIES[test]] = value
        variables.update(given.variables)
        name = f"{SERIES[test]}_{value}" if value else ""
        cases.append(laboratory_case(name, test, PROJECT, variables))
    paths = []
    for material in given.continuum:
        for value in (series if test == "triaxial" else []) or [""]:
            name = f"point_{material.stem}_{value}"
            paths.append(law_case(name, test, material, value or CONFINEMENT))
    folders = [run.folder for run in executor.completed([*cases, *paths])]
    points = [str(folder) for folder in folders[len(cases) :]]
    found = report_tests(folders[: len(cases)], given.reference, points)
    print(found.report)
    target = output / "laboratory.png"
    draw_laboratory(found, target)
    print(target)


@command(
    argument("test", choices=sorted(SERIES), required=False, metavar="[TEST]", help=f"one of {', '.join(sorted(SERIES))}"),
    flag("--list", help="print tests and grounds"),
    option("--ground", default="sand_dry", show_default=True, help=f"one of {', '.join(grounds())}"),
    option("--series", metavar="VALUES", help=f"values, with commas: {', '.join(f'{t}: {n}' for t, n in SERIES.items())}"),
    option("--confinement", metavar="VALUES", help="the series of triaxial, extension, plane_strain and shear"),
    option("--continuum", parse=path, multiple=True, metavar="MATERIAL.yaml", help="the same path on a law, for comparison"),
    option("--reference", parse=path, help="reference.csv of an oedometer"),
    option("-v", "variables", nargs=2, parse=str, multiple=True, metavar="NAME VALUE", help="a variable of scene or ground"),
    option("-o", "--output", parse=path, help="folder of the results"),
    option("--jobs", parse=at_least(1), default=1, show_default=True, help="runs at a time"),
    option("--build", parse=path, help="default: $FURROW_BUILD, or build in the tree"),
    description=__doc__ or "",
)
def laboratory(given: Given) -> None:
    if given.list or not given.test:
        print("tests:", ", ".join(sorted(SERIES)), "\ngrounds:", ", ".join(grounds()))
        return
    given.variables = [(name, value.strip()) for name, value in given.variables]
    run_test(given)


def main() -> int:
    return start(laboratory, "laboratory/run.py")


if __name__ == "__main__":
    sys.exit(main())
