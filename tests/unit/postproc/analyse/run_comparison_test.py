# SPDX-License-Identifier: GPL-2.0-or-later
"""Verdicts on two values, the verdict on all of them, and what pure functions leave alone."""

import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

from furrow_post.analyse import comparison, conditions
from furrow_post.analyse.comparison import Comparison, best_estimates
from furrow_post.uncertainty.budget import Budget
from furrow_post.uncertainty.cost_table import families
from furrow_post.analyse.curves import Curve, CurveKind, compare_curves
from furrow_post.analyse.density import height_left
from furrow_post.laws.prediction import Prediction
from furrow_post.uncertainty.verdict import BEST, COEFFICIENT, FORMULA, HUB_DROP, MEASURED, RUN
from furrow_post.uncertainty.verdict import Agreement, Entry, Quantity, remedies, verdict_between
from furrow_post.errors import ResultsError
from furrow_post.read.results import Results, Surface
from furrow_post.run.summary import SteadyValue
from furrow_post.read.wheel_run import Condition, WheelRun, read_wheel_run
from support.folder import FolderTest
from support.runs import write_run
from support.tables import CONTINUUM, row


def entry(
    source: str, value: float, u: float, quantity: Quantity = HUB_DROP, kind: str = RUN
) -> Entry:
    return Entry(quantity, source, value, Budget(u, 0.0, 0.0, 0.0), kind)


class VerdictTest(unittest.TestCase):
    def test_limit_of_agreement_is_two_standard_deviations(self) -> None:
        a = entry("a", 0.100, 0.003)
        near = verdict_between(a, entry("b", 0.100 + 2 * 0.005 - 1e-6, 0.004))
        far = verdict_between(a, entry("b", 0.100 + 2 * 0.005 + 1e-6, 0.004))
        self.assertEqual((near.agreement, far.agreement), (Agreement.AGREE, Agreement.DIFFER))
        self.assertIn("a and b differ: b - a = +10 mm (+10 %), 10 allowed", far.sentence)

    def test_agreement_within_a_large_uncertainty_is_inconclusive(self) -> None:
        verdict = verdict_between(entry("a", 0.1, 0.02), entry("b", 0.11, 0.0))
        self.assertEqual(verdict.agreement, Agreement.INCONCLUSIVE)
        self.assertIn("inconclusive, too large: time of a: b - a = +10 mm (+10 %), 40 allowed", verdict.sentence)

    def test_missing_uncertainty_is_inconclusive(self) -> None:
        other = Entry(HUB_DROP, "b", 0.1, Budget(), MEASURED)
        verdict = verdict_between(entry("a", 0.1, 0.001), other)
        self.assertEqual(verdict.agreement, Agreement.INCONCLUSIVE)
        self.assertIn("inconclusive, unknown: uncertainty of b", verdict.sentence)

    def test_unknown_part_of_the_error_is_inconclusive(self) -> None:
        for value in (0.1, 0.2):
            other = Entry(HUB_DROP, "b", value, Budget(time=0.001), RUN)
            verdict = verdict_between(entry("a", 0.1, 0.001), other)
            self.assertEqual(verdict.agreement, Agreement.INCONCLUSIVE)
            self.assertEqual(verdict.unknown, ("domain of b", "packing of b", "size of b"))
            self.assertIn("inconclusive, unknown: domain of b, packing of b, size of b", verdict.sentence)
            self.assertIn("2.8 allowed by the known parts", verdict.sentence)

    def test_unsteady_value_has_no_known_error_over_time(self) -> None:
        verdict = verdict_between(entry("a", 0.1, 0.001), replace(entry("b", 0.1, 0.001), steady=False))
        self.assertEqual((verdict.agreement, verdict.unknown), (Agreement.INCONCLUSIVE, ("time of b",)))
        self.assertEqual(remedies(verdict.unknown), ["time average (b): a longer run"])

    def test_unknown_parts_list_the_run_that_determines_them(self) -> None:
        other = Entry(HUB_DROP, "b", 0.1, Budget(time=0.001), RUN)
        sizes, ground, packings, command = remedies(verdict_between(entry("a", 0.1, 0.001), other).unknown)
        self.assertRegex(sizes, r"^size of cells or grains \(b\): .*-v cell")
        self.assertRegex(ground, r"^size of the ground \(b\): .*-v width")
        self.assertRegex(packings, r"^packing of grains \(b\): .*-v seed")
        self.assertIn("furrow-post cost RUNS... --write errors.csv", command)
        self.assertEqual(remedies(verdict_between(entry("a", 0.1, 0.001), entry("b", 0.1, 0.001)).unknown), [])


