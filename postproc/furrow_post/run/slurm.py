# SPDX-License-Identifier: GPL-2.0-or-later
"""A list of runs as an array job of Slurm, one run a task, in the same folders as without Slurm."""

import json
import os
import shlex
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from ..arguments import has_control_characters
from ..errors import Interrupted, ResultsError
from ..json_text import parse_json
from .case import Case
from .executor import Executor, State
from .progress import Progress

FOLDER, SCRIPT, JOB = "slurm", "job.sh", "job.json"  # below the folder of the sweep
LOOK_EVERY = 2.0  # [s] at the queue and the points
SETTLING = 10.0  # [s] delay of a file from a node to this machine

BATCH = """#!/bin/bash
# Written by inputs/run --submit slurm. Partition, account, time: the variables SBATCH_* of sbatch.
#SBATCH --job-name={name}
#SBATCH --array=0-{last}{limit}
#SBATCH --ntasks={ranks}
#SBATCH --output={output}
points=(
{points}
)
{environment}
exec {command} --point "${{points[$SLURM_ARRAY_TASK_ID]}}"
"""


@dataclass(frozen=True)
class ArrayJob:
    """An array job that was submitted."""

    number: str
    points: tuple[str, ...]  # folder of each task

    def write(self, folder: Path) -> None:
        (folder / JOB).write_text(json.dumps(asdict(self)) + "\n", encoding="utf-8")


def read_job(folder: Path) -> ArrayJob | None:
    """The last one of a sweep, or None."""
    try:
        content = parse_json((folder / JOB).read_text(encoding="utf-8"))
        return ArrayJob(content["number"], tuple(content["points"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None


def batch_text(
    results: Path,
    points: Sequence[str],
    command: Sequence[str],
    environment: Mapping[str, str],
    ranks: int,
    at_a_time: int | None,
) -> str:
    """The script for sbatch; command: makes the point whose name comes behind --point.

    @raises ResultsError for a folder whose name would be a line of the script
    """
    if has_control_characters(str(results)):
        raise ResultsError(
            f"{str(results)!r}: has a line break or another control character; name another folder"
        )
    # Slurm takes % in the name of an output for a number that it fills in
    output = str(results / FOLDER).replace("%", "%%") + "/%a.txt"
    exports = (f"export {name}={shlex.quote(value)}" for name, value in environment.items())
    return BATCH.format(
        name=shlex.quote(f"furrow_{results.name}"),
        last=len(points) - 1,
        limit=f"%{at_a_time}" if at_a_time else "",
        ranks=ranks,
        output=f'"{output}"',
        points="\n".join(f"  {shlex.quote(point)}" for point in points),
        environment="\n".join(exports),
        command=shlex.join(command),
    )


def submit(folder: Path, text: str, points: Sequence[str]) -> ArrayJob:
    """folder: of the job's files. @raises ResultsError with what sbatch says"""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / SCRIPT).write_text(text, encoding="utf-8")
    done = _slurm("sbatch", "--parsable", str(folder / SCRIPT))
    if done.returncode:
        said = " ".join(done.stderr.split()) or f"status {done.returncode}"
        raise ResultsError(f"sbatch refuses {folder / SCRIPT}: {said}")
    job = ArrayJob(done.stdout.strip().split(";")[0], tuple(points))
    job.write(folder)
    return job


def is_queued(job: ArrayJob) -> bool:
    """True where a task of the job waits or runs. @raises ResultsError where Slurm does not answer"""
    done = _slurm("squeue", "--noheader", "--jobs", job.number, "--format", "%T")
    if done.returncode and "Invalid job id" not in done.stderr:
        raise ResultsError(f"squeue does not answer: {' '.join(done.stderr.split())}")
    return bool(done.stdout.strip())


def _slurm(*words: str) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(words, capture_output=True, text=True)
    except FileNotFoundError:
        raise ResultsError(
            f"there is no {words[0]} on this machine; start the sweep where Slurm is, or leave "
            "--submit out"
        ) from None


def gather(job: ArrayJob, executor: Executor, cases: Sequence[Case]) -> None:
    """Waits until the job has ended and tells of each point that ends. @raises Interrupted"""
    left = {case.name: case for case in cases if case.name in job.points}
    left = {name: case for name, case in left.items() if executor.state(case) is State.MISSING}
    progress = Progress(len(left), max(len(left), 1))
    ended_at = None
    try:
        while left:
            for name in [n for n, case in left.items() if executor.state(case) is not State.MISSING]:
                case = left.pop(name)
                if run := executor.ended(case):
                    progress.report(name, run.folder, run.record)
            progress.show([folder for case in left.values() if (folder := executor.folder(case)).is_dir()])
            if not is_queued(job):
                ended_at = ended_at or time.monotonic()
                if time.monotonic() - ended_at > SETTLING:
                    break
            time.sleep(LOOK_EVERY if left else 0)
    except KeyboardInterrupt:
        raise Interrupted(
            f"interrupted; job {job.number} goes on. The same command gathers its points, "
            f"'scancel {job.number}' ends it"
        ) from None
    finally:
        progress.clear()


def lost(job: ArrayJob, executor: Executor, cases: Sequence[Case]) -> list[str]:
    """A sentence for each point whose task ended without a record of its run."""
    folder = executor.results / FOLDER
    found = []
    for case in cases:
        if case.name in job.points and executor.state(case) is State.MISSING:
            output = folder / f"{job.points.index(case.name)}.txt"
            said = output.read_text(errors="replace").split("\n") if output.is_file() else []
            last = next((line.strip() for line in reversed(said) if line.strip()), "")
            found.append(
                f"{case.name}: its task ended without a result{f': {last}' if last else ''} "
                f"({output})"
            )
    return found


def environment() -> dict[str, str]:
    """Variables of this environment that a task needs: the build, Open MPI's settings, the cache of beds."""
    kept = ("FURROW_", "OMPI_")
    return {name: value for name, value in os.environ.items() if name.startswith(kept)}
