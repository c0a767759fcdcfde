# SPDX-License-Identifier: GPL-2.0-or-later
"""Empirical formulas for the conditions of a run."""

from collections.abc import Iterable

from ..errors import ResultsError
from ..read.wheel_run import WheelRun
from . import empirical
from .prediction import Prediction
from .terrain_values import terrain


def predictions_for(run: WheelRun, names: Iterable[str], extrapolate: bool) -> list[Prediction]:
    """One per name: "nrmm:PRESSURE" [Pa], "bekker:TERRAIN", "wong_reece:TERRAIN".

    @raises ResultsError for another name, an unknown terrain, or outside of the range of a formula
    """
    return [_prediction(run, name, extrapolate) for name in names]


def require_formulas(names: Iterable[str]) -> None:
    """@raises ResultsError for a name that is none, for any run"""
    for name in names:
        method, _, what = name.partition(":")
        if method == "nrmm":
            _nrmm_pressure(name)
        elif method in ("bekker", "wong_reece"):
            terrain(what)
        else:
            raise ResultsError(
                f"there is no formula '{method}'; there are nrmm:PRESSURE, bekker:TERRAIN, "
                "wong_reece:TERRAIN"
            )


def _nrmm_pressure(name: str) -> float:
    try:
        pressure = float(name.partition(":")[2])
    except ValueError:
        raise ResultsError(
            f"formula '{name}': write nrmm:PRESSURE with the largest contact pressure in Pa, "
            "e.g. nrmm:179e3"
        ) from None
    empirical.require_pressure(pressure)
    return pressure


def _prediction(run: WheelRun, name: str, extrapolate: bool) -> Prediction:
    require_formulas([name])
    method, _, what = name.partition(":")
    load, diameter, width = run.number("load"), 2 * run.radius, run.number("wheel_width")
    if method == "nrmm":
        if "density" not in run.conditions:
            raise ResultsError(
                f"{run.label}: the density of its ground is not known; NRMM needs it"
            )
        depth, density = run.number("depth"), run.number("density")
        pressure = _nrmm_pressure(name)
        return empirical.nrmm(
            load, run.radius, width, depth, density, pressure, extrapolate=extrapolate
        )
    ground = terrain(what)
    if method == "bekker":
        return empirical.bekker(load, diameter, width, ground, extrapolate)
    slip = run.number("slip")
    return empirical.wong_reece(load, diameter, width, slip, ground, extrapolate)
