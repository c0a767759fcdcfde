# SPDX-License-Identifier: GPL-2.0-or-later
"""Whole errors: their parts, the model's from measured tests, cells from a scene or from like wheels, calibration."""

import json
import math
import unittest
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

from furrow_post.uncertainty import model_error, scene_errors, whole_error
from furrow_post.uncertainty.budget import Budget, rounded
from furrow_post.uncertainty.cost_table import FamilyKey, families
from furrow_post.uncertainty.model_error import REGIMES, TESTS, Case, Test, leave_one_study_out, regimes_of
from furrow_post.uncertainty.whole_error import RunErrors, case_of, headline, of_like_wheels, report
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.figures.histories import draw_histories
from furrow_post.read.results import Results
from furrow_post.read.wheel_run import Condition, WheelRun, read_wheel_run
from support.command import SOURCE
from support.folder import FolderTest
from support.tables import CONTINUUM, row
from support.runs import RADIUS, WIDTH, rig, rigid_wheel, style, write_run

VALIDATION = SOURCE / "inputs" / "validation"
DRIVEN = Case("sand", "rigid wheel", "driven", "no", 0.2, 0.0, 0.0, 0.4, 0.3)


class BudgetTest(unittest.TestCase):
    def test_known_parts_add_in_squares_and_unknown_parts_are_listed(self) -> None:
        budget = Budget(0.4e-3, 2e-3, packing=0.0, step=0.0, contact=0.0, held=0.0, model=11e-3)
        self.assertAlmostEqual(budget.total, math.sqrt(0.4**2 + 2**2 + 11**2) * 1e-3)
        self.assertEqual(
            budget.scaled(1e3).text(94.2, "mm"), "94 ± 11 mm (time 0.4, cells 2, model 11; ground, material unknown)"
        )

    def test_value_without_any_known_part_has_no_error(self) -> None:
        self.assertTrue(math.isnan(Budget().total))
        self.assertEqual(Budget().value_text(0.12345), "0.123")

    def test_parts_have_one_or_two_digits(self) -> None:
        self.assertEqual([rounded(x) for x in (0.0, 0.0123, 0.0178, 234.0, 0.4)], ["0", "0.012", "0.02", "200", "0.4"])


def few(independent: float) -> float:
    """Factor of so few independent tests: half of Student's t where two standard deviations are normal."""
    p = model_error.UPPER
    return {1: math.tan(math.pi * (p - 0.5)), 2: (2 * p - 1) / math.sqrt(2 * p * (1 - p))}[round(independent)] / 2


def tests(study: str, differences: list[float], case: Case = DRIVEN, error: float = 0.0) -> list[Test]:
    return [Test(study, "known", "coefficient", case, 1, d, error) for d in differences]