class CurvesTest(unittest.TestCase):
    def verdict(self, factor: float, ground: str = "continuum") -> str:
        stress = np.geomspace(1e3, 1e6, 30)
        density = 1 + 0.1 * np.log(stress / 1e3)
        curves = [
            Curve(label, CurveKind.OEDOMETER, ground, stress, y, {"density": 200.0}, np.zeros(30))
            for label, y in (("a", density), ("b", factor * density))
        ]
        return compare_curves(curves).verdict()

    def test_curves_of_material_points_agree_or_differ(self) -> None:
        what = "compression (density over that at the start) at equal stress"
        self.assertEqual(self.verdict(1.0), f"The curves agree in {what}.")
        self.assertEqual(self.verdict(1.01), f"The curves differ in {what}.")

    def test_grains_of_one_packing_and_size_are_inconclusive(self) -> None:
        self.assertIn("unknown: packing of a, size of a, packing of b", self.verdict(1.0, "grains"))


class OverallTest(unittest.TestCase):
    """The verdict comes from the enumeration, never from words."""

    def verdict(self, *pairs: tuple[Entry, Entry]) -> str:
        return Comparison([], verdicts=[verdict_between(a, b) for a, b in pairs]).overall()

    def test_every_verdict_has_a_sentence(self) -> None:
        agree = entry("a", 0.1, 0.003), entry("b", 0.101, 0.003)
        differ = entry("a", 0.1, 0.003), entry("b", 0.2, 0.003)
        vague = entry("a", 0.2, 0.1, COEFFICIENT), entry("b", 0.21, 0.1, COEFFICIENT)
        unknown = entry("a", 0.2, 0.1), Entry(HUB_DROP, "b", 0.2, Budget(0.1, packing=0.0), RUN)
        self.assertEqual(self.verdict(agree), "The runs agree in hub drop.")
        self.assertEqual(self.verdict(differ), "The runs differ in hub drop.")
        self.assertEqual(
            self.verdict(agree, vague),
            "The runs agree in hub drop. Inconclusive in resistance coefficient; the uncertainty is "
            "too large.",
        )
        self.assertEqual(
            self.verdict(unknown), "Inconclusive in hub drop; unknown: domain of b, size of b."
        )
        self.assertEqual(
            self.verdict(differ, vague),
            "The runs differ in hub drop. Inconclusive in resistance coefficient; the uncertainty is "
            "too large.",
        )
        self.assertEqual(self.verdict(), "")

    def test_run_can_have_the_name_measured(self) -> None:
        values = entry("a", 0.1, 0.003), entry("measured", 0.2, 0.003)
        self.assertEqual(self.verdict(values), "The runs differ in hub drop.")

    def test_run_can_have_the_name_of_a_verdict(self) -> None:
        values = entry("inconclusive", 0.1, 0.003), entry("unknown", 0.1, 0.003)
        self.assertEqual(self.verdict(values), "The runs agree in hub drop.")

    def test_overall_verdict_excludes_measurements(self) -> None:
        measured = entry("measured", 0.1, 0.001, kind=MEASURED)
        self.assertEqual(self.verdict((measured, entry("b", 0.2, 0.001))), "")


