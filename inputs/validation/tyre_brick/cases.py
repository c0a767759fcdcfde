# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of tyre_brick: the tyre with a tread of rubber on a rigid plane."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

from mould import tyre_text

from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case

TYRES = PROJECT / "inputs/tyres"
SMOOTH = TYRES / "p235_75r15_smooth.yaml"
LOAD = 6227  # [N] Table 6
PRESSURES = (103, 138, 179, 241)  # [kPa] of Table 6
IDENTIFIED_AT = (103, 241)  # [kPa]
SECTIONS = 120  # round the tyre, as the report's mesh


def pressed(
    name: str,
    tyre: Path | str,
    pressures: Sequence[Value],
    loads: Sequence[Value],
    sections: int = SECTIONS,
    **more: object,
) -> Case:
    """Half a tyre inflated [kPa] and pressed on the plane [N]. Its stage is the name's folder."""
    arguments: tuple[Value, ...] = (
        *(tyre, "--half", "--sections", sections),
        *("--pressure", *pressures, "--load", *loads, "--folder", FOLDER),
    )
    stage = name.partition("/")[0]
    return Case(name, "furrow-tyre", arguments, stage=stage, **more)  # type: ignore[arg-type]


COARSE = 60  # sections of what is run at many loads, or for many tyres
# Low pressures fold a coarse sidewall under a load that comes at once
STEPS = (3000, 4500, 5500, LOAD)  # [N]


@dataclass(frozen=True)
class Carcass:
    """What is identified."""

    crown: float  # [m] radius of the mould's crown
    belt: float  # [N/m] stiffness of the belts against stretching along
    shear: float  # [N/m] of the sidewalls against shear


CHOSEN = Carcass(1.5, 5e6, 2e3)  # of the tyre files
TRIALS = {  # each with one value changed
    "crown 0.5 m": Carcass(0.5, CHOSEN.belt, CHOSEN.shear),
    "belts 8 MN/m": Carcass(CHOSEN.crown, 8e6, CHOSEN.shear),
    "sidewalls 5 kN/m": Carcass(CHOSEN.crown, CHOSEN.belt, 5e3),
}
IDENTIFICATION = {
    name: pressed(
        f"identification/{name.replace(' ', '_').replace('/', '_per_')}",
        f"{FOLDER}/tyre.yaml",
        IDENTIFIED_AT,
        STEPS,
        COARSE,
        may_fail=True,
        files={"tyre.yaml": tyre_text(SMOOTH, of.crown, of.belt, of.shear)},
    )
    for name, of in TRIALS.items()
}

TABLE6 = pressed("table6", SMOOTH, PRESSURES, [4000, LOAD])
MESH = pressed("meshes/60", SMOOTH, PRESSURES, STEPS, COARSE)

STRESS_PRESSURE, STRESS_LOAD = 207, 6627  # [kPa], [N] Fig 52
STRESS = {
    (tread, sections): pressed(
        f"contact_stress/{tread}_{sections}",
        TYRES / f"p235_75r15_{tread}.yaml",
        [STRESS_PRESSURE],
        [4000, STRESS_LOAD],
        sections,
    )
    for tread, sections in (
        ("smooth", COARSE),
        ("smooth", SECTIONS),
        ("ribbed", COARSE),
    )
}

# Fig 54: the report's ribs buckle at a low pressure under a high load
TREAD_STATES = {241: (LOAD,), 103: (4000, 5500, LOAD, 7500)}  # [kPa]: [N]
TREADS = {
    (tread, pressure): pressed(
        f"treads/{tread}_{pressure}",
        TYRES / f"p235_75r15_{tread}.yaml",
        [pressure],
        loads,
        COARSE,
        may_fail=True,
    )
    for tread in ("smooth", "ribbed", "lugged")
    for pressure, loads in TREAD_STATES.items()
}

# Rolling on the plane at 8 km/h, friction 0.825 as in the report: damping of the tyre [1/s]
ROLLING_DISTANCE = 2  # [m] Table 10
ROLLING = {
    damping: script_case(
        f"rolling/{damping}",
        PROJECT / "inputs/scenes/brick_tyre_on_plane.lig",
        {"damping": damping, "length": ROLLING_DISTANCE, "friction": 0.825, "sections": COARSE},
        stage="rolling",
    )
    for damping in (0, 100)
}

CASES = (
    TABLE6,
    MESH,
    *IDENTIFICATION.values(),
    *STRESS.values(),
    *TREADS.values(),
    *ROLLING.values(),
)
