# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/second_opinion: inputs of CalculiX, and packings of grains by two programs."""

import re
import unittest

import pandas

from furrow_post.study.values import DEFINITION, load_yaml
from furrow_post.tables.engine import Engine, Tables
from support.evaluation import VALIDATION, evaluation

study = evaluation("second_opinion")


class ComparisonTest(unittest.TestCase):
    def test_plate_mesh_has_shared_nodes(self) -> None:
        deck = study.decks.plate(3, 0.01, plastic=True)
        nodes = re.search(r"NSET=ALL\n(.*?)\*ELEMENT", deck, re.S)
        assert nodes
        # corners and middles of edges of 3^3 elements
        self.assertEqual(len(nodes[1].splitlines()), 4**3 + 3 * 3 * 4**2)
        plate = re.search(r"NSET=PLATE\n(.*?)\*MATERIAL", deck, re.S)
        assert plate
        self.assertEqual(len(plate[1].splitlines()), 8)  # of the face of one element
        self.assertTrue(deck.endswith("PLATE,3,3,-0.01\n*NODE PRINT, NSET=PLATE, TOTALS=ONLY\nRF\n*END STEP\n"))

    def test_error_on_grains_is_the_mean_difference_of_packings(self) -> None:
        folder = VALIDATION / "second_opinion"
        engine = Engine(folder, load_yaml(folder / DEFINITION), study)
        tables = Tables(engine)
        loads = {"plate_1": (10.0, 9.0), "plate_2": (12.0, 9.0)}
        tables["curves"] = pandas.DataFrame(
            [
                {"test": "plate", "run": run, "program": program, "x": x, "axial": load}
                for run, pair in loads.items()
                for program, load in zip(("Furrow", "Yade"), pair)
                for x in (0.001, 0.006)
            ]
        )
        tables["means"] = pandas.DataFrame(engine.rows(study.Runs([], None), "means", tables))
        row = engine.derived("grains", tables).to_dict("records")[0]
        self.assertEqual((row["quantity"], row["ours"], row["other"]), ("mean load to 5 mm", 11.0, 9.0))
        self.assertAlmostEqual(row["ours_error"], 1.0)  # of differences 1 and 3


if __name__ == "__main__":
    unittest.main()
