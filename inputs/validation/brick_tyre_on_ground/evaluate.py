# SPDX-License-Identifier: GPL-2.0-or-later
"""Hub drop, deflection, rut and resistance of tyres and a rigid wheel on several grounds."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from furrow_post.analyse.statistics import block_mean
from furrow_post.csv_table import read_matrix, read_rows
from furrow_post.read.results import Results
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

STORED = Path(__file__).resolve().parent / "results.csv"
# [m] of travel before the end, over which is averaged, by ground
WINDOWS = {"snow": 0.5, "sand": 0.5, "grains": 0.2, "clusters": 0.2}
SAME = 0.02  # relative difference of a run that is made again


def row_of(run: Run) -> dict[str, Any]:
    """Means over the last part of the travel, and the standard error of c of eight blocks.

    A tyre's deflection, and what its hub has sunk in, are counted from the inflated shape, which
    the first row of watch.txt has: there it does not touch the ground yet.
    """
    name = run.name.rpartition("/")[2]
    history = Results(run.folder).columns
    last = history["x"] > history["x"][-1] - WINDOWS[name.partition("_")[0]]
    load = history["force_z"][last].mean()
    c, error = block_mean(-history["force_x"][last] / load)
    watch = read_matrix(run.folder / "watch.txt", 2)
    steps = watch[-1, 0] - watch[0, 0]
    since = (watch[:, 0] - watch[0, 0]) / steps
    start = (history["time"][last][0] - history["time"][0]) / (
        history["time"][-1] - history["time"][0]
    )
    unloaded = watch[0, 1]
    deflection = watch[since > start, 1].mean() - unloaded
    hub = history["hub_drop"][last].mean() - unloaded
    return {
        "run": name,
        "hub_mm": round(1e3 * hub, 1),
        "deflection_mm": round(1e3 * deflection, 1),
        "rut_mm": round(1e3 * (hub - deflection), 1),
        "c": round(c, 4),
        "c_error": round(error, 4),
        "load_N": round(load),
        "slip": round(history["slip"][last].mean(), 3),
        "user_s": run.seconds,
    }


def changed(again: Sequence[dict[str, Any]], before: Sequence[dict[str, str]]) -> Iterator[str]:
    """What differs of runs made again from those that are stored."""
    stored = {row["run"]: row for row in before}
    for row in again:
        if old := stored.get(row["run"]):
            for what in ("hub_mm", "deflection_mm", "c"):
                if abs(row[what] - float(old[what])) > SAME * abs(float(old[what])):
                    yield f"{row['run']}: {what} {row[what]} was {old[what]}"


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    rows = [row_of(run) for run in runs.done("ground")]
    output.table("results.csv", rows)
    return list(changed(rows, read_rows(STORED))) if STORED.is_file() else []
