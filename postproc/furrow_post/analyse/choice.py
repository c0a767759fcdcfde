# SPDX-License-Identifier: GPL-2.0-or-later
"""What to model for a wanted error, from the table of a scene, and whether the estimate held.

One run, or two that are extrapolated to size zero where that is cheaper.
"""

import math
from collections.abc import Sequence

from ..errors import ResultsError
from ..formatting import duration, with_error
from ..read.wheel_run import WheelRun
from . import cost
from .cost import Assessed
from .extrapolation import Pair, better_pair
from .verdict import COVERAGE

QUANTITY_NAMES = (("sinkage", "sinkage"), ("coefficient", "resistance_coefficient"))


def choose(assessed: Sequence[Assessed], error: float) -> tuple[Assessed, bool, Pair | None]:
    """The run for a relative error and whether it is within; the pair that is better, if any.

    @raises ResultsError where the error of no run is known
    """
    run, within = cost.recommend(assessed, error)
    return run, within, better_pair(assessed, error, run, within)


def reasons_of_pair(pair: Pair, run: Assessed, within: bool, error: float) -> list[str]:
    """Sentences on why two runs were chosen instead of this one."""
    what = f"{100 * pair.error:.0f} % ({pair.worst}), {duration(pair.cpu_time)} of one core"
    alone = f"{run.describe()}, {100 * run.error:.0f} %, {duration(run.row.cpu_time)}"
    if pair.error > error:
        return [
            f"Nothing of the table reaches {100 * error:g} %; the best is {pair.describe()}: "
            f"{what}.",
            f"  one run alone, at best: {alone}",
        ]
    return [
        f"For {100 * error:g} % error use {pair.describe()}: {what} for both.",
        f"  one run alone{'' if within else ', at best'}: {alone}",
    ]


def pair_held(pair: Pair, error: float, coarse: WheelRun, fine: WheelRun) -> list[str]:
    """What two runs come to at size zero, and whether that and the cost are as expected."""
    lines = [
        f"Estimate: {pair.describe()}, error {100 * pair.error:.0f} %, "
        f"{duration(pair.cpu_time)} of one core"
    ]
    good = True
    for key, name in QUANTITY_NAMES:
        one, other = (run.values[name] for run in (coarse, fine))
        value, u = pair.at_size_zero(
            (one.mean, one.standard_error), (other.mean, other.standard_error)
        )
        allowed = max(error, pair.errors[key])
        line, ok = _judged(f"{name} at size zero", value, u, pair.fine.references[key], allowed)
        lines.append(line)
        good &= ok
    return [*lines, *_cost(coarse.cpu_time + fine.cpu_time, pair.cpu_time), _in_all(good)]


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
    for key, name in QUANTITY_NAMES:
        value = run.values[name]
        allowed = max(error, choice.errors[key])
        line, ok = _judged(
            name, value.mean, value.standard_error, choice.references[key], allowed
        )
        lines.append(line)
        good &= ok
    return [*lines, *_cost(run.cpu_time, row.cpu_time), _in_all(good)]


def _judged(
    name: str, value: float, u: float, reference: float, error: float
) -> tuple[str, bool]:
    """A value with its standard error against that at size zero: a line, and whether it held."""
    off = (value - reference) / reference
    allowed = error + COVERAGE * u / abs(reference)
    ok = abs(off) <= allowed
    line = (
        f"  {name.replace('_', ' ')}: {with_error(value, u)}, "
        f"{100 * off:+.1f} % from the value at size zero ({reference:.4g}), "
        f"allowed {100 * allowed:.0f} %: {'held' if ok else 'NOT HELD'}"
    )
    return line, ok


def _cost(spent: float, estimate: float) -> list[str]:
    if not (math.isfinite(spent) and estimate > 0):
        return []
    return [f"  cost: {duration(spent)}, {spent / estimate:.2f} times the estimate"]


def _in_all(good: bool) -> str:
    if good:
        return "The estimate held."
    return (
        "The estimate did not hold: the scene differs from those of the table, or the table is out "
        "of date."
    )
