# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and curves of made runs with known answers: coefficients, errors, packings, axes."""

import json
import math
import re
import unittest
from collections import defaultdict
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import h5py

from furrow_post.uncertainty.budget import Budget
from furrow_post.uncertainty.cost_table import FamilyKey
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.figures.resistance_parts import COLOURS
from furrow_post.formatting import with_error
from furrow_post.run.record import Record
from furrow_post.sweep.sweep_curves import EFFICIENCY, PULL, HUB_DROP, TORQUE
from furrow_post.sweep.drawing import draw_sweep
from furrow_post.sweep.sweep_files import Named, Wanted, evaluate, report_lines, write_sweep
from furrow_post.sweep.sweep_plan import PlannedRun, SweepPlan
from furrow_post.sweep.series import read_series
from support.command import SOURCE
from support.folder import FolderTest
from support.runs import RADIUS, add_parts, rig, rigid_wheel, write_run

LOAD = 2000.0  # [N]
# slip, drawbar pull over load, torque [N m]
PULLING = ((-0.2, -0.3, -60.0), (0.1, 0.1, 120.0), (0.3, 0.25, 240.0))


def finished(folder: Path, error: str = "") -> None:
    Record({}, "", {}, "", "2026-01-01T00:00:00Z", 1.0, 1.5, 0.1, error=error).write(folder)


class KnownSize:
    """A family of runs whose error has this part of the size of the cells."""

    SIZE = 0.02

    def components(self, key: str, size: float, time_error: float) -> Budget:
        return Budget(time_error, self.SIZE, math.nan, 0.0)


def write_pulling(folder: Path, sinkage: float = 0.05) -> None:
    """A sweep over slip of three points."""
    points = []
    for slip, pull, torque in PULLING:
        name = f"slip_{slip:g}"
        write_run(folder / name, LOAD, sinkage, slip=slip, pull=pull, torque=torque)
        finished(folder / name)
        points.append(PlannedRun(name, {"slip": f"{slip:g}"}))
    SweepPlan("scene.lig", ("slip",), points=tuple(points)).write(folder)


