# SPDX-License-Identifier: GPL-2.0-or-later
"""Tyres on snow and sand."""

from collections.abc import Iterator
from dataclasses import replace

from overview import Experiment, Group, Stored

from .stored import PERCENT, SAND, TYRE_ON_SNOW, of

SOFT = "its 8 cm are those of its rigid wheel: d 30 to 40 kPa, coarse mesh (report_wheel)"
ANOTHER = "so the report's 3 mm are another quantity (tyre_shift)"
SOFTER = "the field's snow, on which 16 cm were measured, is softer than the report's (snow_wheel)"
STANDS_IN = "the tyre caps the pressure, and the wheel does not (tyre_on_snow)"
SHIFTS = "5 mm are the tread moving as a whole, whatever the ground (tyre_shift)"


def on_snow(run: str, column: str, scale: float = 1.0) -> Stored:
    return of(TYRE_ON_SNOW, run, column, scale, key="case")


def tyre(run: str, what: str, remark: str = "") -> tuple[Experiment, ...]:
    numbers = (
        ("z", "cm", "sinkage_mm", 0.1, "8"),
        ("deflection", "mm", "deflection_mm", 1.0, "3"),
        ("deflection over section height", "%", "deflection_share_section", PERCENT, "1.8"),
    )
    finer = "tyre_241_40" if run == "tyre_241_50" else ""
    return tuple(
        Experiment(
            "p. 54",
            what,
            quantity,
            unit,
            report=report,
            ours=on_snow(run, column, scale),
            near=on_snow(finer, column, scale) if finer else None,
            cost=on_snow(run, "user_s"),
            remark=remark,
            why=SOFT if quantity == "z" else SHIFTS,
        )
        for quantity, unit, column, scale, report in numbers
    )


def softer_tyres() -> Iterator[Experiment]:
    """At the other pressures; the report has its tyre on snow at 241 kPa only."""
    for pressure, road in (("179", "28"), ("103", "38")):
        for quantity, unit, column, scale in (
            ("z", "cm", "sinkage_mm", 0.1),
            ("deflection over section height", "%", "deflection_share_section", PERCENT),
        ):
            run = f"tyre_{pressure}_50"
            yield Experiment(
                "p. 54",
                f"tyre, {pressure} kPa, 20 cm of snow, zero slip, d 5 kPa",
                quantity,
                unit,
                ours=on_snow(run, column, scale),
                cost=on_snow(run, "user_s") if quantity == "z" else None,
                remark=f"not in the report; on a road {road} % (Table 6)" if unit == "%" else "",
            )


def stand_in() -> Iterator[Experiment]:
    """The report's conclusion: a rigid wheel may stand in for the tyre."""
    for d, rigid, of_tyre in (
        ("5", "rigid_50", "tyre_241_50"),
        ("30", "rigid_d30_50", "tyre_241_d30_50"),
    ):
        for quantity, unit, column, scale in (
            ("z", "cm", "sinkage_mm", 0.1),
            ("c", "", "coefficient", 1.0),
        ):
            yield Experiment(
                "p. 54",
                f"rigid wheel in place of the tyre, d {d} kPa",
                quantity,
                unit,
                report=on_snow(of_tyre, column, scale),
                ours=on_snow(rigid, column, scale),
                cost=on_snow(rigid, "user_s") if quantity == "z" else None,
                remark="report: our tyre, 241 kPa, with its deflection in z",
                why=STANDS_IN,
            )


def ahead(state: str, what: str) -> Experiment:
    return Experiment(
        "Fig 69",
        what,
        "share of vertical stress ahead of the axle, 2.5 cm deep",
        "%",
        report="50",
        ours=Stored(SAND, {"quantity": "sz_25_front"}, state, PERCENT),
        floor=True,
        cost=Stored(SAND, {"quantity": "user_s"}, state),
        remark="the report: slightly ahead, no number",
    )


def principal_stresses() -> tuple[Experiment, ...]:
    """The report's three findings, each as the sign of a number."""
    table = "sand_zones/stress.csv"
    rows = (
        ("44", "greatest compression ahead of the axle, 4.4 cm deep", "mm", "compression_ahead_mm"),
        ("44", "largest principal stress at the sides, 4.4 cm deep", "kPa", "largest_beside_kPa"),
        ("190", "the same below the tyre, 19 cm deep", "kPa", "largest_under_kPa"),
        ("44", "greatest shear ahead of the axle, 4.4 cm deep", "mm", "shear_ahead_mm"),
    )
    return tuple(
        Experiment(
            "Fig 69",
            what,
            "stress" if unit == "kPa" else "place",
            unit,
            report="0",
            ours=Stored(table, {"depth_mm": depth}, column),
            floor=True,
            cost=Stored(table, {"depth_mm": depth}, "user_s") if index == 0 else None,
            remark="tension positive" if unit == "kPa" else "particles stand 12.5 mm apart",
            why="of two ridges of the contact the one behind the axle is higher there (sand_zones)",
        )
        for index, (depth, what, unit, column) in enumerate(rows)
    )


