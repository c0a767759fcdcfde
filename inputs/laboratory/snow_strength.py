#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Tensile and shear strength of snow against its density: clusters, the laws identified on them,
and measurements. Prints the table and draws the figure.

Clusters: records/*.csv, undisturbed and pressed snow; shear is that under the smallest normal
stress of the record. Laws: the same paths, by furrow-point. Measured: snow_strength_reference.csv.
"""

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from identify_snow import sections_of
from snow_paths import Points, predicted
from snow_record import Row, read_record

from furrow_post.arguments import path
from furrow_post.arrays import Floats
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, command, option
from furrow_post.csv_table import markdown, read_rows
from furrow_post.figures.style import KILOPASCAL, RUN_COLOURS, annotate_panel, save, use_style
from furrow_post.run.tools import Tools

GROUNDS = ("snow_bonded", "snow_bonded_slab")
KINDS = ("tension", "shear")
COMPACTIONS = np.linspace(0, 0.95, 14)  # of the laws' curves
DENSITIES = np.linspace(180, 500, 60)  # [kg/m3] of the measured curves


class Fit(NamedTuple):
    """A measured strength: a power of density."""

    snow: str
    source: str
    coefficient: float  # [Pa]
    reference: float  # [kg/m3]
    exponent: float

    def at(self, density: Floats | float) -> Floats | float:
        """[Pa]"""
        strength: Floats | float = self.coefficient * (density / self.reference) ** self.exponent
        return strength


class Strengths(NamedTuple):
    """Strengths of one kind [Pa], by density [kg/m3]."""

    density: Floats
    strength: Floats
    scatter: Floats


def measured(kind: str) -> list[Fit]:
    numbers = ("coefficient_Pa", "reference_kgm3", "exponent")
    rows = read_rows(HERE / "snow_strength_reference.csv")
    return [
        Fit(row["snow"], row["source"], *(float(row[name]) for name in numbers))
        for row in rows
        if row["quantity"] == kind
    ]


def of_clusters(record: Sequence[Row]) -> dict[str, Strengths]:
    """Tension and shear start from the same pressed and released snow: one density for both."""
    sheared = [row for row in record if row.test == "shear"]
    least = min(row.confinement for row in sheared)
    places = {
        (row.test, row.compaction, row.quantity): row
        for row in record
        if row.confinement in (0, least)
    }
    pressed = sorted({row.compaction for row in sheared})
    density = np.array([places["shear", c, "density"].value for c in pressed])
    found = {}
    for kind in KINDS:
        rows = [places[kind, c, "strength"] for c in pressed]
        strength, scatter = np.array([[row.value, row.scatter] for row in rows]).T
        found[kind] = Strengths(density, strength, scatter)
    return found


def of_law(ground: str, normal: float, points: Points) -> dict[str, Strengths]:
    """normal: stress [Pa] that shear is under"""
    sections = sections_of(PROJECT / "inputs" / "materials" / "variants" / f"{ground}_cam_clay.yaml")
    wanted = (
        ("tension", 0.0, "strength"),
        ("shear", normal, "strength"),
        ("shear", normal, "density"),
    )
    rows = [
        Row(test, float(compaction), confinement, 0.0, quantity, 0.0, 0.0, 1)
        for compaction in COMPACTIONS
        for test, confinement, quantity in wanted
    ]
    values = predicted(sections, rows, points)
    tension, shear, density = np.reshape([values[row.place] for row in rows], (-1, 3)).T
    nothing = 0 * density
    return {
        "tension": Strengths(density, tension, nothing),
        "shear": Strengths(density, shear, nothing),
    }


def table(clusters: dict[str, dict[str, Strengths]], laws: dict[str, dict[str, Strengths]]) -> str:
    """Table of strengths [kPa] in Markdown."""
    lines = []
    for kind in KINDS:
        fits = measured(kind)
        for ground, found in clusters.items():
            law = laws[ground][kind]
            for density, strength, scatter in zip(*found[kind]):
                by_law = np.interp(density, law.density, law.strength)
                values = [strength, scatter, by_law, *(float(fit.at(density)) for fit in fits)]
                kilopascals = [f"{KILOPASCAL * value:.2g}" for value in values]
                own = " ± ".join(kilopascals[:2])
                measurements = "; ".join(kilopascals[3:])
                lines.append([kind, ground, f"{density:.0f}", own, kilopascals[2], measurements])
    return "\n".join(markdown(["", "", "kg/m3", "clusters", "law", "measured"], lines))


def draw_kind(
    axes: Axes,
    kind: str,
    clusters: dict[str, dict[str, Strengths]],
    laws: dict[str, dict[str, Strengths]],
) -> None:
    styles = ("-", "--", "-.", ":")
    for fit, style in zip(measured(kind), styles):
        label = f"measured: {fit.snow} [{fit.source}]"
        strength = KILOPASCAL * np.asarray(fit.at(DENSITIES))
        axes.semilogy(DENSITIES, strength, style, color="0.35", lw=1.2, label=label)
    for ground, colour in zip(GROUNDS, RUN_COLOURS):
        law, found = laws[ground][kind], clusters[ground][kind]
        label = f"Cam clay of {ground}"
        axes.semilogy(law.density, KILOPASCAL * law.strength, color=colour, lw=1.2, label=label)
        axes.errorbar(
            found.density,
            KILOPASCAL * found.strength,
            KILOPASCAL * found.scatter,
            fmt="o",
            ms=5,
            color=colour,
            label=f"clusters: {ground}",
        )
    name = "tensile" if kind == "tension" else kind
    axes.set(xlabel="density [kg/m³]", ylabel=f"{name} strength [kPa]")
    axes.legend(fontsize=7, loc="upper left")


@command(
    option("--build", parse=path, help="default: $FURROW_BUILD, or build in the tree"),
    option("-o", "--output", parse=path, default=HERE / "snow_strength.png", metavar="FIGURE", help="default: next to this program"),
    description=__doc__ or "",
)
def strength(given: Given) -> None:
    records = {ground: read_record(HERE / "records" / f"{ground}.csv") for ground in GROUNDS}
    clusters = {ground: of_clusters(record) for ground, record in records.items()}
    tools = Tools.of(Path(__file__), given.build)
    with tempfile.TemporaryDirectory() as name, Points(tools, Path(name)) as points:
        laws = {
            ground: of_law(ground, min(r.confinement for r in record if r.test == "shear"), points)
            for ground, record in records.items()
        }
    print(table(clusters, laws))
    use_style()
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained", sharey=True)
    for letter, kind, axes in zip("ab", KINDS, panels):
        draw_kind(axes, kind, clusters, laws)
        annotate_panel(axes, letter, "tension" if kind == "tension" else "shear under 0.1 kPa")
    save(figure, given.output)


def main() -> int:
    return start(strength, "laboratory/snow_strength.py")


if __name__ == "__main__":
    sys.exit(main())
