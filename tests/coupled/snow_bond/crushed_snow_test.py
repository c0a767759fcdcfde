# SPDX-License-Identifier: GPL-2.0-or-later
"""A block of sintered snow that is crushed and torn, with what grains may meet.

    crushed_snow_test.py ranks.<load> <furrow> <mpirun -n>      on 1, 2 and 3 ranks: to rounding, and the same bonds
    crushed_snow_test.py restart.<load> <furrow> <mpirun -n>    continued after half of it, on 1 and 2 ranks: every bit
    crushed_snow_test.py mesh_as_plane <furrow> <mpirun -n>     thrown at a mesh of LIGGGHTS as at a plane;
                                                                every bit without AVX2 as with it, and in the
                                                                loop of LIGGGHTS as in Furrow's
    crushed_snow_test.py initial_overlap <furrow> <mpirun -n>   accepted where snow is crushed, warned of where it
                                                                is crushed to ice

Loads: plate (crushed on a plane by a body of Furrow), soft (the same, snow that does not harden),
hybrid (on a continuum), plane and mesh (thrown at walls of LIGGGHTS, without a body of Furrow),
frozen and counted (variants of plane).
"""

import os
import re
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import script_output

HERE = Path(__file__).resolve().parent
TIME_LIMIT = 250  # s; on a busy machine ranks wait for each other in every step
DIAMETER = 0.02  # m
ROUNDING = 1e-9  # m; sums over ranks and ghosts come in another order, and differences grow
THROWN = {"velocity": "1 0.3 -3"}  # m/s
VARIABLES = {"plate": {}, "soft": {}, "hybrid": {"steps": 2001}, "plane": THROWN, "mesh": THROWN,
             "frozen": THROWN, "counted": THROWN}


def write_floor(path):
    """A level square of 0.24 m at z = 0, in 5 x 5 squares of two triangles."""
    side, cells = 0.24, 5
    knots = [side * (k / cells - 0.5) for k in range(cells + 1)]
    lines = ["solid floor"]
    for x, right in zip(knots, knots[1:]):
        for y, back in zip(knots, knots[1:]):
            for corners in (((x, y), (right, y), (right, back)), ((x, y), (right, back), (x, back))):
                vertices = [f"vertex {px:.17g} {py:.17g} 0" for px, py in corners]
                lines += ["facet normal 0 0 1", "outer loop", *vertices, "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid floor", ""]))


def run(furrow, mpirun, folder, ranks, load, **more):
    folder.mkdir(exist_ok=True)
    write_floor(folder / "floor.stl")
    variables = {"here": HERE, "load": load, **VARIABLES[load], **more}
    said = script_output(furrow, HERE / "crushed.lig", folder, [*mpirun, ranks], TIME_LIMIT, **variables)
    (folder / "screen.txt").write_text(said)
    return np.loadtxt(folder / "grains.txt", skiprows=9), (folder / "bonds.txt").read_text()


def check_that_it_happens(grains, bonds):
    _, all_bonds, _, made, _, broken = bonds.split()
    assert float(broken) > 100 and float(made) > 50, f"hardly a bond breaks: {bonds}"
    assert grains[:, 3].max() < 0.115, "the block is not crushed"


def compare(what, one, other, tolerance):
    difference = np.abs(one[0][:, 1:4] - other[0][:, 1:4]).max()
    print(f"{what}: largest difference {difference:.1e} m; {other[1].strip()}")
    assert difference <= tolerance
    assert one[1] == other[1], f"{one[1]} and {other[1]}"


def ranks(furrow, mpirun, folder, load):
    alone = run(furrow, mpirun, folder / "one", 1, load)
    check_that_it_happens(*alone)
    for number in (2, 3):
        compare(f"{number} ranks", alone, run(furrow, mpirun, folder / str(number), number, load), ROUNDING)


def restart(furrow, mpirun, folder, load):
    for number in (1, 2):
        place = folder / str(number)
        whole = run(furrow, mpirun, place, number, load)
        check_that_it_happens(*whole)
        continued = run(furrow, mpirun, place, number, load, start="continued", **{"from": "checkpoint.2000"})
        assert np.array_equal(continued[0], whole[0])
        compare(f"{number} ranks", whole, continued, 0.0)


def mesh_as_plane(furrow, mpirun, folder):
    plane, mesh = (run(furrow, mpirun, folder / load, 1, load) for load in ("plane", "mesh"))
    check_that_it_happens(*plane)
    compare("mesh and plane", plane, mesh, ROUNDING)
    compare("LIGGGHTS's loop", *(run(furrow, mpirun, folder / load, 1, load) for load in ("frozen", "counted")), 0.0)
    os.environ["FURROW_ISA"] = "baseline"
    compare("without AVX2", plane, run(furrow, mpirun, folder / "baseline", 1, "plane"), 0.0)


def initial_overlap(furrow, mpirun, folder):
    """Those of crushed snow are accepted; on a body beyond 0.4 of a diameter there is a warning, and
    one where two clusters leave less room to the snow between them than ice has."""
    ice = 917.0  # kg/m3
    for load, speed, density, ranks in (("plate", 1.2, 340, 1), ("soft", 2.5, 340, 1), ("plate", 1.2, 700, 2)):
        place = folder / f"{load}_{density}"
        grains, _ = run(furrow, mpirun, place, ranks, load, speed=speed, density=density)
        distances = np.linalg.norm(grains[:, None, 1:4] - grains[None, :, 1:4], axis=2)
        between = 1.0 - distances[distances > 0.0].min() / DIAMETER
        screen = (place / "screen.txt").read_text()
        on_plate = re.findall(r"overlaps the body by ([\d.]+) of its diameter", screen)
        of_clusters = re.findall(r"two clusters overlap by ([\d.]+) .* has (\d+) kg/m3", screen)
        print(f"{load}: {between:.2f} between clusters of {density} kg/m3, warned of {of_clusters}, "
              f"on the plate: {on_plate}")
        assert load == "soft" or between > 0.2, "the snow is hardly crushed"
        assert len(on_plate) == (load == "soft") and all(float(overlap) > 0.4 for overlap in on_plate)
        assert len(of_clusters) == (density == 700), screen
        for overlap, pressed in of_clusters:  # from then on: at the end it may be more
            assert 1.0 - density / ice <= float(overlap) + 0.005 <= between + 0.015
            assert abs(density / (1.0 - float(overlap)) - float(pressed)) < 0.01 * ice


if __name__ == "__main__":
    case, program, *launcher = sys.argv[1:]
    check, *loads = case.split(".")
    with tempfile.TemporaryDirectory() as scratch:
        checks = {"ranks": ranks, "restart": restart, "mesh_as_plane": mesh_as_plane, "initial_overlap": initial_overlap}
        checks[check](program, launcher, Path(scratch), *loads)
