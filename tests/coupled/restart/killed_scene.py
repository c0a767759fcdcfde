# SPDX-License-Identifier: GPL-2.0-or-later
"""A shipped scene is killed at a random moment and continued: the results are those of a run in one.

    killed_scene.py [--kills n] [--seed n] [--mpirun <word>]... <furrow> <scene> <steps between checkpoints> <ranks>
                    [<name> <value>]...

The scene is changed as coupling/restart/command_read_restart.md says: `restart` before the run; to
continue, `read_restart` in the variable `begin`, or the checkpoint in `from` of a bed. Every number
of history.h5 and terrain.h5 must be the same, bit for bit, but for the two files' own facts (cost,
audit of a part of a run, script). A curve that fix ave/time writes must be the same in every byte.

One kill comes some time after the second checkpoint. Each of several comes at any moment of the
last run, every other one as SIGTERM; then the checkpoint is that of the signal. After it several ranks
of a continuum, whose sums it has added up at that step, agree to 1e-9 of the largest number of a
unit. The moments follow from the seed, which is printed: another one each time unless it is given.
"""

import argparse
import contextlib
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import INPUTS, wait_until, words_of
from same_results import compare_arrays

LOOK = 0.03  # [s] between looks at a run
PRINTED = 1e-5  # a last digit of a curve

parser = argparse.ArgumentParser()
parser.add_argument("--kills", type=int, default=1)
parser.add_argument("--seed", type=int, default=int.from_bytes(os.urandom(4), "little"))
parser.add_argument("--mpirun", action="append", default=[])
for positional in ("furrow", "scene", "every", "ranks"):
    parser.add_argument(positional)
parser.add_argument("variables", nargs=argparse.REMAINDER)
words = parser.parse_args()
furrow, scene, every, ranks, variables = words.furrow, words.scene, words.every, words.ranks, words.variables
launch = [*words.mpirun, ranks] if int(ranks) > 1 else []
has_bed = "from ${from}" in Path(scene).read_text()
# A bed that was made in the first run is read in the others.
cache = tempfile.TemporaryDirectory()


def whole_script() -> str:
    """The scene with absolute paths, that writes checkpoints in turn to ck.1 and ck.2."""
    text = Path(scene).read_text().replace("../", f"{INPUTS}/")
    head, run, tail = text.rpartition("\nrun ")
    return f"{head}\nrestart {every} ck.1 ck.2{run}{tail}"


def continued_script(checkpoint: Path) -> str:
    text = whole_script()
    if has_bed:
        return re.sub(r"^(variable +from index) .*$", rf"\1 {checkpoint}", text, flags=re.M)
    return re.sub(r"^(variable +begin index) .*$", rf'\1 "read_restart {checkpoint}"', text, flags=re.M)


def start(folder: Path, script: str) -> subprocess.Popen:
    (folder / "results").mkdir(parents=True, exist_ok=True)  # as inputs/run does
    (folder / "scene.lig").write_text(script)
    given = words_of({"results": "results", **dict(zip(variables[::2], variables[1::2]))})
    return subprocess.Popen([*launch, furrow, "-in", "scene.lig", "-log", "none", *given], cwd=folder, stdin=subprocess.DEVNULL,
                            env={**os.environ, "FURROW_CACHE": cache.name}, stdout=open(folder / "screen.txt", "w"),
                            stderr=subprocess.STDOUT, start_new_session=True)


def stop(what: str, folder: Path) -> None:
    """Ends the test with the last words of a run."""
    sys.exit(f"{what}:\n{(folder / 'screen.txt').read_text()[-3000:]}")


def finish(folder: Path, script: str) -> tuple[float, float]:
    """@return when the last run began, and when all ended [s since the start]; the histories are
    opened by the last run"""
    began = time.monotonic()
    run, prepared = start(folder, script), 0.0
    while run.poll() is None:
        if time.monotonic() - began > 900:
            os.killpg(run.pid, signal.SIGKILL)
        if not prepared and any((folder / "results").glob("*.h5")):
            prepared = time.monotonic() - began
        time.sleep(LOOK)
    if run.returncode != 0:
        stop(f"{folder.name} stopped", folder)
    return prepared, time.monotonic() - began


def newest(files: list[Path]) -> Path | None:
    """Whole, as every file of that name is."""
    there = [file for file in files if file.exists()]
    return max(there, key=lambda file: file.stat().st_mtime) if there else None


