# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the plate on snow of several laws and cells, the laws in confined compression."""

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import point_case, script_case

INPUTS = Path(__file__).resolve().parents[2]
SCENE = INPUTS / "scenes/plate_on_snow.lig"
MATERIALS = INPUTS / "materials"
TIME_LIMIT = 3600.0  # [s] of one run
FRESH, REPORT, FOAM, FITTED = (
    MATERIALS / f"fresh_snow{name}.yaml" for name in ("", "_shoop", "_foam", "_foam_oedometer")
)


def on_snow(name: str, what: str, stage: str, variables: Mapping[str, Value]) -> Case:
    return script_case(
        name, SCENE, variables, what=what, stage=stage, time_limit=TIME_LIMIT, may_fail=True
    )


def plate(name: str, what: str, **variables: Value) -> Case:
    """The scene with a cap law, fresh_snow unless a material is given."""
    given: dict[str, Value] = {"material": FRESH, **variables}
    return on_snow(name, what, "cap", given)


def report(name: str, what: str, **variables: Value) -> Case:
    """The scene with the report's reading of the cap law."""
    given: dict[str, Value] = {"material": REPORT, **variables}
    return plate(name, what, **given)


def foam(name: str, what: str, **variables: Value) -> Case:
    """The scene with the foam law, whose porous elasticity has no E to scale."""
    given: dict[str, Value] = {"material": FOAM, "modulus_scale": 1, **variables}
    return on_snow(name, what, "foam", given)


def with_material(case: Case, text: str) -> Case:
    """The case with a material file of its own."""
    variables: dict[str, Value] = {**case.variables, "material": f"{FOLDER}/material.yaml"}
    return replace(case, variables=variables, files={"material.yaml": text})


def variant(name: str, what: str, text: str) -> Case:
    """fresh_snow with other keys."""
    return with_material(plate(name, what), f"title: {what}\nbase: {FRESH}\n{text}\n")


def steep(name: str, beta: float) -> Case:
    """The report's cap law with a steeper cone [degrees] and the same confined compression.

    p_b such that sigma_1 = p_b (1 + 2/3 tan beta) + 2/3 d stays as it was.
    """

    def rise(angle: float) -> float:
        return 1 + 2 / 3 * math.tan(math.radians(angle))

    text = REPORT.read_text()
    p, eps = (_numbers(text, key) for key in ("p", "eps_vol_pl"))
    strengths = [float(value) * rise(22.53) / rise(beta) for value in p.strip("[]").split(",")]
    eccentricity = 0.95 * strengths[0] / 5e3
    case = report(name, f"the report's, beta {beta} degrees, same confined compression")
    return with_material(
        case,
        f"title: Fresh snow, beta {beta}\nbase: {REPORT}\n"
        f"law: {{beta: {beta}, R: {eccentricity:.4g}}}\n"
        f"hardening: {{type: table, p: {strengths}, eps_vol_pl: {eps}, interpolation: linear, "
        "beyond: extrapolate}\n",
    )


def _numbers(text: str, key: str) -> str:
    """The list behind a key of a material file, as it stands there."""
    found = re.search(rf"^  {key}: *(\[.*\])", text, re.M)
    assert found
    return found[1]


def linear(name: str, what: str, **variables: Value) -> Case:
    """The foam law with linear elasticity instead of the porous one, which takes three times."""
    text = (
        f"title: Foam law, linear elasticity\nbase: {FOAM}\n"
        "elasticity: {type: linear, E: 13.79e6, nu: 0.3}\n"
    )
    return with_material(foam(name, what, **variables), text)


LINEAR = "foam law, linear elasticity"
FITTED_LAMBDA = "foam law, lambda from the oedometer"
CASES = (
    plate("fresh", "fresh_snow: crushed in place"),
    plate("fresh_fine", "the same, cells of 3.1 cm", cell=0.03125),
    plate("fresh_finer", "the same, cells of 2.5 cm", cell=0.025),
    plate("fresh_smooth", "the same, no friction on plate and edge", friction=0),
    plate("fresh_slow", "the same, half the speed", speed=0.25),
    variant("fresh_d", "the same, d = 2 kPa", "law: {d: 2e3}"),
    variant("fresh_linear", "the same, straight in p", "hardening: {interpolation: linear}"),
    plate(
        "clay",
        "Cam clay with the same oedometer and K0",
        material=MATERIALS / "fresh_snow_cam_clay.yaml",
    ),
    plate(
        "clay_fine",
        "the same, cells of 3.1 cm",
        material=MATERIALS / "fresh_snow_cam_clay.yaml",
        cell=0.03125,
    ),
    plate(
        "clay_finer",
        "the same, cells of 2.5 cm",
        material=MATERIALS / "fresh_snow_cam_clay.yaml",
        cell=0.025,
    ),
    plate("field", "field_snow, 220 kg/m3", material=MATERIALS / "field_snow.yaml"),
    report("oedometer", "the report's reading, beta 22.5 degrees"),
    report("fine", "the report's, cells of 3.1 cm", cell=0.03125),
    report("finer", "the report's, cells of 2.5 cm", cell=0.025),
    report(
        "log",
        "the report's, hardening straight in ln p",
        material=MATERIALS / "fresh_snow_shoop_log.yaml",
    ),
    report(
        "p_0413",
        "the report's, hardening read as p = 0.413 sigma1",
        material=MATERIALS / "fresh_snow_p_0413.yaml",
    ),
    steep("beta_45", 45),
    steep("beta_60", 60),
    foam("foam", "foam law"),
    foam("foam_fine", "foam law, cells of 3.1 cm", cell=0.03125),
    foam("foam_weightless", "foam law, no weight", gravity=0),
    foam("foam_fitted", FITTED_LAMBDA, material=FITTED),
    foam("foam_fitted_weightless", f"{FITTED_LAMBDA}, no weight", material=FITTED, gravity=0),
    foam("foam_deep", "foam law, 80 cm of snow", depth=0.8),
    foam("foam_box", "foam law, walls 1 m apart", box=1.0),
    linear("foam_linear", LINEAR),
    linear("foam_linear_finer", f"{LINEAR}, cells of 2.5 cm", cell=0.025),
    foam("foam_smooth", "foam law, no friction on plate and edge", friction=0),
    foam("foam_remap_1", "foam law, remapping at each step", remap_interval=1),
    foam(
        "foam_column",
        "foam law, plate as wide as the box",
        shape="square",
        size=0.6,
        friction=0,
        cell=0.05,
    ),
)
CONFINED = tuple(
    point_case(
        f"confined/{material.stem}",
        material.stem,
        material,
        "{type: confined, strain: [1.1], steps: 400}",
        what=what,
        stage="confined",
    )
    for material, what in (
        (FRESH, "cap law"),
        (REPORT, "cap law, the report's"),
        (FOAM, "foam law"),
        (FITTED, FITTED_LAMBDA),
    )
)
