# SPDX-License-Identifier: GPL-2.0-or-later
"""All commands of furrow-post by subject; the module of a command is imported when it is used."""

import difflib
import importlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

import click

from .parameters import Command


@dataclass(frozen=True)
class Entry:
    """Command: its arguments, its module in this folder, and its former names."""

    path: str
    module: str
    help: str
    examples: tuple[str, ...] = ("",)
    former: tuple[str, ...] = ()

    def load(self) -> Command:
        module = importlib.import_module(f".{self.module}", __package__)
        name = self.path.replace(" ", "_")
        found = next(v for v in vars(module).values() if isinstance(v, Command) and v.function == name)
        found.name = self.path.split()[-1]
        found.help = self.help[0].upper() + self.help[1:]
        found.examples = self.examples
        return found


COMMANDS: dict[str, tuple[Entry, ...]] = {
    "Runs": (
        Entry("run", "run_commands",
              "runs a scene or a sweep of it, and shows its results",
              ("wheel_on_snow --quick", "tyre_on_plane --sweep slip=0:0.2:3 -o results/pull")),
        Entry("answer", "answer_command",
              "pull, resistance and rut of a tyre on sand or clay, from its size and a cone index, with the formulas",
              ("265/70R17 --load 6000 --pressure 200 --soil sand --cone-index 300 --slip 0.2 --error 10%",)),
        Entry("variables", "shell_commands",
              "the variables of a script that 'run SCRIPT -v NAME VALUE' may set",
              ("inputs/scenes/wheel_on_snow.lig",)),
        Entry("fmu", "fmu_command",
              "a script of one wheel as a co-simulation FMU (FMI 2.0, 3.0) -> <script>.fmu",
              ("inputs/guide/howto/vehicle/wheel.lig -o results/wheel.fmu",)),
        Entry("study", "study_command",
              "the studies under inputs: their runs, tables and the values in pages",
              ("", "snow_oedometer", "snow_plate fresh_fine --results results/plate", "--pages --check")),
    ),
    "One run": (
        Entry("resistance", "value_commands",
              "steady hub drop, resistance and torque with standard errors (furrow-resistance)",
              ("results/a", "--csv results/a results/b", "--distance 0.5 1.2 results/a")),
        Entry("budget", "value_commands",
              "the whole error of each value, with its parts and the nearest tests",
              ("results/a", "results/a --json")),
        Entry("plot", "picture_commands",
              "forces, depths, torque and slip against time or place -> histories.png",
              ("results/a", "results/a --against x -o forces.svg")),
        Entry("picture", "picture_commands",
              "the rut from four sides, grains coloured by displacement, continuum by density -> rut.png",
              ("results/a",)),
        Entry("terrain", "picture_commands",
              "density, tracers, stress and densities of the rut of continuum terrain -> terrain.png, "
              "terrain_stress.png",
              ("results/a --format pdf",),
              ("ground",)),
        Entry("view", "picture_commands",
              "one or two runs in 3D, in one self-contained page: time, colours, cut -> view.html",
              ("results/a", "results/a results/b -o both.html")),
        Entry("film", "picture_commands",
              "the frames of a run as a film (ffmpeg) -> film.mp4",
              ("results/a film.mp4", "results/a --colour displacement --cut 0 --seconds 5")),
        Entry("export", "value_commands",
              "histories as CSV with units in the head, all channels or some -> history.csv",
              ("results/a", "results/a results/b --channels hub_drop,force_x -o both.csv")),
        Entry("report", "comparison_commands",
              "one self-contained page on runs and their comparison -> report.html, report.csv, report.h5",
              ("results/a", "continuum=results/a grains=results/b -o both.html")),
    ),
    "Several runs": (
        Entry("compare", "comparison_commands",
              "the same scene on several grounds: table, verdict, figure -> compare.txt, .csv, .h5, .png",
              ("continuum=results/a grains=results/b -o results/both",)),
        Entry("sweep", "comparison_commands",
              "curves over slip, load, pressure, depth or speed of folders of runs -> sweep.csv, .h5, .png, "
              "report.html",
              ("results/sweep", "continuum=results/a grains=results/b -o results/both")),
        Entry("flow", "comparison_commands",
              "displacement and density of two grounds under one wheel, and their difference -> flow.csv, .h5, .png",
              ("results/a results/b",)),
        Entry("compaction", "comparison_commands",
              "stress and density at depth below the track, with Boussinesq and Soehne -> compaction.csv, .png",
              ("results/a", "soft=results/a hard=results/b -o results/both")),
        Entry("converge", "run_commands",
              "a scene in three sizes of its cells or grains; later runs take the error of their size from it",
              ("wheel_on_snow", "my_wheel.lig -v cell 0.04 --jobs 2")),
        Entry("cost", "comparison_commands",
              "values, numerical errors and cost of the runs of a scene -> cost.png, cost.csv",
              ("coarse=results/a fine=results/b", "inputs/costs/wheel_on_snow.csv")),
    ),
    "Materials and tyres": (
        Entry("fit law", "fit_commands",
              "parameters of a law from measured curves (furrow-point fit) -> material.yaml, report.txt, fit.csv, "
              ".h5, .png",
              ("inputs/points/fit_abele_gow.yaml -o results/oedometer",),
              ("fit-law",)),
        Entry("fit tyre", "fit_commands",
              "a tyre file from size, catalogue and load-deflection points",
              ("235/75R15 --rim 6.5 --pressure 241 --point 241 6227 3.1 -o my_tyre.yaml",),
              ("fit-tyre",)),
        Entry("fit soil", "surrogate_commands",
              "soil parameters from wheel tests, by a surrogate -> posterior.csv, posterior.png",
              ("wheel.json tests.csv --set c=250 -o results/soil",),
              ("identify",)),
        Entry("card make", "soil_commands",
              "a soil card of a ground: runs plates, shear ring and cone -> card.yaml, card.html",
              ("dry_sand_smooth -o results/card --export chrono altair table", "sand_cmu -o results/card_of_grains")),
        Entry("card material", "soil_commands",
              "a material file from soil data, checked by a virtual test",
              ("my_sand.yaml --c 500 --phi 33 --density 1600 --oedometer oedometer.csv",
               "my_loam.yaml --k_c 5270 --k_phi 1515040 --n 0.7 --c 1720 --phi 29 --K 0.025",
               "my_clay.yaml --cone_index 4e5 --class CL --no-check")),
        Entry("card export", "soil_commands", "a card for vehicle codes", ("results/card/card.yaml chrono",)),
        Entry("card table", "soil_commands", "cards as a table in Markdown", ("results/card/card.yaml",)),
        Entry("card rft", "soil_commands", "strength of a card's sand for contact/rft", ("inputs/soils/grc1.yaml --sinkage 0.03",)),
        Entry("laboratory", "soil_commands",
              "moduli, strengths, repose or run-out of laboratory tests with their errors -> laboratory.json, "
              "laboratory.png",
              ("results/laboratory/oedometer_sand_dry",)),
    ),
    "Vehicles": (
        Entry("empirical", "empirical_command",
              "the answer of an empirical formula: NRMM for snow, Bekker and Wong-Reece for sand, ...",
              ("nrmm --load 6e3 --diameter 0.74 --width 0.27 --depth 0.2 --density 200 --pressure 179e3",)),
        Entry("surrogate", "surrogate_commands",
              "a fast model of a wheel from sweeps, with checked intervals -> surrogate.json, .png",
              ("results/a -o wheel.json", "fast.csv --better good.csv -o wheel.json", "wheel.json --at slip=0.2 load=600")),
        Entry("map", "surrogate_commands",
              "go, pull, speed and energy of a wheel on a terrain raster -> map.tif, map.png, mobility.csv",
              ("wheel.json dem.tif --classes soil.tif soils.csv --load 600 -o results/map",)),
        Entry("slopes", "surrogate_commands",
              "slip and hub drop of a wheel over slope and load, and where it digs in -> slopes.csv, slopes.png",
              ("wheel.json --slope 0:25 --load 100:250:4 -o results/slopes",)),
    ),
    "Other": (
        Entry("figure", "shell_commands",
              "the figure of furrow-point, furrow-sidewall or furrow-tyre --modes",
              ("point results/snow_oedometer", "modes results/at_rest"),
              ("point", "sidewall", "modes")),
        Entry("completion", "shell_commands", "the lines that complete words in a shell", ("bash",)),
    ),
}  # fmt: skip
GROUPS = {"fit": "fits laws, tyres and soils to measurements", "card": "soil cards and material files"}
KEPT = ("point", "sidewall", "modes")  # former names that are the first argument of the new command


