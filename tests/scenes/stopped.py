# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene that is stopped leaves a checkpoint and no process, and continues bit for bit.

    stopped.py <scene> <SIGTERM or SIGKILL> <results> [<argument of inputs/run>]...

The signal goes to inputs/run after its first checkpoint. Every array of the continued run must be
that of a run without a break.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from run import PROJECT, empty, inputs_run

sys.path.insert(0, str(PROJECT / "tests" / "coupled" / "support"))
from same_results import compare_arrays

PATIENCE = 200  # [s]


def wait_for(what, condition):
    until = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > until:
            sys.exit(f"{what} did not happen within {PATIENCE} s")
        time.sleep(0.05)


def programs_of(folder):
    """Processes of furrow that write to a results folder."""
    found = []
    for command in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = command.read_bytes().split(b"\0")
        except OSError:  # has ended
            continue
        if words[0].endswith(b"/furrow") and any(str(folder).encode() in word for word in words):
            found.append(int(command.parent.name))
    return found


def main(scene, signal_name, results, *words):
    folder, number = empty(Path(results).resolve()), signal.Signals[signal_name]
    whole, stopped = folder / "whole", folder / "stopped"
    cache = {"FURROW_CACHE": str(folder / "cache")}
    inputs_run(scene, *words, "--no-pictures", "-o", whole, **cache)
    command = ["bash", PROJECT / "inputs" / "run", "--no-build", scene, *words, "-o", stopped]
    begun = subprocess.Popen([*command, "--checkpoint", "0.5s"], env={**os.environ, **cache},
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True)
    wait_for("a checkpoint", lambda: (stopped / "checkpoint.data").exists() or begun.poll() is not None)
    if not programs_of(stopped):
        sys.exit(f"the run ended before it was stopped:\n{begun.communicate()[0]}")
    begun.send_signal(number)
    said, _ = begun.communicate(timeout=PATIENCE)
    if number == signal.SIGTERM and (begun.returncode != 143 or "give --continue" not in said):
        sys.exit(f"status {begun.returncode} after SIGTERM, or no way to continue:\n{said}")
    if number == signal.SIGTERM and programs_of(stopped):
        sys.exit("furrow goes on after inputs/run has ended")
    wait_for("the end of furrow", lambda: not programs_of(stopped))
    print(said, inputs_run(scene, "--no-pictures", "-o", stopped, "--continue", **cache))
    if not (stopped / "run.json").is_file():
        sys.exit("the continued run did not come to its end")
    same = compare_arrays(whole, stopped, tolerance=0.0)
    if same < 20:
        sys.exit(f"only {same} arrays were compared")
    print(f"{signal_name}: {same} arrays are the same")


if __name__ == "__main__":
    main(*sys.argv[1:])
