# SPDX-License-Identifier: GPL-2.0-or-later
"""HTML pages that need no other file: their templates are in the folder templates."""

import base64
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ..analyse.comparison import Comparison, parts_cell
from ..uncertainty.verdict import QUANTITIES
from ..uncertainty.whole_error import RunErrors, headline
from ..formatting import duration, in_unit
from ..read.wheel_run import WheelRun
from ..run.summary import Summary


def _data_uri(path: Path) -> str:
    """An image as data in the page."""
    kind = "svg+xml" if path.suffix == ".svg" else "png"
    return f"data:image/{kind};base64,{base64.b64encode(path.read_bytes()).decode()}"


_environment = Environment(
    loader=FileSystemLoader(Path(__file__).parent / "templates"),
    autoescape=True,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
    undefined=StrictUndefined,
)
_environment.filters["data_uri"] = _data_uri


def render(template: str, title: str, lead: str = "", **values: Any) -> str:
    """A whole page. lead: a line below the title, may be empty"""
    return _environment.get_template(template).render(title=title, lead=lead, **values)


def verdict_values(result: Comparison) -> dict[str, Any]:
    """Verdict, findings and differences of a comparison."""
    return {
        "verdict": result.overall(),
        "findings": result.findings(),
        "differences": [f"{each.condition}: {each.text}" for each in result.differences],
    }


def results_tables(result: Comparison) -> list[tuple[str, list[list[str]]]]:
    """Name and rows of every quantity of every run, formula and measurement with its uncertainty."""
    tables = []
    for quantity in QUANTITIES:
        rows = [[e.label, e.text(), parts_cell(e), duration(e.cpu_time), e.note] for e in result.of(quantity)]
        name = quantity.name[0].upper() + quantity.name[1:] + in_unit(quantity.unit)
        tables.append((name, rows))
    return tables


def condition_rows(runs: Sequence[WheelRun], but: str = "") -> list[list[str]]:
    """Conditions, ground and discretisation of the runs, a row each; but: without this one."""
    names = dict.fromkeys(name for run in runs for name in run.conditions if name != but)
    return [
        *([name.replace("_", " "), *(run.text(name) for run in runs)] for name in names),
        ["ground", *(run.ground for run in runs)],
        ["discretisation", *(run.describe_size() for run in runs)],
    ]


def all_condition_rows(runs: Sequence[WheelRun]) -> list[list[str]]:
    """Conditions, discretisation and cost of the runs."""
    domains = [" x ".join(f"{edge:.3g}" for edge in run.domain) for run in runs]
    return condition_rows(runs) + [
        ["particles or grains"] + [str(run.elements) for run in runs],
        ["model"] + [run.model for run in runs],
        ["domain"] + [f"{domain} m" for domain in domains],
        ["CPU time"] + [duration(run.cpu_time) for run in runs],
    ]


def run_values(run: WheelRun, histories: Path) -> dict[str, Any]:
    """Conditions and values of one run. histories: its drawn histories"""
    summary = Summary(run.folder)
    steady, errors = [], RunErrors(run).all()
    for name, value in summary.quantities.items():
        known = summary.quantity(name)
        number = errors[name].value_text(known.mean) if known else ""
        parts = errors[name].parts_text() if known else ""
        steady.append([name.replace("_", " "), number, value["unit"], parts, value.get("verdict", "")])
    info = run.results.run
    facts = [[key, info[key]] for key in ("title", "version", "started", "ranks") if key in info]
    facts.append(["script", Path(info.get("script", "")).name])
    audit = summary.content.get("audit", {})
    if audit.get("energy_scale"):
        share = abs(audit["energy_residual"] / audit["energy_scale"])
        facts.append(["wheel's energy not accounted for", f"{share:.1e} of the largest work"])
    rut = run.folder / "rut.png"
    return {
        "label": run.label,
        "line": headline(run.folder),
        "rut": rut if rut.is_file() else None,
        "histories": histories,
        "steady": steady,
        "facts": facts,
        "input": run.results.effective_input,
    }
