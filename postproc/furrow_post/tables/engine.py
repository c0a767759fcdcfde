# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables, figures and limits of a study.

`tables` in a study.yaml lists them by file name. A table of runs has

    runs: [stage, name, pattern*]   whose runs have rows, in the order of the study
    failed: [column, ...]           what rows of failed runs have; "all" columns
    measure: {name: {argument: value}, ...}
    expand: expression              list of mappings, a row for each
    let: {name: expression}         further names for the columns
    where: expression               of the rows that are kept
    columns: {name: expression}
    blocks: [{runs, measure, columns}, ...]   several groups of runs, each with further keys
    rows: function or "= list"      in place of runs: rows of other numbers

A measure is a function of the run in a file *_measures.py or in the study's evaluate.py, or resistance
(furrow-resistance): its numbers, or a list of them, one per row. An expression sees them, `reference` (columns of
reference.csv), the names of RUN, the functions of evaluate.py, and the constants of the study and of `with`. An
argument that begins with "=" is an expression. "*": measure has a column for each of its numbers.

A table made of others has

    of: file or [files]     of the study, or ../other_study/file; texts: columns that stay text as a stored file has them
    do: [{operation: {argument: value}}, ...]   of operations.py, or a function of evaluate.py
    columns: {name: expression}

Such a table is made of the cells that its sources store; one whose name has no ending is not stored itself. `figures` are of panels.py. `limits` list
{table, where, holds, message}: the message, with names in braces, for each row for which `holds` is not true;
{table, where, least, absent}: this message where fewer rows meet the condition;
{table, key, repeats: [columns], within}: rows that differ from the stored ones by more than this share.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from inspect import isfunction, signature
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pandas

from ..csv_table import read_comments, rows_text
from ..errors import ResultsError, refuse_others
from ..study.definition import cases_of, evaluation_of
from ..study.runs import Run, Runs
from ..study.study import Study
from ..study.study_files import Output
from ..study.values import DEFINITION, load_yaml
from . import element_measures, ground_measures, panels, tyre_measures, wheel_measures
from .frames import Row, cell, filled, frame_of, plain, read_frame, rows_of, value_of
from .operations import OPERATIONS, Known, cells, select, transpose

RUN = "name, last, what, arguments, stage, seconds, cpu, cpu_time, error, v (variables), facts"
BLOCK_KEYS = {"runs", "rows", "failed", "measure", "expand", "let", "where", "columns", "with"}
TABLE_KEYS = BLOCK_KEYS | {"blocks", "of", "texts", "do", "comments", "transpose"}

LIMIT_KEYS = {"table", "where", "holds", "message", "least", "absent", "key", "repeats", "within"}

Spec = Mapping[str, Any]


def measures(first: str) -> Mapping[str, Callable[..., Any]]:
    """Functions of the files *_measures.py whose first argument has this name."""
    return {
        name: value
        for module in (element_measures, ground_measures, tyre_measures, wheel_measures)
        for name, value in vars(module).items()
        if isfunction(value) and value.__module__ == module.__name__ and not name.startswith("_")
        if next(iter(signature(value).parameters)) == first
    }


MEASURES, MEASURES_OF_ALL = measures("run"), measures("runs")  # of one run, and of all runs of a study


class Variables(SimpleNamespace):
    """Variables of a run's script as it was started."""

    def get(self, name: str, default: Any = None) -> Any:
        return getattr(self, name, default)


class Tables(dict[str, pandas.DataFrame]):
    """Tables by file name: those made in this evaluation, else those stored next to study.yaml. A table whose name has
    no ending is made of others and not stored."""

    def __init__(self, engine: "Engine") -> None:
        super().__init__()
        self.engine = engine

    def __missing__(self, name: str) -> pandas.DataFrame:
        path = self.engine.folder / name
        if "of" in self.engine.tables.get(name, {}) and not path.suffix:
            self[name] = self.engine.derived(name, self)
        elif path.is_file():
            self[name] = read_frame(path)
        else:
            raise ResultsError(f"{path}: no such table; the study lists its tables before it uses them")
        return self[name]


