# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene that is stopped leaves a checkpoint and no process, and continues bit for bit.

    stopped.py <scene> <SIGTERM or SIGKILL> <results> [<argument of inputs/run>]...

The signal goes to inputs/run after its first checkpoint. Every array of the continued run must be
that of a run without a break.
"""

import signal
import sys
import time
from pathlib import Path

from scene_test import PROJECT, empty, inputs_run

sys.path.insert(0, str(PROJECT / "tests" / "coupled" / "support"))
from furrow_run import going, wait_until
from same_results import compare_arrays

PATIENCE = 200  # [s]


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
    with going([*command, "--checkpoint", "0.5s"], folder, **cache) as begun:
        wait_until((stopped / "checkpoint.data").exists, begun, PATIENCE)
        assert (stopped / "checkpoint.data").exists(), f"the run wrote no checkpoint in {PATIENCE} s"
        assert programs_of(stopped), f"the run ended before it was stopped:\n{(folder / 'said').read_text()}"
        begun.send_signal(number)
        begun.wait(PATIENCE)
    said = (folder / "said").read_text()
    if number == signal.SIGTERM and (begun.returncode != 143 or "give --continue" not in said):
        sys.exit(f"status {begun.returncode} after SIGTERM, or no way to continue:\n{said}")
    assert number != signal.SIGTERM or not programs_of(stopped), "furrow goes on after inputs/run has ended"
    until = time.monotonic() + PATIENCE
    while programs_of(stopped):
        assert time.monotonic() <= until, f"furrow did not end within {PATIENCE} s"
        time.sleep(0.05)
    print(said, inputs_run(scene, "--no-pictures", "-o", stopped, "--continue", **cache))
    assert (stopped / "run.json").is_file(), "the continued run did not come to its end"
    same = compare_arrays(whole, stopped, tolerance=0.0)
    assert same >= 20, f"only {same} arrays were compared"
    print(f"{signal_name}: {same} arrays are the same")


if __name__ == "__main__":
    main(*sys.argv[1:])
