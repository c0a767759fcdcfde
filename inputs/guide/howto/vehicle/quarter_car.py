#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A quarter car drops on soft ground: stability and energy error over the communication step.

With the coupling "axle" this program moves the axle and receives the force of the ground. With
"load" Furrow moves the axle under the force of the suspension. quarter_car.py [FIGURE]
"""

import sys
from dataclasses import dataclass

import numpy as np
from cosimulation import Wheel

GRAVITY = 9.80665  # [m/s^2]
RADIUS = 0.35  # [m]
STIFFNESS = 2e7  # of the ground in wheel.lig [Pa/m]


@dataclass
class QuarterCar:
    chassis: float = 225.0  # [kg]
    wheel: float = 35.0  # [kg]
    stiffness: float = 25e3  # [N/m]
    damping: float = 2.5e3  # [N s/m]
    drop: float = 0.05  # [m]

    def largest_step(self, ground: float) -> float:
        """Stable step of the coupling "axle" [s]: semi-implicit Euler of a wheel between damper and elastic ground
        of this stiffness [N/m] is stable for (w h)^2 + 2 c/m h < 4.
        """
        a, b = (ground + self.stiffness) / self.wheel, 2 * self.damping / self.wheel
        return float((np.sqrt(b * b + 16 * a) - b) / (2 * a))


@dataclass
class Result:
    step: float  # [s]
    sinkage: float  # [m]
    unrest: float  # mean speed of the axle in the last quarter [m/s]
    energy_error: float  # share of the energy that the ground and the damper take
    contact_stiffness: float  # of the elastic ground below the wheel [N/m]


def simulate(car: QuarterCar, coupling: str, exchange: float, end: float = 1.0, **variables: object) -> Result:
    z = RADIUS + car.drop
    wheel = Wheel({"z": z, "mass": car.wheel, **variables})
    hub = wheel.hub
    if coupling == "load":
        hub.release("z")
    top = z  # of the chassis, with unloaded springs, above the axle's height [m]
    speed, top_speed, damper_loss = 0.0, 0.0, 0.0
    speeds = []
    start = z  # at which the energies are zero
    for _ in range(round(end / exchange)):
        rate = speed - top_speed
        force = car.stiffness * (z - top) + car.damping * rate
        if coupling == "axle":
            ground = wheel.move([0.0, 0.0, z, 0.0], 0.0, exchange)[2]
            speed += exchange * ((ground - force) / car.wheel - GRAVITY)
            z += exchange * speed
        else:
            hub.load = (0.0, 0.0, -force - car.wheel * GRAVITY)
            wheel.run.step(round(exchange / wheel.step))
            z, speed = hub.position[2], hub.velocity[2]
        new_speed = top_speed + exchange * (force / car.chassis - GRAVITY)
        damper_loss += exchange * car.damping * rate * (speed - (top_speed + new_speed) / 2)
        top_speed = new_speed
        top += exchange * top_speed
        speeds.append(abs(speed))
    energy = 0.5 * (car.chassis * top_speed**2 + car.wheel * speed**2 + car.stiffness * (z - top) ** 2)
    energy += GRAVITY * (car.chassis * (top - start) + car.wheel * (z - start))
    lost = damper_loss + wheel.lost_energy()
    area = float(wheel.run.outputs("touch")["area"])
    wheel.close()
    unrest = float(np.mean(speeds[-len(speeds) // 4 :]))
    return Result(exchange, RADIUS - z, unrest, (energy + lost) / lost, STIFFNESS * area)


def draw(results: dict[str, list[Result]], file: str) -> None:
    from matplotlib.figure import Figure

    figure = Figure((7, 2.8), layout="constrained")
    energy, unrest = figure.subplots(1, 2)
    for coupling, found in results.items():
        steps = [1e3 * result.step for result in found]
        energy.loglog(steps, [abs(result.energy_error) for result in found], "o-", ms=3, label=coupling)
        unrest.loglog(steps, [result.unrest for result in found], "o-", ms=3)
    limit = QuarterCar().largest_step(results["axle"][0].contact_stiffness)
    unrest.axvline(1e3 * limit, color="k", ls="--", lw=1)
    energy.set(xlabel="communication step [ms]", ylabel="energy error", ylim=(1e-3, 1))
    unrest.set(xlabel="communication step [ms]", ylabel="mean speed at rest [m/s]", ylim=(1e-5, 10))
    energy.legend()
    figure.savefig(file, dpi=110)


def main() -> None:
    results: dict[str, list[Result]] = {}
    print("coupling  step [ms]  sinkage [mm]  energy error [%]  speed at rest [m/s]")
    for coupling in ("axle", "load"):
        results[coupling] = []
        for step in (0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3, 9e-3, 16e-3, 32e-3):
            found = simulate(QuarterCar(), coupling, step, cell=0.02, step=5e-4)
            results[coupling].append(found)
            print(f"{coupling:8} {1e3 * step:10.1f}", end=" ")
            if found.unrest < 0.1:
                print(f"{1e3 * found.sinkage:13.1f} {100 * found.energy_error:17.1f} {found.unrest:20.1e}", flush=True)
            else:
                print(f"{'unstable':>13} {'':17} {found.unrest:20.1e}", flush=True)
    stiffness = results["axle"][0].contact_stiffness
    print(f"largest step of 'axle' by theory: {1e3 * QuarterCar().largest_step(stiffness):.2f} ms")
    if len(sys.argv) > 1:
        draw(results, sys.argv[1])


if __name__ == "__main__":
    main()
