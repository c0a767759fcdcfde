#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A vehicle with four wheels on soft ground. Each wheel and its ground run in a process of Furrow."""

import argparse
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from cosimulation import Array, Wheels

GRAVITY = 9.80665  # [m/s^2]
WHEELS = ("front_left", "front_right", "rear_left", "rear_right")


def zeros(count: int) -> Array:
    return field(default_factory=lambda: np.zeros(count))


@dataclass
class Vehicle:
    """A chassis with plane motion, heave, roll and pitch, on two beam axles that move up and down.

    x points forward, y to the left, z up. Roll and pitch are small angles about the centre of mass.
    The plane motion has the mass of chassis and wheels. Horizontal forces reach the chassis at the
    height of the axles.
    """

    chassis: float = 900.0  # [kg]
    wheel: float = 35.0  # mass of each wheel [kg]
    inertia: tuple[float, float, float] = (250.0, 900.0, 1100.0)  # roll, pitch, yaw [kg m^2]
    x: tuple[float, ...] = (1.0, 1.0, -1.2, -1.2)  # of the wheels from the centre of mass [m]
    y: tuple[float, ...] = (0.7, -0.7, 0.7, -0.7)
    height: float = 0.45  # of the centre of mass above the axles, with unloaded springs [m]
    stiffness: float = 25e3  # of each suspension [N/m]
    damping: float = 2.5e3  # [N s/m]
    hitch_height: float = -0.35  # from the centre of mass [m]
    radius: float = 0.35  # of the wheels [m]

    # Inputs of the driver
    steering: float = 0.0  # of the front wheels [rad]
    torque: Array = zeros(4)  # of the shafts [N m]
    draught: float = 0.0  # force at the hitch, backwards [N]

    # Coordinates and their rates
    plane: Array = zeros(3)  # x, y [m], yaw [rad]
    plane_rate: Array = zeros(3)
    attitude: Array = zeros(3)  # z of the centre of mass [m], roll, pitch [rad]
    attitude_rate: Array = zeros(3)
    axles: Array = zeros(4)  # z [m]
    axles_rate: Array = zeros(4)

    def __post_init__(self) -> None:
        """The vehicle stands on the ground, with the springs loaded by the chassis."""
        self.axles[:] = self.radius + 1e-3
        self.attitude[0] = self.axles[0] + self.height - self.chassis * GRAVITY / (4 * self.stiffness)

    @property
    def mass(self) -> float:
        return self.chassis + 4 * self.wheel

    @property
    def corners(self) -> Array:
        """Rise of each suspension's upper end by heave, roll and pitch."""
        return np.column_stack((np.ones(4), self.y, np.negative(self.x)))

    @property
    def yaws(self) -> Array:
        """Yaw angles of the wheels against the chassis [rad]."""
        return np.array([self.steering, self.steering, 0.0, 0.0])

    def turned(self, vectors: Array, yaw: float) -> Array:
        c, s = np.cos(yaw), np.sin(yaw)
        turned: Array = vectors @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        return turned

    def suspension(self) -> Array:
        """Forces on the chassis [N]."""
        squeeze = self.axles + self.height - self.corners @ self.attitude
        rate = self.axles_rate - self.corners @ self.attitude_rate
        return self.stiffness * squeeze + self.damping * rate

    def poses(self) -> Array:
        """x, y, z [m] and yaw [rad] of each wheel. Beam axles keep them upright."""
        _, roll, pitch = self.attitude
        arm = self.axles - self.attitude[0]
        corners = np.column_stack((self.x + pitch * arm, self.y - roll * arm, self.axles))
        place = self.turned(corners, self.plane[2]) + (*self.plane[:2], 0.0)
        return np.column_stack((place, self.plane[2] + self.yaws))

    def advance(self, ground: Array, step: float) -> None:
        """One step of semi-implicit Euler under six forces of the ground on each wheel [N, N m]."""
        yaw = self.plane[2]
        (f_x, f_y, f_z), moments = self.turned(ground[:, :3], -yaw).T, self.turned(ground[:, 3:], -yaw)
        spring = self.suspension()
        # Links pass moments to the chassis: about an axle that of the shaft. A beam carries m_x.
        axle = np.column_stack((-np.sin(self.yaws), np.cos(self.yaws), np.zeros(4)))
        about_axle = np.sum(moments * axle, axis=1)
        m_x, m_y, m_z = (moments - (about_axle + self.torque)[:, None] * axle).T
        beam = m_x.reshape(2, 2).sum(axis=1).repeat(2) / np.multiply(2.0, self.y)
        self.axles_rate += step * ((f_z + beam - spring) / self.wheel - GRAVITY)
        arm = self.axles - self.attitude[0]
        heave = np.sum(spring) - self.chassis * GRAVITY
        roll = np.sum(np.multiply(self.y, spring) - arm * f_y)
        pitch = np.sum(arm * f_x - np.multiply(self.x, spring) + m_y) - self.hitch_height * self.draught
        turn = np.sum(np.multiply(self.x, f_y) - np.multiply(self.y, f_x) + m_z)
        self.attitude_rate += step * np.array([heave, roll, pitch]) / (self.chassis, *self.inertia[:2])
        push = self.turned(np.array([np.sum(f_x) - self.draught, np.sum(f_y), 0.0]), yaw)
        self.plane_rate += step * np.append(push[:2] / self.mass, turn / self.inertia[2])
        self.plane = self.plane + step * self.plane_rate
        self.attitude = self.attitude + step * self.attitude_rate
        self.axles = self.axles + step * self.axles_rate