def flow_zones() -> Iterator[Experiment]:
    """Wong and Reece's zones, which the report has in words: sand goes forward in one and backward
    in the other under a rolling wheel; under a locked one all goes forward."""
    table = "sand_zones/flow.csv"
    for run, how in (("towed", "towed"), ("driven", "driven, slip 0.3")):
        yield Experiment(
            "Fig 1",
            f"two zones of flow in sand under a wheel, {how}",
            "share that moves backward",
            report="0.01",
            ours=of(table, run, "backward_share"),
            floor=True,
            cost=of(table, run, "user_s"),
            remark="zones in words; a zone here: a hundredth of the motion or more",
            why="it skids by a third and flows as under a locked wheel, in one zone (sand_zones)",
        )
    yield Experiment(
        "Fig 1",
        "one zone of flow in sand under a locked wheel",
        "share that moves forward",
        report="1",
        ours=of(table, "locked", "forward_share"),
        cost=of(table, "locked", "user_s"),
        remark="zones in words",
    )


SHIFT = "tyre_shift/results.csv"


def shifts() -> tuple[Experiment, ...]:
    """Of a deflection the part that the load fixes whatever the ground: it is less than all."""
    return tuple(
        Experiment(
            "p. 54",
            what,
            "deflection" if column == "deflection_mm" else "part of the deflection",
            "mm",
            report="3",
            ours=of(SHIFT, run, column),
            limit=column != "deflection_mm",
            cost=of(SHIFT, run, "user_s") if column == "deflection_mm" else None,
            remark=remark,
            why=ANOTHER,
        )
        for run, column, what, remark in (
            ("d_30", "shift_up_mm", "of it the tread as a whole", "less than all of the report's?"),
            ("d_30_brick", "deflection_mm", "tyre with a tread of rubber, d 30 kPa", ""),
            (
                "d_30_brick",
                "shift_up_mm",
                "of it the tread as a whole",
                "less than all of the report's?",
            ),
        )
    )


def buckling() -> Iterator[Experiment]:
    """How much of the tread lifts where it buckles, and how its pressure alternates from node to
    node: on soft ground less than on a plane."""
    plane, snow = (
        of("tyre_on_snow/lift.csv", run, "user_s") for run in ("lift_plane", "lift_field_snow")
    )
    what = "buckling of the tread at 69 kPa under 5 kN"
    for column, quantity, unit, scale in (
        ("lifted_share", "share of the contact that lifts", "%", PERCENT),
        ("alternation", "alternation of the pressure", "", 1.0),
    ):
        on_plane = replace(plane, column=column, scale=scale)
        first = column == "lifted_share"
        yield Experiment(
            "p. 40",
            f"{what}, on a plane",
            quantity,
            unit,
            ours=on_plane,
            cost=plane if first else None,
            remark="pictures only",
        )
        yield Experiment(
            "p. 40",
            f"{what}, on 20 cm of `field_snow`",
            quantity,
            unit,
            report=on_plane,
            ours=replace(snow, column=column, scale=scale),
            limit=True,
            cost=snow if first else None,
            remark="the report: disappears on soft ground; limit: ours on the plane",
        )


TYRE_ON_GROUND = Group(
    "Tyre on snow and on sand",
    (
        *tyre("tyre_241_50", "tyre, 241 kPa, 20 cm of snow, zero slip, d 5 kPa"),
        *tyre("tyre_241_d30_50", "the same, d 30 kPa"),
        *softer_tyres(),
        *stand_in(),
        *shifts(),
        *(
            Experiment(
                "p. 54",
                "smooth tread of bricks, 241 kPa, 20 cm of `field_snow`",
                quantity,
                unit,
                report=report,
                ours=of("brick_tyre_on_ground/results.csv", "snow_smooth", column, scale),
                cost=of("brick_tyre_on_ground/results.csv", "snow_smooth", "user_s")
                if quantity == "z"
                else None,
                why=why,
            )
            for quantity, unit, report, column, scale, why in (
                ("z", "cm", "8", "hub_mm", 0.1, SOFTER),
                ("deflection", "mm", "3", "deflection_mm", 1.0, ANOTHER),
            )
        ),
        ahead("cap_rolled", "the tyre rolling on McCormick sand, cap law"),
        ahead("elastic_rolled", "the same, elastic sand"),
        *principal_stresses(),
        *flow_zones(),
        *buckling(),
    ),
)
