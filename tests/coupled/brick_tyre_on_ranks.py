# SPDX-License-Identifier: GPL-2.0-or-later
"""The brick tyre on snow on one and on two ranks: every number of the tyre's and the ground's
histories, the tyre's surface and the rut agree to 1e-10 of the largest number of their unit;
reached are 2e-13 for forces.

    brick_tyre_on_ranks.py <furrow> <mpirun -n>

The shipped scene, set down and accelerated faster: in 330 steps the tyre sinks in and rolls off.
"""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "support"))
from furrow_run import INPUTS, script_output
from same_results import compare_arrays, largest, numbers

TOLERANCE = 1e-10
STEPS = 330
# each rank bounds the step of its block; one rank sends nothing
OF_RANKS = tuple(f"terrain.h5/history/{name}" for name in ("stable_step", "halo_messages", "halo_bytes"))
CHANGES = {
    "../": f"{INPUTS}/",
    "+0.372+0.002": "+0.3725",
    "settle_time 0.4 accelerate_time 0.2":
        "settle_time 0.02 load_ramp_time 0.005 accelerate_time 0.02 release in_air",
    "every 50 vtk ${vtk}": "every 20",
    "run             ${steps}": f"run             {STEPS}",
}


def script() -> str:
    text = (INPUTS / "scenes/brick_tyre_on_snow.lig").read_text()
    for old, new in CHANGES.items():
        if old not in text:
            sys.exit(f"the scene has no '{old}'")
        text = text.replace(old, new)
    return text


def run(folder: Path, launch: list[str], furrow: str) -> Path:
    (folder / "results").mkdir(parents=True)
    (folder / "scene.lig").write_text(script())
    script_output(furrow, "scene.lig", folder, launch, results="results", cell=0.1, sections=24)
    return folder / "results"


with tempfile.TemporaryDirectory() as name:
    one = run(Path(name) / "one", [], sys.argv[1])
    two = run(Path(name) / "two", [*sys.argv[2:], "2"], sys.argv[1])
    found, _ = numbers(one, ("history",))
    lift = found["history.h5/history/force_z"]
    if not largest(lift) > 2000.0 or not largest(found["history.h5/history/force_x"]) > 30.0:
        sys.exit(f"the tyre does not roll in the snow: {largest(lift):.0f} N")
    print(compare_arrays(one, two, TOLERANCE, ("history", "surface", "rut"), OF_RANKS), "arrays are the same")
