# SPDX-License-Identifier: GPL-2.0-or-later
"""Sintered snow on a slope steeper than its friction with the floor, 25 degrees and 0.3.

    tilted_bed.py <furrow>

On a plane the bed comes down nearly as fast as a block does, g (sin a - mu cos a): its side walls hold
it a little, its lowest clusters may roll. Frozen to the ground by its base it stays.
"""

import math
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import INPUTS, script_output

HERE = Path(__file__).resolve().parent
GRAVITY, FRICTION, SLOPE, TIME = 9.80665, 0.3, math.radians(25), 0.05


def speed_downhill(furrow, folder, base):
    """Clusters of the frozen base, mean speed [m/s], level of the bed [m]."""
    script_output(furrow, HERE / "tilted_bed.lig", folder, seconds=200, beds=INPUTS / "beds", base=base)
    _, frozen, _, downhill, _, level = (folder / "slope.txt").read_text().split()
    return int(float(frozen)), float(downhill), float(level)


with tempfile.TemporaryDirectory() as scratch:
    plane = speed_downhill(sys.argv[1], Path(scratch), 0)
    rough = speed_downhill(sys.argv[1], Path(scratch), 0.02)
print(f"on a plane {plane}, frozen {rough}")
block = GRAVITY * (math.sin(SLOPE) - FRICTION * math.cos(SLOPE)) * TIME
assert plane[0] == 0 and rough[0] > 20
assert 0.8 * block < plane[1] < GRAVITY * math.sin(SLOPE) * TIME, block
assert abs(rough[1]) < 0.02 * block
assert abs(rough[2] - plane[2]) < 0.01, "both are levelled at the same height above the ground"
