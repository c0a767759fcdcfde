# SPDX-License-Identifier: GPL-2.0-or-later
"""A mobility map: what a wheel can do on each cell of a raster, as GeoTIFF, picture and table."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas
from matplotlib.colors import BoundaryNorm, ListedColormap

from ..arrays import Booleans, Floats
from ..csv_table import in_cells, read_numbers, write_rows
from ..errors import ResultsError
from ..figures.style import annotate_panel, panel_letters, save, use_style
from .mobility import UNITS, Vehicle, evaluate, inside_ranges, mobility_of, tabulate
from .model import Surrogate
from .raster import Raster, write_geotiff

NO_GO, UNCERTAIN, GO = 0.0, 1.0, 2.0
PIXELS = 700  # of a panel, at most
SLOPES = np.arange(0.0, 46.0, 1.0)  # [degrees] of the table for other programs
Ground = dict[str, Floats]


@dataclass(frozen=True)
class Map:
    """Rows and columns as in the elevation model; NaN: outside of the training ranges or no data."""

    verdict: Floats  # NO_GO, UNCERTAIN, GO
    bands: Mapping[str, tuple[Floats, str]]
    notes: tuple[str, ...]


def make_map(
    surrogate: Surrogate,
    vehicle: Vehicle,
    slope: Raster,
    rasters: Mapping[str, Floats],
    fixed: Sequence[tuple[Booleans | None, Mapping[str, float]]],
    confidence: float,
) -> Map:
    """rasters: parameter -> values; fixed: cells (None: all) and the parameters that they share"""
    shape = slope.values.shape
    found = {name: np.full(shape, np.nan) for name in UNITS}
    notes: list[str] = []
    outside = 0
    for cells, constants in fixed:
        ground = {"slope": slope.values, **rasters}
        known = np.all([np.isfinite(values) for values in ground.values()], axis=0)
        if cells is not None:
            known &= cells
        usable = known & inside_ranges(surrogate, vehicle, ground)
        outside += int(known.sum() - usable.sum())
        if not usable.any():
            continue
        here: Ground = {name: values[usable] for name, values in ground.items()}
        here |= {name: np.full_like(here["slope"], value) for name, value in constants.items()}
        table = tabulate(surrogate, vehicle, here)
        result = mobility_of(table.at(here), vehicle, here["slope"])
        for name, values in result.items():
            found[name][usable] = values
        notes.append(
            f"table of {table.nodes} nodes over {', '.join(table.axes)}: rms error "
            f"{table.errors['best']:.2g} standard deviations of the pull, energy {100 * table.errors['energy']:.2g} %"
        )
    if outside:
        notes.append(
            f"{outside} of {slope.values.size} cells lie outside of the training ranges: no data"
        )
    chance = found["probability"]
    cases = {np.nan: np.isnan(chance), GO: chance >= confidence, NO_GO: chance <= 1 - confidence}
    verdict = np.select(list(cases.values()), list(cases), UNCERTAIN)
    bands = {"verdict": (verdict, ""), **{name: (found[name], unit) for name, unit in UNITS.items()}}
    return Map(verdict, bands, tuple(notes))


def read_classes(file: Path, names: Sequence[str]) -> dict[int, dict[str, float]]:
    """Soil class -> parameters, of a CSV with the columns class and names. @raises ResultsError"""
    rows = read_numbers(file)
    absent = [name for name in ("class", *names) if not rows or name not in rows[0]]
    if absent:
        raise ResultsError(
            f"{file}: has no column {', '.join(absent)}; a row per class has its soil parameters"
        )
    return {int(row["class"]): {name: row[name] for name in names} for row in rows}


def write_map(result: Map, like: Raster, folder: Path) -> list[str]:
    """@return names of the files"""
    folder.mkdir(parents=True, exist_ok=True)
    write_geotiff(folder / "map.tif", like, result.bands, result.notes)
    draw_map(result, like, folder / "map.png")
    return ["map.tif", "map.png"]


def draw_map(result: Map, like: Raster, target: Path) -> None:
    use_style()
    figure, panels = plt.subplots(
        2, 2, figsize=(10, 8), layout="constrained", sharex=True, sharey=True
    )
    rows, columns = like.values.shape
    step = max(1, -(-max(rows, columns) // PIXELS))
    x0, dx, _, y0, _, dy = like.transform
    extent = np.array([x0, x0 + columns * dx, y0 + rows * dy, y0]) / 1e3
    colours = ListedColormap(["#a3264f", "#f0b55e", "#4d8a4a"])
    shown = {
        "verdict": ("go, uncertain, no-go", colours),
        "pull": ("drawbar pull that remains [N]", "viridis"),
        "energy": ("energy per distance [J/m]", "magma_r"),
        "probability": ("probability of go", "RdYlGn"),
    }
    for axes, letter, (name, (title, colour)) in zip(panels.flat, panel_letters(), shown.items()):
        values, _ = result.bands[name]
        norm = BoundaryNorm([-0.5, 0.5, 1.5, 2.5], 3) if colour is colours else None
        axes.set_facecolor("0.85")
        image = axes.imshow(
            values[::step, ::step], extent=extent, cmap=colour, norm=norm, interpolation="nearest"
        )
        bar = figure.colorbar(image, ax=axes, shrink=0.8)
        if norm:
            bar.set_ticks([0, 1, 2], labels=["no-go", "uncertain", "go"])
        annotate_panel(axes, letter, title)
        axes.set_aspect("equal")
    for axes in panels[1]:
        axes.set_xlabel("east [km]")
    for axes in panels[:, 0]:
        axes.set_ylabel("north [km]")
    save(figure, target)


def write_mobility_table(
    file: Path, surrogate: Surrogate, vehicle: Vehicle, soils: Mapping[str, Mapping[str, float]]
) -> int:
    """A row per soil and slope, for tools that read speed, go and pull by soil and slope. @return rows"""
    inside = SLOPES[inside_ranges(surrogate, vehicle, {"slope": SLOPES})]
    tables = []
    for soil, parameters in soils.items() if len(inside) else ():
        constants = {name: np.full(len(inside), value) for name, value in parameters.items()}
        fields = evaluate(surrogate, vehicle, {"slope": inside, **constants})
        result = mobility_of(fields, vehicle, inside)
        columns = {
            **constants,
            "slope_percent": 100 * np.tan(np.radians(inside)),
            "slope_degrees": inside,
            "traction_coefficient": fields["best"],
            "traction_deviation": fields["deviation"],
            "go_probability": result["probability"],
            "pull_N": result["pull"],
            "speed_m_per_s": result["speed"],
            "energy_J_per_m": result["energy"],
            "slip": result["slip"],
            "hub_drop_m": result["hub_drop"],
        }
        tables.append(pandas.DataFrame({"soil": soil, **columns}))
    rows = [in_cells(row, 6) for table in tables for row in table.to_dict("records")]
    comments = (
        f"# Mobility of one wheel of {vehicle.load:g} N at {vehicle.speed:g} m/s by a surrogate of Furrow.",
        "# traction_coefficient: largest drawbar pull over load, with its standard deviation; pull: that remains",
        "# on the slope; empty: the wheel does not climb. SI units, slope in per cent and degrees.",
    )
    write_rows(file, rows, comments)
    return len(rows)