class ModelErrorTest(unittest.TestCase):
    def test_similar_tests_of_a_study_count_once(self) -> None:
        (regime,) = regimes_of([*tests("many", [0.1] * 9), *tests("one", [0.3])])
        self.assertAlmostEqual(regime.independent, 2.0)
        self.assertAlmostEqual(regime.model, few(2) * math.sqrt((0.01 + 0.09) / 2))
        self.assertAlmostEqual(regime.bias, 0.12)
        self.assertEqual((regime.tests, regime.studies), (10, ("many", "one")))

    def test_errors_of_tests_are_subtracted_down_to_a_quarter(self) -> None:
        self.assertAlmostEqual(regimes_of(tests("a", [0.1, -0.1], error=0.05))[0].model, few(2) * math.sqrt(0.0075))
        self.assertAlmostEqual(regimes_of(tests("a", [0.1, -0.1], error=0.2))[0].model, few(2) * 0.05)

    def test_correlation_within_studies_is_recovered(self) -> None:
        random = np.random.default_rng(5)
        bias, scatter = 0.3, 0.4  # share of the bias in the mean square: 0.36
        made = [tests(f"{k}", list(random.normal(0, bias) + random.normal(0, scatter, 8))) for k in range(400)]
        self.assertAlmostEqual(model_error.correlation([made]), 0.36, delta=0.04)
        (regime,) = regimes_of(test for study in made[:3] for test in study)
        alike = model_error.correlation([made[:3]])
        self.assertAlmostEqual(regime.independent, 3 / (alike**2 + (1 - alike**2) / 8))

    def test_two_errors_cover_95_percent_for_few_studies(self) -> None:
        """A new study of the same population lies within two errors from two others, for biases that rule and for scatter."""
        random = np.random.default_rng(7)
        for bias, scatter in ((1.0, 0.01), (0.01, 1.0)):
            inside = 0
            for _ in range(1500):
                known = [tests(str(k), list(random.normal(0, bias) + random.normal(0, scatter, 3))) for k in range(2)]
                (regime,) = regimes_of(known[0] + known[1])
                inside += abs(random.normal(0, math.hypot(bias, scatter))) <= 2 * regime.model
            self.assertAlmostEqual(inside / 1500, 0.955, delta=0.025, msg=str((bias, scatter)))

    def test_error_grows_with_the_distance_from_the_nearest_tests(self) -> None:
        regimes = regimes_of([*tests("a", [0.1]), *tests("b", [0.2], replace(DRIVEN, ground="snow"))])
        cases: tuple[tuple[dict[str, Any], float, float], ...] = (
            ({}, 0.0, 0.1),
            ({"slip": 0.6}, 2.0, 0.1),
            ({"wheel": "tyre", "slope": 10.0}, math.sqrt(2), 0.1),
            ({"radius": 0.6}, 1.0, 0.1),
            ({"ground": "road"}, 2.0, 0.2),  # as far from both: the larger error
        )
        for changed, distance, model in cases:
            found = model_error.model_error(regimes, "coefficient", replace(DRIVEN, **changed))
            assert found is not None
            self.assertAlmostEqual(found.distance, distance, 5)
            self.assertAlmostEqual(found.value, few(1) * model * math.hypot(1, distance), 3)
        self.assertIsNone(model_error.model_error(regimes, "torque", DRIVEN))
        self.assertIsNone(model_error.model_error(regimes, "coefficient", replace(DRIVEN, slip=0.81)))  # 3.05 steps

    def test_stored_regimes_equal_those_of_their_tests(self) -> None:
        made = regimes_of(TESTS.stored())
        stored = REGIMES.stored()
        for one, other in zip(made, stored, strict=True):
            self.assertEqual((one.words, one.tests, one.studies), (other.words, other.tests, other.studies))
            self.assertAlmostEqual(other.model / one.model, 1.0, 3)

    def test_study_is_predicted_by_the_others(self) -> None:
        scored = leave_one_study_out([*tests("a", [0.1]), *tests("b", [0.3])])
        self.assertEqual([round(one.normalised, 6) for one in scored], [round(1 / 3 / few(1), 6), round(3 / few(1), 6)])
        self.assertEqual(leave_one_study_out(tests("alone", [0.1, 0.2])), [])

    def test_committed_comparisons_are_calibrated_as_a_whole(self) -> None:
        """Regimes that miss the range are listed on the accuracy page."""
        rows = {(row["quantity"], row["regime"]): row for row in read_rows(VALIDATION / "calibration.csv")}
        whole = rows["all", "all"]
        self.assertTrue(0.8 <= float(whole["rms"]) <= 1.2, whole)
        self.assertTrue(0.9 <= float(whole["inside_two_errors"]) <= 0.98, whole)
        page = (VALIDATION / "README.md").read_text(encoding="utf-8")
        for (quantity, regime), row in rows.items():
            if int(row["tests"]) >= 5 and not 0.8 <= float(row["rms"]) <= 1.2:
                self.assertIn(f"| {quantity}, {regime} | {row['tests']} | {row['rms']} |", page)


