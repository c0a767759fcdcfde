# SPDX-License-Identifier: GPL-2.0-or-later
"""Report and files of the fit of a law to measured curves."""

import math
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from .. import __version__
from ..csv_table import write_rows
from ..formatting import in_unit
from ..whole_file import replaced
from .fitter import PARTNER, Fitted
from .law_fit import LawFit
from ..uncertainty.material_error import BESIDE
from .point_curves import PointCurves

CORRELATED = 0.95  # two parameters are reported together from this on
LARGEST_RMS = 2.0  # deviations of the data, beyond which the law does not describe them


def report(point: PointCurves, fit: LawFit) -> str:
    """Parameters with uncertainties, what is not determined, correlations."""
    lines = [
        point.title,
        f"  material      {point.material} ({point.law})",
        f"  data          {fit.data} values of {len(point.curves)} curve(s), "
        f"{len(fit.parameters)} parameters",
        f"  residual      rms {fit.rms_start:.4g} at the start, {fit.fit.rms:.4g} fitted; "
        f"{fit.fit.evaluations} evaluations; {fit.fit.end}",
    ]
    if not fit.fit.converged:
        lines.append("  WARNING       the fit did not converge")
    if fit.fit.known and fit.fit.rms > LARGEST_RMS:
        lines.append(
            f"  WARNING       this law cannot follow the data: the rms residual is {fit.fit.rms:.3g} "
            "deviations; try another law, or check the deviations"
        )
    lines += ["", f"  {'parameter':<24} {'start':>12} {'fitted':>12} {'deviation':>12}"]
    lines += map(_row, fit.parameters)
    scatter = ""
    if fit.fit.known and fit.fit.scatter > 1.0:
        scatter = f", times {fit.fit.scatter:.3g}, the factor by which the law misses the data"
    elif fit.fit.scatter != 1.0:
        scatter = f"; scatter of the data from the residuals, {fit.fit.scatter:.3g}"
    singular = ", ".join(f"{value:.3g}" for value in fit.fit.singular_values)
    lines += [
        "",
        f"  deviation: one standard deviation, linearised{scatter}",
        f"  singular values of the scaled Jacobian: {singular}",
    ]
    names = [fitted.parameter.name for fitted in fit.parameters]
    direction = fit.fit.directions[:, -1]
    direction = direction * np.sign(direction[np.argmax(np.abs(direction))])
    weakest = [f"{part:+.2f} {name}" for part, name in zip(direction, names) if abs(part) > PARTNER]
    if len(names) > 1:
        lines.append(
            f"  the data determine least the combination {' '.join(weakest)} (of logarithms, or "
            "values over their scale)"
        )
    lines += [
        f"  {names[j]} and {names[i]} are correlated by {fit.fit.correlation[i, j]:.4f}: the data fix "
        "them together better than each alone"
        for i in range(len(names))
        for j in range(i)
        if abs(fit.fit.correlation[i, j]) > CORRELATED
    ]
    return "\n".join(lines) + "\n"


def _row(fitted: Fitted) -> str:
    parameter, deviation = fitted.parameter, fitted.deviation
    shown = f"{deviation:.3g}" if math.isfinite(deviation) else "infinite"
    if math.isnan(deviation):
        shown = "unknown"
    share = ""
    if fitted.value and math.isfinite(deviation):
        share = f"{100 * abs(deviation / fitted.value):.2g} %"
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
    errors = [{"parameter": one.parameter.name, "error": one.deviation} for one in fit.parameters if one.determined and math.isfinite(one.deviation)]
    if errors:
        with replaced(folder / f"material{BESIDE}") as part:
            write_rows(part, errors, [f"# Standard errors of material.yaml: {point.title}"])
    comments = [f"# {point.title} (furrow {__version__})"] + [
        f"# curve {number}: {curve.name}; driven: {curve.driven_by}; compared: {curve.channel}"
        for number, curve in enumerate(point.curves)
    ]
    with replaced(folder / "fit.csv") as part:
        write_rows(part, _rows(point, fit), comments)
    with replaced(folder / "fit.h5") as part, h5py.File(part, "w") as content:
        _write_hdf5(point, fit, content)


def _rows(point: PointCurves, fit: LawFit) -> list[dict[str, Any]]:
    rows = []
    for number, curve in enumerate(point.curves):
        columns = {
            "driven": curve.driven,
            "measured": curve.measured,
            "start": fit.start[number],
            "fitted": fit.fitted[number],
        }
        for values in np.array(list(columns.values())).T.tolist():
            cells = ["" if math.isnan(value) else value for value in values]
            rows.append({"curve": number, **dict(zip(columns, cells))})
    return rows


def _write_hdf5(point: PointCurves, fit: LawFit, content: Any) -> None:
    """/curves/<n>/driven, measured, start, fitted; /parameters/<name>, attributes alone."""
    curves = content.create_group("curves")
    curves.attrs["title"] = point.title
    for number, curve in enumerate(point.curves):
        group = curves.create_group(str(number))
        group["driven"], group["measured"] = curve.driven, curve.measured
        group["start"], group["fitted"] = fit.start[number], fit.fitted[number]
        for name in ("name", "path", "driven_by", "compared", "deviation"):
            group.attrs[name] = getattr(curve, name)
        group.attrs["relative"] = float(curve.relative)
    parameters = content.create_group("parameters", track_order=True)
    for fitted in fit.parameters:
        parameters.create_group(fitted.parameter.name).attrs.update(
            {
                "unit": fitted.parameter.unit,
                "remark": fitted.remark,
                "start": fitted.parameter.start,
                "value": fitted.value,
                "deviation": fitted.deviation,
                "determined": float(fitted.determined),
            }
        )
