# SPDX-License-Identifier: GPL-2.0-or-later
"""Wheels of Furrow in separate processes, whose axles another program moves."""

import multiprocessing
from collections.abc import Sequence
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
SCRIPT = Path(__file__).resolve().parent / "wheel.lig"
COORDINATES = ("x", "y", "z", "yaw")


class Wheel:
    """One wheel in this process. A pose is x, y, z [m] and yaw [rad]."""

    def __init__(self, variables: dict[str, object]) -> None:
        import furrow

        given: dict[str, object] = {**variables, "here": SCRIPT.parent}
        self.run = furrow.Simulation(SCRIPT, variables=given)
        self.hub = self.run.wheels["wheel"]
        self.run.step(1)
        self.step = float(self.run.time)
        self.hub.release("spin")
        self.pose: Sequence[float] = [self.hub.position[i] for i in (0, 1, 2, 4)]

    def move(self, pose: Sequence[float], torque: float, seconds: float) -> Array:
        """Moves the axle to a pose at constant rates, while a torque [N m] spins the wheel.
        @return six forces of the ground at the end [N, N m], and the spin rate [rad/s]"""
        steps = round(seconds / self.step)
        for name, start, end in zip(COORDINATES, self.pose, pose):
            self.hub.prescribe(name, (end - start) / (steps * self.step))
        self.pose = pose
        self.hub.set_axle_torque(torque)
        self.run.step(steps)
        return np.array([*self.hub.force, self.hub.velocity[3]])

    def lost_energy(self) -> float:
        """Energy that a height field has taken [J]."""
        contact: dict[str, float] = self.run.outputs("touch")
        return contact["stored_energy"] + contact["compaction_loss"] + contact["shear_loss"]

    def close(self) -> None:
        self.run.close()


def serve(connection: Connection, variables: dict[str, object]) -> None:
    """The process of a wheel: answers calls until the other side closes."""
    try:
        wheel = Wheel(variables)
        connection.send(None)
        while call := connection.recv():
            name, *arguments = call
            connection.send(getattr(wheel, name)(*arguments))
    except EOFError:
        return
    except Exception as problem:  # for example furrow.Error
        connection.send(problem)


class Wheels:
    """Several wheels, which compute at the same time."""

    def __init__(self, variables: Sequence[dict[str, object]]) -> None:
        context = multiprocessing.get_context("spawn")
        self.lines, self.processes = [], []
        for each in variables:
            here, there = context.Pipe()
            process = context.Process(target=serve, args=(there, each), daemon=True)
            process.start()
            there.close()
            self.lines.append(here)
            self.processes.append(process)
        self.answers()

    def answers(self) -> list[Any]:
        """Answers of all wheels, in their order."""
        try:
            received = [line.recv() for line in self.lines]
        except EOFError:
            raise RuntimeError("the process of a wheel has ended") from None
        for answer in received:
            if isinstance(answer, Exception):
                raise answer
        return received

    def move(self, poses: Array, torques: Array, seconds: float) -> Array:
        """@return six forces and the spin rate of each wheel"""
        for line, pose, torque in zip(self.lines, poses.tolist(), torques.tolist()):
            line.send(("move", pose, torque, seconds))
        return np.array(self.answers())

    def lost_energy(self) -> float:
        for line in self.lines:
            line.send(("lost_energy",))
        return float(sum(self.answers()))

    def close(self) -> None:
        for line in self.lines:
            line.close()
        for process in self.processes:
            process.join()
