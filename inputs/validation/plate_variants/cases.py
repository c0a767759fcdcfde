# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the laboratory's plate and the field's, their laws and cells."""

import math
import re
from collections.abc import Sequence
from pathlib import Path

from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case

INPUTS = Path(__file__).resolve().parents[2]
SCENE = INPUTS / "scenes/plate_on_snow.lig"
MATERIALS = INPUTS / "materials"
FRESH, REPORT, FOAM, FITTED = (
    MATERIALS / f"fresh_snow{name}.yaml" for name in ("", "_shoop", "_foam", "_foam_oedometer")
)
TIME_LIMIT = 3600.0  # [s] of one run
RADIUS, DEPTH = 0.1016, 0.5  # [m] of the plate, of the snow
DENSITY = 180.0  # [kg/m3] before
OTHERS_DENSITY = 200.0  # [kg/m3] of the snow of the material files
NO_SLIP = 10.0  # friction of a plate that holds the snow, as the report's does
SLIDE_FRICTION = 0.3
COARSE, FINE, FINER, FINEST = 0.0416667, 0.03125, 0.025, 0.02  # [m] cells


def numbers_of(text: str, key: str) -> list[float]:
    """The list behind a key of a material file."""
    found = re.search(rf"^  {key}: *\[(.*)\]", text, re.M)
    assert found
    return [float(value) for value in found[1].split(",")]


def report_hardening() -> str:
    """Strengths at the densities where they were, the first at the snow's own."""
    text = REPORT.read_text()
    lighter = math.log(OTHERS_DENSITY / DENSITY)
    strains = [round(strain + lighter, 4) for strain in numbers_of(text, "eps_vol_pl")[1:]]
    return (
        f"hardening: {{type: table, p: {numbers_of(text, 'p')}, eps_vol_pl: {[0.0, *strains]}, "
        "interpolation: linear, beyond: extrapolate}"
    )


def fresh_hardening() -> str:
    """As report_hardening."""
    text = FRESH.read_text()
    return (
        f"hardening: {{type: by_density, p: {numbers_of(text, 'p')}, "
        f"rho: {[DENSITY, *numbers_of(text, 'rho')[1:]]}, interpolation: log, beyond: extrapolate}}"
    )


# A foam law counts voids against ice of 900 kg/m3: e0 = 900/180 - 1
FOAM_VOIDS = "elasticity: {e0: 4.0}\nhardening: {e0: 4.0}"


def plate(
    name: str, what: str, base: Path, keys: str, slide: bool, cell: float = COARSE, **more: Value
) -> Case:
    """The scene with a material file of its own, and with a slide surface or without one.

    The surface stands outside of the particles that the plate touches.
    """
    variables: dict[str, Value] = {
        "material": f"{FOLDER}/material.yaml",
        "friction": NO_SLIP,
        "cell": cell,
        **more,
    }
    if slide:
        surface = f"slide_cylinder 0 0 {RADIUS + 0.25 * cell:.4f}"
        variables["terrain_keywords"] = f"{surface} slide_friction {SLIDE_FRICTION}"
    material = f"title: {what}\nbase: {base}\nlaw: {{density: {DENSITY:.0f}}}\n{keys}\n"
    return script_case(
        name,
        SCENE,
        variables,
        what=what,
        time_limit=TIME_LIMIT,
        may_fail=True,
        files={"material.yaml": material},
    )


def name_of(variant: str, cell: float) -> str:
    """Of a run in cells of this size [m]."""
    return variant if cell == COARSE else f"{variant}_{1e3 * cell:.0f}"


def sizes(
    name: str, what: str, base: Path, keys: str, slide: bool, cells: Sequence[float], **more: Value
) -> tuple[Case, ...]:
    """The same in several cells [m]."""
    return tuple(
        plate(
            name_of(name, cell),
            what if cell == COARSE else f"the same, cells of {100 * cell:.1f} cm",
            base,
            keys,
            slide,
            cell,
            **more,
        )
        for cell in cells
    )


ALL_CELLS, TWO, ONE = (COARSE, FINE, FINER), (COARSE, FINE), (COARSE,)
CASES = (
    *sizes("cap", "report's cap law", REPORT, report_hardening(), False, (*ALL_CELLS, FINEST)),
    *sizes("cap_slide", "cap law, slide surface", REPORT, report_hardening(), True, ALL_CELLS),
    *sizes("foam", "foam law", FOAM, FOAM_VOIDS, False, ONE, modulus_scale=1),
    *sizes("foam_slide", "foam law, slide surface", FOAM, FOAM_VOIDS, True, ONE, modulus_scale=1),
    *sizes(
        "foam_fitted_slide",
        "foam law, lambda of the oedometer, slide surface",
        FITTED,
        FOAM_VOIDS,
        True,
        ONE,
        modulus_scale=1,
    ),
    *sizes("fresh", "crushed in place", FRESH, fresh_hardening(), False, TWO),
    *sizes("fresh_slide", "crushed in place, slide surface", FRESH, fresh_hardening(), True, TWO),
)


# The field's plate: 20 cm on 40 cm of snow of 200 kg/m3, to its ultimate resistance
FIELD_DEPTH, FIELD_PLATE, FIELD_SINKAGE = 0.4, 0.2, 0.225  # [m]


def field(name: str, what: str, material: Path, cell: float, slide: bool, **more: Value) -> Case:
    """In the snow of the material file itself, as wide as the field is: 1.2 m."""
    variables: dict[str, Value] = {
        "material": material,
        "friction": NO_SLIP,
        "cell": cell,
        "depth": FIELD_DEPTH,
        "size": FIELD_PLATE,
        "sinkage": FIELD_SINKAGE,
        "box": 1.2,
        **more,
    }
    if slide:
        surface = f"slide_cylinder 0 0 {0.5 * FIELD_PLATE + 0.25 * cell:.4f}"
        variables["terrain_keywords"] = f"{surface} slide_friction {SLIDE_FRICTION}"
    return script_case(
        name,
        SCENE,
        variables,
        what=what,
        stage="field",
        time_limit=TIME_LIMIT,
        may_fail=True,
    )


FIELD_CASES = (
    field("field_cap", "report's cap law", REPORT, 0.05, False),
    field("field_cap_40", "the same, cells of 4 cm", REPORT, 0.04, False),
    field("field_cap_slide_40", "the same, slide surface", REPORT, 0.04, True),
    field("field_fresh_40", "crushed in place, cells of 4 cm", FRESH, 0.04, False),
    field("field_foam_slide", "foam law, slide surface", FOAM, 0.05, True, modulus_scale=1),
)
