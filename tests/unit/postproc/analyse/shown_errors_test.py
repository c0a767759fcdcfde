# SPDX-License-Identifier: GPL-2.0-or-later
"""No number is shown with an error that is smaller than its known parts: committed tables and pages, texts of a run."""

import math
import re
import unittest
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

from furrow_post.analyse import comparison
from furrow_post.analyse.comparison import compare, comparison_report, table_rows
from furrow_post.uncertainty.whole_error import SIZES, RunErrors, headline, report
from furrow_post.csv_table import read_rows
from furrow_post.figures.page import results_tables, run_values
from furrow_post.read.wheel_run import Condition, WheelRun, read_wheel_run
from furrow_post.scene.scene_summary import verdict_line
from furrow_post.sweep.series import quantities
from support.command import SOURCE
from support.folder import FolderTest
from support.runs import write_run

ROUNDING = 0.8  # of an error with one digit: 2 of 2.49
SHOWN = re.compile(r"(-?[\d.]+) ± ([\d.]+)")
OF_SERIES = re.compile(r"hub drop|sinkage|coefficient|traction", re.I)  # other quantities have the same digits by chance


def root_sum_square(row: dict[str, str], columns: list[str]) -> float:
    return math.hypot(*(float(row[column] or 0) for column in columns))


INPUTS = SOURCE / "inputs"
STATED = re.compile(r"(?i)errors? (is|are|have|has|contain|contains|cover|covers|of|on|with|from|within)\b|(standard|their|its|rms) errors?\b")


def size_errors() -> dict[str, float]:
    """Values of the size series as pages and tables show them -> numerical error in that unit."""
    known: dict[str, float] = {}
    for series in SIZES.stored():
        for row in series.family.bases:
            for key, scale, digits in (("sinkage", 1e3, 1), ("coefficient", 1.0, 3)):
                parts = series.family.components(key, row.size, row.value(key)[1])
                known[f"{scale * row.value(key)[0]:.{digits}f}"] = scale * parts.total
    return known


def rows_of_series(page: str) -> Iterator[str]:
    """Rows of tables in Markdown whose head or cells name a quantity of the size series."""
    head = ""
    for line in re.sub("<!-- value: .*?<!-- end value -->", "", page).splitlines():
        head = (head or line) if line.startswith("|") else ""
        if head and OF_SERIES.search(head + line):
            yield line


def tables() -> list[Path]:
    found = [path for folder in ("costs", "crosscheck", "validation") for path in sorted((INPUTS / folder).rglob("*.csv"))]
    return [path for path in found if path.name not in ("errors.csv", "provenance.csv") and "parts" not in path.parts]


class CommittedTest(unittest.TestCase):
    def test_every_error_column_has_a_meaning(self) -> None:
        listed: dict[str, set[str]] = {}
        for row in read_rows(INPUTS / "validation" / "errors.csv"):
            self.assertTrue(row["holds"], row)
            listed.setdefault(row["table"], set()).update(row["columns"].split())
        for path in tables():
            columns = read_rows(path)[0] if read_rows(path) else {}
            errors = {name for name in columns if "error" in name.split("_")}
            known = listed.pop(path.relative_to(INPUTS).as_posix(), set())
            self.assertEqual(errors - known, set(), f"{path}: what do these columns hold? See inputs/validation/errors.csv")
            self.assertEqual(known - set(columns), set(), path)
        self.assertEqual(listed, {}, "errors.csv has tables that do not exist")

    def test_errors_of_cells_are_not_below_the_known_ones(self) -> None:
        known, seen = size_errors(), 0
        for row in read_rows(INPUTS / "validation" / "errors.csv"):
            if not re.search("cells|grains", row["holds"]) or "change" in row["holds"]:
                continue
            for line in read_rows(INPUTS / row["table"]):
                if not OF_SERIES.search(" ".join([*line, *line.values()])):
                    continue
                for column in row["columns"].split():
                    value = line.get(re.sub("_?error_?(mm)?", "", column) or "value", "")
                    whole = known.get(value.removeprefix("-"), 0.0)
                    seen += 1
                    self.assertGreaterEqual(float(line[column] or "inf"), ROUNDING * whole, (row["table"], line))
        self.assertGreater(seen, 100)

    def test_pages_show_errors_of_cells_or_state_that_errors_are_over_time(self) -> None:
        """Series of sizes have known cells or grains, packing and ground. Marked values have their parts in experiments.csv."""
        known, seen, pages, over_time = size_errors(), 0, 0, set()
        for page in (page for page in SOURCE.rglob("*.md") if page.relative_to(SOURCE).parts[0] not in ("build", "lib", "results")):
            text = page.read_text(encoding="utf-8")
            table = "\n".join(line for line in text.splitlines() if line.startswith("|"))
            if "±" in table:
                pages += 1
                self.assertRegex(text, STATED, f"{page}: what is the number behind ±?")
            if page.parent.name == "crosscheck":  # has another test
                continue
            for value, error in SHOWN.findall("\n".join(rows_of_series(text))):
                whole = known.get(value.removeprefix("-"), 0.0)
                seen += whole > 0
                if float(error) < ROUNDING * whole:
                    over_time.add(page)
                    self.assertRegex(text, r"(?i)errors? (is|are) (those |that )?(of the |over )time", f"{page}: {value} ± {error}")
        self.assertGreater(seen, 15)
        self.assertGreater(pages, 15)
        self.assertEqual({page.parent.name for page in over_time}, {"convergence", "grains"})

    def test_errors_of_the_cross_check_are_not_below_their_parts(self) -> None:
        folder = INPUTS / "crosscheck"
        page = (folder / "README.md").read_text(encoding="utf-8")
        table = [line for line in page.splitlines() if line.startswith("|") and "±" in line]
        whole: dict[float, float] = {}  # value -> its smallest whole error, of all scales that the page has
        for row in read_rows(folder / "results.csv"):
            error = root_sum_square(row, [column for column in row if column.startswith("error_")])
            for scale in (1.0, 1e3, 1e-3):
                whole[scale * float(row["value"])] = min(scale * error, whole.get(scale * float(row["value"]), math.inf))
        checked = 0
        for value, error in (map(float, pair) for line in table for pair in SHOWN.findall(line)):
            digit = 0.5 * 10.0 ** -len(str(value).partition(".")[2].rstrip("0"))
            near = [u for known, u in whole.items() if abs(known - value) <= digit and u < abs(known)]
            if near:
                self.assertGreaterEqual(error, ROUNDING * min(near), (value, error))
                checked += 1
        self.assertGreater(checked, 15)

    def test_errors_of_regimes_are_not_below_those_of_their_tests(self) -> None:
        """The error of the model and of the tests cover the mean square of the differences of each regime."""
        tests = read_rows(INPUTS / "validation" / "measured.csv")
        for regime in read_rows(INPUTS / "validation" / "model_errors.csv"):
            words = ("quantity", "ground", "wheel", "motion", "grousers")
            own = [row for row in tests if all(row[word] == regime[word] for word in words)]
            for study in {row["study"] for row in own}:
                self.assertIn(study, regime["studies"].split())
            smallest = min(float(row["difference"]) ** 2 for row in own)
            noise = max(float(row["error"]) ** 2 for row in own)
            self.assertGreaterEqual(float(regime["model"]) ** 2 + noise, smallest * 0.999, regime)


