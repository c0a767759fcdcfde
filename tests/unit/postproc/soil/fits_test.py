# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits of a soil card: known parameters from synthetic curves with noise, and errors that hold."""

import math
import unittest
from dataclasses import replace

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError
from furrow_post.read.soil_card import PressureSinkage, Shear
from furrow_post.soil.fits import (
    ConeCurve,
    PlateCurve,
    ShearCurve,
    cone_index,
    fit_plates,
    fit_shear,
)
from furrow_post.soil.instruments import ring_scale

K_C, K_PHI, N = 2.0e4, 1.5e6, 0.8
C, PHI, K, SPEED_STRESS = 900.0, 31.0, 0.012, 700.0
G, START = 1.2e6, 2.0e4  # of a cone


def noise(random: np.random.Generator, size: int, scale: float, memory: float) -> Floats:
    """Neighbours are correlated by `memory`, as in curves of a run."""
    steps = random.normal(0, scale * math.sqrt(1 - memory**2), size)
    values = np.empty(size)
    values[0] = random.normal(0, scale)
    for k in range(1, size):
        values[k] = memory * values[k - 1] + steps[k]
    return values


def plates(random: np.random.Generator, memory: float = 0.8) -> PressureSinkage:
    curves = []
    for radius in (0.05, 0.075, 0.1):
        z = np.linspace(1e-3, 0.6 * radius, 150)
        p = (K_C / radius + K_PHI) * z**N
        curves.append(PlateCurve(radius, z, p + noise(random, z.size, 0.02 * p.max(), memory)))
    return fit_plates(curves)


def shear(random: np.random.Generator, memory: float = 0.8) -> Shear:
    curves = []
    for normal, speed in ((5e3, 0.04), (1e4, 0.04), (2e4, 0.04), (5e3, 0.16)):
        j = np.linspace(0, 0.05, 150)
        sigma = normal * (1 + 0.1 * np.sin(60 * j))  # a load that is not quite held
        strength = C + sigma * math.tan(math.radians(PHI)) + SPEED_STRESS * math.sqrt(speed / 0.04)
        tau = strength * (1 - np.exp(-j / K))
        curves.append(ShearCurve(j, sigma, tau + noise(random, j.size, 0.02 * tau.max(), memory), speed))
    return fit_shear(curves[:3], curves[3])


class ExactCurvesTest(unittest.TestCase):
    def test_parameters_are_recovered(self) -> None:
        plate = plates(np.random.default_rng(1), memory=0.0)
        z = np.linspace(1e-3, 0.03, 50)
        exact = fit_plates([PlateCurve(b, z, (K_C / b + K_PHI) * z**N) for b in (0.05, 0.1)])
        for found, truth in ((exact.k_c, K_C), (exact.k_phi, K_PHI), (exact.n, N)):
            self.assertAlmostEqual(found.value / truth, 1, delta=1e-5)
        self.assertLess(exact.residual, 1e-6)
        self.assertAlmostEqual(plate.residual, 0.02, delta=0.004)
        self.assertEqual((exact.radii.low, exact.radii.high), (0.05, 0.1))
        np.testing.assert_allclose(exact.at(z, 0.05), (K_C / 0.05 + K_PHI) * z**N, rtol=1e-5)

    def test_varying_load_gives_the_shear_parameters(self) -> None:
        j = np.linspace(0, 0.05, 80)
        curves = []
        for normal in (5e3, 2e4):
            sigma = normal * (1 - 0.3 * j / j.max())
            tau = (C + sigma * math.tan(math.radians(PHI))) * (1 - np.exp(-j / K))
            curves.append(ShearCurve(j, sigma, tau))
        found = fit_shear(curves)
        for value, truth in ((found.c, C), (found.phi, PHI), (found.K, K)):
            self.assertAlmostEqual(value.value / truth, 1, delta=1e-5)

    def test_stress_by_the_root_of_the_speed_is_subtracted(self) -> None:
        j = np.linspace(0, 0.05, 80)

        def ring(normal: float, speed: float) -> ShearCurve:
            strength = C + normal * math.tan(math.radians(PHI)) + 800 * math.sqrt(speed)
            return ShearCurve(j, np.full(j.size, normal), strength * (1 - np.exp(-j / K)), speed)

        slow, fast = [ring(5e3, 0.04), ring(2e4, 0.04)], ring(5e3, 0.16)
        self.assertAlmostEqual(fit_shear(slow).c.value / (C + 160), 1, delta=1e-5)
        found = fit_shear(slow, fast)
        for value, truth in ((found.c, C), (found.phi, PHI), (found.K, K), (found.speed_stress, 160)):
            self.assertAlmostEqual(value.value / truth, 1, delta=1e-5)

    def test_cone_index_is_the_mean_over_15_cm(self) -> None:
        z = np.linspace(-0.04, 0.2, 241)
        found = cone_index(ConeCurve(z, START + G * z, 0.02, 30.0))
        self.assertAlmostEqual(found.index.value, START + G * 0.075, delta=1.0)
        self.assertAlmostEqual(found.gradient.value / G, 1, delta=1e-9)
        self.assertAlmostEqual(found.depth.high, 0.15, delta=1e-9)


