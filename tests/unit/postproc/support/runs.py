# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders of wheel runs with known answers: history.h5, terrain.h5, summary.json."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from furrow_post.arrays import Floats, Integers

RADIUS, WIDTH = 0.3, 0.2  # [m] of the rigid wheel

Entry = dict[str, Any]  # of /run/styles


def style(kind: str, name: str, identity: str = "x", **options: Any) -> Entry:
    """An entry of /run/styles; every option is a list there."""
    listed = {key: value if isinstance(value, list) else [value] for key, value in options.items()}
    return {"id": identity, "group": "all", "style": name, "kind": kind, "options": listed}


def rigid_wheel(identity: str = "wheel") -> Entry:
    return style("wheel", "wheel/rigid", identity, diameter=2 * RADIUS, width=WIDTH, mass=50)


def rig(load: float = 1000.0, identity: str = "rig", datum: float = 0.0) -> Entry:
    return style(
        "rig",
        "wheel/rig",
        identity,
        wheel="wheel",
        load_force=load,
        speed=1,
        mode="slip",
        slip=0.2,
        slip_angle=0,
        camber=0,
        gravity=9.80665,
        ground_level=datum,
    )


def write_columns(group: Any, columns: Mapping[str, Floats]) -> None:
    for name, values in columns.items():
        group[name] = values
        group[name].attrs["unit"] = np.bytes_(" ")
        group[name].attrs["meaning"] = np.bytes_(name)


def write_head(content: Any, styles: list[Entry] | None, title: str = "made") -> None:
    """/run of history.h5; styles: None as an older Furrow wrote it."""
    run = content.create_group("run")
    for name, value in (
        ("title", title), ("version", "0.0.9"), ("script", "none"), ("started", "2026-01-01T00:00:00Z"),
    ):
        run.attrs[name] = np.bytes_(value)
    run.attrs["ranks"] = 1
    run["effective_input"] = np.bytes_("# styles with their effective values\n")
    if styles is not None:
        run["styles"] = np.bytes_(json.dumps(styles).encode())


def write_summary(
    folder: Path, sinkage: float, load: float, slip: float = 0.2, pull: float = -0.2, torque: float = 0.0,
) -> None:
    """pull: over the load; torque [N m]"""

    def quantity(mean: float, error: float, unit: str) -> dict[str, Any]:
        entry = {"mean": mean, "standard_error": error, "unit": unit}
        return {**entry, "steady": True, "verdict": "steady"}

    quantities = {
        "hub_drop": quantity(sinkage, 1e-3, "m"),
        "resistance_coefficient": quantity(-pull, 0.01, ""),
        "force_z": quantity(load, 1.0, "N"),
        "drawbar_pull": quantity(pull * load, 1.0, "N"),
        "drive_torque": quantity(torque, 0.01 * torque, "N m"),
        "slip": quantity(slip, 0.0, ""),
    }
    content = {"window": {"start": 1.0, "end": 1.9}, "steady": True, "quantities": quantities}
    (folder / "summary.json").write_text(json.dumps(content))


def write_history(
    path: Path, time: Floats, columns: Mapping[str, Floats], styles: list[Entry], title: str = "made"
) -> None:
    """A wheel that settles until 0.5 s and accelerates until 0.8 s; columns: without time, stage and place."""
    stage = np.where(time < 0.5, 0.0, np.where(time < 0.8, 1.0, 2.0))
    with h5py.File(path, "w") as content:
        write_head(content, styles, title)
        group = content.create_group("history", track_order=True)
        write_columns(group, {"time": time, "stage": stage, "x": np.maximum(time - 0.65, 0), **columns})


def write_run(
    folder: Path,
    load: float = 1000.0,
    sinkage: float = 0.05,
    styles: list[Entry] | None = None,
    datum: float = 0.0,
    slip: float = 0.2,
    pull: float = -0.2,
    torque: float = 0.0,
) -> None:
    """A wheel of RADIUS and WIDTH on ground without grains, steady from 1 s on. styles: instead of a rigid wheel on a rig;
    pull: over the load; torque [N m]"""
    folder.mkdir(parents=True, exist_ok=True)
    time = np.arange(2000) * 1e-3
    v = np.where(time > 0.65, 1.0, 0.0)
    rim = v / (1 - slip) if slip >= 0 else v * (1 + slip)
    one = np.ones_like(time)
    columns = {
        "y": 0 * one,
        "z": RADIUS * one,
        "velocity_x": v,
        "spin_rate": rim / RADIUS,
        "hub_drop": sinkage * np.minimum(time / 0.5, 1),
        "force_x": pull * load * v,
        "force_y": 0 * one,
        "force_z": load * one,
        "drawbar_pull": pull * load * v,
        "drive_torque": torque * one,
        "slip": slip * v,
    }
    write_history(folder / "history.h5", time, columns, styles or [rigid_wheel(), rig(load, datum=datum)])
    write_summary(folder, sinkage, load, slip, pull, torque)


def add_parts(folder: Path, forces: Mapping[str, float], unexplained: float = 0.0) -> None:
    """Adds the parts of the resistance [N] to summary.json."""
    file = folder / "summary.json"
    content = json.loads(file.read_text())
    whole = sum(forces.values()) + unexplained
    content["resistance_parts"] = {"unit": "N", "whole": whole, "parts": dict(forces), "unexplained": unexplained}
    file.write_text(json.dumps(content))


def write_noisy_history(path: Path, rows: int = 4000) -> None:
    """Settle, accelerate, cruise with noise about known means.

    Sinkage 20 mm, resistance coefficient 0.2, slip 0.1, torque 3 N m
    """
    random = np.random.default_rng(3)

    def noise(size: float) -> Floats:
        return size * random.normal(size=rows)

    columns = {
        "hub_drop": 0.02 + noise(2e-4),
        "force_x": -20 + noise(1.0),
        "force_y": noise(0.5),
        "force_z": 100 + noise(2.0),
        "drawbar_pull": -20 + noise(1.0),
        "drive_torque": 3 + noise(0.1),
        "slip": 0.1 + noise(0.002),
    }
    write_history(path, np.arange(rows) * 1e-3, columns, [rigid_wheel(), rig()], "synthetic")


def write_grains(group: Any, x: Floats, radius: Floats, bed_level: float, identity: Integers | None = None) -> None:
    """/grains/reference or /grains/final; identity: 0, 1, 2 ... if it is not given."""
    group["id"] = np.arange(len(x)) if identity is None else identity
    group["x"], group["radius"] = x, radius
    group["period"] = np.zeros(3)
    group.attrs["bed_level"] = bed_level
