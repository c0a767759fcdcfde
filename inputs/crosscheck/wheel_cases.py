# SPDX-License-Identifier: GPL-2.0-or-later
"""Wheels and tyres on both grounds, beside formulas."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from cases import BASE, CHECKS, Made, OutputRow, known, output_row

from furrow_post.analyse import cost_table, empirical
from furrow_post.analyse.comparison import (
    FORMULA,
    RUN,
    Comparison,
    compare,
    entries_of_run,
    findings,
    overall,
)
from furrow_post.analyse.empirical import Prediction
from furrow_post.analyse.verdict import QUANTITIES, Agreement, joined, quantities_with
from furrow_post.errors import ResultsError
from furrow_post.figures.comparison import draw_comparison
from furrow_post.figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from furrow_post.formatting import with_error
from furrow_post.read.wheel_run import WheelRun, read_wheel_run
from furrow_post.study.output import Output
from furrow_post.study.tables import markdown

GROUNDS = ("continuum", "grains")
VARIED = {"load": "load [N]", "depth": "depth [m]", "speed": "speed [m/s]"}  # roles of a series
PRESSURE = 179e3  # [Pa] for NRMM
BEKKER = ("LLL dry sand", "LETE sand")  # for cases on sand
WONG_REECE = ("Wong-Reece loose sand", "Wong-Reece compact sand")


def formulas(case: str, run: WheelRun) -> dict[str, Prediction | None]:
    """Short name -> what the formulas of the case say, None where they are out of range."""
    load, width = run.number("load"), run.number("wheel_width")
    wheel = (load, run.number("wheel_diameter"), width)
    if "snow" in case:
        snow = (run.number("depth"), run.number("density"))
        wanted = {"NRMM": partial(empirical.nrmm, load, run.radius, width, *snow, PRESSURE)}
    else:
        wanted = {
            f"Bekker, {name}": partial(empirical.bekker, *wheel, empirical.terrain(name))
            for name in BEKKER
        }
        for name in WONG_REECE:
            wanted[name] = partial(empirical.wong_reece, *wheel, 0.0, empirical.terrain(name))
    found: dict[str, Prediction | None] = {}
    for name, formula in wanted.items():
        try:
            found[name] = replace(formula(), method=name)
        except ResultsError:  # out of range, or the ground does not carry the load
            found[name] = None
    return found


class WheelCase:
    """Pairs of wheel runs with the errors of the case's own checks."""

    def __init__(self, case: str, made: Made) -> None:
        self.case = case
        self.made = made
        self.plans = {(planned.ground, planned.role): planned for planned in made.plans}
        self.runs = {
            key: read_wheel_run(made.folder(planned), planned.ground)
            for key, planned in self.plans.items()
        }
        self.table = [
            cost_table.row_of(self.runs[key])
            for key, planned in self.plans.items()
            if planned.kind in CHECKS
        ]
        # another law of the continuum stands beside the same grains
        for _, role in [key for key in self.runs if key[1].startswith("law=")]:
            if ("grains", BASE) in self.runs:
                self.runs["grains", role] = self.runs["grains", BASE]
                self.plans["grains", role] = self.plans["grains", BASE]

    @property
    def complete(self) -> bool:
        """Whether there is a pair to compare."""
        return self.on_both(BASE)

    def on_both(self, role: str) -> bool:
        return all((ground, role) in self.runs for ground in GROUNDS)

    def roles(self) -> list[str]:
        """The base and what is not a check of it, where both grounds were run."""
        roles = dict.fromkeys(plan.role for plan in self.made.plans if not plan.is_check)
        return [role for role in roles if self.on_both(role)]

    def compared(self, role: str) -> Comparison:
        pair = [self.runs[ground, role] for ground in GROUNDS]
        valid = [p for p in formulas(self.case, pair[0]).values() if p]
        return compare(pair, self.table, valid, anyway=True)


def agreement_cell(result: Comparison) -> str:
    """In which quantities the two grounds agree, and which cannot be decided."""
    undecided = quantities_with(result.verdicts, Agreement.UNDECIDED)
    agreed = [
        name for name in quantities_with(result.verdicts, Agreement.AGREE) if name not in undecided
    ]
    parts = [joined(agreed)] if agreed else []
    if undecided:
        parts.append(f"not decided: {joined(undecided)}")
    return "; ".join(parts) or "neither"


