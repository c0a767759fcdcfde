# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post fit soil: soil parameters from wheel tests, with what they cannot identify."""

from pathlib import Path

import numpy as np

from ..arguments import path
from ..csv_table import in_columns, write_rows
from ..formatting import in_unit
from ..surrogate.surrogate_figures import draw_posterior
from ..surrogate.model import read_surrogate
from ..surrogate.posterior import identify, read_tests
from .parameters import Given, argument, assignments, command, target_option

QUANTILES = (2.5, 50.0, 97.5)


@command(
    argument("surrogate", "file of furrow-post surrogate", path),
    argument("tests", "CSV: inputs, quantities and their errors of wheel tests on one soil", path),
    assignments("--set", "inputs that are known in all tests"),
    target_option("folder to write: posterior.csv, posterior.png", required=True),
)
def fit_soil(given: Given) -> None:
    surrogate = read_surrogate(given.surrogate)
    posterior = identify(surrogate, read_tests(given.tests, surrogate, dict(given.set)))
    rows = [["parameter", "median", "95 % interval", "width over prior"]]
    for name, samples, ratio in zip(posterior.names, posterior.samples.T, posterior.ratio):
        unit = surrogate.inputs[surrogate.names.index(name)].unit
        low, median, high = np.percentile(samples, QUANTILES)
        rows.append(
            [f"{name}{in_unit(unit)}", f"{median:.4g}", f"{low:.4g} to {high:.4g}", f"{ratio:.2f}"]
        )
    folder: Path = given.output
    folder.mkdir(parents=True, exist_ok=True)
    thinned = posterior.samples[:: max(1, len(posterior.samples) // 2000)]
    write_rows(
        folder / "posterior.csv",
        [dict(zip(posterior.names, map("{:.6g}".format, sample))) for sample in thinned],
        ("# Samples of the posterior of furrow-post fit soil, in the units of the surrogate.",),
    )
    draw_posterior(posterior, surrogate, folder / "posterior.png")
    print("\n".join([*in_columns(rows), "", *posterior.remarks(), f"R-hat {posterior.rhat:.3f}"]))
    print(f"\n{folder}: posterior.csv, posterior.png")