class OutputTest(FolderTest):
    def run_on_sand(self) -> WheelRun:
        write_run(self.folder / "run", torque=50.0, pull=0.1)
        run = read_wheel_run(self.folder / "run")
        run.ground, run.size = "continuum", 0.04
        run.conditions["density"] = Condition(1600.0, "kg/m3")
        return run

    def assert_whole(self, text: str, run: WheelRun) -> int:
        """Every "value ± error" of a text is one of the run, with its whole error; their number."""
        known = {}
        for name, budget in RunErrors(run).all().items():
            mean = run.values[name].mean if name in run.values else math.nan
            known[name] = (mean, math.hypot(*(budget.part(part) for part in budget.known)))
        found = 0
        for value, error in (map(float, pair) for pair in SHOWN.findall(text)):
            fits = [
                scale * whole
                for mean, whole in known.values()
                for scale in (1.0, 100.0, 1e3)
                if abs(abs(scale * mean) - abs(value)) <= max(0.51 * error, 1e-3 * abs(value)) and whole > 0
            ]
            self.assertTrue(fits, f"{value} ± {error} in {text}")
            self.assertGreaterEqual(error, ROUNDING * min(fits), f"{value} ± {error} in {text}")
            found += 1
        return found

    def test_texts_of_a_run_state_the_kind_of_error(self) -> None:
        write_run(self.folder / "run", torque=50.0, pull=0.1)
        run = read_wheel_run(self.folder / "run")
        histories = self.folder / "histories.png"
        result = compare([run])
        page = run_values(run, histories)
        texts = {
            "compare": comparison_report(result),
            "report page": "\n".join(" ".join(row[:2]) for row in page["steady"]),
            "tables of the page": "\n".join(" ".join(row) for _, rows in results_tables(result) for row in rows),
        }
        for name, text in texts.items():
            with self.subTest(text=name):
                self.assertGreaterEqual(self.assert_whole(text, run), 2)
        for line in table_rows(result):
            parts = [value for name, value in line.items() if name.startswith("u_") and isinstance(value, float)]
            self.assertAlmostEqual(float(line["uncertainty"]), math.hypot(*(p for p in parts if p == p)))

    def test_density_under_the_track_lists_the_excluded_errors(self) -> None:
        run = self.run_on_sand()
        with patch.object(comparison, "track_density", return_value=(1650.0, 5.0)):
            result = compare([run])
        (line,) = (row for row in comparison_report(result).splitlines() if "1650 ± 5" in row)
        self.assertRegex(line, r"1650 ± 5 +time 5; cells, ground, step, contact, .*material, model unknown$")
        (row,) = (row for row in table_rows(result) if row["quantity"] == "density under the track")
        self.assertEqual((row["u_time"], row["u_packing"]), (5.0, 0.0))
        self.assertTrue(math.isnan(float(row["u_size"])))

    def test_texts_of_a_folder_state_the_kind_of_error(self) -> None:
        write_run(self.folder / "run", torque=50.0)
        folder = self.folder / "run"
        run = read_wheel_run(folder)
        for text in (report(folder), headline(folder), verdict_line(folder, quick=False)):
            self.assertGreaterEqual(self.assert_whole(text, run), 1)

    def test_values_of_a_sweep_state_the_kind_of_error(self) -> None:
        run = self.run_on_sand()
        for name, value in quantities([run], {}).items():
            known = [value.parts.part(part) for part in value.parts.known]
            self.assertAlmostEqual(value.uncertainty, math.hypot(*known), 12, name)
        self.assertGreater(quantities([run], {})["net_traction_coefficient"].parts.model, 0.03)


if __name__ == "__main__":
    unittest.main()
