# SPDX-License-Identifier: GPL-2.0-or-later
"""A surrogate: Gaussian processes of a wheel's answers over the inputs of a sweep, and its JSON file."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import __version__
from ..arrays import Booleans, Floats
from ..errors import ResultsError, content_of
from ..json_text import parse_json
from .gaussian_process import HeldOut, Process, fit_process, require_calibrated
from .training import QUANTITIES, Training, require_alike
from .two_fidelities import Corrected, Gain, correct

FORMAT, CORRECTED = "furrow surrogate 1", "furrow surrogate 2"  # 2: some process is corrected by better runs
LINEAR, LOGARITHMIC = "linear", "logarithmic"
DECADE = 10.0  # inputs that span more are scaled by their logarithm


@dataclass(frozen=True)
class Input:
    """An input with its training range."""

    name: str
    unit: str
    low: float
    high: float
    scale: str = LINEAR

    @property
    def logarithmic(self) -> bool:
        return self.scale == LOGARITHMIC

    def scaled(self, values: Floats) -> Floats:
        """Values scaled from the range to [0, 1]."""
        low, high = self.low, self.high
        if self.logarithmic:
            values, low, high = np.log(values), math.log(low), math.log(high)
        return (values - low) / (high - low)

    def physical(self, scaled: Floats) -> Floats:
        if self.logarithmic:
            physical: Floats = self.low * (self.high / self.low) ** scaled
            return physical
        return self.low + scaled * (self.high - self.low)


@dataclass(frozen=True)
class Surrogate:
    inputs: tuple[Input, ...]
    processes: Mapping[str, Process | Corrected]  # by quantity
    checks: Mapping[str, Mapping[str, float]]  # by quantity: rms_error, coverage
    constants: Mapping[str, float]
    origin: Mapping[str, str]

    @property
    def names(self) -> list[str]:
        return [one.name for one in self.inputs]

    def scaled(self, values: Mapping[str, Floats | float]) -> Floats:
        """(..., inputs) in [0, 1] inside the training ranges, of all inputs by name."""
        columns = [one.scaled(np.asarray(values[one.name], float)) for one in self.inputs]
        return np.stack(np.broadcast_arrays(*columns), -1)

    def inside(self, name: str, values: Floats) -> Booleans:
        """True where values of an input lie in its training range, but for rounding."""
        one = self.inputs[self.names.index(name)]
        slack = 1e-6 * (one.high - one.low)
        found: Booleans = (values >= one.low - slack) & (values <= one.high + slack)
        return found

    def require(self, values: Mapping[str, Floats | float]) -> None:
        """@raises ResultsError for other names than the inputs, or values outside of their ranges"""
        for name in values:
            if name not in self.names:
                raise ResultsError(
                    f"the surrogate has no input '{name}'; it has {', '.join(self.names)}"
                )
        for one in self.inputs:
            if one.name not in values:
                raise ResultsError(f"the surrogate needs a value of '{one.name}' ({_range(one)})")
            self.require_range(one.name, values[one.name])

    def require_range(self, name: str, values: Floats | float) -> None:
        """@raises ResultsError for values of an input outside of its training range"""
        given = np.asarray(values, float).ravel()
        outside = given[~self.inside(name, given)]
        if len(outside):
            one = self.inputs[self.names.index(name)]
            raise ResultsError(
                f"{name}: {outside[0]:g} lies outside of the training range ({_range(one)}); a "
                "surrogate does not extrapolate. Add runs there, or stay inside"
            )

    def write(self, file: Path) -> None:
        first = next(iter(self.processes.values()))
        fast, better = (first.fast, first.delta) if isinstance(first, Corrected) else (first, None)
        quantities: dict[str, dict[str, Any]] = {
            name: {"unit": QUANTITIES[name], **self.checks[name], **_content(process)}
            for name, process in self.processes.items()
        }
        content = {
            "format": CORRECTED if better else FORMAT,
            **self.origin,
            "constants": dict(self.constants),
            "inputs": [
                {
                    **asdict(one),
                    "values": one.physical(fast.x[:, k]).tolist(),
                    **({"better": one.physical(better.x[:, k]).tolist()} if better else {}),
                }
                for k, one in enumerate(self.inputs)
            ],
            "kernel": "Matern 5/2 of scaled inputs, of (value - mean)/deviation of the training values",
            "quantities": quantities,
        }
        file.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def _content(process: Process | Corrected) -> dict[str, Any]:
    if isinstance(process, Corrected):
        correction: dict[str, Any] = {"rho": process.rho, "widening": process.factor, **_content(process.delta)}
        return {**_content(process.fast), "correction": correction}
    return {
        "factor": process.factor,
        "signal": process.signal,
        "noise": process.noise,
        "lengths": process.lengths.tolist(),
        "values": process.y.tolist(),
    }


def _process(content: Mapping[str, Any], x: Floats) -> Process:
    y, lengths = (np.array(content[key], float) for key in ("values", "lengths"))
    return Process(x, y, lengths, content["signal"], content["noise"], content["factor"])


def _range(one: Input) -> str:
    return f"{one.low:g} to {one.high:g} {one.unit}".strip()


def fit(
    training: Training, origin: Mapping[str, str], better: Training | None = None
) -> tuple[Surrogate, dict[str, HeldOut], dict[str, Gain]]:
    """The surrogate, its held-out runs and, with few runs on a better ground, the gain by both.

    @raises ResultsError where the intervals of a quantity are not those of the held-out runs
    """
    if better:
        better = require_alike(training, better)
    known = (better or training).inputs
    inputs = tuple(
        Input(name, unit, float(low), float(high), LOGARITHMIC if 0 < DECADE * values.min() < values.max() else LINEAR)
        for name, unit, low, high, values in zip(training.names, training.units, known.min(0), known.max(0), training.inputs.T)
    )

    def scaled(runs: Training) -> Floats:
        return np.column_stack([one.scaled(runs.inputs[:, k]) for k, one in enumerate(inputs)])

    x = scaled(training)
    processes: dict[str, Process | Corrected] = {}
    held_out, gains = {}, {}
    for name, y in training.quantities.items():
        process, held_out[name] = fit_process(x, y)
        require_calibrated(name, held_out[name])
        processes[name] = process
        if better:
            processes[name], held_out[name], gains[name] = correct(process, scaled(better), better.quantities[name])
    checks = {
        name: {"rms_error": held.rms_error, "coverage": held.coverage}
        for name, held in held_out.items()
    }
    named = {"program": f"furrow-post {__version__}", **origin}
    return Surrogate(inputs, processes, checks, training.constants, named), held_out, gains


def read_surrogate(file: Path) -> Surrogate:
    """Reads a surrogate from its file. @raises ResultsError, OSError"""
    with content_of(file, "make it with 'furrow-post surrogate'"):
        content = parse_json(file.read_text(encoding="utf-8"))
        if content["format"] not in (FORMAT, CORRECTED):
            raise ResultsError(
                f"{file}: is of the format '{content['format']}', not '{FORMAT}'; make it again"
            )
        rows: Sequence[Mapping[str, object]] = content["inputs"]
        inputs = tuple(Input(**{key: row[key] for key in ("name", "unit", "low", "high", "scale")}) for row in rows)  # type: ignore[arg-type]

        def scaled(key: str) -> Floats:
            return np.column_stack([one.scaled(np.array(row[key], float)) for one, row in zip(inputs, rows)])

        x = scaled("values")
        processes: dict[str, Process | Corrected] = {}
        checks = {}
        for name in QUANTITIES:
            one = content["quantities"][name]
            processes[name] = process = _process(one, x)
            if correction := one.get("correction"):
                delta = _process(correction, scaled("better"))
                processes[name] = Corrected(process, correction["rho"], delta, correction["widening"])
            checks[name] = {key: one[key] for key in ("rms_error", "coverage")}
        origin = {key: content[key] for key in ("program", "source", "commit", "fitted")}
        return Surrogate(inputs, processes, checks, content["constants"], origin)
