# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the rigid wheel of [Shoop2001] on its snow, one thing changed at a time."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case

HERE = Path(__file__).resolve().parent
MATERIALS = HERE.parents[1] / "materials"
REPORT_SNOW = "fresh_snow_shoop"
CELL = 0.05  # [m]; four in 20 cm, what the report's 11,520 elements suggest
SMALL_R = 1.1e-4  # [Shoop2001] Table 1: 2.2e-2 to this; the larger one is for d = 5 kPa alone
DEPTHS = {0.20: 0.066667, 0.30: 0.06, 0.40: 0.066667, 0.50: 0.0625}  # [m] -> cells [m]

ZERO_SLIP, FREE = "slip slip 0", "towed"
MODES = {"zero": ZERO_SLIP, "free": FREE}

# A short run: the sinkage of the standing wheel, then 1.2 m of rolling, mean of the last 0.5 m
SHORT: dict[str, Value] = {"settle": 0.4, "accelerate": 0.2, "distance": 1.2}
SHORT_WINDOW = 0.5  # [m]
# As the report ran it: 1.5 s, 0.5 s, 8 km/h to 5 s; its mean is over the constant part
REPORT: dict[str, Value] = {"settle": 1.5, "accelerate": 0.5, "distance": 7.26}
REPORT_WINDOW = 5.6  # [m]: 2.5 to 5 s

BASE: dict[str, Value] = {
    **SHORT,
    "speed": 2.235,
    "mode": ZERO_SLIP,
    "load_mass": 636,
    "depth": 0.20,
    "cell": CELL,
    "length": 1.6,
    "width": 0.8,
    "clearance_above": 0.5,
    "contact": "friction 0.3",
    "faces": "ends smooth sides smooth",
}


def report_snow(change: str) -> str:
    """A material file: the report's snow but for this section of it."""
    base = MATERIALS / f"{REPORT_SNOW}.yaml"
    return f"title: The report's snow, one section changed\nbase: {base}\n{change}\n"


def changed(d: float, beta: float = 22.53) -> str:
    """The report's snow with another shear line: d [Pa] and beta [degrees]."""
    return report_snow(f"law: {{d: {d:g}, beta: {beta:g}, R: {SMALL_R:g}}}")


def case(
    name: str,
    stage: str,
    what: str,
    material: str = REPORT_SNOW,
    text: str = "",
    time_limit: float = 3600.0,
    **changes: Value,
) -> Case:
    """material: of inputs/materials; text: of a material file instead."""
    file: Value = f"{FOLDER}/material.yaml" if text else MATERIALS / f"{material}.yaml"
    given: Mapping[str, Value] = {**BASE, "material": file, **changes}
    return script_case(
        name,
        HERE / "wheel.lig",
        given,
        what=what,
        stage=stage,
        files={"material.yaml": text} if text else {},
        time_limit=time_limit,
        may_fail=True,
    )


def readings() -> list[Case]:
    """What Table 1 and Table 3 leave open, at zero slip in 20 cm."""
    stage = "reading"
    strengths = [
        case(f"d_{d}", stage, f"d {d} kPa, R 1.1e-4", text=changed(1e3 * d))
        for d in (5, 6, 10, 20, 30, 40, 72)
    ]
    return [
        case("base", stage, "d 5 kPa, R 2.2e-2"),
        *strengths,
        case("ring_shear", stage, "d 3.7 kPa, beta 15.2 degrees", text=changed(3.7e3, 15.2)),
        case("log", stage, "Table 3 straight in ln p", "fresh_snow_shoop_log"),
        case("as_printed", stage, "Table 3 as printed", "fresh_snow_as_printed"),
        case("exponential", stage, "exponential hardening", "fresh_snow_exponential"),
        case("p_0413", stage, "Table 3 read as p = 0.413 sigma1", "fresh_snow_p_0413"),
        case("beta_41", stage, "beta 41.3 degrees", "fresh_snow_beta_41"),
        case("soft", stage, "E 1.4 MPa", text=report_snow("elasticity: {E: 1.4e6}")),
        case("stiff", stage, "E 41 MPa", text=report_snow("elasticity: {E: 41e6}")),
        case("k0", stage, "K0 0.12: `fresh_snow`", "fresh_snow"),
    ]


