# SPDX-License-Identifier: GPL-2.0-or-later
"""Steady means, fields under the wheel, a closed form, NRMM and the figure over depth.

What confined compression alone carries under the rigid wheel of [Shoop2001], in closed form.

A column of snow of height h0 below a cylinder of radius r that has sunk by z is compressed by
  w(x) = z - (r - sqrt(r^2 - x^2)),  eps = -ln(1 - w/h0),
and presses back with the oedometer's sigma1(eps). The wheel carries b times the integral of sigma1
over its contact: a rolling one over the front half, since the snow stays compressed behind it, a
standing one over both. Energy per metre is b times the integral of sigma1 dw from 0 to z.

What the snow bears by shear at the wheel's sides is not in it; at most it is that of a strip
footing on ground of cohesion c and friction angle phi that cannot be compressed (Prandtl), Nc c
over the contact's area, with tan(beta) = sqrt(3) sin(phi) and d = sqrt(3) c cos(phi) ([Shoop2001]
eq 19, 20). Snow that flows aside carries less than confined compression: both together bound the sinkage from
below.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse import empirical
from furrow_post.analyse.displacement import displacements
from furrow_post.analyse.evaluations import steady_columns
from furrow_post.analyse.rut import rut_densities, share_left
from furrow_post.analyse.statistics import place_of_greatest
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.figures.style import save
from furrow_post.read.results import Results
from furrow_post.read.terrain import Outline, Terrain, TerrainStress
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

MEASURED = Path(__file__).resolve().parents[1] / "snow_wheel" / "reference.csv"
NRMM_DENSITIES = (200.0, 240.0)  # [kg/m3]; the report finds its model at the second
PRESSURE = 179e3  # [Pa]
DEPTHS = (0.20, 0.30, 0.40, 0.50)  # [m]
WINDOWS = {"depth": 5.6}  # [m] of travel of a stage: 2.5 to 5 s, as the report's
WINDOW = 0.5  # [m] of the others
SERIES = (  # names of runs, look, words of the figure
    ("depth_*_zero_d30", "o-", "d 30 kPa, zero slip"),
    ("depth_*_free_d30", "^", "d 30 kPa, free"),
    ("d_5", "s", "d 5 kPa, zero slip"),
)
# run -> the run that it differs from in one thing
IN_BOTH_CELLS = {  # of 5 cm, and of 10 cm, whose names end with COARSE
    "absorbing_5": "d_5",
    "absorbing_30": "d_30",
    "slide_d5": "d_5",
    "slide_d30": "d_30",
    "d_30_impulse": "d_30",
    **{f"friction_{name}_d5": "d_5" for name in ("0.1", "0.8", "rough")},
    **{f"friction_{name}": "d_30" for name in ("0.1", "0.8", "rough")},
}
COARSE = "_cell_10"
EFFECTS = {
    "soft": "base",
    "stiff": "base",
    f"soft{COARSE}": "cell_10",
    "impulse": "base",
    f"impulse{COARSE}": "cell_10",
    "slip_free_impulse": "slip_free",
    "slip_free_d5_impulse": "slip_free_d5",
    **{f"{run}{end}": f"{base}{end}" for run, base in IN_BOTH_CELLS.items() for end in ("", COARSE)},
}
FIELDS = (  # runs whose ground is looked into
    *("d_5", "d_10", "d_20", "d_30", f"d_5{COARSE}", f"d_30{COARSE}"),
    *("times_2_d20", "times_4_d10", "times_8_d10"),
)

Row = dict[str, Any]

# ---- the closed form

LOAD = 636 * 9.80665  # [N]
RADIUS, WIDTH, DEPTH = 0.37, 0.272, 0.20  # [m]
# [Shoop2001] Table 3 as fresh_snow_shoop.yaml has it, beta 22.53 degrees: p_b [Pa] at eps
STRENGTH = (113.76, 5e4, 1e5, 2e5, 5e5, 1e6, 2e6, 2.8e6)
STRAIN = (0.0, 0.6419, 0.7178, 0.8544, 0.9933, 1.1314, 1.3481, 1.5041)
TAN_BETA = math.tan(math.radians(22.53))
PHI = math.asin(TAN_BETA / math.sqrt(3))
NC = (math.exp(math.pi * math.tan(PHI)) * math.tan(math.pi / 4 + PHI / 2) ** 2 - 1) / math.tan(PHI)
POINTS = 2001
STRENGTHS = (5e3, 10e3, 20e3, 30e3, 72e3)  # d [Pa]


def axial_stress(strain: Floats, d: float) -> Floats:
    """sigma1 [Pa] in confined compression, at the corner of shear line and cap (R near 0)."""
    strength: Floats = np.interp(strain, STRAIN, STRENGTH)
    stress: Floats = strength + 2 / 3 * (d + strength * TAN_BETA)
    return stress


def carried(sinkage: float, d: float, sides: int) -> float:
    """[N] by confined compression, over one (rolling) or both (standing) sides of the axle."""
    half_length = math.sqrt(2 * RADIUS * sinkage - sinkage**2)
    x = np.linspace(0, half_length, POINTS)
    compression = sinkage - (RADIUS - np.sqrt(RADIUS**2 - x**2))
    stress = axial_stress(-np.log1p(-np.maximum(compression, 0.0) / DEPTH), d)
    return float(sides * WIDTH * np.trapz(stress, x))


def sunk(d: float, sides: int, footing: bool) -> float:
    """Sinkage [m] that carries the load; footing: with the bearing capacity of the cohesion."""
    low, high = 1e-4, 0.78 * DEPTH
    for _ in range(50):
        z = 0.5 * (low + high)
        area = sides * WIDTH * math.sqrt(2 * RADIUS * z - z**2)
        shear = NC * d / (math.sqrt(3) * math.cos(PHI)) * area if footing else 0.0
        low, high = (z, high) if carried(z, d, sides) + shear < LOAD else (low, z)
    return 0.5 * (low + high)


def resistance(sinkage: float, d: float) -> float:
    """Work of confined compression per metre over the load."""
    w = np.linspace(0, sinkage, POINTS)
    return float(WIDTH * np.trapz(axial_stress(-np.log1p(-w / DEPTH), d), w)) / LOAD


def closed_form_table() -> list[dict[str, float]]:
    """For each d: share of the load that confined compression carries at 8 cm, the sinkage of the
    rolling and of the standing wheel by it alone, with the footing, and the resistance."""
    found = []
    for d in STRENGTHS:
        alone = sunk(d, 1, False)
        found.append(
            {
                "d_kPa": 1e-3 * d,
                "carried_at_8cm": round(carried(0.08, d, 1) / LOAD, 3),
                "rolling_m": round(alone, 4),
                "resistance": round(resistance(alone, d), 4),
                "rolling_with_footing_m": round(sunk(d, 1, True), 4),
                "standing_m": round(sunk(d, 2, False), 4),
                "standing_with_footing_m": round(sunk(d, 2, True), 4),
            }
        )
    return found


# ---- fields: what Figs 65 to 67 draw

GREATEST = 10  # particles of a layer, of both halves, whose mean place is that of the greatest
WITHIN = 0.3  # [m] to both sides of the axle that are looked at


def numbers(folder: Path) -> dict[str, Any]:
    """Densities [kg/m3]; displacements [cm] where the finished rut is; where the deviatoric stress
    q is greatest in the middle plane, ahead of the axle [cm], just below the wheel and at the
    base."""
    terrain, stress = Terrain.read(folder), TerrainStress.read(folder)
    body = Outline(folder, terrain)
    densities, moved = rut_densities(terrain, body), displacements(terrain, body)
    assert body.surface
    x, z = terrain.x[:, 0] - body.centre[0], terrain.x[:, 2]
    near = (np.abs(terrain.x[:, 1]) < terrain.spacing) & (np.abs(x) < WITHIN)
    near &= z < body.surface.x[:, 2].min()
    layers = terrain.levels(near)
    upper, base = (
        near & terrain.at_level(layer) for layer in (layers[len(layers) // 2], layers[0])
    )
    return {
        "density_under": round(densities.under),
        "density_greatest": round(densities.greatest_under),
        "density_shoulder": round(densities.shoulder),
        "mass_left": round(share_left(terrain, body), 2),
        **{f"{name}_cm": round(100 * value, 1) for name, value in vars(moved).items()},
        "q_kPa": round(float(stress.mises[near].max()) / 1e3),
        **{
            f"q_{name}_ahead_cm": round(
                100 * place_of_greatest(x[layer], stress.mises[layer], GREATEST), 1
            )
            for name, layer in (("middle", upper), ("base", base))
        },
    }


# ---- runs


def row_of(run: Run) -> Row:
    """Sinkage of the standing wheel; means over the window of rolling, and half the difference
    between its halves. A failed run has its error alone."""
    row: Row = {
        "run": run.name,
        "stage": run.case.stage,
        "what": run.what,
        "user_s": run.seconds,
        "failure": run.error,
        "depth_m": run.case.variables["depth"],
        "cell_m": run.case.variables["cell"],
    }
    if run.error:
        return row
    wheel = Results(run.folder).columns
    standing = wheel["time"] <= run.number("settle")
    row["standing_m"] = round(float(wheel["hub_drop"][standing][-1]), 4)
    return {**row, **steady_columns(wheel, WINDOWS.get(run.case.stage, WINDOW))}


def nrmm(depth: float, density: float) -> tuple[float, float]:
    """Sinkage [m] and resistance coefficient of the formula for this wheel."""
    z = empirical.nrmm_sinkage(depth, density, PRESSURE)
    resistance = empirical.nrmm_resistance(density, WIDTH, RADIUS, z)
    return z, resistance / LOAD


def draw_depths(rows: Sequence[Row], path: Path) -> None:
    """Sinkage and resistance over depth: computed, measured, NRMM."""
    measured = read_numbers(MEASURED)
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.6), constrained_layout=True)
    depths = np.linspace(0.12, 0.52, 101)
    for axes, what, title in (
        (panels[0], "sinkage_m", "sinkage [m]"),
        (panels[1], "resistance", "resistance over load"),
    ):
        column = 0 if what == "sinkage_m" else 1
        axes.plot(
            [r["depth_m"] for r in measured],
            [r[what] for r in measured],
            ".",
            color="0.3",
            label="measured, a tyre, 110 to 220 kg/m3",
        )
        for density, style in zip(NRMM_DENSITIES, ("-", "--")):
            values = [nrmm(depth, density)[column] for depth in depths]
            axes.plot(depths, values, style, color="0.5", label=f"NRMM, {density:.0f} kg/m3")
        for pattern, mark, label in SERIES:
            mine = [r for r in rows if fnmatch(r["run"], pattern) and not r["failure"]]
            axes.plot([r["depth_m"] for r in mine], [r[what] for r in mine], mark, label=label)
        axes.set(xlabel="depth of the snow [m]", ylabel=title, ylim=(0, None))
        axes.grid(alpha=0.3)
    panels[0].plot(0.20, 0.08, "k*", ms=11, label="the report's own wheel, about 8 cm")
    panels[0].legend(frameon=False, fontsize=8)
    save(figure, path, dpi=90)


def effects(rows: Sequence[Mapping[str, Any]]) -> list[Row]:
    """How far sinkage and resistance move with absorbing faces, with friction [%], and the error of
    their averages over time."""
    found = {row["run"]: row for row in rows if not row["failure"]}
    return [
        {"run": run, "of": base, **_change(found[run], found[base])}
        for run, base in EFFECTS.items()
        if run in found and base in found
    ]


def _change(run: Mapping[str, Any], base: Mapping[str, Any]) -> Row:
    change: Row = {}
    for quantity, key, error in (
        ("sinkage", "sinkage_m", "sinkage_change_m"),
        ("resistance", "resistance", "resistance_change"),
    ):
        ratio = float(run[key]) / float(base[key])
        parts = (float(row[error]) / float(row[key]) for row in (run, base))
        change[f"{quantity}_percent"] = round(abs(100 * (ratio - 1)), 1)
        change[f"{quantity}_percent_time"] = round(abs(100 * ratio) * math.hypot(*parts), 1)
    return change


def nrmm_table() -> Iterator[Row]:
    for density in NRMM_DENSITIES:
        for depth in DEPTHS:
            z, c = (round(value, 3) for value in nrmm(depth, density))
            yield {"density_kgm3": density, "depth_m": depth, "sinkage_m": z, "resistance": c}


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    rows = [row_of(run) for run in runs.ended("*")]
    output.table("results.csv", rows)
    output.table("effects.csv", effects(output.known("results.csv", rows)))
    output.table("closed_form.csv", closed_form_table())
    output.table("nrmm.csv", list(nrmm_table()))
    ground = [{"run": run.name, "what": run.what, **numbers(run.folder)} for run in runs.done(*FIELDS)]
    output.table("fields.csv", ground)
    draw_depths(rows, output.path("depth.png"))
    return []
