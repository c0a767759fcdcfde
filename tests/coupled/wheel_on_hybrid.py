# SPDX-License-Identifier: GPL-2.0-or-later
"""The wheel of inputs/crosscheck on a hybrid, coarse: set down and moved on by 5 cm.

    wheel_on_hybrid.py <furrow>

What the base of the continuum gives is the weight of grains and continuum and the load of the wheel
(momentum), but for what walls around the grains carry by friction: 2 %, and less than 0.1 % without
friction. The continuum gives way where a
rigid floor under the same grains does not; and its long steps change the sinkage by less than the
scatter of grains. Likewise with the grains in a trough of the continuum, another packing; and where
grains and continuum go with the wheel, over more than the length of both: then the ground loses and
gains no more than the wheel pushes aside, and the wheel does not sink away or come up.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "support"))
from furrow_run import INPUTS, columns, script_output

GRAVITY, GRAIN_DENSITY = 9.80665, 2650.0
FOLDER = INPUTS / "crosscheck"


def run(results: Path, script: str, **variables: object) -> float:
    """@return sinkage at rest [m]"""
    given = {"diameter": 0.05, "distance": 0.05, "settle": 0.6, "here": FOLDER, "results": results, **variables}
    script_output(sys.argv[1], FOLDER / f"{script}.lig", results, cache=results.parent / "cache", **given)
    history = columns(results / "history.h5")
    return float(history["hub_drop"][(history["time"] > 0.5) & (history["time"] < 0.6)].mean())


def check_momentum(results: Path) -> None:
    history, ground = columns(results / "history.h5"), columns(results / "terrain.h5")
    particles, radius = columns(results / "terrain.h5", "terrain"), columns(results / "history.h5", "grains/reference")["radius"]
    mass = np.sum(particles["density"] * particles["volume"]) + np.sum(4 / 3 * np.pi * radius**3) * GRAIN_DENSITY
    base, end = ground["base_impulse"], ground["time"][-1]
    within = history["time"] <= end
    wheel = float(np.trapz(history["force_z"][within], history["time"][within]))
    expected = mass * GRAVITY * end + wheel
    print(f"base {base[-1]:.2f} N s, weights and wheel {expected:.2f} N s")
    by_walls = 1.0 - base[-1] / expected
    if not -0.003 <= by_walls <= 0.03:
        sys.exit("the base does not give what it carries")


def check_steady(results: Path) -> None:
    """Means over the first and the second half of the way in cruise."""
    history, ground = columns(results / "history.h5"), columns(results / "terrain.h5")
    x, sinkage = history["x"] - history["x"][0], history["hub_drop"]
    half = 0.5 * x[-1]
    first, second = sinkage[(x > 0.2) & (x < half)].mean(), sinkage[x >= half].mean()
    particles, travelled = ground["particles"], ground["travelled"][-1]
    print(f"sinkage {1e3 * first:.2f} and {1e3 * second:.2f} mm, ground went on {travelled:.3f} m, "
          f"{particles.min():.0f} to {particles.max():.0f} particles")
    if not 1.2 <= travelled <= x[-1] + 0.1:
        sys.exit("the ground does not go with the wheel")
    if np.ptp(particles) > 0.005 * particles[0]:
        sys.exit("ground is lost or made")
    if abs(second - first) > 0.3 * first:
        sys.exit("the sinkage is not steady")


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    cell = {"cell": 0.0666667}
    long_steps = run(folder / "long", "wheel_sand_hybrid", **cell)
    short_steps = run(folder / "short", "wheel_sand_hybrid", multirate="no", **cell)
    trough = run(folder / "trough", "wheel_sand_hybrid", trough=0.4, every=2, **cell)
    run(folder / "moving", "wheel_sand_hybrid", period=1.2, slabs=8, distance=1.4)
    rigid = run(folder / "rigid", "wheel_sand_grains", depth=0.15)
    print(f"sinkage {1e3 * long_steps:.2f} mm, with short steps {1e3 * short_steps:.2f} mm, "
          f"in a trough {1e3 * trough:.2f} mm, on a rigid floor {1e3 * rigid:.2f} mm")
    check_momentum(folder / "long")
    check_momentum(folder / "trough")
    check_momentum(folder / "moving")
    check_steady(folder / "moving")
    if abs(long_steps - short_steps) > 0.15 * short_steps:
        sys.exit("the continuum's long steps change the sinkage")
    if min(long_steps, trough) < rigid + 0.004:
        sys.exit("the continuum under the grains does not give way")
