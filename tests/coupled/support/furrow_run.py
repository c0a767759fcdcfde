# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of furrow in tests: commands and scripts with their output, programs that go on, columns of results."""

import contextlib
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

import h5py

INPUTS = Path(__file__).resolve().parents[3] / "inputs"
SECONDS = 60  # of a short command, and until a program has begun


class Said(NamedTuple):
    """End of a program."""

    status: object
    text: str  # on both outputs


def run(command, folder, seconds=SECONDS, **environment):
    """Status and output of a command. @raises subprocess.TimeoutExpired"""
    done = subprocess.run(list(map(str, command)), cwd=folder, env={**os.environ, **environment}, timeout=seconds,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return Said(done.returncode, done.stdout.decode(errors="replace"))


def output(command, folder, seconds=500, **environment):
    """Output of a command; the test ends where its status is not 0."""
    said = run(command, folder, seconds, **environment)
    if said.status != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {said.status}\n{said.text[-4000:]}")
    return said.text


def words_of(variables):
    """Arguments of furrow that set variables of its script."""
    return [str(word) for pair in variables.items() for word in ("-var", *pair)]


def script_output(furrow, script, folder, launcher=(), seconds=500, cache=None, **variables):
    """Output of a script that ends well. It runs in a folder, which is made.

    cache: of beds; by default within the folder
    """
    Path(folder).mkdir(parents=True, exist_ok=True)
    return output([*launcher, furrow, "-in", script, "-log", "none", *words_of(variables)], folder, seconds,
                  FURROW_CACHE=str(cache or Path(folder).resolve() / "cache"))


@contextlib.contextmanager
def going(command, folder, **environment):
    """A program that goes on, and is killed at the end of the with statement. Its output is in the file `said`."""
    with open(Path(folder) / "said", "w") as said:
        program = subprocess.Popen(list(map(str, command)), cwd=folder, env={**os.environ, **environment},
                                   stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT)
    try:
        yield program
    finally:
        program.kill()
        program.wait()


def wait_until(happened, program, seconds=SECONDS):
    """Waits until something has happened, the program has ended, or the time is over."""
    until = time.monotonic() + seconds
    while not happened() and program.poll() is None and time.monotonic() < until:
        time.sleep(0.02)


def columns(file, group="history"):
    """Columns of a group of a results file by name."""
    with h5py.File(file) as content:
        return {name: data[()] for name, data in content[group].items() if isinstance(data, h5py.Dataset)}
