# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands fit law, a law from measured curves (furrow-point fit becomes this), and fit tyre, a tyre file from a
catalogue and tests."""

import importlib
import shlex
import sys
from pathlib import Path

import numpy as np

from ..laws.law_fit import fit_law, report, write_fit
from ..laws.point_curves import PROGRAM, PointCurves
from ..laws.tyre_estimate import Catalogue, hub_mass
from ..laws.tyre_fit import MEASURED, PlateTest, TyreFit, fit_tyre, press, read_tests
from ..laws.tyre_size import INCH, read_size
from ..arguments import inflation, path, positive
from ..errors import ResultsError
from .parameters import Given, argument, command, flag, option, target_option

MILLIMETRES = {  # option -> meaning, in the order of Catalogue
    "diameter": "of the new tyre; by default that of the size",
    "section-width": "by default that of the size",
    "tread-width": "by default 0.72 of the section width",
    "tread": "thickness of tread and undertread; by default 2.85 % of the diameter",
    "flange": "height of the rim's flange; by default 17",
}
CORRELATED = 0.8  # two parameters are reported together from this on
# Deflection under the rated load over the section's height: 0.16 of a skid steer's tyre (Mitas
# SK-05), 0.19 of [Goodyear2010], up to 0.29 of farm tyres (static loaded radii in bwt.uk.com)
USUAL_DEFLECTION = (0.12, 0.30)


@command(
    argument("file", "a YAML file with a fit; furrow-point paths lists its keys", path),
    target_option("the results folder; results/<name of the file> unless given"),
    flag("--no-plot", help="no figure"),
)
def fit_law_(given: Given) -> int:
    """1 where the fit did not converge; its results are written all the same."""
    folder: Path = given.output or Path("results") / given.file.stem
    with PointCurves(given.file) as point:
        for warning in point.warnings:
            print(f"{PROGRAM}: warning: {warning}", file=sys.stderr)
        fit = fit_law(point.parameters, point.curves, point)
        write_fit(point, fit, folder)
        print(f"{report(point, fit)}  results       {folder}")
    if not given.no_plot:  # importing matplotlib takes time
        (figure,) = importlib.import_module("..figures.point_figure", __package__).draw_point(folder)
        print(f"  figure        {figure}")
    return 0 if fit.converged else 1


@command(
    argument("size", "235/75R15, 31x10.50R15, 16.00R20, 18.4R38, ..."),
    option("--pressure", parse=inflation, required=True, help="inflation [kPa]"),
    option("--rim", parse=positive, help="rim width [inch]; by default 0.7 of the width"),
    option("--mass", parse=positive, help="of the tyre [kg]"),
    *(option(f"--{name}", parse=positive, help=f"[mm] {meaning}") for name, meaning in MILLIMETRES.items()),
    option("--point", parse=positive, nargs=3, multiple=True, metavar="KPA N CM", help="pressure, load and deflection: half the diameter less the static loaded radius"),
    option("--tests", parse=path, help=f"table (CSV) with pressure_kPa, load_N and any of {', '.join(MEASURED)}"),
    option("--load", parse=positive, help="rated load [N] at --pressure: reports the deflection"),
    option("--source", help="of the catalogue's values: a comment of the file"),
    option("--title", help="of the file; by default the size"),
    option("-o", "--output", parse=path, required=True, help="the tyre file; a new one"),
    flag("--check", help="check the arguments; fit nothing"),
)
def fit_tyre_(given: Given) -> None:
    output: Path = given.output
    if output.exists():
        raise ResultsError(f"{output} exists; give another name with -o, or remove it")
    if not output.parent.is_dir():
        raise ResultsError(f"{output.parent} is no folder; make it, or give another name with -o")
    known = _catalogue(given)
    tests = [PlateTest(pressure, load, {"deflection_cm": deflection}) for pressure, load, deflection in given.point]
    if given.tests is not None:
        tests += read_tests(given.tests)
    _require_possible(known, tests)
    if given.check:
        print(f"  checked       {known.size.designation}, {len(tests)} tests; nothing is fitted")
        return
    fit = fit_tyre(known, tests)
    print(_report(fit))
    title = given.title or known.size.designation
    comments = [given.source] if given.source else []
    comments += [f"furrow-post fit tyre {_command(given)}", *_comments(fit)]
    if given.load is not None:
        rated = _rated(fit, title, given.load)
        print(f"  rated load    {rated}")
        comments.append(f"Rated load: {rated}")
    output.write_text(fit.file_text(title, comments), encoding="utf-8")
    print(f"  tyre file     {output}")


def _command(given: Given) -> str:
    """The arguments that made the file, without texts and files."""
    words = [given.size]
    for name in ("pressure", "rim", "mass", *MILLIMETRES, "load"):
        if (value := getattr(given, name.replace("-", "_"))) is not None:
            words += [f"--{name}", f"{value:g}"]
    for point in given.point:
        words += ["--point", *(f"{value:g}" for value in point)]
    if given.tests is not None:
        words += ["--tests", given.tests.name]
    return shlex.join(words)


def _rated(fit: TyreFit, title: str, load: float) -> str:
    """Sentence on the deflection under the rated load and its usual range."""
    pressure = 1e-3 * fit.known.pressure
    (state,) = press(fit.file_text(title, []), [PlateTest(pressure, load, {})])
    share = state["deflection_cm"] / (100.0 * fit.known.height)
    text = (
        f"{load:g} N at {pressure:g} kPa, deflection {state['deflection_cm']:.1f} cm, "
        f"{100 * share:.0f} % of the section's height"
    )
    low, high = USUAL_DEFLECTION
    if low <= share <= high:
        return text
    return f"{text}; usual are {100 * low:.0f} to {100 * high:.0f} %: check load, pressure and size"


def _catalogue(given: Given) -> Catalogue:
    def metres(name: str, unit: float = 1e-3) -> float | None:
        value: float | None = getattr(given, name.replace("-", "_"))
        return None if value is None else unit * value

    measures: list[float | None] = [metres("rim", INCH), *map(metres, MILLIMETRES), given.mass]
    return Catalogue(read_size(given.size), 1e3 * given.pressure, *measures)


def _require_possible(known: Catalogue, tests: list[PlateTest]) -> None:
    """@raises ResultsError for a unit that is wrong by a factor"""
    diameter = known.size.diameter
    if known.diameter is not None and not 0.8 < known.diameter / diameter < 1.25:
        raise ResultsError(
            f"--diameter {1e3 * known.diameter:g} mm is not that of {known.size.designation}, "
            f"about {1e3 * diameter:.0f} mm; check the size and the unit"
        )
    for test in tests:
        deflection = 1e-2 * test.measured.get("deflection_cm", 0.0)
        if deflection >= 0.7 * known.height:
            raise ResultsError(
                f"a deflection of {100 * deflection:g} cm at {test.load:g} N is more than 0.7 of the "
                f"section's height, {100 * known.height:.1f} cm; give centimetres"
            )


def _report(fit: TyreFit) -> str:
    size = fit.known.size
    lines = [
        f"{size.designation}: by its size the section is {1e3 * size.width:.0f} mm wide and "
        f"{1e3 * size.height:.0f} mm high, the diameter {1e3 * size.diameter:.0f} mm",
        f"  {'parameter':18} {'value':>10} {'error':>7} {'by tests':>9}  guess",
    ]
    for parameter in fit.parameters:
        lines.append(
            f"  {parameter.name:18} {parameter.value:10.4g} {100 * parameter.error:6.1f}% "
            f"{100 * parameter.determined:8.0f}%  {parameter.guess.value:.4g} ± "
            f"{100 * parameter.guess.spread:.0f}%, {parameter.guess.source}"
        )
    if fit.tests:
        lines += _tests(fit)
    if (mass := hub_mass(fit.known)) is not None:
        lines.append(f"  mass          add {mass:.3g} kg of the tyre to the rim's mass in the script")
    return "\n".join(lines)


def _tests(fit: TyreFit) -> list[str]:
    values = ", ".join(f"{value:.2g}" for value in fit.singular_values)
    found = sum(value > 1.0 for value in fit.singular_values)
    lines = [
        f"  determined    {found} of {len(fit.parameters)} combinations of parameters, those with a "
        f"singular value above 1: {values}"
    ]
    names = [parameter.name for parameter in fit.parameters]
    for i, j in np.argwhere(np.tril(np.abs(fit.correlation), -1) > CORRELATED):
        lines.append(f"  correlated    {names[j]} and {names[i]}: {fit.correlation[i, j]:.2f}")
    lines.append(f"  {'pressure kPa':>14} {'load N':>8}  measured and fitted")
    for test, state in zip(fit.tests, fit.states):
        pairs = ", ".join(f"{name} {value:g} {state[name]:.4g}" for name, value in test.measured.items())
        lines.append(f"  {test.pressure:14g} {test.load:8g}  {pairs}")
    lines.append(f"  misfit (rms)  {_misfits(fit)}")
    if fit.stretch > 1.0:
        lines.append(
            f"  warning       the misfit is {fit.stretch:.1f} times the assumed errors of the tests, "
            "and the errors above are larger by this"
        )
    return lines


def _misfits(fit: TyreFit) -> str:
    return ", ".join(f"{name} {100 * value:.1f} %" for name, value in fit.misfits().items())


def _comments(fit: TyreFit) -> list[str]:
    if not fit.tests:
        return ["Estimate by furrow-post fit tyre from the size and a catalogue, without a test."]
    return [
        f"By furrow-post fit tyre from the size, a catalogue and {len(fit.tests)} states on a plane.",
        f"Misfit (rms): {_misfits(fit)}. In brackets: standard errors.",
    ]