class Engine:
    """The evaluation of one study. content: of its study.yaml; module: its evaluate.py or None."""

    def __init__(self, folder: Path, content: Spec, module: ModuleType | None) -> None:
        self.folder, self.content, self.module = folder, content, module
        own = {name: value for name, value in vars(module).items() if name.islower() and callable(value)} if module else {}
        self.constants: Row = {"folder": folder, **own, **(content.get("constants") or {})}
        if (folder / "reference.csv").is_file():
            reference = read_frame(folder / "reference.csv")
            one = len(reference) == 1
            columns = {str(name): plain(reference[name][0]) if one else reference[name].to_numpy() for name in reference}
            self.constants["reference"] = SimpleNamespace(**columns)
        self.constants = filled(self.constants, self.constants, self.where("constants"))
        for name, spec in self.tables.items():
            refuse_others(self.where(name), spec, TABLE_KEYS)

    @property
    def tables(self) -> Mapping[str, Spec]:
        found: Mapping[str, Spec] = self.content.get("tables") or {}
        return found

    def where(self, name: str) -> str:
        return f"{self.folder / 'study.yaml'}: {name}"

    def names(self, spec: Spec, tables: Mapping[str, pandas.DataFrame]) -> Row:
        """Names in expressions of a table or block: constants of the study and its own, and all tables."""
        return {**self.constants, "tables": tables, **(spec.get("with") or {})}

    def function(self, name: str, known: Mapping[str, Callable[..., Any]], what: str) -> Callable[..., Any]:
        """Function of evaluate.py, or of the package. @raises ResultsError"""
        found = getattr(self.module, name, None) or known.get(name)
        if found is None:
            raise ResultsError(f"{self.where(what)}: there is no {name}; known are {', '.join(sorted(known))}")
        function: Callable[..., Any] = found
        return function

    def measure(self, name: str, runs: Runs, what: str) -> Callable[..., Any]:
        """Measure of evaluate.py or of the package; resistance: lines that furrow-resistance prints, a row for each."""

        def resistance(run: Run, options: Sequence[object] = ("--csv",)) -> list[Row]:
            return [dict(line) for line in runs.resistance(run, *options)]

        return self.function(name, {**MEASURES, "resistance": resistance}, what)

    # ---- rows of runs

    def rows(self, runs: Runs, name: str, tables: Mapping[str, pandas.DataFrame]) -> list[Row]:
        """Rows of a table of runs."""
        spec = self.tables[name]
        common = {key: value for key, value in spec.items() if key in BLOCK_KEYS}
        blocks = [
            {**common, **block, "columns": {**(common.get("columns") or {}), **(block.get("columns") or {})}}
            for block in spec.get("blocks") or [{}]
        ]
        found = [row for block in blocks for row in self.rows_of_block(runs, block, name, tables)]
        return [{column: plain(value) for column, value in row.items()} for row in found]

    def rows_of_block(
        self, runs: Runs, block: Spec, name: str, tables: Mapping[str, pandas.DataFrame]
    ) -> Iterator[Row]:
        if "rows" not in block:
            for run in self.chosen(runs, block):
                yield from self.rows_of_run(runs, run, block, name, tables)
            return
        names = self.names(block, tables)
        made = block["rows"]
        if isinstance(made, str) and made.startswith("="):
            rows = filled(made, names, self.where(name))
        else:
            called = filled({made: {}} if isinstance(made, str) else made, names, self.where(name))
            rows = [row for one, given in called.items() for row in self.function(one, MEASURES_OF_ALL, name)(runs, **given)]
        for row in rows:
            yield cells({**names, **row}, block["columns"], self.where(name)) if block.get("columns") else row

    def chosen(self, runs: Runs, block: Spec) -> list[Run]:
        names = panels.listed(block.get("runs", "*"))
        return runs.ended(*names) if block.get("failed") else runs.done(*names)

    def rows_of_run(
        self, runs: Runs, run: Run, block: Spec, name: str, tables: Mapping[str, pandas.DataFrame]
    ) -> Iterator[Row]:
        where = f"{self.where(name)}, run {run.name}"
        names = {**self.names(block, tables), **names_of(run)}
        columns = block.get("columns") or {}
        whole = not run.error or block["failed"] == "all"  # with all columns
        if not whole:
            columns = {column: columns[column] for column in block["failed"]}
        try:
            found = [{**names, **part} for part in self.measured(runs, run, block, name, names)]
        except ResultsError:
            if not run.error:
                raise
            found = [] if whole else [names]  # the run failed before its first row
        else:
            if "expand" in block:
                found = [{**one, **more} for one in found for more in value_of(block["expand"], one, where)]
        for known in found:
            if whole:
                known |= cells(known, block.get("let") or {}, where)
            if value_of(block.get("where", True), known, where):
                row: Row = {}
                for column, text in columns.items():
                    row |= known[f"all of {text}"] if column == "*" else cells({**row, **known}, {column: text}, where)
                yield row

    def measured(self, runs: Runs, run: Run, block: Spec, name: str, names: Row) -> list[Row]:
        """Numbers of all measures of a block, each row of one with each row of the others."""
        parts: list[Row] = [{}]
        wanted = block.get("measure") or {}
        for one, arguments in ({wanted: {}} if isinstance(wanted, str) else wanted).items():
            if parts:  # a measure can have no rows
                given = filled(arguments or {}, {**names, **parts[0]}, f"{self.where(name)}, run {run.name}")
                found = self.measure(one, runs, name)(run, **given)
                several = found if isinstance(found, list) else [found]
                parts = [{**part, **more, f"all of {one}": more} for part in parts for more in several]
        return parts

    # ---- tables of tables

    def is_of_stored(self, name: str) -> bool:
        """True where a table can be made of stored ones: none of its sources is a table of runs that is not stored."""
        spec = self.tables.get(name)
        if spec is None or Path(name).suffix and "of" not in spec:
            return True
        if "of" not in spec:
            return False
        steps = [one for step in spec.get("do") or [] if isinstance(step, Mapping) for one in step.values()]
        joined = [one["table"] for one in steps if isinstance(one, Mapping) and "table" in one]
        return all(self.is_of_stored(one) for one in (*panels.listed(spec["of"]), *joined))

    def derived(self, name: str, tables: Tables) -> pandas.DataFrame:
        """Computes a table from other tables."""
        spec = self.tables[name]
        sources = [spec["of"]] if isinstance(spec["of"], str) else spec["of"]
        texts = spec.get("texts") or []
        frame = pandas.concat(
            [read_frame(self.folder / one, texts) if texts else tables[one] for one in sources], ignore_index=True
        )
        known = Known(tables, self.names(spec, tables))
        for step in spec.get("do") or []:
            if not len(frame):
                return frame
            for one, arguments in ({step: {}} if isinstance(step, str) else step).items():
                operation = self.function(one, OPERATIONS, name)
                given = {"condition": arguments} if isinstance(arguments, str) else arguments or {}
                frame = operation(frame, known, **filled(given, known.constants, self.where(name)))
        if len(frame) and spec.get("columns"):
            frame = select(frame, known, **{str(name): text for name, text in spec["columns"].items()})
        return frame

    def text(self, name: str, tables: Tables) -> str:
        """A table made of others as its file has it."""
        path = self.folder / name
        return rows_text(rows_of(self.derived(name, tables)), self.comments(name, path))

    def comments(self, name: str, path: Path) -> Sequence[str]:
        given: Sequence[str] | None = self.tables[name].get("comments")
        return given if given is not None else read_comments(path) if path.is_file() else ()

    # ---- all

    def evaluate(self, runs: Runs, output: Output) -> list[str]:
        """Writes tables and figures of the runs that are there; what misses a limit."""
        tables = Tables(self)
        for name, spec in self.tables.items():
            if not Path(name).suffix:
                if "of" not in spec:
                    tables[name] = frame_of(self.rows(runs, name, tables))
                continue
            if "of" in spec:
                rows = rows_of(self.derived(name, tables))
                known: Sequence[Mapping[str, Any]] = rows
                if self.is_of_stored(name):
                    output.of_all_runs(name)
            else:
                rows = self.rows(runs, name, tables)
                if key := spec.get("transpose"):
                    rows = rows_of(transpose(pandas.DataFrame(rows, dtype=object), Known({}, {}), key)) if rows else []
                known = output.known(name, rows)
            output.table(name, rows, self.comments(name, self.folder / name))
            tables[name] = frame_of(known)
        for name, spec in (self.content.get("figures") or {}).items():
            self.draw(name, spec, runs, tables, output)
        return list(self.missed(tables))

    def draw(self, name: str, spec: Spec, runs: Runs, tables: Tables, output: Output) -> None:
        """Draws a figure; skips it if a table has no rows or a line no run."""
        sources = panels.sources_of(spec)
        if any("table" in one and one["table"] in self.tables and not len(tables[one["table"]]) for one in sources):
            return
        if any("runs" in one and not runs.ended(*panels.listed(one["runs"])) for one in sources):
            return
        if sources and not any("runs" in one for one in sources):
            output.of_all_runs(name)
        if "draw" in spec:
            function = self.function(spec["draw"], panels.DRAWINGS, name)
            given = {**(spec.get("with") or {}), **({"names": panels.listed(spec["runs"])} if "runs" in spec else {})}
            if "{run}" in name:  # a file for each run
                function(runs, tables, output, file=name, **given)
            else:
                function(runs, tables, output.path(name), **given)
                if not output.path(name).is_file():
                    output.files.remove(name)  # no run of the table is stored
        else:
            curve = partial(self.curve, runs)
            panels.draw(spec, panels.Sources(runs, tables, {**self.constants, "tables": tables}, names_of, curve), output.path(name))

    def curve(self, runs: Runs, name: str, run: Run, arguments: Spec) -> Row:
        """Numbers of a run for a line of a figure; columns of several rows."""
        measure = self.measure(name, runs, "figures")
        found = measure(run, **filled(arguments, {**self.constants, **names_of(run)}, "figures"))
        return {str(key): column.to_numpy() for key, column in pandas.DataFrame(found).items()} if isinstance(found, list) else dict(found)

    def missed(self, tables: Tables) -> Iterator[str]:
        """A sentence for each limit that is missed."""
        for limit in self.content.get("limits") or []:
            refuse_others(self.where("a limit"), limit, LIMIT_KEYS)
            frame = self.made_or_stored(limit["table"], tables)
            if "repeats" in limit:
                yield from self.changed(limit, frame)
                continue
            found = 0
            for row in frame.to_dict("records"):
                names = {**self.constants, **{str(key): value for key, value in row.items()}}
                if value_of(limit.get("where", True), names, "limits"):
                    found += 1
                    if not value_of(limit.get("holds", True), names, "limits"):
                        yield str(limit["message"]).format(**names)
            if found < limit.get("least", 0):
                yield limit["absent"]

    def made_or_stored(self, name: str, tables: Tables) -> pandas.DataFrame:
        """A table of this evaluation; the stored one, if no run of it is there."""
        frame, path = tables[name], self.folder / name
        return frame if len(frame) or not path.is_file() else read_frame(path)

    def changed(self, limit: Spec, frame: pandas.DataFrame) -> Iterator[str]:
        """Differences of rows made again from the stored ones."""
        path, key = self.folder / limit["table"], limit["key"]
        stored = {row[key]: row for row in read_frame(path).to_dict("records")} if path.is_file() else {}
        for row in frame.to_dict("records"):
            for column in limit["repeats"] if row[key] in stored else ():
                new, old = row[column], stored[row[key]][column]
                if abs(new - old) > limit["within"] * abs(old):
                    yield f"{row[key]}: {column} {new} was {old}; the table is of another program"


def names_of(run: Run) -> Row:
    """Names that an expression can use for a run."""
    variables = {name: cell(str(value)) for name, value in {**run.case.variables, **run.record.changes}.items()}
    return {
        "name": run.name,
        "last": run.name.rpartition("/")[2],
        "what": run.what,
        "arguments": [str(word) for word in run.case.arguments],
        "stage": run.case.stage,
        "seconds": run.seconds,
        "cpu": round(run.record.cpu_time + run.record.system_time, 1),
        "cpu_time": run.record.cpu_time,
        "error": run.error,
        "v": Variables(**variables),
        "facts": SimpleNamespace(**run.record.facts),
    }


def load_study(folder: Path) -> Study:
    """A study with its runs and its evaluation: the tables of study.yaml, or evaluate(runs, output) of evaluate.py.

    @raises ResultsError
    """
    folder = folder.resolve()
    content = load_yaml(folder / DEFINITION)
    module = evaluation_of(folder)
    cases = tuple(module.cases()) if module and hasattr(module, "cases") else cases_of(folder, content)
    evaluate = getattr(module, "evaluate", None) or Engine(folder, content, module).evaluate
    return Study(folder, cases, evaluate, content.get("checked"))
