# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of the HTML page of a report: tables, inlined pictures, the frame."""

import base64
import html
from collections.abc import Collection, Iterable, Sequence
from pathlib import Path

from ..analyse.comparison import Comparison, overall
from ..analyse.comparison_report import component_cells, findings
from ..analyse.verdict import QUANTITIES
from ..formatting import duration, in_unit, with_error
from ..run.summary import Summary
from ..read.wheel_run import WheelRun

STYLE = """
body { font: 15px/1.5 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; color: #222;
  background: #fff; margin: 0 auto; padding: 1.5em; max-width: 1000px; }
h1 { font-size: 25px; margin: 0 0 0.1em 0; }
h2 { font-size: 18px; margin: 2em 0 0.5em 0; border-bottom: 1px solid #ccd3da;
  padding-bottom: 0.2em; }
h3 { font-size: 15px; margin: 1.4em 0 0.4em 0; }
p.lead { color: #556; margin-top: 0; }
div.verdict { border-left: 5px solid #1f5a8a; background: #f1f5f9; padding: 0.7em 1em;
  margin: 1em 0; }
div.warning { border-left: 5px solid #c8672b; background: #fbf3ec; padding: 0.7em 1em;
  margin: 1em 0; }
table { border-collapse: collapse; margin: 0.5em 0 1em 0; font-size: 13.5px; }
th { text-align: left; font-weight: 600; border-bottom: 1.5px solid #556;
  padding: 0.25em 1.1em 0.25em 0; vertical-align: bottom; }
td { border-bottom: 1px solid #e3e7eb; padding: 0.25em 1.1em 0.25em 0; vertical-align: top; }
td.n, th.n { text-align: right; white-space: nowrap; }
figure { margin: 1em 0; } figure img { max-width: 100%; border: 0; }
figcaption { font-size: 13px; color: #556; }
pre { font: 12px/1.4 "DejaVu Sans Mono", Consolas, monospace; background: #f6f7f8;
  padding: 0.8em; overflow-x: auto; white-space: pre-wrap; }
summary { cursor: pointer; color: #1f5a8a; }
footer { margin-top: 3em; color: #778; font-size: 12.5px; }
"""


def escaped(text: object) -> str:
    return html.escape(str(text), quote=True)


def paragraph(text: str) -> str:
    return f"<p>{escaped(text)}</p>"


def html_table(
    head: Sequence[str], rows: Iterable[Sequence[str]], numeric: Collection[int] = ()
) -> str:
    """numeric: columns that are set flush right."""

    def line(tag: str, cells: Sequence[str]) -> str:
        flush_right = ' class="n"'
        return "".join(
            f"<{tag}{flush_right if k in numeric else ''}>{escaped(cell)}</{tag}>"
            for k, cell in enumerate(cells)
        )

    body = "\n".join(f"<tr>{line('td', row)}</tr>" for row in rows)
    return f"<table>\n<tr>{line('th', head)}</tr>\n{body}\n</table>"


def inline_picture(path: Path, caption: str) -> str:
    """An image as data in the page, with its caption."""
    data = base64.b64encode(path.read_bytes()).decode()
    kind = "svg+xml" if path.suffix == ".svg" else "png"
    text = escaped(caption)
    image = f'<img src="data:image/{kind};base64,{data}" alt="{text}"/>'
    return f"<figure>{image}<figcaption>{text}</figcaption></figure>"


def results_tables(result: Comparison) -> str:
    """Every quantity of every run, formula and measurement with its uncertainty."""
    parts = []
    for quantity in QUANTITIES:
        rows = [
            [e.label, e.text(), *component_cells(e), duration(e.cpu_time), e.note]
            for e in result.of(quantity)
        ]
        name = quantity.name[0].upper() + quantity.name[1:] + in_unit(quantity.unit)
        head = ["", "value", "time", "size", "domain", "packing", "cost", ""]
        parts.append(f"<h3>{escaped(name)}</h3>{html_table(head, rows, range(1, 7))}")
    parts.append(
        "<p>± is one standard error made of the parts that are known: time average, size of cells or "
        "grains, domain, packing; “?” is not known, and not in the sum. Two values agree when all "
        "parts are known and they differ by no more than two standard errors.</p>"
    )
    if result.tracks:
        rows = [[label, with_error(*track)] for label, track in result.tracks.items()]
        table = html_table(["", "value"], rows, (1,))
        parts.append(f"<h3>Density under the track [kg/m³]</h3>{table}")
    return "\n".join(parts)


