# SPDX-License-Identifier: GPL-2.0-or-later
"""A results folder belongs to one run at a time, and to none once that run was killed.

    folders.py <furrow> <script of a wheel with two histories in one folder> <inputs> [<mpirun> -n]
"""

import os
import sys
from pathlib import Path

from fault_table import Table, run, run_script
from furrow_run import going, wait_until

REFUSED = "is 'results', which another run is writing to; allowed: a folder for each run"
NO_END = 100_000_000  # steps


def main(furrow, script, inputs, *mpirun):
    table = Table()
    short = Path(script).read_text().replace("${inputs}", inputs)
    endless = short.replace("run             20", f"run             {NO_END}")
    (table.folder / "endless.lig").write_text(endless)
    results = table.folder / "results"
    with going([furrow, "-in", "endless.lig", "-log", "none"], table.folder) as first:
        wait_until((results / "terrain.h5").exists, first)
        table.check("a second run", run_script(furrow, table.folder, short), 1, REFUSED)
        table.check("a second run of two ranks",
                    run_script(furrow, table.folder, short, launcher=[*mpirun, 2]), 1, REFUSED)
        elsewhere = short.replace("folder results", "folder others")
        table.check("another folder", run_script(furrow, table.folder, elsewhere), 0)
        scene = Path(inputs) / "scenes" / "wheel_on_snow.lig"
        words = ["bash", Path(inputs) / "run", "--no-build", scene, "-o", results]
        build = str(Path(furrow).parents[1])
        table.check("inputs/run", run(words, table.folder, FURROW_BUILD=build), 2, "which another run is writing to")
        table.expect("nothing of theirs is in the folder",
                     {file.name for file in results.iterdir()} <= {
                         "history.h5", "terrain.h5", "history.part.h5", "terrain.part.h5"},
                     os.listdir(results))
        table.expect("the first run goes on", first.poll() is None, first.returncode)
    table.check("after a kill", run_script(furrow, table.folder, short), 0)
    table.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