class CoverageTest(unittest.TestCase):
    """The error covers the truth as often as a standard error does, within the scatter of the draws."""

    DRAWS = 150

    def test_errors_cover_the_true_value(self) -> None:
        random = np.random.default_rng(7)
        deviations: dict[str, list[float]] = {}
        for _ in range(self.DRAWS):
            plate, ring = plates(random), shear(random)
            z = np.linspace(0, 0.15, 150)
            cone = cone_index(ConeCurve(z, START + G * z + noise(random, z.size, 5e3, 0.8), 0.02, 30.0))
            for name, found, truth in (
                ("k_c", plate.k_c, K_C),
                ("k_phi", plate.k_phi, K_PHI),
                ("n", plate.n, N),
                ("c", ring.c, C),
                ("phi", ring.phi, PHI),
                ("K", ring.K, K),
                ("speed stress", ring.speed_stress, SPEED_STRESS),
                ("index", cone.index, START + G * 0.075),
                ("gradient", cone.gradient, G),
            ):
                deviations.setdefault(name, []).append((found.value - truth) / found.error)
        for name, values in deviations.items():
            within = np.abs(np.array(values))
            self.assertGreater(np.mean(within < 2), 0.85, name)
            self.assertTrue(0.5 < np.mean(within < 1) < 0.85, f"{name}: {np.mean(within < 1)}")


class SinkingTest(unittest.TestCase):
    def test_sinking_ring_has_the_friction_of_a_level_one(self) -> None:
        """Closed form of Davis: the principal axes of stress and of strain rate coincide."""
        cohesion, sine, j = 150.0, 0.5, np.linspace(0, 0.03, 200)
        curves = []
        for load, psi in ((2e3, 0.05), (4e3, 0.15), (8e3, 0.3)):
            # Mohr's circle with the centre p and radius p sin(phi') + c': the plane of the ring is at the
            # angle 45 degrees + psi/2 of its major stress
            radius = (cohesion + load * sine) / (1 + sine * math.sin(psi))
            shear = radius * math.cos(psi) * (1 - np.exp(-j / 0.001))
            curves.append(ShearCurve(j, np.full(200, load), shear, sinking=math.tan(psi)))
        ring = fit_shear(curves)
        self.assertAlmostEqual(math.tan(math.radians(ring.phi.value)), sine, places=5)
        self.assertAlmostEqual(ring.c.value, cohesion, delta=0.1)


class RefusalTest(unittest.TestCase):
    def test_curves_that_do_not_determine_the_parameters_are_refused(self) -> None:
        z = np.linspace(1e-3, 0.03, 30)
        one = PlateCurve(0.05, z, 1e6 * z)
        with self.assertRaisesRegex(ResultsError, "plates of two sizes or more"):
            fit_plates([one, one])
        with self.assertRaisesRegex(ResultsError, "a plate that carries load"):
            fit_plates([one, PlateCurve(0.1, z, 0 * z)])
        ring = ShearCurve(z, np.full(30, 1e4), 1e3 * z)
        with self.assertRaisesRegex(ResultsError, "a ring under loads that differ by a factor of 1.5"):
            fit_shear([ring, ring])
        with self.assertRaisesRegex(ResultsError, "curves within 10% of Bekker's law"):
            fit_plates([PlateCurve(b, z, 1e6 * np.exp(-z / 0.01)) for b in (0.05, 0.1)])
        # 0.2 of the normal stress, and 3 kPa by the speed
        first, second, fast = (
            ShearCurve(z, np.full(30, load), np.full(30, stress), speed)
            for load, stress, speed in ((1e4, 5e3, 0.1), (2e4, 7e3, 0.1), (1e4, 8e3, 0.4))
        )
        with self.assertRaisesRegex(ResultsError, "a speed stress below 0.5 of the shear stress"):
            fit_shear([first, second], fast)
        high = ShearCurve(z, np.full(30, 5e3), np.full(30, 2e3), 0.1, 1e3)
        with self.assertRaisesRegex(ResultsError, "holds its load: it carries 5000 Pa in place of 1000 Pa"):
            fit_shear([first, high])
        sinks = ShearCurve(z, second.normal, second.shear, 0.1, sinking=0.5)
        with self.assertRaisesRegex(ResultsError, "under 20000 Pa it sinks by 0.50 of it"):
            fit_shear([first, sinks])
        with self.assertRaisesRegex(ResultsError, "a cone whose base is below the surface"):
            cone_index(ConeCurve(-z, z, 0.02, 30.0))


class RingOnSnowTest(unittest.TestCase):
    def test_only_a_modulus_far_above_the_pressure_is_scaled(self) -> None:
        self.assertEqual(ring_scale(4.78e6, 4.9e4), 1)  # dry_sand_smooth
        self.assertEqual(ring_scale(499e4, 1e4), 1)
        self.assertAlmostEqual(ring_scale(13.79e6, 3900), 100 * 3900 / 13.79e6)  # field_snow
        self.assertEqual(ring_scale(1e10, 1e3), 0.01)  # least modulus_scale of terrain/continuum

    def test_growing_shear_stress_is_reported_as_unsteady(self) -> None:
        j = np.linspace(0, 0.04, 401)
        for shear, growth in ((1e5 * j, 2 / 3), (np.full(j.size, 500.0), 0.0)):
            self.assertAlmostEqual(ShearCurve(j, np.full(j.size, 1e3), shear).growth(), growth, delta=0.01)

    def test_correction_for_sinking_needs_constant_strength(self) -> None:
        j = np.linspace(0, 0.04, 11)
        ring = ShearCurve(j, 1e3 + 0 * j, 500 + 0 * j, sinking=0.3)
        psi = math.atan(0.3)
        self.assertAlmostEqual(ring.share(0.5), math.cos(psi) / (1 + 0.5 * math.sin(psi)))
        self.assertEqual(replace(ring, compacts=True).share(0.5), 1)


if __name__ == "__main__":
    unittest.main()
