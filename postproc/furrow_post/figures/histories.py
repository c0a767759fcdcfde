# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post plot: sinkage, forces, torque and slip against time."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

from .results import ResultsError
from .style import MILLIMETRE, save, use_style
from .summary import Summary, with_error

PHASES = ("settle", "accelerate", "cruise")
# title of the panel, unit, scale, channels with their legend, quantity of the summary
PANELS = (
    ("sinkage", "mm", MILLIMETRE, (("sinkage", "sinkage"),), "sinkage"),
    ("forces of the ground", "N", 1.0, (("force_z", "vertical"), ("force_x", "along the travel"), ("force_y", "lateral")), "force_z"),
    ("drawbar pull", "N", 1.0, (("drawbar_pull", "drawbar pull"),), "drawbar_pull"),
    ("axle torque", "N m", 1.0, (("drive_torque", "axle torque"),), "drive_torque"),
    ("slip", "%", 100.0, (("slip", "slip"),), "slip"),
)


def _shade_phases(axes, time, phase, label):
    """Light bands with the names of the rig's phases on top."""
    for number, name in enumerate(PHASES):
        rows = np.flatnonzero(phase == number)
        if len(rows) == 0:
            continue
        begin, end = time[rows[0]], time[rows[-1]]
        axes.axvspan(begin, end, color=("0.93", "0.97", "1.0")[number], lw=0, zorder=0)
        if label:
            axes.text(0.5 * (begin + end), 1.03, name, transform=axes.get_xaxis_transform(), ha="center", va="bottom", color="0.4")


def _mark_steady(axes, summary, name, scale):
    """The mean over the steady window with a band of one standard error; dashed where the value was not steady."""
    value, window = summary.quantity(name), summary.window
    if value is None or window is None:
        return
    mean, error = scale * value["mean"], scale * value["standard_error"]
    axes.fill_between(window, mean - error, mean + error, color="C3", alpha=0.25, lw=0, zorder=3)
    axes.plot(window, (mean, mean), color="C3", lw=1.6, ls="-" if value["steady"] else "--", zorder=4,
              label=f"mean {with_error(mean, error)}" + ("" if value["steady"] else " (not steady)"))


def _look_at_cruise(axes, scale, columns, phase):
    """Limits the axis where a short swing before the cruise (slip at the first motion) would flatten all the rest."""
    cruise = np.concatenate([column[phase == 2] for column in columns]) * scale
    if len(cruise) == 0:
        return
    low, high = min(cruise.min(), 0.0), max(cruise.max(), 0.0)
    room = 1.5 * (high - low)
    bottom, top = axes.get_ylim()
    if room > 0 and (bottom < low - room or top > high + room):
        axes.set_ylim(max(bottom, low - 0.4 * room), min(top, high + 0.4 * room))
        axes.text(0.005, 0.03, "swings before the cruise go beyond this axis", transform=axes.transAxes, fontsize=7, color="0.4")


def draw(results, target):
    """Draws the histories of a run to target."""
    use_style()
    summary = Summary(results.folder)
    missing = [name for panel in PANELS for name, _ in panel[3] if name not in results.columns]
    if "time" not in results.columns or missing:
        raise ResultsError(f"{results.file}: has no channel {', '.join(missing) or 'time'}; plot needs the history of a wheel on a rig")
    time = results.columns["time"]
    if len(time) == 0:
        raise ResultsError(f"{results.file}: the history has no rows yet")
    phase = results.columns.get("phase", np.full(len(time), 2.0))
    figure, panels = plt.subplots(len(PANELS), 1, figsize=(10, 12), sharex=True, layout="constrained")
    for axes, (title, unit, scale, channels, quantity) in zip(panels, PANELS):
        _shade_phases(axes, time, phase, axes is panels[0])
        for channel, legend in channels:
            axes.plot(time, scale * results.columns[channel], lw=0.8, alpha=0.85, label=legend)
        _mark_steady(axes, summary, quantity, scale)
        axes.set_ylabel(f"{title} [{unit}]")
        _look_at_cruise(axes, scale, [results.columns[channel] for channel, _ in channels], phase)
        axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
        axes.margins(x=0)
    panels[-1].set_xlabel("time [s]")
    figure.suptitle(f"{results.title}\n{summary.line()}" if summary.line() else results.title, fontsize=10)
    save(figure, target)
