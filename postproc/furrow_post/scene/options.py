# SPDX-License-Identifier: GPL-2.0-or-later
"""Options of a run that belong together."""

import os
import sys
from collections.abc import Iterator, Sequence
from typing import Any

from ..errors import ResultsError
from ..programs import CALLED

MOST_RANKS_ON_A_CORE = 4
OF_SWEEPS = ("samples", "packings", "jobs", "submit", "again", "check", "formula", "measured", "point")


def called() -> str:
    """Command by which a user starts this program."""
    return os.environ.get(CALLED, "furrow-post run")


def require_fitting(options: Any) -> None:
    """Completes the options of a run. @raises ResultsError for what they do not allow together"""
    options.given = [(name, value.strip()) for name, value in options.given]
    scenes: Sequence[str] = options.scene
    if not all(scene.strip() for scene in scenes):
        raise ResultsError("an argument is empty; name a scene, or leave it out")
    if len(scenes) > 1:
        raise ResultsError(f"'{scenes[0]}' and '{scenes[1]}' are two scenes; name one")
    options.scene = scenes[0] if scenes else ""
    for broken, message in _rules(options):
        if broken:
            raise ResultsError(message)
    options.ranks = _affordable(options.ranks or 1)


def _rules(options: Any) -> Iterator[tuple[Any, str]]:
    """Conditions that must not hold, and the message of each."""
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
    alone = not options.sweep and not options.point
    for option, value in of_scenes.items():
        yield value and not options.scene and not options.point, f"{option} belongs to a scene; name one"
    for name in OF_SWEEPS:
        yield alone and getattr(options, name), f"--{name} belongs to --sweep; give that too"
    yield (
        alone and options.time_limit and not options.until_steady,
        "--time-limit belongs to --until-steady or --sweep; give one of them",
    )
    wanted = "--error" if options.error else "--time" if options.time else ""
    yield options.dry_run and not wanted, "--dry-run prints the plan for --error or --time; give one of them"
    yield options.sweep and wanted, f"{wanted} chooses one run; with --sweep give sizes by -v"
    yield (
        options.continues and (wanted or options.ranks),
        f"--continue takes sizes and ranks from the run; leave out {wanted or '-n'}",
    )
    yield options.quick and wanted, f"--quick and {wanted} both choose sizes; give one of them"
    yield (
        options.sweep and (options.continues or options.checkpoint),
        "--checkpoint and --continue belong to one run; a sweep keeps its finished points, so the same command "
        "resumes it",
    )


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
