# SPDX-License-Identifier: GPL-2.0-or-later
"""The cards of inputs/soils: their grounds, the table of the page, and Bekker-Wong with a card against
the rigid wheel on the same ground, as the tutorial quotes it."""

import unittest
from dataclasses import replace

from furrow_post.analyse import empirical
from furrow_post.analyse.terrain_values import terrain
from furrow_post.csv_table import read_rows
from furrow_post.read.soil_card import NoResult, markdown, read_card
from furrow_post.soil.material import read_material
from support.command import SOURCE

SOILS = SOURCE / "inputs" / "soils"
TUTORIAL = SOURCE / "inputs" / "guide" / "tutorials" / "8_soil_card.md"


class LibraryTest(unittest.TestCase):
    def test_every_card_is_of_a_material_and_in_the_table(self) -> None:
        paths = sorted(SOILS.glob("*.yaml"))
        self.assertGreater(len(paths), 0)
        cards = [read_card(path) for path in paths]
        for path, card in zip(paths, cards):
            material = read_material(SOURCE / "inputs" / "materials" / card.ground)
            self.assertEqual(path.name, card.ground)
            self.assertEqual(card.density, material.density)
            for name, fitted in card.parameters().items():
                self.assertGreater(fitted.error, 0, f"{path}: {name}")
            for part in (card.pressure_sinkage, card.shear):
                self.assertTrue(isinstance(part, NoResult) or part.residual < 0.1, path)
            page = (SOILS / "README.md").read_text(encoding="utf-8")
            for instrument in card.failures():  # with the reason, in words
                self.assertRegex(page, f"{path.stem}`[^|]*{instrument}")
        self.assertIn(markdown(cards), (SOILS / "README.md").read_text(encoding="utf-8"))

    def test_bekker_wong_with_a_card_against_the_wheel(self) -> None:
        ground = terrain(str(SOILS / "dry_sand_smooth.yaml"))
        text = TUTORIAL.read_text(encoding="utf-8")
        rows = read_rows(SOILS / "wheel_on_dry_sand.csv")
        self.assertEqual(len(rows), 2)
        for row in rows:
            load, sinkage, net = (float(row[key]) for key in ("load_N", "sinkage_m", "net_traction"))
            found, fitted_k = (
                empirical.wong_reece(load, 0.74, 0.272, 0.0, soil, extrapolate=True)
                for soil in (ground, replace(ground, K=0.02))
            )
            line = (
                f"| {load:g} | {1e3 * sinkage:.0f} | {1e3 * found.sinkage:.0f} | "
                f"{found.sinkage / sinkage - 1:+.0%} | {net:.2f} | {-found.coefficient:.2f} | "
                f"{-fitted_k.coefficient:.2f} |"
            )
            self.assertIn(line, text)

    def test_bekker_wong_with_the_card_of_grc1_against_the_wheel(self) -> None:
        """The page has each load and slip, and the sinkage deviates by less than twice the wheel's error."""
        ground = replace(terrain(str(SOILS / "grc1.yaml")), K=0.01)
        text = TUTORIAL.read_text(encoding="utf-8")
        rows = read_rows(SOILS / "wheel_on_grc1.csv")
        self.assertEqual(len(rows), 4)
        for row in rows:
            load, slip, sinkage, spread, net, net_spread = (float(value) for value in row.values())
            found = empirical.wong_reece(load, 0.74, 0.272, slip, ground, extrapolate=True)
            self.assertLess(abs(found.sinkage - sinkage), 2 * spread)
            line = (
                f"| {load:g} | {slip:g} | {1e3 * sinkage:.0f} ± {1e3 * spread:.0f} | {1e3 * found.sinkage:.0f} | "
                f"{found.sinkage / sinkage - 1:+.0%} | {net:.2f} ± {net_spread:.2f} | {-found.coefficient:.2f} |"
            )
            self.assertIn(line, text)


if __name__ == "__main__":
    unittest.main()
