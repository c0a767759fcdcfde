# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of studies: verdicts, entries of study.yaml, and values in pages."""

import tempfile
import unittest
from pathlib import Path

from furrow_post.analyse.comparison import measured_near
from furrow_post.cli.study_command import write_pages
from furrow_post.errors import ResultsError
from furrow_post.study.pages import shown, stale_pages, with_values
from furrow_post.study.provenance import read_origins
from furrow_post.study.values import (
    NEED_REASON,
    Registry,
    StudyValue,
    limit_verdict,
    study_folders,
    values_of,
    verdict_of,
)
from support.command import SOURCE


class VerdictTest(unittest.TestCase):
    def test_equal_values_agree(self) -> None:
        for expected, value, error, reference_error in (
            ("agrees", 10.9, 0.0, 0.0),
            ("near", 12.0, 0.0, 0.0),
            ("differs", 13.0, 0.0, 0.0),
            ("agrees", 12.0, 0.0, 1.0),  # within the scatter of the measurement
            ("inconclusive", 12.0, 1.1, 0.0),  # only a large error reaches the reference
            ("inconclusive", 10.5, 2.0, 0.0),  # an agreement that would allow 40 %
            ("inconclusive", 12.0, 0.0, 2.0),
            ("differs", 15.0, 1.0, 0.0),
        ):
            with self.subTest(value=value, error=error, reference_error=reference_error):
                self.assertEqual(verdict_of(value, error, 10.0, reference_error), expected)

    def test_larger_error_never_makes_a_value_agree(self) -> None:
        for value in (9.0, 10.5, 11.5, 13.0):
            verdicts = [verdict_of(value, error, 10.0) for error in (0.0, 0.2, 0.5, 1.0, 3.0)]
            if verdicts[0] != "agrees":
                self.assertNotIn("agrees", verdicts)

    def test_limits_include_the_error(self) -> None:
        for expected, value, error, upper in (
            ("met", 9.0, 0.0, True),
            ("missed", 11.0, 0.0, True),
            ("met", 11.0, 0.4, False),
            ("missed", 9.0, 0.4, False),
            ("inconclusive", 9.5, 0.4, True),
            ("inconclusive", 10.5, 0.4, True),
            ("inconclusive", -0.2, 5.0, True),  # an error that allows the whole limit
            ("missed", 25.0, 5.0, True),
            ("met", 200.0, 9.0, False),  # an error as large as the limit, 21 of them from it
            ("inconclusive", 14.0, 1.9, False),
        ):
            with self.subTest(value=value, upper=upper):
                self.assertEqual(limit_verdict(value, error, 10.0, upper), expected)


class Study:
    """A project with one study in a temporary folder."""

    def __init__(self, test: unittest.TestCase, values: str, table: str) -> None:
        temporary = tempfile.TemporaryDirectory()
        test.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        self.folder = self.root / "inputs" / "plate"
        self.folder.mkdir(parents=True)
        (self.folder / "study.yaml").write_text(values, encoding="utf-8")
        (self.folder / "results.csv").write_text(table, encoding="utf-8")

    def registry(self) -> Registry:
        return Registry.of(self.root)


TABLE = "run,z,e\na,0.1234,0.0031\nb,0.130,\nc,5,\nc,6,\n"
ENTRY = "values:\n  - {{id: z, row: {{run: {run}}}, column: z, scale: 100, unit: cm{more}}}\n"


