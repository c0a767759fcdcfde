# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation: what the tables of a study's page say is in its stored tables."""

import math
import re
import unittest
from bisect import bisect_left
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path

from furrow_post.csv_table import read_rows
from furrow_post.study.experiments import answers, report_items
from furrow_post.study.pages import MARK
from furrow_post.study.values import Registry
from support.command import SOURCE
from support.evaluation import VALIDATION, stored

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?![\w.])")
OTHER_WORDS = re.compile(r"\[[^]]*\]\([^)]*\)|`[^`]*`|\[\w+\]")  # links, code, keys of sources
SCALES = (1.0, 1e3, 1e-3, 1e2, 1e-2, 10.0, 0.1)  # between the units of tables and pages
# Numbers of pages that no table of the study need have, with where they are from
ELSEWHERE = {
    "cmu_sand": {"0.071"},  # mean of several rows
    # shares of a plate of 23 cm, from the loads of the runs by circumference and area
    "plate_variants": {"-1", "-22", "-13", "+12", "-12", "-31"},
    "pull_slip": {"67", "600", "3000"},  # cell and loads, defaults of its scripts
    "report_wheel": {"460"},  # density below the report's own wheel
    "sand_zones": {"-0.33"},  # slip of the towed wheel: results of the run
    "snow_oedometer": {"0.12"},  # K0, [Shoop2001] eq 24
    # densities measured beside the wheel, [Shoop2001] Fig 67, final ones under wheels [CRREL95-7]
    "snow_wheel": {"280", "300", "525"},
}
# Its page also holds hand-made tables of runs that it does not keep
WITHOUT_TABLES = {"grains"}


def body_rows(page: str) -> Iterator[list[str]]:
    """Cells of the tables' rows but for their heads and first columns."""
    lines = page.splitlines()
    for before, line in zip(["", *lines], lines):
        if line.startswith("|") and before.startswith("|") and set(line) - set("|-: "):
            yield line.strip("|").split("|")[1:]


def stored_numbers(folder: Path) -> list[float]:
    """Absolute values, in order."""
    texts = [table.read_text(encoding="utf-8") for table in folder.glob("*.csv") if table.name != "provenance.csv"]
    exponent = r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
    return sorted({abs(float(text)) for text in re.findall(exponent, "\n".join(texts))})


def is_stored(text: str, numbers: list[float]) -> bool:
    """True if one of the numbers, rounded as the text is, in its unit or another, is the text.

    Pages show a value without an error with three digits.
    """
    value, digits = abs(float(text)), len(text.partition(".")[2])
    if value >= 1000 and not digits and value % 10 == 0:
        digits = 2 - math.floor(math.log10(value))
    half = 0.500001 * 10.0**-digits
    for scale in SCALES:
        place = bisect_left(numbers, (value - half) / scale)
        if place < len(numbers) and numbers[place] <= (value + half) / scale:
            return True
    return False


def not_stored(page: str, numbers: list[float]) -> set[str]:
    """Numbers of the page's tables that are not among the numbers."""
    cells = [OTHER_WORDS.sub("", cell) for row in body_rows(page) for cell in row]
    shown = {text for cell in cells for text in NUMBER.findall(cell)}
    return {text for text in shown if not is_stored(text, numbers)}


class StudyPagesTest(unittest.TestCase):
    def test_pages_have_the_numbers_of_their_tables(self) -> None:
        pages = sorted(VALIDATION.glob("*/README.md"))
        self.assertGreater(len(pages), 10)
        for page in pages:
            if page.parent.name in WITHOUT_TABLES:
                continue
            with self.subTest(study=page.parent.name):
                missing = not_stored(page.read_text(encoding="utf-8"), stored_numbers(page.parent))
                self.assertLessEqual(
                    missing,
                    ELSEWHERE.get(page.parent.name, set()),
                    "the page says what the study's tables do not: mend it, or evaluate again",
                )

    def test_number_is_found_rounded_and_in_other_units(self) -> None:
        page = "| run | z mm | c |\n|---|---|---|\n| `d 7` a 3 | {} | [x7](y) |\n"
        for text in ("163", "16.3", "0.1629", "162.87", "-163"):
            self.assertEqual(not_stored(page.format(text), [0.16287, 5.0]), set())
        for text in ("164", "0.1628"):
            self.assertEqual(not_stored(page.format(text), [0.16287, 5.0]), {text})


