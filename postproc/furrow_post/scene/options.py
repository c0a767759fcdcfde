# SPDX-License-Identifier: GPL-2.0-or-later
"""The command line of 'furrow-post run', which inputs/run passes on."""

import argparse
import os
import re
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from ..arguments import (
    at_least,
    fraction,
    has_control_characters,
    path,
    seconds,
    shield_negative_numbers,
)
from ..errors import ResultsError
from .catalogue import listing

CALLED = "FURROW_CALLED"  # environment variable: how the user started this program
MOST_RANKS_ON_A_CORE = 4
# What an option needs, where its value is missing or empty
NEEDS = {
    "-n": "the number of ranks",
    "-o": "a folder",
    "-v": "a name and a value",
    "--error": "a relative error, e.g. 10%",
    "--sweep": "a variable and its values, e.g. slip=-0.3:0.6:10",
    "--until-steady": "a relative error, e.g. 3%",
    "--time-limit": "a time, e.g. 2h",
    "--checkpoint": "a time, e.g. 10min",
}
DESCRIPTION = """\
Runs a scene and shows its results. Without a scene: the tyre of Shoop (2001) on 20 cm of snow, with
measurements and NRMM, and its rigid wheel on fresh snow as continuum and as grains."""
OF_SWEEPS = ("samples", "packings", "jobs", "submit", "again", "check", "formula", "measured", "point")


def called() -> str:
    """How a user starts this program."""
    return os.environ.get(CALLED, "furrow-post run")


class _Parser(argparse.ArgumentParser):
    """Faults are ResultsErrors that begin with the option."""

    def error(self, message: str) -> NoReturn:
        found = re.fullmatch(r"argument (\S+?): (.*)", message, re.DOTALL)
        if not found:
            unknown = message.removeprefix("unrecognized arguments: ")
            if unknown == message:
                raise ResultsError(message)
            raise ResultsError(f"does not know '{unknown}'; '{called()} --help' lists the options")
        option, text = found.groups()
        if text.startswith(("expected", "''")) or text == "is empty":
            raise ResultsError(f"{option} needs {NEEDS.get(option, 'a value')}")
        raise ResultsError(f"{option} {text}" if text.startswith("is ") else f"{option}: {text}")


class _Once(argparse.Action):
    """An option that may be given once."""

    def __call__(
        self, parser: argparse.ArgumentParser, namespace: argparse.Namespace, values: Any, option_string: Any = None
    ) -> None:
        if getattr(namespace, self.dest) is not self.default:
            raise argparse.ArgumentError(self, "is given twice; give it once")
        setattr(namespace, self.dest, values)


def _ranks(text: str) -> int:
    try:
        return at_least(1)(text)
    except argparse.ArgumentTypeError:
        raise argparse.ArgumentTypeError(f"'{text.strip()}' is no whole number of ranks") from None


