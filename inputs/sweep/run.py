#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Sweeps of a scene: makes the points that are missing, here or by Slurm, and draws their curves.

'bash inputs/run SCENE --sweep ...' calls it. See README.md.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postproc"))

from furrow_post.arguments import at_least, fraction, path, seconds, shield_negative_numbers, words
from furrow_post.errors import ResultsError
from furrow_post.program import run_program
from furrow_post.study.case import Case
from furrow_post.study.launch import Tools
from furrow_post.study.runner import Runner, State
from furrow_post.sweep import slurm
from furrow_post.sweep.cases import Request, case_of, continued_script, plan_of
from furrow_post.sweep.output import Named, Wanted, evaluate, report_lines, write_sweep
from furrow_post.sweep.plan import Plan, read_plan

COSTS = Path(__file__).resolve().parents[1] / "costs"


def parser() -> argparse.ArgumentParser:
    """Options are explained to users by inputs/run --help and the page."""
    usage = "bash inputs/run SCENE --sweep NAME=VALUES ...; all options: bash inputs/run --help"
    found = argparse.ArgumentParser(prog="inputs/run", usage=usage, allow_abbrev=False)
    found.add_argument("script", type=path, nargs="?")
    found.add_argument("--sweep", action="append", default=[], type=words, metavar="NAME=VALUES")
    for name in ("-v", "--preset"):
        found.add_argument(name, nargs=2, action="append", default=[], metavar=("NAME", "VALUE"))
    found.add_argument("-o", dest="folder", type=path)
    found.add_argument("-n", dest="ranks", type=at_least(1), default=1)
    found.add_argument("--packings", type=at_least(1), default=1)
    found.add_argument("--jobs", type=at_least(1))
    found.add_argument("--again", action="store_true")
    found.add_argument("--submit", choices=("slurm",))
    found.add_argument("--until-steady", type=fraction, default=0.0)
    found.add_argument("--time-limit", type=seconds, default=0.0)
    found.add_argument("--formula", action="append", default=[])
    found.add_argument("--measured", action="append", default=[], type=path)
    found.add_argument("--check", action="store_true", help="only say whether it may be run")
    found.add_argument("--point", type=words, help="make this point of the sweep in -o")
    found.add_argument("--continued", action="store_true", help="print the script of one run")
    return found


def main(given: Sequence[str]) -> int:
    parsed = parser().parse_args(shield_negative_numbers(given))
    tools = Tools.of(Path(__file__))
    if parsed.point:
        return make_point(parsed.folder, parsed.point, tools)
    script: Path = parsed.script
    if parsed.continued:
        print(continued_script(script.resolve(), parsed.until_steady, parsed.time_limit), end="")
        return 0
    request = Request(
        script,
        parsed.sweep,
        [(name, value.strip()) for name, value in parsed.v],
        [(name, value.strip()) for name, value in parsed.preset],
        parsed.packings,
        parsed.ranks,
        parsed.until_steady,
        parsed.time_limit,
    )
    plan, warnings = plan_of(request)
    wanted = Wanted(
        errors=table if (table := COSTS / f"{script.stem}.csv").is_file() else None,
        formulas=parsed.formula,
        measured=[Named(file) for file in parsed.measured],
    )
    wanted.check()
    if parsed.check:
        for warning in warnings:
            print(f"WARNING: {warning}", file=sys.stderr)
        return 0
    folder: Path = parsed.folder.resolve()
    former = read_plan(folder)
    whole = plan.joined(former) if former else plan
    whole.write(folder)
    runner = Runner(folder, tools, parsed.jobs or 1, again=parsed.again, same_inputs=True)
    cases = [case_of(plan, point) for point in plan.points]
    states = [runner.state(case) for case in cases]
    print(
        f"{len(cases)} points, {states.count(State.DONE)} of them are there; "
        f"{plan.ranks} rank(s) each; results in {folder}",
        flush=True,
    )
    remarks = []
    if parsed.submit:
        remarks = by_slurm(runner, cases, plan, parsed.jobs)
    else:
        runner.run(cases)
    return ended(runner, cases, remarks, folder, wanted)


def make_point(folder: Path, name: str, tools: Tools) -> int:
    """The task of an array job."""
    plan = read_plan(folder)
    found = [point for point in plan.points if point.folder == name] if plan else []
    if not plan or not found:
        raise ResultsError(f"{folder}: is no sweep with a point {name}")
    case = case_of(plan, found[0])
    runner = Runner(folder, tools, same_inputs=True, again=True)
    runner.run([case])
    return 0 if runner.state(case) is State.DONE else 1


def by_slurm(
    runner: Runner, cases: Sequence[Case], plan: Plan, at_a_time: int | None
) -> list[str]:
    """Makes the points by an array job, after one that is still in the queue."""
    folder = runner.results / slurm.FOLDER
    job = slurm.read_job(folder)
    if job and slurm.is_queued(job):
        print(f"Job {job.number} of this sweep is in the queue; gathering its points", flush=True)
        slurm.gather(job, runner, cases)
    missing = [case.name for case in runner.missing(cases)]
    if not missing:
        return []
    command = [str(Path(__file__).resolve()), "-o", str(runner.results)]
    surroundings = {**slurm.environment(), "FURROW_BUILD": str(runner.tools.build)}
    text = slurm.batch_text(
        runner.results, missing, command, surroundings, plan.ranks, at_a_time
    )
    if runner.again:
        runner.forget(cases)
    job = slurm.submit(folder, text, missing)
    print(f"Submitted job {job.number}: {len(missing)} tasks; {folder / slurm.SCRIPT}", flush=True)
    slurm.gather(job, runner, cases)
    return slurm.lost(job, runner, cases)


def ended(
    runner: Runner, cases: Sequence[Case], remarks: Sequence[str], folder: Path, wanted: Wanted
) -> int:
    """Draws what there is, then tells what failed; the exit status."""
    records = {case.name: runner.failure(case) for case in cases}
    failures = [f"{name}: {failure.error}" for name, failure in records.items() if failure]
    done = sum(runner.state(case) is State.DONE for case in cases)
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
        print(f"inputs/run: {trouble}", file=sys.stderr)
    return 1 if failures or remarks or trouble or done < len(cases) else 0


if __name__ == "__main__":
    sys.exit(run_program("inputs/run", lambda: main(sys.argv[1:])))
