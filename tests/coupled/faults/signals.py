# SPDX-License-Identifier: GPL-2.0-or-later
"""Signals: a run ends with a checkpoint that continues as any other.

    signals.py <furrow> [<mpirun -n>]

Without a launcher the cases of one process, with it those of one rank of two.
The grains of fault_table.py fall on a floor while a signal comes; the run that continues gives the same
state, bit for bit, as a run without a break.
"""

import re
import signal
import subprocess
import sys
import time

from fault_table import CONTINUED, GRAINS, WHEEL, Said, Table, run_script
from furrow_run import going, wait_until

BEGIN = GRAINS + WHEEL


def state(table, name):
    """Grains of the last dump, as text with all digits."""
    last = (table.folder / name).read_text().split("ITEM: ATOMS")[-1]
    return sorted(last.splitlines()[1:])


def dump_at(step):
    return (f"dump end all custom {step} end id x y z vx vy vz omegax omegay omegaz\n"
            'dump_modify end format "%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g" first no\n')


def interrupted(furrow, table, script, numbers, launcher=()):
    """Sends the signals to the first rank when the run has begun."""
    (table.folder / "script.lig").write_text(script)
    for file in (*table.folder.glob("restart_forced*"), *table.folder.glob("pid*")):
        file.unlink()
    shell = 'file=pid${OMPI_COMM_WORLD_RANK:-0}; echo $$ > $file.new; mv $file.new $file; exec "$0" "$@"'
    with going([*launcher, "sh", "-c", shell, furrow, "-in", "script.lig", "-log", "none"], table.folder) as run:
        wait_until((table.folder / "going").exists, run)
        for number in numbers:
            if run.poll() is None:
                subprocess.run(["kill", f"-{number}", (table.folder / "pid0").read_text().strip()], check=True)
                time.sleep(0.2)
            if number == signal.SIGUSR1:
                wait_until(lambda: list(table.folder.glob("restart_forced*")), run)
        wait_until(lambda: False, run)
        status = run.poll()
        if status is None:
            run.terminate()  # mpirun ends its ranks
            run.wait()
    (table.folder / "going").unlink(missing_ok=True)
    return Said(status, (table.folder / "said").read_text())


def going_on(script, steps):
    """Says with a file that steps are taken."""
    return script + f"dump going all custom 50 going id\nthermo 100\nrun {steps} upto\n"


def continues(furrow, table, name, number, status, launcher=()):
    said = interrupted(furrow, table, going_on(BEGIN, 100000000), [number], launcher)
    table.check(f"{name}", said, status, "stopped the run after step", "'read_restart restart_forced_liggghts_",
                absent=["No neighbour lists were due"])
    files = [path.name for path in table.folder.glob("restart_forced*")]
    table.expect(f"{name}: one checkpoint", len(files) == 1, files)
    step = int(re.search(r"_(\d+)\.data", files[0]).group(1))
    last = f"run {step + 500} upto\n"
    dump = dump_at(step + 500)
    again = run_script(furrow, table.folder, CONTINUED.format(file=files[0]) + WHEEL + dump + last, launcher=launcher)
    table.check(f"{name}: continued", again, 0)
    got = state(table, "end")
    whole = run_script(furrow, table.folder, BEGIN + dump + last, launcher=launcher)
    table.check(f"{name}: without a break", whole, 0)
    table.expect(f"{name}: the same grains", got == state(table, "end") and len(got) > 100, "they differ")


# Not "shell touch": system() ignores SIGINT until its command has ended
ENDLESS = "print going file going\nlabel again\nvariable x equal 1\njump SELF again\n"
ENDS = ((signal.SIGTERM, 143), (signal.SIGINT, 130))


def one_rank_of_two(furrow, table, launcher):
    continues(furrow, table, "SIGTERM of one rank of two", signal.SIGTERM, 143, launcher)
    for number, status in ENDS:
        said = interrupted(furrow, table, ENDLESS, [number], launcher)
        table.check(f"signal {number} in a loop, of one rank of two", said, status, "before its first run")


def one_process(furrow, table):
    continues(furrow, table, "SIGTERM", signal.SIGTERM, 143)
    continues(furrow, table, "SIGINT", signal.SIGINT, 130)
    continues(furrow, table, "SIGHUP", signal.SIGHUP, 129)
    said = interrupted(furrow, table, going_on(GRAINS, 100000000), [signal.SIGUSR1, signal.SIGTERM])
    table.check("SIGUSR1", said, 143)
    files = list(table.folder.glob("restart_forced*"))
    table.expect("SIGUSR1: goes on after its checkpoint", len(files) == 2, files)
    resting = GRAINS.replace("fix move all nve/sphere\n", "fix still all freeze\n") + WHEEL
    said = interrupted(furrow, table, going_on(resting, 100000000), [signal.SIGTERM])
    table.check("grains that need no new lists", said, 143, "stopped the run after step", "No neighbour lists were due")
    said = interrupted(furrow, table, going_on(GRAINS + "write_restart_on_signal no\n", 100000000), [signal.SIGTERM])
    table.check("without checkpoint", said, 143, "without a checkpoint")
    table.expect("without checkpoint: no file", not list(table.folder.glob("restart_forced*")), "there is one")
    said = interrupted(furrow, table, going_on(GRAINS, 500) , [signal.SIGPIPE])
    table.check("SIGPIPE is ignored", said, 0)
    for number, status in ENDS:
        said = interrupted(furrow, table, ENDLESS, [number])
        table.check(f"signal {number} in a loop without a run", said, status, "before its first run")
    said = interrupted(furrow, table, GRAINS + "run 0\n" + ENDLESS, [signal.SIGTERM])
    table.check("SIGTERM in a loop after a run", said, 143, "without a checkpoint")
    twice = [signal.SIGTERM, signal.SIGTERM]
    said = interrupted(furrow, table, GRAINS + "run 0\n" + ENDLESS, twice)
    table.check("second signal", said, 143, "ends at once")


def main(furrow, *mpirun):
    table = Table()
    if mpirun:
        one_rank_of_two(furrow, table, [*mpirun, "2"])
    else:
        one_process(furrow, table)
    table.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
