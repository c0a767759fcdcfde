# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the lists of runs and the snow they use."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import snow
import table11

from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case

HERE = Path(__file__).resolve().parent
INPUTS = HERE.parents[1]
MATERIALS = INPUTS / "materials"
TIME_LIMIT = 3600.0  # [s] of one run

LOAD_MASS = 636.0  # [kg] [Shoop2001] p. 27
WIDTH = 0.272  # [m]
CELLS, COARSE_CELLS = 5, 4  # in 0.20 m: cells of 4 and 5 cm
# Numerical choices; the stage 'error' changes one at a time. Damping of the rig: the wheel comes to
# rest in height after 0.6 m.
BASE: dict[str, Value] = {
    "speed": 2.235,
    "settle": 0.4,
    "accelerate": 0.2,
    "distance": 1.2,
    "damping": 2000,
    "length": 1.6,
    "width": 0.8,
    "fine_width": 0.4,
    "particles": 2,
    "friction": 0.3,
    "stiffness": 0.4,
    "enforcement": "penalty",
    "remap_interval": 16,  # half of it where that stops a run
    "modulus_scale": 1.0,
}
WINDOW = 0.5  # [m] of travel at the end that is averaged
DEEP: dict[str, Value] = {"width": 1.0, "distance": 2.0, "clearance_above": 0.6}  # above 0.3 m

# ---- wheels: the measured one was a tyre

PRESSURE = 179e3  # [Pa] of the measured tyre
RIGID: dict[str, Value] = {  # of [Shoop2001]
    "body": "wheel/rigid diameter 0.74 width 0.272 shoulder 0.051 mass 636 inertia 2.15 "
    "segments 72",
    "load": f"load_mass {LOAD_MASS:g}",
    "radius": 0.37,
    "damping": 10000,
}


def tyre(pressure: float = PRESSURE, mesh: str = "4 36") -> dict[str, Value]:
    """The tyre of [Shoop2001] at a pressure [Pa]."""
    file = INPUTS / "tyres" / "p235_75r15.yaml"
    return {
        "body": f"tyre/darnell file {file} pressure {pressure:g} mesh {mesh} half yes mass 30 "
        "inertia 1",
        "load": "load_force 6227",
        "radius": 0.3483,
    }


# ---- runs


