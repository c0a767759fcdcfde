# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow on a script with one fault after another and checks what it says.

    fault_scripts_test.py <furrow> <script> [<launcher> ...]

A table of the same name next to the script, `<script>.faults`, has a paragraph for each fault:

    two_rigs                              its name
    - <text>                              a piece of the script, which must occur once,
    + <text>                              ... and what replaces it
    > <line>                              a line more, before the last one
    error: <text>                         part of the message: the run must be refused
    warning: <text>                       part of a warning: the run must end normally

The script as it stands is the first case. The comments at its head may say, in lines `# <key>: <text>`:

    error, warning                        as above; a script with an error must stop at its last line
    intact                                results file that is readable afterwards, with no row missing
    of one rank: yes                      on several ranks the error may be that of any one, which knows no line and
                                          cannot have rank 0 write its rows

A refusal has a status other than 0, is no signal, and names a line of the script. A run that ends
well has the warnings that are announced, of the case or in the head of the script, and no other.
"""

import re
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import INPUTS, columns, run, words_of

FOLDERS = {"inputs": INPUTS, "beds": INPUTS / "beds", "parts": Path(__file__).resolve().parents[1] / "bad_input" / "parts"}


class Fault:
    """A change of a script, and what must happen then."""

    def __init__(self, name, lines):
        self.name, self.edits, self.additions = name, [], []
        self.errors, self.warnings = [], []
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


def read_table(path):
    paragraphs = [[line for line in paragraph.splitlines() if not line.startswith("#")]
                  for paragraph in path.read_text().split("\n\n")] if path.exists() else []
    return [Fault(name, rest) for name, *rest in filter(None, paragraphs)]


def problems_of(fault, said, place, usual, one_rank):
    """@param place  line of the message that names the line of the script
    @param usual  warnings that any case may have
    @param one_rank  the error may be that of any rank, which knows no place"""
    output = said.text
    if said.status < 0 or said.status >= 128 and not one_rank:
        yield f"ended by a signal: status {said.status}"
    if (said.status == 0) == bool(fault.errors):
        yield f"the status is {said.status}"
    if fault.errors and not one_rank and not re.search(place, output, re.MULTILINE):
        yield "the message does not name the line of the script"
    for text in [*fault.errors, *fault.warnings, *(["ERROR" if one_rank else "ERROR: "] if fault.errors else [])]:
        if text not in output:
            yield f"nothing says: {text}"
    for line in output.splitlines():
        if not fault.errors and "WARNING" in line and not any(text in line for text in [*fault.warnings, *usual]):
            yield f"an unannounced warning: {line}"


def problems_of_rows(path):
    """Problems of a history that ended with an error."""
    try:
        channels = columns(path)
    except (OSError, KeyError) as problem:
        yield f"{path.name} cannot be read: {problem}"
        return
    rows = {len(values) for values in channels.values()}
    if len(rows) != 1 or rows.pop() < 2:
        yield f"{path.name}: rows differ or are missing"
    elif not all(np.isfinite(values).all() for values in channels.values()):
        yield f"{path.name}: a value is not finite"
    elif not np.allclose(np.diff(channels["time"]), np.diff(channels["time"])[0], rtol=1e-9):
        yield f"{path.name}: rows are missing"


def main(furrow, script, *launcher):
    script, failed = Path(script).resolve(), 0
    text, table = script.read_text(), read_table(script.with_suffix(".faults"))
    head = re.findall(r"^# (error|warning|intact|of one rank): (.*)$", text, re.MULTILINE)
    usual = [given for key, given in head if key == "warning"]
    sound = Fault("(sound)", [f"{key}: {given}" for key, given in head if key == "error" or key == "warning" and not table])
    one_rank = bool(launcher) and ("of one rank", "yes") in head
    last = [line for line in text.splitlines() if line.strip()][-1]
    with tempfile.TemporaryDirectory() as cache:
        for fault in [sound, *table]:
            with tempfile.TemporaryDirectory() as folder:
                changed = Path(folder) / "script.lig" if table else script
                if table:
                    changed.write_text(fault.script(text))
                words = words_of({name: path for name, path in FOLDERS.items() if f"${{{name}}}" in changed.read_text()})
                said = run([*launcher, furrow, "-in", changed, "-log", "none", *words], folder, FURROW_CACHE=cache)
                line = r"\d+: " if table else f"{len(text.rstrip().splitlines())}: {re.escape(last.split()[0])}"
                problems = list(problems_of(fault, said, rf"^  at {re.escape(str(changed))}, line {line}", usual, one_rank))
                for key, file in head:
                    if key == "intact" and not one_rank:
                        problems += problems_of_rows(Path(folder) / file)
            print(f"{'FAILED' if problems else 'ok':<8}{fault.name}", flush=True)
            if problems:
                failed += 1
                print(*(f"    {problem}" for problem in problems), said.text, sep="\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
