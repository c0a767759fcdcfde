# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow on a script with one fault and checks how it is refused.

    run.py <furrow> <script> [<launcher> ...]

The header of a script states what must happen:
    # expect: <text>      part of the message (any number of lines)
    # intact: <file>      results file that must be readable after the error, with no row missing
                          before it
    # warning: <text>     part of a warning; the script must run to its end
    # of one rank: yes    on several ranks the error may be that of any one, which knows no line and
                          cannot have rank 0 write its rows: the run must still stop, with the
                          message
A script with an expectation must stop at its last line, with a non-zero status, within the time
limit, and the message must name the script and the number of that line. A script without one must
run to its end, without a warning that it does not announce.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

TIME_LIMIT = 60  # s


def header(script, key):
    mark = f"# {key}: "
    return [line[len(mark):].rstrip("\n") for line in script.open() if line.startswith(mark)]


def last_line(script):
    """Number and first word of the last command: the one at fault."""
    lines = script.read_text().splitlines()
    number = max(i for i, line in enumerate(lines, 1) if line.strip())
    return number, lines[number - 1].split()[0]


def check_intact(path):
    with h5py.File(path) as file:
        channels = {name: data[:] for name, data in file["history"].items()}
    rows = {len(values) for values in channels.values()}
    assert len(rows) == 1 and rows.pop() > 1, f"{path}: rows differ or are missing"
    assert all(np.isfinite(values).all() for values in channels.values()), f"{path}: a value is not finite"
    spacing = np.diff(channels["time"])
    assert np.allclose(spacing, spacing[0], rtol=1e-9), f"{path}: rows are missing"


def main(furrow, script, launcher):
    script = Path(script).resolve()
    here = Path(__file__).resolve().parent
    expected, warnings = header(script, "expect"), header(script, "warning")
    environment = dict(os.environ, FURROW_CACHE="cache")
    with tempfile.TemporaryDirectory() as folder:
        folders = {"parts": here / "parts", "beds": here.parents[2] / "inputs/beds"}
        variables = [word for name, path in folders.items() if f"${{{name}}}" in script.read_text()
                     for word in ("-var", name, path)]
        command = [*launcher, furrow, "-in", script, "-log", "none", *variables]
        run = subprocess.run(command, cwd=folder, env=environment, timeout=TIME_LIMIT, text=True, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        print(run.stdout)
        problems = []
        if (run.returncode == 0) == bool(expected):
            problems.append(f"the status is {run.returncode}")
        of_one_rank = launcher and header(script, "of one rank")
        if of_one_rank:
            expected += ["ERROR"]
        elif expected:
            number, command_name = last_line(script)
            expected += ["ERROR: ", f"at {script}, line {number}: {command_name}"]
        else:
            problems += [f"an unannounced warning: {line}" for line in run.stdout.splitlines()
                         if "WARNING" in line and not any(text in line for text in warnings)]
        problems += [f"the message lacks: {text}" for text in expected + warnings if text not in run.stdout]
        for path in [] if of_one_rank else header(script, "intact"):
            try:
                check_intact(Path(folder) / path)
            except (OSError, KeyError, AssertionError) as problem:
                problems.append(f"{path} is not intact: {problem}")
    for problem in problems:
        print(f"FAILED: {script.name}: {problem}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
