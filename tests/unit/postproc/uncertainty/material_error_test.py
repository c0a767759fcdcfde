# SPDX-License-Identifier: GPL-2.0-or-later
"""Standard errors of cards and materials: where they are read, what is varied, and which runs take them."""

import math
import unittest
from pathlib import Path

import yaml

from furrow_post.uncertainty.material_error import intervals, require_intervals, varied_text
from furrow_post.uncertainty.scene_errors import MATERIAL, SceneMaterial, places
from furrow_post.uncertainty.whole_error import RunErrors
from furrow_post.errors import ResultsError
from furrow_post.read.wheel_run import read_wheel_run
from furrow_post.run.record import digest
from support.command import SOURCE
from support.folder import FolderTest
from support.runs import rig, rigid_wheel, style, write_run

CARD = SOURCE / "inputs" / "soils" / "dry_sand_smooth.yaml"
SAND = SOURCE / "inputs" / "materials" / "dry_sand_smooth.yaml"


class FileTest(FolderTest):
    def test_card_has_errors_and_one_value_is_varied(self) -> None:
        known = {one.name: one for one in intervals(CARD)}
        self.assertEqual(list(known), [f"pressure_sinkage.{k}" for k in ("k_c", "k_phi", "n")] + [f"shear.{k}" for k in ("c", "phi", "K")])
        phi = known["shear.phi"]
        before, after = yaml.safe_load(CARD.read_text()), yaml.safe_load(varied_text(CARD, phi))
        self.assertAlmostEqual(after["shear"]["phi"]["value"], 24.5071 + 1.3688, 3)
        after["shear"]["phi"]["value"], after["contact"] = before["shear"]["phi"]["value"], before["contact"]
        self.assertEqual(after, before)

    def test_errors_of_a_material_include_those_of_its_bases(self) -> None:
        mine = self.folder / "mine.yaml"
        mine.write_text(f"base: {SAND}\nlaw: {{beta: 40}}\nhardening: {{type: table, p: [1, 2e3], eps_vol_pl: [0, 0.1]}}\n")
        mine.with_suffix(".errors.csv").write_text("parameter,error\nhardening.p[2],300\n")
        known = {one.name: one for one in intervals(mine)}
        self.assertEqual({name: one.value for name, one in known.items()}, {"law.beta": 40.0, "law.K": 0.764, "hardening.p.1": 2e3})
        text = yaml.safe_load(varied_text(mine, known["hardening.p.1"]))
        self.assertEqual((list(text), text["base"], text["hardening"]["p"]), (["base", "hardening"], str(mine), [1, 2300.0]))
        self.assertEqual(yaml.safe_load(varied_text(mine, known["law.K"]))["law"]["K"], 0.793)

    def test_errors_of_the_sand_follow_from_its_tests(self) -> None:
        beta = next(one for one in intervals(SAND) if one.name == "law.beta")
        self.assertAlmostEqual(math.tan(math.radians(beta.value + beta.error)) - math.tan(math.radians(beta.value)), 0.024, 3)

    def test_scene_needs_one_file_with_errors(self) -> None:
        plain = self.folder / "plain.yaml"
        plain.write_text("law: {M: 1}\n")
        self.assertEqual(require_intervals({"contact": plain, "card": CARD})[0], "card")
        cases: tuple[tuple[dict[str, Path], str], ...] = (
            ({"material": plain}, "no file has"), ({"card": CARD, "material": SAND}, "several files have"), ({}, "no variable"),
        )  # fmt: skip
        for files, message in cases:
            with self.assertRaisesRegex(ResultsError, message):
                require_intervals(files)


class RunTest(FolderTest):
    def test_later_runs_of_the_scene_include_the_material_error(self) -> None:
        script, soil = self.folder / "scene.lig", self.folder / "soil.yaml"
        script.write_text("# a scene\n")
        soil.write_text("law: {M: 1}\n")
        ground = style("scm", "terrain/scm", "soil", card="soil.yaml", cell=0.01, length=2.0, width=1.0)
        write_run(self.folder / "run", styles=[rigid_wheel(), rig(), ground])
        run = read_wheel_run(self.folder / "run")
        run.results.run["script"] = str(script)
        parts = {"hub_drop": {"law.M": -0.03, "law.K": 0.04}, "net_traction_coefficient": {"law.M": 0.02}}
        made = SceneMaterial(places(script, run.folder, MATERIAL)[0], digest(script), soil.name, digest(soil), parts)
        made.write()
        found = RunErrors(run).all()
        self.assertAlmostEqual(found["hub_drop"].material, 0.05 * 0.05)
        self.assertAlmostEqual(found["drawbar_pull"].material, 0.02 * 1000.0)
        self.assertIn("law.M, law.K of soil.yaml", found["hub_drop"].sources["material"])
        self.assertIn("material", found["slip"].unknown)
        soil.write_text("law: {M: 2}\n")
        self.assertIn("material", RunErrors(run).all()["hub_drop"].unknown)


if __name__ == "__main__":
    unittest.main()