def _parser() -> argparse.ArgumentParser:
    found = _Parser(
        prog=called(),
        usage=f"{called()} [scene] [options]",
        description=DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    add = found.add_argument
    add("scene", nargs="*", help="one of the list below, or the path of a LIGGGHTS script")
    add("--quick", action="store_true", help="a small, coarse version, done within a minute")
    add("-n", dest="ranks", metavar="RANKS", type=_ranks, action=_Once, help="MPI ranks (default 1)")
    add("-o", dest="folder", metavar="FOLDER", type=path, action=_Once, help="where results go (default: results/SCENE)")
    add(
        *("-v",),
        dest="given",
        nargs=2,
        action="append",
        default=[],
        metavar=("NAME", "VALUE"),
        help="sets a variable of the script, e.g. -v speed 0.2; 'furrow-post variables SCRIPT' lists them",
    )
    add(
        "--error",
        metavar="PERCENT",
        type=fraction,
        action=_Once,
        help="chooses ground, size and kind of wheel for this numerical error, e.g. 10%%, from the measured "
        "runs in inputs/costs; prints the reasons, and at the end whether the estimate was right",
    )
    add(
        "--until-steady",
        metavar="PERCENT",
        type=fraction,
        action=_Once,
        help="continues until hub drop and resistance are steady within this standard error, e.g. 3%%",
    )
    add("--time-limit", metavar="TIME", type=seconds, action=_Once, help="of --until-steady or of each point of a sweep, e.g. 2h")
    add(
        "--checkpoint",
        metavar="TIME",
        type=seconds,
        action=_Once,
        help="writes a checkpoint at this interval, e.g. 10min; a run that is stopped writes one too",
    )
    add(
        "--continue",
        dest="continues",
        action="store_true",
        help="continues a stopped run from its last checkpoint, with its variables and ranks",
    )
    add("--no-pictures", action="store_true", help="draws no pictures of the results")
    add("--no-build", action="store_true", help="runs the programs that were built last")
    sweep = found.add_argument_group("sweeps (inputs/sweep/README.md)")
    add = sweep.add_argument
    add(
        "--sweep",
        action="append",
        default=[],
        metavar="NAME=VALUES",
        help="a run for each value: FIRST:LAST:COUNT or VALUE,VALUE,...; several --sweep give each combination. "
        "Finished points are kept, so the same command resumes a sweep",
    )
    add(
        "--samples",
        metavar="N",
        type=at_least(2),
        action=_Once,
        help="N points that fill the box of several --sweep NAME=FIRST:LAST, for 'furrow-post surrogate'",
    )
    add("--packings", metavar="N", type=at_least(1), action=_Once, help="each point with N packings of its grains")
    add("--jobs", metavar="N", type=at_least(1), action=_Once, help="runs at a time (default 1; with --submit: no limit)")
    add("--submit", choices=("slurm",), action=_Once, help="runs the points as an array job of Slurm")
    add("--again", action="store_true", help="repeats points that failed")
    add("--check", action="store_true", help="checks the sweep and runs nothing")
    add("--formula", action="append", default=[], metavar="NAME", help="adds nrmm:PRESSURE, bekker:TERRAIN or wong_reece:TERRAIN")
    add("--measured", action="append", default=[], type=path, metavar="FILE", help="adds measured points: CSV with the columns of sweep.csv")
    for name in ("--point", "--prepare"):  # of job scripts; of inputs/run
        add(name, help=argparse.SUPPRESS, **({} if name == "--point" else {"action": "store_true"}))  # type: ignore[arg-type]
    found.epilog = f"scenes:\n{listing()}"
    return found


def parse(given: Sequence[str]) -> argparse.Namespace:
    """@raises ResultsError for what the options do not allow, alone or together"""
    for word in given:
        if has_control_characters(word):
            raise ResultsError(f"{word!r} has a line break or another control character; leave it out")
    options = _parser().parse_intermixed_args(shield_negative_numbers(given))
    options.given = [(name, value.strip()) for name, value in options.given]
    _require_one_scene(options)
    _require_fitting(options)
    return options


def _require_one_scene(options: argparse.Namespace) -> None:
    """Makes options.scene one word, or empty. @raises ResultsError"""
    scenes: list[str] = options.scene
    if not all(scene.strip() for scene in scenes):
        raise ResultsError("an argument is empty; name a scene, or leave it out")
    if len(scenes) > 1:
        raise ResultsError(f"'{scenes[0]}' and '{scenes[1]}' are two scenes; name one")
    options.scene = scenes[0] if scenes else ""
    of_scenes = {
        "-n": options.ranks,
        "-v": options.given,
        "--error": options.error,
        "--sweep": options.sweep,
        "--until-steady": options.until_steady,
        "--checkpoint": options.checkpoint,
        "--continue": options.continues,
    }
    if not options.scene and not options.point:
        for option, value in of_scenes.items():
            if value:
                raise ResultsError(f"{option} belongs to a scene; name one")


def _require_fitting(options: argparse.Namespace) -> None:
    """@raises ResultsError"""
    if not options.sweep and not options.point:
        for name in OF_SWEEPS:
            if getattr(options, name):
                raise ResultsError(f"--{name} belongs to --sweep; give that too")
        if options.time_limit and not options.until_steady:
            raise ResultsError("--time-limit belongs to --until-steady or --sweep; give one of them")
    if options.sweep and options.error:
        raise ResultsError("--error chooses one run; with --sweep give sizes by -v")
    if options.continues and (options.error or options.ranks):
        raise ResultsError("--continue takes the scene's choice and ranks from the run; leave out --error and -n")
    if options.sweep and (options.continues or options.checkpoint):
        raise ResultsError(
            "--checkpoint and --continue belong to one run; a sweep keeps its finished points, so the same "
            "command resumes it"
        )
    if options.quick and options.error:
        raise ResultsError("--quick and --error both choose sizes; give one of them")
    options.ranks = _affordable(options.ranks or 1)


def _affordable(ranks: int) -> int:
    """@raises ResultsError for more ranks than this machine can take"""
    cores = len(os.sched_getaffinity(0))
    if ranks > MOST_RANKS_ON_A_CORE * cores:
        raise ResultsError(
            f"-n {ranks}: this machine has {cores} core(s), more than four ranks on each would crawl; "
            f"take at most {MOST_RANKS_ON_A_CORE * cores}"
        )
    if ranks > cores:
        print(
            f"WARNING: {ranks} ranks on {cores} core(s) wait for each other; -n {cores} is the fastest here.",
            file=sys.stderr,
        )
    return ranks
