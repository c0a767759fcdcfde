# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post run: runs a scene and shows its results."""

import importlib
from typing import Any

import click

from ..arguments import at_least, fraction, path, seconds
from ..scene.catalogue import listing, scene_names
from ..scene.command import run_scene
from .parameters import Given, argument, command, flag, option

DESCRIPTION = """\
Runs a scene and shows its results. Without a scene: the tyre of Shoop (2001) on 20 cm of snow, with
measurements and NRMM, and its rigid wheel on fresh snow as continuum and as grains."""


def _complete_scene(_: click.Context, __: click.Parameter, incomplete: str) -> list[str]:
    return [name for name in scene_names() if name.startswith(incomplete)]


def _of_sweep(*names: str, help: str, **more: Any) -> Any:
    return option(*names, help=f"[sweep] {help}", **more)


@command(
    argument(
        "scene",
        "one of the list below, or the path of a LIGGGHTS script",
        str,
        nargs=-1,
        metavar="[SCENE]",
        shell_complete=_complete_scene,
    ),
    flag("--quick", help="a small, coarse version, done within a minute"),
    option("-n", "ranks", metavar="RANKS", parse=at_least(1), once=True, help="MPI ranks (default 1)"),
    option(
        "-o",
        "--output",
        "folder",
        metavar="FOLDER",
        parse=path,
        once=True,
        help="where results go (default: results/SCENE)",
    ),
    option(
        "-v",
        "given",
        nargs=2,
        parse=str,
        multiple=True,
        metavar="NAME VALUE",
        help="sets a variable of the script, e.g. -v speed 0.2; 'furrow-post variables SCRIPT' lists them",
    ),
    option(
        "--error",
        metavar="PERCENT",
        parse=fraction,
        once=True,
        help="chooses size and travel for this whole error of hub drop and coefficient, e.g. 10%, by a pilot run in "
        "coarser cells; prints a forecast, and at the end whether it was reached and what limits it",
    ),
    option("--time", metavar="TIME", parse=seconds, once=True, help="the least error within this time of one core, e.g. 10min"),
    flag("--dry-run", help="of --error and --time: makes the pilot run and prints the plan alone"),
    option(
        "--until-steady",
        metavar="PERCENT",
        parse=fraction,
        once=True,
        help="continues until hub drop and resistance are steady within this standard error, e.g. 3%",
    ),
    option(
        "--time-limit",
        metavar="TIME",
        parse=seconds,
        once=True,
        help="of --until-steady or of each point of a sweep, e.g. 2h",
    ),
    option(
        "--checkpoint",
        metavar="TIME",
        parse=seconds,
        once=True,
        help="writes a checkpoint at this interval, e.g. 10min; a run that is stopped writes one too",
    ),
    flag(
        "--continue",
        "continues",
        help="continues a stopped run from its last checkpoint, with its variables and ranks",
    ),
    flag("--no-pictures", help="draws no pictures of the results"),
    flag("--no-build", help="for inputs/run: runs the programs that were built last"),
    _of_sweep(
        "--sweep",
        parse=str,
        multiple=True,
        metavar="NAME=VALUES",
        help="a run for each value: FIRST:LAST:COUNT or VALUE,VALUE,...; several --sweep give each combination. "
        "Finished points are kept, so the same command resumes a sweep (inputs/sweep/README.md)",
    ),
    _of_sweep(
        "--samples",
        metavar="N",
        parse=at_least(2),
        once=True,
        help="N points that fill the box of several --sweep NAME=FIRST:LAST, for 'furrow-post surrogate'",
    ),
    _of_sweep(
        "--packings", metavar="N", parse=at_least(1), once=True, help="each point with N packings of its grains"
    ),
    _of_sweep(
        "--jobs",
        metavar="N",
        parse=at_least(1),
        once=True,
        help="runs at a time (default 1; with --submit: no limit)",
    ),
    _of_sweep("--submit", choices=("slurm",), once=True, help="runs the points as an array job of Slurm"),
    flag("--again", help="[sweep] repeats points that failed"),
    flag("--check", help="[sweep] checks the sweep and runs nothing"),
    _of_sweep(
        "--formula",
        parse=str,
        multiple=True,
        metavar="NAME",
        help="adds nrmm:PRESSURE, bekker:TERRAIN or wong_reece:TERRAIN",
    ),
    _of_sweep(
        "--measured",
        parse=path,
        multiple=True,
        metavar="FILE",
        help="adds measured points: CSV with the columns of sweep.csv",
    ),
    option("--point", hidden=True, parse=str, help="a task of an array job makes this point"),
    description=DESCRIPTION,
    closing=lambda: f"Scenes:\n{listing()}",
)
def run(given: Given) -> int:
    return run_scene(given, post)


def post(*words: object) -> int:
    """Another command of furrow-post in this process. @raises ResultsError"""
    main = importlib.import_module(".main", __package__)
    status = main.root.main(list(map(str, words)), prog_name=main.NAME, standalone_mode=False)
    return status or 0
