# SPDX-License-Identifier: GPL-2.0-or-later
"""When one rank of two fails, all end within ten seconds, with the message.

    ranks.py <furrow> <mpirun -n>

Grains stand on both sides of x = 0, where the two ranks meet.
"""

import subprocess
import sys
import time

from fault_table import CONTINUED, GRAINS, WHEEL, Said, Table, run_script
from furrow_run import columns, going, wait_until

WITHIN = 10.0  # s
GRAINS = "processors 2 1 1\n" + GRAINS
SECOND_RANK = "region right block 0.07 0.1 INF INF INF INF units box\ngroup right region right\n"
# Long after the failure.
GO_ON = "thermo 100\nrun 100000000\n"
HISTORY = ("fix rig all wheel/rig wheel wheel load_force 1 speed 1 mode towed settle_time 1 accelerate_time 1 ground_level 0\n"
           "fix out all wheel/history rig rig folder results every 1\n")


def launch(launcher, second, furrow):
    """The second rank under separate conditions, as a line of sh."""
    shell = f'[ "$OMPI_COMM_WORLD_RANK" != 1 ] || {{ echo $$ > pid; {second}; }}; exec "$0" "$@"'
    return [*launcher, "2", "sh", "-c", shell, furrow]


def timed(table, name, command, *texts, script, meanwhile=None):
    folder = table.folder
    (folder / "script.lig").write_text(script)
    (folder / "going").unlink(missing_ok=True)
    with going([*command, "-in", "script.lig", "-log", "none"], folder) as run:
        wait_until((folder / "going").exists, run)
        if meanwhile:
            meanwhile()
        began = time.monotonic()
        wait_until(lambda: False, run, 3 * WITHIN)
        duration = time.monotonic() - began
        failed = run.poll() not in (None, 0)
    table.check(name, Said("an error" if failed else "none", (folder / "said").read_text()), "an error", *texts)
    table.expect(f"{name}: within {WITHIN:g} s", duration < WITHIN, f"{duration:.1f} s")


def main(furrow, *mpirun):
    table = Table()
    here = launch(mpirun, ":", furrow)
    begun = "shell touch going\n"
    timed(table, "a grain's velocity is no number", here, "ERROR", "velocity",
          script=GRAINS + WHEEL + SECOND_RANK + "run 10\n" + begun +
          "variable nonsense atom 1e300*1e300-1e300*1e300\nset group right vz v_nonsense\n" + GO_ON)
    # the rows that rank 0 has in memory when the other rank fails
    timed(table, "an infinite force on a grain", here, "ERROR on rank 1", "at run",
          script=GRAINS + WHEEL + HISTORY + SECOND_RANK + begun + "variable push equal 1e305*(step>200)*1e305\n"
                 "fix push right addforce 0.0 0.0 v_push\n" + GO_ON)
    rows = len(columns(table.folder / "results/history.h5")["time"])
    table.expect("an infinite force on a grain: all rows are there", rows >= 200, rows)
    timed(table, "a file of rank 0", here, "ERROR", "Cannot open", "line ",
          script=GRAINS + "dump d all custom 20 /proc/no/dump id\n" + begun + GO_ON)
    timed(table, "a line of the script", here, "ERROR", "line ",
          script=GRAINS + begun + "fix wheel all wheel/rigid diameter -1\n")
    timed(table, "killed", here, script=GRAINS + "run 10\n" + begun + GO_ON,
          meanwhile=lambda: subprocess.run(["kill", "-9", (table.folder / "pid").read_text().strip()], check=True))
    timed(table, "too little memory", launch(mpirun, "ulimit -v 400000", furrow), "ERROR",
          script=GRAINS + begun + "region more block -0.1 0.1 -0.1 0.1 0 0.2 units box\nlattice sc 0.0004\n"
                 "create_atoms 1 region more\n" + GO_ON)

    # a state that cannot be read: its bytes are changed, and the file is not checked
    table.check("checkpoint", run_script(furrow, table.folder, GRAINS + WHEEL + "run 10\nwrite_restart ck\n",
                                         launcher=[*mpirun, "2"]), 0)
    content = (table.folder / "ck").read_bytes()
    place = content.index(b"FurrowCP") + 200
    (table.folder / "ck").write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1:])
    timed(table, "a damaged state", here, "ERROR", "its part of the checkpoint is damaged",
          script="processors 2 1 1\n" + CONTINUED.format(file="ck unchecked") + begun + WHEEL + GO_ON)
    table.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
