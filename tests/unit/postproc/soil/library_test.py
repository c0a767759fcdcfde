# SPDX-License-Identifier: GPL-2.0-or-later
"""The cards of inputs/soils: their grounds, the table of the page, and Bekker-Wong with a card against
the rigid wheel on the same ground, as the tutorial quotes it."""

import math
import unittest
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from scipy.optimize import brentq

from furrow_post.laws import empirical
from furrow_post.uncertainty.grid_convergence import grid_convergence, noise_of, pooled_scatter
from furrow_post.laws.terrain_values import terrain
from furrow_post.csv_table import read_rows
from furrow_post.json_text import parse_json
from furrow_post.programs import find_program
from furrow_post.read.soil_card import Cone, NoResult, Shear, markdown, read_card
from furrow_post.run.tools import answer
from furrow_post.soil.grains import read_ground
from furrow_post.soil.material import OF_GRAINS, read_material
from support.command import SOURCE

SOILS = SOURCE / "inputs" / "soils"
MATERIALS = SOURCE / "inputs" / "materials"
TUTORIAL = SOURCE / "inputs" / "guide" / "tutorials" / "8_soil_card.md"


def sections_of(name: str) -> dict[str, dict[str, Any]]:
    """Values of a material file with its bases."""
    file = MATERIALS / f"{name}.yaml"
    sections: dict[str, dict[str, Any]] = parse_json(answer([find_program("furrow-point"), "show", file, "--json"]))["sections"]
    return sections


def strengths(name: str, normal: float) -> tuple[float, float]:
    """Shear strength [Pa] of a law of snow under a normal stress [Pa]: at its density and constant volume,
    and in the steady state (cohesive_cam_clay.h; theory: snow, eqs. 1 and 2)."""
    content = sections_of(name)
    law, hardening = content["law"], content["hardening"]
    log_rho, log_p = (np.log([float(x) for x in hardening[key]]) for key in ("rho", "p"))
    rho = float(law["density"])

    def cap(density: float) -> float:
        return math.exp(float(np.interp(math.log(density), log_rho, log_p)))

    if law["type"] == "cohesive_cam_clay":
        beta = float(law["tension_ratio"])
        slope = float(law["M"]) / math.sqrt(3 * (1 + 2 * beta)) * (1 + beta)
        return 0.5 * slope * cap(rho), slope / (1 - beta) * normal
    tangent, nu_p = math.tan(math.radians(float(law["beta"]))), float(law["nu_p"])
    aspect = math.sqrt(4.5 * (1 - 2 * nu_p) / (1 + nu_p))

    def line(density: float) -> float:
        cohesion = float(law["d"]) * math.pow(density / float(law["d_density"]), float(law["d_exponent"]))
        return cohesion + normal * tangent

    if normal == 0:  # where the preset has both at its density
        return line(rho) / math.sqrt(3), line(rho) / math.sqrt(3)
    meet = float(brentq(lambda x: aspect * math.sqrt(max(cap(x) ** 2 - normal**2, 0.0)) - line(x), rho, 2 * rho))
    return line(rho) / math.sqrt(3), line(meet) / math.sqrt(3)


