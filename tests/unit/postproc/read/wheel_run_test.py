# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions of a run come from /run/styles; a wheel is whatever is of that kind."""

import unittest

import h5py
import numpy as np

from furrow_post.analyse.density import ground_points
from furrow_post.errors import ResultsError
from furrow_post.read.results import Grains, Results, Styles, Surface
from furrow_post.read.wheel_run import read_wheel_run, slip_by_vehicle_speed
from support.folder import FolderTest
from support.runs import RADIUS, rig, rigid_wheel, style, write_grains, write_run, write_summary

TYRE = style("wheel", "tyre/modal", "wheel", pressure=2.4e5, modes=12, half=True)


class WheelRunTest(FolderTest):
    def test_slip_has_both_definitions(self) -> None:
        write_run(self.folder)
        run = read_wheel_run(self.folder)
        self.assertAlmostEqual(run.number("slip"), 0.2, places=12)
        self.assertAlmostEqual(run.number("slip_by_vehicle_speed"), 0.25, places=12)  # s/(1 - s)

    def test_radius_of_a_mesh_excludes_grousers(self) -> None:
        mesh = style("wheel", "wheel/mesh", "wheel", radius=RADIUS)
        write_run(self.folder, styles=[mesh, rig()])
        tip = 1.08 * RADIUS
        with h5py.File(self.folder / "history.h5", "a") as content:
            content["surface/triangles"] = np.array([[0, 1, 2]])
            content["surface/x"] = np.array([[-tip, 0, 0], [tip, 0.1, 0], [0, -0.1, tip]])
        run = read_wheel_run(self.folder)
        self.assertAlmostEqual(run.radius, RADIUS)
        self.assertAlmostEqual(run.number("slip_by_vehicle_speed"), 0.25, places=12)
        self.assertAlmostEqual(run.rolling_radius, 0.8 * RADIUS)

    def test_radius_of_slip_is_that_of_the_rig(self) -> None:
        for options, height, radius in (
            ({}, 0.03, RADIUS),
            ({"slip_radius": ["tip"]}, 0.03, RADIUS + 0.03),
            ({"slip_radius": ["tip"]}, None, RADIUS),
            ({"slip_radius": ["effective"], "effective_radius": [0.2]}, 0.03, 0.2),
        ):
            wheel, driven = rigid_wheel(), rig()
            driven["options"].update(options)
            if height:
                wheel["options"].update(grousers=[24], grouser_height=[height])
            write_run(self.folder, styles=[wheel, driven])
            self.assertAlmostEqual(read_wheel_run(self.folder).slip_radius, radius)

    def test_both_slips_have_the_radius_of_the_rig(self) -> None:
        write_run(self.folder)
        write_summary(self.folder, 0.05, 1000.0, slip=0.3)  # by the tips of grousers; the channel rim_speed is that of 0.2
        run = read_wheel_run(self.folder)
        self.assertAlmostEqual(run.number("slip_by_vehicle_speed"), 3 / 7, places=12)

    def test_braked_wheel_has_equal_slips(self) -> None:
        for slip, by_speed in ((-0.5, -0.5), (0.0, 0.0), (0.5, 1.0)):
            self.assertAlmostEqual(slip_by_vehicle_speed(slip), by_speed)
        self.assertTrue(np.isnan(slip_by_vehicle_speed(1.0)))

    def test_fix_can_have_the_name_of_a_keyword(self) -> None:
        write_run(self.folder, styles=[rigid_wheel("speed"), rig(identity="load_force")])
        run = read_wheel_run(self.folder)
        self.assertEqual((run.number("speed"), run.number("load")), (1.0, 1000.0))

    def test_load_of_a_mass_is_its_weight(self) -> None:
        entry = rig()
        del entry["options"]["load_force"]
        entry["options"].update(load_mass=[100], gravity=[10.0])
        write_run(self.folder, styles=[rigid_wheel(), entry])
        self.assertEqual(read_wheel_run(self.folder).number("load"), 1000.0)

    def test_any_style_of_kind_wheel_is_a_wheel(self) -> None:
        """A tyre that nobody here knows: its sizes are those of its surface, a half is mirrored."""
        write_run(self.folder, styles=[TYRE, rig()])
        with h5py.File(self.folder / "history.h5", "a") as content:
            content["surface/triangles"] = np.array([[0, 1, 2]])
            content["surface/x"] = np.array([[0.0, 0, 0], [0.7, 0.13, 0.1], [0.3, 0, 0.7]])
        run = read_wheel_run(self.folder)
        self.assertEqual((run.wheel, run.deformable), ("tyre", True))
        self.assertAlmostEqual(run.number("wheel_diameter"), 0.7)
        self.assertAlmostEqual(run.number("wheel_width"), 0.26)
        self.assertEqual(run.number("pressure"), 2.4e5)

    def test_rigid_wheel_has_the_sizes_of_its_style(self) -> None:
        write_run(self.folder)
        run = read_wheel_run(self.folder)
        self.assertEqual((run.wheel, run.deformable), ("rigid wheel", False))
        self.assertEqual(run.radius, RADIUS)

    def test_wheel_of_a_mesh_is_rigid_and_has_the_width_of_its_surface(self) -> None:
        wheel = style("wheel", "wheel/mesh", "wheel", file="wheel.stl", radius=0.3)
        write_run(self.folder, styles=[wheel, rig()])
        with h5py.File(self.folder / "history.h5", "a") as content:
            content["surface/triangles"] = np.array([[0, 1, 2]])
            content["surface/x"] = np.array([[0.0, -0.1, 0], [0.7, 0.1, 0.1], [0.3, 0, 0.7]])
        run = read_wheel_run(self.folder)
        self.assertEqual((run.wheel, run.deformable), ("mesh wheel", False))
        self.assertAlmostEqual(run.number("wheel_diameter"), 0.6)
        self.assertAlmostEqual(run.number("wheel_width"), 0.2)

    def test_run_without_a_wheel_is_refused(self) -> None:
        write_run(self.folder, styles=[rig()])
        with self.assertRaisesRegex(ResultsError, "is not the run of a wheel on a rig"):
            read_wheel_run(self.folder)

    def test_bed_of_grains_has_its_datum(self) -> None:
        """Grains that fill a box of 0.4 x 0.2 x 0.1 m to one half; the rig counts from 0.12 m."""
        bed = style("command", "bed", "", length=0.5, density=2000, seed=86028121)
        write_run(self.folder, styles=[bed, rigid_wheel(), rig(datum=0.12)])
        radius = 0.01
        corners = np.array([[0.0, 0, 0], [0.4, 0.2, 0.1]])
        count = int(0.5 * 0.4 * 0.2 * 0.1 / (4 / 3 * np.pi * radius**3))
        x = np.full((count, 3), 0.05)
        x[:2] = corners + [[radius], [-radius]]
        with h5py.File(self.folder / "history.h5", "a") as content:
            for when in ("reference", "final"):
                group = content.create_group(f"grains/{when}")
                write_grains(group, x, np.full(count, radius), 0.1)
        run = read_wheel_run(self.folder)
        self.assertEqual((run.ground, run.seed, run.elements), ("grains", "86028121", count))
        self.assertEqual(
            run.domain, (0.5, 0.2)
        )  # the bed's length; its width is that of the grains
        self.assertAlmostEqual(run.number("depth"), 0.1)
        self.assertAlmostEqual(run.number("density"), 1000, delta=2)
        self.assertAlmostEqual(run.values["hub_drop"].mean, 0.05 - 0.02)
        self.assertAlmostEqual(run.number("datum_shift"), -0.02)

    def test_hybrid_is_a_bed_on_a_continuum(self) -> None:
        """Two grains on 0.1 m of continuum, in a box that reaches below it."""
        bed = style("command", "bed", "", length=0.04, density=300, seed=86028121)
        soil = style("terrain", "terrain/continuum", depth=0.1, surface=0.02, cell=0.05)
        write_run(self.folder, styles=[bed, rigid_wheel(), rig(datum=0.05), soil])
        (self.folder / "terrain.h5").touch()
        x = np.array([[0.1, 0, 0.04], [0.1, 0.2, 0.04]])
        with h5py.File(self.folder / "history.h5", "a") as content:
            for when in ("reference", "final"):
                group = content.create_group(f"grains/{when}")
                write_grains(group, x, np.full(2, 0.02), 0.06)
        run = read_wheel_run(self.folder)
        self.assertEqual((run.ground, run.seed, run.size), ("hybrid", "86028121", 0.04))
        self.assertAlmostEqual(run.number("depth"), 0.1 + 0.04)
        solid, layer = 8 / 3 * np.pi * 0.02**3, 0.04 * 0.24 * 0.04
        self.assertAlmostEqual(run.number("density"), 300 * solid / layer)
        self.assertAlmostEqual(run.values["hub_drop"].mean, 0.05 + 0.01)
        self.assertAlmostEqual(ground_points(run).mass.sum(), 300 * solid)

    def test_frozen_base_of_a_bed_is_not_ground(self) -> None:
        """Two grains of the bed on one that is frozen below z = 0."""
        bed = style("command", "bed", "", length=0.04, density=300, base=0.03)
        write_run(self.folder, styles=[bed, rigid_wheel(), rig(datum=0.06)])
        radius = np.full(3, 0.02)
        with h5py.File(self.folder / "history.h5", "a") as content:
            for when, moved in (("reference", 0.0), ("final", -0.03)):
                x = np.array([[0.1, 0, -0.01], [0.1, 0, 0.02], [0.1, 0.2, 0.04 + moved]])
                write_grains(content.create_group(f"grains/{when}"), x, radius, 0.06)
        run = read_wheel_run(self.folder)
        self.assertAlmostEqual(run.number("depth"), 0.06)
        cap = np.pi / 3 * 0.01**2 * (3 * 0.02 - 0.01)  # of the frozen one, above the ground
        solid = 2 * 4 / 3 * np.pi * 0.02**3 + cap
        self.assertAlmostEqual(run.number("density"), 300 * solid / (0.04 * 0.24 * 0.06))

    def test_wheel_across_a_periodic_face_is_among_the_grains(self) -> None:
        """Twice round a box of 2 m along x, whose middle is at 0.5 m."""
        x = np.array([[-0.4, 0, 0.1], [1.4, 0, 0.1]])
        bed = Grains(np.arange(2), x, np.full(2, 0.1), np.array([2.0, 0, 0]), 0.2)
        wheel = Surface(np.array([[0, 1, 2]]), np.array([[4.9, 0, 0], [5.1, 0, 0], [5.0, 3, 1]]))
        np.testing.assert_allclose(bed.image_of(wheel).x, wheel.x - [4, 0, 0])
        np.testing.assert_allclose(bed.image_of(bed.image_of(wheel)).x, wheel.x - [4, 0, 0])

    def test_height_field_has_cells_and_no_density(self) -> None:
        scm = style("scm", "terrain/scm", length=3.0, width=1.0, cell=0.02)
        write_run(self.folder, styles=[rigid_wheel(), rig(), scm])
        run = read_wheel_run(self.folder)
        self.assertEqual((run.ground, run.ground_kind.has_density, run.elements), ("scm", False, 7500))
        self.assertEqual(run.describe_size(), "cells of 20 mm")
        self.assertEqual((run.domain, run.ground_kind.elements), ((3.0, 1.0), "cells"))

    def test_results_of_an_older_version_are_refused(self) -> None:
        write_run(self.folder)
        with h5py.File(self.folder / "history.h5", "a") as content:
            del content["run/styles"]
        message = "older Furrow, version 0.0.9, on 2026-01-01.*furrow-post of the source tree"
        with self.assertRaisesRegex(ResultsError, message):
            Results(self.folder)

    def test_terrain_of_an_older_version_is_refused(self) -> None:
        soil = style("terrain", "terrain/continuum", cell=0.02)
        write_run(self.folder, styles=[rigid_wheel(), rig(), soil])
        with h5py.File(self.folder / "ground.h5", "w") as content:
            content.create_group("run").attrs["version"] = np.bytes_("0.0.8")
        with self.assertRaisesRegex(ResultsError, "ground.h5: .*older Furrow, version 0.0.8"):
            read_wheel_run(self.folder)
        (self.folder / "ground.h5").unlink()
        with self.assertRaisesRegex(ResultsError, "has no terrain.h5; give the scene a fix"):
            read_wheel_run(self.folder)

    def test_names_of_earlier_versions_are_read(self) -> None:
        write_run(self.folder)
        summary = self.folder / "summary.json"
        summary.write_text(summary.read_text().replace('"hub_drop"', '"sinkage"'))
        with h5py.File(self.folder / "history.h5", "a") as content:
            content.move("history/hub_drop", "history/sinkage")
        run = read_wheel_run(self.folder)
        self.assertAlmostEqual(run.values["hub_drop"].mean, 0.05)
        self.assertAlmostEqual(run.results.columns["hub_drop"][-1], 0.05)

    def test_missing_steady_value_names_the_remedy(self) -> None:
        write_run(self.folder)
        (self.folder / "summary.json").unlink()
        with self.assertRaisesRegex(ResultsError, "no steady hub_drop.*resistance --write"):
            read_wheel_run(self.folder)


class StylesTest(unittest.TestCase):
    def test_options_have_types(self) -> None:
        styles = Styles.from_json(
            '[{"id": "a", "group": "all", "style": "terrain/continuum", "kind": "terrain",'
            ' "options": {"cell": [0.02], "symmetry": [true], "centre": [0, 0.5],'
            ' "material": ["snow.yaml"]}}]'
        )
        soil = styles.of_kind("terrain")
        assert soil
        self.assertEqual((soil.number("cell"), soil.flag("symmetry")), (0.02, True))
        self.assertEqual(soil.values("centre"), [0, 0.5])
        self.assertEqual(soil.number("depth", 0.3), 0.3)
        self.assertFalse(soil.flag("half"))
        self.assertIsNone(styles.of_kind("wheel"))
        with self.assertRaisesRegex(ResultsError, "'a': 'material' is 'snow.yaml', not a number"):
            soil.number("material")
        with self.assertRaisesRegex(ResultsError, "no value of 'depth'"):
            soil.number("depth")


if __name__ == "__main__":
    unittest.main()
