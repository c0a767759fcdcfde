# SPDX-License-Identifier: GPL-2.0-or-later
"""A wheel on sand has the same loads in cells that are fine around it only as in cells that are fine everywhere.

The ground has fewer particles, and their number does not grow with the way. The wheel is that of
inputs/crosscheck/wheel_continuum.lig.

    graded_window_test.py <furrow> <folder of the script>
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, script_output

CELL, LENGTH, FINE, DISTANCE, LOAD = 0.08, 3.2, 0.65, 1.2, 3120.0  # [m], [N]
STEADY = 0.4            # of the rows, the last ones
HUB_DROP, FORCE = 0.03, 0.02  # allowed: of the hub drop; of the load


def roll(furrow, scripts, folder, keywords):
    """@return steady means of the history, columns of the terrain's history"""
    script_output(furrow, scripts / "wheel_continuum.lig", folder, here=scripts, results=folder, cell=CELL, length=LENGTH,
                  distance=DISTANCE, load=LOAD, slip=0.1, scheme=f"growth 1.3 {keywords}")
    rows = columns(folder / "history.h5")
    steady = slice(-int(STEADY * len(rows["hub_drop"])), None)
    means = {name: rows[name][steady].mean() for name in ("hub_drop", "drawbar_pull", "drive_torque")}
    return means, columns(folder / "terrain.h5")


def main(furrow, scripts):
    with tempfile.TemporaryDirectory() as name:
        even, even_terrain = roll(furrow, Path(scripts), Path(name) / "even", "")
        graded, terrain = roll(furrow, Path(scripts), Path(name) / "graded", f"fine_length {FINE}")
    for channel in even:
        print(f"{channel}: {even[channel]:.4g} in even cells, {graded[channel]:.4g} in graded ones")
    particles = terrain["particles"]
    even_balance, balance = (np.abs(run["residual"]).max() / np.abs([run["contact_work"], run["load_work"]]).max()
                             for run in (even_terrain, terrain))
    print(f"particles {even_terrain['particles'][0]:.0f}, {particles[0]:.0f} to {particles.max():.0f}; travelled {terrain['travelled'][-1]:.3g} m; "
          f"energy balance {even_balance:.1e}, {balance:.1e}")
    assert abs(graded["hub_drop"] / even["hub_drop"] - 1) < HUB_DROP
    assert abs(graded["drawbar_pull"] - even["drawbar_pull"]) < FORCE * LOAD
    assert abs(graded["drive_torque"] - even["drive_torque"]) < FORCE * LOAD * 0.37  # radius of the wheel [m]
    assert terrain["travelled"][-1] > 0.5 and particles[0] < 0.75 * even_terrain["particles"][0]
    assert particles.max() < 1.2 * particles[0], "particles behind the wheel stay divided"
    assert balance < 1.5 * even_balance


if __name__ == "__main__":
    main(*sys.argv[1:])
