# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/predictions: slips, the conditions that are run, and their values."""

import hashlib
import math
import unittest

import yaml

from furrow_post.csv_table import read_rows
from support.command import SOURCE
from support.evaluation import evaluation, stored

FOLDER = SOURCE / "inputs/validation/predictions"
study = evaluation("predictions")
QUANTITIES = {
    "T11": {"hub_drop", "rut_depth", "resistance_coefficient"},
    "CMU": {"fx_over_fz", "fy_over_fz", "sinkage"},
    "MGRU3": {"slip"},
    "DEF": {"deflection", "width"},
}


class SetUpTest(unittest.TestCase):
    def test_cmu_conditions_are_two_wheels_at_three_angles_and_four_slips(self) -> None:
        rows = read_rows(FOLDER / "conditions.csv")
        chosen = [row for row in rows if study.is_predicted(row) and row["id"].startswith("CMU")]
        places = {(row["case"], row["slip_angle_deg"], round(float(row["slip"]), 1)) for row in chosen}
        self.assertEqual(len(places), 2 * 3 * 4)

    def test_further_cmu_conditions_have_every_slip_and_angle_and_none_of_the_first(self) -> None:
        rows = study.further_sand()
        first = {row["id"] for row in read_rows(FOLDER / "conditions.csv") if study.is_predicted(row)}
        self.assertEqual([sum("smooth" in row["id"] for row in rows), len(rows)], [12, 36])
        self.assertFalse(first & {row["id"] for row in rows})
        for column, count in (("slip_angle_deg", 6), (3, 9)):
            values = {row["id"].split("-")[3] if column == 3 else row[column] for row in rows}
            self.assertEqual(len(values), count)

    def test_slip_by_total_speed_is_converted_to_the_wheel_plane(self) -> None:
        for slip, angle in ((0.5, 30.0), (0.0, 45.0), (-0.5, 15.0)):
            travel, converted = study.in_wheel_frame(slip, angle)
            rim = travel / (1 - slip) if slip >= 0 else travel * (1 + slip)
            forward = travel * math.cos(math.radians(angle))
            self.assertAlmostEqual(converted, (rim - forward) / max(rim, forward))
            self.assertAlmostEqual(max(rim, travel), 1.0)

    def test_study_and_scene_have_grc_1_of_38_degrees(self) -> None:
        sine = math.sin(math.radians(38.0))
        for folder in (FOLDER / "materials", SOURCE / "inputs/materials"):
            law = yaml.safe_load((folder / "grc1.yaml").read_text())["law"]
            tangent = math.tan(math.radians(law["beta"]))
            self.assertAlmostEqual(tangent, 6 * sine / (3 - sine), delta=1e-3)
            self.assertAlmostEqual(law["K"], (3 - sine) / (3 + sine), delta=1e-4)
            self.assertEqual(law["density"], 1760)


class ValuesTest(unittest.TestCase):
    def test_every_predicted_condition_has_all_quantities_with_an_error(self) -> None:
        for table in ("predictions", "further"):
            rows = stored("predictions", table)
            self.assertTrue(rows["value"].abs().lt(math.inf).all() and (rows["standard_error"] > 0).all())
            for name, quantities in rows.groupby("id")["quantity"]:
                self.assertEqual(set(quantities), QUANTITIES[name.split("-")[0]], name)

    def test_frozen_values_equal_the_first_committed_ones(self) -> None:
        names = ("id", "quantity", "value", "standard_error")
        digests = {"predictions.csv": "933e6fc99b72bf23", "second.csv": "4d2d4bc0eabbd30a", "further.csv": "ad0a8f92dbb8d9c9"}
        for file, known in digests.items():
            lines = [",".join(row[name] for name in names) for row in read_rows(FOLDER / file)]
            digest = hashlib.sha256("\n".join(lines).encode()).hexdigest()
            self.assertEqual(digest[:16], known, file)


if __name__ == "__main__":
    unittest.main()
