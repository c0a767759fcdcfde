# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post fit tyre with furrow-tyre: [Shoop2001]'s tyre from Table 6, and the files that come with
Furrow."""

import re
import shlex
import tempfile
import unittest
from pathlib import Path

import numpy as np
import yaml

from furrow_post.laws.tyre_estimate import Catalogue
from furrow_post.laws.tyre_fit import PlateTest, fit_tyre, press, read_tests
from furrow_post.laws.tyre_size import INCH, read_size
from support.command import SOURCE, run_post
from support.evaluation import stored

TYRES = SOURCE / "inputs" / "tyres"
ESTIMATES = ("lt265_75r16", "16_00r20", "710_70r38", "15x6_00_6")
TABLE6_LOAD = 6227.0  # [N] [Shoop2001] Table 6


def table6(used_for: str) -> list[PlateTest]:
    rows = stored("tyre_table6", "reference").query(f"used_for == '{used_for}'").set_index("pressure_kPa")
    measured = rows[["deflection_cm", "area_cm2", "section_width_cm"]]
    measured.columns = ["deflection_cm", "perimeter_area_cm2", "section_width_cm"]
    return [PlateTest(float(pressure), TABLE6_LOAD, row.to_dict()) for pressure, row in measured.iterrows()]


class MeasuredTyresTest(unittest.TestCase):
    def test_tyre_of_shoop_is_recovered_from_table_6(self) -> None:
        """Its tread width, section, belts and stiffnesses are known from Tables 6 and 8."""
        known = Catalogue(read_size("235/75R15"), 241e3, rim_width=6.5 * INCH, diameter=0.737)
        fit = fit_tyre(known, table6("identification"))
        true = {"belt_radius": 0.3475, "half_width": 0.0785, "section_width": 0.229}
        true |= {"belt_stiffness": 1.0, "sidewall_stiffness": 1.0}
        for parameter in fit.parameters:
            with self.subTest(name=parameter.name):
                self.assertLess(abs(np.log(parameter.value / true[parameter.name])), 2.0 * parameter.error)
        found = {parameter.name: parameter for parameter in fit.parameters}
        self.assertGreater(found["half_width"].determined, 0.5)
        self.assertGreater(found["section_width"].determined, 0.5)
        self.assertLess(max(fit.misfits().values()), 0.05)
        # the pressures between, which the shell tyre meets within 13 % (tyre_table6)
        between = table6("prediction")
        for test, state in zip(between, press(fit.file_text("Table 6", []), between)):
            for name, value in test.measured.items():
                self.assertLess(abs(state[name] / value - 1.0), 0.17, (test.pressure, name))

    def test_truck_tyre_agrees_with_its_curves(self) -> None:
        """[Goodyear2010]: the fitted file beside the same tyre without its tests."""
        tests = read_tests(TYRES / "measured" / "335_65r22_5.csv")
        known = Catalogue(read_size("335/65R22.5"), 414e3, rim_width=9 * INCH, diameter=0.9974, mass=55.4)
        text = (TYRES / "335_65r22_5.yaml").read_text(encoding="utf-8")
        fitted = misfit(press(text, tests), tests)
        guess = fit_tyre(known, []).file_text("335/65R22.5", [])
        self.assertLess(fitted, 0.06)
        self.assertLess(fitted, 0.7 * misfit(press(guess, tests), tests))
        (stated,) = re.findall(r"deflection_cm ([\d.]+) %", text)
        self.assertAlmostEqual(100.0 * fitted, float(stated), delta=0.5)


def misfit(states: list[dict[str, float]], tests: list[PlateTest]) -> float:
    """rms relative error of the deflections."""
    computed = [state["deflection_cm"] for state in states]
    measured = [test.measured["deflection_cm"] for test in tests]
    return float(np.sqrt(np.mean((np.divide(computed, measured) - 1.0) ** 2)))


class FilesTest(unittest.TestCase):
    def test_estimates_equal_the_output_of_their_command(self) -> None:
        """furrow-tyre reads them, and the rated load deflects them as is usual."""
        for name in ESTIMATES:
            text = (TYRES / f"{name}.yaml").read_text(encoding="utf-8")
            with self.subTest(name=name), tempfile.TemporaryDirectory() as folder:
                (command,) = re.findall(r"(?m)^# furrow-post fit tyre (.*)$", text)
                (source,) = re.findall(r"(?m)^# (.*)\n# furrow-post fit tyre", text)
                (title,) = re.findall(r"(?m)^title: (.*)$", text)
                self.assertIn("estimate", title)
                output = Path(folder) / "tyre.yaml"
                words = [*shlex.split(command), "--source", source, "--title", title]
                done = run_post("fit", "tyre", *words, "-o", output)
                self.assertEqual(done.returncode, 0, done.stderr)
                made = output.read_text(encoding="utf-8")
                self.assertEqual(yaml.safe_load(made), yaml.safe_load(text))
                share = float(re.findall(r"# Rated load: .* (\d+) % of the section", text)[0])
                self.assertTrue(12 <= share <= 30, share)
                self.assertNotIn("check load", done.stdout)
                (computed,) = re.findall(r"rated load .* (\d+) % of the section", done.stdout)
                self.assertAlmostEqual(float(computed), share, delta=1.0)

    def test_wrong_inputs_are_refused(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "tyre.yaml"
            there = Path(folder) / "there.yaml"
            there.write_text("mine", encoding="utf-8")
            for words, message in (
                (["15", "-o", output], "no size designation"),
                (["235/75R15", "-o", there], "exists; give another name"),
                (["235/75R15", "-o", Path(folder) / "no" / "x"], "is no folder"),
                (["235/75R15", "--diameter", "0.737", "-o", output], "check the size and the unit"),
                (["235/75R15", "--rim", "10", "-o", output], "a section is wider than both"),
                (["235/75R15", "--point", "241", "6227", "31", "-o", output], "give centimetres"),
                (["235/75R15", "--point", "241", "9e5", "3", "-o", output], "--load, at 241 kPa"),
                (["235/75R15", "--tests", there, "-o", output], "has no test"),
            ):
                with self.subTest(words=words):
                    done = run_post("fit", "tyre", *words, "--pressure", "241")
                    self.assertEqual(done.returncode, 1, done.stdout)
                    self.assertIn(message, done.stderr)
                    self.assertEqual(done.stderr.count("\n"), 1)
                    self.assertFalse(output.exists())
            self.assertEqual(there.read_text(encoding="utf-8"), "mine")
            words = ["235/75R15", "--pressure", "241", "--point", "241", "6227", "3.1", "--check"]
            done = run_post("fit", "tyre", *words, "-o", output)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("235/75R15, 1 tests; nothing is fitted", done.stdout)
            self.assertFalse(output.exists())


if __name__ == "__main__":
    unittest.main()
