# SPDX-License-Identifier: GPL-2.0-or-later
"""A wheel run that is stopped and continued, against the same run without a break: the histories
must agree.

    restart_test.py <case> <furrow> [<mpirun -n>]

Cases, with the largest difference reached here over 2000 steps, relative to the largest value of a
channel:
    exact       checkpoint at a multiple of 1000 steps, killed later, continued: every bit
    slip        the same with prescribed slip: every bit
    sinkage     the same with prescribed sinkage: every bit
    off_sort    checkpoint at another step than those at which LIGGGHTS sorts its grains: every bit
    two_runs    checkpoint by write_restart between two runs of one process: every bit. Both begin
                with LIGGGHTS's set-up.
    one_to_two  continued on two ranks: 3e-11. Sums over ranks and ghosts come in another order.
    two         two ranks throughout: every bit
    hybrid      on grains and a continuum that go with the wheel, renewed before the checkpoint and
                after it: every bit
    hybrid_two  the same on two ranks: every bit
Rounding differences grow with time, because grains are chaotic; the bound of 1e-9 leaves room for
them over these 2000 steps, and none for a missing state: without the forces of the checkpoint's
step the difference was 1e-2.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, script_output

HERE = Path(__file__).resolve().parent
ROUNDING = 1e-9   # of the largest value of a channel

# options of the script, ranks before and after the checkpoint, tolerance, script
CASES = {
    "exact": ({}, 1, 1, 0.0, "wheel"),
    "slip": ({"drive": "mode slip slip 0.2"}, 1, 1, 0.0, "wheel"),
    "sinkage": ({"load": "sinkage 0.004"}, 1, 1, 0.0, "wheel"),
    "off_sort": ({"checkpoint": 12340}, 1, 1, 0.0, "wheel"),
    "two_runs": ({}, 1, 1, 0.0, "two_runs"),
    "one_to_two": ({}, 1, 2, ROUNDING, "wheel"),
    "two": ({}, 2, 2, 0.0, "wheel"),
    "hybrid": ({}, 1, 1, 0.0, "hybrid"),
    "hybrid_two": ({}, 2, 2, 0.0, "hybrid"),
}


def history(folder):
    return columns(folder / "results/history.h5")


def difference(one, other):
    """Largest difference of each channel over its largest value."""
    assert one.keys() == other.keys()
    assert np.array_equal(one["time"], other["time"]), "rows are missing or double"
    return {name: np.abs(one[name] - other[name]).max() / max(np.abs(one[name]).max(), 1e-300) for name in one}


def main(case, furrow, *mpirun):
    options, before, after, tolerance, script = CASES[case]
    checkpoint = options.get("checkpoint", 12000)
    with tempfile.TemporaryDirectory() as folder:
        whole, parts = Path(folder) / "whole", Path(folder) / "parts"

        def run(part, script, ranks, **more):
            launcher = [*mpirun, ranks] if ranks > 1 else []
            script_output(furrow, HERE / f"{script}.lig", part, launcher, cache=f"{folder}/cache", here=HERE, **options, **more)

        run(whole, script, before)
        # The first part goes on beyond its checkpoint, as a run does that is killed: those rows must
        # be dropped.
        run(parts, script, before, until=checkpoint + 500)
        moving = history(whole)
        assert len(history(parts)["time"]) < len(moving["time"])
        run(parts, "wheel" if script == "two_runs" else script, after, **{"from": f"checkpoint.{checkpoint}"})

        largest = difference(moving, history(parts))
        worst = max(largest, key=largest.get)
        print(f"{case}: {len(moving['time'])} rows, largest difference {largest[worst]:.1e} of the largest {worst}")
        assert np.ptp(moving["x"]) > 0.01 and moving["force_z"].max() > 5.0, "the wheel does not roll on the bed"
        assert largest[worst] <= tolerance, f"differences: { {k: v for k, v in largest.items() if v > tolerance} }"
        names = [sorted(path.name for path in (part / "results/vtk").iterdir()) for part in (whole, parts)]
        assert names[0] == names[1], f"frames differ: {names}"
        for series in ("wheel.pvd", "grains.pvd"):
            assert (whole / "results/vtk" / series).read_text() == (parts / "results/vtk" / series).read_text(), series


if __name__ == "__main__":
    main(*sys.argv[1:])