def artefacts() -> list[Case]:
    """What a mesh, a contact or a load could do to the sinkage, at zero slip in 20 cm."""
    stage = "artefact"
    return [
        case("cell_10", stage, "d 5 kPa, cells of 10 cm", cell=0.10),
        *(
            case(
                f"d_{d}_cell_10",
                stage,
                f"d {d} kPa, cells of 10 cm",
                text=changed(1e3 * d),
                cell=0.10,
            )
            for d in (10, 20, 30, 40)
        ),
        case("d_30_cell_4", stage, "d 30 kPa, cells of 4 cm", text=changed(30e3), cell=0.04),
        case("d_6_cell_4", stage, "d 6 kPa, cells of 4 cm", text=changed(6e3), cell=0.04),
        case(
            "slip_free_d6_cell_4", stage, "d 6 kPa, cells of 4 cm, free",
            text=changed(6e3), cell=0.04, mode=FREE,
        ),
        case("half_load", stage, "half of the load", load_mass=318),
    ]


ABSORBING = "ends absorbing sides absorbing"  # in place of the report's infinite elements


def domains() -> list[Case]:
    """Ends and sides that absorb, and ones that are farther away, at zero slip in 20 cm."""
    runs: list[Case] = []
    for d in (5, 30):
        text = changed(1e3 * d)
        runs += [
            case(f"absorbing_{d}", "domain", f"d {d} kPa, absorbing", text=text, faces=ABSORBING),
            case(
                f"wide_{d}", "domain", f"d {d} kPa, 2.4 x 1.6 m", text=text, length=2.4, width=1.6
            ),
        ]
    return runs


def depths() -> list[Case]:
    """As the report ran it, with its largest d."""
    runs = [(depth, name) for name in MODES for depth in DEPTHS]
    return [
        case(
            f"depth_{100 * depth:.0f}_{name}_d30",
            "depth",
            f"{100 * depth:.0f} cm, {name} slip, d 30 kPa",
            text=changed(30e3),
            mode=MODES[name],
            depth=depth,
            cell=DEPTHS[depth],
            width=1.0,
            clearance_above=0.8,
            settle=REPORT["settle"],
            accelerate=REPORT["accelerate"],
            distance=REPORT["distance"],
        )
        for depth, name in runs
    ]


SLIPS = {f"{slip:+g}": f"slip slip {slip:g}" for slip in (0.1, -0.05, -0.1, -0.2)}
FRICTIONS = {  # name -> words of the contact
    "0.1": "friction 0.1",
    "0.8": "friction 0.8",
    "rough": "surface rough",
    "eq26": "friction 0.3 slip_length 0.02",
}
# d [kPa] -> suffix of the run's name, which slips and frictions: all for the ends of Table 1
STRENGTHS: Mapping[int, tuple[str, Sequence[str], Sequence[str]]] = {
    5: ("_d5", (*SLIPS, "free"), ("0.1", "0.8", "rough")),
    6: ("_d6", ("free",), ()),
    10: ("_d10", (*SLIPS, "free"), ("0.1", "0.8")),
    20: ("_d20", (*SLIPS, "free"), ("0.1", "0.8")),
    30: ("", (*SLIPS, "free"), tuple(FRICTIONS)),
}


def slips() -> list[Case]:
    """From a driven wheel to a free one."""
    modes = {**SLIPS, "free": FREE}
    return [
        case(
            f"slip_{name}{suffix}",
            "slip",
            f"d {d} kPa, slip {name}",
            text=changed(1e3 * d),
            mode=modes[name],
        )
        for d, (suffix, names, _) in STRENGTHS.items()
        for name in names
    ]


def frictions() -> list[Case]:
    """Of the wheel on the snow, at zero slip."""
    return [
        case(
            f"friction_{name}{suffix}",
            "friction",
            f"d {d} kPa, {FRICTIONS[name]}",
            text=changed(1e3 * d),
            contact=FRICTIONS[name],
        )
        for d, (suffix, _, names) in STRENGTHS.items()
        for name in names
    ]


# run -> the run that it differs from in one thing
EFFECTS = {
    "soft": "base",
    "stiff": "base",
    "absorbing_5": "d_5",
    "absorbing_30": "d_30",
    **{f"friction_{name}_d5": "d_5" for name in ("0.1", "0.8", "rough")},
    **{f"friction_{name}": "d_30" for name in ("0.1", "0.8", "rough")},
}

FIELDS = ("d_5", "d_10", "d_20", "d_30")  # runs whose ground is looked into

# Runs that are a test: sinkage [m] and resistance coefficient that they have here, and how far off
# another processor or compiler may be
CHECKED = {"cell_10": (0.153, 0.174), "d_30_cell_10": (0.086, 0.094)}
TOLERANCES = (0.002, 0.01)


def all_cases() -> tuple[Case, ...]:
    return (*readings(), *artefacts(), *domains(), *slips(), *frictions(), *depths())
