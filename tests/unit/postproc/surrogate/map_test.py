# SPDX-License-Identifier: GPL-2.0-or-later
"""A mobility map of a wheel with a closed form, on slopes that are known."""

import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np
from osgeo import gdal, osr

from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError
from furrow_post.surrogate.mobility import Vehicle, evaluate, mobility_of, tabulate
from furrow_post.surrogate.raster import read_slope
from furrow_post.surrogate.training import HUB_DROP, PULL, TORQUE
from support.command import run_post
from support.folder import FolderTest
from support.surrogate import RANGES, closed_form, made_surrogate, wheel

gdal.UseExceptions()
LOAD, SPEED, POWER, CELL = 600.0, 0.5, 150.0, 10.0
PHI = {1: 26.0, 2: 32.0}  # by soil class
ROWS, COLUMNS = 40, 60


def write_ascii(file: Path, values: Floats, cell: float = CELL) -> None:
    """ESRI's grid of numbers, row 0 in the north."""
    head = f"ncols {values.shape[1]}\nnrows {values.shape[0]}\nxllcorner 0\nyllcorner 0\ncellsize {cell}\nNODATA_value -9999\n"
    file.write_text(head + "\n".join(" ".join(f"{v:.9g}" for v in row) for row in values) + "\n")


class MapTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        made_surrogate().write(self.folder / "wheel.json")
        # Elevation over the column: the slope grows from 0 to 30 degrees
        x = CELL * np.arange(COLUMNS)
        self.slope = 30.0 * x / x[-1]
        rise = np.cumsum(np.tan(np.radians(self.slope))) * CELL
        write_ascii(self.folder / "dem.asc", np.tile(rise, (ROWS, 1)))
        self.classes = np.where(np.arange(ROWS)[:, None] < ROWS // 2, 1.0, 2.0) * np.ones(
            (1, COLUMNS)
        )
        write_ascii(self.folder / "soil.asc", self.classes)
        rows = "".join(f"{key},{phi}\n" for key, phi in PHI.items())
        (self.folder / "soils.csv").write_text("class,phi\n" + rows)

    def map(self, *words: object) -> str:
        done = run_post(
            "map",
            self.folder / "wheel.json",
            self.folder / "dem.asc",
            "-o",
            self.folder / "map",
            "--load",
            LOAD,
            *words,
        )
        return done.stdout if done.returncode == 0 else done.stderr

    def test_operating_point_has_the_closed_form(self) -> None:
        vehicle = Vehicle(LOAD, SPEED)
        slopes = np.array([0.0, 5.0, 10.0, 15.0, 25.0])
        for phi in PHI.values():
            fields = evaluate(made_surrogate(), vehicle, {"slope": slopes, "phi": np.full(5, phi)})
            result = mobility_of(fields, vehicle, slopes)
            for k, slope in enumerate(slopes):
                margin, slip, energy = closed_form(float(slope), phi, LOAD)
                self.assertAlmostEqual(
                    result["pull"][k], max(margin, 0) * LOAD * np.cos(np.radians(slope)), delta=1.5
                )
                self.assertEqual(result["probability"][k] > 0.5, margin > 0)
                if margin > 0.01:
                    self.assertAlmostEqual(result["slip"][k], slip, delta=0.003)
                    self.assertAlmostEqual(result["energy"][k], energy, delta=0.01 * energy)
                    drop = float(
                        wheel(
                            np.array(slip),
                            np.array(LOAD * np.cos(np.radians(slope))),
                            np.array(phi),
                        )[HUB_DROP]
                    )
                    self.assertAlmostEqual(result["hub_drop"][k], drop, delta=2e-4)
                elif margin < -0.01:
                    self.assertTrue(np.isnan(result["energy"][k]))

    def test_load_that_follows_another_input_is_refused(self) -> None:
        whole = made_surrogate()
        inputs = tuple(replace(one, name="gravity" if one.name == "load" else one.name) for one in whole.inputs)
        replace(whole, inputs=inputs).write(self.folder / "wheel.json")
        self.assertIn("the surrogate knows loads that follow another input; sweep load too", self.map())

    def test_power_limits_speed_and_pull(self) -> None:
        ground = {"slope": np.array([10.0]), "phi": np.array([36.0])}
        free, limited = Vehicle(LOAD, SPEED), Vehicle(LOAD, SPEED, 60.0)
        of = [
            mobility_of(evaluate(made_surrogate(), one, ground), one, ground["slope"])
            for one in (free, limited)
        ]
        self.assertEqual(of[0]["speed"][0], SPEED)
        self.assertAlmostEqual(of[1]["speed"][0], 60.0 / of[0]["energy"][0], places=6)
        self.assertLess(of[1]["pull"][0], of[0]["pull"][0])

    def test_table_is_within_its_tolerance_of_the_surrogate(self) -> None:
        random = np.random.default_rng(0)
        ground = {"slope": random.uniform(0, 30, 3000), "phi": random.uniform(25, 37, 3000)}
        surrogate, vehicle = made_surrogate(), Vehicle(LOAD, SPEED)
        table = tabulate(surrogate, vehicle, ground)
        exact, found = evaluate(surrogate, vehicle, ground), table.at(ground)
        self.assertLess(
            np.sqrt(np.mean((found["best"] - exact["best"]) ** 2)), 0.3 * exact["deviation"].mean()
        )
        self.assertLess(np.sqrt(np.mean((found["slip"] - exact["slip"]) ** 2)), 0.03)

    def test_map_has_the_boundary_of_the_closed_form(self) -> None:
        said = self.map(
            "--classes", self.folder / "soil.asc", self.folder / "soils.csv", "--power", POWER
        )
        self.assertIn("% of the cells", said)
        data = gdal.Open(str(self.folder / "map" / "map.tif"))
        bands = {data.GetRasterBand(k).GetDescription(): data.GetRasterBand(k) for k in range(1, 8)}
        self.assertEqual(bands["energy"].GetUnitType(), "J/m")
        verdict = bands["verdict"].ReadAsArray()
        for key, phi in PHI.items():
            row = verdict[self.classes[:, 0] == key][5]
            edge = np.flatnonzero(row < 2)[0]  # first column without go
            steepest = next(s for s in np.arange(0, 45, 0.01) if closed_form(float(s), phi, LOAD)[0] < 0)
            self.assertAlmostEqual(self.slope[edge], steepest, delta=1.0)
        self.assertGreater((self.folder / "map" / "map.png").stat().st_size, 10_000)
        rows = read_numbers(self.folder / "map" / "mobility.csv")
        self.assertEqual({row["soil"] for row in rows}, {1.0, 2.0})
        for row in rows:
            slope = np.radians(row["slope_degrees"])
            margin, _, energy = closed_form(row["slope_degrees"], PHI[int(row["soil"])], LOAD)
            self.assertAlmostEqual(row["traction_coefficient"], margin + np.tan(slope), delta=2e-3)
            self.assertLess(row["pull_N"], max(margin, 0) * LOAD * np.cos(slope) + 1.5)  # power limits it
            self.assertEqual(row["go_probability"] > 0.5, margin > 0)
            if margin > 0.01:
                self.assertAlmostEqual(row["energy_J_per_m"], energy, delta=0.01 * energy)

    def plane(self, system: str, unit: str, length: float, height: float) -> Path:
        """A GeoTIFF of a plane that rises by 20 degrees; length, height: units [m]; system: of PROJ."""
        file = self.folder / "plane.tif"
        data = gdal.GetDriverByName("GTiff").Create(str(file), 8, 8, 1, gdal.GDT_Float64)
        data.SetGeoTransform((5e5, 10.0 / length, 0.0, 4e6, 0.0, -10.0 / length))
        reference = osr.SpatialReference()
        reference.SetFromUserInput(system)
        data.SetProjection(reference.ExportToWkt())
        band = data.GetRasterBand(1)
        band.WriteArray(np.tile(np.arange(8) * 10.0 * np.tan(np.radians(20.0)) / height, (8, 1)))
        if unit:
            band.SetUnitType(unit)
        return file

    def test_heights_have_the_unit_that_the_file_states(self) -> None:
        """UTM in metres and New York in US survey feet; NAVD88 in metres, feet and US survey feet."""
        foot, survey = 0.3048, 1200 / 3937
        for system, unit, length, height in (
            ("EPSG:32610", "", 1.0, 1.0),
            ("EPSG:32610+5703", "", 1.0, 1.0),
            ("EPSG:32610+8228", "", 1.0, foot),
            ("EPSG:32610+6360", "", 1.0, survey),
            ("EPSG:32610", "ft", 1.0, foot),
            ("EPSG:2263+6360", "", survey, survey),
            ("EPSG:2263", "m", survey, 1.0),
        ):
            with self.subTest(system=system, unit=unit):
                slope = read_slope(self.plane(system, unit, length, height)).values[1:-1, 1:-1]
                np.testing.assert_allclose(slope, 20.0, atol=1e-4)  # without GDAL's edges
        for system, unit in (("EPSG:32610", "cm"), ("EPSG:2263", "")):
            with self.assertRaisesRegex(ResultsError, f"has heights in '{unit}', and .*allowed: heights in m, ft or us-ft"):
                read_slope(self.plane(system, unit, 1.0, 1.0))

    def test_faults_are_one_line(self) -> None:
        other = self.folder / "other.asc"
        write_ascii(other, np.full((3, 3), 30.0))
        for words, message in (
            ((), "no soil parameter phi; give it by --set"),
            (("--set", "phi=50"), "phi: 50 lies outside of the training range"),
            (("--set", "n=1"), "the surrogate has no soil parameter 'n'"),
            (("--raster", f"phi={other}"), "differ from the elevation model"),
            (("--raster", f"phi={self.folder}/no.tif"), "no such file"),
            (("--classes", self.folder / "soil.asc", self.folder / "wheel.json"), "wheel.json"),
        ):
            with self.subTest(words):
                said = self.map(*words)
                self.assertIn(message, said)
                self.assertEqual(said.count("\n"), 1)

    def test_cells_outside_of_the_training_range_have_no_data(self) -> None:
        phi = np.full((ROWS, COLUMNS), 30.0)
        phi[:10] = 45.0
        write_ascii(self.folder / "phi.asc", phi)
        said = self.map("--raster", f"phi={self.folder / 'phi.asc'}")
        self.assertIn(f"{10 * COLUMNS} of {ROWS * COLUMNS} cells lie outside", said)


if __name__ == "__main__":
    unittest.main()
