# SPDX-License-Identifier: GPL-2.0-or-later
"""A source tree with a program that stands for furrow: it does what its variables say."""

import os
import sys
from pathlib import Path

from furrow_post.run.case import Case, Value
from furrow_post.run.case import script_case
from furrow_post.run.tools import Tools

REAL = Path(os.environ["FURROW_BUILD"]) / "bin"
# First lines of a program that stands for furrow: the real one lists the variables of scripts
ANSWER = f"""import os, sys
if "--variables" in sys.argv:
    os.execv({str(REAL / "furrow")!r}, ["furrow", *sys.argv[1:]])
"""
# Variables: sleep [s], fail (message), status, signal (number), value, checkpoint. Every start adds
# a line to starts.txt in the build folder.
PROGRAM = """#!{python} -S
{answer}
import pathlib, time
words = sys.argv[1:]
v = dict(zip(*[iter(w for i, w in enumerate(words) if "-var" in words[max(i - 2, 0):i])] * 2))
with open(pathlib.Path(__file__).parents[1] / "starts.txt", "a") as file:
    file.write(pathlib.Path(v["results"]).name + "\\n")
print("reading", words[1], flush=True)
time.sleep(float(v.get("sleep", 0)))
if "checkpoint" in v:
    (pathlib.Path(v["results"]) / "restart_forced_liggghts_7.data").write_text("")
if "signal" in v:
    os.kill(os.getpid(), int(v["signal"]))
if "fail" in v:
    print("ERROR: " + v["fail"] + " (made.cpp:1)")
    sys.exit(1)
if "status" in v:
    print("furrow: " + v["results"] + " is bad", file=sys.stderr)
    sys.exit(int(v["status"]))
print("FACTS steps 1 value 0")
print("FACTS steps 10 value", v.get("value", 1))
"""


class FakeTree:
    """A tree with inputs/made, a build folder with the program, and a script."""

    def __init__(self, folder: Path) -> None:
        self.root = folder / "tree"
        self.study = self.root / "inputs" / "made"
        self.study.mkdir(parents=True)
        (self.root / "CMakeLists.txt").write_text("")
        self.script = self.study / "made.lig"
        self.script.write_text("run 1\n")
        self.build = self.root / "build"
        (self.build / "bin").mkdir(parents=True)
        self.program = self.build / "bin" / "furrow"
        self.install()

    def install(self, remark: str = "") -> None:
        """The program; another remark makes another program."""
        self.program.write_text(PROGRAM.format(python=sys.executable, answer=ANSWER) + f"# {remark}\n")
        self.program.chmod(0o755)

    @property
    def tools(self) -> Tools:
        return Tools.of(self.study / "run.py", self.build)

    def case(self, name: str, **variables: Value) -> Case:
        return script_case(name, self.script, variables)

    def starts(self) -> list[str]:
        """Names of the runs in the order in which they were started."""
        path = self.build / "starts.txt"
        return path.read_text().split() if path.exists() else []
