# SPDX-License-Identifier: GPL-2.0-or-later
"""What the report plans to do next."""

from collections.abc import Iterator
from dataclasses import replace

from overview import Experiment, Group

from .stored import not_done, of


def pressures() -> Iterator[Experiment]:
    """The tyre with less and more air, beside the report's empirical formula."""
    table = "snow_wheel/pressures.csv"
    for pressure in ("103", "241"):
        for quantity, unit, column, scale in (
            ("z", "cm", "sinkage_m", 100.0),
            ("c", "", "resistance", 1.0),
        ):
            stored = of(table, pressure, column, scale, key="pressure_kPa")
            yield Experiment(
                "pp. 55-56",
                f"design: the tyre at {pressure} kPa on 20 cm of `field_snow`",
                quantity,
                unit,
                report=replace(stored, column=f"nrmm_{column}"),
                ours=stored,
                cost=replace(stored, column="user_s", scale=1.0) if quantity == "z" else None,
                remark="report: NRMM, eq 29-33; 179 kPa is above",
                why="at 179 kPa NRMM has 0.10 too, where 0.074 was measured (snow_wheel)",
            )


def designs() -> Iterator[Experiment]:
    """Rigid wheels of other sizes beside the closed form."""
    for run, size in (
        ("design_56x27cm", "diameter 56 cm, width 27.2 cm"),
        ("design_74x27cm", "diameter 74 cm, width 27.2 cm"),
        ("design_100x27cm", "diameter 100 cm, width 27.2 cm"),
        ("design_74x18cm", "diameter 74 cm, width 18 cm"),
        ("design_74x40cm", "diameter 74 cm, width 40 cm"),
    ):
        yield Experiment(
            "pp. 55-56",
            f"design: rigid wheel on 20 cm of `field_snow`, {size}",
            "c",
            report=of("snow_wheel/design.csv", run, "closed_form_resistance"),
            ours=of("snow_wheel/design.csv", run, "resistance"),
            uncertainty=of("snow_wheel/design.csv", run, "resistance_change"),
            cost=of("snow_wheel/design.csv", run, "user_s"),
            remark="report: the closed form, of compaction alone",
            why="the closed form lets no snow go aside (snow_wheel)",
        )


FUTURE = Group(
    "What the report leaves to others (pp. 41, 55)",
    (
        *pressures(),
        *designs(),
        *(
            Experiment(
                "pp. 55-56",
                f"tread blocks: {tread} tread, 241 kPa, 20 cm of `field_snow`",
                "c",
                "",
                ours=of("brick_tyre_on_ground/results.csv", f"snow_{tread}", "c"),
                uncertainty=of("brick_tyre_on_ground/results.csv", f"snow_{tread}", "c_error"),
                remark="coarse; none measured",
            )
            for tread in ("smooth", "lugged")
        ),
        *(
            not_done("pp. 55-56", what, "", f"{lacks}; future work there, without a number")
            for what, lacks in (
                ("temperature, melting, sintering in time", "no law knows temperature or age"),
                ("rate effects, wet snow, thawing soil", "no law knows rate or water"),
                ("suspension, washboard", "a rig's load has a mass and no spring"),
                ("pavements, geosynthetics, pore water", "no layers of unlike ground, no water in it"),
                ("rubber that creeps", "the rubber's law is elastic, its damping viscous"),
            )
        ),
        *(
            Experiment(
                "pp. 55-56",
                f"repeated passes: the tyre on 20 cm of `field_snow`, pass {number}",
                quantity,
                unit,
                ours=of("snow_wheel/passes.csv", f"passes_{number}", column, scale),
                uncertainty=of("snow_wheel/passes.csv", f"passes_{number}", f"{change}", scale),
                cost=of("snow_wheel/passes.csv", f"passes_{number}", "user_s")
                if quantity == "z"
                else None,
                remark="none measured",
            )
            for number in (1, 2, 3)
            for quantity, unit, column, change, scale in (
                ("z", "cm", "sinkage_m", "sinkage_change_m", 100.0),
                ("c", "", "resistance", "resistance_change", 1.0),
            )
        ),
    ),
)
