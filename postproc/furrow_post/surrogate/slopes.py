# SPDX-License-Identifier: GPL-2.0-or-later
"""Slip and hub drop of a wheel over slope and load, with 95 % bands, as a table and a picture."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas

from ..arrays import Floats
from ..csv_table import in_cells, write_rows
from ..figures.style import MILLIMETRE, head_figure, label_panels, save, use_style
from .gaussian_process import Z_95
from .mobility import Vehicle, evaluate, inside_ranges, mobility_of
from .model import Surrogate
from .training import HUB_DROP, RADIUS


def slip_over_slope(
    surrogate: Surrogate, vehicle: Vehicle, slopes: Floats, soil: Mapping[str, float]
) -> pandas.DataFrame:
    """A row per slope [degrees] inside the training ranges.

    slip: where the pull reaches the need; NaN where it does not, or where the need is below the pull at the lowest
    slip. least, greatest: the same with the pull at the ends of its band. The band of the hub drop spans those slips.
    """
    ground = {"slope": slopes, **{name: np.full_like(slopes, value) for name, value in soil.items()}}
    known = inside_ranges(surrogate, vehicle, ground)
    if not known.any():
        return pandas.DataFrame()
    ground = {name: values[known] for name, values in ground.items()}
    tilt = ground["slope"]
    middle, least, greatest = (
        mobility_of(evaluate(surrogate, vehicle, ground, shift), vehicle, tilt) for shift in (0.0, Z_95, -Z_95)
    )
    lowest = surrogate.inputs[surrogate.names.index("slip")].low
    slip = np.where(middle["slip"] > lowest, middle["slip"], np.nan)
    drops = [_hub_drop(surrogate, vehicle, ground, at) for at in (slip, least["slip"], greatest["slip"])]
    return pandas.DataFrame(
        {
            **{name: ground[name] for name in soil},
            "slope_deg": tilt,
            "load_N": vehicle.load,
            "slip": slip,
            "least": least["slip"],
            "greatest": greatest["slip"],
            "probability": middle["probability"],
            "hub_drop_m": drops[0][0],
            "hub_drop_least_m": np.min([mean - Z_95 * deviation for mean, deviation in drops], axis=0),
            "hub_drop_greatest_m": np.max([mean + Z_95 * deviation for mean, deviation in drops], axis=0),
        }
    )


def _hub_drop(
    surrogate: Surrogate, vehicle: Vehicle, ground: Mapping[str, Floats], slip: Floats
) -> tuple[Floats, Floats]:
    """Mean and standard deviation at these slips; NaN where the slip is."""
    load = vehicle.load * np.cos(np.radians(ground["slope"])) if "slope" not in surrogate.names else vehicle.load
    known = np.isfinite(slip)
    x = surrogate.scaled({**ground, "load": load, "slip": np.where(known, slip, 0.0)})
    mean, deviation = surrogate.processes[HUB_DROP].predict(x)
    return np.where(known, mean, np.nan), np.where(known, deviation, np.nan)


def limits(curve: pandas.DataFrame, probabilities: Sequence[float]) -> list[str]:
    """Steepest slope of a curve up to which the wheel climbs with each probability; ">" where the curve ends first."""
    found = []
    for probability in probabilities:
        below = np.flatnonzero(curve["probability"] < probability)
        count = int(below[0]) if len(below) else len(curve)
        sign = "" if len(below) else ">"
        found.append(f"{sign}{curve['slope_deg'].iloc[count - 1]:.3g}" if count else "")
    return found


def write_slopes(curves: Sequence[pandas.DataFrame], surrogate: Surrogate, file: Path) -> None:
    end = surrogate.inputs[surrogate.names.index("slip")].high
    comments = (
        f"# Slip of one wheel over slope and load by a surrogate of Furrow. Slip is by the radius of {surrogate.constants[RADIUS]:.4g} m.",
        "# load_N: on level ground. least, greatest: slip at the ends of the 95 % band of the pull. probability: of climbing.",
        f"# Empty slip: no slip up to {end:.3g} gives the pull, so that the wheel digs in; or the lowest gives more than the need.",
    )
    write_rows(file, [in_cells(row, 5) for curve in curves for row in curve.to_dict("records")], comments)


def draw_slopes(curves: Sequence[pandas.DataFrame], surrogate: Surrogate, target: Path) -> None:
    """Draws slip and hub drop; a cross ends a curve at the steepest slope that the wheel climbs."""
    use_style()
    figure, (above, below) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained", sharex=True)
    one = surrogate.inputs[surrogate.names.index("slip")]
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(curves)))
    for curve, colour in zip(curves, colours):
        slope, label = curve["slope_deg"], f"{curve['load_N'].iloc[0]:.4g} N"
        above.plot(slope, curve["slip"], color=colour, label=label)
        # Where the wheel may dig in, no slip is the greatest
        above.fill_between(slope, curve["least"], curve["greatest"].fillna(one.high), color=colour, alpha=0.15, lw=0)
        below.plot(slope, MILLIMETRE * curve["hub_drop_m"], color=colour, label=label)
        ends = (MILLIMETRE * curve[f"hub_drop_{end}_m"] for end in ("least", "greatest"))
        below.fill_between(slope, *ends, color=colour, alpha=0.15, lw=0)
        last = curve["slip"].last_valid_index()
        if last is not None and last < len(curve) - 1:
            above.plot(slope[last], curve["slip"][last], "x", color=colour, ms=8, mew=2)
    above.set_ylim(top=one.high)
    above.set_ylabel(f"slip, by the radius of {surrogate.constants[RADIUS]:.4g} m")
    below.set_ylabel("hub drop [mm]")
    for axes in (above, below):
        axes.set_xlabel("slope [degrees]")
        axes.axhline(0.0, color="0.8", lw=0.6, zorder=0)
    label_panels((above, below), f"slip; ×: digs in beyond (no slip up to {one.high:.2g} suffices)", "hub drop; bands: 95 %")
    above.legend(title="load on the level", loc="upper left")
    save(figure, target)
