#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Instructions for a grain and step of two grounds of the laboratory, at rest and while they are
crushed at the same density and rate, counted by callgrind, so whatever else the machine does:
snow_cost.py FURROW. Takes two minutes.

Over those of `snow`: of a grain, its contacts (the packing), and of a contact (the law); the first
is the product of the others."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

LABORATORY = Path(__file__).resolve().parents[2] / "inputs/laboratory"
CLUSTERS = 300
STEPS = (100, 300)  # the difference is free of what a start costs

PREPARE = """
variable        seed index 86028121
include         ${here}/parts/cell.lig
PRESS
variable        steps equal round(${strain}/2/${time_step})+200
run             ${steps}
write_restart   ${ground}.restart
"""

MEASURE = """
atom_style      granular
atom_modify     map array
boundary        p p p
newton          off
communicate     single vel yes
units           si
processors      1 1 *
include         ${here}/grounds/${ground}.lig
read_restart    ${ground}.restart
variable        skin equal 0.3*${diameter}
neighbor        ${skin} bin
neigh_modify    delay 0
include         ${here}/parts/${family}.lig
PROPERTIES
fix             move all nve/sphere
EXTRA
compute         touching all contact/atom
compute         contacts all reduce sum c_touching
thermo_style    custom step c_contacts
thermo          100000
run             ${steps}
"""

PRESS = "fix cell all cell/servo rate_z 2"
ENERGY = "fix energy all snow/energy"


class State(NamedTuple):
    name: str
    strain: float  # of confined compression before
    motion: str  # before, and while steps are counted


STATES = (State("at rest", 0.0, ""), State("pressed together by a fifth, at 2 1/s", 0.223, PRESS))


class Cost(NamedTuple):
    instructions: float  # for a grain and step
    contacts: float  # of a grain

    @property
    def of_a_contact(self) -> float:
        return self.instructions / self.contacts


def variables(ground: str, **others: float) -> list[str]:
    values = {"here": LABORATORY, "ground": ground, **others}
    return [word for name, value in values.items() for word in ("-v", name, str(value))]


def properties(ground: str) -> str:
    """Those of the snow instead of those that its clusters are packed with."""
    if not ground.startswith("snow_bonded"):
        return ""
    return (LABORATORY / "parts/snow_bonded_sinter.lig").read_text().split("velocity")[0]


def prepare(furrow: str, folder: Path, ground: str, state: State) -> None:
    (folder / "prepare.lig").write_text(PREPARE.replace("PRESS", state.motion))
    subprocess.run(
        [furrow, "-in", "prepare.lig", *variables(ground, strain=state.strain, grains=CLUSTERS)],
        cwd=folder, stdout=subprocess.DEVNULL, check=True,
    )  # fmt: skip


def cost(furrow: str, folder: Path, ground: str, state: State, extra: str = "") -> Cost:
    script = folder / "measure.lig"
    text = MEASURE.replace("PROPERTIES", properties(ground))
    text = text.replace("EXTRA", f"{state.motion}\n{extra}")
    script.write_text(text)
    counts = []
    for steps in STEPS:
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", furrow,
             "-in", script.name, *variables(ground, steps=steps)],
            cwd=folder, capture_output=True, text=True, check=True,
        )  # fmt: skip
        counts.append(int(re.findall(r"Collected : (\d+)", run.stderr)[-1]))
    rows = re.findall(r"^ *\d+ +([\d.e+]+) *$", run.stdout, re.MULTILINE)
    each = (counts[1] - counts[0]) / (STEPS[1] - STEPS[0]) / CLUSTERS
    return Cost(each, 0.5 * float(rows[-1]) / CLUSTERS)


def row(found: Cost, plain: Cost) -> str:
    pairs = (
        (found.instructions, plain.instructions, "9.0f"),
        (found.contacts, plain.contacts, "9.2f"),
        (found.of_a_contact, plain.of_a_contact, "12.0f"),
    )
    return "  ".join(f"{mine:{form}}  {mine / other:.2f}" for mine, other, form in pairs)


def main() -> None:
    furrow = str(Path(sys.argv[1]).resolve())
    print(f"{'':36}per grain  over   contacts  over   per contact  over")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for state in STATES:
            for ground in ("snow", "snow_bonded"):
                prepare(furrow, folder, ground, state)
            plain = cost(furrow, folder, "snow", state)
            bonded = cost(furrow, folder, "snow_bonded", state)
            counted = cost(furrow, folder, "snow_bonded", state, ENERGY)
            print(state.name)
            for label, found in (
                ("snow", plain), ("snow_bonded", bonded), ("snow_bonded, with fix snow/energy", counted),
            ):
                print(f"  {label:33} {row(found, plain)}")


if __name__ == "__main__":
    main()
