# SPDX-License-Identifier: GPL-2.0-or-later
"""Carries out 'furrow-post run': checks all that is asked for, runs it, and shows what came out."""

import importlib
import math
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import Interrupted, ResultsError
from ..programs import results_folder
from ..run.script import RESERVED, check_variables, script_variables
from ..run.case import RESULTS, continued_script
from ..run.executor import Failed
from ..run.process import CHECKPOINT
from ..run.tools import Tools
from ..sweep.sweep_plan import SweepPlan
from .catalogue import Variables, head_lines, quick_variables, script_of
from .one import SceneRun, ranks_remark, require_folder, run_scenes, show, words_of
from .options import called, require_fitting
from .restart import Former, continuation, read_former
from .scene_summary import result_lines
from .two_grounds import Post, run_two_grounds
from .wanted_error import outcome, plan


@dataclass
class Request:
    """Checked request of the command line."""

    options: Any
    folder: Path  # of the results
    script: Path | None = None  # None for runs without a scene
    preset: Variables = field(default_factory=list)  # of --quick
    plan: SweepPlan | None = None  # of --sweep
    former: Former | None = None  # of --continue


def run_scene(options: Any, post: Post) -> int:
    """The exit status: 2 for what is refused before anything runs. post: runs a command of furrow-post"""
    try:
        require_fitting(options)
        if options.point:
            return int(_sweeps().make_point(options.folder, options.point))
        request = checked(options)
        if options.check:
            return 0
        Tools.found().program("furrow")
        if not options.sweep:
            require_folder(request.folder)
    except (ResultsError, OSError) as error:
        print(f"{called()}: {error}", file=sys.stderr)
        return 2
    try:
        return _run(request, post)
    except (Failed, Interrupted) as end:
        if isinstance(end, Interrupted):
            print(f"{called()}: {end}{_how_to_continue(request)}", file=sys.stderr)
        return end.status


def _how_to_continue(request: Request) -> str:
    """ "; ..." where there is a checkpoint in the results."""
    if not (request.folder / CHECKPOINT).is_file():
        return ""
    return f"; to continue it from {request.folder / CHECKPOINT}, give --continue"


def checked(options: Any) -> Request:
    """Checks the options and makes the request. @raises ResultsError, OSError"""
    scene: str = options.scene
    request = Request(options, options.folder or _default_folder(options))
    if not scene:
        return request
    request.script = script_of(scene)
    if options.quick:
        request.preset = quick_variables(request.script)
    if options.sweep:
        request.plan = _sweeps().planned(options, request.script, request.preset)
    else:
        if options.until_steady:
            continued_script(request.script.resolve(), options.until_steady, options.time_limit or 0.0)
        if options.continues:
            request.former = read_former(request.folder, request.script)
            if request.former.checkpoint:
                continuation(request.script, CHECKPOINT)
        for warning in check_variables(request.script, options.given, RESERVED):
            print(f"WARNING: {warning}", file=sys.stderr)
        _require_results_variable(options, request.script)
    if options.folder:
        require_folder(options.folder)
    return request


def _require_results_variable(options: Any, script: Path) -> None:
    """@raises ResultsError for a script whose results -o cannot send to a folder"""
    if options.folder and RESULTS not in script_variables(script, {}).settable:
        raise ResultsError(
            f"{script}: has no variable '{RESULTS}', so -o cannot choose the folder of its results; write 'variable "
            f"{RESULTS} index results/{script.stem}' and 'folder ${{{RESULTS}}}', or leave out -o"
        )


def _sweeps() -> Any:
    """The module of sweeps, which draws: other runs do not wait for matplotlib."""
    return importlib.import_module(".sweeps", __package__)


def _default_folder(options: Any) -> Path:
    name = Path(options.scene).stem if options.scene else "two_grounds"
    ending = ("_sweep" if options.sweep else "") + ("_quick" if options.quick else "")
    return results_folder(name + ending)


def _run(request: Request, post: Post) -> int:
    """Runs the request; returns the exit status. @raises ResultsError, Failed, Interrupted"""
    options, folder, script = request.options, request.folder, request.script
    if script is None:
        run_two_grounds(folder, options.quick, post)
        return 0
    if request.plan:
        return int(_sweeps().make_sweep(options, script, request.plan, folder))
    if request.former and request.former.finished:
        print(f"{folder}: the run came to its end before; nothing is left to continue")
        return 0
    if request.former and not request.former.checkpoint:
        print(f"{folder}: the run was stopped before its first checkpoint; it starts again", flush=True)
    print("\n".join(head_lines(script)), flush=True)
    if options.error or options.time:
        return _run_planned(request, script)
    former = request.former.variables if request.former else []
    variables = [*options.given, *former, *request.preset]
    variables = list({name: (name, value) for name, value in reversed(variables)}.values())[::-1]
    _run_and_show(_scene_run(request, script, variables), options)
    return 0


def _scene_run(request: Request, script: Path, variables: Variables) -> SceneRun:
    options, former = request.options, request.former
    return SceneRun(
        script,
        request.folder,
        variables,
        former.ranks if former else options.ranks,
        options.until_steady or 0.0,
        options.time_limit or 0.0,
        options.checkpoint or 0.0,
        former.checkpoint if former else None,
        words_of(options.scene, variables),
    )


def _run_planned(request: Request, script: Path) -> int:
    """The exit status: 1 where the run misses the error. @raises ResultsError, Failed, Interrupted"""
    options, folder = request.options, request.folder
    made = plan(script, options.given, folder, options.error or math.inf, options.time or math.inf)
    print("\n".join(made.lines()), flush=True)
    if options.dry_run:
        return 0
    variables = [*options.given, *made.forecast.variables]
    print(f"{called()} {words_of(options.scene, variables)}")
    _run_and_show(_scene_run(request, script, variables), options)
    print("\n".join(outcome(made, folder)))
    return 0


def _run_and_show(run: SceneRun, options: Any) -> None:
    where = run.folder
    if RESULTS not in script_variables(run.script, {}).settable:
        where = Path("the folder that the script names")
    print(f"Running on {run.ranks} rank(s); results in {where}", flush=True)
    if run.ranks > 1:
        print(ranks_remark(run.ranks), flush=True)
    run_scenes(run.folder, [run])
    if (run.folder / "history.h5").is_file():
        if not options.no_pictures:
            show(run.folder, options.quick)
        print("\n".join(result_lines(run.folder, options.quick)))
