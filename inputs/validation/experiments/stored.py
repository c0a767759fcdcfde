# SPDX-License-Identifier: GPL-2.0-or-later
"""How a row of the table finds its numbers."""

from overview import Experiment, Stored

WHEEL, SNOW_WHEEL = "report_wheel/results.csv", "snow_wheel/results.csv"
ERROR, ACCURACY = "snow_wheel/error.csv", "snow_wheel/accuracy.csv"
PLATE, TYRE_ON_SNOW = "snow_plate/results.csv", "tyre_on_snow/results.csv"
SAND = "tyre_on_sand_ground/results.csv"
OEDOMETER = "snow_oedometer/results.csv"
PLATE_VARIANTS = "plate_variants/results.csv"
GIVEN = "report_inputs/results.csv"

PERCENT = 100.0


def of(table: str, run: str, column: str, scale: float = 1.0, key: str = "run") -> Stored:
    return Stored(table, {key: run}, column, scale)


def not_done(place: str, what: str, quantity: str, reason: str, aside: str = "") -> Experiment:
    """aside: a verdict other than that."""
    return Experiment(place, what, quantity, remark=reason, aside=aside)


HELD = "held at zero slip, a wheel drives with its friction: c is linear in slip (report_wheel)"
SLIDES = "under a slippery wheel soft snow flows further: 17.9 cm, not 16.0 (report_wheel)"


def effect(place: str, what: str, run: str, limit: str = "") -> tuple[Experiment, ...]:
    """How far z and c move; limit [%]: where the report finds little effect."""
    remark = f"report: little effect, here less than {limit} %" if limit else "no number there"
    return tuple(
        Experiment(
            place,
            what,
            f"change of {quantity}",
            "%",
            report=limit,
            ours=of("report_wheel/effects.csv", run, f"{column}_percent"),
            limit=bool(limit),
            cost=of(WHEEL, run, "user_s") if quantity == "z" else None,
            remark=remark,
            why=HELD if quantity == "c" else SLIDES,
        )
        for quantity, column in (("z", "sinkage"), ("c", "resistance"))
    )
