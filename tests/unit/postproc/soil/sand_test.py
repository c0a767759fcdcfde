# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of quartz sand: peak angles against Bolton's correlation, and the sand of a cone index."""

import math
import re
import tempfile
import unittest
from pathlib import Path

import pandas as pd

from furrow_post.csv_table import read_rows
from furrow_post.programs import find_program
from furrow_post.run.tools import answer
from furrow_post.soil.sand import TABLE, quartz_sand
from support.command import SOURCE

MATERIALS = SOURCE / "inputs" / "materials"
LOOSEST, DENSEST = 0.977, 0.597  # void ratios of Toyoura sand [Verdugo1996]
CRITICAL = 30.9  # [degrees] of M = 1.24 in triaxial compression


def peak_angle(sand: str, confinement: float, folder: Path) -> tuple[float, float]:
    """Largest friction angle [degrees] in triaxial compression, and the mean stress there [kPa]. confinement: Pa"""
    path = folder / f"{sand}.yaml"
    path.write_text(
        f"title: {sand}\nmaterial: {MATERIALS / sand}.yaml\n"
        f"path: {{type: triaxial, confinement: {confinement:g}, axial_strain: [0.15], steps: 300}}\n"
    )
    answer([find_program("furrow-point"), "run", path, "-o", folder / sand, "--no-plot"])
    points = pd.read_csv(folder / sand / "point.csv", comment="#")
    peak = points.loc[points["stress_ratio"].idxmax()]
    return math.degrees(math.asin(3 * peak["stress_ratio"] / (6 + peak["stress_ratio"]))), 1e-3 * float(peak["p"])


class QuartzSandTest(unittest.TestCase):
    def test_peak_angles_are_within_two_degrees_of_bolton(self) -> None:
        """M. D. Bolton (1986): the peak exceeds the critical angle by 3 I_R degrees, I_R = I_D (10 - ln p) - 1 from 0 to 4."""
        with tempfile.TemporaryDirectory() as folder:
            for sand, void_ratio in (("sand_loose", 0.92), ("sand_medium", 0.78), ("sand_firm", 0.64)):
                density = (LOOSEST - void_ratio) / (LOOSEST - DENSEST)
                for confinement in (2e4, 1e5):
                    angle, pressure = peak_angle(sand, confinement, Path(folder))
                    bolton = CRITICAL + 3 * min(max(density * (10 - math.log(pressure)) - 1, 0), 4)
                    self.assertLess(abs(angle - bolton), 2, f"{sand}: {angle:.1f}, Bolton {bolton:.1f} degrees")

    def test_the_sand_of_a_cone_index_is_that_of_the_table(self) -> None:
        rows = [row for row in read_rows(SOURCE / "inputs" / "soils" / TABLE) if row["across"] == "2"]
        for row in rows:
            text = quartz_sand("sand", float(row["index_Pa"]))
            assert text is not None
            found = {key: float(value) for key, value in re.findall(r"(density|e0|pt): ([\d.]+)", text)}
            self.assertAlmostEqual(found["e0"], float(row["e0"]), places=4)
            self.assertAlmostEqual(found["pt"] / float(row["pt_Pa"]), 1, places=3)
            self.assertAlmostEqual(found["density"] * (1 + found["e0"]) / 2650, 1, places=3)
        first, last = float(rows[0]["index_Pa"]), float(rows[-1]["index_Pa"])
        self.assertIsNone(quartz_sand("sand", 0.99 * first))
        self.assertIsNone(quartz_sand("sand", 1.01 * last))

    def test_titles_of_the_files_have_the_index_of_the_table(self) -> None:
        rows = {(row["e0"], row["pt_Pa"]): float(row["index_Pa"]) for row in read_rows(SOURCE / "inputs" / "soils" / TABLE) if row["across"] == "2"}
        for sand, key in (("sand_loose", ("0.92", "20")), ("sand_medium", ("0.78", "20")), ("sand_firm", ("0.64", "20"))):
            title = (MATERIALS / f"{sand}.yaml").read_text(encoding="utf-8").splitlines()[0]
            self.assertAlmostEqual(float(re.findall(r"cone index (\d+) kPa", title)[0]), 1e-3 * rows[key], delta=5)


if __name__ == "__main__":
    unittest.main()
