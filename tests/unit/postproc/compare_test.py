# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post compare, cost, choose and report on made runs with known answers; refusals with their words."""

import csv
import dataclasses
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

SOURCE = Path(os.environ["FURROW_SOURCE"])
sys.path.insert(0, str(SOURCE / "postproc"))

import h5py
import numpy as np

from furrow_post import compare, conditions, cost, cost_table, curves, density
from furrow_post.results import ResultsError

FURROW_POST = SOURCE / "postproc" / "furrow-post"


def row(name, ground, size, sinkage, coefficient, cpu, domain="2x1", seed="1", options="", error=0.0):
    return cost_table.Row(name, ground, "half" if ground == "continuum" else "whole", "rigid wheel", size, domain, seed, sinkage, error,
                          coefficient, error, cpu, options)


def made_runs():
    """Continuum: exact f0 + C h with f0 = 0.1 m and 0.2; grains: another line, with two packings and a wider domain."""
    rows = [row(f"c{h}", "continuum", h, 0.1 * (1 + 2 * h), 0.2 * (1 - 5 * h), 1e-4 / h**4, seed="", options=f"wheel -v cell {h}", error=1e-9)
            for h in (0.04, 0.02, 0.01)]
    rows += [row(f"g{h}", "grains", h, 0.12 * (1 + 3 * h), 0.25, 5e-4 / h**4, options=f"grains -v diameter {h}", error=1e-9) for h in (0.04, 0.02)]
    rows.append(row("seed", "grains", 0.04, 0.12 * 1.12 + 0.002, 0.25, 1.0, seed="2"))
    rows.append(row("wide", "grains", 0.04, 0.12 * 1.12 - 0.005, 0.26, 1.0, domain="2x2"))
    return rows


class Table(unittest.TestCase):
    def test_extrapolation_and_components_are_those_of_the_lines(self):
        families = cost_table.families(made_runs())
        f0, C, _ = families["continuum", "half", "rigid wheel"].fit("sinkage")
        self.assertAlmostEqual(f0, 0.1, places=9)
        self.assertAlmostEqual(C, 0.2, places=7)
        parts = families["grains", "whole", "rigid wheel"].components("sinkage", 0.03, 1e-4)
        self.assertAlmostEqual(parts.size, 0.12 * 3 * 0.03, places=7)
        self.assertAlmostEqual(parts.packing, 0.002 / math.sqrt(2), places=9)
        self.assertAlmostEqual(parts.domain, 0.005, places=9)
        self.assertAlmostEqual(parts.total, math.sqrt(1e-8 + 0.0108**2 + 0.002**2 / 2 + 0.005**2), places=7)

    def test_one_size_gives_no_error(self):
        family = cost_table.families([row("a", "grains", 0.04, 0.1, 0.2, 1.0)])["grains", "whole", "rigid wheel"]
        self.assertIsNone(family.fit("sinkage"))
        self.assertEqual(family.components("sinkage", 0.04).known, [])
        with self.assertRaisesRegex(ResultsError, "add a run of another size, or longer runs"):
            cost.recommend(cost.assess([row("a", "grains", 0.04, 0.1, 0.2, 1.0)]), 0.1)

    def test_recommends_the_cheapest_within_the_error(self):
        slow = row("slow", "continuum", 0.02, 0.1 * 1.04, 0.2 * 0.9, 2e3, seed="", error=1e-9)  # as c0.02, at three times its cost
        assessed = cost.assess(made_runs() + [slow])
        errors = {a.row.run: a.error for a in assessed}
        self.assertAlmostEqual(errors["c0.04"], 0.2, places=4)  # the coefficient's 5 h is the worse
        self.assertAlmostEqual(errors["c0.02"], 0.1, places=4)
        # sizes 3 h, packing and domain of the sinkage
        self.assertAlmostEqual(errors["g0.02"], math.sqrt(0.06**2 + (0.002 / 0.12) ** 2 / 2 + (0.005 / 0.12) ** 2), places=4)
        self.assertEqual({a.row.run for a in assessed if not a.pareto}, {"slow"})
        for wanted, name, reached in ((0.101, "c0.02", True), (0.08, "g0.02", True), (0.001, "c0.01", False)):
            choice, within = cost.recommend(assessed, wanted)
            self.assertEqual((choice.row.run, within), (name, reached))

    def test_another_wheel_errs_by_the_difference_of_values_at_size_zero(self):
        tyres = [dataclasses.replace(r, run="t" + r.run, wheel="tyre", model="whole", sinkage=1.25 * r.sinkage, cpu_time=9 * r.cpu_time)
                 for r in made_runs() if r.ground == "continuum"]
        assessed = {a.row.run: a for a in cost.assess(made_runs() + tyres, "tyre")}
        stand_in, tyre = assessed["c0.01"], assessed["tc0.01"]
        self.assertAlmostEqual(tyre.error, 0.05, places=4)                      # its own size, as before
        self.assertEqual(tyre.models["sinkage"], 0.0)
        self.assertAlmostEqual(stand_in.models["sinkage"], 0.2, places=6)       # 0.1 m for 0.125 m
        self.assertAlmostEqual(stand_in.errors["sinkage"], math.hypot(0.2, 0.2 * 0.01 / 0.125), places=4)
        self.assertAlmostEqual(stand_in.references["sinkage"], 0.125, places=6)
        self.assertTrue(math.isnan(assessed["g0.02"].error))                    # no tyre on grains to be judged by
        self.assertEqual(cost.recommend(list(assessed.values()), 0.101)[0].row.run, "tc0.02")
        self.assertEqual(cost_table.wanted_wheel(["# made", "# wheel: tyre"]), "tyre")

    def test_size_and_cost_beyond_the_table(self):
        # coefficient error 5 h = 1 % at h = 2 mm, cost 1e-4/h^4
        (family, size, seconds), *_ = cost.needed(cost.assess([r for r in made_runs() if r.ground == "continuum"]), 0.01)
        self.assertEqual(family, ("continuum", "half", "rigid wheel"))
        self.assertAlmostEqual(size, 0.002, delta=2e-5)
        self.assertAlmostEqual(seconds / (1e-4 / 0.002**4), 1, delta=0.05)

    def test_written_table_comes_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "t.csv"
            cost_table.write(path, made_runs(), ["# made"])
            rows, comments = cost_table.read(path)
            self.assertEqual([r.run for r in rows], [r.run for r in made_runs()])
            self.assertEqual(comments, ["# made"])
            path.write_text("run,ground\na,b\n")
            with self.assertRaisesRegex(ResultsError, "has no column model; columns are run, ground"):
                cost_table.read(path)


