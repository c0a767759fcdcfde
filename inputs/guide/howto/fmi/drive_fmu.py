#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Two shaft torques from one state of an FMU: drive_fmu.py wheel.fmu [FIGURE]"""

import sys
from pathlib import Path

from importer import Fmu, Instance

STEP, SPEED, LOAD = 4e-3, 0.5, 2500.0  # [s], [m/s], [N]
OUTPUTS = ("force_x", "force_z", "hub_z", "hub_spin_rate")


def main(file: str, figure: str = "") -> None:
    wheel = Instance(Fmu(Path(file)))
    wheel.initialize({"height_by_load": True, "variables.cell": "0.03"})
    time, x, rows = 0.0, 0.0, {80.0: [], 160.0: []}  # type: ignore[var-annotated]
    while time < 0.5 - STEP / 2:  # settle
        wheel.set({"load": LOAD * min(1.0, time / 0.3)})
        wheel.step(time, STEP)
        time += STEP
    settled, begin = wheel.get_state(), time
    for torque, found in rows.items():
        wheel.set_state(settled)
        time, x = begin, 0.0
        while time < 2.0:
            speed = SPEED * min(1.0, (time - begin) / 0.5)
            rate = wheel.get("hub_spin_rate")
            drive = torque + 100.0 * (speed / 0.35 - rate)  # a motor that holds its rim speed
            wheel.set({"load": LOAD, "spin_torque": drive, "position_x": x, "velocity_x": speed})
            wheel.step(time, STEP)
            time, x = time + STEP, x + STEP * speed
            found.append((time, *(wheel.get(name) for name in OUTPUTS)))
        _, pull, load, height, rate = found[-1]
        print(f"torque {torque:.0f} N m and more: pull {pull:.0f} N, load {load:.0f} N, axle at {height:.4f} m")
    wheel.free_state(settled)
    wheel.call("fmi2Terminate")
    wheel.free()
    if figure:
        draw(rows, figure)


def draw(rows: dict[float, list[tuple[float, ...]]], file: str) -> None:
    from matplotlib.figure import Figure

    figure = Figure((7, 2.6), layout="constrained")
    axes = figure.subplots(1, 2)
    for torque, found in rows.items():
        times = [row[0] for row in found]
        axes[0].plot(times, [row[1] for row in found], lw=1, label=f"{torque:.0f} N m")
        axes[1].plot(times, [1e3 * row[3] for row in found], lw=1)
    axes[0].set(xlabel="time [s]", ylabel="pull [N]")
    axes[1].set(xlabel="time [s]", ylabel="height of the axle [mm]")
    axes[0].legend()
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
