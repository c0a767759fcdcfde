# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas of a cone index in a sweep: the band, and values outside of it."""

import unittest
from pathlib import Path
from unittest.mock import patch

import h5py
import numpy as np

from furrow_post.laws.cone_files import formula_tyre, soil_of
from furrow_post.laws.cone_formulas import formulas_for
from furrow_post.errors import ResultsError
from furrow_post.run.record import Record
from furrow_post.sweep.sweep_curves import HUB_DROP, PULL, RESISTANCE, TORQUE
from furrow_post.sweep.sweep_files import Named, SweepResult, Wanted, evaluate, write_sweep
from furrow_post.sweep.sweep_plan import PlannedRun, SweepPlan
from support.command import SOURCE
from support.folder import FolderTest
from support.runs import rig, rigid_wheel, style, write_run

TYRE = SOURCE / "inputs" / "tyres" / "p235_75r15.yaml"
LOAD, PRESSURE = 6000.0, 2e5


def write_tyre_run(folder: Path, material: str, slip: float, pull: float, mode: str = "slip", tyre: bool = True) -> None:
    """A tyre on a continuum of one particle, by a script that names its files from its own folder on."""
    driven = rig(LOAD)
    driven["options"]["mode"] = [mode]
    wheel = style("wheel", "tyre/darnell", "wheel", file="../tyres/p235_75r15.yaml", pressure=PRESSURE, diameter=0.7, width=0.2)
    soil = style("terrain", "terrain/continuum", "soil", material=f"../materials/{material}.yaml", length=2, width=1, depth=0.5, cell=0.05)
    write_run(folder, LOAD, styles=[wheel if tyre else rigid_wheel(), driven, soil], slip=slip, pull=pull, torque=500.0)
    with h5py.File(folder / "history.h5", "a") as content:
        content["run"].attrs["script"] = np.bytes_(str(SOURCE / "inputs" / "scenes" / "tyre_on_soil.lig"))
    with h5py.File(folder / "terrain.h5", "w") as content:
        for name in ("density", "volume", "compaction", "vertical_stress"):
            content[f"terrain/{name}"] = np.zeros(1) if name in ("compaction", "vertical_stress") else np.ones(1)
        content["terrain/x"] = content["terrain/initial_position"] = np.zeros((1, 3))
    Record({}, "", {}, "", "2026-01-01T00:00:00Z", 1.0, 1.5, 0.1).write(folder)


class ConeBandTest(FolderTest):
    def sweep(self, material: str, pulls: dict[float, float], tyre: bool = True) -> SweepResult:
        points = []
        for slip, pull in pulls.items():
            write_tyre_run(self.folder / f"slip_{slip:g}", material, slip, pull, tyre=tyre)
            points.append(PlannedRun(f"slip_{slip:g}", {"motion": f"mode slip slip {slip:g}"}))
        SweepPlan("scene.lig", ("motion",), points=tuple(points)).write(self.folder)
        return evaluate([Named(self.folder)], Wanted(against="slip"))

    def test_variable_that_sets_the_slip_does_not_split_a_curve(self) -> None:
        self.assertEqual([line.x for line in self.sweep("fresh_snow", {0.1: 0.2, 0.3: 0.2}).figure.lines], [(0.1, 0.3)])

    def test_clay_has_a_band_and_values_outside_are_named(self) -> None:
        result = self.sweep("clay_medium", {0.1: 0.25, 0.2: -0.5})
        (band,) = result.bands
        tyre = formula_tyre(TYRE, PRESSURE, LOAD)
        for slip, mean, least, greatest in band.values(PULL):
            self.assertEqual((mean, least, greatest), formulas_for("clay", 270e3, tyre, slip).band("net"))
            self.assertLess(least, greatest)
        self.assertEqual([x for x, *_ in band.values(TORQUE)], [0.1, 0.2])
        self.assertEqual(band.values(HUB_DROP), [])
        named = [text for text in result.remarks() if "outside of the formulas" in text]
        self.assertEqual(len(named), 1, named)
        self.assertRegex(named[0], r"slip_0.2: net traction coefficient -0.50 ± \S+ is outside of the formulas, 0\.\d+ to 0\.\d+")
        self.assertIn("sweep.png", write_sweep(result, self.folder / "drawn"))

    def test_line_over_several_soils_has_no_band(self) -> None:
        for name in ("sand_firm", "clay_stiff"):
            write_tyre_run(self.folder / name, name, 0.2, 0.1)
        points = tuple(PlannedRun(name, {"material": name}) for name in ("sand_firm", "clay_stiff"))
        SweepPlan("scene.lig", ("material",), points=points).write(self.folder)
        self.assertEqual(list(evaluate([Named(self.folder)], Wanted()).bands), [])

    def test_unreadable_material_gives_a_note(self) -> None:
        with patch("furrow_post.laws.cone_files.answer", side_effect=ResultsError("sand.yaml: no such law")):
            soil_of.cache_clear()
            result = self.sweep("sand_firm", {0.1: 0.2, 0.3: 0.2})
        self.assertIn("no formulas of a cone index: sand.yaml: no such law", " ".join(result.remarks()))
        self.assertIn("sweep.png", write_sweep(result, self.folder / "drawn"))

    def test_samples_of_different_size_stay_separate(self) -> None:
        points = []
        for slip, load in ((0.1, "5000"), (0.3, "7000")):
            write_tyre_run(self.folder / load, "fresh_snow", slip, 0.1)
            points.append(PlannedRun(load, {"slip": f"{slip:g}", "load": load}))
        SweepPlan("scene.lig", ("slip", "load"), points=tuple(points)).write(self.folder)
        lines = evaluate([Named(self.folder)], Wanted(against="slip")).figure.lines
        self.assertEqual([line.label for line in lines], ["load 5000", "load 7000"])

    def test_towed_tyre_on_sand_has_the_formula_of_towed_resistance(self) -> None:
        for load in (5000, 6000):
            write_tyre_run(self.folder / f"load_{load}", "sand_firm", -0.05, -0.1, mode="towed")
        points = tuple(PlannedRun(f"load_{load}", {"load": str(load)}) for load in (5000, 6000))
        SweepPlan("scene.lig", ("load",), points=points).write(self.folder)
        (band,) = evaluate([Named(self.folder)], Wanted()).bands
        expected = formulas_for("sand", 217e3, formula_tyre(TYRE, PRESSURE, LOAD), 1e-6).answers[0].towed_resistance
        self.assertEqual({mean for _, mean, *_ in band.values(RESISTANCE)}, {expected})
        self.assertEqual(band.values(PULL), [])

    def test_rigid_wheels_and_snow_have_no_formula(self) -> None:
        self.assertEqual(list(self.sweep("fresh_snow", {0.1: 0.2, 0.3: 0.2}).bands), [])
        self.assertEqual(list(self.sweep("sand_firm", {0.1: 0.2, 0.3: 0.2}, tyre=False).bands), [])


if __name__ == "__main__":
    unittest.main()
