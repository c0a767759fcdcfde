# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post report: one self-contained HTML page on runs and their comparison, and the same numbers as CSV and HDF5."""

import base64
import html
import math
import shutil
import tempfile
from pathlib import Path

import h5py

from . import compare, compare_figures, cost, cost_table, cross_commands, histories
from .results import ResultsError
from .summary import Summary, with_error

STYLE = """
body { font: 15px/1.5 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; color: #222; background: #fff; margin: 0 auto; padding: 1.5em; max-width: 1000px; }
h1 { font-size: 25px; margin: 0 0 0.1em 0; }
h2 { font-size: 18px; margin: 2em 0 0.5em 0; border-bottom: 1px solid #ccd3da; padding-bottom: 0.2em; }
h3 { font-size: 15px; margin: 1.4em 0 0.4em 0; }
p.lead { color: #556; margin-top: 0; }
div.verdict { border-left: 5px solid #1f5a8a; background: #f1f5f9; padding: 0.7em 1em; margin: 1em 0; }
div.warning { border-left: 5px solid #c8672b; background: #fbf3ec; padding: 0.7em 1em; margin: 1em 0; }
table { border-collapse: collapse; margin: 0.5em 0 1em 0; font-size: 13.5px; }
th { text-align: left; font-weight: 600; border-bottom: 1.5px solid #556; padding: 0.25em 1.1em 0.25em 0; vertical-align: bottom; }
td { border-bottom: 1px solid #e3e7eb; padding: 0.25em 1.1em 0.25em 0; vertical-align: top; }
td.n, th.n { text-align: right; white-space: nowrap; }
figure { margin: 1em 0; } figure img { max-width: 100%; border: 0; } figcaption { font-size: 13px; color: #556; }
pre { font: 12px/1.4 "DejaVu Sans Mono", Consolas, monospace; background: #f6f7f8; padding: 0.8em; overflow-x: auto; white-space: pre-wrap; }
summary { cursor: pointer; color: #1f5a8a; }
footer { margin-top: 3em; color: #778; font-size: 12.5px; }
"""


def esc(text):
    return html.escape(str(text), quote=True)


def table(head, rows, numeric=()):
    """HTML table; numeric: columns set flush right."""
    kind = lambda k: ' class="n"' if k in numeric else ""
    cells = lambda tag, row: "".join(f"<{tag}{kind(k)}>{esc(cell)}</{tag}>" for k, cell in enumerate(row))
    return "<table>\n<tr>" + cells("th", head) + "</tr>\n" + "\n".join("<tr>" + cells("td", row) + "</tr>" for row in rows) + "\n</table>"


def picture(path, caption):
    """An image inlined, with its caption."""
    data = base64.b64encode(Path(path).read_bytes()).decode()
    kind = "svg+xml" if Path(path).suffix == ".svg" else "png"
    return f'<figure><img src="data:image/{kind};base64,{data}" alt="{esc(caption)}"/><figcaption>{esc(caption)}</figcaption></figure>'


def _number(entry, scale):
    return with_error(scale * entry.value, scale * entry.uncertainty) if math.isfinite(entry.uncertainty) else f"{scale * entry.value:.3g}"


def _results_table(result):
    parts = []
    for quantity, (name, unit, scale) in compare.QUANTITIES.items():
        rows = []
        for e in result.of(quantity):
            cell = lambda part: f"{scale * getattr(e.parts, part):.2g}" if math.isfinite(getattr(e.parts, part)) else "?"
            parts_known = [cell(p) for p in e.parts.NAMES] if e.kind == "run" else [""] * 4
            rows.append([e.source, _number(e, scale), *parts_known, compare.duration(e.cpu_time), e.note])
        parts.append(f"<h3>{esc(name[0].upper() + name[1:])}{f' [{esc(unit)}]' if unit else ''}</h3>" +
                     table(["", "value", "time", "size", "domain", "packing", "cost", ""], rows, (1, 2, 3, 4, 5, 6)))
    parts.append("<p>± is one standard deviation made of the parts that are known: time average, size of cells or grains, domain, packing; "
                 "“?” is not known, and not in the sum. Two values agree when they differ by no more than two.</p>")
    if result.tracks:
        rows = [[label, with_error(*value)] for label, value in result.tracks.items()]
        parts.append("<h3>Density under the track [kg/m³]</h3>" + table(["", "value"], rows, (1,)))
    return "\n".join(parts)


def _conditions_table(result):
    names = list(dict.fromkeys(name for run in result.runs for name in run.conditions))
    rows = [[name.replace("_", " ")] + [run.conditions[name].text() if name in run.conditions else "" for run in result.runs] for name in names]
    rows += [["ground"] + [run.ground for run in result.runs], ["discretisation"] + [run.describe_size() for run in result.runs],
             ["particles or grains"] + [str(run.elements) for run in result.runs],
             ["model"] + ["half" if run.half else "whole" for run in result.runs],
             ["domain"] + [" x ".join(f"{edge:.3g}" for edge in run.domain) + " m" for run in result.runs],
             ["CPU time"] + [compare.duration(run.cpu_time) for run in result.runs]]
    return table([""] + [run.label for run in result.runs], rows)