def condition_rows(runs: Sequence[WheelRun], but: str = "") -> list[list[str]]:
    """Conditions, ground and discretisation of the runs, a row each; but: without this one."""
    names = dict.fromkeys(name for run in runs for name in run.conditions if name != but)
    return [
        *([name.replace("_", " "), *(run.text(name) for run in runs)] for name in names),
        ["ground", *(run.ground for run in runs)],
        ["discretisation", *(run.describe_size() for run in runs)],
    ]


def conditions_table(result: Comparison) -> str:
    """Conditions, discretisation and cost of the runs."""
    runs = result.runs
    domains = [" x ".join(f"{edge:.3g}" for edge in run.domain) for run in runs]
    rows = condition_rows(runs) + [
        ["particles or grains"] + [str(run.elements) for run in runs],
        ["model"] + [run.model for run in runs],
        ["domain"] + [f"{domain} m" for domain in domains],
        ["CPU time"] + [duration(run.cpu_time) for run in runs],
    ]
    return html_table([""] + [run.label for run in runs], rows)


def run_section(run: WheelRun, histories: Path) -> str:
    """What one run was and gave. histories: its drawn histories"""
    summary = Summary(run.folder)
    parts = [f"<h2>{escaped(run.label)}</h2>", paragraph(summary.line())]
    if (run.folder / "rut.png").is_file():
        parts.append(inline_picture(run.folder / "rut.png", "The ground after the run."))
    caption = (
        "Histories with the steady window's means; light bands: settling, acceleration, cruise."
    )
    parts.append(inline_picture(histories, caption))
    rows = []
    for name, value in summary.quantities.items():
        steady = summary.quantity(name)
        number = with_error(steady.mean, steady.standard_error) if steady else ""
        rows.append([name.replace("_", " "), number, value["unit"], value.get("verdict", "")])
    head = ["", "mean ± standard error", "", "steady?"]
    parts.append(f"<h3>Steady values</h3>{html_table(head, rows, (1,))}")
    info = run.results.run
    rows = [[key, info[key]] for key in ("title", "version", "started", "ranks") if key in info]
    rows.append(["script", Path(info.get("script", "")).name])
    audit = summary.content.get("audit", {})
    if audit.get("energy_scale"):
        share = abs(audit["energy_residual"] / audit["energy_scale"])
        rows.append(["wheel's energy not accounted for", f"{share:.1e} of the largest work"])
    parts.append(f"<h3>Run</h3>{html_table(['', ''], rows)}")
    text = escaped(run.results.effective_input)
    parts.append(f"<details><summary>Effective input</summary><pre>{text}</pre></details>")
    return "\n".join(parts)


def footer(run: WheelRun, target: Path) -> str:
    """target: the page, beside which its numbers lie."""
    numbers = f"{target.with_suffix('.csv').name}, {target.with_suffix('.h5').name}"
    return (
        f"<footer>Furrow {escaped(run.results.run.get('version', ''))}, furrow-post report. The "
        f"numbers of this page: {escaped(numbers)}. SI units; slip positive when driving, (v_rim - "
        "v)/max(|v_rim|, |v|).</footer>"
    )


def page(
    result: Comparison, title: str, lead: str, sections: Iterable[str], style: str = ""
) -> str:
    """The whole page: title, verdict, warnings, sections. style: CSS of the sections"""
    body = []
    verdict = overall(result)
    if verdict:
        points = "".join(f"<li>{escaped(sentence)}</li>" for sentence in findings(result))
        body.append(
            f'<div class="verdict"><strong>{escaped(verdict)}</strong><ul>{points}</ul></div>'
        )
    if result.differences:
        points = "".join(
            f"<li>{escaped(f'{d.condition}: {d.text}')}</li>" for d in result.differences
        )
        body.append(
            '<div class="warning"><strong>Compared although conditions differ.</strong>'
            f"<ul>{points}</ul></div>"
        )
    return document(title, lead, [*body, *sections], style)


def document(title: str, lead: str, sections: Iterable[str], style: str = "") -> str:
    """A page that needs no other file. lead: may be empty; style: CSS beside that of all pages"""
    head = [f"<h1>{escaped(title)}</h1>", f'<p class="lead">{escaped(lead)}</p>' if lead else ""]
    return html_page(title, "\n".join([*head, *sections]), style)


def html_page(title: str, content: str, style: str = "") -> str:
    """The frame of a page. style: CSS beside that of all pages"""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8"/>\n'
        '<meta name="viewport" content="width=device-width"/>\n<link rel="icon" href="data:,"/>\n'
        f"<title>{escaped(title)}</title>\n<style>{STYLE}{style}</style>\n</head>\n<body>\n"
        f"{content}\n</body>\n</html>\n"
    )