def entries() -> list[Entry]:
    return [entry for group in COMMANDS.values() for entry in group]


class Group(click.Group):
    """Commands whose paths begin with some words; at the top with headings."""

    def __init__(self, words: Sequence[str] = (), **settings: Any) -> None:
        super().__init__(**settings)
        self.words = tuple(words)

    def _further(self, entry: Entry) -> list[str]:
        """The words of a command behind those of this group; none where it is not in it."""
        path, count = entry.path.split(), len(self.words)
        return path[count:] if tuple(path[:count]) == self.words else []

    def _below(self) -> dict[str, list[Entry]]:
        """Next word of a command -> commands that have it."""
        found: dict[str, list[Entry]] = {}
        for entry in entries():
            for word in self._further(entry)[:1]:
                found.setdefault(word, []).append(entry)
        return found

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(self._below())

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        found = self._below().get(cmd_name, [])
        if not found:
            return None
        path = (*self.words, cmd_name)
        if found[0].path == " ".join(path):
            return found[0].load()
        return Group(path, name=cmd_name, help=GROUPS[cmd_name])

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if not self.words and args:
            args = present_words(args)
        if args and args[0] not in self._below() and not ctx.resilient_parsing:
            self._refuse(ctx, args[0])
        return super().resolve_command(ctx, args)

    def _refuse(self, ctx: click.Context, word: str) -> NoReturn:
        names = self.list_commands(ctx)
        near = difflib.get_close_matches(word, names, n=2)
        hint = f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(names)}"
        raise click.UsageError(f"there is no command '{word}'; {hint}", ctx)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        for heading, group in COMMANDS.items():
            if rows := [(" ".join(words), entry.help) for entry in group if (words := self._further(entry))]:
                with formatter.section(heading if not self.words else "Commands"):
                    formatter.write_dl(rows)


def present_words(words: Sequence[str]) -> list[str]:
    """The words of a command line with the present name of its command; reports a former one."""
    for entry in entries():
        if words[0] in entry.former:
            kept = [words[0]] if words[0] in KEPT else []
            name = " ".join([entry.path, *kept])
            click.echo(f"furrow-post: '{words[0]}' is now 'furrow-post {name}'", err=True)
            return [*entry.path.split(), *kept, *words[1:]]
    return list(words)
