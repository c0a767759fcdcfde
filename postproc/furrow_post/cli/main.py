# SPDX-License-Identifier: GPL-2.0-or-later
"""The command furrow-post and its subcommands."""

import argparse
import os
import shutil
import sys
from pathlib import Path

from . import cross_commands
from .results import Results, ResultsError
from .summary import Summary


def _find_resistance_program():
    """furrow-resistance: beside furrow-post, in the build folder of the source tree, or on the PATH."""
    here = Path(sys.argv[0]).resolve().parent
    build = Path(os.environ.get("FURROW_BUILD", here.parent / "build"))
    for candidate in (here / "furrow-resistance", build / "bin" / "furrow-resistance"):
        if candidate.is_file():
            return str(candidate)
    found = shutil.which("furrow-resistance")
    if not found:
        raise ResultsError("furrow-resistance is not built or not installed; run 'bash inputs/run' once, or put it on the PATH")
    return found


def _resistance(arguments):
    program = _find_resistance_program()
    os.execv(program, [program] + arguments.words)


def _plot(arguments):
    from . import histories

    results = Results(arguments.results)
    target = arguments.output or results.folder / f"histories.{arguments.format}"
    histories.draw(results, target)
    print(target)


def _picture(arguments):
    from . import ground, picture

    results = Results(arguments.results)
    target = arguments.output or results.folder / f"rut.{arguments.format}"
    numbers = Summary(results.folder).line()
    if results.has_grains or not (results.folder / "ground.h5").is_file():
        picture.draw(results, numbers, target)
    else:
        ground.draw(results.folder, results.title, numbers, target)
    print(target)


def _ground(arguments):
    from . import ground

    folder = Path(arguments.results)
    folder = folder if folder.is_dir() else folder.parent
    target = arguments.output or folder / f"ground.{arguments.format}"
    title = Results(folder).title if (folder / "history.h5").is_file() else folder.resolve().name
    print(ground.text(ground.draw(folder, title, Summary(folder).line(), target)))
    print(target)


def _laboratory(arguments):
    from . import laboratory, laboratory_figures

    tests, measured, points, text = laboratory.report(arguments.folders, arguments.reference, arguments.point)
    print(text)
    target = arguments.output or tests[0].folder / f"laboratory.{arguments.format}"
    laboratory_figures.draw(tests, measured, points, target)
    print(target)


def _parser():
    parser = argparse.ArgumentParser(prog="furrow-post", description="Steady values, plots and pictures of Furrow's results folders.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="command")
    resistance = commands.add_parser("resistance", add_help=False,
                                     help="steady sinkage, motion resistance and torque with standard errors (furrow-resistance)")
    resistance.add_argument("words", nargs=argparse.REMAINDER)
    resistance.set_defaults(run=_resistance)
    for name, run, text in (("plot", _plot, "forces, sinkage, torque and slip against time -> histories.png"),
                            ("picture", _picture, "the rut from four sides, grains coloured by displacement, continuum by density -> rut.png"),
                            ("ground", _ground, "density sections, tracers and densities of the rut of continuum ground -> ground.png")):
        command = commands.add_parser(name, help=text, description=text)
        command.add_argument("results", help="results folder of a run, or its history.h5")
        command.add_argument("-o", "--output", type=Path, help="file to write (default: in the results folder)")
        command.add_argument("--format", choices=("png", "svg", "pdf"), default="png", help="format (default: png)")
        command.set_defaults(run=run)
    text = "moduli, strengths, repose or run-out of laboratory tests with their errors -> laboratory.json, laboratory.png"
    command = commands.add_parser("laboratory", help=text, description=text)
    command.add_argument("folders", nargs="+", metavar="results", help="results folders of one test of inputs/laboratory")
    command.add_argument("--reference", type=Path, help="reference.csv of an oedometer, with columns rho_kgm3 and sigma1_Pa")
    command.add_argument("--point", action="append", default=[], help="results folder of furrow-point with the same path, to lay beside")
    command.add_argument("-o", "--output", type=Path, help="figure to write (default: in the first folder)")
    command.add_argument("--format", choices=("png", "svg", "pdf"), default="png", help="format (default: png)")
    command.set_defaults(run=_laboratory)
    cross_commands.add(commands)
    return parser


def main(words):
    # The words of "resistance" belong to furrow-resistance, options included.
    arguments = argparse.Namespace(words=words[1:], run=_resistance) if words[:1] == ["resistance"] else _parser().parse_args(words)
    try:
        arguments.run(arguments)
    except (ResultsError, OSError) as error:
        print(f"furrow-post: {error}", file=sys.stderr)
        return 1
    return 0
