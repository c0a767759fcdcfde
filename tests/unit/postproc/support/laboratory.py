# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders of laboratory tests from curves in closed form."""

from pathlib import Path

import numpy as np

from furrow_post.arrays import Floats


def write_test(folder: Path, facts: str, rows: Floats) -> Path:
    """facts.txt and curve.txt."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "facts.txt").write_text(facts)
    np.savetxt(folder / "curve.txt", rows)
    return folder


def cell_rows(strain: Floats, stress: Floats, density: float | Floats = 1500.0) -> Floats:
    """Rows of fix cell/servo: step, edges, stresses, density, inertial number.

    strain, stress (n, 3); the first row has no forces.
    """
    count = len(strain)
    edges = 0.1 * np.exp(-strain)
    columns = (np.arange(count), edges, stress, np.full(count, density), np.full(count, 1e-4))
    rows = np.column_stack(columns)
    return np.vstack((rows[:1], rows))


def write_cell(
    folder: Path, test: str, strain: Floats, stress: Floats, density: float | Floats = 1500.0, **facts: object
) -> Path:
    """A test in a cell; strain, stress (n, 3)."""
    known = " ".join(f"{name} {value}" for name, value in facts.items())
    return write_test(folder, f"test {test} ground made {known}", cell_rows(strain, stress, density))


def axisymmetric(side: float | Floats, axial: Floats) -> Floats:
    """(n, 3) strains or stresses along both sides and the axis."""
    sides = np.full_like(axial, side)
    return np.column_stack((sides, sides, axial))


def triaxial_stress(lateral: float, axial: Floats) -> Floats:
    """(n, 3)."""
    return axisymmetric(lateral, axial)


def write_plate(folder: Path, k: float, size: float = 0.1, speed: float = 0.5) -> None:
    """p = k z up to 20 mm on ground of 0.05 m."""
    z = np.linspace(-0.001, 0.02, 400)
    pressure = k * np.maximum(z, 0)
    rows = np.column_stack([np.arange(400), z, pressure * size**2, pressure])
    write_test(folder, f"test plate family made size {size} depth 0.05 speed {speed}\n", rows)
