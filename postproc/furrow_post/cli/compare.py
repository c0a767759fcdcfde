# SPDX-License-Identifier: GPL-2.0-or-later
"""The subcommands of furrow-post that lay runs beside each other and beside formulas: empirical, compare, cost, report."""

from pathlib import Path

from .results import ResultsError


def fraction(text):
    """0.1 of "10%" or "0.1"."""
    value = float(text[:-1]) / 100 if text.endswith("%") else float(text)
    if not 0 < value < 1:
        raise ValueError
    return value


def _needs(arguments, *names):
    missing = [name for name in names if getattr(arguments, name) is None]
    if missing:
        raise ResultsError(f"empirical {arguments.method} needs " + ", ".join(f"--{name}" for name in missing))
    return [getattr(arguments, name) for name in names]


def _empirical(arguments):
    from . import empirical

    outside = arguments.extrapolate
    if arguments.method == "nrmm":
        load, diameter, width, depth, density, pressure = _needs(arguments, "load", "diameter", "width", "depth", "density", "pressure")
        prediction = empirical.nrmm(load, 0.5 * diameter, width, depth, density, pressure, arguments.sinkage, outside)
    else:
        load, diameter, width, name = _needs(arguments, "load", "diameter", "width", "terrain")
        ground = empirical.terrain(name)
        prediction = empirical.bekker(load, diameter, width, ground, outside) if arguments.method == "bekker" else \
            empirical.wong_reece(load, diameter, width, *_needs(arguments, "slip"), ground, outside)
    print(empirical.text(prediction))


def formulas_for(run, words, extrapolate):
    """Predictions for a run: "nrmm:<pressure in Pa>", "bekker:<terrain>", "wong_reece:<terrain>"."""
    from . import empirical

    value = {name: condition.value for name, condition in run.conditions.items()}
    found = []
    for word in words:
        method, _, what = word.partition(":")
        if method == "nrmm":
            if "density" not in value:
                raise ResultsError(f"{run.label}: the density of its ground is not known; NRMM needs it")
            found.append(empirical.nrmm(value["load"], run.radius, value["wheel_width"], value["depth"], value["density"],
                                        float(what or "nan"), extrapolate=extrapolate))
        elif method == "bekker":
            found.append(empirical.bekker(value["load"], 2 * run.radius, value["wheel_width"], empirical.terrain(what), extrapolate))
        elif method == "wong_reece":
            found.append(empirical.wong_reece(value["load"], 2 * run.radius, value["wheel_width"], value["slip"], empirical.terrain(what),
                                              extrapolate))
        else:
            raise ResultsError(f"there is no formula '{method}'; there are nrmm:PRESSURE, bekker:TERRAIN, wong_reece:TERRAIN")
    return found


def _labelled(words):
    """[(folder, label or None)] of FOLDER or LABEL=FOLDER."""
    return [(tail, head) if equals else (head, None) for head, equals, tail in (word.partition("=") for word in words)]


def compared(arguments):
    """The Comparison that the arguments of compare or report ask for."""
    from . import compare, conditions, cost_table

    runs = [conditions.read(folder, label) for folder, label in _labelled(arguments.results)]
    table = cost_table.read(arguments.errors)[0] if arguments.errors else None
    formulas = formulas_for(runs[0], arguments.formula, arguments.extrapolate)
    return compare.compare(runs, table, formulas, arguments.measured, arguments.anyway)


def _compare(arguments):
    from . import compare, compare_figures, curves

    folders = [folder for folder, _ in _labelled(arguments.results)]
    target = arguments.output or Path(folders[0]).resolve().parent / "compare"
    if curves.is_curve(folders[0]):
        result = curves.compare([curves.read(folder, label) for folder, label in _labelled(arguments.results)], arguments.anyway)
        curves.write(result, target)
        curves.draw(result, target / "compare.png")
        print(curves.text(result))
    else:
        result = compared(arguments)
        compare.write(result, target)
        compare_figures.draw(result, target / "compare.png")
        print(compare.text(result))
    print(f"\n{target}/compare.png, compare.txt, compare.csv, compare.h5")


