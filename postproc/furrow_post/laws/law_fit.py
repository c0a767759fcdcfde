# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits parameters of a law to measured curves; report and files of the fit."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from .. import __version__
from ..arrays import Floats
from ..csv_table import write_rows
from ..formatting import in_unit
from ..uncertainty.material_error import BESIDE
from ..uncertainty.statistics import rms
from ..whole_file import replaced
from .fitter import PARTNER, Fit, Fitted, NotComputed, Parameter, fit
from .point_curves import Curve, PointCurves

# Values of the parameters -> each curve at its points. @raises NotComputed
Model = Callable[[Floats], Sequence[Floats]]
CORRELATED = 0.95  # two parameters are reported together from this on
LARGEST_RMS = 2.0  # deviations of the data, beyond which the law does not describe them


@dataclass(frozen=True)
class LawFit(Fit):
    """A fit with its curves at their points."""

    started: tuple[Floats, ...] = ()  # with the values at the start
    fitted: tuple[Floats, ...] = ()


def residuals_of(curves: Sequence[Curve], computed: Sequence[Floats]) -> Floats:
    """@raises NotComputed for a value that is not finite, or has no logarithm"""
    parts = []
    for curve, values in zip(curves, computed):
        known = np.isfinite(curve.measured)
        model, measured = values[known], curve.measured[known]
        if not np.all(np.isfinite(model)):
            raise NotComputed(f"curve {curve.name}: {curve.channel} is not finite")
        if curve.relative and np.any(model <= 0):
            raise NotComputed(
                f"curve {curve.name}: {curve.channel} is {model.min():g} and is compared in "
                "logarithms; use scale: linear"
            )
        difference = np.log(model / measured) if curve.relative else model - measured
        parts.append(difference / (curve.deviation or 1.0))
    return np.concatenate(parts)


def fit_law(parameters: Sequence[Parameter], curves: Sequence[Curve], model: Model) -> LawFit:
    """@raises ResultsError where the curves cannot be computed at the start or around the solution"""
    known = all(curve.deviation > 0 for curve in curves)
    # The curves themselves are known to the paths' tolerance, 1e-10 unless changed
    found = fit(parameters, lambda values: residuals_of(curves, model(values)), known=known)
    first = np.array([parameter.value(parameter.first) for parameter in parameters])
    return LawFit(**vars(found), started=tuple(model(first)), fitted=tuple(model(found.values)))


def report(point: PointCurves, fit: LawFit) -> str:
    """Report: parameters with uncertainties, undetermined parameters, correlations."""
    lines = [
        point.title,
        f"  material      {point.material} ({point.law})",
        f"  data          {len(fit.residuals)} values of {len(point.curves)} curve(s), "
        f"{len(fit.parameters)} parameters",
        f"  residual      rms {rms(fit.start):.4g} at the start, {fit.rms:.4g} fitted; "
        f"{fit.evaluations} evaluations; {fit.end}",
    ]
    if not fit.converged:
        lines.append("  WARNING       the fit did not converge")
    if fit.known and fit.rms > LARGEST_RMS:
        lines.append(
            f"  WARNING       this law cannot follow the data: the rms residual is {fit.rms:.3g} "
            "deviations; try another law, or check the deviations"
        )
    lines += ["", f"  {'parameter':<24} {'start':>12} {'fitted':>12} {'deviation':>12}", *map(_row, fit.parameters)]
    scatter = ""
    if fit.known and fit.scatter > 1.0:
        scatter = f", times {fit.scatter:.3g}, the factor by which the law misses the data"
    elif fit.scatter != 1.0:
        scatter = f"; scatter of the data from the residuals, {fit.scatter:.3g}"
    singular = ", ".join(f"{value:.3g}" for value in fit.singular_values)
    lines += ["", f"  deviation: one standard deviation, linearised{scatter}"]
    lines.append(f"  singular values of the scaled Jacobian: {singular}")
    names = [fitted.parameter.name for fitted in fit.parameters]
    direction = fit.directions[:, -1]
    direction = direction * np.sign(direction[np.argmax(np.abs(direction))])
    weakest = [f"{part:+.2f} {name}" for part, name in zip(direction, names) if abs(part) > PARTNER]
    if len(names) > 1:
        lines.append(
            f"  the data determine least the combination {' '.join(weakest)} (of logarithms, or "
            "values over their scale)"
        )
    for i, j in np.argwhere(np.abs(np.tril(fit.correlation, -1)) > CORRELATED):
        together = f"{names[j]} and {names[i]} are correlated by {fit.correlation[i, j]:.4f}"
        lines.append(f"  {together}: the data fix them together better than each alone")
    return "\n".join(lines) + "\n"