def session_of(leader: int) -> list[int]:
    """@return processes of the session, of which mpirun's ranks outlive it for a while"""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, _, session, *_ = status.read_text().rpartition(") ")[2].split()
        except OSError:  # has ended
            continue
        if int(session) == leader and state != "Z":
            found.append(int(status.parent.name))
    return found


def end(run: subprocess.Popen) -> int:
    """Waits for the run and all its ranks: none may write on into the results. @return the status"""
    status = run.wait(timeout=120)
    while left := session_of(run.pid):
        for process in left:
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGKILL)
        time.sleep(LOOK)
    return status


def kill_after_checkpoint(folder: Path) -> Path | None:
    """@return the newest checkpoint when the run was killed"""
    began = time.monotonic()
    run = start(folder, whole_script())
    files = [folder / "ck.1", folder / "ck.2"]
    wait_until(lambda: all(file.exists() for file in files), run, seconds=900)
    time.sleep(random.uniform(0.0, 0.3) * (time.monotonic() - began))  # well before the end
    if run.poll() is not None:
        stop("the run ended before it was killed", folder)
    os.killpg(run.pid, signal.SIGKILL)
    end(run)
    return newest(files)


def kill_at_any_moment(folder: Path, prepared: float, duration: float, number: int) -> Path | None:
    """@return a checkpoint, or nothing if there was none yet"""
    run = start(folder, whole_script())
    try:
        moment = prepared + random.uniform(0.05, 0.9) * (duration - prepared)
        if run.wait(timeout=moment) != 0:
            stop("the run stopped", folder)
        return newest([folder / "ck.1", folder / "ck.2"])  # faster than the first: continued from its last
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, number)
    status = end(run)
    if number == signal.SIGTERM and status == 0:
        sys.exit("the status after SIGTERM is 0")
    forced = [file for file in folder.glob("restart_forced*.data") if step_of(file) >= prepared_steps()]
    return newest(forced or [folder / "ck.1", folder / "ck.2"])


def step_of(forced: Path) -> int:
    """Step of the checkpoint of a signal, which has it in its name."""
    return int(re.findall(r"\d+", forced.name)[-1])


def prepared_steps() -> int:
    """Steps of the runs before the last: a checkpoint of theirs is continued by what the script
    does then, which continued_script() leaves out."""
    return sum(int(steps) for steps in re.findall(r"^run +(\d+)$", whole_script(), flags=re.M))


def compare(whole: Path, killed: Path, tolerance: float) -> int:
    """@param tolerance  of the largest number of a unit
    @return how many arrays are the same"""
    return compare_arrays(whole / "results", killed / "results", tolerance) + compare_curves(whole, killed, tolerance)


def compare_curves(whole: Path, killed: Path, tolerance: float) -> int:
    """@return how many there are"""
    curves = [curve for curve in sorted((whole / "results").glob("*.txt")) if curve.name != "summary.txt"]
    for curve in curves:
        other = killed / "results" / curve.name
        if curve.read_bytes() == other.read_bytes():
            continue
        rows, other_rows = np.loadtxt(curve), np.loadtxt(other)
        if not tolerance or rows.shape != other_rows.shape or \
                not np.allclose(rows, other_rows, rtol=0.0, atol=max(tolerance, PRINTED) * np.abs(rows).max()):
            sys.exit(f"{curve.name}: {len(other_rows)} rows are not the {len(rows)} of the run in one")
    return len(curves)


random.seed(words.seed)
print("seed", words.seed, flush=True)
with tempfile.TemporaryDirectory() as name:
    whole, killed = Path(name) / "whole", Path(name) / "killed"
    if has_bed and words.kills > 1:
        finish(killed, whole_script())  # makes the bed, whose minutes are none of those that moments are drawn from
    prepared, duration = finish(whole, whole_script())
    continued = 0
    for kill in range(words.kills):
        shutil.rmtree(killed, ignore_errors=True)
        number = signal.SIGTERM if kill % 2 else signal.SIGKILL
        checkpoint = kill_after_checkpoint(killed) if words.kills == 1 else kill_at_any_moment(killed, prepared, duration, number)
        if checkpoint is None:
            print("killed before the first checkpoint")
            continue
        finish(killed, continued_script(checkpoint))
        exact = number == signal.SIGKILL or ranks == "1"
        same = compare(whole, killed, tolerance=0.0 if exact else 1e-9)
        if same == 0:
            sys.exit("there are no results")
        continued += 1
        print(f"{number.name}, {checkpoint.name}: {same} arrays are the same", flush=True)
    if 2 * continued < words.kills:
        sys.exit(f"only {continued} of {words.kills} runs could be continued")
