# SPDX-License-Identifier: GPL-2.0-or-later
"""What to model for a wanted error, from the table of a scene, and whether the estimate held.

One run, or two that are extrapolated to size zero where that is cheaper.
"""

import math
from collections.abc import Mapping, Sequence

from ..errors import ResultsError
from ..formatting import duration, with_error
from ..read.wheel_run import WheelRun
from . import cost
from .cost import Assessed
from .entry import NAME_IN_RUN
from .extrapolation import Pair, better_pair
from .verdict import COVERAGE

Mean = tuple[float, float]  # a value and its standard error


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
    one, other = _means(coarse), _means(fine)
    values = {key: pair.at_size_zero(key, one[key], other[key]) for key in one}
    return _judged(pair, error, values, coarse.cpu_time + fine.cpu_time, " at size zero")


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

    The values must lie within the wanted relative error of the table's best estimate.
    """
    return _judged(choice, error, _means(run), run.cpu_time)


def _means(run: WheelRun) -> dict[str, Mean]:
    """By the keys of quantities."""
    values = {key: run.values[name] for key, name in NAME_IN_RUN.items()}
    return {key: (value.mean, value.standard_error) for key, value in values.items()}


def _judged(
    choice: Assessed | Pair, error: float, values: Mapping[str, Mean], spent: float, where: str = ""
) -> list[str]:
    """spent: core seconds; where: the values are, for the sentences."""
    lines = [
        f"Estimate: {choice.describe()}, error {100 * choice.error:.0f} %, "
        f"{duration(choice.cpu_time)} of one core"
    ]
    good = True
    for key, (value, u) in values.items():
        reference = choice.references[key]
        off = (value - reference) / reference
        allowed = max(error, choice.errors[key]) + COVERAGE * u / abs(reference)
        ok = abs(off) <= allowed
        good &= ok
        lines.append(
            f"  {NAME_IN_RUN[key].replace('_', ' ')}{where}: {with_error(value, u)}, "
            f"{100 * off:+.1f} % from the best estimate ({reference:.4g}), "
            f"allowed {100 * allowed:.0f} %: {'held' if ok else 'NOT HELD'}"
        )
    if math.isfinite(spent) and choice.cpu_time > 0:
        ratio = spent / choice.cpu_time
        lines.append(f"  cost: {duration(spent)}, {ratio:.2f} times the estimate")
    lines.append(
        "The estimate held."
        if good
        else "The estimate did not hold: the scene differs from those of the table, or the table "
        "is out of date."
    )
    return lines