def _run_section(run, folder):
    parts = [f"<h2>{esc(run.label)}</h2>"]
    summary = Summary(run.folder)
    parts.append(f"<p>{esc(summary.line())}</p>")
    if (run.folder / "rut.png").is_file():
        parts.append(picture(run.folder / "rut.png", "The ground after the run."))
    drawn = folder / "histories.png"
    histories.draw(run.results, drawn)
    parts.append(picture(drawn, "Histories with the steady window's means; light bands: settling, acceleration, cruise."))
    quantities = summary.content.get("quantities", {})
    rows = [[name.replace("_", " "), with_error(v["mean"], v["standard_error"]) if v["mean"] is not None else "", v["unit"], v.get("verdict", "")]
            for name, v in quantities.items()]
    parts.append("<h3>Steady values</h3>" + table(["", "mean ± standard error", "", "steady?"], rows, (1,)))
    info = run.results.run
    rows = [[key, str(info[key])] for key in ("title", "version", "started", "ranks") if key in info]
    rows.append(["script", Path(str(info.get("script", ""))).name])
    audit = summary.content.get("audit", {})
    if audit.get("energy_scale"):
        rows.append(["wheel's energy not accounted for", f"{abs(audit['energy_residual'] / audit['energy_scale']):.1e} of the largest work"])
    parts.append("<h3>Run</h3>" + table(["", ""], rows))
    with h5py.File(run.results.file, "r") as content:
        text = content["run/effective_input"][()]
    text = text.decode() if isinstance(text, bytes) else str(text)
    parts.append(f"<details><summary>Effective input</summary><pre>{esc(text)}</pre></details>")
    return "\n".join(parts)


def page(result, title, lead, sections):
    """The whole page as text."""
    verdict = compare.overall(result)
    body = [f"<h1>{esc(title)}</h1>", f'<p class="lead">{esc(lead)}</p>']
    if verdict:
        points = "".join(f"<li>{esc(t)}</li>" for t in [t for t, _ in result.verdicts] + ["Besides: " + t for t in result.besides])
        body.append(f'<div class="verdict"><strong>{esc(verdict)}</strong><ul>{points}</ul></div>')
    if result.differences:
        body.append('<div class="warning"><strong>Compared although conditions differ.</strong><ul>' +
                    "".join(f"<li>{esc(name)}: {esc(t)}</li>" for name, t in result.differences) + "</ul></div>")
    body += sections
    return ("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width\"/>\n"
            f"<title>{esc(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n" + "\n".join(body) + "\n</body>\n</html>\n")


def write(arguments):
    """The subcommand: report.html with report.csv and report.h5 beside it."""
    result = cross_commands.compared(arguments)
    runs = result.runs
    target = arguments.output or (runs[0].folder / "report.html" if len(runs) == 1 else runs[0].folder.resolve().parent / "report.html")
    if target.suffix != ".html":
        raise ResultsError(f"{target}: a report's name ends in .html")
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        compare.write(result, folder / "numbers")
        compare_figures.draw(result, folder / "compare.png")
        c = runs[0].conditions
        lead = f"{c['wheel'].value} {c['wheel_diameter'].text()} x {c['wheel_width'].text()}, load {c['load'].text()}, {c['speed'].text()}"
        sections = ["<h2>Results</h2>", _results_table(result),
                    picture(folder / "compare.png", "a, b: values with two standard deviations. c to e: histories, datum of the sinkage the top of the "
                            "undisturbed ground. Below: density, same scale; grains are smoothed over about one grain."),
                    "<h2>Conditions and discretisation</h2>", _conditions_table(result)]
        if arguments.errors:
            rows, _ = cost_table.read(arguments.errors)
            assessed = cost.assess(rows)
            cost.draw(assessed, 0.1, folder / "cost.png")
            sections += ["<h2>Error against cost</h2>", "".join(f"<p>{esc(line)}</p>" for line in cost.advice(assessed, 0.1)),
                         picture(folder / "cost.png", "Numerical error of the runs of this scene against their cost; values against size.")]
        sections += [_run_section(run, folder) for run in runs]
        sections.append("<footer>Furrow " + esc(runs[0].results.run.get("version", "")) + ", furrow-post report. The numbers of this page: " +
                        f"{esc(target.with_suffix('.csv').name)}, {esc(target.with_suffix('.h5').name)}. SI units; slip positive when driving, "
                        "(v_rim - v)/max(|v_rim|, |v|).</footer>")
        title = runs[0].results.title if len(runs) == 1 else " and ".join(run.label for run in runs)
        target.write_text(page(result, title, lead, sections), encoding="utf-8")
        shutil.copyfile(folder / "numbers" / "compare.csv", target.with_suffix(".csv"))
        shutil.copyfile(folder / "numbers" / "compare.h5", target.with_suffix(".h5"))
    print(f"{target}, {target.with_suffix('.csv').name}, {target.with_suffix('.h5').name}")
