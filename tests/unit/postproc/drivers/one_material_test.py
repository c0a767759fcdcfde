# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/one_material: values of grains from their runs, beside those of the reference."""

import math
import unittest
from unittest import mock

from support.evaluation import evaluation

study = evaluation("one_material")
TORQUE, PLATE = ("wheel", "slip 0", "torque"), ("plate", "100 mm", "pressure")


def row(run: str, value: float) -> dict[str, str]:
    test, at, quantity = TORQUE
    return {"run": run, "test": test, "at": at, "quantity": quantity, "value": str(value)}


class GrainsTest(unittest.TestCase):
    def test_error_has_scatter_of_packings_and_step_from_coarser_grains(self) -> None:
        rows = [row("slip_0_grains/0.05_1", 90), row("slip_0_grains/0.05_2", 110), row("slip_0_grains/0.07_1", 70)]
        rows.append(row("slip_0_snow", 600))
        value, error = study.values_of_grains(rows)[TORQUE]
        self.assertEqual(value, 100)
        self.assertAlmostEqual(error, math.hypot(10, 30))
        self.assertEqual(study.values_of_laws(rows)["snow"], {TORQUE: 600})

    def test_reference_keeps_its_own_values(self) -> None:
        names = ("test", "at", "quantity", "grains", "grains_error")
        stored = [dict(zip(names, (*TORQUE, "", ""))), dict(zip(names, (*PLATE, "19332", "1900")))]
        with mock.patch.object(study, "read_rows", return_value=stored):
            torque, plate = study.references({TORQUE: (100.0, 32.0), PLATE: (1.0, 1.0)})
        self.assertEqual((torque["grains"], torque["grains_error"]), ("100", "32"))
        self.assertEqual(plate["grains"], "19332")


if __name__ == "__main__":
    unittest.main()
