# SPDX-License-Identifier: GPL-2.0-or-later
"""A body on three and four wheels rolls over sand: momentum, statics, mirror image, restart.

    rolling_chassis_test.py <case> <furrow>

level: four wheels carry the weight and left equals right. A run that continues has the same bits.
slopes: four wheels on a grade with a side slope. driven: a tricycle climbs by torques.

The wheel loads of each case balance weights, guides and torques about the three axes. Mean loads over
a window include the change of momentum in it, so the balance is exact but for the time step.
"""

import math
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, script_output

HERE = Path(__file__).resolve().parent
GRAVITY, STEP = 9.80665, 1e-3  # [m/s2], [s]
# vehicle.lig: [kg], [kg], [N/m], [kg m2], [kg m2], [m], [m], [m]
WHEEL, SPRUNG, STIFFNESS, ROLL, PITCH = 8.0, 32.0, 15000.0, 25.0, 40.0
BASE, TRACK, HEIGHT = 1.2, 1.0, 0.3
PLACES = {4: {"a": (0.5, 0.5), "b": (-0.5, 0.5), "c": (-0.5, -0.5), "d": (0.5, -0.5)},
          3: {"a": (2 / 3, 0.0), "b": (-1 / 3, 0.5), "c": (-1 / 3, -0.5)}}  # of BASE, TRACK
WINDOW = slice(1600, 2000)  # steps of the cruise
BALANCE = 1e-4  # of the weight, also times BASE or TRACK
ROUNDING = 1e-9  # of the largest value
CHECKPOINT = 1400


@dataclass
class Vehicle:
    """A run: columns of each wheel (rows, wheels) and heave, roll and pitch (rows, 3)."""

    columns: dict[str, np.ndarray]
    motion: np.ndarray
    x: np.ndarray = field(init=False)
    y: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        places = PLACES[self.columns["z"].shape[1]]
        self.x, self.y = np.array(list(places.values())).T * [[BASE], [TRACK]]
        self.count = len(places)

    def mean(self, channel: str) -> np.ndarray:
        """Mean of a channel of each wheel."""
        return self.columns[channel][WINDOW].mean(axis=0)

    def momentum(self) -> np.ndarray:
        """Mean rates over the window: heave [N], roll and pitch [N m], of body and wheels."""
        ends = np.array([WINDOW.start, WINDOW.stop])
        rates = (self.motion[ends] - self.motion[ends - 1]) / STEP
        lifts = WHEEL * self.columns["velocity_z"][ends - 1]
        wheels = np.column_stack([lifts.sum(axis=1), lifts @ self.y, -lifts @ self.x])
        whole = rates * [SPRUNG * self.count, ROLL, PITCH] + wheels
        return (whole[1] - whole[0]) / (STEP * (WINDOW.stop - WINDOW.start))


def run(furrow: str, folder: Path, **variables: object) -> Vehicle:
    script_output(furrow, HERE / "vehicle.lig", folder, seconds=300, **variables)
    wheels = [columns(path) for path in sorted((folder / "results").rglob("history.h5"))]
    motion = np.loadtxt(folder / "body.txt")[:, 1:]
    motion[:, 1:] = np.radians(motion[:, 1:])
    return Vehicle({name: np.column_stack([wheel[name] for wheel in wheels]) for name in wheels[0]}, motion)


def check(what: str, found: float, expected: float, allowed: float) -> None:
    print(f"{what}: {found:.4f}, expected {expected:.4f}, allowed difference {allowed:.2g}")
    assert abs(found - expected) <= allowed, what


def check_balance(vehicle: Vehicle, pull: tuple[float, float, float], guide: float = 0.0) -> None:
    """Checks the balance of wheel loads with the other forces. @param pull  weight of a kilogram along x, y, z [N/kg]"""
    weight, sprung = np.array(pull) * vehicle.count * (WHEEL + SPRUNG), vehicle.count * SPRUNG
    change, load = vehicle.momentum(), vehicle.mean("force_z")
    guides = [-weight[axis] - vehicle.mean(f"force_{name}").sum() for axis, name in enumerate("xy")]
    along = HEIGHT * sprung * pull[0] + guide * guides[0] - vehicle.mean("drive_torque").sum()
    across = HEIGHT * sprung * pull[1] + guide * guides[1] - vehicle.mean("moment_x").sum()
    check("sum of the loads [N]", load.sum(), -weight[2] + change[0], BALANCE * abs(weight[2]))
    check("moment along [N m]", load @ vehicle.x, along - change[2], BALANCE * abs(weight[2]) * BASE)
    check("moment across [N m]", load @ vehicle.y, across + change[1], BALANCE * abs(weight[2]) * TRACK)


def level(furrow: str, folder: Path) -> None:
    vehicle = run(furrow, folder)
    check_balance(vehicle, (0.0, 0.0, -GRAVITY))
    for channel in ("z", "force_x", "force_z", "suspension_force", "spin_angle"):
        column = vehicle.columns[channel]
        difference = np.abs(column - column[:, [3, 2, 1, 0]]).max()
        check(f"{channel}, left less right", difference, 0.0, ROUNDING * np.abs(column).max())
    again = run(furrow, folder, begin=f"read_restart checkpoint.{CHECKPOINT}")
    for channel, column in vehicle.columns.items():
        assert np.array_equal(column, again.columns[channel]), f"{channel} after the restart"
    rows = len(vehicle.motion) - 1 - CHECKPOINT
    assert np.array_equal(vehicle.motion[-rows:], again.motion[-rows:]), "motion after the restart"


def slopes(furrow: str, folder: Path) -> None:
    """Guides at the height of the track stand for the ground that guides a vehicle."""
    rise, side = math.radians(5), math.radians(8)
    vehicle = run(furrow, folder, rise=5, side=8, guide=-0.2)
    down = -GRAVITY * math.cos(rise)
    check_balance(vehicle, (-GRAVITY * math.sin(rise), down * math.sin(side), down * math.cos(side)), -0.2)
    # at rest the springs alone share the load: of what no equilibrium determines
    warp = np.sign(vehicle.x * vehicle.y)
    rise = vehicle.mean("z") - vehicle.columns["z"][0]
    check("load by warp [N]", warp @ vehicle.mean("force_z"), STIFFNESS * warp @ rise, 0.5)


def driven(furrow: str, folder: Path) -> None:
    rise = math.radians(6)
    vehicle = run(furrow, folder, wheels=3, rise=6, motion="mode torque torque 14")
    check_balance(vehicle, (-GRAVITY * math.sin(rise), 0.0, -GRAVITY * math.cos(rise)))
    check("torque [N m]", vehicle.mean("drive_torque").sum(), 3 * 14, 1e-9)


if __name__ == "__main__":
    case, furrow = sys.argv[1:]
    with tempfile.TemporaryDirectory() as scratch:
        {"level": level, "slopes": slopes, "driven": driven}[case](furrow, Path(scratch))
