# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow on faults, a table of cases at a time, and checks how each is refused."""

import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import Said, run

SIZE_LIMIT = 1e6  # of what is said [bytes]: no endless warnings

# A box with grains that fall on a floor, and the same continued.
GRAINS = """units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
region box block -0.1 0.1 -0.1 0.1 0 0.2 units box
create_box 1 box
{properties}
lattice sc 0.02
region layer block -0.08 0.08 -0.08 0.08 0.01 0.12 units box
create_atoms 1 region layer
set group all diameter 0.019 density 2500
"""
PROPERTIES = """neighbor 0.005 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.3
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran model hertz tangential history
pair_coeff * *
timestep 2e-5
fix weight all gravity 9.80665 vector 0 0 -1
fix floor all wall/gran model hertz tangential history primitive type 1 zplane 0
fix move all nve/sphere
"""
GRAINS = GRAINS.format(properties=PROPERTIES)
CONTINUED = "newton off\ncommunicate single vel yes\nread_restart {file}\n" + PROPERTIES
# A wheel far above the grains: its state is a part of a checkpoint, and so are all forces.
WHEEL = ("fix wheel all wheel/rigid diameter 0.04 width 0.02 shoulder 0.005 mass 1 inertia 2e-4 segments 24 "
         "axle 0 0 0.17\n")


def run_script(furrow, folder, script, launcher=(), **environment):
    (Path(folder) / "script.lig").write_text(script)
    return run([*launcher, furrow, "-in", "script.lig", "-log", "none"], folder, **environment)


class Table:
    """Cases one after the other; a line each, and the status of all at the end."""

    def __init__(self):
        self.cases, self.failed = 0, []
        self._folder = tempfile.TemporaryDirectory()
        self.folder = Path(self._folder.name)

    def check(self, name, said, status, *texts, absent=()):
        """The status is this one, the texts are in the output, and in at most one message."""
        self.cases += 1
        problems = []
        if said.status != status:
            problems.append(f"status {said.status} instead of {status}")
        problems += [f"does not say: {text}" for text in texts if text not in said.text]
        problems += [f"says: {text}" for text in absent if text in said.text]
        if len(re.findall("^ERROR", said.text, re.M)) > 1:
            problems.append("says more than one error")
        if len(said.text) > SIZE_LIMIT:
            problems.append(f"says {len(said.text)} bytes")
        print("FAILED" if problems else "ok", name, *problems, sep=": ", flush=True)
        if problems:
            print("\n".join(said.text.splitlines()[-12:]))
            self.failed.append(name)

    def expect(self, name, truth, what):
        self.check(name, Said(0 if truth else what, ""), 0)

    def end(self):
        if not self.cases:
            sys.exit("no case was tried")
        if self.failed:
            sys.exit(f"{len(self.failed)} of {self.cases} cases failed: {', '.join(self.failed)}")
        print(self.cases, "cases")
