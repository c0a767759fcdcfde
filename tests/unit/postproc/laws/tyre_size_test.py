# SPDX-License-Identifier: GPL-2.0-or-later
"""Size designations against the dimensions of tyres in catalogues."""

import unittest
from pathlib import Path

from furrow_post.laws.tyre_size import read_size
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError

CATALOGUE = Path(__file__).with_name("tyre_catalogue.csv")
# Tolerances of diameter and width; flotation sizes name the largest tyre of the size
TOLERANCES = {"x": (0.05, 0.09), "/": (0.03, 0.07), "": (0.03, 0.09)}


class SizeTest(unittest.TestCase):
    def test_dimensions_agree_with_catalogues(self) -> None:
        for row in read_rows(CATALOGUE):
            size = read_size(row["size"])
            form = next(mark for mark in TOLERANCES if mark in row["size"].lower())
            with self.subTest(size=row["size"]):
                diameter, width = float(row["diameter_mm"]), float(row["section_width_mm"])
                self.assertLess(abs(1e3 * size.diameter / diameter - 1.0), TOLERANCES[form][0])
                self.assertLess(abs(1e3 * size.width / width - 1.0), TOLERANCES[form][1])

    def test_missing_aspect_ratio_is_estimated_within_the_stated_error(self) -> None:
        rows = [row for row in read_rows(CATALOGUE) if read_size(row["size"]).diameter_error > 0.0]
        self.assertGreater(len(rows), 1)
        for row in rows:
            size = read_size(row["size"])
            off = abs(size.diameter - 1e-3 * float(row["diameter_mm"]))
            self.assertLess(off, 2.0 * size.diameter_error, row["size"])

    def test_every_form_of_designation_is_read(self) -> None:
        for text, width, diameter, rim in (
            ("235/75R15", 0.235, 15 * 0.0254 + 2 * 0.75 * 0.235, 0.381),
            ("P235/75 R15", 0.235, 15 * 0.0254 + 2 * 0.75 * 0.235, 0.381),
            ("710/70R38", 0.710, 38 * 0.0254 + 2 * 0.70 * 0.710, 0.9652),
            ("31x10.50R15LT", 0.2667, 31 * 0.0254, 0.381),
            ("31 X 10.5 R 15", 0.2667, 31 * 0.0254, 0.381),
            ("16.00R20", 0.4064, 20 * 0.0254 + 2 * 1.03 * 0.4064, 0.508),
            ("18.4-38", 0.46736, 38 * 0.0254 + 2 * 0.83 * 0.46736, 0.9652),
        ):
            with self.subTest(text=text):
                size = read_size(text)
                self.assertAlmostEqual(size.width, width)
                self.assertAlmostEqual(size.diameter, diameter)
                self.assertAlmostEqual(size.rim_diameter, rim)
                self.assertAlmostEqual(size.height, 0.5 * (diameter - rim))

    def test_other_designations_are_refused(self) -> None:
        for text in ("", "15", "235", "235/75", "tyre", "235/75R15.55", "-5", "235/75R15 98H x"):
            with self.subTest(text=text), self.assertRaisesRegex(
                ResultsError, "no size designation"
            ):
                read_size(text)
        for text in ("235/10R15", "31x10.50R30", "20x4.00R38"):
            with self.subTest(text=text), self.assertRaisesRegex(
                ResultsError, "no tyre has this shape"
            ):
                read_size(text)


if __name__ == "__main__":
    unittest.main()