@dataclass
class Drive:
    """Motors that hold a rim speed. Speed, steering and draught grow after the vehicle has settled."""

    speed: float = 1.5  # of the rims [m/s]
    steering: float = 0.0  # [rad]
    draught: float = 0.0  # [N]
    settle: float = 1.0  # [s]
    ramp: float = 1.0  # [s]
    gain: float = 300.0  # torque for a spin rate too low [N m s/rad]

    def __call__(self, vehicle: Vehicle, spin_rate: Array, now: float) -> None:
        share = min(max((now - self.settle) / self.ramp, 0.0), 1.0)
        smooth = share * share * (3 - 2 * share)
        vehicle.torque = self.gain * (smooth * self.speed / vehicle.radius - spin_rate)
        vehicle.steering, vehicle.draught = smooth * self.steering, smooth * self.draught


def open_wheels(vehicle: Vehicle, **variables: object) -> Wheels:
    """Starts one process for each wheel."""
    return Wheels([{"x": x, "y": y, "z": z, **variables} for x, y, z in vehicle.poses()[:, :3]])


def simulate(vehicle: Vehicle, wheels: Wheels, drive: Drive, end: float, step: float) -> Iterator[dict[str, Array]]:
    """@return after each communication step: time, torques, forces of the ground, then the motion that follows"""
    spin_rate = np.zeros(4)
    for count in range(round(end / step)):
        drive(vehicle, spin_rate, count * step)
        poses = vehicle.poses()
        answers = wheels.move(poses, vehicle.torque, step)
        forces, spin_rate = answers[:, :6], answers[:, 6]
        vehicle.advance(forces, step)
        yield {
            "time": np.array([(count + 1) * step]),
            "torque": vehicle.torque,
            "draught": np.array([vehicle.draught]),
            "poses": poses,
            "forces": forces,
            "spin_rate": spin_rate,
            "plane": vehicle.plane,
            "plane_rate": vehicle.plane_rate.copy(),
            "attitude": vehicle.attitude,
        }


def draw(rows: dict[str, Array], file: Path) -> None:
    from matplotlib.figure import Figure

    figure = Figure((10, 3.2), layout="constrained")
    path, load, pull = figure.subplots(1, 3)
    for k, name in enumerate(WHEELS):
        path.plot(rows["poses"][:, k, 0], rows["poses"][:, k, 1], lw=1)
        load.plot(rows["time"], rows["forces"][:, k, 2] / 1e3, lw=1, label=name)
        pull.plot(rows["time"], np.hypot(*rows["forces"][:, k, :2].T) / 1e3, lw=1)
    path.plot(*rows["plane"][:, :2].T, "k--", lw=1)
    path.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title="paths of wheels and centre of mass")
    load.set(xlabel="time [s]", ylabel="[kN]", title="wheel loads")
    load.legend(fontsize=8)
    pull.set(xlabel="time [s]", ylabel="[kN]", title="horizontal forces of the ground")
    figure.savefig(file, dpi=110)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--speed", type=float, default=1.5, help="of the rims [m/s]")
    parser.add_argument("--steering", type=float, default=0.0, help="of the front wheels [degrees]")
    parser.add_argument("--draught", type=float, default=0.0, help="force at the hitch [N]")
    parser.add_argument("--end", type=float, default=4.0, help="[s]")
    parser.add_argument("--step", type=float, default=4e-3, help="between exchanges [s]")
    parser.add_argument("--results", type=Path, default=Path("results/vehicle"))
    parser.add_argument("-v", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"), help="of wheel.lig")
    given = parser.parse_args()
    vehicle, begin = Vehicle(), time.perf_counter()
    wheels = open_wheels(vehicle, **dict(given.v))
    drive = Drive(given.speed, float(np.radians(given.steering)), given.draught)
    found = list(simulate(vehicle, wheels, drive, given.end, given.step))
    rows = {name: np.array([row[name] for row in found]) for name in found[0]}
    wheels.close()
    given.results.mkdir(parents=True, exist_ok=True)
    np.savez(given.results / "vehicle.npz", **rows)
    draw(rows, given.results / "vehicle.png")
    last = rows["time"][:, 0] > given.end - 0.2
    print("wheel        load [N]  pull [N]  torque [N m]  slip")
    for k, name in enumerate(WHEELS):
        load, torque = rows["forces"][last, k, 2].mean(), rows["torque"][last, k].mean()
        yaw = rows["poses"][last, k, 3]
        ahead = np.column_stack((np.cos(yaw), np.sin(yaw)))
        pull = np.sum(rows["forces"][last, k, :2] * ahead, axis=1).mean()
        travel = np.sum(np.gradient(rows["poses"][:, k, :2], given.step, axis=0)[last] * ahead, axis=1)
        slip = 1 - travel.mean() / (vehicle.radius * rows["spin_rate"][last, k].mean())
        print(f"{name:11} {load:9.0f} {pull:9.0f} {torque:13.1f} {slip:5.2f}")
    print(f"{(time.perf_counter() - begin) / given.end:.1f} s for each second; results: {given.results}")


if __name__ == "__main__":
    main()
