# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates on snow."""

from collections.abc import Iterator

from overview import Experiment, Group

from .stored import PLATE, PLATE_VARIANTS, of


def plate(
    case: str, what: str, near: str, remark: str, study: str = PLATE, why: str = ""
) -> Experiment:
    return Experiment(
        "Fig 31",
        what,
        "largest force",
        "N",
        measured="1867",
        ours=of(study, case, "peak_N", key="case"),
        near=of(study, near, "peak_N", key="case") if near else None,
        cost=of(study, case, "user_s", key="case"),
        remark=remark,
        why=why,
    )


def variant(case: str, what: str, near: str, why: str = "") -> Experiment:
    return plate(case, what, near, "180 kg/m3, plate holds the snow", PLATE_VARIANTS, why)


def size_zero(case: str, what: str) -> Experiment:
    table = "plate_variants/size_zero.csv"
    return Experiment(
        "Fig 31",
        what,
        "largest force",
        "N",
        measured="1867",
        ours=of(table, case, "size_zero_N", key="case"),
        uncertainty=of(table, case, "error_N", key="case"),
        remark="cells of size zero; ± to an error of first order, or to the cells before",
    )


def below() -> tuple[Experiment, ...]:
    """Densities of the two layers within 5.4 cm below the plate, of variant 1."""
    return tuple(
        Experiment(
            "Fig 31",
            f"variant 1, layer {layer} of ten below the plate",
            "density",
            "kg/m3",
            measured=measured,
            ours=of(PLATE_VARIANTS, "cap_20", f"density_{layer}", key="case"),
            near=of(PLATE_VARIANTS, "cap_25", f"density_{layer}", key="case"),
            why="all seven runs spread the strain, no law has a crushing front (plate_variants)",
        )
        for layer, measured in ((1, "520"), (2, "440"))
    )


ASIDE = "its law lets snow flow aside; so does the report's cap model (Fig 28) (plate_variants)"


def aside() -> Iterator[Experiment]:
    """What stood at the plate's edge: marks in the report's snow stayed where they were."""
    for case, what in (
        ("cap_20", "variant 1: cap law"),
        ("cap_slide_25", "variant 2: with the slide surface"),
        ("foam_slide", "variant 3: foam, slide surface"),
    ):
        yield Experiment(
            "Fig 28",
            f"{what}, snow at the plate's edge",
            "moved out",
            "mm",
            measured="2",
            ours=of(PLATE_VARIANTS, case, "edge_moved_out_mm", key="case"),
            limit=True,
            remark="none was seen; here less than 1 % of the plate's width",
            why=ASIDE,
        )


PLATES = Group(
    "Plates on snow",
    (
        plate("fresh", "plate of 20.32 cm, `fresh_snow`, 4.2 cm cells", "fresh_fine", "200 kg/m3"),
        plate("fresh_finer", "the same, 2.5 cm cells", "fresh_fine", "200 kg/m3"),
        plate("clay_finer", "plate of 20.32 cm, Cam clay", "clay_fine", "200 kg/m3"),
        plate("finer", "the same, cap law of Tables 1 and 3", "fine", "200 kg/m3"),
        plate(
            "foam_fine",
            "the same, foam of Table 1",
            "foam",
            "without the slide surface",
            "snow_plate/foam.csv",
            "twice the oedometer's stress, and more than half goes past the sides (snow_plate)",
        ),
        variant("cap_20", "variant 1: cap law of Tables 1 and 3", "cap_25"),
        size_zero("cap", "the same"),
        variant("cap_slide_25", "variant 2: with a slide surface, friction 0.3", "cap_slide_31"),
        size_zero("cap_slide", "the same"),
        variant(
            "foam_slide",
            "variant 3: foam of Table 1, slide surface",
            "",
            "its lambda; with the oedometer's 6027 N (plate_variants)",
        ),
        Experiment(
            "Fig 30",
            "variant 1, densest place",
            "density",
            "kg/m3",
            report="420",
            ours=of(PLATE_VARIANTS, "cap_20", "greatest_kg_m3", key="case"),
            near=of(PLATE_VARIANTS, "cap_31", "greatest_kg_m3", key="case"),
            remark="one particle",
            why="settled here from 3.1 to 2.0 cm; an element averages more snow (plate_variants)",
        ),
        *below(),
        Experiment(
            "Fig 31",
            "variant 1, beside the plate",
            "density",
            "kg/m3",
            measured="195",
            ours=of(PLATE_VARIANTS, "cap_20", "beside_kg_m3", key="case"),
            near=of(PLATE_VARIANTS, "cap_25", "beside_kg_m3", key="case"),
            remark="measured: 180 to 210",
        ),
        *aside(),
        Experiment(
            "Fig 29b",
            "field plate, 20 cm on 40 cm of snow, slide surface",
            "force after 22.5 cm",
            "N",
            ours=of("plate_variants/field.csv", "field_cap_slide_40", "peak_N", key="case"),
            cost=of("plate_variants/field.csv", "field_cap_slide_40", "user_s", key="case"),
            remark="no number there; an ultimate resistance is not reached, 5 % more per cm",
        ),
    ),
)
