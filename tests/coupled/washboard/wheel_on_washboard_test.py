# SPDX-License-Identifier: GPL-2.0-or-later
"""The sprung wheel of wheel_on_washboard.lig on a continuum with a corrugated surface, in plane strain.

    wheel_on_washboard_test.py <furrow> <scene>

At the frequency of the washboard the sprung mass follows the axle by the closed form of spring and
damper, and the contact force is what moves both masses, on any ground. On stiff elastic ground the
axle follows the washboard, which stays. On sand that yields the wheel levels it: crests are lower
and troughs higher after the pass, and the force swings less.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, script_output

WAVELENGTH, AMPLITUDE, SPEED = 0.5, 0.012, 2.0  # [m], [m], [m/s]
UNSPRUNG, SPRUNG = 10.0, 20.0  # of the scene with mass 30 [kg]
FREQUENCY = 2 * np.pi * SPEED / WAVELENGTH  # [rad/s]; that of the spring is the same, a resonance
SPRING, DAMPER = SPRUNG * FREQUENCY**2, SPRUNG * FREQUENCY  # [N/m], [N s/m], half of critical
STRUT = SPRING + 1j * FREQUENCY * DAMPER
MASS_OVER_AXLE = STRUT / (STRUT - SPRUNG * FREQUENCY**2)
CELL, BEGINS, DISTANCE = 1 / 24, 0.4, 2.0  # [m]
WAVE_ERROR = 0.03  # of the amplitudes on rigid ground: a wave is 12 cells long


def roll(furrow, scene, material, folder, modulus_scale):
    """@return columns of the history, and x and z of the ground behind the wheel, means over y [m]"""
    variables = {"continuum": 1, "material": material, "results": folder, "speed": SPEED, "mass": UNSPRUNG + SPRUNG,
                 "stiffness": SPRING, "damping": DAMPER, "relief": f"washboard {WAVELENGTH} {AMPLITUDE} flat_until {BEGINS}",
                 "cell": CELL, "depth": 4 * CELL, "ground_width": 0.1, "distance": DISTANCE, "modulus_scale": modulus_scale, "vtk": 0}
    script_output(furrow, Path(scene).resolve(), folder, seconds=300, **variables)
    points = columns(folder / "terrain.h5", "rut")["x"]
    x = np.unique(points[:, 0])
    return columns(folder / "history.h5"), x, np.array([points[points[:, 0] == place, 2].mean() for place in x])


def wave(x, values):
    """Complex amplitude at the wavelength of the washboard, by least squares with a mean."""
    k = 2 * np.pi / WAVELENGTH
    (a, b, _), *_ = np.linalg.lstsq(np.column_stack([np.cos(k * x), np.sin(k * x), np.ones_like(x)]), values, rcond=None)
    return a - 1j * b


def amplitudes(name, history, x, z):
    """Amplitudes of the axle and of the ground behind over AMPLITUDE, and of the force over that on rigid ground."""
    steady = history["x"] >= DISTANCE - 2 * WAVELENGTH
    axle, drop, force = (wave(history["x"][steady], history[key][steady]) for key in ("z", "sprung_drop", "force_z"))
    mass = -drop
    on_rigid = FREQUENCY**2 * AMPLITUDE * abs(UNSPRUNG + SPRUNG * MASS_OVER_AXLE)
    off_form = abs(mass - MASS_OVER_AXLE * axle) / AMPLITUDE
    missing = abs(force) - FREQUENCY**2 * abs(UNSPRUNG * axle + SPRUNG * mass)
    passed = (x >= BEGINS) & (x < BEGINS + 2 * WAVELENGTH - CELL / 2)
    ground = abs(wave(x[passed], z[passed])) / AMPLITUDE
    print(f"{name}: mass off the closed form {off_form:.4f}, force less that of the masses {missing / on_rigid:+.4f}; "
          f"amplitudes: axle {abs(axle) / AMPLITUDE:.3f}, ground behind {ground:.3f}, force {abs(force) / on_rigid:.3f}; "
          f"crests {1e3 * z[passed].max():.1f}, troughs {1e3 * z[passed].min():.1f} mm")
    assert off_form < WAVE_ERROR
    assert abs(missing) < WAVE_ERROR * on_rigid
    return abs(axle) / AMPLITUDE, ground, abs(force) / on_rigid


def main(furrow, scene):
    materials = Path(scene).resolve().parents[1] / "materials"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        axle, ground, force = amplitudes("stiff", *roll(furrow, scene, materials / "compacted_sand_elastic.yaml", folder / "stiff", 0.3))
        assert abs(axle - 1) < WAVE_ERROR and abs(ground - 1) < WAVE_ERROR and abs(force - 1) < WAVE_ERROR
        axle, ground, force = amplitudes("yields", *roll(furrow, scene, materials / "dry_sand_smooth.yaml", folder / "sand", 1))
        assert 0 < ground < 0.5, "the wheel does not level the washboard"
        assert axle < 0.5 and force < 0.5, "the wheel does not feel that crests yield"


if __name__ == "__main__":
    main(*sys.argv[1:])