class CompareTest(FolderTest):
    def read(self, name: str, label: str, sinkage: float = 0.05) -> WheelRun:
        write_run(self.folder / name, sinkage=sinkage)
        return read_wheel_run(self.folder / name, label)

    def test_labels_become_unique_without_change_of_the_runs(self) -> None:
        runs = [self.read("one/wheel", "wheel"), self.read("two/wheel", "wheel")]
        result = comparison.compare(runs)
        self.assertEqual([run.label for run in result.runs], ["one/wheel", "two/wheel"])
        self.assertEqual([run.label for run in runs], ["wheel", "wheel"])

    def test_slip_is_a_condition_unless_all_wheels_are_towed(self) -> None:
        runs = [self.read("a", "a"), self.read("b", "b")]
        runs[1].conditions["slip"] = Condition(runs[0].number("slip") - 0.1)
        for modes, differences in (
            (("slip", "slip"), ["slip"]),
            (("towed", "slip"), ["slip"]),
            (("towed", "towed"), []),
        ):
            for run, mode in zip(runs, modes):
                run.conditions["mode"] = Condition(mode)
            found = [difference.condition for difference in conditions.incomparable(runs)]
            self.assertEqual(found, differences, modes)

    def test_different_slips_of_towed_wheels_give_a_remark(self) -> None:
        runs = [self.read("a", "a"), self.read("b", "b")]
        for run, slip in zip(runs, (-0.03, -0.09)):
            run.conditions["mode"] = Condition("towed")
            run.conditions["slip"] = Condition(slip)
        remarks = comparison.compare(runs).remarks
        self.assertIn("a slips by -3 % and b by -9 %, more than 3 % apart", remarks)

    def test_another_definition_of_slip_is_not_comparable(self) -> None:
        runs = [self.read("a", "a"), self.read("b", "b")]
        self.assertEqual(runs[0].text("slip_definition"), "bare radius, forward speed")
        runs[1].conditions["slip_definition"] = Condition("tip radius, forward speed")
        found = [difference.condition for difference in conditions.incomparable(runs)]
        self.assertEqual(found, ["slip definition"])

    def test_run_named_measured_is_compared_as_any_other(self) -> None:
        runs = [self.read("a", "measured"), self.read("b", "b", sinkage=0.06)]
        result = comparison.compare(runs)
        self.assertEqual(
            result.overall(),
            "Inconclusive in hub drop and resistance coefficient; unknown: size of b, size of measured.",
        )

    def test_measurements_are_compared_with_every_run(self) -> None:
        reference = self.folder / "reference.csv"
        rows = "".join(f"0.2,{0.05 + k * 1e-3},0.2,200\n" for k in (-1, 0, 1))
        reference.write_text("# made\ndepth_m,sinkage_m,resistance,density_kgm3\n" + rows)
        run = self.read("a", "a")
        run.conditions["depth"] = Condition(0.2, "m")
        result = comparison.compare([run], measured=reference)
        self.assertTrue(all(verdict.with_measurement for verdict in result.verdicts))
        self.assertEqual(
            result.overall(),
            "Inconclusive in hub drop and resistance coefficient; unknown: size of a.",
        )
        run.conditions["depth"] = Condition(0.5, "m")
        message = "has 0 rows within 10 % of a depth of 0.5 m; a scatter needs three"
        with self.assertRaisesRegex(ResultsError, message):
            comparison.compare([run], measured=reference)

    def test_best_estimates_of_runs_are_compared(self) -> None:
        # 60 mm with cells of 40 mm, on a line that falls to 52 mm
        run, other = self.read("a", "a", sinkage=0.06), self.read("b", "b", sinkage=0.06)
        run.ground, run.half, run.size = CONTINUUM.ground, True, 0.04
        table = [
            row(f"{h}", "continuum", h, 0.01 + 0.2 * h, 0.2, 1.0, seed="", error=1e-6)
            for h in (0.02, 0.03, 0.04)
        ]
        table += [replace(table[0], run="wide", domain="1.1x1")]
        known = families(table)
        limit, _ = best_estimates(run, known)
        self.assertAlmostEqual(limit.value, 0.06 - 0.2 * 0.04, places=5)
        self.assertEqual((limit.label, limit.source), ("a, best estimate", "a"))
        self.assertEqual(best_estimates(other, known), [])  # of no family

        same = entry("b", 0.0521, 1e-3, kind=BEST)
        verdict = verdict_between(limit, same)
        self.assertIn("hub drop, best estimate: a and b agree", verdict.sentence)
        result = Comparison([run, other], [limit, same], best_estimates=[verdict])
        self.assertEqual(
            result.overall_of_best_estimates(),
            "Best estimate: The runs agree in hub drop.",
        )
        self.assertIn(verdict.sentence, result.findings())
        kinds = [line["kind"] for line in comparison.table_rows(result)]
        self.assertEqual(kinds, [BEST] * 2)
        self.assertEqual(Comparison([run]).overall_of_best_estimates(), "")

    def test_formula_is_listed_without_a_verdict(self) -> None:
        prediction = Prediction("made", "nowhere", 0.04, 100.0, 1000.0)
        result = comparison.compare([self.read("a", "a")], formulas=[prediction])
        (found,) = result.of(HUB_DROP, FORMULA)
        self.assertEqual((found.source, found.value), ("made", 0.04))
        self.assertEqual(result.verdicts, [])
        said = comparison.comparison_report(result).split("Verdict\n")[1]
        self.assertEqual(said, "  none: there is nothing to compare the run with")


class TyreResults(Results):
    """A tyre whose lowest point stands at 0.34 m."""

    def __init__(self) -> None:
        pass

    def surface(self) -> Surface:
        return Surface(np.empty((0, 3), int), np.array([[0.0, 0.0, 0.34], [0.1, 0.0, 0.4]]))


class HeightLeftTest(unittest.TestCase):
    def test_height_left_under_a_tyre_includes_the_deflection(self) -> None:
        """0.2 m of ground up to 0.5 m; sinkage of the unloaded outline 0.18 m: 20 mm further up."""
        run = WheelRun(Path(), TyreResults(), "", "continuum", deformable=False)
        run.conditions = {"depth": Condition(0.2), "ground_level": Condition(0.5)}
        run.values = {"hub_drop": SteadyValue(0.18, 0.0, "m", True)}
        self.assertAlmostEqual(height_left(run), 0.02)
        run.deformable = True
        self.assertAlmostEqual(height_left(run), 0.04)


if __name__ == "__main__":
    unittest.main()