def case(
    name: str,
    stage: str,
    depth: float,
    variables: Mapping[str, Value],
    cells: int | None = None,
    what: str = "",
    files: Mapping[str, str] | None = None,
) -> Case:
    """Cells of about 4 cm that divide the depth [m], or so many; towed unless a mode is given."""
    cell = depth / (cells or round(depth * CELLS / 0.20))
    given: dict[str, Value] = {
        **BASE,
        "depth": depth,
        "cell": round(cell, 6),
        "clearance_above": 0.4,
        "mode": "towed",
        **(DEEP if depth > 0.3 else {}),
        **variables,
    }
    steps = int(str(given["remap_interval"]))
    return script_case(
        name,
        HERE / "wheel.lig",
        given,
        what=what,
        stage=stage,
        files=files or {},
        time_limit=TIME_LIMIT,
        fallback={"remap_interval": steps // 2} if steps > 1 else {},
        may_fail=True,
    )


def on_preset(
    name: str,
    stage: str,
    material: str,
    wheel: Mapping[str, Value],
    what: str,
    depth: float = 0.20,
    cells: int | None = None,
    **changes: Value,
) -> Case:
    """On snow of a file of inputs/materials."""
    given: dict[str, Value] = {**wheel, "material": MATERIALS / f"{material}.yaml", **changes}
    return case(name, stage, depth, given, cells, what)


def on_field_snow(
    name: str,
    stage: str,
    density: float,
    depth: float,
    wheel: Mapping[str, Value] | None = None,
    beginning: snow.Beginning = snow.FIELD_SNOW,
    cells: int | None = None,
    what: str = "",
    slope: float = snow.CRUSHED,
    **changes: Value,
) -> Case:
    """The tyre, unless another wheel is given, on the field's snow."""
    given: dict[str, Value] = {
        **(wheel or tyre()),
        "material": f"{FOLDER}/material.yaml",
        **changes,
    }
    text = snow.field_snow(density, beginning, f"field snow of {density:g} kg/m3", slope)
    return case(name, stage, depth, given, cells, what, {"material.yaml": text})


ZERO_SLIP = "slip slip 0"


def predictions() -> list[Case]:
    """From the oedometer alone; what the report's reading of it and of friction change."""
    stage = "predict"
    fresh, clay, report = "fresh_snow", "fresh_snow_cam_clay", "fresh_snow_shoop"
    return [
        on_preset("rigid_towed", stage, fresh, RIGID, "`fresh_snow`, towed"),
        on_preset("rigid_zero_slip", stage, fresh, RIGID, "the same, zero slip", mode=ZERO_SLIP),
        on_preset("tyre_towed", stage, fresh, tyre(), "`fresh_snow`, the tyre, towed"),
        on_preset("clay_towed", stage, clay, RIGID, "`fresh_snow_cam_clay`, towed"),
        on_preset("clay_zero_slip", stage, clay, RIGID, "the same, zero slip", mode=ZERO_SLIP),
        on_preset("clay_tyre_towed", stage, clay, tyre(), "`fresh_snow_cam_clay`, the tyre, towed"),
        on_preset("report_towed", stage, report, RIGID, "`fresh_snow_shoop`, towed"),
        on_preset("report_zero_slip", stage, report, RIGID, "the same, zero slip", mode=ZERO_SLIP),
        on_preset("rigid_deep", stage, clay, RIGID, f"`{clay}`, 0.50 m deep, towed", 0.50),
        on_field_snow("rigid_field", stage, 220, 0.20, RIGID, what="`field_snow`, towed"),
    ]


def row_name(density: float, depth: float) -> str:
    return f"row_{density:.0f}_{100 * depth:.0f}cm"


def densities_and_depths() -> list[tuple[float, float]]:
    """Of the shared rows [kg/m3], [m]; the densest and deepest first."""
    return sorted({(r["density_kgm3"], r["depth_m"]) for r in table11.reference()}, reverse=True)


def rows() -> list[Case]:
    """One run for each depth and density of the shared rows, the calibration's too."""
    return [
        on_field_snow(row_name(density, depth), "rows", density, depth)
        for density, depth in densities_and_depths()
    ]


def flowing_name(density: float, depth: float) -> str:
    return f"flowing_{row_name(density, depth).removeprefix('row_')}"


def coarse(depth: float) -> int:
    """Cells of about 5 cm in it [m]."""
    return round(depth * COARSE_CELLS / 0.20)


def flowing_rows() -> list[Case]:
    """The same on snow that flows aside more easily, in cells of about 5 cm."""
    return [
        on_field_snow(
            flowing_name(density, depth),
            "flowing",
            density,
            depth,
            cells=coarse(depth),
            slope=snow.FLOWING,
        )
        for density, depth in densities_and_depths()
    ]


SLOPES = (snow.SOFTEST, snow.FLOWING, snow.CRUSHED)  # with which the slope is identified
SLOPE_DEPTHS = (0.18, 0.20, 0.22, 0.38)  # [m]


def slope_name(slope: float, depth: float) -> str:
    """Of the run in 220 kg/m3; other stages have some with the same cells."""
    elsewhere = {
        (snow.CRUSHED, 0.18): row_name(table11.CALIBRATION_DENSITY, 0.18),
        (snow.CRUSHED, 0.20): f"error_{COARSE}",
        **{(snow.FLOWING, h): flowing_name(table11.CALIBRATION_DENSITY, h) for h in SLOPE_DEPTHS},
    }
    return elsewhere.get((slope, depth), f"slope_{slope:g}_{100 * depth:.0f}cm")


def slopes() -> list[Case]:
    """The runs for the slope that no other stage has."""
    wanted = [(slope_name(m, h), m, h) for m in SLOPES for h in SLOPE_DEPTHS]
    return [
        on_field_snow(
            name,
            "slope",
            table11.CALIBRATION_DENSITY,
            depth,
            cells=coarse(depth),
            slope=slope,
        )
        for name, slope, depth in wanted
        if name.startswith("slope")
    ]


SPREADING_SLOPES = (1.0, snow.SPREADING, 1.4)  # with which that of the rut's depth is identified
SPREADING_DEPTHS = (0.20,)  # [m]


def spreading_name(slope: float, density: float, depth: float) -> str:
    return f"m_{slope:g}_{density:.0f}_{100 * depth:.0f}cm"


def spreading_run(name: str, slope: float, density: float, depth: float, cells: int) -> Case:
    return on_field_snow(
        name,
        "spreading",
        density,
        depth,
        beginning=snow.TWO_STRESSES,
        cells=cells,
        slope=slope,
    )


def spreading_rows() -> list[Case]:
    """The same, with two identified stresses, on snow that goes aside so easily that ruts are as
    deep as the measured sinkages; what its slope is identified with; and one in finer cells."""
    wanted = [(snow.SPREADING, *row) for row in densities_and_depths()]
    wanted += [
        (slope, table11.CALIBRATION_DENSITY, depth)
        for slope in SPREADING_SLOPES
        if slope != snow.SPREADING
        for depth in SPREADING_DEPTHS
    ]
    made = [spreading_run(spreading_name(*row), *row, coarse(row[-1])) for row in wanted]
    finer = snow.SPREADING, table11.CALIBRATION_DENSITY, 0.20
    return [*made, spreading_run(f"{spreading_name(*finer)}_fine", *finer, CELLS)]


ERROR_BASE = row_name(220, 0.20)
PRESSURES = {103e3: "error_pressure_103", PRESSURE: ERROR_BASE, 241e3: "error_pressure_241"}  # [Pa]
COARSE = "cell_5cm"
ERRORS: dict[str, tuple[str, dict[str, Any]]] = {  # name -> what is changed, changes
    COARSE: ("cells of 5 cm", {"cells": COARSE_CELLS}),
    "cell_3.3cm": ("cells of 3.33 cm", {"cells": 6}),
    "cell_2.5cm": ("cells of 2.5 cm", {"cells": 8}),
    "mesh": ("tyre of 6 x 72 elements", {"wheel": tyre(mesh="6 72")}),
    "long": ("ground 2.0 m long", {"length": 2.0}),
    "wide": ("ground 1.2 m wide", {"width": 1.2}),
    "rolls_further": ("2.0 m of rolling", {"distance": 2.0}),
    "soft": ("modulus of the snow times 0.25", {"modulus_scale": 0.25}),
    "contact_0.2": ("springs of the contact times 0.5", {"stiffness": 0.2}),
    "slow": ("5 km/h", {"speed": 1.39}),
    "friction_0.1": ("friction 0.1", {"friction": 0.1}),
    "friction_0.6": ("friction 0.6", {"friction": 0.6}),
    "pressure_103": ("tyre at 103 kPa", {"wheel": tyre(103e3)}),
    "pressure_241": ("tyre at 241 kPa", {"wheel": tyre(241e3)}),
}


def errors() -> list[Case]:
    """The tyre on 0.20 m of 220 kg/m3: one choice changed at a time."""
    return [
        on_field_snow(f"error_{name}", "error", 220, 0.20, what=what, **changes)
        for name, (what, changes) in ERRORS.items()
    ]


# ---- design: what the report leaves to others

DESIGN_CELLS = 4  # in 0.20 m: cells of 5 cm
DIAMETER, WIDE = 0.74, 0.272  # [m] of RIGID, which stands between the others
DESIGNS = (  # diameter [m], width [m]
    (DIAMETER, 0.18),
    (DIAMETER, WIDE),
    (DIAMETER, 0.40),
    (0.56, WIDE),
    (1.00, WIDE),
)


def rigid(diameter: float, width: float) -> dict[str, Value]:
    """RIGID with another diameter and width [m], under the same load."""
    return {
        **RIGID,
        "body": f"wheel/rigid diameter {diameter:g} width {width:g} shoulder 0.051 mass 636 "
        "inertia 2.15 segments 72",
        "radius": 0.5 * diameter,
    }


def designs() -> list[Case]:
    """Rigid wheels of other sizes on the field snow of 220 kg/m3."""
    return [
        on_field_snow(
            f"design_{100 * diameter:.0f}x{100 * width:.0f}cm",
            "design",
            220,
            0.20,
            rigid(diameter, width),
            cells=DESIGN_CELLS,
            what=f"diameter {diameter:g} m, width {width:g} m",
        )
        for diameter, width in DESIGNS
    ]


CHECKED = "design_56x27cm"  # run that is a test
PASSES = 3


def passes() -> Case:
    """The tyre on the field snow of 220 kg/m3, several times in one rut."""
    text = snow.field_snow(220, title="field snow of 220 kg/m3")
    variables: dict[str, Value] = {
        **{name: BASE[name] for name in ("speed", "settle", "accelerate", "width", "fine_width")},
        **{name: BASE[name] for name in ("damping", "particles", "friction")},
        **tyre(),
        "material": f"{FOLDER}/material.yaml",
        "depth": 0.20,
        "cell": 0.20 / DESIGN_CELLS,
        "length": 2.2,
        "centre": 0.5,
        "clearance_above": 0.4,
        "distance": 1.0,
        "passes": PASSES,
        "return": 0.3,
    }
    return script_case(
        "passes",
        HERE / "passes.lig",
        variables,
        what="the tyre, several times in one rut",
        stage="design",
        files={"material.yaml": text},
        time_limit=TIME_LIMIT,
        may_fail=True,
    )


def all_cases() -> dict[str, Case]:
    """Name -> case, in the order in which they are made."""
    made = predictions() + rows() + flowing_rows() + slopes() + spreading_rows()
    made += errors() + designs() + [passes()]
    return {case.name: case for case in made}
