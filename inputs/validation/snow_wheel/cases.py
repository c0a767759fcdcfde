# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the lists of runs and the laws they use."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from furrow_post.csv_table import read_numbers
from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case

HERE = Path(__file__).resolve().parent
MATERIALS = HERE.parents[1] / "materials"
TIME_LIMIT = 580.0  # [s] of one run

LOAD_MASS = 636.0  # [kg] [Shoop2001] p. 27
WIDTH = 0.272  # [m]
CELLS = 5  # in 0.20 m: cells of 4 cm
REMAP_INTERVAL = 16  # steps between remaps; half of it where that stops a run
# Numerical choices; the stage 'error' changes one at a time. Damping of the rig: the wheel comes to
# rest in height after 0.6 m.
BASE: dict[str, Value] = {
    "wheel_width": WIDTH,
    "shoulder": 0.051,
    "mass": LOAD_MASS,
    "speed": 2.235,
    "settle": 0.25,
    "accelerate": 0.15,
    "distance": 1.2,
    "damping": 10000,
    "width": 0.7,
    "fine_width": 0.4,
    "particles": 2,
    "friction": 0.3,
    "enforcement": "penalty",
    "remap_interval": REMAP_INTERVAL,
}
WINDOW = 0.5  # [m] of travel at the end that is averaged
DEEP: dict[str, Any] = {"width": 0.9, "distance": 2.4}  # [m] on more than 0.3 m of snow

# The rows of reference.csv that the identification may see: density [kg/m3], depths [m]
CALIBRATION_DENSITY = 220.0
CALIBRATION_DEPTHS = (0.18, 0.22)

# ---- laws of density alone: p_b = p_510 (rho/510 kg/m3)^s, not below what carries the own weight

OWN_WEIGHT = 1e3  # [Pa] half a metre of 220 kg/m3

Section = dict[str, Any]  # of a material file


def power_law(
    density: float, slope: float, d: float, beta: float, E: float, p_510: float
) -> dict[str, Section]:
    """Sections of a material file. density [kg/m3], d, E, p_510 [Pa], beta [degrees]"""

    def strength(rho: float) -> float:
        return float(p_510 * (rho / 510.0) ** slope)

    knee = 510.0 * (OWN_WEIGHT / p_510) ** (1.0 / slope)  # [kg/m3] where the power begins
    rows = [(density, strength(density))]
    if knee > 1.001 * density:
        rows = [(density, OWN_WEIGHT), (knee, 1.001 * OWN_WEIGHT)]
    rows.append((900.0, strength(900.0)))
    return {
        "law": {
            "type": "drucker_prager_cap",
            "density": density,
            "d": d,
            "beta": beta,
            "R": 1.1e-4,
            "alpha": 0,
            "K": 1,
            "eps_vol_pl_0": 0.001,
        },
        "elasticity": {"type": "linear", "E": E, "nu": 0.3},
        "hardening": {
            "type": "table",
            "p": [float(f"{p:.6g}") for _, p in rows],
            "eps_vol_pl": [round(math.log(rho / density), 6) for rho, _ in rows],
            "interpolation": "log",
            "beyond": "extrapolate",
        },
    }


Law = dict[str, float]  # slope, d, beta, E, p_510 of power_law

# The identified laws, rounded from what identify.py found; inputs/materials/
# field_snow_identified[_towed].yaml are these at 220 kg/m3. zero_slip: as [Shoop2001] compares;
# towed: free spin, as the wheel was measured.
LAWS: dict[str, Law] = {
    "zero_slip": {"slope": 26, "d": 7e3, "beta": 22.53, "E": 13.79e6, "p_510": 130e3},
    "towed": {"slope": 30, "d": 1e3, "beta": 57, "E": 0.35e6, "p_510": 70e3},
}


def _yaml(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(f'{x:.6g}' for x in value)}]"
    return f"{value:.6g}" if isinstance(value, (int, float)) else str(value)


def material_text(sections: Mapping[str, Section], title: str) -> str:
    """A material file."""
    lines = [f"title: {title}"]
    for name, section in sections.items():
        lines += [f"{name}:", *(f"  {key}: {_yaml(value)}" for key, value in section.items())]
    return "\n".join(lines) + "\n"


# ---- runs


