#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Instructions for a grain and step of two grounds of the laboratory at rest, counted by callgrind,
so whatever else the machine does: snow_cost.py FURROW. Takes half a minute."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

LABORATORY = Path(__file__).resolve().parents[2] / "inputs/laboratory"
CLUSTERS = 300
STEPS = (100, 300)  # the difference is free of what a start costs

PREPARE = """
variable        seed index 86028121
include         ${here}/parts/cell.lig
run             200
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
thermo          100000
run             ${steps}
"""


def variables(ground: str) -> list[str]:
    return ["-v", "here", str(LABORATORY), "-v", "ground", ground]


def properties(ground: str) -> str:
    """Those of the snow instead of those that its clusters are packed with."""
    if not ground.startswith("snow_bonded"):
        return ""
    return (LABORATORY / "parts/snow_bonded_sinter.lig").read_text().split("velocity")[0]


def instructions(furrow: str, folder: Path, ground: str, extra: str = "") -> float:
    """For a grain and step."""
    script = folder / "measure.lig"
    text = MEASURE.replace("PROPERTIES", properties(ground)).replace("EXTRA", extra)
    script.write_text(text)
    counts = []
    for steps in STEPS:
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", furrow,
             "-in", script.name, *variables(ground), "-v", "steps", str(steps)],
            cwd=folder, capture_output=True, text=True, check=True,
        )  # fmt: skip
        counts.append(int(re.findall(r"Collected : (\d+)", run.stderr)[-1]))
    return (counts[1] - counts[0]) / (STEPS[1] - STEPS[0]) / CLUSTERS


def main() -> None:
    furrow = str(Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        found = {}
        for ground in ("snow", "snow_bonded"):
            (folder / "prepare.lig").write_text(PREPARE)
            subprocess.run(
                [furrow, "-in", "prepare.lig", *variables(ground), "-v", "grains", str(CLUSTERS)],
                cwd=folder, stdout=subprocess.DEVNULL, check=True,
            )  # fmt: skip
            found[ground] = instructions(furrow, folder, ground)
        counted = "snow_bonded, with fix snow/energy"
        found[counted] = instructions(
            furrow, folder, "snow_bonded", "fix energy all snow/energy"
        )
    for ground, count in found.items():
        print(f"{ground:35} {count:6.0f}  {count / found['snow']:.2f}")


if __name__ == "__main__":
    main()