def wheel_section(case: WheelCase, output: Output, out: list[OutputRow]) -> list[str]:
    """The section of the page; out: gets the lines of results.csv."""
    names = list(formulas(case.case, case.runs["continuum", BASE]))
    by_formula = "NRMM" if names == ["NRMM"] else "by formula"
    head = ["", "sinkage mm: continuum", "grains", by_formula]
    head += ["coefficient: continuum", "grains", by_formula, "agree in"]
    rows, results = [], {}
    for role in case.roles():
        result = results[role] = case.compared(role)
        for difference in result.differences:
            text = f"{role}: {difference.condition} differs: {difference.text}"
            rows.append([text, *[""] * (len(head) - 1)])
        rows.append(wheel_cells(case, role, result, names))
        out += wheel_rows(case, role, result, names)
    base = results[BASE]
    draw_comparison(base, output.path(f"{case.case}.png"))
    lines = [f"## {case.case.replace('_', ' ')}", "", *markdown(head, rows)]
    if len(names) > 1:
        lines += ["", f"By formula: {'; '.join(names)}."]
    lines += ["", f"![{case.case}]({case.case}.png)", ""]
    if draw_series(case, output):
        lines += [f"![{case.case}, series]({case.case}_series.png)", ""]
    lines += [overall(base), "", *(f"- {sentence}" for sentence in findings(base)), ""]
    if len(case.table) > 2:
        comment = "# Runs of the case with their size, domain, packing: what its errors come from."
        cost_table.write_table(output.path(f"{case.case}_runs.csv"), case.table, [comment])
    return lines


def wheel_cells(case: WheelCase, role: str, result: Comparison, names: Sequence[str]) -> list[str]:
    cells = [role.replace("=", " ")]
    for quantity in QUANTITIES:
        scale = quantity.scale
        for entry in result.of(quantity, RUN):
            cells.append(with_error(scale * entry.value, scale * entry.uncertainty))
        found = {e.source: f"{scale * e.value:.3g}" for e in result.of(quantity, FORMULA)}
        cells.append(", ".join(found.get(name, "out of range") for name in names))
    return [*cells, agreement_cell(result)]


def wheel_rows(
    case: WheelCase, role: str, result: Comparison, names: Sequence[str]
) -> Iterator[OutputRow]:
    for quantity in QUANTITIES:
        for entry in result.of(quantity, RUN):
            parts = dict(zip(entry.parts.NAMES, map(known, entry.parts.parts())))
            yield output_row(
                case.case,
                role,
                entry.source,
                quantity.key,
                value=f"{entry.value:.6g}",
                uncertainty=f"{entry.uncertainty:.3g}",
                **parts,
                **case.made.cost_cells(case.plans[entry.source, role]),
            )
        for name in names:
            for entry in result.of(quantity, FORMULA):
                if entry.source == name:
                    value = f"{entry.value:.6g}"
                    yield output_row(case.case, role, name, quantity.key, value=value)


def draw_series(case: WheelCase, output: Output) -> bool:
    """Sinkage and coefficient of both grounds against what was varied; formulas where valid.

    False: nothing was varied.
    """
    varied = [name for name in VARIED if any(role.startswith(f"{name}=") for _, role in case.runs)]
    if not varied:
        return False
    use_style()
    size = (1 + 3.4 * len(varied), 6)
    figure, panels = plt.subplots(
        2, len(varied), figsize=size, layout="constrained", sharex="col", squeeze=False
    )
    for column, (name, letter) in enumerate(zip(varied, panel_letters())):
        draw_varied(panels[:, column], case, name)
        annotate_panel(panels[0, column], letter, f"against {name}")
    panels[0, 0].set_ylabel("sinkage [mm]")
    panels[1, 0].set_ylabel("resistance coefficient")
    panels[0, 0].legend(fontsize=8)
    save(figure, output.path(f"{case.case}_series.png"), dpi=110)
    return True


def draw_varied(panels: Sequence[Axes], case: WheelCase, name: str) -> None:
    """One condition; panels: of sinkage and of the coefficient."""
    families = cost_table.families(case.table)
    picked: list[WheelRun] = []
    for ground, colour in zip(GROUNDS, RUN_COLOURS):
        picked = [
            run
            for (of, role), run in case.runs.items()
            if of == ground and (role == BASE or role.startswith(f"{name}="))
        ]
        picked.sort(key=lambda run: run.number(name))
        x = [run.number(name) for run in picked]
        for axes, quantity in zip(panels, QUANTITIES):
            entries = [
                entry
                for run in picked
                for entry in entries_of_run(run, families)
                if entry.quantity == quantity
            ]
            values = [quantity.scale * entry.value for entry in entries]
            errors = [2 * quantity.scale * entry.uncertainty for entry in entries]
            look = {"fmt": "o-", "capsize": 3, "lw": 1, "color": colour, "label": ground}
            axes.errorbar(x, values, errors, **look)
    points: dict[str, list[tuple[float, Prediction]]] = {}
    for run in picked:
        for formula, prediction in formulas(case.case, run).items():
            if prediction:
                points.setdefault(formula, []).append((run.number(name), prediction))
    for (formula, found), marker in zip(points.items(), "s^vD"):
        x = [value for value, _ in found]
        look = {"ls": "", "marker": marker, "mfc": "white", "color": "0.4", "label": formula}
        panels[0].plot(x, [1e3 * p.sinkage for _, p in found], **look)
        panels[1].plot(x, [p.coefficient for _, p in found], **look)
    for axes in panels:
        axes.set_ylim(0, None)
    panels[1].set_xlabel(VARIED[name])