class EntryTest(unittest.TestCase):
    def value(self, more: str = "", run: str = "a") -> StudyValue:
        return Study(self, ENTRY.format(run=run, more=more), TABLE).registry()["plate.z"]

    def test_scale_applies_to_value_and_error(self) -> None:
        for more, error in ((", error: e", 0.31), (", error: 0.5", 0.5), ("", None)):
            value = self.value(more)
            self.assertAlmostEqual(value.computed() or 0, 12.34)
            self.assertAlmostEqual(value.uncertainty() or 0, error or 0)

    def test_error_of_the_next_size_is_the_distance(self) -> None:
        value = self.value(", next: {row: {run: b}}, reference: 12, reference_of: measured")
        self.assertAlmostEqual(value.uncertainty() or 0, 0.66)
        self.assertEqual(value.verdict(), "agrees")

    def test_ratio_divides_two_stored_numbers(self) -> None:
        value = self.value(", over: {row: {run: b}, scale: 1}, reference: 90, reference_of: report")
        self.assertAlmostEqual(value.computed() or 0, 12.34 / 0.130)
        self.assertEqual(value.row()["error"], "not estimated")
        with self.assertRaisesRegex(ResultsError, "next is no error of a ratio"):
            self.value(", over: {row: {run: b}}, next: {row: {run: b}}")

    def test_parts_of_an_error_add_as_their_squares(self) -> None:
        parts = "{of: time average, column: e}, {of: cells, between: [{row: {run: a}}, {row: {run: b}}]}"
        value = self.value(f", error: [{parts}]")
        self.assertAlmostEqual(value.uncertainty() or 0, (0.31**2 + 0.66**2) ** 0.5)
        self.assertAlmostEqual(value.time_error(), 0.31)
        self.assertEqual(value.row()["error_of"], "time average; cells")

    def test_rms_has_the_error_of_its_number_of_tests(self) -> None:
        value = self.value(", error: [{of: tests, tests: 8}]")
        self.assertAlmostEqual(value.uncertainty() or 0, 12.34 / 4)

    def test_unestimated_error_is_marked(self) -> None:
        unknown = self.value(", reference: 12.34, reference_of: measured")
        self.assertEqual((unknown.row()["error"], unknown.verdict()), ("not estimated", "inconclusive"))
        self.assertEqual(self.value(", error: [{of: none}]").row()["error"], "0")

    def test_scatter_of_tests_gives_the_error_of_their_mean(self) -> None:
        more = ", error: 0, reference: 11, reference_scatter: 1.2, reference_tests: {}, reference_of: measured"
        for tests, verdict in ((1, "agrees"), (4, "near")):
            value = self.value(more.format(tests))
            self.assertAlmostEqual(value.expected_error(), 1.2 / tests**0.5)
            self.assertEqual(value.verdict(), verdict)

    def test_reference_can_be_a_stored_value(self) -> None:
        value = self.value(", error: 0, reference: {row: {run: b}}, limit: upper, reference_of: formula")
        self.assertAlmostEqual(value.expected() or 0, 13.0)
        self.assertEqual(value.verdict(), "met")

    def test_error_of_a_reference_can_be_a_stored_value(self) -> None:
        more = ", error: 0, reference: 14, reference_error: {}, reference_of: ours"
        for error, expected, verdict in (("0.31", 0.31, "near"), ("{column: e, scale: 300}", 0.93, "agrees")):
            value = self.value(more.format(error))
            self.assertAlmostEqual(value.expected_error(), expected)
            self.assertEqual(value.verdict(), verdict)

    def test_mistakes_are_refused(self) -> None:
        for more, run, message in (
            ("", "c", "2 rows have"),
            ("", "d", "0 rows have"),
            (", error: none", "a", "no number in column 'none'"),
            (", lable: known", "a", "unknown keys"),
            (", label: guessed", "a", "label is one of fitted, known, held out, blind, scored"),
            (", limit: above", "a", "limit is one of upper, lower"),
            (", next: {rows: 1}", "a", "unknown keys"),
            (", error: [{of: luck, value: 1}]", "a", "of, of a part of its error, is one of time average"),
            (", error: [{of: cells, betwixt: 1}]", "a", "unknown keys"),
        ):
            with self.subTest(more=more, run=run), self.assertRaisesRegex(ResultsError, message):
                value = self.value(more, run)
                value.row()

    def test_two_values_of_one_name_are_refused(self) -> None:
        entry = ENTRY.format(run="a", more="")
        with self.assertRaisesRegex(ResultsError, "two values are called 'plate.z'"):
            Study(self, entry + entry.partition("\n")[2], TABLE).registry()