def _row(fitted: Fitted) -> str:
    parameter, deviation = fitted.parameter, fitted.deviation
    shown, share = "unknown" if math.isnan(deviation) else "infinite", ""
    if math.isfinite(deviation):
        shown = f"{deviation:.3g}"
        share = f"{100 * abs(deviation / fitted.value):.2g} %" if fitted.value else ""
    remark = fitted.remark if fitted.determined else f"NOT DETERMINED: {fitted.remark}"
    return (
        f"  {parameter.name + in_unit(parameter.unit):<24} {parameter.start:12.6g} "
        f"{fitted.value:12.6g} {shown:>12} {share:>8}  {remark}"
    ).rstrip()


def write_fit(point: PointCurves, fit: LawFit, folder: Path) -> None:
    """material.yaml with the fitted values, their standard errors, report.txt, fit.csv and fit.h5. @raises OSError"""
    folder.mkdir(parents=True, exist_ok=True)
    texts = {"material.yaml": point.material_file(fit.values), "report.txt": report(point, fit)}
    for name, text in texts.items():
        with replaced(folder / name) as part:
            part.write_text(text, encoding="utf-8")
    determined = [one for one in fit.parameters if one.determined and math.isfinite(one.deviation)]
    if determined:
        errors = [{"parameter": one.parameter.name, "error": one.deviation} for one in determined]
        with replaced(folder / f"material{BESIDE}") as part:
            write_rows(part, errors, [f"# Standard errors of material.yaml: {point.title}"])
    comments, rows = [f"# {point.title} (furrow {__version__})"], []
    for number, (curve, *computed) in enumerate(zip(point.curves, fit.started, fit.fitted)):
        comments.append(f"# curve {number}: {curve.name}; driven: {curve.driven_by}; compared: {curve.channel}")
        for values in np.column_stack([curve.driven, curve.measured, *computed]).tolist():
            cells = ("" if math.isnan(value) else value for value in values)
            rows.append({"curve": number, **dict(zip(("driven", "measured", "start", "fitted"), cells))})
    with replaced(folder / "fit.csv") as part:
        write_rows(part, rows, comments)
    with replaced(folder / "fit.h5") as part, h5py.File(part, "w") as content:
        _write_hdf5(point, fit, content)


def _write_hdf5(point: PointCurves, fit: LawFit, content: Any) -> None:
    """/curves/<n>/driven, measured, start, fitted; /parameters/<name>, attributes alone."""
    curves = content.create_group("curves")
    curves.attrs["title"] = point.title
    for number, curve in enumerate(point.curves):
        group = curves.create_group(str(number))
        group["driven"], group["measured"] = curve.driven, curve.measured
        group["start"], group["fitted"] = fit.started[number], fit.fitted[number]
        for name in ("name", "path", "driven_by", "compared", "deviation"):
            group.attrs[name] = getattr(curve, name)
        group.attrs["relative"] = float(curve.relative)
    parameters = content.create_group("parameters", track_order=True)
    for fitted in fit.parameters:
        attributes = parameters.create_group(fitted.parameter.name).attrs
        attributes.update({"unit": fitted.parameter.unit, "remark": fitted.remark, "start": fitted.parameter.start})
        attributes.update({"value": fitted.value, "deviation": fitted.deviation})
        attributes["determined"] = float(fitted.determined)
