# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/tyre_brick: the outlines of the tyre files, errors and goals, the choices.

The outline of a carcass as the mould leaves it: four arcs that meet without a corner. The radius of
the crown is fitted; where the arcs end is assumed. Everything else is measured: [Shoop2001] Table 8
has the radii of belts and bead, Table 6 the widths of tread and section.
"""

import math
import re
import tempfile
import unittest
from dataclasses import dataclass
from math import asin, cos, pi, radians, sin
from pathlib import Path
from unittest.mock import patch

import numpy as np
import yaml

from support.command import SOURCE
from support.evaluation import cases, evaluation, stored

BELT_RADIUS = 0.3475  # [m] Table 8: diameter of the belts 69.5 cm
BEAD = (0.0825, 0.2080)  # [m] axial: half of the 6.5 inch rim; radius: Table 8
SHOULDER_END = 60.0  # [degrees] of the outline against the axle, assumed
POINTS = (4, 4, 2, 3)  # of each arc
UPPER_END = 0.108  # [m] along the outline, where the upper sidewall ends
BEAD_ZONES = (0.046, 0.030, 0.0)  # [m] before the bead, where the last zones end


@dataclass(frozen=True)
class Mould:
    """Parameters of an outline, in addition to those that are measured."""

    crown: float = 1.5  # [m] radius, identified
    crown_end: float = 0.066  # [m] axial, assumed
    shoulder: float = 0.045  # [m] radius, assumed
    widest: float = 0.1115  # [m] Table 6: section 22.9 cm without air, less walls of 3 mm
    # [m] along the outline: belts, and the tread's full thickness, end where its outside is 7.85 cm
    # from the mid-plane (Table 6: 15.7 cm wide); the tread ends
    belt_end: float = 0.0735
    tread_end: float = 0.084


@dataclass(frozen=True)
class Outline:
    axial: list[float]  # [m]
    radius: list[float]  # [m]
    length: float  # [m]


def outline(mould: Mould) -> Outline:
    """Points of the four arcs: crown, shoulder, upper sidewall to the widest place, the lower one
    to the bead. The angle is that of the outline against the axle."""
    axial, radius, length = [0.0], [BELT_RADIUS], 0.0

    def add(start: float, end: float, of_arc: float, points: int) -> None:
        nonlocal length
        a, r = axial[-1], radius[-1]
        for k in range(1, points + 1):
            angle = start + (end - start) * k / points
            axial.append(a + of_arc * (sin(angle) - sin(start)))
            radius.append(r - of_arc * (cos(start) - cos(angle)))
        length += of_arc * (end - start)

    crown, shoulder = asin(mould.crown_end / mould.crown), radians(SHOULDER_END)
    add(0.0, crown, mould.crown, POINTS[0])
    add(crown, shoulder, mould.shoulder, POINTS[1])
    add(shoulder, pi / 2, (mould.widest - axial[-1]) / (1.0 - sin(shoulder)), POINTS[2])
    across, down = mould.widest - BEAD[0], radius[-1] - BEAD[1]
    lower = (across**2 + down**2) / (2.0 * across)
    add(pi / 2, pi / 2 + asin(down / lower), lower, POINTS[3])
    return Outline([round(a, 5) for a in axial], [round(r, 5) for r in radius], length)


def zone_ends(mould: Mould) -> list[float]:
    """[m] of belts, shoulder, upper sidewall, sidewall, lower sidewall, bead."""
    length = outline(mould).length
    last = (round(length - before, 4) for before in BEAD_ZONES)
    return [mould.belt_end, mould.tread_end, UPPER_END, *last]


def listed(text: str, key: str) -> list[float]:
    """The values of a key in the text of a tyre file. @raises ValueError"""
    found = re.findall(rf"(?m)^ +{key}: *\[([^]]*)\]", text)
    if len(found) != 1:
        raise ValueError(f"{len(found)} lines of the tyre file have {key}")
    return [float(value) for value in found[0].split(",")]


class MouldTest(unittest.TestCase):
    def test_four_arcs_join_smoothly(self) -> None:
        shape = outline(Mould(crown=1.0))
        self.assertEqual((shape.axial[0], shape.radius[0]), (0.0, BELT_RADIUS))
        self.assertEqual((shape.axial[-1], shape.radius[-1]), BEAD)
        self.assertEqual(max(shape.axial), Mould().widest)
        chords = list(zip(shape.axial, shape.radius))
        angles = [math.atan2(a[1] - b[1], b[0] - a[0]) for a, b in zip(chords, chords[1:])]
        self.assertEqual(angles, sorted(angles))  # bent to the bead everywhere
        self.assertLess(max(b - a for a, b in zip(angles, angles[1:])), math.radians(26))
        total = sum(math.dist(a, b) for a, b in zip(chords, chords[1:]))
        self.assertLess(total, shape.length)
        self.assertAlmostEqual(total, shape.length, delta=2e-3)

    def test_flat_crown_has_its_sagitta(self) -> None:
        of = Mould(crown=1.0)
        shape = outline(of)
        edge = shape.axial.index(of.crown_end)
        drop = 1.0 - math.sqrt(1.0 - of.crown_end**2)
        self.assertAlmostEqual(shape.radius[edge], BELT_RADIUS - drop, delta=1e-5)

    def test_tyre_files_have_the_chosen_profile(self) -> None:
        edge = Mould(crown_end=0.0775, shoulder=0.030, widest=0.109, belt_end=0.0775, tread_end=0.088)
        for tread, of, rubber in (
            ("smooth", Mould(), 1.109596e6),
            ("ribbed", Mould(), 2.408340e6),
            ("lugged", Mould(), None),
            ("equivalent", edge, 2e5),
        ):
            shape = outline(of)
            file = SOURCE / "inputs" / "tyres" / f"p235_75r15_{tread}.yaml"
            text = file.read_text(encoding="utf-8")
            self.assertEqual(listed(text, "axial"), shape.axial)
            self.assertEqual(listed(text, "radius"), shape.radius)
            self.assertEqual(listed(text, "zone_end"), zone_ends(of))
            self.assertEqual(listed(text, "at"), [0, of.belt_end, of.tread_end])
            self.assertEqual(listed(text, "stretch_along")[0], 5e6)
            self.assertEqual(listed(text, "shear")[2:5], [2e3] * 3)
            if rubber:
                (found,) = re.findall(r"C10: (\S+)", text)
                self.assertEqual(float(found), rubber)


class GroovesTest(unittest.TestCase):
    def test_ribbed_tread_has_the_void_share_of_the_report(self) -> None:
        """[Shoop2001] Table 9: 5.1 x 16.6 and 5.3 x 16.2 mm, headed "width x depth", and a share of
        0.44. The share excludes the heading: grooves as wide as 5.1 and 5.3 mm make 0.13."""
        text = (SOURCE / "inputs" / "tyres" / "p235_75r15_ribbed.yaml").read_text(encoding="utf-8")
        widths = [b - a for a, b in zip(listed(text, "from"), listed(text, "to"))]
        half_tread = 0.0785  # [m] Table 6: 15.7 cm
        np.testing.assert_allclose(sorted(widths), [16.2e-3, 16.6e-3], atol=1e-6)
        np.testing.assert_allclose(listed(text, "depth"), [5.1e-3, 5.3e-3])
        self.assertAlmostEqual(sum(widths) / half_tread, 0.44, delta=0.03)
        self.assertAlmostEqual(sum(listed(text, "depth")) / half_tread, 0.13, delta=0.005)


    def test_tyre_with_printed_grooves_equals_the_ribbed_one_otherwise(self) -> None:
        text = cases("tyre_brick")["grooves/printed_241"].files["tyre.yaml"]
        made, ribbed = yaml.safe_load(text), yaml.safe_load((SOURCE / "inputs" / "tyres" / "p235_75r15_ribbed.yaml").read_text())
        self.assertEqual(made.pop("title"), f"{ribbed.pop('title')}, grooves by width and depth")
        voids, others = made.pop("voids"), ribbed.pop("voids")
        self.assertEqual(made, ribbed)
        np.testing.assert_allclose(np.subtract(voids["to"], voids["from"]), others["depth"])
        np.testing.assert_allclose(sorted(np.subtract(others["to"], others["from"])), sorted(map(float, voids["depth"])), atol=1e-6)
        middle, of_ribbed = (np.add(one["to"], one["from"]) / 2 for one in (voids, others))
        np.testing.assert_allclose(middle, of_ribbed, atol=1e-4)

    def test_file_of_the_ribbed_tyre_gives_all_except_the_grooves(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "tyre.yaml"
            file.write_text("title: Other\ncap:\n  C10: 1e6  # softer\nvoids:\n  from: [1]\n")
            study = evaluation("tyre_brick")
            with patch.object(study, "RIBBED", file):
                self.assertEqual(study.ribbed_tyre("cut", to="[2]"), "title: Other, cut\ncap:\n  C10: 1e6\nvoids:\n  to:    [2]\n")


class Table6Test(unittest.TestCase):
    def test_stored_table_has_its_errors(self) -> None:
        table, measured = stored("tyre_brick", "table6"), stored("tyre_table6", "reference")
        for what in ("deflection_cm", "area_cm2", "section_width_cm"):
            error = table[f"{what.rpartition('_')[0]}_error"]
            np.testing.assert_allclose(error, table[what] / measured[what] - 1, atol=2e-4)  # both are rounded


if __name__ == "__main__":
    unittest.main()