class PagesTest(unittest.TestCase):
    def setUp(self) -> None:
        more = ", error: e, reference: 12.5, reference_of: measured"
        self.study = Study(self, ENTRY.format(run="a", more=more), TABLE)

    def test_value_is_rounded_to_its_error(self) -> None:
        value = self.study.registry()["plate.z"]
        for form, text in (
            ("", "12.3 ± 0.3"),
            ("value", "12.3"),
            ("error", "0.3"),
            ("reference", "12.5"),
            ("verdict", "agrees"),
        ):
            self.assertEqual(shown(value, form), text)

    def test_page_shows_the_stored_values(self) -> None:
        page = self.study.root / "page.md"
        page.write_text("z <!-- value: plate.z -->?<!-- end value --> cm\n", encoding="utf-8")
        stale = stale_pages(self.study.root, self.study.registry())
        expected = "z <!-- value: plate.z -->12.3 ± 0.3<!-- end value --> cm\n"
        self.assertEqual(stale, {page: expected})
        page.write_text(expected, encoding="utf-8")
        self.assertEqual(stale_pages(self.study.root, self.study.registry()), {})

    def test_mistakes_in_a_page_are_refused(self) -> None:
        for text, message in (
            ("<!-- value: plate.y -->1<!-- end value -->", "no value is called 'plate.y'"),
            ("<!-- value: plate.z -->1", "no '<!-- end value -->'"),
            ("<!-- value: plate.z big -->1<!-- end value -->", "after the name may come"),
        ):
            with self.subTest(text), self.assertRaisesRegex(ResultsError, message):
                with_values(text, self.study.registry())


class StoredTest(unittest.TestCase):
    """The studies of the project."""

    def test_pages_and_experiments_have_the_stored_values(self) -> None:
        from_studies = Registry.of(SOURCE)
        self.assertGreater(len(list(from_studies)), 200)
        write_pages(SOURCE, check=True)

    def test_values_that_need_a_reason_have_one(self) -> None:
        for value in Registry.of(SOURCE):
            if value.verdict() in NEED_REASON:
                with self.subTest(value.id):
                    self.assertTrue(value.reason)

    def test_field_tests_equal_their_table(self) -> None:
        """The twelve tests in 0.18 to 0.22 m of 220 kg/m3, on which values of c and z rest."""
        table = SOURCE / "inputs" / "validation" / "snow_wheel" / "reference.csv"
        measured = measured_near(table, 0.2, 220.0, {"depth": (0.9, 1.1), "density": (1.0, 1.0)})
        self.assertEqual(len(measured), 12)
        registry = Registry.of(SOURCE)
        for name, scale in (("resistance", 1.0), ("sinkage_m", 100.0)):
            mean, scatter = measured[name].mean(), measured[name].std()
            for run in ("snow_wheel.row_220_20cm", "report_wheel.slip_free"):
                value = registry[f"{run}.{name}"]
                self.assertAlmostEqual(value.expected() or 0.0, scale * mean, delta=5e-3 * scale * mean)
                self.assertAlmostEqual(value.reference_scatter, scale * scatter, delta=0.01 * scale)
                self.assertEqual(value.reference_tests, len(measured))

    def test_studies_are_not_blind_and_calibrations_are_fitted(self) -> None:
        registry = Registry.of(SOURCE)
        self.assertFalse([value.id for value in registry if value.label == "blind"])
        for name in (  # the numbers that the parameters of these runs were chosen by
            "snow_oedometer.fresh_snow.density_100kPa",
            "snow_oedometer.fresh_snow_shoop.density_100kPa",
            "tyre_table6.rolling.100.deflection_mm",
            "snow_wheel.row_220_20cm.density_under",
            "snow_wheel.m_1.4_220_20cm.density_under",
        ):
            self.assertEqual(registry[name].label, "fitted", name)

    def test_computed_number_is_no_measurement(self) -> None:
        for value in Registry.of(SOURCE):
            if value.quantity == "K0":  # 1 - sin(phi), from shear tests
                self.assertEqual(value.reference_of, "formula")
            if value.place == "Fig 52" and value.quantity == "largest":  # a colour scale ends there, no peak is measured
                self.assertIn(value.reference_of, ("", "ours"))
            if value.reference == 1867.0:  # of a plate on snow of 180 kg/m3
                self.assertEqual(value.study, "plate_variants")

    def test_tables_state_their_origin(self) -> None:
        for folder in study_folders(SOURCE):
            tables = {value.stored.table.name for value in values_of(folder) if value.stored}
            self.assertLessEqual(tables, set(read_origins(folder)), folder)


if __name__ == "__main__":
    unittest.main()