def case(
    name: str,
    stage: str,
    depth: float,
    variables: Mapping[str, Value],
    mode: str = "towed",
    cells: int | None = None,
    what: str = "",
    files: Mapping[str, str] | None = None,
) -> Case:
    """Cells of about 4 cm that divide the depth [m], or so many. mode: towed or zero_slip"""
    cell = depth / (cells or round(depth * CELLS / 0.20))
    given: dict[str, Value] = {
        **BASE,
        "depth": depth,
        "cell": round(cell, 6),
        "fine_depth": depth,
        "clearance_above": 0.4,
        "modulus_scale": 1.0,
        "stiffness": 0.4,
        "length": 1.2,
        "mode": "slip slip 0" if mode == "zero_slip" else mode,
        **variables,
    }
    steps = int(str(given["remap_interval"]))
    return script_case(
        name,
        HERE / "wheel.lig",
        given,
        what=what,
        stage=stage,
        files=files or {},
        time_limit=TIME_LIMIT,
        fallback={"remap_interval": steps // 2} if steps > 1 else {},
        may_fail=True,
    )


def on_preset(
    name: str,
    stage: str,
    material: str,
    depth: float = 0.20,
    mode: str = "towed",
    cells: int | None = None,
    what: str = "",
    **changes: Value,
) -> Case:
    """The wheel of [Shoop2001] on snow of a file of inputs/materials.

    The modulus is scaled down (README: what that does).
    """
    given: dict[str, Value] = {
        "diameter": 0.74,
        "modulus_scale": 0.25,
        "material": MATERIALS / f"{material}.yaml",
        **changes,
    }
    return case(name, stage, depth, given, mode, cells, what)


def on_law(
    name: str,
    stage: str,
    density: float,
    depth: float,
    mode: str,
    law: Law,
    cells: int | None = None,
    what: str = "",
    **changes: Value,
) -> Case:
    """The wheel of Table 11 on snow of a law.

    A modulus like that of [Shoop2001] is scaled down; springs of the contact follow the modulus, so
    that a soft one needs stiffer springs.
    """
    E = law["E"]
    given: dict[str, Value] = {
        "diameter": 0.76,
        "modulus_scale": min(1.0, 0.25 * 13.79e6 / E),
        "stiffness": max(0.4, min(4.0, 1e6 / E)),
        "material": f"{FOLDER}/material.yaml",
        **changes,
    }
    text = material_text(power_law(density, **law), f"snow of {Path(name).name}")
    return case(name, stage, depth, given, mode, cells, what, {"material.yaml": text})


def on_field_snow(name: str, stage: str, law: str, mode: str = "", **changes: Any) -> Case:
    """0.20 m of 220 kg/m3 with an identified law; mode: by default the one it was identified in."""
    given: dict[str, Any] = {"density": 220, "depth": 0.20, **changes}
    return on_law(name, stage, mode=mode or law, law=LAWS[law], **given)


def predictions() -> list[Case]:
    """From the oedometer alone, with the variants that tell where the bias comes from."""
    stage = "predict"
    runs = [
        on_preset("oedometer_towed", stage, "fresh_snow_shoop"),
        on_preset("oedometer_zero_slip", stage, "fresh_snow_shoop", mode="zero_slip"),
    ]
    for variant in ("shoop_log", "p_0413", "abele_gow", "exponential", "beta_41", "d_30"):
        name = variant.removeprefix("shoop_")
        runs.append(on_preset(f"{name}_towed", stage, f"fresh_snow_{variant}"))
    deep: dict[str, Any] = {"depth": 0.50, "clearance_above": 1.0, **DEEP}
    return runs + [
        on_preset("log_zero_slip", stage, "fresh_snow_shoop_log", mode="zero_slip"),
        # does not turn: it pushes snow up ahead of it
        on_preset("smooth_wheel", stage, "fresh_snow_shoop", friction=0.0, clearance_above=1.0),
        on_preset("deep_towed", stage, "fresh_snow_shoop", **deep),
        on_preset("deep_zero_slip", stage, "fresh_snow_shoop", mode="zero_slip", **deep),
        on_field_snow("deep_field_towed", stage, "towed", **deep),
        # porous elasticity: no E to scale
        on_preset("foam_towed", stage, "fresh_snow_foam", modulus_scale=1.0, remap_interval=1),
    ]


def row_name(mode: str, density: float, depth: float) -> str:
    return f"{mode}_row_{density:.0f}_{100 * depth:.0f}cm"


def densities_and_depths() -> list[tuple[float, float]]:
    """Of the shared rows [kg/m3], [m]; the densest and deepest first."""
    return sorted({(r["density_kgm3"], r["depth_m"]) for r in reference()}, reverse=True)


def rows() -> list[Case]:
    """One run for each depth and density of the shared rows with each of the identified laws.

    The calibration's too. A deep one has more width and rolls further until it is steady.
    """
    runs = []
    for mode, law in LAWS.items():
        for density, depth in densities_and_depths():
            name, changes = row_name(mode, density, depth), DEEP if depth > 0.3 else {}
            runs.append(on_law(name, "rows", density, depth, mode, law, **changes))
    return runs


def exchanged() -> list[Case]:
    """Each law with the wheel of the other."""
    return [
        on_field_snow("towed_law_zero_slip", "rows", "towed", mode="zero_slip"),
        on_field_snow("zero_slip_law_towed", "rows", "zero_slip", mode="towed"),
    ]


ERROR_BASE = row_name("towed", 220, 0.20)
ERRORS: dict[str, tuple[str, dict[str, Any]]] = {  # name -> what is changed, changes
    "cell_5cm": ("cells of 5 cm", {"cells": 4}),
    "cell_3.3cm": ("cells of 3.33 cm", {"cells": 6}),
    "cell_2.5cm": ("cells of 2.5 cm", {"cells": 8}),
    "particles_3": ("27 particles in a cell, springs 2.5", {"particles": 3, "stiffness": 2.5}),
    "uniform": ("cells of 4 cm over the whole width", {"fine_width": 0.7}),
    "graded": (
        "cells grow under the wheel: below 8 cm and beside 20 cm",
        {"fine_depth": 0.08, "fine_width": 0.2},
    ),
    "wide": ("ground 1.0 m wide", {"width": 1.0}),
    "long": ("ground 1.6 m long", {"length": 1.6}),
    "rolls_further": ("2.0 m of rolling", {"distance": 2.0}),
    "impulse": ("contact by impulses", {"enforcement": "impulse"}),
    "remap_1": ("mapping at each step", {"remap_interval": 1}),
    "soft": ("modulus halved", {"modulus_scale": 0.5}),
    "slow": ("5 km/h, as measured", {"speed": 1.39}),
}
SPRINGS = (0.5, 1.5)  # factors on the springs of the contact, the identified law
CONTACT = (0.2, 0.8, 1.6)  # springs of the contact, the oedometer's law, beside 0.4
MODULUS_SCALES = (0.5, 1.0)  # factors on its modulus, beside 0.25


def errors_of_law() -> list[Case]:
    """Of the identified law: one numerical choice changed at a time."""
    runs = [
        on_field_snow(f"error_{name}", "error", "towed", what=what, **changes)
        for name, (what, changes) in ERRORS.items()
    ]
    springs = float(str(on_field_snow("", "error", "towed").variables["stiffness"]))
    for factor in SPRINGS:
        what = f"contact springs times {factor:g}"
        name = f"error_contact_{factor:g}"
        runs.append(on_field_snow(name, "error", "towed", what=what, stiffness=factor * springs))
    return runs


def errors_of_oedometer() -> list[Case]:
    """The same of the oedometer's law, whose modulus is scaled down."""

    def changed(name: str, what: str, **changes: Any) -> Case:
        return on_preset(f"error_oedometer_{name}", "error", "fresh_snow_shoop", what=what, **changes)

    runs = [
        changed("cell_5cm", "cells of 5 cm", cells=4),
        changed("cell_3.3cm", "cells of 3.33 cm", cells=6),
        changed("impulse", "contact by impulses", enforcement="impulse"),
    ]
    for factor in MODULUS_SCALES:
        what = f"modulus softened by {factor:g}" if factor < 1 else "modulus not softened"
        runs.append(changed(f"modulus_{factor:g}", what, modulus_scale=factor))
    for factor in CONTACT:
        what = f"contact springs {factor:g}"
        runs.append(changed(f"contact_{factor:g}", what, stiffness=factor))
    return runs


def all_cases() -> dict[str, Case]:
    """Name -> case, in the order in which they are made."""
    cases = predictions() + rows() + exchanged() + errors_of_law() + errors_of_oedometer()
    return {case.name: case for case in cases}


# ---- measurements


def reference() -> list[dict[str, float]]:
    """Rows of reference.csv."""
    return read_numbers(HERE / "reference.csv")


def is_calibration(row: Mapping[str, float]) -> bool:
    low, high = CALIBRATION_DEPTHS
    return row["density_kgm3"] == CALIBRATION_DENSITY and low <= row["depth_m"] <= high