class RunTest(FolderTest):
    def read(self, **changes: object) -> WheelRun:
        write_run(self.folder / "run", torque=50.0)
        run = read_wheel_run(self.folder / "run")
        for name, value in changes.items():
            setattr(run, name, value)
        return run

    def on_sand(self, cell: float = 0.05) -> WheelRun:
        run = self.read(ground="continuum", size=cell)
        run.conditions["density"] = Condition(1600.0, "kg/m3")
        return run

    def test_error_of_cells_depends_on_cells_in_the_wheel_width(self) -> None:
        """The series of convergence on sand, wheel of 272 mm: 60 mm are 44 mm under one of 200 mm."""
        run = self.on_sand(0.06 * WIDTH / 0.272)
        case = case_of(run)
        self.assertEqual(case.text(), "rigid wheel driven on sand")
        near = [s for s in whole_error.SIZES.stored() if s.name.startswith("convergence: sand")]
        expected = [s.family.components("coefficient", 0.06).size for s in near]
        particles = whole_error.SCHEME.stored()["size", "coefficient"][0]
        found = of_like_wheels(run, case, "coefficient").size
        self.assertAlmostEqual(found, math.hypot(math.sqrt(np.mean(np.square(expected))), particles))

    def test_cells_beyond_those_of_the_series_have_larger_errors(self) -> None:
        errors = [of_like_wheels(run, case_of(run), "sinkage").size for run in map(self.on_sand, (0.0588, 0.12))]
        self.assertGreater(errors[1], 1.5 * errors[0])

    def test_parts_have_sources_and_the_total_is_no_smaller(self) -> None:
        for name, budget in RunErrors(self.on_sand()).all().items():
            for part in budget.known:
                self.assertGreaterEqual(budget.total * (1 + 1e-12), budget.part(part), (name, part))
            self.assertEqual(sorted(set(budget.sources) - set(budget.known)), [], name)
        coefficient = RunErrors(self.on_sand()).all()["resistance_coefficient"]
        self.assertEqual(coefficient.unknown, ["domain", "material"])
        self.assertIn("cmu_sand predictions".replace(" ", ", "), coefficient.sources["model"])
        self.assertIn("convergence: sand, slip 0", coefficient.sources["size"])

    def test_larger_error_of_a_table_has_priority_over_similar_wheels(self) -> None:
        run = self.on_sand()
        usual = RunErrors(run).all()["hub_drop"].size
        key = FamilyKey(run.ground, run.model, run.wheel)
        for step, larger in ((0.001, False), (0.02, True)):
            rows = [row(f"{h}", "continuum", h, 0.05 + step * k, 0.2, 1.0, seed="", error=1e-6) for k, h in enumerate((0.05, 0.1))]
            found = RunErrors(run, {key: families(rows)[CONTINUUM]}).all()["hub_drop"]
            self.assertEqual(found.size > usual, larger)
            self.assertEqual(found.sources["size"] == "table of runs of the scene", larger)

    def test_error_of_the_ground_width_follows_its_study(self) -> None:
        effects = self.folder / "effects.csv"
        effects.write_text(
            "kind,body,edge,quantity,a,c,residual,runs\nsand,wheel,width,hub_drop_m,-0.8,0.5,0.01,9\n"
            "sand,wheel,depth,hub_drop_m,9,9,9,9\nsand,plate,width,hub_drop_m,9,9,9,9\n"
        )
        run = self.on_sand()
        run.domain = (2.0, 3 * WIDTH)  # a width on each side
        with mock.patch.object(whole_error, "EFFECTS", replace(whole_error.EFFECTS, name=str(effects))):
            found = RunErrors(run).all()
        self.assertAlmostEqual(found["hub_drop"].domain, 0.05 * math.hypot(0.8 * math.exp(-2), 0.01))
        self.assertEqual(found["hub_drop"].sources["domain"], "ground_size: sides 1 widths away")
        self.assertIn("domain", found["resistance_coefficient"].unknown)

    def test_pull_has_the_error_of_its_coefficient_times_the_load(self) -> None:
        found = RunErrors(self.on_sand()).all()
        self.assertAlmostEqual(found["drawbar_pull"].model, 1000.0 * found["resistance_coefficient"].model)

    def test_model_of_a_height_field_is_unknown(self) -> None:
        self.assertIn("model", RunErrors(self.read(ground="scm", size=0.01)).all()["hub_drop"].unknown)

    def test_varying_load_enters_the_error(self) -> None:
        run = self.on_sand()
        run.conditions["load"] = Condition(980.0, "N")
        found = RunErrors(run).all()
        self.assertAlmostEqual(found["hub_drop"].held, 0.05 * (1000 / 980 - 1))
        self.assertEqual(found["slip"].held, 0.0)

    def test_convergence_of_the_scene_has_priority_over_similar_wheels(self) -> None:
        script = self.folder / "scene.lig"
        script.write_text("# a scene\n")
        runs = [self.on_sand(size) for size in (0.08, 0.04, 0.02)]
        for run, drop in zip(runs, (0.058, 0.054, 0.052)):
            run.values["hub_drop"] = replace(run.values["hub_drop"], mean=drop, standard_error=1e-6)
        place = scene_errors.places(script, self.folder)[0]
        scene_errors.of_runs(place, script, runs, ("hub_drop", "slip")).write()
        stored = scene_errors.read_convergence(place)
        self.assertAlmostEqual(stored.series("hub_drop").order, 1.0, 3)
        runs[0].results.run["script"] = str(script)
        found = RunErrors(runs[0]).all()["hub_drop"]
        self.assertAlmostEqual(found.size, 0.008 * 0.058 / 0.05, 3)
        self.assertEqual(found.sources["size"], "scene.convergence.json: cells of 80, 40, 20 mm")
        script.write_text("# another scene\n")
        self.assertNotEqual(RunErrors(runs[0]).all()["hub_drop"].sources["size"], found.sources["size"])
        place.write_text(json.dumps({"sizes": [0.1]}))
        with self.assertRaisesRegex(ResultsError, "furrow-post converge SCENE"):
            scene_errors.read_convergence(place)

    def test_texts_have_total_errors_parts_and_nearest_tests(self) -> None:
        write_run(self.folder / "run", styles=[rigid_wheel(), rig()], torque=50.0)
        text, title = report(self.folder / "run"), headline(self.folder / "run")
        self.assertRegex(text, r"hub drop +50 ± \d+ mm \(time 1\.0, model \d+; mesh, step, contact, material unknown\)")
        self.assertRegex(text, r"nearest tests of hub drop: \d+ tests: ")
        self.assertRegex(title, r"^hub drop 50 ± \d+ mm.*\(\+ mesh, step, contact, material unknown\).*; torque 50.0 ± 0.5 N m.* \(over time only\)")

    def test_first_figure_has_the_total_error_over_the_nearest_tests(self) -> None:
        write_run(self.folder / "run", styles=[rigid_wheel(), rig()])
        run = read_wheel_run(self.folder / "run")
        run.ground, run.size = "continuum", 0.05
        run.conditions["density"] = Condition(1600.0, "kg/m3")
        run.conditions["wheel_diameter"] = Condition(0.3, "m")
        drop, resistance = whole_error.over_tests(run)
        budget = RunErrors(run).all()["hub_drop"]
        self.assertAlmostEqual(drop.value, 0.05 / 0.15)
        self.assertAlmostEqual(drop.error, budget.total / 0.15)
        self.assertIn(budget.sources["model"], drop.title)
        self.assertNotIn("towed", {test.case.motion for test in resistance.tests})
        self.assertEqual(resistance.sign, -1.0)  # these tests have a pull
        self.assertGreater(len(drop.tests), 1)
        draw_histories(Results(self.folder / "run"), self.folder / "run" / "histories.svg")
        drawn = (self.folder / "run" / "histories.svg").read_text()
        for text in ("measured hub drop over radius", "this run, 1 and 2 standard errors", "known tests"):
            self.assertIn(text, drawn)

    def test_stored_tests_have_the_measured_values(self) -> None:
        rows = [row for row in read_rows(VALIDATION / "snow_wheel" / "rows.csv") if row["used"] == "prediction" and row["refit_rut_depth_m"]]
        tests = [test for test in TESTS.stored() if test.study == "snow_wheel"]
        for quantity, column, scale in (("depth", "sinkage_m", 0.38), ("coefficient", "resistance", 1.0)):
            found = [scale * test.measured for test in tests if test.quantity == quantity]
            np.testing.assert_allclose(found, [float(row[column]) for row in rows], atol=1e-3)

    def test_case_has_grousers_and_slope(self) -> None:
        wheel = style("wheel", "wheel/rigid", "wheel", diameter=2 * RADIUS, width=WIDTH, mass=50, grousers=12)
        write_run(self.folder / "bars", styles=[wheel, rig()], torque=50.0, slip=-0.3)
        case = case_of(read_wheel_run(self.folder / "bars"))
        self.assertEqual((case.grousers, case.motion), ("yes", "braked"))

    def test_incomplete_run_has_its_error_over_time(self) -> None:
        write_run(self.folder / "part")
        (self.folder / "part" / "history.h5").unlink()
        found = whole_error.budgets_of(Path(self.folder / "part"))["hub_drop"]
        self.assertEqual((found.known, found.time), (["time"], 1e-3))
        self.assertRegex(report(self.folder / "part"), "only the error over time is known: .*history.h5")


if __name__ == "__main__":
    unittest.main()
