# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of a sweep: the request, checked against the script, and its cases."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import ResultsError
from ..run.case import RESULTS, Case, scene_case
from ..run.script import RESERVED, ScriptVariables, check_variables, require_files, script_variables
from .sweep_plan import PlannedRun, SweepPlan, points_of
from .sampling import sampled
from .sweep_values import further_seeds, parse_variables, product

SEED = "seed"  # the variable of a script that chooses the packing of its grains
MOTION = "motion"  # the variable of a script that has the mode of its rig
DRIVEN = {"slip": "mode slip slip {}", "torque": "mode torque torque {}"}  # values of MOTION


@dataclass(frozen=True)
class SweepRequest:
    """Request of the command line for a sweep."""

    script: Path
    sweep: Sequence[str]  # values of --sweep
    given: Sequence[tuple[str, str]] = ()  # values of -v
    preset: Sequence[tuple[str, str]] = ()  # values of --quick; given and swept values have priority
    packings: int = 1
    ranks: int = 1
    until_steady: float = 0.0
    time_limit: float = 0.0
    samples: int = 0  # points in the box of the variables; 0: all combinations of values


def plan_of(request: SweepRequest) -> tuple[SweepPlan, list[str]]:
    """The plan, and warnings. @raises ResultsError for what the script does not take; OSError"""
    if request.samples:
        points = sampled(request.sweep, request.samples)
    else:
        points = product(parse_variables(request.sweep))
    names = list(points[0])
    given = dict(request.given)
    warnings = check_variables(request.script, request.given, RESERVED)
    settable = script_variables(request.script, given).settable
    words = [_word_of(settable, *item) for item in points[0].items()]
    swept = dict(words)
    for name in swept:
        if name in given:
            raise ResultsError(f"{name} is given both by -v and by --sweep; give it once")
    if len(swept) < len(words):
        raise ResultsError(f"--sweep {' and '.join(names)} set the same variable of the script")
    check_variables(request.script, words, RESERVED, given, "--sweep")
    defaults = script_variables(request.script, given).defaults
    values = list(dict.fromkeys(item for point in points for item in point.items()))
    require_files(request.script, defaults, values, "--sweep")
    fixed = {**dict(request.preset), **given}
    fixed = {name: value for name, value in fixed.items() if name not in swept}
    known = script_variables(request.script, fixed)
    if RESULTS not in known.settable:
        raise ResultsError(
            f"{request.script}: no line reads '{RESULTS}', so that all points would write to one "
            f"folder; give the script 'variable {RESULTS} index ...' as the folder of its results"
        )
    seeds = _seeds(request, names, known, fixed)
    plan = SweepPlan(
        str(request.script.resolve()),
        tuple(names),
        fixed,
        points_of(points, seeds),
        request.ranks,
        request.until_steady,
        request.time_limit,
    )
    return plan, warnings


def _word_of(settable: Sequence[str], name: str, value: str) -> tuple[str, str]:
    """The variable of the script that takes a value of the sweep, and what it takes.

    Slip and torque belong to the mode of the rig.
    """
    if name in DRIVEN and name not in settable and MOTION in settable:
        return MOTION, DRIVEN[name].format(value)
    return name, value


def _seeds(
    request: SweepRequest,
    swept: Sequence[str],
    known: ScriptVariables,
    fixed: Mapping[str, str],
) -> list[int]:
    """Seeds of the packings after the first. @raises ResultsError"""
    if request.packings == 1:
        return []
    if SEED not in known.settable:
        raise ResultsError(
            f"--packings {request.packings}: no line of {request.script} reads '{SEED}', which "
            "chooses the packing of grains; leave --packings out"
        )
    if SEED in swept:
        raise ResultsError(f"--packings chooses '{SEED}', which is swept too; give one of them")
    first = fixed.get(SEED, known.defaults.get(SEED, ""))
    try:
        return further_seeds(int(first), request.packings - 1)
    except ValueError:
        raise ResultsError(f"--packings: '{SEED}' is '{first}', no whole number") from None


def case_of(plan: SweepPlan, point: PlannedRun) -> Case:
    """The run of a point."""
    script = Path(plan.script)
    seed = {SEED: point.seed} if point.seed else {}
    settable = script_variables(script, plan.fixed).settable
    swept = dict(_word_of(settable, *item) for item in point.values.items())
    return scene_case(
        point.folder,
        script,
        {**plan.fixed, **swept, **seed},
        plan.until_steady,
        plan.time_limit,
        ranks=plan.ranks,
        # A run until it is steady ends by itself
        time_limit=math.inf if plan.until_steady or not plan.time_limit else plan.time_limit,
    )
