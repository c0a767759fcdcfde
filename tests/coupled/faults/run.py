# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow on a script with one fault after another and checks what it says.

    run.py <furrow> <script>

Beside the script stands a table of the same name, `<script>.faults`: a paragraph for each fault.

    two_rigs                              its name
    - <text>                              a piece of the script, which must occur once,
    + <text>                              ... and what replaces it
    > <line>                              a line more, before the last one
    error: <text>                         part of the message: the run must be refused
    warning: <text>                       part of a warning: the run must end normally

A refusal has a status other than 0, is no signal, and names a line of the script. A run that ends
well has the warnings that are announced, of the case or for all in the head of the script
(`# warning: <text>`), and no other. The script as it stands is the first case.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TIME_LIMIT = 60  # s
INPUTS = Path(__file__).resolve().parents[3] / "inputs"


class Fault:
    def __init__(self, name, lines=(), usual=()):
        self.name = name
        self.edits, self.additions = [], []
        self.errors, self.warnings, self.usual = [], [], usual
        for line in lines:
            mark, _, text = line.partition(" ")
            if mark == "-":
                self.edits.append([text, ""])
            elif mark == "+":
                self.edits[-1][1] = text
            else:
                {">": self.additions, "error:": self.errors, "warning:": self.warnings}[mark].append(text)

    def script(self, sound):
        text = sound
        for old, new in self.edits:
            if text.count(old) != 1:
                sys.exit(f"{self.name}: '{old}' occurs {text.count(old)} times in the script")
            text = text.replace(old, new)
        *lines, last = text.rstrip("\n").split("\n")
        return "\n".join([*lines, *self.additions, last]) + "\n"

    def problems(self, status, output, script):
        expected = list(self.errors)
        if status < 0 or status >= 128:
            yield f"ended by a signal: status {status}"
        if self.errors:
            expected += ["ERROR: "]
            if not re.search(rf"^  at {re.escape(str(script))}, line \d+: ", output, re.MULTILINE):
                yield "the message names no line of the script"
        if (status == 0) == bool(self.errors):
            yield f"the status is {status}"
        for text in expected + self.warnings:
            if text not in output:
                yield f"nothing says: {text}"
        for line in output.splitlines():
            if not self.errors and "WARNING" in line and not any(
                    text in line for text in [*self.warnings, *self.usual]):
                yield f"an unannounced warning: {line}"


def read_table(path, usual):
    paragraphs = [[line for line in paragraph.splitlines() if not line.startswith("#")]
                  for paragraph in path.read_text().split("\n\n")]
    return [Fault(name, rest, usual) for name, *rest in filter(None, paragraphs)]


def run(furrow, fault, sound, cache):
    """The problems of a case, and what furrow said."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "script.lig"
        script.write_text(fault.script(sound))
        variables = ["-var", "inputs", INPUTS] if "${inputs}" in script.read_text() else []
        try:
            done = subprocess.run([furrow, "-in", script, "-log", "none", *variables], cwd=folder,
                                  env=dict(os.environ, FURROW_CACHE=cache), timeout=TIME_LIMIT, text=True,
                                  errors="replace", stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT)
        except subprocess.TimeoutExpired:
            return [f"did not end within {TIME_LIMIT} s"], ""
        return list(fault.problems(done.returncode, done.stdout, script)), done.stdout


def main(furrow, script):
    script = Path(script)
    failed = 0
    text = script.read_text()
    usual = re.findall("^# warning: (.*)$", text, re.MULTILINE)
    with tempfile.TemporaryDirectory() as cache:
        for fault in [Fault("(sound)", usual=usual), *read_table(script.with_suffix(".faults"), usual)]:
            problems, output = run(furrow, fault, text, cache)
            print(f"{'FAILED' if problems else 'ok':<8}{fault.name}", flush=True)
            if problems:
                failed += 1
                print(*(f"    {problem}" for problem in problems), output, sep="\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
