# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post choose: what to model for a wanted error, from the table of a scene, and afterwards whether the estimate held."""

import math
import shlex
import sys

from . import conditions, cost, cost_table
from .compare import COVERAGE, duration
from .results import ResultsError
from .summary import with_error


def command(arguments):
    rows, comments = cost_table.read(arguments.table)
    runnable = {row.run for row in rows if row.options}
    assessed = [a for a in cost.assess(rows, cost_table.wanted_wheel(comments)) if a.row.run in runnable]
    if not assessed:
        raise ResultsError(f"{arguments.table}: no row says how to run it (column options)")
    choice, within = cost.recommend(assessed, arguments.error)
    if arguments.held:
        print("\n".join(held(choice, arguments.error, conditions.read(arguments.held))))
        return
    print("\n".join(reasons(choice, within, assessed, arguments.error)), file=sys.stderr)
    print("\n".join(shlex.split(choice.row.options)))  # a word a line


def reasons(choice, within, assessed, error):
    """Sentences on what was chosen and what each choice costs in accuracy."""
    advice = cost.advice(assessed, error)
    lines = advice[:1] + [line for line in advice[1:] if line.startswith("By its fit")]
    row = choice.row
    for quantity, part in choice.parts.items():
        known = ", ".join(f"{name} {100 * getattr(part, name) / abs(choice.references[quantity]):.1f} %" for name in part.known)
        lines.append(f"  {quantity}: error {100 * choice.errors[quantity]:.0f} % ({known})")
    if row.model == "half":
        lines.append("  half model: exact for straight travel on ground that is symmetric, and half the cost")
    kinds = {a.row.wheel for a in assessed if math.isfinite(a.error)}
    lines.append(f"  {row.wheel}: " + ("the only kind whose error is known" if len(kinds) == 1 else "cheapest within the error" if within else "least error"))
    for kind in sorted(kinds - {row.wheel}):
        other = min((a for a in assessed if a.row.wheel == kind and math.isfinite(a.error)), key=lambda a: a.error)
        worst = max(other.models, key=other.models.get)
        stands = f"standing in for the {row.wheel} it errs by {100 * other.models[worst]:.0f} % in the {worst}, whatever its size" \
            if other.models[worst] > 0 else f"{100 * other.error:.0f} % at best, {duration(other.row.cpu_time)}"
        lines.append(f"  not {kind}: {stands}")
    if choice.models[choice.worst] > 0:
        lines.append("  it stands in for another wheel: " + ", ".join(f"{q} off by {100 * m:.0f} %" for q, m in choice.models.items()))
    for ground in sorted({a.row.ground for a in assessed} - {row.ground}):
        try:
            other, ok = cost.recommend(assessed, error, {ground})
            lines.append(f"  not {ground}: " + (f"{duration(other.row.cpu_time)} for the same" if ok else f"{100 * other.error:.0f} % at best"))
        except ResultsError:
            lines.append(f"  not {ground}: its error is not known")
    return lines


def held(choice, error, run):
    """Whether the run's values lie within the wanted error of the table's value at size zero, and its cost near the estimate."""
    lines = [f"Estimate: {cost.describe(choice)}, error {100 * choice.error:.0f} %, {duration(choice.row.cpu_time)} of one core"]
    good = True
    for quantity, name in (("sinkage", "sinkage"), ("coefficient", "resistance_coefficient")):
        reference, value = choice.references[quantity], run.values[name]
        off = (value.mean - reference) / reference
        allowed = max(error, choice.errors[quantity]) + COVERAGE * value.error / abs(reference)
        ok = abs(off) <= allowed
        good &= ok
        lines.append(f"  {name.replace('_', ' ')}: {with_error(value.mean, value.error)}, {100 * off:+.1f} % from the value at size zero "
                     f"({reference:.4g}), allowed {100 * allowed:.0f} %: {'held' if ok else 'NOT HELD'}")
    if math.isfinite(run.cpu_time) and choice.row.cpu_time > 0:
        lines.append(f"  cost: {duration(run.cpu_time)}, {run.cpu_time / choice.row.cpu_time:.2f} times the estimate")
    lines.append("The estimate held." if good else
                 "The estimate did not hold: the scene differs from those of the table, or the table is out of date.")
    return lines
