# SPDX-License-Identifier: GPL-2.0-or-later
"""A vehicle and a quarter car in Python on wheels of Furrow: equilibrium, momentum, energy, stability."""

import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "inputs" / "guide" / "howto" / "vehicle"))

import numpy as np
import quarter_car
import vehicle as model

COARSE = {"cell": 0.04, "step": 1e-3}


class QuarterCar(unittest.TestCase):
    def test_stability_limit_equals_theory(self) -> None:
        car = quarter_car.QuarterCar()
        stiffness = quarter_car.simulate(car, "axle", 2e-3, end=0.5, cell=0.04).contact_stiffness
        below = 0.5e-3 * np.floor(car.largest_step(stiffness) / 0.5e-3)
        self.assertGreater(below, 5e-3)
        self.assertLess(quarter_car.simulate(car, "axle", below, cell=0.04).unrest, 1e-3)
        self.assertGreater(quarter_car.simulate(car, "axle", below + 1e-3, cell=0.04).unrest, 0.1)

    def test_coupling_by_load_is_stable_beyond_and_has_half_the_error(self) -> None:
        car = quarter_car.QuarterCar()
        self.assertLess(quarter_car.simulate(car, "load", 10e-3, cell=0.04).unrest, 1e-3)
        by_axle, by_load = (quarter_car.simulate(car, name, 2e-3, cell=0.04) for name in ("axle", "load"))
        self.assertLess(by_axle.energy_error, 0.02)
        self.assertLess(abs(by_load.energy_error), 0.6 * by_axle.energy_error)
        self.assertAlmostEqual(by_load.sinkage / by_axle.sinkage, 1.0, delta=0.01)


class Vehicle(unittest.TestCase):
    def test_loads_pull_and_energy_are_in_balance(self) -> None:
        car = model.Vehicle()
        wheels = model.open_wheels(car, **COARSE)
        self.addCleanup(wheels.close)
        drive, step = model.Drive(draught=400.0, settle=0.8, ramp=0.6), 4e-3
        rows, lost = [], {}
        for row in model.simulate(car, wheels, drive, 2.8, step):
            rows.append(row)
            if len(rows) in (200, 600, 700):
                lost[len(rows)] = wheels.lost_energy()
        force = np.array([row["forces"] for row in rows])
        torque, spin_rate = (np.array([row[name] for row in rows]) for name in ("torque", "spin_rate"))

        # At rest: shares of the axles from the moments about the other one
        weight = car.chassis * model.GRAVITY
        settled = force[190:200].mean(axis=0)
        front = weight * 1.2 / 2.2 + 2 * car.wheel * model.GRAVITY
        self.assertAlmostEqual(settled[:2, 2].sum() / front, 1.0, delta=0.005)
        self.assertAlmostEqual(settled[:, 2].sum() / (car.mass * model.GRAVITY), 1.0, delta=0.005)
        np.testing.assert_allclose(settled[::2, 2], settled[1::2, 2], rtol=1e-3)

        # Momentum along x of the whole run
        impulse = step * (force[:, :, 0].sum() - np.sum([row["draught"] for row in rows]))
        self.assertAlmostEqual(impulse / (car.mass * car.plane_rate[0]), 1.0, delta=1e-9)

        # Steady travel: pull, moments of the wheels, and moments about the centre of mass
        steady = force[600:].mean(axis=0)
        self.assertAlmostEqual(steady[:, 0].sum() / 400.0, 1.0, delta=0.02)
        # forces belong to nodes that have turned by a step since: load x speed x step
        turned = steady[:, 2] * car.plane_rate[0] * COARSE["step"]
        np.testing.assert_allclose(turned - steady[:, 4], torque[600:].mean(axis=0), rtol=0.005)
        heights = np.array([row["poses"][:, 2] - row["attitude"][0] for row in rows[600:]]).mean(axis=0)
        weights = np.array([0.0, 0.0, car.wheel * model.GRAVITY])
        moment = np.sum(heights * steady[:, 0] - car.x * (steady[:, 2] - weights[2]) + steady[:, 4])
        moment -= car.hitch_height * 400.0
        self.assertAlmostEqual(moment / (front * 1.0), 0.0, delta=0.01)

        # Its power: shafts drive the draught and deform the ground
        part = slice(600, 700)
        shafts = step * np.sum(torque[part] * spin_rate[part])
        pull = step * 400.0 * np.sum([row["plane_rate"][0] for row in rows[part]])
        self.assertAlmostEqual((pull + lost[700] - lost[600]) / shafts, 1.0, delta=0.02)

    def test_steered_vehicle_turns_with_the_lateral_force(self) -> None:
        car = model.Vehicle()
        wheels = model.open_wheels(car, breadth=4, **COARSE)
        self.addCleanup(wheels.close)
        drive = model.Drive(steering=np.radians(10.0), settle=0.4, ramp=0.6)
        rows = list(model.simulate(car, wheels, drive, 3.0, 4e-3))[-100:]
        speed = np.mean([np.hypot(*row["plane_rate"][:2]) for row in rows])
        turn = np.mean([row["plane_rate"][2] for row in rows])
        yaw = np.array([row["plane"][2] for row in rows])
        across = np.array([row["forces"][:, :2].sum(axis=0) for row in rows])
        lateral = np.mean(across[:, 1] * np.cos(yaw) - across[:, 0] * np.sin(yaw))
        self.assertAlmostEqual(lateral / (car.mass * speed * turn), 1.0, delta=0.05)
        self.assertGreater(turn / (speed * np.tan(np.radians(10.0)) / 2.2), 0.5)  # less than on a road
        self.assertLess(turn / (speed * np.tan(np.radians(10.0)) / 2.2), 1.0)
        loads = np.mean([row["forces"][:, 2] for row in rows], axis=0)
        self.assertGreater(loads[1] + loads[3], loads[0] + loads[2])  # the outer wheels

    def test_error_of_a_wheel_reaches_the_vehicle(self) -> None:
        with self.assertRaisesRegex(RuntimeError, "wheel.lig, line .*k_cc|variable 'lenght'"):
            model.open_wheels(model.Vehicle(), lenght=3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
