# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the tyre pressed on the plane by furrow-tyre, and rolling on it."""

import itertools
from collections.abc import Sequence
from pathlib import Path

from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case

INPUTS = Path(__file__).resolve().parents[2]
TYRE = INPUTS / "tyres/p235_75r15.yaml"
LOAD = 6227  # [N]

PRESSURES = (103, 138, 179, 241)  # [kPa] of Table 6
IDENTIFIED_AT = (103, 241)  # [kPa]
Mesh = tuple[int, int]  # elements across and around


def pressed(
    name: str,
    stage: str,
    pressures: Sequence[Value],
    loads: Sequence[Value],
    mesh: Mesh,
    *options: Value,
) -> Case:
    """The tyre inflated [kPa] and pressed on the plane [N]; options: of furrow-tyre.

    Some states are refused, which is a result; the first table must be complete (missed_goals).
    """
    arguments: tuple[Value, ...] = (
        TYRE,
        "--pressure",
        *pressures,
        "--load",
        *loads,
        "--mesh",
        *mesh,
        *options,
    )
    return Case(name, "furrow-tyre", arguments, stage=stage, may_fail=True)


def mesh_name(mesh: Mesh) -> str:
    return f"{mesh[0]}x{mesh[1]}"


# End springs of the sidewall at rim and tread [N m/rad/m], link to the tread's edge, axially [m]
SPRINGS_AND_LINKS = tuple(itertools.product([1, 30, 300], [1, 30, 300], [0, -0.01]))
MESHES = (((4, 36), True), ((6, 72), True), ((6, 72), False), ((12, 144), True))  # half model?
TREAD_SPRINGS = tuple(itertools.product([10, 50], [(6, 72), (12, 144), (20, 240)]))
HARD_CASES = (  # name, pressure [kPa], load [N], options
    ("low pressure, high load", 69, 5000, ()),
    ("bottomed", 69, 8000, ()),
    ("nearly flat", 20, 1000, ()),
    ("without air", 0, 200, ("--direct",)),
)
BASE_MESH = (6, 72)

TABLE6 = pressed("table6", "table6", PRESSURES, [LOAD], BASE_MESH)
LOAD_DEFLECTION = pressed(
    "load_deflection",
    "load_deflection",
    (103, 179, 241),
    range(1000, 8001, 1000),
    BASE_MESH,
    "--half",
)
MESH_CASES = tuple(
    pressed(
        f"meshes/{mesh_name(mesh)}{'_half' if half else ''}",
        "meshes",
        PRESSURES,
        [LOAD],
        mesh,
        *(["--half"] if half else []),
    )
    for mesh, half in MESHES
)
STRESS_CASES = tuple(
    pressed(
        f"contact_stress/{mesh_name(mesh)}_{spring}",
        "contact_stress",
        [207],
        [6627],
        mesh,
        "--half",
        "--tread-stiffness",
        spring,
        "--folder",
        FOLDER,
    )
    for spring, mesh in TREAD_SPRINGS
)
HARD = tuple(
    pressed(
        f"hard_cases/{name.replace(', ', '_').replace(' ', '_')}",
        "hard_cases",
        [pressure],
        [load],
        BASE_MESH,
        "--half",
        *options,
    )
    for name, pressure, load, options in HARD_CASES
)
IDENTIFICATION = tuple(
    pressed(
        f"identification/{rim}_{tread}_{abs(axial)}",
        "identification",
        IDENTIFIED_AT,
        [LOAD],
        BASE_MESH,
        "--half",
        "--rim-stiffness",
        rim,
        "--tread-stiffness",
        tread,
        "--link",
        axial,
        0,
    )
    for rim, tread, axial in SPRINGS_AND_LINKS
)
# Rolling on the plane at 8 km/h, friction 0.825 as in the report, two turns: damping of the tread
# [1/s]
DAMPINGS = (20, 100, 300)
ROLLING_DISTANCE = 4.5  # [m]
ROLLING = tuple(
    script_case(
        f"rolling/{damping}",
        INPUTS / "scenes/tyre_on_plane.lig",
        {"damping": damping, "length": ROLLING_DISTANCE, "friction": 0.825},
        stage="rolling",
    )
    for damping in DAMPINGS
)
CASES = (
    TABLE6,
    *MESH_CASES,
    LOAD_DEFLECTION,
    *STRESS_CASES,
    *HARD,
    *IDENTIFICATION,
    *ROLLING,
)
