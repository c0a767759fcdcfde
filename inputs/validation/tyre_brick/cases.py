# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of tyre_brick: the tyre with a tread of rubber on a rigid plane."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

from mould import Mould, tyre_text

from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case

TYRES = PROJECT / "inputs/tyres"
SMOOTH = TYRES / "p235_75r15_smooth.yaml"
EQUIVALENT = TYRES / "p235_75r15_equivalent.yaml"
LOAD = 6227  # [N] Table 6
PRESSURES = (103, 138, 179, 241)  # [kPa] of Table 6
IDENTIFIED_AT = (103, 241)  # [kPa]
SECTIONS = 120  # round the tyre, as the report's mesh
FINE = 240


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
class Values:
    """What is identified, or assumed and changed."""

    mould: Mould
    belt: float  # [N/m] stiffness of the belts against stretching along
    shear: float  # [N/m] of the sidewalls against shear
    rubber: float  # [Pa] C10


OF_SMOOTH = Values(Mould(), 5e6, 2e3, 1.109596e6)  # of the tyre files
TO_THE_EDGE = Mould(
    crown_end=0.0775, shoulder=0.030, widest=0.109, belt_end=0.0775, tread_end=0.088
)
OF_EQUIVALENT = replace(OF_SMOOTH, mould=TO_THE_EDGE, rubber=2e5)
# From the smooth tyre to its equivalent, one change after the other
STEPS_BETWEEN = {"flat to the tread's edge": replace(OF_SMOOTH, mould=TO_THE_EDGE)}
BETWEEN_AT = 241  # [kPa]
BETWEEN = {
    name: pressed(
        f"between/{number}",
        f"{FOLDER}/tyre.yaml",
        [BETWEEN_AT],
        [LOAD],
        files={"tyre.yaml": tyre_text(SMOOTH, of.mould, of.belt, of.shear, of.rubber)},
        what=name,
    )
    for number, (name, of) in enumerate(STEPS_BETWEEN.items())
}

TABLE6 = pressed("table6", EQUIVALENT, PRESSURES, [4000, LOAD])
BETWEEN_FIRST = pressed("between/smooth", SMOOTH, [BETWEEN_AT], [LOAD])
MESH = pressed("meshes/60", EQUIVALENT, PRESSURES, STEPS, COARSE)
# A state that takes seconds: is it still what is stored?
CHECK = pressed("check", EQUIVALENT, [241], [LOAD], COARSE)

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
        ("ribbed", SECTIONS),
        ("ribbed", FINE),
    )
}

# Fig 54: the report's ribs buckle at a low pressure under a high load
TREAD_STATES = {241: (LOAD,), 103: (4000, 5500, LOAD)}  # [kPa]: [N]
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
    CHECK,
    TABLE6,
    BETWEEN_FIRST,
    MESH,
    *BETWEEN.values(),
    *STRESS.values(),
    *TREADS.values(),
    *ROLLING.values(),
)
