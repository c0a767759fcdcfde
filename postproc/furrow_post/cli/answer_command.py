# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post answer: pull, resistance and rut of a tyre on soil, from its size and a cone index."""

from pathlib import Path
from typing import NamedTuple

from ..laws.cone_formulas import Formulas, Tyre, formulas_for
from ..laws.tyre_estimate import Catalogue
from ..laws.tyre_fit import PlateTest, fit_tyre, press
from ..laws.tyre_size import is_radial, read_size
from ..uncertainty.whole_error import budgets_of
from ..csv_table import write_rows
from ..arguments import between, fraction, inflation, path, positive, seconds
from ..programs import results_folder
from ..run.summary import Summary
from ..soil.make import from_cone
from ..soil.material import find_ground
from .parameters import Given, argument, command, flag, option
from .run_commands import post

SCENE = "tyre_on_soil"
RESULTS = "answer"  # name of the default results folder
TABLE = "answer.csv"  # values and formulas, in the results
SAND, CLAY = "sand", "clay"
CLASS = "SP"  # of the sand between the classes of the USCS: clean, of one size
LOOSE_BELOW = 85e3  # [Pa] sand has 33 degrees, midway between contact/sand.yaml (28) and firm_sand.yaml (38)
INDEX_OVER_STRENGTH = 12.5  # cone index over undrained strength; 9 to 15 are measured
USUAL_SLIP = 0.2  # of the driven columns of the formulas next to a towed tyre
STIFFNESS = 150.0  # Young's modulus over strength; 50 to 500 are measured
ADHESION = 0.9  # of rubber, over strength; 0.5 to 1 are measured, 0.3 to 0.6 with a film of water
# Quantity of the run -> that of the formulas when towed, and when driven
COMPARED = {
    "resistance_coefficient": ("towed_resistance", ""),
    "net_traction_coefficient": ("", "net"),
    "rut_depth": ("towed_sinkage", "sinkage"),
}


def default_folder() -> Path:
    """Results folder of a command without --output."""
    return results_folder(RESULTS)


@command(
    argument("size", "of the tyre: 265/70R17, 31x10.50R15, 16.00R20, 18.4R38, ..."),
    option("--load", parse=positive, required=True, help="of the wheel [N]"),
    option("--pressure", parse=inflation, required=True, help="inflation [kPa]"),
    option("--soil", choices=(SAND, CLAY), required=True, help="dry sand, or clay without drainage"),
    option("--cone-index", parse=between(20.0, 5000.0), required=True, help="mean of the first 15 cm [kPa]"),
    option("--slip", parse=between(-1.0, 0.9), help="of a driven wheel, 1 - v/(r omega); towed without it"),
    option("--error", parse=fraction, metavar="PERCENT", help="wanted whole error of hub drop and coefficient, e.g. 10%"),
    option("--time", parse=seconds, metavar="TIME", help="the least error within this time of one core, e.g. 10min"),
    option("-o", "--output", "folder", parse=path, help=f"by default results/{RESULTS}"),
    flag("--quick", help="a small, coarse run, done within a minute"),
)
def answer(given: Given) -> int:
    folder: Path = given.folder or default_folder()
    folder.mkdir(parents=True, exist_ok=True)
    tyre_file, soil_file, run = folder / "tyre.yaml", folder / "soil.yaml", folder / "run"
    made_by = f"furrow-post answer {given.size} --pressure {given.pressure:g}"
    estimated = estimate_tyre(given.size, given.load, given.pressure, made_by)
    tyre_file.write_text(estimated.text, encoding="utf-8")
    soil_file.write_text(_soil(given), encoding="utf-8")
    print(f"{given.size}: {tyre_file}, estimated from its size\n{given.soil}: {soil_file}, estimated from its cone index", flush=True)
    motion = "mode towed" if given.slip is None else f"mode slip slip {given.slip:g}"
    values = {"tyre": tyre_file.resolve(), "material": soil_file.resolve(), "radius": f"{estimated.radius:.4f}",
              "pressure": f"{1e3 * given.pressure:g}", "load": f"{given.load:g}", "motion": motion}
    words = [word for name, value in values.items() for word in ("-v", name, value)]
    for name in ("error", "time"):
        if (wanted := getattr(given, name)) is not None:
            words += [f"--{name}", f"{100 * wanted:g}%" if name == "error" else f"{wanted:g}s"]
    words += ["--quick"] if given.quick else []
    status = post("run", SCENE, "-o", run, *words)
    if status == 0:
        formulas = formulas_for(given.soil, 1e3 * given.cone_index, estimated.tyre, given.slip or USUAL_SLIP)
        rows = compared(run, formulas, given.slip is None)
        write_rows(folder / TABLE, [row._asdict() for row in rows])
        print("\n".join(["", "Formulas of this cone index", formulas.report(), "", *(row.sentence() for row in rows)]))
    return status


