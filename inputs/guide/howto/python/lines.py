#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Presses a wheel into snow, without a script file. Run it from the folder of the project."""

import furrow

lines = """
units        si
atom_style   granular
atom_modify  sort 0 0
newton       off
communicate  single vel yes
region       box block -1 1 -1 1 -1 1 units box
create_box   1 box
neighbor     0.05 bin
timestep     2e-4
fix wheel all wheel/rigid diameter 0.3 width 0.1 mass 5 inertia 0.06 axle 0 0 0.28
fix soil  all terrain/continuum material inputs/materials/fresh_snow_cam_clay.yaml length 0.8 width 0.32 &
    depth 0.12 surface 0.12 cell 0.04 symmetry yes follow wheel clearance_above 0.3
fix touch all contact/continuum body wheel terrain soil
run 400
""".splitlines()
with furrow.Simulation(lines) as run:
    wheel = run.wheels["wheel"]
    wheel.prescribe("z", -0.5)          # press the wheel down [m/s]
    while run.step(40):
        wheel.prescribe("z", 0.0 if wheel.force[2] > 100 else -0.5)
    print(f"axle at {wheel.position[2]:.3f} m, load {wheel.force[2]:.0f} N")
