# SPDX-License-Identifier: GPL-2.0-or-later
"""A checkpoint of many particles: written and read back on two ranks, and read on one.

    large.py <furrow> <mpirun> <-n> [<million particles>]

Settling ground of 12 million particles unless said otherwise. The test fails when
  - a rank that writes the checkpoint takes a tenth more memory than one that does not,
  - a checkpoint that the continued run writes has another byte in any file of particles,
  - the ground that one rank has read has other energies, by more than 1e-9 of the largest.
It prints the memory and the sizes.
"""

import filecmp
import re
import resource
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import INPUTS, output

MATERIAL = INPUTS / "materials/fresh_snow.yaml"
CELL = 0.02                 # m
PARTICLES_IN_CELL = 8
MEMORY_GROWTH = 0.1         # of the memory of a run without a checkpoint
TOLERANCE = 1e-9            # of the largest energy: one rank adds up in another order
TIME_LIMIT = 3600           # s of one run

SCRIPT = """units si
atom_style granular
atom_modify sort 0 0
newton off
communicate single vel yes
{box}
neighbor 0.05 bin
timestep 1e-4
fix soil all terrain/continuum material {material} length {length} width {width} depth 1 surface 1 cell {cell} &
    clearance_above 0.04 initial_stress no cfl 0.4
{tail}
"""
NEW_BOX = "processors 2 1 1\nregion box block -100 100 -100 100 -1 3 units box\ncreate_box 1 box"
PRINT = "".join(f"variable e{n} equal f_soil[{n}]\n" for n in (1, 2, 3, 6)) + 'print "END ${e1} ${e2} ${e3} ${e6}"'


def run(command: list[str], folder: Path, script: str) -> tuple[str, float]:
    """Output of a run, and the largest memory of a process of this and all former runs [MB]."""
    (folder / "script.lig").write_text(script)
    text = output([*command, "-in", "script.lig", "-log", "none"], folder, TIME_LIMIT)
    return text, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e3


def energies(text: str) -> list[float]:
    return [float(word) for word in re.findall(r"^END (.*)$", text, flags=re.M)[0].split()]


def main(furrow: str, mpirun: str, number: str, millions: str = "12") -> None:
    cells = float(millions) * 1e6 / PARTICLES_IN_CELL
    width = 50 * CELL                             # m, 50 cells deep and wide
    length = round(cells / 2500) * CELL
    two = [mpirun, number, "2", furrow]
    def script(box: str, tail: str) -> str:
        return SCRIPT.format(box=box, material=MATERIAL, length=length, width=width, cell=CELL, tail=tail)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        particles = folder / "large.particles"
        _, before = run(two, folder, script(NEW_BOX, f"run 2\n{PRINT}"))
        text, after = run(two, folder, script(NEW_BOX, f"run 2\n{PRINT}\nwrite_restart large"))
        whole = energies(text)
        files = sorted(particles.iterdir())
        size = sum(file.stat().st_size for file in files)
        print(f"{whole[0]:.0f} particles: {size / 1e9:.3f} GB in {len(files)} files, {size / whole[0]:.1f} bytes a particle; "
              f"restart file {(folder / 'large').stat().st_size / 1e9:.3f} GB")
        print(f"memory of a rank [MB]: without a checkpoint {before:.0f} and with one {after:.0f}", flush=True)
        assert whole[0] > 0.99e6 * float(millions) and len(files) == 2
        assert size > 2**31 or float(millions) < 12, "the checkpoint is no larger than a record of LIGGGHTS can be"
        assert after < (1 + MEMORY_GROWTH) * before, "the checkpoint takes the memory of a rank"

        _, read = run(two, folder, script("read_restart large", f"write_restart again\nrun 0\n{PRINT}"))
        print(f"memory of a rank in these runs and in one that reads it [MB]: {read:.0f}", flush=True)
        again = sorted((folder / "again.particles").iterdir())
        for one, other in zip(files, again, strict=True):
            assert one.suffix == other.suffix and filecmp.cmp(one, other, shallow=False), f"{other} is not {one}"
        for file in again:
            file.unlink()
        text, _ = run([furrow], folder, script("read_restart large", f"run 0\n{PRINT}"))
        alone = energies(text)
        largest = max(map(abs, whole[1:]))
        print("energies of two ranks", *whole[1:], "and of one", *alone[1:])
        assert alone[0] == whole[0]
        assert all(abs(one - other) <= TOLERANCE * largest for one, other in zip(whole, alone)), "one rank has read other ground"


if __name__ == "__main__":
    main(*sys.argv[1:])
