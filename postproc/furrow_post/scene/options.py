# SPDX-License-Identifier: GPL-2.0-or-later
"""Options of a run that belong together."""

import os
import sys
from collections.abc import Sequence
from typing import Any

from ..errors import ResultsError
from ..programs import CALLED

MOST_RANKS_ON_A_CORE = 4
OF_SWEEPS = ("samples", "packings", "jobs", "submit", "again", "check", "formula", "measured", "point")


def called() -> str:
    """How a user starts this program."""
    return os.environ.get(CALLED, "furrow-post run")


def require_fitting(options: Any) -> None:
    """Completes the options of a run. @raises ResultsError for what they do not allow together"""
    options.given = [(name, value.strip()) for name, value in options.given]
    _require_one_scene(options)
    _require_sweep(options)


def _require_one_scene(options: Any) -> None:
    """Makes options.scene one word, or empty. @raises ResultsError"""
    scenes: Sequence[str] = options.scene
    if not all(scene.strip() for scene in scenes):
        raise ResultsError("an argument is empty; name a scene, or leave it out")
    if len(scenes) > 1:
        raise ResultsError(f"'{scenes[0]}' and '{scenes[1]}' are two scenes; name one")
    options.scene = scenes[0] if scenes else ""
    of_scenes = {
        "-n": options.ranks,
        "-v": options.given,
        "--error": options.error,
        "--time": options.time,
        "--sweep": options.sweep,
        "--until-steady": options.until_steady,
        "--checkpoint": options.checkpoint,
        "--continue": options.continues,
    }
    if not options.scene and not options.point:
        for option, value in of_scenes.items():
            if value:
                raise ResultsError(f"{option} belongs to a scene; name one")


def _require_sweep(options: Any) -> None:
    """@raises ResultsError"""
    if not options.sweep and not options.point:
        for name in OF_SWEEPS:
            if getattr(options, name):
                raise ResultsError(f"--{name} belongs to --sweep; give that too")
        if options.time_limit and not options.until_steady:
            raise ResultsError("--time-limit belongs to --until-steady or --sweep; give one of them")
    _require_plan(options)
    if options.sweep and (options.continues or options.checkpoint):
        raise ResultsError(
            "--checkpoint and --continue belong to one run; a sweep keeps its finished points, so the same "
            "command resumes it"
        )
    options.ranks = _affordable(options.ranks or 1)


def _require_plan(options: Any) -> None:
    """@raises ResultsError"""
    wanted = "--error" if options.error else "--time" if options.time else ""
    if options.dry_run and not wanted:
        raise ResultsError("--dry-run prints the plan for --error or --time; give one of them")
    if options.sweep and wanted:
        raise ResultsError(f"{wanted} chooses one run; with --sweep give sizes by -v")
    if options.continues and (wanted or options.ranks):
        raise ResultsError(f"--continue takes sizes and ranks from the run; leave out {wanted or '-n'}")
    if options.quick and wanted:
        raise ResultsError(f"--quick and {wanted} both choose sizes; give one of them")


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