class Verdict(unittest.TestCase):
    def entry(self, source, value, u):
        return compare.Entry("sinkage", source, value, cost_table.Components(time=u, size=0.0, domain=0.0, packing=0.0), "run")

    def test_two_standard_deviations_decide(self):
        a = self.entry("a", 0.100, 0.003)
        self.assertTrue(compare.judge(a, self.entry("b", 0.100 + 2 * 0.005 - 1e-6, 0.004))[1])
        text, agree = compare.judge(a, self.entry("b", 0.100 + 2 * 0.005 + 1e-6, 0.004))
        self.assertFalse(agree)
        self.assertIn("differ by 1.0 times what their uncertainty allows (difference +10 mm (+10 %), allowed 10)", text)

    def test_no_uncertainty_no_verdict(self):
        other = compare.Entry("sinkage", "b", 0.1, cost_table.Components(), "run")
        text, agree = compare.judge(self.entry("a", 0.1, 0.001), other)
        self.assertIsNone(agree)
        self.assertIn("b has no uncertainty", text)

    def test_unknown_parts_are_named(self):
        other = compare.Entry("sinkage", "b", 0.1, cost_table.Components(time=0.001), "run")
        self.assertIn("not known: domain of b, packing of b, size of b", compare.judge(self.entry("a", 0.1, 0.001), other)[0])


class Track(unittest.TestCase):
    def test_height_left_under_a_tyre_counts_its_deflection(self):
        """0.2 m of ground up to 0.5 m; sinkage of the unloaded outline 0.18 m, the tread's lowest point at 0.34 m: 20 mm further up."""
        value = lambda v: SimpleNamespace(value=v, mean=v)
        surface = (np.empty((0, 3), int), np.array([[0.0, 0.0, 0.34], [0.1, 0.0, 0.4]]))
        run = SimpleNamespace(wheel="rigid wheel", conditions={"depth": value(0.2)}, values={"sinkage": value(0.18)}, ground_level=0.5,
                              results=SimpleNamespace(surface=lambda: surface))
        self.assertAlmostEqual(density.height_left(run), 0.02)
        run.wheel = "tyre"
        self.assertAlmostEqual(density.height_left(run), 0.04)


