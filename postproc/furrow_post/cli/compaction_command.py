# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post compaction: stress and density at depth below the track, with formulas."""


import numpy as np

from ..analyse.compaction import Compaction, read_compaction, report, write_compaction
from ..laws.half_space import ELASTIC, SOEHNE
from ..figures.compaction_figure import draw_compaction
from ..formatting import value_text
from ..csv_table import in_columns
from .comparing import beside_first, folders, folders_argument
from .parameters import Given, command, target_option

LINES = 8  # of the table on the screen


@command(
    folders_argument(),
    target_option("folder to write (default: compaction next to the first)"),
)
def compaction(given: Given) -> None:
    runs = [read_compaction(*item) for item in folders(given)]
    target = beside_first(given, "compaction")
    target.mkdir(parents=True, exist_ok=True)
    write_compaction(runs, target / "compaction.csv")
    draw_compaction(runs, target / "compaction.png")
    for one in runs:
        print("\n".join([*report(one), "", *in_columns(_table(one)), ""]))
    print(f"{target}/compaction.png, compaction.csv")


def _table(run: Compaction) -> list[list[str]]:
    """Some layers; stresses in kPa."""
    heads = ["depth [cm]", "vertical [kPa]", "mean [kPa]", "Boussinesq [kPa]"]
    rows = [[*heads, *(f"Söhne {factor:.0f} [kPa]" for factor in SOEHNE), "density [kg/m3]"]]
    count = len(run.layers)
    for k in np.unique(np.linspace(0, count - 1, min(LINES, count)).round().astype(int)):
        layer, contact = run.layers.iloc[k], run.contact
        z = np.array([layer.distance])
        pairs = [(layer.vertical_stress, layer.vertical_stress_error), (layer.mean_stress, layer.mean_stress_error)]
        pairs += [(contact.ellipse(z, factor)[0], contact.ellipse_error(z, factor)[0]) for factor in (ELASTIC, *SOEHNE)]
        stresses = [value_text(1e-3 * value, 1e-3 * error) for value, error in pairs]
        rows.append([f"{100 * layer.depth:.1f}", *stresses, value_text(layer.density, layer.density_error)])
    return rows
