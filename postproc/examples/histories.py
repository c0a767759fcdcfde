#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""An example to start from: the history of a run as a data frame, its mean over the cruise, a figure.

    postproc/examples/histories.py results/wheel_on_snow
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# without 'pip install ./postproc', from the tree
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import furrow_post

folder = Path(sys.argv[1])
run = furrow_post.load(folder)
channels = run.channels

CRUISE = 2  # of the channel stage
cruise = channels[channels["stage"] == CRUISE]
c = -cruise["force_x"].mean() / cruise["force_z"].mean()
print(f"{run.title}: {len(cruise)} rows of cruise, hub drop {cruise['hub_drop'].mean():.4f} m, c {c:.3f}")

axes = channels.plot("time", ["force_x", "force_z"], xlabel="time [s]")
axes.set_ylabel(f"force [{run.units['force_x']}]")
plt.savefig(folder / "forces.png")
