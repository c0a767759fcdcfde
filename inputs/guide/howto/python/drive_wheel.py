#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A driver raises the slip of a wheel on snow until the pull no longer grows: drive_wheel.py [FOLDER]"""

import sys
from pathlib import Path

import furrow
import numpy as np

SCENE = Path(__file__).resolve().parents[3] / "scenes" / "wheel_on_snow.lig"
results = sys.argv[1] if len(sys.argv) > 1 else "results/drive_wheel"
variables = {"results": results, "cell": 0.1, "distance": 1.2, "motion": "mode slip slip 0.05", "vtk": 0}

print("time [s]  slip  pull [N]  hub drop [m]")
with furrow.Simulation(SCENE, variables=variables) as run:
    rig, pulls = run.rigs["rig"], []
    while run.time < 0.8:  # settle, accelerate, and a short cruise
        run.step(100)
    while run.step(5):
        pulls.append(rig.measure()["drawbar_pull"])
        if len(pulls) < 60:
            continue
        row, slip = rig.measure(), rig.targets["slip"]
        print(f"{run.time:8.3f} {slip:5.2f} {np.mean(pulls):9.0f} {row['hub_drop']:13.4f}")
        if slip < 0.3:
            rig.set(slip=slip + 0.05)
        pulls.clear()
print("results:", results)
