# SPDX-License-Identifier: GPL-2.0-or-later
"""Both kinds of rig find the same curves: run.py <furrow>

A wheel with prescribed spin, free along x, finds a slip under a drawbar load, and another on a
slope, where W sin(slope) takes the place of that load (pull-slip and slope-slip curves). At that
slip the rig that prescribes speed and slip must measure the load as drawbar pull, within COVERAGE
standard errors of pull and slip together. Its pull there is interpolated between two runs.
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
LOAD = 3000.0  # W, of wheel.lig [N]
PULL = 150.0  # [N]
SLOPE = math.degrees(math.asin(PULL / LOAD))
FREE = "travel free mode spin spin_rate 5.4 dragged_mass 60"
RIGS = {"drawbar load": f"{FREE} drawbar_load {PULL:g}", "slope": f"{FREE} slope {SLOPE:.6f}"}
SLIPS = (-0.03, 0.0)  # below and above what the free wheels find
PRESCRIBED = "speed 2.03 mode slip slip {}"  # [m/s] as fast as the free wheels
COVERAGE = 2.0  # standard errors
SHARPEST = 0.01  # of the load: no larger difference, however large the errors


def run(furrow, folder, name, drive, duration):
    """(slip, its error), (pull, its error [N])"""
    done = subprocess.run(
        [furrow, "-in", HERE / "wheel.lig", "-log", "none", "-var", "results", folder / name,
         "-var", "drive", drive, "-var", "duration", str(duration)],
        cwd=HERE, text=True, stdin=subprocess.DEVNULL, timeout=500,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{name}: status {done.returncode}\n{done.stdout[-4000:]}")
    values = json.loads((folder / name / "summary.json").read_text())["quantities"]
    slip, pull = ((values[key]["mean"], values[key]["standard_error"])
                  for key in ("slip", "drawbar_pull"))
    print(f"{name}: slip {slip[0]:.4f} +- {slip[1]:.4f}, pull {pull[0]:.1f} +- {pull[1]:.1f} N")
    return slip, pull


def main(furrow):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        pulls = [run(furrow, folder, f"prescribed_{slip:g}", PRESCRIBED.format(slip), 1.0)[1]
                 for slip in SLIPS]
        found = {rig: run(furrow, folder, rig.replace(" ", "_"), drive, 1.2)
                 for rig, drive in RIGS.items()}
    steepness = (pulls[1][0] - pulls[0][0]) / (SLIPS[1] - SLIPS[0])  # of the pull over the slip [N]
    for rig, ((slip, slip_error), (pull, _)) in found.items():
        assert SLIPS[0] < slip < SLIPS[1], f"{rig}: slip {slip:.4f} is not between {SLIPS}"
        assert abs(pull - PULL) < 1e-3 * PULL, f"{rig}: pulls {pull:.5g} N, not {PULL:g}"
        share = (slip - SLIPS[0]) / (SLIPS[1] - SLIPS[0])
        expected = (1.0 - share) * pulls[0][0] + share * pulls[1][0]
        error = math.hypot((1.0 - share) * pulls[0][1], share * pulls[1][1], steepness * slip_error)
        print(f"{rig}: at its slip of {slip:.4f} the other rig pulls {expected:.1f} +- {error:.1f} N, "
              f"itself {pull:.1f}")
        assert abs(pull - expected) <= min(COVERAGE * error, SHARPEST * LOAD), \
            f"{rig}: the rigs do not agree"


if __name__ == "__main__":
    main(sys.argv[1])
