# SPDX-License-Identifier: GPL-2.0-or-later
"""The tyres on a hard surface."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from overview import NOTHING, Experiment, Group, Stored

from .stored import GIVEN, PERCENT, of


def rolling(damping: int, column: str = "resistance_N") -> Stored:
    return Stored("tyre_table6/rolling.csv", {"damping": str(damping)}, column)


def stress(column: str) -> Stored:
    row = {"mesh": "12x144", "tread_stiffness": "10"}
    return Stored("tyre_table6/contact_stress.csv", row, column)


DEFLECTIONS = {103: "6.3", 138: "5.4", 179: "4.6", 241: "3.1"}  # [cm]
AREAS = {103: "509.7", 138: "419.4", 179: "364.5", 241: "281.7"}  # [cm2]
WIDTHS = {103: "27.9", 138: "25.9", 179: "26.0", 241: "25.1"}  # [cm]
BRICK = "tread of bricks"


class TyreStudy(NamedTuple):
    """Where the results of a tyre on a plane are."""

    place: str  # in the report
    folder: str
    pressure: str  # format of a pressure in its tables [kPa]
    finer: Mapping[str, str]  # further columns that name a row of its meshes.csv
    remark: str


DARNELL = TyreStudy("Table 6", "tyre_table6", "{}.0", {"mesh": "12x144"}, "")
BRICKS = TyreStudy("Table 6", "tyre_brick", "{}", {}, BRICK + ", equivalent")


def table6(tyre: TyreStudy) -> Iterator[Experiment]:
    """Under 6227 N, by pressure."""
    for what, column, unit, measured in (
        ("deflection", "deflection_cm", "cm", DEFLECTIONS),
        ("contact area", "area_cm2", "cm2", AREAS),
        ("section width", "section_width_cm", "cm", WIDTHS),
    ):
        for pressure, value in measured.items():
            row = {"pressure_kPa": tyre.pressure.format(pressure)}
            used = "identified on" if pressure in (103, 241) and measured is not WIDTHS else ""
            yield Experiment(
                tyre.place,
                f"{what} under 6227 N, {pressure} kPa",
                what,
                unit,
                measured=value,
                ours=Stored(f"{tyre.folder}/table6.csv", row, column),
                near=Stored(f"{tyre.folder}/meshes.csv", {**row, **tyre.finer}, column),
                remark=", ".join(filter(None, (tyre.remark, used))),
            )


def brick_stress(sections: int, tread: str = "smooth") -> Stored:
    row = {"tread": tread, "sections": str(sections)}
    return Stored("tyre_brick/contact_stress.csv", row, "largest_kPa")


def brick_rolling(column: str) -> Stored:
    return Stored("tyre_brick/rolling.csv", {"damping": "0"}, column)


INFLATION = "207"  # [kPa] of Fig 52
RIDGE = "measured: a ridge above the inflation, in words"
NO_RUBBER = "ours is of cords and belts, without the rubber outside of them"

HARD_SURFACE = Group(
    "Tyre 235/75 R15 on a hard surface",
    (
        *table6(DARNELL),
        Experiment(
            "Table 6",
            "inflated to 241 kPa, no load",
            "largest width",
            "cm",
            measured="24.9",
            ours=of("tyre_table6/inflated.csv", "241.0", "section_width_cm", key="pressure_kPa"),
            remark=NO_RUBBER,
        ),
        Experiment(
            "Table 6",
            "inflated from 103 to 241 kPa, no load",
            "growth of the diameter",
            "%",
            measured="0.8",
            ours=of("tyre_table6/inflated.csv", "241.0", "growth", PERCENT, key="pressure_kPa"),
            remark="74.7 to 75.3 cm",
            why="p R^2/(E1 h): Table 8's belt is as stiff as that (tyre_table6)",
        ),
        Experiment(
            "Fig 52",
            "contact stress, 207 kPa, 6627 N",
            "largest",
            "kPa",
            measured="765",
            ours=stress("largest_kPa"),
            why="a line force of the sidewall, which grows with the mesh (tyre_table6)",
        ),
        Experiment(
            "Fig 52",
            "the same, middle of the tread",
            "stress",
            "kPa",
            ours=stress("middle_kPa"),
            remark=f"{RIDGE}; the belt of Table 8 is a membrane there and has none",
        ),
        Experiment(
            "pp. 24-41",
            "rolling resistance at 8 km/h, 241 kPa, friction 0.825",
            "force",
            "N",
            report="10",
            ours=rolling(100),
            uncertainty=rolling(100, "resistance_error_N"),
            limit=True,
            remark="the report's model is below this; damping 100 1/s",
        ),
        Experiment(
            "pp. 24-41",
            "the same, damping 300 1/s",
            "force",
            "N",
            measured="25",
            ours=rolling(300),
            uncertainty=rolling(300, "resistance_error_N"),
            remark="calibrates the damping",
        ),
        Experiment(
            "Table 10",
            "rolling, 20 m in the report, 4.5 m of half the tyre here",
            "deflection",
            "mm",
            measured="31",
            ours=rolling(100, "deflection_mm"),
            hours="0.18",
            cost=rolling(100, "user_s"),
            remark="measured at rest (Table 6); 20 m of the whole tyre: 100 core s",
        ),
        *table6(BRICKS),
        Experiment(
            "Table 6",
            "inflated to 241 kPa, no load",
            "largest width",
            "cm",
            measured="24.9",
            ours=of("tyre_brick/inflated.csv", "241", "width_cm", key="pressure_kPa"),
            remark=BRICK,
        ),
        Experiment(
            "Table 6",
            "inflated to 241 kPa, no load",
            "diameter",
            "cm",
            measured="75",
            ours=of("tyre_brick/inflated.csv", "241", "diameter_cm", key="pressure_kPa"),
            remark=BRICK + "; 74.7 to 75.3 cm",
        ),
        Experiment(
            "Fig 52",
            "contact stress, 207 kPa, 6627 N",
            "largest",
            "kPa",
            measured="765",
            ours=brick_stress(120),
            near=brick_stress(60),
            remark=BRICK + ", smooth",
            why="Fig 52 measures a ribbed tread, whose voids carry nothing (tyre_table6)",
        ),
        Experiment(
            "Fig 52",
            "the same, ribs",
            "largest",
            "kPa",
            measured="765",
            ours=brick_stress(120, "ribbed"),
            near=brick_stress(240, "ribbed"),
            remark=BRICK + ", ribbed",
        ),
        *(
            Experiment(
                "Fig 52",
                "the same, middle of the tread",
                "stress",
                "kPa",
                measured=INFLATION,
                ours=replace(brick_stress(120, tread), column="centreline_kPa"),
                floor=True,
                remark=f"{BRICK}, {tread}; {RIDGE}",
            )
            for tread in ("smooth", "ribbed")
        ),
        Experiment(
            "Table 10",
            "rolling 2 m at 8 km/h, 241 kPa, half tyre, 60 sections, no damping",
            "force",
            "N",
            report="10",
            ours=brick_rolling("resistance_N"),
            uncertainty=brick_rolling("resistance_error_N"),
            limit=True,
            hours="22",
            cost=brick_rolling("user_s"),
            remark=BRICK + ", smooth; the report's at 120 sections",
        ),
        Experiment(
            "Table 10",
            "ribbed tread, whole tyre: 25 mm of rolling in the report, 2 m here",
            "",
            hours="488",
            remark=BRICK + "; 481 core s, one run by hand: cost alone (page of tyre_brick)",
            aside=NOTHING,
        ),
        Experiment(
            "Fig 54",
            "buckling of ribs: lean of a rib's outer wall, 103 kPa, 6227 N",
            "angle",
            "degrees",
            ours=Stored(
                "tyre_brick/ribs.csv",
                {"pressure_kPa": "103", "load_N": "6227"},
                "lean_at_2.9_cm_deg",
            ),
            remark=BRICK + ", ribbed; only drawn; here its walls lean apart: no buckling",
        ),
        *(
            Experiment(
                "Tables 9, 10",
                f"brick tread, smooth, 241 kPa: natural mode, {mode}",
                "frequency",
                "Hz",
                ours=Stored(
                    "tyre_shift/modes.csv", {"run": "plane_brick", "mode": mode}, "frequency_Hz"
                ),
                remark="the report gives no mode",
            )
            for mode in ("turning", "shaking in the wheel's plane")
        ),
        *(
            Experiment(
                figures,
                f"{what} under 4000 N, {pressure} kPa",
                what,
                unit,
                ours=Stored(
                    "tyre_table6/load_deflection.csv",
                    {"pressure_kPa": f"{pressure}.0", "load_N": "4000.0"},
                    column,
                ),
                remark="measured curves only drawn",
            )
            for figures, what, unit, column in (
                ("Figs 45-47", "deflection", "cm", "deflection_cm"),
                ("Figs 48-51", "contact area", "cm2", "perimeter_area_cm2"),
            )
            for pressure in (103, 241)
        ),
        *(
            Experiment(
                "Fig 55",
                f"sidewall profile under 6227 N, {pressure} kPa",
                f"half its width, {state}",
                "cm",
                ours=Stored(
                    "tyre_brick/profiles.csv",
                    {"pressure_kPa": pressure},
                    f"{state}_half_width_cm",
                ),
                remark=BRICK + ": of its cords; curves only drawn; over all: Table 6 above",
            )
            for pressure in ("103", "241")
            for state in ("inflated", "loaded")
        ),
        *(
            Experiment(
                "Table 7",
                f"cantilever tests of the tread, {way}",
                "EI per width",
                "N m",
                measured=measured,
                ours=of(GIVEN, f"belt_stiffness_{way}", "value", key="quantity"),
                remark="an input, by Table 8",
            )
            for way, measured in (("along", "4.11"), ("across", "2.21"))
        ),
    ),
)
