# SPDX-License-Identifier: GPL-2.0-or-later
"""What to model for a wanted error, from the table of a scene, and whether the estimate held."""

import math
from collections.abc import Sequence

from ..errors import ResultsError
from ..formatting import duration, with_error
from ..read.wheel_run import WheelRun
from . import cost
from .cost import Assessed
from .verdict import COVERAGE


def reasons(
    choice: Assessed, within: bool, assessed: Sequence[Assessed], error: float
) -> list[str]:
    """Sentences on what was chosen and what each choice costs in accuracy.

    within: whether the choice reaches the relative error that is wanted.
    """
    lines = cost.advice(assessed, error)[:1]
    if not within:
        lines += cost.extrapolation_advice(assessed, error)
    row = choice.row
    for key, part in choice.parts.items():
        reference = abs(choice.references[key])
        known = [f"{name} {100 * part.part(name) / reference:.1f} %" for name in part.known]
        lines.append(f"  {key}: error {100 * choice.errors[key]:.0f} % ({', '.join(known)})")
    if row.model == "half":
        lines.append(
            "  half model: exact for straight travel on ground that is symmetric, and half the cost"
        )
    return lines + _other_wheels(choice, within, assessed) + _other_grounds(choice, assessed, error)


def _other_wheels(choice: Assessed, within: bool, assessed: Sequence[Assessed]) -> list[str]:
    known = [a for a in assessed if math.isfinite(a.error)]
    kinds = {a.row.wheel for a in known}
    wheel = choice.row.wheel
    why = "cheapest within the error" if within else "least error"
    lines = [f"  {wheel}: {'the only kind whose error is known' if len(kinds) == 1 else why}"]
    for kind in sorted(kinds - {wheel}):
        other = min((a for a in known if a.row.wheel == kind), key=lambda a: a.error)
        worst = max(other.models, key=lambda key: other.models[key])
        if other.models[worst] > 0:
            lines.append(
                f"  not {kind}: standing in for the {wheel} it errs by "
                f"{100 * other.models[worst]:.0f} % in the {worst}, whatever its size"
            )
        else:
            at_best = f"{100 * other.error:.0f} % at best, {duration(other.row.cpu_time)}"
            lines.append(f"  not {kind}: {at_best}")
    if choice.models[choice.worst] > 0:
        off = ", ".join(f"{key} off by {100 * m:.0f} %" for key, m in choice.models.items())
        lines.append(f"  it stands in for another wheel: {off}")
    return lines


def _other_grounds(choice: Assessed, assessed: Sequence[Assessed], error: float) -> list[str]:
    lines = []
    for ground in sorted({a.row.ground for a in assessed} - {choice.row.ground}):
        try:
            other, reached = cost.recommend(assessed, error, {ground})
        except ResultsError:
            lines.append(f"  not {ground}: its error is not known")
            continue
        at_best = f"{100 * other.error:.0f} % at best"
        same = f"{duration(other.row.cpu_time)} for the same"
        lines.append(f"  not {ground}: {same if reached else at_best}")
    return lines


def held(choice: Assessed, error: float, run: WheelRun) -> list[str]:
    """Whether the run's values and its cost are what the table let expect, as sentences.

    The values must lie within the wanted relative error of the table's value at size zero.
    """
    row = choice.row
    lines = [
        f"Estimate: {choice.describe()}, error {100 * choice.error:.0f} %, "
        f"{duration(row.cpu_time)} of one core"
    ]
    good = True
    for key, name in (("sinkage", "sinkage"), ("coefficient", "resistance_coefficient")):
        reference, value = choice.references[key], run.values[name]
        off = (value.mean - reference) / reference
        allowed = max(error, choice.errors[key])
        allowed += COVERAGE * value.standard_error / abs(reference)
        ok = abs(off) <= allowed
        good &= ok
        lines.append(
            f"  {name.replace('_', ' ')}: {with_error(value.mean, value.standard_error)}, "
            f"{100 * off:+.1f} % from the value at size zero ({reference:.4g}), "
            f"allowed {100 * allowed:.0f} %: {'held' if ok else 'NOT HELD'}"
        )
    if math.isfinite(run.cpu_time) and row.cpu_time > 0:
        ratio = run.cpu_time / row.cpu_time
        lines.append(f"  cost: {duration(run.cpu_time)}, {ratio:.2f} times the estimate")
    lines.append(
        "The estimate held."
        if good
        else "The estimate did not hold: the scene differs from those of the table, or the table "
        "is out of date."
    )
    return lines