class EstimatedTyre(NamedTuple):
    """Text of a tyre file, radius of the belt, which meets the ground [m], and the tyre of the formulas."""

    text: str
    radius: float
    tyre: Tyre


def estimate_tyre(text: str, load: float, pressure: float, command: str) -> EstimatedTyre:
    """The tyre of a size designation under a load [N], at an inflation [kPa]. command: that the file names."""
    size = read_size(text)
    fit = fit_tyre(Catalogue(size, 1e3 * pressure), [])
    file_text = fit.file_text(size.designation, [command])
    (state,) = press(file_text, [PlateTest(pressure, load, {})])
    tyre = Tyre(load, size.diameter, size.width, size.height, 1e-2 * state["deflection_cm"], radial=is_radial(text))
    return EstimatedTyre(file_text, fit.values()["belt_radius"], tyre)


def _soil(given: Given) -> str:
    """Text of a material file with this cone index."""
    index = 1e3 * given.cone_index
    title = f"{given.soil.capitalize()} of cone index {given.cone_index:g} kPa"
    clay = find_ground("clay_medium")
    if given.soil == SAND:
        contact = clay.parent / "contact" / ("sand.yaml" if index < LOOSE_BELOW else "firm_sand.yaml")
        return f"{from_cone(title, index, CLASS, None).text()}cone_index: {index:g}\ncontact: {contact}\n"
    strength = index / INDEX_OVER_STRENGTH
    return (
        f"title: {title}\n"
        f"# Strength: cone index over {INDEX_OVER_STRENGTH:g}. Modulus: {STIFFNESS:g} times the strength.\n"
        f"base: {clay}\ncone_index: {index:g}\n"
        f"law: {{su: {strength:g}}}\nelasticity: {{E: {STIFFNESS * strength:g}}}\n"
        "contact:\n  rubber:\n    friction: 1\n    friction_range: [0.5, 1.5]\n    slip_length: 0.006\n"
        f"    slip_length_range: [0.003, 0.009]\n    shear_limit: {ADHESION * strength:g}\n"
        f"    shear_limit_range: [{0.5 * strength:g}, {strength:g}]\n"
        f"    label: assumed\n    source: adhesion {ADHESION:g} of the strength\n"
    )


class Compared(NamedTuple):
    """Value of a run with its whole error, and mean and band of the formulas."""

    quantity: str
    value: float
    error: float
    mean: float  # of the formulas
    least: float
    greatest: float
    unknown: str  # parts of the error

    def sentence(self) -> str:
        """Sentence on a value: inside the band, or the number of errors outside."""
        known = f"formulas {self.least:.3g} to {self.greatest:.3g}" if self.least < self.greatest else f"formula {self.least:.3g}, of unknown scatter"
        apart = max(self.least - self.value, self.value - self.greatest, 0.0) / self.error if self.error > 0.0 else 0.0
        lacks = f" ({self.unknown})" if self.unknown else ""
        return f"{self.quantity.replace('_', ' ')} {self.value:.3g} ± {self.error:.2g}{lacks}; {known}: {_place(apart)}"


def compared(run: Path, formulas: Formulas, towed: bool) -> list[Compared]:
    """Values of the run of which the formulas speak."""
    found, errors = Summary(run).quantities, budgets_of(run)
    rows = []
    for name, of_formulas in COMPARED.items():
        quantity = of_formulas[0 if towed else 1]
        if name in found and quantity and (band := formulas.band(quantity)):
            error = errors[name]
            rows.append(Compared(name, float(found[name]["mean"]), error.total, *band, error.missing_text()))
    return rows


def _place(apart: float) -> str:
    """apart: distance from the band over the error."""
    return "inside" if apart == 0.0 else f"{'OUTSIDE' if apart > 2.0 else 'outside'} by {apart:.1f} errors"