class LabelsTest(unittest.TestCase):
    """Facts that a label, a reference or a verdict must not hide."""

    registry = Registry.of(SOURCE)

    def test_report_is_the_source_of_its_printed_values_alone(self) -> None:
        for value in self.registry:
            if value.reference_of == "ours":
                self.assertFalse(value.remark.startswith("report:"), value.id)
            if value.study == "report_wheel" and value.reference == 0.1:
                self.assertEqual(value.reference_of, "measured", value.id)

    def test_one_run_has_one_label(self) -> None:
        names = [f"report_wheel.d_30.{name}" for name in ("sinkage_m", "resistance")]
        self.assertEqual({self.registry[name].label for name in names}, {"fitted"})

    def test_contradictions_of_the_report_are_listed(self) -> None:
        for name, verdict in (
            ("report_wheel.depth_40_free_d30.sinkage_m", "missed"),
            ("report_wheel.effects.d_30_impulse.resistance_percent", "missed"),
            ("report_wheel.fields.times_2_d20.density_under", "differs"),
            ("report_wheel.depth_40_free_d30.resistance", "agrees"),  # alone: its sinkage is missed
            ("snow_wheel.row_170_19cm.density_shoulder", "near"),
            ("snow_wheel.m_1.4_170_19cm.density_shoulder", "near"),
        ):
            self.assertEqual(self.registry[name].verdict(), verdict, name)

    def test_effects_keep_their_sign(self) -> None:
        effects = stored("report_wheel", "effects").set_index("run")["resistance_percent"]
        self.assertLess(effects[["friction_0.8", "friction_rough", "soft"]].max(), 0.0)

    def test_contact_of_a_skid_belongs_to_the_skidding_wheel(self) -> None:
        for slip in ("-0.1", "-0.2"):
            error = self.registry[f"report_wheel.slip_{slip}.resistance"].uncertainty()
            self.assertLess(error or 1.0, 0.01, slip)

    def test_table_11_is_held_out_and_not_blind(self) -> None:
        page = (VALIDATION / "predictions" / "README.md").read_text(encoding="utf-8")
        self.assertRegex(page, r"\| `T11` \| all 16 \| held out \|")
        self.assertNotIn("All values have the label", page)

    def test_verdicts_on_findings_equal_those_of_their_rows(self) -> None:
        """The first value of a row of the page has a verdict that allows the words of the row."""
        allowed = {
            "holds": ("agrees", "met"),
            "holds in part": ("agrees", "near"),
            "not reproduced": ("differs", "missed", "near", "nothing to compare"),
            "inconclusive": ("inconclusive", "agrees", "differs"),
        }
        page = (VALIDATION / "report_findings.md").read_text(encoding="utf-8")
        rows = [row for row in page.splitlines() if "<!-- value:" in row]
        self.assertGreater(len(rows), 10)
        for row in rows:
            words = row.split("|")[2].strip()
            name = MARK.search(row)
            assert name
            self.assertIn(self.registry[name[2]].verdict(), allowed[words], row)


class ReportItemsTest(unittest.TestCase):
    """report_items.csv: every item of [Shoop2001] has a value, a test or a reason."""

    items, registry = report_items(SOURCE), Registry.of(SOURCE)

    def test_every_item_occurs_once(self) -> None:
        self.assertEqual([item["item"] for item in self.items], [str(n + 1) for n in range(126)])

    def test_states_of_items_equal_those_of_their_rows(self) -> None:
        for item in self.items:
            with self.subTest(item["item"]):
                for pattern in item["rows"].split():
                    self.assertTrue(any(fnmatchcase(value.id, pattern) for value in self.registry), pattern)
                numbers = [value for value in self.registry if answers(value, item) and value.stored]
                self.assertIn(item["state"], ("row", "test", "partly", "none"))
                self.assertEqual(item["state"] == "row", not item["reason"])
                if item["state"] in ("row", "none"):
                    self.assertEqual(bool(numbers), item["state"] == "row")
                if item["state"] == "test":
                    self.assertTrue((SOURCE / item["reason"]).is_file())

    def test_numbers_of_experiments_are_items(self) -> None:
        known = {item["item"] for item in self.items}
        for row in read_rows(VALIDATION / "experiments.csv"):
            self.assertLessEqual(set(row["audit"].split()), known, row["id"])

    def test_page_has_the_number_of_items(self) -> None:
        states = [item["state"] for item in self.items]
        known = [value for value in self.registry if value.expected() is not None]
        answered = [item for item in self.items if item["state"] == "row"]
        compared = [item for item in answered if any(answers(value, item) for value in known)]
        page = " ".join((VALIDATION / "report_findings.md").read_text(encoding="utf-8").split())
        self.assertIn(
            f"lists {len(states)} items of the report. A number answers {states.count('row')} of them, and "
            f"{len(compared)} of these have a reference. Tests answer {states.count('test')}. Of the others "
            f"{states.count('partly')} are answered in part, and {states.count('none')} not.",
            page,
        )


if __name__ == "__main__":
    unittest.main()
