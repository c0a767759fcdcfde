# SPDX-License-Identifier: GPL-2.0-or-later
"""The command furrow-post: finds the module of a subcommand, which has all the rest."""

import argparse
import importlib
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, cast

from .. import __version__
from ..program import run_program
from .examples import epilog

DESCRIPTION = "Steady values, plots, pictures and comparisons of Furrow's results folders."


@dataclass(frozen=True)
class Subcommand:
    """One subcommand: the module of its name, or of this file, has its arguments and what it does."""

    name: str
    help: str
    aliases: tuple[str, ...] = ()
    file: str = ""

    @property
    def module(self) -> str:
        return self.file or self.name.replace("-", "_")


class Module(Protocol):
    """What the module of a subcommand has."""

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        ...

    def run(self, arguments: argparse.Namespace) -> int | None:
        """The exit status; None is 0. @raises ResultsError, OSError"""


# Their options go to another parser, which begins after "--"
PASSED_ON = ("run", "resistance")

SUBCOMMANDS = (
    Subcommand("run", "runs a scene and shows its results: what 'bash inputs/run' does after the build"),
    Subcommand(
        "resistance",
        "steady hub drop, resistance and torque with standard errors (furrow-resistance)",
    ),
    Subcommand("export", "histories as CSV with units in the head, all channels or some -> history.csv"),
    Subcommand("plot", "forces, depths, torque and slip against time or place -> histories.png"),
    Subcommand(
        "picture",
        "the rut from four sides, grains coloured by displacement, continuum by density -> rut.png",
    ),
    Subcommand(
        "terrain",
        "density, tracers, stress and densities of the rut of continuum terrain "
        "-> terrain.png, terrain_stress.png",
        ("ground",),
    ),
    Subcommand(
        "laboratory",
        "moduli, strengths, repose or run-out of laboratory tests with their errors "
        "-> laboratory.json, laboratory.png",
    ),
    Subcommand("point", "the figure of furrow-point -> point.png or fit.png", file="figure"),
    Subcommand("sidewall", "the figure of furrow-sidewall -> sidewall.png", file="figure"),
    Subcommand("modes", "the natural modes of furrow-tyre --modes -> <state>_modes.png", file="figure"),
    Subcommand(
        "fit-law",
        "parameters of a law from measured curves (furrow-point fit) "
        "-> material.yaml, report.txt, fit.csv, .h5, .png",
    ),
    Subcommand("fit-tyre", "a tyre file from size, catalogue and load-deflection points"),
    Subcommand(
        "empirical", "what an empirical formula says: NRMM for snow, Bekker and Wong-Reece for sand"
    ),
    Subcommand(
        "compare",
        "the same scene on several grounds: table, verdict, figure -> compare.txt, .csv, .h5, .png",
    ),
    Subcommand(
        "flow",
        "displacement and density of two grounds under one wheel, and their difference "
        "-> flow.csv, .h5, .png",
    ),
    Subcommand(
        "compaction",
        "stress and density at depth below the track, with Boussinesq and Soehne "
        "-> compaction.csv, .png",
    ),
    Subcommand(
        "sweep",
        "curves over slip, load, pressure, depth or speed of folders of runs "
        "-> sweep.csv, .h5, .png, report.html",
    ),
    Subcommand("surrogate", "a fast model of a wheel from sweeps, with checked intervals -> surrogate.json, .png"),
    Subcommand("map", "go, pull, speed and energy of a wheel on a terrain raster -> map.tif, map.png, mobility.csv"),
    Subcommand("identify", "soil parameters from wheel tests, by a surrogate -> posterior.csv, posterior.png"),
    Subcommand(
        "cost", "error against cost of the runs of a scene, and which to take -> cost.png, cost.csv"
    ),
    Subcommand("study", "the studies under inputs: their runs, tables and the values in pages"),
    Subcommand("plan", "the runs that bring a scene's error down to a goal most cheaply"),
    Subcommand(
        "choose",
        "for 'inputs/run SCENE --error': the run of a table to make, and whether its estimate held",
    ),
    Subcommand(
        "variables", "the variables of a script that 'inputs/run SCRIPT -v NAME VALUE' may set"
    ),
    Subcommand("fmu", "a script of one wheel as a co-simulation FMU (FMI 2.0, 3.0) -> <script>.fmu"),
    Subcommand(
        "view",
        "one or two runs in 3D, in one self-contained page: time, colours, cut -> view.html",
    ),
    Subcommand("film", "the frames of a run as a film (ffmpeg) -> film.mp4"),
    Subcommand(
        "report",
        "one self-contained page on runs and their comparison "
        "-> report.html, report.csv, report.h5",
    ),
)


def parser(chosen: str) -> argparse.ArgumentParser:
    """The command line; of the subcommands only the chosen one has its arguments.

    Its module alone is loaded, so that a command without figures does not wait for matplotlib.
    """
    whole = argparse.ArgumentParser(prog="furrow-post", description=DESCRIPTION)
    whole.add_argument("--version", action="version", version=f"furrow-post {__version__}")
    commands = whole.add_subparsers(dest="command", required=True, metavar="command")
    for entry in SUBCOMMANDS:
        command = commands.add_parser(
            entry.name,
            aliases=entry.aliases,
            help=entry.help,
            description=entry.help,
            epilog=epilog(entry.name),
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        if chosen in (entry.name, *entry.aliases):
            module = cast(Module, importlib.import_module(f".{entry.module}", __package__))
            module.add_arguments(command)
            command.set_defaults(run=module.run)
    return whole


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a subcommand; the result is the exit status."""
    given = list(sys.argv[1:] if arguments is None else arguments)

    def run() -> int | None:
        if given and given[0] in PASSED_ON:
            given.insert(1, "--")
        parsed = parser(given[0] if given else "").parse_args(given)
        status: int | None = parsed.run(parsed)
        return status

    return run_program("furrow-post", run)