def write_run(folder, load=1000.0, sinkage=0.05, datum=0.0):
    """A wheel of 0.6 m x 0.2 m on ground without grains, steady from 1 s on."""
    folder.mkdir(parents=True)
    time = np.arange(2000) * 1e-3
    phase = np.where(time < 0.5, 0.0, np.where(time < 0.8, 1.0, 2.0))
    v = np.where(time > 0.65, 1.0, 0.0)
    one = np.ones_like(time)
    columns = {"time": time, "phase": phase, "x": np.maximum(time - 0.65, 0), "y": 0 * one, "z": 0.3 * one, "velocity_x": v,
               "spin_rate": v / 0.3 * 1.25, "sinkage": sinkage * np.minimum(time / 0.5, 1), "force_x": -0.2 * load * v, "force_y": 0 * one,
               "force_z": load * one, "drawbar_pull": -0.2 * load * v, "drive_torque": 0 * one, "slip": 0.2 * v}
    with h5py.File(folder / "history.h5", "w") as content:
        run = content.create_group("run")
        for name, value in (("title", "made"), ("version", "test"), ("script", "none"), ("started", "2026-01-01T00:00:00Z")):
            run.attrs[name] = np.bytes_(value)
        run.attrs["ranks"] = 1
        run["effective_input"] = np.bytes_(
            "# styles with their effective values\nfix wheel all wheel/rigid diameter 0.6 width 0.2 mass 50\n"
            f"fix rig all wheel/rig load_force {load} speed 1 mode slip slip 0.2 slip_angle 0 camber 0 ground_level {datum} gravity 9.80665\n")
        group = content.create_group("history", track_order=True)
        for name, values in columns.items():
            group[name] = values
            group[name].attrs["unit"], group[name].attrs["meaning"] = np.bytes_(" "), np.bytes_(name)
    quantity = lambda mean, error, unit: {"mean": mean, "standard_error": error, "unit": unit, "steady": True, "verdict": "steady"}
    (folder / "summary.json").write_text(json.dumps({"window": {"start": 1.0, "end": 1.9}, "quantities": {
        "sinkage": quantity(sinkage, 1e-3, "m"), "resistance_coefficient": quantity(0.2, 0.01, ""), "force_z": quantity(load, 1.0, "N"),
        "drawbar_pull": quantity(-0.2 * load, 1.0, "N"), "drive_torque": quantity(0.0, 0.0, "N m"), "slip": quantity(0.2, 0.0, "")}}))


def plate_curve(label, factor, box=0.8, **facts):
    """p = factor x 1 MPa/m z."""
    z = np.linspace(1e-4, 0.05, 200)
    return curves.Curve(label, "plate", "grains", z, 1e6 * factor * z, {"depth": 0.1, "box": box, **facts}, np.zeros(200))


class CurveErrors(unittest.TestCase):
    base = plate_curve("base", math.exp(5 * 0.02), diameter=0.02)

    def test_errors_are_those_of_the_checks(self):
        checks = [plate_curve("coarse", math.exp(5 * 0.04), diameter=0.04), plate_curve("seed", 1.1 * math.exp(5 * 0.04), diameter=0.04),
                  plate_curve("wide", 0.9 * math.exp(5 * 0.02), box=1.2, diameter=0.02)]
        found = curves.numerical_errors(self.base, checks, [0.01, 0.02])
        np.testing.assert_allclose(found["size"], 5 * 0.02, rtol=1e-9)   # ln p is linear in the size
        np.testing.assert_allclose(found["packing"], math.log(1.1) / math.sqrt(2), rtol=1e-9)
        np.testing.assert_allclose(found["domain"], -math.log(0.9), rtol=1e-9)
        self.assertTrue(all(np.isnan(v).all() for v in curves.numerical_errors(self.base, [], [0.01]).values()))
        # beyond the end of a check nothing is known
        self.assertTrue(np.isnan(curves.numerical_errors(self.base, checks, [0.06])["size"][0]))

    def test_verdict_names_what_is_not_known(self):
        other = plate_curve("other", 1.3 * math.exp(5 * 0.02), diameter=0.02)
        result = curves.compare([self.base, other])
        none = {name: np.full(len(result.levels), np.nan) for name in ("size", "domain", "packing")}
        known = {name: np.full(len(result.levels), 0.1) for name in ("size", "domain", "packing")}
        self.assertEqual(curves.judge(result, 1, [known, none]), "base and other agree within their uncertainty at every level (allowed 35 %); "
                         "not known: size of other, domain of other, packing of other")
        far = curves.compare([self.base, plate_curve("far", 2.0, diameter=0.02)])
        self.assertEqual(curves.judge(far, 1, [known, known]), "base and far differ at every level (allowed 49 %)")
        large = {name: np.full(len(result.levels), 0.2) for name in ("size", "domain", "packing")}
        self.assertIn("base and other cannot be told apart at every level", curves.judge(result, 1, [large, known]))


def write_plate(folder, k, size=0.1, speed=0.5):
    """p = k z up to 20 mm, ground of 0.05 m."""
    folder.mkdir(parents=True)
    z = np.linspace(-0.001, 0.02, 400)
    pressure = k * np.maximum(z, 0)
    np.savetxt(folder / "curve.txt", np.column_stack([np.arange(400), z, pressure * size**2, pressure]))
    (folder / "facts.txt").write_text(f"test plate family made size {size} depth 0.05 speed {speed}\n")


