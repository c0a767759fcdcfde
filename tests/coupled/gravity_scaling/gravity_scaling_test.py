# SPDX-License-Identifier: GPL-2.0-or-later
"""Granular scaling: wheels of other sizes in other gravities give the same numbers.

    gravity_scaling_test.py <furrow>

Sand without cohesion and rate has no length and no time: with lengths L, times sqrt(L/g), masses
L^3 and stresses L g, a wheel's slip, hub drop over L and forces over its weight are the same
[Slonaker2017]. All factors are powers of 2, which rounding
does not change: what differs, a number with a unit in the program has done.
A wheel with its lunar load on the Earth is not scaled: it sinks less and pulls more than on the Moon.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import INPUTS, columns, script_output

HERE = Path(__file__).resolve().parent
SAND = INPUTS / "materials" / "dry_sand_smooth.yaml"
EARTH, MOON = 9.80665, 1.62  # [m/s^2]
ROUNDING = 1e-9  # of the largest value


def material(path, stress):
    """The sand with its stresses times a factor, digits kept, and without its contact, which has a
    length."""
    sand = yaml.safe_load(SAND.read_text())
    del sand["contact"]
    sand["title"] = path.stem
    sand["law"]["d"] = float(sand["law"]["d"]) * stress
    sand["elasticity"]["E"] = float(sand["elasticity"]["E"]) * stress
    sand["hardening"]["p"] = [float(p) * stress for p in sand["hardening"]["p"]]
    path.write_text(yaml.safe_dump(sand))


def run(furrow, folder, name, length, gravity, stress, share=1.0):
    material(folder / f"{name}.yaml", stress)
    script_output(furrow, HERE / "wheel.lig", folder, results=folder / name, material=folder / f"{name}.yaml", L=length,
                  gravity=gravity, share=share)
    time = np.sqrt(length / gravity)
    weight = 10.0 * share * length**3 * gravity
    scale = {"time": time, "hub_drop": length, "x": length, "force_x": weight, "force_z": weight,
             "drive_torque": weight * length, "contact_work": weight * length, "slip": 1.0}
    history = columns(folder / name / "history.h5")
    return {key: history[key] / factor for key, factor in scale.items()}


def steady(history):
    """Means of the last third, a dictionary."""
    return {key: float(values[-len(values) // 3:].mean()) for key, values in history.items()}


def main(furrow):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        earth = run(furrow, folder, "Earth", 1.0, EARTH, 1.0)
        assert abs(steady(earth)["force_x"]) > 0.02, "the wheel has no pull to compare"
        # half the size in an eighth of the gravity: times twice, stresses a sixteenth
        small = run(furrow, folder, "small", 0.5, EARTH / 8.0, 1.0 / 16.0)
        for key, values in earth.items():
            largest = np.abs(values).max()
            error = np.abs(small[key] - values).max() / largest
            print(f"{key:14} largest {largest:10.4g}, difference over it {error:.2g}")
            assert error <= ROUNDING, f"{key} is not that of the scaled wheel"
        # the load of the Moon on the Earth: its stresses are those of the Moon, the sand's are not
        moon = steady(run(furrow, folder, "Moon", 1.0, MOON, 1.0))
        reduced = steady(run(furrow, folder, "reduced", 1.0, EARTH, 1.0, share=MOON / EARTH))
        for name, values in (("Moon", moon), ("load of the Moon on the Earth", reduced)):
            print(f"{name}: hub drop {1e3 * values['hub_drop']:.2g} mm, pull over load {values['force_x']:.2f}")
        assert moon["hub_drop"] > 2.0 * reduced["hub_drop"], "reduced weight does not sink less"
        assert reduced["force_x"] > 1.3 * moon["force_x"], "reduced weight does not pull more"


if __name__ == "__main__":
    main(sys.argv[1])