def _cost(arguments):
    from . import conditions, cost, cost_table

    rows, comments = [], []
    for word in arguments.results:
        if Path(word).suffix == ".csv":
            more, head = cost_table.read(word)
            rows, comments = rows + more, comments + head
        else:
            (folder, label), = _labelled([word])
            rows.append(cost_table.row_of(conditions.read(folder, label)))
    if arguments.write:
        cost_table.write(arguments.write, rows, comments)
    assessed = cost.assess(rows, cost_table.wanted_wheel(comments))
    print(cost.text(assessed, arguments.error))
    target = arguments.output or Path("cost.png")
    cost.draw(assessed, arguments.error, target)
    cost.write_csv(target.with_suffix(".csv"), assessed)
    print(f"\n{target}, {target.with_suffix('.csv')}")


def _choose(arguments):
    """For inputs/run --error: the options of the choice on stdout, the reasons on stderr."""
    from . import choose

    choose.command(arguments)


def _report(arguments):
    from . import report

    report.write(arguments)


def add(commands):
    """Registers the subcommands."""
    text = "what an empirical formula says: NRMM for snow, Bekker and Wong-Reece for sand"
    empirical = commands.add_parser("empirical", help=text, description=text)
    empirical.add_argument("method", choices=("nrmm", "bekker", "wong_reece"))
    for name, unit in (("load", "N"), ("diameter", "m"), ("width", "m"), ("depth", "m, of the snow"), ("density", "kg/m3, of the snow"),
                       ("pressure", "Pa, largest contact pressure on snow"), ("sinkage", "m, measured, instead of NRMM's own"),
                       ("slip", "1 - v/(r omega), of a driven wheel")):
        empirical.add_argument(f"--{name}", type=float, help=unit)
    empirical.add_argument("--terrain", help="name in furrow_post/terrains.csv, e.g. 'LETE sand'")
    empirical.add_argument("--extrapolate", action="store_true", help="answer outside of the range of validity too, and say so")
    empirical.set_defaults(run=_empirical)

    text = "the same scene on several grounds: table, verdict, figure -> compare.txt, .csv, .h5, .png"
    compare = commands.add_parser("compare", help=text, description=text)
    text = "one self-contained page on runs and their comparison -> report.html, report.csv, report.h5"
    report = commands.add_parser("report", help=text, description=text)
    for command in (compare, report):
        command.add_argument("results", nargs="+", help="results folder, or LABEL=FOLDER")
        command.add_argument("--errors", type=Path, help="table of runs of the scene (inputs/costs): errors of size, domain, packing")
        command.add_argument("--formula", action="append", default=[],
                             help="nrmm:PRESSURE, bekker:TERRAIN or wong_reece:TERRAIN; may be repeated")
        command.add_argument("--measured", type=Path, help="reference.csv with depth_m, sinkage_m, resistance, density_kgm3")
        command.add_argument("--extrapolate", action="store_true", help="formulas outside of their range of validity too")
        command.add_argument("--anyway", action="store_true", help="compare runs whose conditions differ")
    compare.add_argument("-o", "--output", type=Path, help="folder to write (default: compare beside the first)")
    compare.set_defaults(run=_compare)
    report.add_argument("-o", "--output", type=Path, help="page to write (default: report.html in or beside the results)")
    report.set_defaults(run=_report)

    text = "error against cost of the runs of a scene, and which to take -> cost.png, cost.csv"
    cost = commands.add_parser("cost", help=text, description=text)
    cost.add_argument("results", nargs="+", help="results folders (LABEL=FOLDER), or a table of inputs/costs")
    cost.add_argument("--error", type=fraction, default=0.1, help="wanted relative error, e.g. 10%% (default)")
    cost.add_argument("--write", type=Path, help="also write the table of runs, as inputs/costs has them")
    cost.add_argument("-o", "--output", type=Path, help="figure (default: cost.png)")
    cost.set_defaults(run=_cost)

    choose = commands.add_parser("choose", help="for 'inputs/run SCENE --error': the run of a table to make, and whether its estimate held")
    choose.add_argument("table", type=Path)
    choose.add_argument("--error", type=fraction, required=True)
    choose.add_argument("--held", type=Path, help="results folder of the run that was chosen")
    choose.set_defaults(run=_choose)