class Balanced(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.images = [], 0

    def handle_startendtag(self, tag, attributes):
        self.images += tag == "img"

    def handle_starttag(self, tag, attributes):
        self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        write_run(cls.folder / "a")
        write_run(cls.folder / "b", sinkage=0.051)
        write_run(cls.folder / "heavy", load=1100.0)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def run_post(self, *words):
        return subprocess.run([str(FURROW_POST), *map(str, words)], capture_output=True, text=True, timeout=240, cwd=self.folder)

    def test_slip_in_both_definitions(self):
        run = conditions.read(self.folder / "a")
        self.assertAlmostEqual(run.conditions["slip"].value, 0.2, places=12)
        self.assertAlmostEqual(run.conditions["slip_by_vehicle_speed"].value, 0.25, places=12)  # i = s/(1 - s)

    def test_refuses_another_load_and_says_why(self):
        done = self.run_post("compare", "a", "heavy", "-o", "refused")
        self.assertEqual(done.returncode, 1)
        self.assertIn("these runs are not comparable:\n  load: a: 1000 N; heavy: 1100 N (they may differ by 2 %)", done.stderr)
        self.assertFalse((self.folder / "refused").exists())
        done = self.run_post("compare", "a", "heavy", "-o", "anyway", "--anyway")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("COMPARED ALTHOUGH CONDITIONS DIFFER", done.stdout)

    def test_compare_writes_table_and_figure(self):
        done = self.run_post("compare", "one=a", "two=b", "-o", "both")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("sinkage: one and two agree within their uncertainty (difference +1 mm (+2 %), allowed 2.8)", done.stdout)
        with open(self.folder / "both" / "compare.csv", encoding="utf-8") as file:
            lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual([(r["quantity"], r["source"], float(r["value"])) for r in lines[:3]],
                         [("sinkage", "one", 0.05), ("resistance coefficient", "one", 0.2), ("sinkage", "two", 0.051)])
        self.assertEqual(lines[0]["u_size"], "")  # not known is not zero
        with h5py.File(self.folder / "both" / "compare.h5", "r") as content:
            self.assertAlmostEqual(content["runs/two/history/sinkage"][-1], 0.051)
        self.assertGreater((self.folder / "both" / "compare.png").stat().st_size, 20000)

    def test_plates_are_compared_at_equal_sinkage(self):
        write_plate(self.folder / "soft", 1e6)
        write_plate(self.folder / "stiff", 1.5e6)
        write_plate(self.folder / "large", 1e6, size=0.2)
        done = self.run_post("compare", "soft", "stiff", "-o", "plates")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("stiff differs from soft by +50 % on average, rms ln-ratio 0.405", done.stdout)
        with open(self.folder / "plates" / "compare.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual([float(r["level"]) for r in rows], [0.0025, 0.005, 0.01, 0.015])
        self.assertAlmostEqual(float(rows[2]["soft"]), 1e4, delta=10)
        done = self.run_post("compare", "soft", "large", "-o", "refused")
        self.assertEqual(done.returncode, 1)
        self.assertIn("these tests are not comparable:\n  size: soft: 0.1; large: 0.2 (they may differ by 2 %)", done.stderr)

    def test_report_is_one_page(self):
        done = self.run_post("report", "one=a", "two=b", "-o", "page/report.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "page" / "report.html").read_text(encoding="utf-8")
        parser = Balanced()
        parser.feed(text.replace("<!DOCTYPE html>", ""))
        self.assertEqual(parser.open, [])
        self.assertEqual(parser.images, 3)
        self.assertNotIn("src=\"http", text)
        self.assertNotIn(str(self.folder), text)  # no path of this machine
        for name in ("report.csv", "report.h5"):
            self.assertTrue((self.folder / "page" / name).is_file())

    def test_choose_and_held(self):
        cost_table.write(self.folder / "made.csv", made_runs())
        done = self.run_post("choose", "made.csv", "--error", "10.1%")
        self.assertEqual((done.returncode, done.stdout), (0, "wheel\n-v\ncell\n0.02\n"), done.stderr)
        self.assertIn("For 10.1 % error use continuum, cells of 20 mm, half model, rigid wheel", done.stderr)
        done = self.run_post("choose", "made.csv", "--error", "10.1%", "--held", "a")
        self.assertIn("sinkage: 0.0500 ± 0.0010, -50.0 % from the value at size zero (0.1), allowed 12 %: NOT HELD", done.stdout)
        self.assertIn("The estimate did not hold", done.stdout)
        self.assertEqual(self.run_post("choose", "made.csv", "--error", "200%").returncode, 2)


if __name__ == "__main__":
    unittest.main()
