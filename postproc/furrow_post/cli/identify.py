# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post identify: soil parameters from wheel tests, with what they cannot identify."""

import argparse
from pathlib import Path

import numpy as np

from ..arguments import path
from ..csv_table import write_rows
from ..formatting import in_unit
from ..study.tables import in_columns
from ..surrogate.figures import draw_posterior
from ..surrogate.model import read_surrogate
from ..surrogate.posterior import identify, read_tests
from .output import add_assignments, add_target

QUANTILES = (2.5, 50.0, 97.5)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("surrogate", type=path, help="file of furrow-post surrogate")
    tests = "CSV: inputs, quantities and their errors of wheel tests on one soil"
    parser.add_argument("tests", type=path, help=tests)
    add_assignments(parser, "--set", "inputs that are known in all tests", default=[])
    add_target(parser, "folder to write: posterior.csv, posterior.png", required=True)


def run(arguments: argparse.Namespace) -> None:
    surrogate = read_surrogate(arguments.surrogate)
    posterior = identify(surrogate, read_tests(arguments.tests, surrogate, dict(arguments.set)))
    rows = [["parameter", "median", "95 % interval", "width over prior"]]
    for name, samples, ratio in zip(posterior.names, posterior.samples.T, posterior.ratio):
        unit = surrogate.inputs[surrogate.names.index(name)].unit
        low, median, high = np.percentile(samples, QUANTILES)
        rows.append(
            [f"{name}{in_unit(unit)}", f"{median:.4g}", f"{low:.4g} to {high:.4g}", f"{ratio:.2f}"]
        )
    folder: Path = arguments.output
    folder.mkdir(parents=True, exist_ok=True)
    thinned = posterior.samples[:: max(1, len(posterior.samples) // 2000)]
    write_rows(
        folder / "posterior.csv",
        [dict(zip(posterior.names, map("{:.6g}".format, sample))) for sample in thinned],
        ("# Samples of the posterior of furrow-post identify, in the units of the surrogate.",),
    )
    draw_posterior(posterior, surrogate, folder / "posterior.png")
    print("\n".join([*in_columns(rows), "", *posterior.remarks(), f"R-hat {posterior.rhat:.3f}"]))
    print(f"\n{folder}: posterior.csv, posterior.png")