class OutputTest(FolderTest):
    def test_pull_slip_curve_has_coefficients(self) -> None:
        write_pulling(self.folder / "a")
        result = evaluate([Named(self.folder / "a")], Wanted())
        self.assertEqual(
            [curve.name for curve in result.figure.curves],
            ["pull–slip", "torque–slip", "tractive efficiency", "hub drop–slip"],
        )
        (line,) = result.figure.lines
        for (x, _, value), (slip, pull, torque) in zip(line.values(PULL), PULLING):
            self.assertAlmostEqual(x, slip, 9)
            self.assertAlmostEqual(value.mean, pull, 9)
            error = math.hypot(1.0 / LOAD, pull * 1.0 / LOAD)  # 1 N of each of them
            self.assertAlmostEqual(value.parts.time, error, 12)
        for (_, _, value), (_, _, torque) in zip(line.values(TORQUE), PULLING):
            self.assertAlmostEqual(value.mean, torque / (LOAD * RADIUS), 9)
        efficiency = [value.mean for _, _, value in line.values(EFFICIENCY)]
        expected = [p * LOAD * (1 - s) * RADIUS / t for s, p, t in PULLING[1:]]
        self.assertEqual([round(e, 9) for e in efficiency], [round(e, 9) for e in expected])

    def test_efficiency_is_independent_of_the_slip_radius(self) -> None:
        write_pulling(self.folder / "a")
        tips = 1.08  # over the radius without grousers: the slip is by the tips
        for file in (self.folder / "a").glob("*/history.h5"):
            with h5py.File(file, "a") as content:
                content["history/spin_rate"][...] /= tips
        (line,) = evaluate([Named(self.folder / "a")], Wanted()).figure.lines
        efficiency = [value.mean for _, _, value in line.values(EFFICIENCY)]
        expected = [p * LOAD * (1 - s) * tips * RADIUS / t for s, p, t in PULLING[1:]]
        self.assertEqual([round(e, 9) for e in efficiency], [round(e, 9) for e in expected])

    def test_slip_of_free_wheels_is_a_result(self) -> None:
        for slope in (0.0, 5.0, 10.0):
            free = rig(LOAD)
            free["options"].update(travel=["free"], slope=[slope])
            write_run(
                self.folder / f"{slope:g}",
                LOAD,
                styles=[rigid_wheel(), free],
                slip=0.02 + 0.03 * slope,
                pull=math.tan(math.radians(slope)),
                torque=100.0,
            )
        result = evaluate([Named(self.folder)], Wanted())  # slopes are all that differs
        self.assertEqual(
            [curve.name for curve in result.figure.curves],
            [
                "slope–slip",
                "torque against slope",
                "tractive efficiency against slope",
                "hub drop against slope",
            ],
        )
        (line,) = result.figure.lines
        for (x, _, value), slope in zip(line.values(result.figure.curves[0].y), (0.0, 5.0, 10.0)):
            self.assertAlmostEqual(x, slope)
            self.assertAlmostEqual(value.mean, 0.02 + 0.03 * slope)
        # the same runs as a pull-slip curve, beside those of another rig
        pulls = evaluate([Named(self.folder)], Wanted(against="slip")).figure.lines[0].values(PULL)
        self.assertEqual([round(x, 9) for x, _, _ in pulls], [0.02, 0.17, 0.32])

    def test_packings_are_averaged_and_give_an_error(self) -> None:
        sinkages = (0.050, 0.056, 0.053)  # s 3 mm; 1 mm of time average each
        points = []
        for k, sinkage in enumerate(sinkages):
            name = f"load_2000_{k}"
            write_run(self.folder / name, LOAD, sinkage)
            finished(self.folder / name)
            points.append(PlannedRun(name, {"load": "2000"}, str(k) if k else ""))
        SweepPlan("scene.lig", ("load",), points=tuple(points)).write(self.folder)
        result = evaluate([Named(self.folder)], Wanted())
        (point,) = result.series[0].points
        value = point.quantities["hub_drop"]
        self.assertAlmostEqual(value.mean, 0.053, 9)
        self.assertAlmostEqual(value.parts.time, 1e-3 / math.sqrt(3), 9)
        self.assertAlmostEqual(math.hypot(value.parts.time, value.parts.packing), 3e-3 / math.sqrt(3), 9)  # of the three means
        self.assertEqual(len(point.runs), 3)

    def test_figure_has_two_grounds_measurements_and_formulas(self) -> None:
        write_pulling(self.folder / "a")
        write_pulling(self.folder / "b", 0.06)
        measured = self.folder / "test.csv"
        measured.write_text(
            "# a test\nlabel,slip_percent,drawbar_coefficient,sinkage_mm,sinkage_mm_error\n"
            "one,10,0.12,40,2\none,20,,45,\ntwo,10,0.2,50,1\n"
        )
        wanted = Wanted(formulas=["wong_reece:Wong-Reece loose sand"], measured=[Named(measured)])
        result = evaluate([Named(self.folder / "a", "snow"), Named(self.folder / "b")], wanted)
        self.assertEqual([line.label for line in result.figure.lines], ["snow", "b"])
        one, two = result.measured
        self.assertEqual((one.label, two.label), ("one", "two"))
        self.assertEqual(len(one.values(PULL)), 1)
        x, value, error = one.values(HUB_DROP)[0]
        self.assertAlmostEqual(x, 0.1)
        self.assertAlmostEqual(value, 0.04)
        self.assertAlmostEqual(error, 0.002)
        measured.write_text(
            "\ufefflabel;slip (%);drawbar_coefficient;sinkage [mm];sinkage_mm_error\r\n"
            "one;10,0;0,12;40,0;2\r\none;20,0;;45,0;\r\ntwo;10;0,2;5e1;1\r\n", encoding="utf-8", newline=""
        )  # fmt: skip
        again = evaluate([Named(self.folder / "a")], Wanted(measured=[Named(measured)])).measured
        self.assertEqual([(p.x, p.values(HUB_DROP)[0]) for p in again], [(p.x, p.values(HUB_DROP)[0]) for p in (one, two)])
        (formula,) = result.formulas  # both lines have the same conditions
        self.assertEqual(formula.label, "Wong–Reece, Wong-Reece loose sand")
        self.assertEqual([x for x, _ in formula.values(PULL)], [0.1, 0.3])
        self.assertIn("no answer at 1 of 3 points", "\n".join(result.remarks()))
        write_sweep(result, self.folder / "out")
        for name in ("sweep.png", "report.html", "sweep.csv", "sweep.h5"):
            self.assertTrue((self.folder / "out" / name).is_file(), name)
        self.assertEqual(len(list((self.folder / "out").iterdir())), 4)

    def test_formula_is_drawn_for_each_line(self) -> None:
        points = []
        for load in (1000.0, 2000.0):
            for slip in (0.1, 0.2):
                name = f"slip_{slip:g}_load_{load:g}"
                write_run(self.folder / name, load, slip=slip)
                finished(self.folder / name)
                points.append(PlannedRun(name, {"slip": f"{slip:g}", "load": f"{load:g}"}))
        SweepPlan("scene.lig", ("slip", "load"), points=tuple(points)).write(self.folder)
        result = evaluate([Named(self.folder)], Wanted(formulas=["bekker:LETE sand"]))
        light, heavy = result.formulas
        self.assertEqual(light.label, "Bekker, LETE sand (load 1000)")
        self.assertLess(light.predictions[0].sinkage, heavy.predictions[0].sinkage)
        self.assertEqual(heavy.values(PULL), [])  # Bekker's wheel is towed

    def test_table_has_units_and_can_be_read_as_measured(self) -> None:
        write_pulling(self.folder / "a")
        write_sweep(evaluate([Named(self.folder / "a")], Wanted()), self.folder / "a")
        rows = read_rows(self.folder / "a" / "sweep.csv")
        self.assertEqual([row["set_slip"] for row in rows], ["-0.2", "0.1", "0.3"])
        self.assertEqual(float(rows[1]["hub_drop"]), 0.05)
        self.assertEqual(float(rows[1]["hub_drop_error_time"]), 0.001)
        self.assertGreater(float(rows[1]["hub_drop_error_model"]), 0.002)
        whole = math.hypot(*(float(text or 0) for name, text in rows[1].items() if name.startswith("hub_drop_error_")))
        self.assertAlmostEqual(float(rows[1]["hub_drop_error"]), whole, 9)
        self.assertEqual(rows[1]["unknown"], "size step contact material")
        self.assertEqual(rows[0]["tractive_efficiency"], "")
        with h5py.File(self.folder / "a" / "sweep.h5") as content:
            self.assertEqual(content["hub_drop"].attrs["unit"], "m")
            self.assertEqual(content["drive_torque_error_time"].attrs["unit"], "N m")
            self.assertAlmostEqual(content["load"][1], LOAD)
        wanted = Wanted(measured=[Named(self.folder / "a" / "sweep.csv")])
        (again,) = evaluate([Named(self.folder / "a")], wanted).measured
        self.assertEqual([round(x, 9) for x, _, _ in again.values(PULL)], [-0.2, 0.1, 0.3])

    def test_pull_has_the_cell_part_of_its_negative(self) -> None:
        """A table of errors knows cells of the resistance; the pull is the resistance's negative."""
        write_pulling(self.folder / "a")
        families: Any = defaultdict(KnownSize)
        families[FamilyKey("none", "whole", "rigid wheel")]
        for point in read_series(self.folder / "a", None, families).points:
            resistance, pull = (point.quantities[n] for n in ("resistance_coefficient", PULL.key))
            self.assertEqual((resistance.parts.size, pull.parts.size), (KnownSize.SIZE,) * 2)
            in_newtons = point.quantities["drawbar_pull"].parts.size
            self.assertAlmostEqual(in_newtons, KnownSize.SIZE * LOAD)

    def test_imposed_values_are_marked_and_have_no_error(self) -> None:
        write_pulling(self.folder / "a")
        for file in (self.folder / "a").glob("*/summary.json"):
            content = json.loads(file.read_text())
            content["quantities"]["slip"].update(imposed=True, standard_error=2.6e-17)
            file.write_text(json.dumps(content))
        result = evaluate([Named(self.folder / "a")], Wanted())
        write_sweep(result, self.folder / "out")
        for row in read_rows(self.folder / "out" / "sweep.csv"):
            self.assertEqual((row["imposed"], row["slip_error"]), ("slip", "0"))
            self.assertFalse([name for name in row if "_error_size" in name])  # unknown everywhere
        text = "\n".join(report_lines(result))
        self.assertIn("imposed by the script, without an error: slip", text)
        self.assertNotIn("e-17", text)

    def test_picture_names_its_sigma_level(self) -> None:
        write_pulling(self.folder / "a")
        figure = evaluate([Named(self.folder / "a")], Wanted()).figure
        draw_sweep(figure, [], [], self.folder / "sweep.svg")
        drawn = (self.folder / "sweep.svg").read_text(encoding="utf-8")
        self.assertIn("bars: 2 standard errors (thick: time average alone", drawn)

    def test_parts_of_the_resistance_are_averaged_and_drawn(self) -> None:
        points = []
        for load in (1000.0, 2000.0):
            for seed, friction in (("", 10.0), ("7", 30.0)):
                name = f"load_{load:g}{seed}"
                write_run(self.folder / name, load)
                add_parts(self.folder / name, {"compaction": 0.1 * load, "friction": friction}, 1.0)
                finished(self.folder / name)
                points.append(PlannedRun(name, {"load": f"{load:g}"}, seed))
        SweepPlan("scene.lig", ("load",), points=tuple(points)).write(self.folder)
        result = evaluate([Named(self.folder)], Wanted())
        parts = result.series[0].points[1].parts
        assert parts is not None
        self.assertEqual(dict(parts.forces), {"compaction": 200.0, "friction": 20.0})
        self.assertEqual((parts.whole, parts.unexplained), (221.0, 1.0))
        files = write_sweep(result, self.folder / "out")
        self.assertIn("parts.png", files)
        self.assertEqual(files, sorted(file.name for file in (self.folder / "out").iterdir()))
        rows = read_rows(self.folder / "out" / "sweep.csv")
        self.assertEqual([row["part_compaction"] for row in rows], ["100", "200"])
        self.assertEqual([row["part_not_accounted_for"] for row in rows], ["1", "1"])
        page = (self.folder / "out" / "report.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("<figure>"), 2)

    def test_stacked_figure_has_every_part_of_the_summary(self) -> None:
        program = SOURCE / "src" / "statistics" / "resistance_parts.cpp"
        named = set(re.findall(r'\{"([a-z, ]+)",\s*\{"', program.read_text(encoding="utf-8")))
        self.assertGreaterEqual(len(named), 17)
        self.assertEqual(named - set(COLOURS), set())

    def test_axis_offsets_are_powers_of_ten(self) -> None:
        self.assertEqual(with_error(6.1e-13, 2e-13), "6.1e-13 ± 2e-13")
        self.assertEqual(with_error(10.0, 1.1e-15), "10")
        self.assertEqual(with_error(101.14, 0.17), "101.14 ± 0.17")
        self.assertEqual(with_error(101.14, 0.17, short=True), "101.1 ± 0.2")
        self.assertEqual(with_error(6244.0, 31.0, short=True), "6240 ± 30")
        self.assertEqual(with_error(-471.3, 14.6, short=True), "-471 ± 15")  # not 10
        self.assertEqual(with_error(0.00012, 0.00003), "0.00012 ± 0.00003")

    def test_failed_and_missing_runs_are_distinguished(self) -> None:
        write_pulling(self.folder)
        (self.folder / "slip_0.1" / "run.json").unlink()
        finished(self.folder / "slip_0.1", "ERROR: it broke")
        (self.folder / "slip_0.3" / "run.json").unlink()
        result = evaluate([Named(self.folder)], Wanted())
        text = "\n".join(report_lines(result))
        self.assertIn("slip_0.1 failed: ERROR: it broke", text)
        self.assertIn("1 points were not run: slip_0.3", text)
        self.assertEqual(len(result.series[0].points), 1)

    def test_points_of_two_program_versions_are_reported(self) -> None:
        write_pulling(self.folder / "a")
        remark = "its points are of different programs or scripts"
        self.assertNotIn(remark, "\n".join(evaluate([Named(self.folder / "a")], Wanted()).remarks()))
        Record({}, "other", {}, "", "2026-01-01T00:00:00Z", 1.0, 1.5, 0.1).write(self.folder / "a" / "slip_0.1")
        self.assertIn(remark, "\n".join(evaluate([Named(self.folder / "a")], Wanted()).remarks()))

    def test_unsteady_extended_runs_are_reported(self) -> None:
        write_pulling(self.folder)
        told = "WARNING: run_until_steady: not steady within 3 %: the ground ends\n"
        (self.folder / "slip_0.1" / "screen.txt").write_text(f"x\n{told}y\n")
        text = "\n".join(report_lines(evaluate([Named(self.folder)], Wanted())))
        self.assertIn("slip_0.1: not steady within 3 %: the ground ends", text)

    def test_folders_without_a_sweep_are_refused(self) -> None:
        for load in (1000.0, 2000.0):
            write_run(self.folder / f"run_{load:g}", load)
        result = evaluate([Named(self.folder)], Wanted())
        self.assertEqual(result.figure.x.key, "load")
        self.assertEqual(result.figure.lines[0].x, (1000.0, 2000.0))
        self.assertEqual(
            [curve.name for curve in result.figure.curves],
            ["resistance against load", "hub drop against load"],
        )

    def test_texts_are_categories(self) -> None:
        points = []
        for k, name in enumerate(("loose.yaml", "dense.yaml")):
            write_run(self.folder / name, LOAD, 0.05 + 0.01 * k)
            finished(self.folder / name)
            points.append(PlannedRun(name, {"material": name}))
        SweepPlan("scene.lig", ("material",), points=tuple(points)).write(self.folder)
        result = evaluate([Named(self.folder)], Wanted())
        self.assertEqual(result.figure.categories, ("loose.yaml", "dense.yaml"))
        write_sweep(result, self.folder)

    def test_page_is_valid_html(self) -> None:
        write_pulling(self.folder)
        write_sweep(evaluate([Named(self.folder)], Wanted()), self.folder)
        text = (self.folder / "report.html").read_text()
        for word in ("pull–slip", "tractive efficiency", "data:image/png;base64", "Conditions"):
            self.assertIn(word, text)
        HTMLParser().feed(text)

    def test_faults_are_refused(self) -> None:
        write_pulling(self.folder / "a")
        (self.folder / "empty").mkdir()
        write_run(self.folder / "same" / "x")
        write_run(self.folder / "same" / "y")
        (self.folder / "bad.csv").write_text("a,b\n1,2\n")
        (self.folder / "no_slip.csv").write_text("hub_drop_mm,b\n1,2\n")
        (self.folder / "word.csv").write_text("slip,sinkage\n0.1,deep\n")
        a = [Named(self.folder / "a")]
        for folders, wanted, message in (
            ([Named(self.folder / "none")], Wanted(), "is no folder"),
            ([Named(self.folder / "empty")], Wanted(), "has neither sweep.json nor results"),
            ([Named(self.folder / "same")], Wanted(), "no condition differs among these runs"),
            (a, Wanted("colour"), "has no colour; --against takes"),
            (a, Wanted(formulas=["foo"]), "there is no formula 'foo'"),
            (a, Wanted(formulas=["bekker:moon"]), "there is no terrain 'moon'"),
            (a, Wanted(measured=[Named(self.folder / "none.csv")]), "no such file"),
            (a, Wanted(measured=[Named(self.folder / "bad.csv")]), "is no table of measured points"),
            (a, Wanted(measured=[Named(self.folder / "no_slip.csv")]), "needs a column slip and one"),
            (a, Wanted(measured=[Named(self.folder / "word.csv")]), "could not convert"),
        ):
            with self.subTest(message), self.assertRaises(ResultsError) as refused:
                evaluate(folders, wanted)
            self.assertIn(message, str(refused.exception))


if __name__ == "__main__":
    unittest.main()
