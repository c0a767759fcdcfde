# SPDX-License-Identifier: GPL-2.0-or-later
"""Sweeps of a scene: makes the points that are missing, here or by Slurm, and draws their curves."""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import ResultsError
from ..programs import PACKAGE, find_program, inputs_folder
from ..run.case import Case
from ..run.tools import Tools
from ..run.executor import Executor, State
from ..run import slurm
from ..sweep.cases import SweepRequest, case_of, plan_of
from ..sweep.sweep_files import Named, Wanted, evaluate, report_lines, write_sweep
from ..sweep.sweep_plan import SweepPlan, read_plan
from .catalogue import Variables
from .options import called


def wanted_of(options: Any, script: Path) -> Wanted:
    """References to draw beside the curves, from the options."""
    inputs = inputs_folder()
    table = inputs / "costs" / f"{script.stem}.csv" if inputs else None
    return Wanted(
        errors=table if table and table.is_file() else None,
        formulas=options.formula,
        measured=[Named(file) for file in options.measured],
    )


def planned(options: Any, script: Path, preset: Variables) -> SweepPlan:
    """The points that are asked for; prints warnings. @raises ResultsError"""
    request = SweepRequest(
        script,
        options.sweep,
        options.given,
        preset,
        options.packings or 1,
        options.ranks,
        options.until_steady or 0.0,
        options.time_limit or 0.0,
        options.samples or 0,
    )
    plan, warnings = plan_of(request)
    wanted_of(options, script).check()
    for warning in warnings:
        print(f"WARNING: {warning}", file=sys.stderr)
    return plan


def make_sweep(options: Any, script: Path, plan: SweepPlan, folder: Path) -> int:
    """The exit status. @raises ResultsError, Interrupted"""
    folder = folder.resolve()
    former = read_plan(folder)
    whole = plan.joined(former) if former else plan
    whole.write(folder)
    executor = Executor(folder, Tools.found(), options.jobs or 1, again=options.again)
    cases = [case_of(plan, point) for point in plan.points]
    states = [executor.state(case) for case in cases]
    print(
        f"{len(cases)} points, {states.count(State.DONE)} of them are there; "
        f"{plan.ranks} rank(s) each; results in {folder}",
        flush=True,
    )
    remarks = []
    if options.submit:
        remarks = _by_slurm(executor, cases, plan, options.jobs)
    else:
        executor.run(cases)
    return _ended(executor, cases, remarks, folder, wanted_of(options, script))


def make_point(folder: Path, name: str) -> int:
    """The task of an array job."""
    plan = read_plan(folder)
    found = [point for point in plan.points if point.folder == name] if plan else []
    if not plan or not found:
        raise ResultsError(f"{folder}: is no sweep with a point {name}")
    case = case_of(plan, found[0])
    executor = Executor(folder, Tools.found(), again=True)
    executor.run([case])
    return 0 if executor.state(case) is State.DONE else 1


def _by_slurm(executor: Executor, cases: Sequence[Case], plan: SweepPlan, at_a_time: int | None) -> list[str]:
    """Makes the points by an array job, after one that is still in the queue."""
    folder = executor.results / slurm.FOLDER
    job = slurm.read_job(folder)
    if job and slurm.is_queued(job):
        print(f"Job {job.number} of this sweep is in the queue; gathering its points", flush=True)
        slurm.gather(job, executor, cases)
    missing = [case.name for case in executor.missing(cases)]
    if not missing:
        return []
    command = [*_this_program(), "run", "-o", str(executor.results)]
    surroundings = {**slurm.environment(), "FURROW_BUILD": str(executor.tools.build)}
    text = slurm.batch_text(executor.results, missing, command, surroundings, plan.ranks, at_a_time)
    if executor.again:
        executor.forget(cases)
    job = slurm.submit(folder, text, missing)
    print(f"Submitted job {job.number}: {len(missing)} tasks; {folder / slurm.SCRIPT}", flush=True)
    slurm.gather(job, executor, cases)
    return slurm.lost(job, executor, cases)


def _this_program() -> list[str]:
    """Path of furrow-post: next to the package in the source tree, or in bin if installed."""
    beside = PACKAGE.parent / "furrow-post"
    return [sys.executable, str(beside if beside.is_file() else find_program("furrow-post"))]


def _ended(
    executor: Executor, cases: Sequence[Case], remarks: Sequence[str], folder: Path, wanted: Wanted
) -> int:
    """Draws what there is, then reports what failed; the exit status."""
    runs = [run for case in cases if (run := executor.ended(case))]
    failures = [f"{run.name}: {run.error}" for run in runs if run.error]
    done = len(runs) - len(failures)
    trouble = ""
    if done:
        try:
            result = evaluate([Named(folder)], wanted)
            files = write_sweep(result, folder)
            print("\n" + "\n".join(report_lines(result)))
            print(f"\n{folder}: {', '.join(files)}")
        except ResultsError as error:
            trouble = str(error)
    for text in (*failures, *remarks):
        print(f"FAILED: {text}", file=sys.stderr)
    if trouble:
        print(f"{called()}: {trouble}", file=sys.stderr)
    return 1 if failures or remarks or trouble or done < len(cases) else 0