class LibraryTest(unittest.TestCase):
    def test_every_card_is_of_a_material_and_in_the_table(self) -> None:
        paths = sorted(SOILS.glob("*.yaml"))
        self.assertGreater(len(paths), 0)
        cards = [read_card(path) for path in paths]
        for path, card in zip(paths, cards):
            self.assertEqual(path.stem, Path(card.ground).stem)
            of_grains = card.ground.endswith(OF_GRAINS)
            if of_grains:
                read_ground(SOURCE / "inputs" / "laboratory" / "grounds" / card.ground)
            else:
                self.assertEqual(card.density, read_material(MATERIALS / card.ground).density)
            for name, fitted in card.parameters().items():
                if not (of_grains and name == "speed_stress"):  # which is of the grid
                    self.assertGreater(fitted.error, 0, f"{path}: {name}")
            for part in (card.pressure_sinkage, card.shear):
                self.assertTrue(isinstance(part, NoResult) or part.residual < 0.1, path)
            page = (SOILS / "README.md").read_text(encoding="utf-8")
            for instrument in card.failures():  # with the reason, in words
                self.assertRegex(page, f"{path.stem}`[^|]*{instrument}")
        self.assertIn(markdown(cards), (SOILS / "README.md").read_text(encoding="utf-8"))

    def test_ring_on_snow_lies_between_the_closed_forms(self) -> None:
        """The closed forms are those of fresh snow at constant volume and of the steady state; c is of fresh snow."""
        page = (SOILS / "README.md").read_text(encoding="utf-8")
        for name in ("field_snow", "fresh_snow_cam_clay", "snow"):
            shear = read_card(SOILS / f"{name}.yaml").shear
            assert isinstance(shear, Shear)
            fresh_c, _ = strengths(name, 0.0)
            self.assertLess(abs(shear.c.value - fresh_c), 2 * shear.c.error, name)
            for normal in (shear.normal.low, shear.normal.high):
                fresh, steady = strengths(name, normal)
                found = float(shear.at(np.array(shear.displacement.high), np.array(normal)))
                self.assertTrue(fresh < found < steady, f"{name}: {fresh:.0f} {found:.0f} {steady:.0f} Pa")
                self.assertIn(f"| `{name}` | {normal:.0f} | {fresh:.0f} | {found:.0f} | {steady:.0f} |", page)

    def test_card_of_grains_agrees_with_other_tests_of_the_grains(self) -> None:
        """The angle with the law of their triaxial, extension and plane strain tests, a plate with the
        measured one within the misfit of the calibration."""
        study = SOURCE / "inputs" / "validation" / "cmu_sand"
        card = read_card(SOILS / "sand_cmu.yaml")
        plate, shear = card.bekker_and_shear()
        tangent = math.tan(math.radians(float(yaml.safe_load((study / "sand.yaml").read_text())["law"]["beta"])))
        plane = math.degrees(math.atan(3 * tangent / (6 + tangent)))  # tan(phi) = sin(phi')
        self.assertLess(abs(shear.phi.value - plane), 2 * shear.phi.error)
        # The grains do not stick; sand of 10 mm between the grousers, which cover a quarter, presses too
        between = 0.75 * card.density * 9.80665 * 0.01 * math.tan(math.radians(plane))
        self.assertLess(abs(shear.c.value - between), 2 * shear.c.error)
        misfit = float(read_rows(study / "calibration.csv")[0]["rms_100"])
        area, logarithms = math.pi * 0.05**2, []
        for row in read_rows(study / "reference.csv"):
            if row["kind"] == "plate" and row["size_mm"] == "100" and row["sinkage_mm"] in ("10", "20"):
                found = float(plate.at(np.array(1e-3 * float(row["sinkage_mm"])), 0.05))
                logarithms.append(math.log(found * area / float(row["force_N"])))
        self.assertEqual(len(logarithms), 2)
        self.assertLess(math.sqrt(float(np.mean(np.square(logarithms)))), misfit)

    def test_plates_on_bonded_grains_agree_with_the_law_of_that_snow(self) -> None:
        """Neither was fitted to a plate. The page has the pressures under a plate of 200 mm."""
        page = (SOILS / "README.md").read_text(encoding="utf-8")
        names = ("snow_bonded", "snow", "fresh_snow_cam_clay")
        grains, law, clay = (read_card(SOILS / f"{name}.yaml").bekker_and_shear()[0] for name in names)
        for millimetres in (10, 20, 40):
            sinkage = np.array(1e-3 * millimetres)
            row = [float(plate.at(sinkage, 0.1)) for plate in (grains, law, clay)]
            self.assertLess(abs(row[1] / row[0] - 1), 0.06)
            self.assertIn(f"| {millimetres} | " + " | ".join(f"{1e-3 * pressure:.1f}" for pressure in row) + " |", page)

    def test_ring_width_on_a_cohesive_sand_has_its_effect(self) -> None:
        """The cohesion of the fit is that of the law within its error. With the angle of the law, two speeds give
        the width that shears."""
        page = (SOILS / "README.md").read_text(encoding="utf-8")
        law = sections_of("dry_sand_smooth")["law"]
        tangent = math.tan(math.radians(float(law["beta"])))
        sine, cohesion = 3 * tangent / (6 + tangent), 5000.0
        outer, inner = 0.1, 0.06
        rows = read_rows(SOILS / "ring_on_cohesive_sand.csv")
        for cells in (2, 3):
            slow, fast = ([float(value) for value in row.values()] for row in rows if row["cells"] == str(cells))

            def share(sinking: float) -> float:
                psi = math.atan(sinking)
                return math.cos(psi) / (1 + sine * math.sin(psi))

            excess = [shear - share(sinking) * sine * normal for _, _, normal, shear, sinking, *_ in (slow, fast)]
            left = [[share(run[4]), math.sqrt(run[1] / slow[1])] for run in (slow, fast)]
            widened = float(np.linalg.solve(left, excess)[0])

            def widening(edge: float) -> float:
                return ((outer + edge) ** 3 - (inner - edge) ** 3) / (outer**3 - inner**3)

            cell = (outer - inner) / cells
            width = brentq(lambda edge: widening(edge) - widened / cohesion, 0, inner / 2) / cell
            found = widened / widening(0.5 * cell)
            fit, error = slow[5:]
            self.assertLess(abs(fit - cohesion), error)
            self.assertIn(f"| {cells} | {fit:.0f} ± {error:.0f} | {round(found, -1):.0f} | {width:.2f} |", page)
            self.assertIn(f"{found / cohesion - 1:.0%}".replace("%", " %"), page)

    def test_cone_on_grains_agrees_with_the_cone_in_the_fitted_law(self) -> None:
        """Both extrapolated to zero size of grains or cells, within twice the errors; the page and the card have them."""
        page = (SOILS / "README.md").read_text(encoding="utf-8")
        limits = []
        for ground in ("grains", "law"):
            rows = [row for row in read_rows(SOILS / "cone_on_sand.csv") if row["ground"] == ground]
            groups: dict[str, list[float]] = {}
            for row in rows:
                groups.setdefault(row["across"], []).append(float(row["index_Pa"]) / float(row["weight_Pa"]))
            scatter = pooled_scatter(groups.values())
            values = [value for group in groups.values() for value in group]
            errors = [
                noise_of(value, float(row["error_Pa"]) / float(row["weight_Pa"]), scatter) for value, row in zip(values, rows)
            ]
            limits.append(grid_convergence([1 / float(row["across"]) for row in rows], values, errors))
        grains, law = limits
        self.assertLess(abs(grains.value - law.value), 2 * math.hypot(grains.error, law.error))
        self.assertIn(f"| zero size | {grains.value:.1f} ± {grains.error:.1f} | {law.value:.1f} ± {law.error:.1f} |", page)
        for size, value in zip(grains.sizes, grains.values):
            self.assertRegex(page, rf"\| {1 / size:.0f} \| {value:.1f} \|")
        for size, value in zip(law.sizes, law.values):
            self.assertRegex(page, rf"\| {1 / size:.0f} \| [^|]*\| {value:.1f} \|")
        cone = read_card(SOILS / "sand_cmu.yaml").cone
        assert isinstance(cone, Cone)
        weight = float(next(row["weight_Pa"] for row in read_rows(SOILS / "cone_on_sand.csv") if row["across"] == "8"))
        self.assertAlmostEqual(cone.index.value / weight, grains.values[0], delta=0.01)
        self.assertAlmostEqual(cone.index.error / weight, grains.size_error(1 / 8), delta=0.05)

    def test_bekker_wong_with_a_card_is_compared_with_the_wheel(self) -> None:
        ground = terrain(str(SOILS / "dry_sand_smooth.yaml"))
        text = TUTORIAL.read_text(encoding="utf-8")
        rows = read_rows(SOILS / "wheel_on_dry_sand.csv")
        self.assertEqual(len(rows), 2)
        for row in rows:
            load, sinkage, net = (float(row[key]) for key in ("load_N", "sinkage_m", "net_traction"))
            found, fitted_k = (
                empirical.wong_reece(load, 0.74, 0.272, 0.0, soil, extrapolate=True)
                for soil in (ground, replace(ground, K=0.02))
            )
            line = (
                f"| {load:g} | {1e3 * sinkage:.0f} | {1e3 * found.sinkage:.0f} | "
                f"{found.sinkage / sinkage - 1:+.0%} | {net:.2f} | {-found.coefficient:.2f} | "
                f"{-fitted_k.coefficient:.2f} |"
            )
            self.assertIn(line, text)

    def test_bekker_wong_with_the_card_of_grc1_is_compared_with_the_wheel(self) -> None:
        """The page has each load and slip, and the sinkage deviates by less than twice the wheel's error."""
        ground = replace(terrain(str(SOILS / "grc1.yaml")), K=0.01)
        text = TUTORIAL.read_text(encoding="utf-8")
        rows = read_rows(SOILS / "wheel_on_grc1.csv")
        self.assertEqual(len(rows), 4)
        for row in rows:
            load, slip, sinkage, spread, net, net_spread = (float(value) for value in row.values())
            found = empirical.wong_reece(load, 0.74, 0.272, slip, ground, extrapolate=True)
            self.assertLess(abs(found.sinkage - sinkage), 2 * spread)
            line = (
                f"| {load:g} | {slip:g} | {1e3 * sinkage:.0f} ± {1e3 * spread:.0f} | {1e3 * found.sinkage:.0f} | "
                f"{found.sinkage / sinkage - 1:+.0%} | {net:.2f} ± {net_spread:.2f} | {-found.coefficient:.2f} |"
            )
            self.assertIn(line, text)


if __name__ == "__main__":
    unittest.main()
