# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post card make with a stand-in for furrow whose ground has known parameters."""

import math
import os
import subprocess
import unittest
from unittest import mock

from furrow_post.read.soil_card import Cone, read_card
from furrow_post.run.record import read_record
from furrow_post.soil.material import read_material
from support.command import SOURCE, run_card
from support.fake import ANSWER, REAL
from support.folder import FolderTest

TRUTH = {"k_c": -4e3, "k_phi": 5e5, "n": 0.6, "c": 400.0, "phi": 30.0, "K": 0.006}
CONE = (2e4, 8e5)  # [Pa] at the surface, [Pa/m]
MATERIALS = SOURCE / "inputs" / "materials"
SAND = (MATERIALS / "dry_sand_smooth.yaml").read_text().replace("contact: ", f"contact: {MATERIALS}/")
GRAIN_CONE = 30.0  # index over weight density and size, of grains without size
SPEED_STRESS = 500.0  # [Pa] at 1 m/s, by the root of the speed
STAND_IN = f"""#!/usr/bin/python3 -S
{ANSWER}
""" + """
import math
words = sys.argv
values = {words[k + 1]: words[k + 2] for k, word in enumerate(words) if word == "-var"}
name = words[words.index("-in") + 1].rpartition("/")[2].removesuffix(".lig")
results = values.pop("results")
for key in ("material", "ground", "laboratory", "ring"):
    values.pop(key, None)
v = {key: float(value) for key, value in values.items()}
t = TRUTH
rows = []
for k in range(301):
    s = k / 300
    packing = PACKING if v.get("seed") == 49979687 else 1
    if name in ("plate", "grain_plate"):
        z = s * v["sinkage"]
        p = packing * (t["k_c"] / (0.5 * v["size"]) + t["k_phi"]) * z ** t["n"]
        rows.append((k, z, 0, p))
    elif name == "shear":
        outer, inner = 0.5 * v["size"], 0.5 * v["inner_size"]
        area, moment = math.pi * (outer**2 - inner**2), 2 / 3 * math.pi * (outer**3 - inner**3)
        turned = max(0, 2 * s - 1) * v["angle"]  # pressed first
        normal = v["load"] / area
        speed = v["spin"] * moment / area
        half = 0.5 * (outer - inner) / v["cells"]  # half a cell on each side shears too
        wide = ((outer + half) ** 3 - (inner - half) ** 3) / (outer**3 - inner**3)
        strength = t["c"] * wide + normal * math.tan(math.radians(t["phi"])) + SPEED_STRESS * math.sqrt(speed)
        tau = strength * (1 - math.exp(-turned * moment / area / t["K"]))
        rows.append((k, 0.001, v["load"], normal, -tau * moment, turned))
    elif name == "grain_ring":
        outer, inner = 0.09, 0.05  # 18 and 10 grains of 10 mm
        area, moment = math.pi * (outer**2 - inner**2), 2 / 3 * math.pi * (outer**3 - inner**3)
        turned = max(0, 2 * s - 1) * v["angle"]
        normal = v["load"] / area
        tau = packing * (t["c"] + normal * math.tan(math.radians(t["phi"]))) * (1 - math.exp(-turned * moment / area / t["K"]))
        rows.append((k, 0.001, v["load"], normal, -tau * moment, turned))
    else:
        height = 0.5 * v["size"] / math.tan(math.radians(0.5 * v["angle"]))
        z = s * (v["depth_of_base"] + height)
        if name == "grain_cone":  # whose base has 1 grain in so many; second order
            rows.append((k, z, 0, packing * GRAIN_CONE * 1330 * v["gravity"] * v["size"] * (1 + 4 * (0.01 / v["size"]) ** 2)))
            continue
        rows.append((k, z, 0, max(0, CONE[0] + CONE[1] * (z - height))))
with open(f"{results}/curve.txt", "w") as file:
    file.write("# LIGGGHTS\\n# columns\\n")
    file.writelines(" ".join(map(str, row)) + "\\n" for row in rows)
with open(f"{results}/facts.txt", "w") as file:
    file.write("test plate bulk 1330")
with open("LOG", "a") as log:
    log.write(name + "\\n")
sys.exit(STATUS)
"""


class CardCommandTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "furrow-point").symlink_to(REAL / "furrow-point")
        self.furrow(0)

    def furrow(self, status: int, packing: float = 1.0) -> None:
        """packing: strength of the second packing of grains over the first"""
        program = self.folder / "bin" / "furrow"
        text = STAND_IN.replace("TRUTH", repr(TRUTH)).replace("GRAIN_CONE", str(GRAIN_CONE)).replace("CONE", repr(CONE))
        text = text.replace("SPEED_STRESS", str(SPEED_STRESS)).replace("LOG", str(self.folder / "log.txt")).replace("STATUS", str(status)).replace("PACKING", str(packing))
        program.write_text(text, encoding="utf-8")
        program.chmod(0o755)

    def soil(self, *words: object) -> subprocess.CompletedProcess[str]:
        with mock.patch.dict(os.environ, FURROW_BUILD=str(self.folder)):
            return run_card(*words, folder=self.folder)

    def runs(self) -> list[str]:
        return (self.folder / "log.txt").read_text().split()

    def test_quick_card_has_the_cone_index_of_formulas(self) -> None:
        done = self.soil("make", "dry_sand_smooth", "--quick", "-o", "card")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("cone index: mean over 0 to 150 mm, spread", done.stdout)
        index = read_card(self.folder / "card" / "card.yaml").parameters()["index"]
        self.assertAlmostEqual(index.value / (CONE[0] + 0.075 * CONE[1]), 1, delta=0.01)

    def test_card_has_the_parameters_of_the_ground(self) -> None:
        done = self.soil("make", "dry_sand_smooth", "-o", "card")
        self.assertEqual(done.returncode, 0, done.stderr)
        card = read_card(self.folder / "card" / "card.yaml")
        for name, truth in TRUTH.items():
            found = card.parameters()[name].value
            self.assertAlmostEqual(found / truth, 1, delta=1e-3, msg=name)
        self.assertAlmostEqual(card.parameters()["index"].value / (CONE[0] + 0.075 * CONE[1]), 1, delta=0.01)
        self.assertAlmostEqual(card.parameters()["gradient"].value / CONE[1], 1, delta=1e-3)
        self.assertGreater(card.parameters()["speed_stress"].value, 10)
        self.assertEqual(card.density, 1505)
        # rigid punch: 2 E/(pi a (1 - nu^2))
        stiffness = 2 * 4.78e6 / (math.pi * 0.075 * (1 - 0.11**2))
        self.assertAlmostEqual(card.stiffness / stiffness, 1, places=9)
        self.assertAlmostEqual(card.bekker_and_shear()[0].sinkage.high, 0.06, places=9)
        for file in ("card.html", "card.png", "chrono_scm.json", "altair.rdf", "card.csv"):
            self.assertTrue((self.folder / "card" / file).is_file(), file)
        self.assertIn("Bekker", (self.folder / "card" / "chrono_scm.json").read_text())
        self.assertEqual(self.runs(), 3 * ["plate"] + 4 * ["shear"] + ["cone"])

    def test_runs_are_kept_and_repeated_when_the_ground_changes(self) -> None:
        ground = self.folder / "ground.yaml"
        ground.write_text(SAND, encoding="utf-8")
        words = ("make", ground, "--quick", "--sizes", 0.1, 0.2, "-o", "card")
        self.soil(*words)
        first = self.runs()
        self.assertEqual(first, 2 * ["plate"] + 3 * ["shear"] + ["cone"])
        self.soil(*words)
        self.assertEqual(self.runs(), first)
        ground.write_text(ground.read_text().replace("1505", "1506"), encoding="utf-8")
        self.soil(*words)
        self.assertEqual(self.runs(), 2 * first)

    def test_runs_are_repeated_when_the_base_of_the_ground_changes(self) -> None:
        base, ground = self.folder / "base.yaml", self.folder / "ground.yaml"
        base.write_text(SAND, encoding="utf-8")
        ground.write_text("base: base.yaml\n", encoding="utf-8")
        words = ("make", ground, "--quick", "--sizes", 0.1, 0.2, "-o", "card")
        self.soil(*words)
        first = self.runs()
        base.write_text(base.read_text().replace("beta: 47.1", "beta: 47.2"), encoding="utf-8")
        self.soil(*words)
        self.assertEqual(self.runs(), 2 * first)

    def test_run_that_fails_leaves_no_card(self) -> None:
        self.furrow(1)
        done = self.soil("make", "dry_sand_smooth", "-o", "card")
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, "furrow-post: .*card/plate_100mm failed: stopped with status 1; its output is in")
        self.assertEqual(len(self.runs()), 1)
        self.assertFalse((self.folder / "card" / "card.yaml").exists())

    def test_only_laws_with_youngs_modulus_have_it_scaled(self) -> None:
        """modulus_scale of the ring needs it; furrow refuses it for porous elasticity and NorSand."""
        materials = SOURCE / "inputs" / "materials"
        found = {name: read_material(materials / f"{name}.yaml").linear for name in ("fresh_snow", "fresh_snow_foam", "norsand_dry")}
        self.assertEqual(found, {"fresh_snow": True, "fresh_snow_foam": False, "norsand_dry": False})

    def test_card_of_grains_has_the_parameters(self) -> None:
        done = self.soil("make", "sand_cmu", "-o", "card")
        self.assertEqual(done.returncode, 0, done.stderr)
        card = read_card(self.folder / "card" / "card.yaml")
        for name, truth in TRUTH.items():
            self.assertAlmostEqual(card.parameters()[name].value / truth, 1, delta=2e-3, msg=name)
        self.assertEqual(card.ground, "sand_cmu.lig")
        self.assertAlmostEqual(card.density, 1330)
        self.assertAlmostEqual(card.bekker_and_shear()[0].radii.low, 0.05)
        self.assertIn("packings: 2", card.notes[1])
        self.assertEqual(self.runs(), 4 * ["grain_plate"] + 6 * ["grain_ring"] + 6 * ["grain_cone"])
        cone = card.cone
        assert isinstance(cone, Cone)
        weight = 1330 * 9.80665 * 0.08
        self.assertAlmostEqual(cone.index.value / weight, GRAIN_CONE * (1 + 4 / 64), places=6)
        self.assertGreater(cone.index.error, (cone.index.value - GRAIN_CONE * weight))  # grains of finite size
        self.assertEqual((cone.size, cone.angle), (0.08, 30.0))
        self.assertAlmostEqual(cone.depth.high, 0.08, delta=0.001)
        self.assertIn("8 grains wide; the index of another size, the standard one included, was not computed", card.notes[-2])
        self.assertIn("extrapolated to zero grain size 30 ± ", card.notes[-1])

    def test_card_of_grains_on_the_moon_has_the_inertial_number_of_earth(self) -> None:
        """Speeds grow with the root of gravity; the cone index of sand is in proportion to gravity."""
        self.soil("make", "sand_cmu", "--quick", "-o", "earth")
        self.soil("make", "sand_cmu", "--quick", "--gravity", 1.62, "-o", "moon")
        earth, moon = (read_card(self.folder / name / "card.yaml") for name in ("earth", "moon"))
        self.assertEqual((earth.gravity, moon.gravity), (9.80665, 1.62))
        assert isinstance(earth.cone, Cone) and isinstance(moon.cone, Cone)
        self.assertAlmostEqual(moon.cone.index.value / earth.cone.index.value, 1.62 / 9.80665, places=9)
        pace = math.sqrt(1.62 / 9.80665)
        for run, powers in (
            ("plate_100mm_86028121", {"speed": 1, "accelerate_time": -1, "gravity": 2, "sinkage": 0}),
            ("cone_60mm_86028121", {"speed": 1, "accelerate_time": -1, "gravity": 2, "depth_of_base": 0}),
            ("ring_*_86028121", {"spin": 1, "press_speed": 1, "press_time": -1, "accelerate_time": -1, "gravity": 2, "load": 0}),
        ):
            given = []
            for card in ("earth", "moon"):
                record = read_record(next((self.folder / card).glob(f"{run}/run.json")))
                assert record
                given.append(record)
            for name, power in powers.items():
                ratio = float(given[1].variable(name)) / float(given[0].variable(name))
                self.assertAlmostEqual(ratio, pace**power, places=9, msg=f"{run} {name}")

    def test_card_of_bonded_grains_has_no_cone(self) -> None:
        self.soil("make", "snow_bonded", "--quick", "-o", "card")
        self.assertEqual(self.runs(), 2 * ["grain_plate"] + 2 * ["grain_ring"])
        card = read_card(self.folder / "card" / "card.yaml")
        self.assertIn("only where grains do not stick", card.failures()["cone"])

    def test_errors_include_the_scatter_of_packings(self) -> None:
        self.soil("make", "sand_cmu", "-o", "equal")
        self.furrow(0, packing=1.1)
        self.soil("make", "sand_cmu", "-o", "apart")
        equal, apart = (read_card(self.folder / name / "card.yaml").parameters() for name in ("equal", "apart"))
        middle = math.degrees(math.atan(1.05 * math.tan(math.radians(TRUTH["phi"]))))
        self.assertLess(abs(apart["phi"].value - middle), 2 * apart["phi"].error)
        for name in ("k_phi", "phi"):
            self.assertGreater(apart[name].error, 10 * equal[name].error, name)

    def test_wrong_grounds_of_grains_are_refused(self) -> None:
        good = (SOURCE / "inputs/laboratory/grounds/sand_cmu.lig").read_text(encoding="utf-8")
        ground = self.folder / "my_sand.lig"
        for text, message in (
            (good + "fix soil all terrain/continuum cell 0.01\n", r"my_sand.lig:12: 'terrain/continuum' belongs to a continuum"),
            (good.replace("family string sand", "family string gravel"), "line 'variable family string NAME', NAME one of sand, snow_bonded"),
            (good.replace("diameter index 0.010", "diameter index 10"), "variable diameter is '10'; allowed: 0.0001 to 0.5 m"),
        ):
            ground.write_text(text, encoding="utf-8")
            self.assertRegex(self.soil("make", ground).stderr, message)
        done = self.soil("make", "sand_cmu", "--sizes", 0.08, 0.1)
        self.assertIn("a plate of 0.08 m is 8.0 grains wide; allowed: 10 grains or more, 0.1 m on sand_cmu.lig", done.stderr)
        self.assertIn("NAME one of sand, snow_bonded", self.soil("make", "snow_rough").stderr)
        self.assertFalse((self.folder / "log.txt").exists())

    def test_wrong_grounds_and_sizes_are_refused(self) -> None:
        done = self.soil("make", "moon")
        self.assertRegex(done.stderr, "^furrow-post: there is no ground 'moon'; name a file, or one of .*dry_sand")
        done = self.soil("make", "dry_sand", "--sizes", 0.1)
        self.assertIn("k_c and k_phi need plates of two diameters or more", done.stderr)
        (self.folder / "ground.yaml").write_text("law: {density: 1500}\n", encoding="utf-8")
        done = self.soil("make", "ground.yaml")
        self.assertRegex(done.stderr, "furrow-post: furrow-point: .*ground.yaml, line 1: keyword 'type' is missing; allowed: one of")
        done = self.soil("export", "ground.yaml", "chrono")
        self.assertIn("ground.yaml: has no 'pressure_sinkage'; write it with furrow-post card make", done.stderr)


if __name__ == "__main__":
    unittest.main()
