# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of a finished run, by name and unit; its energies and momenta must balance."""

import json

import h5py
import numpy as np

ENERGY_LIMIT = 5e-3  # of the largest energy, for a wheel or tyre: the error of its time step
CONTINUUM_LIMIT = 0.05  # the same for a continuum, as in tests/verification/mpm/wheel_on_snow_hard_cases_test.cpp
MOMENTUM_LIMIT = 1e-10  # of the largest force or moment: round-off


def check_share(name, part, whole, limit):
    """|part| <= limit whole, and neither is NaN."""
    print(f"  {name}: {part:.3g} of {whole:.3g}")
    assert abs(part) <= limit * whole, f"{name}: {part:.3g} of {whole:.3g} is more than {limit:g} of it"


def check_audit(audit, name, energy_limit):
    assert audit["energy_scale"] > 0, f"{name}: there was no energy at all"
    check_share(f"{name}, energy not accounted for", audit["energy_residual"], audit["energy_scale"], energy_limit)
    for what in ("force", "moment"):
        check_share(f"{name}, {what}s on nodes and grains", audit[f"{what}_imbalance"],
                    audit[f"{what}_scale"], MOMENTUM_LIMIT)


def check_pictures(folder, drawn):
    """There are the pictures of a run, or none."""
    summary = json.loads((folder / "summary.json").read_text())
    grains = summary["cost"]["grains"] > 0 or (folder / "terrain.h5").exists()
    wanted = {"histories.png", *(["rut.png"] if grains else [])} if drawn else set()
    there = {file.name for file in folder.glob("*.png") if file.read_bytes().startswith(b"\x89PNG")}
    assert wanted <= there and (not there or drawn), f"{folder} has the pictures {there}, not {wanted}"


def wheel_quantities(folder):
    """Quantities of summary.json, which the run itself writes, and of history.h5."""
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["complete"], f"{folder} did not come to its end"
    check_audit(summary["audit"], "wheel", ENERGY_LIMIT)
    with h5py.File(folder / "history.h5") as content:
        found = {}
        for name, column in content["history"].items():
            unit = column.attrs["unit"]
            unit = unit.decode() if isinstance(unit, bytes) else unit
            found[f"{name} at the end"] = column[-max(len(column) // 20, 1):].mean(), unit
    found.update(steady_values(summary))
    for further in folder.glob("*/summary.json"):
        its = json.loads(further.read_text())
        check_audit(its["audit"], f"wheel of {further.parent.name}", ENERGY_LIMIT)
        found.update((f"{further.parent.name}_{name}", value) for name, value in steady_values(its).items())
    return {name.replace("_", " "): value for name, value in found.items()}


def steady_values(summary):
    """(value, unit) by name."""
    return {name: (value["mean"], value["unit"]) for name, value in summary.get("quantities", {}).items()}


def plate_quantities(folder):
    """Quantities of curve.txt: time step, sinkage, force, pressure; its end is the last twentieth."""
    curve = np.loadtxt(folder / "curve.txt")
    end = curve[-max(len(curve) // 20, 1):].mean(axis=0)
    return {"peak force": (curve[:, 2].max(), "N"), "force at the end": (end[2], "N"),
            "pressure at the end": (end[3], "Pa"), "sinkage reached": (curve[-1, 1], "m")}


def continuum_quantities(folder):
    """Quantities of the history of terrain/continuum: what the base carries in the last third."""
    for file in folder.glob("*.h5"):
        with h5py.File(file) as content:
            if "history/base_impulse" not in content:
                continue
            check_audit(content["audit"].attrs, "continuum", CONTINUUM_LIMIT)
            time, impulse = content["history/time"][()], content["history/base_impulse"][()]
        first = 2 * len(time) // 3
        force = (impulse[-1] - impulse[first]) / (time[-1] - time[first])
        return {"base force": (force, "N")}
    return {}
