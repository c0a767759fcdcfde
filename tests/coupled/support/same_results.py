# SPDX-License-Identifier: GPL-2.0-or-later
"""Are the results of two runs the same?"""

import sys
from pathlib import Path

import h5py
import numpy as np

GROUPS = ("history", "terrain", "rut", "surface", "grains")  # of the results files


def largest(values: np.ndarray) -> float:
    return float(np.nanmax(np.abs(values), initial=0.0))


def numbers(folder: Path, groups: tuple[str, ...] = GROUPS) -> tuple[dict[str, np.ndarray], dict[str, float]]:
    """Arrays by name, and the largest value of their unit: of a force component that is zero but
    for rounding, that of all forces."""
    found: dict[str, np.ndarray] = {}
    units: dict[str, str] = {}
    for path in sorted(folder.rglob("*.h5")):
        with h5py.File(path) as content:
            def collect(name: str, item: object) -> None:
                if isinstance(item, h5py.Dataset) and name.split("/")[0] in groups:
                    found[f"{path.relative_to(folder)}/{name}"] = item[()]
                    units[f"{path.relative_to(folder)}/{name}"] = str(item.attrs.get("unit", name))
            content.visititems(collect)
    scales = {name: max(largest(values) for other, values in found.items()
                        if units[other] == units[name]) for name in found}
    return found, scales


def compare_arrays(
    one: Path, other: Path, tolerance: float, groups: tuple[str, ...] = GROUPS, but: tuple[str, ...] = (),
) -> int:
    """Compares two folders of results; ends the program where they differ.

    @param tolerance  of the largest number of a unit
    @param but  arrays that may differ
    @return how many arrays are the same"""
    (expected, scales), (got, _) = numbers(one, groups), numbers(other, groups)
    if expected.keys() != got.keys():
        sys.exit(f"results differ in kind: {sorted(expected.keys() ^ got.keys())}")
    expected = {item: values for item, values in expected.items() if item not in but}
    for item, values in expected.items():
        shapes = np.shape(values), np.shape(got[item])
        if shapes[0] != shapes[1]:
            sys.exit(f"{item} is not the same: shapes {shapes[0]}, {shapes[1]}")
        if not np.allclose(values, got[item], rtol=0.0, atol=tolerance * scales[item], equal_nan=True):
            sys.exit(f"{item} is not the same, by {np.nanmax(np.abs(values - got[item])):.3g}")
    return len(expected)
