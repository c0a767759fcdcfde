# SPDX-License-Identifier: GPL-2.0-or-later
"""One look for all figures."""

import matplotlib.pyplot as plt

CENTIMETRE = 100.0   # per metre
MILLIMETRE = 1000.0  # per metre


def use_style():
    plt.rcParams.update({
        "font.family": "DejaVu Sans",
        "font.size": 9,
        "axes.titlesize": 10,
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.linewidth": 0.8,
        "legend.frameon": False,
        "figure.facecolor": "white",
        "svg.fonttype": "none",
    })


def annotate_panel(axes, letter, text):
    axes.set_title(f"$\\mathbf{{{letter}}}$  {text}", color="0.15")


def save(figure, target, dpi=150):
    figure.savefig(target, dpi=dpi)
    plt.close(figure)
