# SPDX-License-Identifier: GPL-2.0-or-later
"""Material models."""

from overview import NOTHING, Experiment, Group

from .stored import GIVEN, OEDOMETER, PERCENT, effect, not_done, of


def oedometer(law: str, what: str, remark: str = "") -> Experiment:
    return Experiment(
        "Table 2, Fig 27",
        what,
        "density under 100 kPa",
        "kg/m3",
        measured="410",
        ours=of(OEDOMETER, law, "density_100kPa", key="law"),
        remark=remark,
    )


MATERIAL = Group(
    "Material models",
    (
        oedometer("fresh_snow", "confined compression, cap law with K0 of eq 24"),
        oedometer("fresh_snow_shoop", "the same by Tables 1 and 3"),
        oedometer("fresh_snow_cam_clay", "the same by cohesive Cam clay"),
        oedometer(
            "fresh_snow_foam",
            "the same by the foam of Table 1",
            "the report calls its foam good (Fig 27); by eq 18 it needs twice the stress",
        ),
        oedometer("fresh_snow_foam_oedometer", "the same, lambda fitted"),
        Experiment(
            "eq 24",
            "lateral over axial stress, cap law with K0 of eq 24",
            "K0",
            measured="0.12",
            ours=of(OEDOMETER, "fresh_snow", "k0", key="law"),
        ),
        Experiment(
            "eq 24",
            "the same by Tables 1 and 3",
            "K0",
            measured="0.12",
            ours=of(OEDOMETER, "fresh_snow_shoop", "k0", key="law"),
            why="beta 22.53 degrees alone fixes K0 (snow_oedometer)",
        ),
        *effect(
            "p. 13, Fig 21",
            "the wheel of Fig 62 with a tenth of E; no law lets E follow density",
            "soft",
        ),
        not_done(
            "Figs 21-25",
            "compilations of E, strength, compression",
            "",
            "measurements of others, only drawn; nothing is computed there",
            NOTHING,
        ),
        Experiment(
            "Fig 34",
            "McCormick sand, confined compression by 8 MPa",
            "axial strain",
            "%",
            ours=of(GIVEN, "sand_axial_strain_8MPa", "value", PERCENT, key="quantity"),
            remark="measured curve only drawn",
        ),
        not_done(
            "pp. 5-23",
            "snow pressed slowly widens",
            "",
            "no snow law depends on the rate; the report has words, no number",
        ),
    ),
)
