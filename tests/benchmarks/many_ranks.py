#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Where ranks stop paying: a sub-step of a test track on many ranks, in slabs and in blocks.

many_ranks.md next to this file states what is measured, assumed and computed.

    tests/benchmarks/many_ranks.py [cell in m]
"""

import math
import sys
from dataclasses import dataclass

# Measured with ground_ranks (many_ranks.md).
UPDATE = 48.1e-9  # s, processor time of a particle update, one rank
SHARED = 41e-9  # s, the same of a shared node in an exchange: two ranks less one
EXCHANGES = 1.0625  # of sums at shared nodes, in a sub-step
CALLS = 4.19  # collective calls in a sub-step
COLLECTED = 32.2e3  # byte in them, nearly all for the wheel's nodes
# From the profile in README.md, of a wheel on 16,000 particles in cells of 4 cm.
CONTACT = 0.11 * 16e3 * UPDATE * 0.04**2  # s m^2, to be divided by the square of the cell
PATCH = (0.5, 0.27)  # m, length and width of the contact

# Assumed; sources in many_ranks.md.
LATENCY = 1e-6  # s, of a message
PORT = 10e9  # byte/s, of the network port of a machine
MACHINE = 64  # ranks on it
MEMORY = 460e9  # byte/s, of a machine
PASSES = 4  # over memory, of a byte in MPI: into a buffer of both ranks, and out of it

TRACK = (10.0, 4.0)  # m
DEPTH, CLEARANCE = 0.2, 0.08  # m
PER_CELL = 8  # particles
NODE = 32  # byte of a node's sum


@dataclass
class Axis:
    """The largest block along an axis."""

    cells: int
    blocks: int

    @property
    def own(self) -> int:
        return -(-self.cells // self.blocks)

    @property
    def local(self) -> int:
        """Nodes that its particles may reach."""
        return self.own + min(self.blocks - 1, 2) + 2

    @property
    def neighbours(self) -> list[int]:
        """How many layers of nodes it shares with each: those k blocks away on either side."""
        shared = []
        for k in range(1, self.blocks):
            layers = self.own + 4 - k * self.own
            if layers <= 0:
                break
            shared += [layers] * min(2, self.blocks - k)
        return shared


@dataclass
class Track:
    """The ground, and a sub-step of it on so many blocks along x and y."""

    cell: float

    def __post_init__(self) -> None:
        self.x_cells, self.y_cells = (round(length / self.cell) for length in TRACK)
        self.deep = round(DEPTH / self.cell)
        self.levels = round((DEPTH + CLEARANCE) / self.cell) + 2

    @property
    def particles(self) -> int:
        return PER_CELL * self.x_cells * self.y_cells * self.deep

    def halo(self, x: Axis, y: Axis) -> tuple[int, int]:
        """Messages and bytes of the rank that sends most, in an exchange."""
        layers = sum(x.neighbours) * y.local + sum(y.neighbours) * x.local
        return len(x.neighbours) + len(y.neighbours), NODE * self.levels * layers

    def leaving(self, x: Axis, y: Axis) -> float:
        """Bytes that leave a machine in an exchange; ranks are numbered along y, then x."""
        ranks = x.blocks * y.blocks
        if ranks <= MACHINE:
            return 0.0
        columns = max(1.0, MACHINE / y.blocks)  # of blocks along y, on a machine
        across = 4 * NODE * self.levels * self.y_cells * 2
        along = 4 * NODE * self.levels * x.local * 2 if y.blocks > MACHINE else 0
        if columns * x.own < 4:  # slabs that reach beyond the next machine
            across *= math.ceil(4 / (columns * x.own))
        return across + along

    def step(self, x: Axis, y: Axis) -> dict[str, float]:
        """Times of a sub-step [s]."""
        ranks = x.blocks * y.blocks
        update = UPDATE * PER_CELL * self.deep * x.own * y.own
        under = [min(1.0, axis.own * self.cell / length) for axis, length in zip((x, y), PATCH)]
        messages, sent = self.halo(x, y)
        phases = (x.blocks > 1) + (y.blocks > 1)
        on_machine = PASSES * sent / (MEMORY / min(ranks, MACHINE))
        rounds = math.ceil(math.log2(ranks)) if ranks > 1 else 0
        return {
            "particles": update,
            "contact": CONTACT / self.cell**2 * under[0] * under[1],
            "halo": EXCHANGES
            * (SHARED * sent / NODE + phases * LATENCY + on_machine + self.leaving(x, y) / PORT),
            "collective": rounds * (CALLS * LATENCY + COLLECTED / PORT),
        }

    def layout(self, ranks: int) -> tuple[Axis, Axis]:
        """As choose_layout() of src/mpm/grid/block_layout.cpp."""
        layouts = [
            (Axis(self.x_cells, x), Axis(self.y_cells, ranks // x)) for x in range(ranks, 0, -1) if ranks % x == 0
        ]
        return min(layouts, key=lambda axes: axes[0].local * axes[1].local)

    def slabs(self, ranks: int) -> tuple[Axis, Axis]:
        return Axis(self.x_cells, ranks), Axis(self.y_cells, 1)

    def efficiency(self, ranks: int, axes: tuple[Axis, Axis]) -> float:
        alone = sum(self.step(Axis(self.x_cells, 1), Axis(self.y_cells, 1)).values())
        return alone / ranks / sum(self.step(*axes).values())


def half_at(track: Track, blocks: bool) -> int:
    """The most ranks, a power of two, whose efficiency is one half or more."""
    ranks = 1
    while ranks < 2**20:
        axes = track.layout(2 * ranks) if blocks else track.slabs(2 * ranks)
        if track.efficiency(2 * ranks, axes) < 0.5:
            break
        ranks *= 2
    return ranks


def coarsest(ranks: int, blocks: bool) -> float:
    """The coarsest cell of whole millimetres at which so many ranks are half used [m]."""
    fits = 0
    for millimetres in range(1, 101):
        track = Track(1e-3 * millimetres)
        axes = track.layout(ranks) if blocks else track.slabs(ranks)
        if track.efficiency(ranks, axes) >= 0.5:
            fits = millimetres
    return 1e-3 * fits


def main() -> None:
    track = Track(float(sys.argv[1]) if len(sys.argv) > 1 else 0.01)
    print(
        f"{track.x_cells} x {track.y_cells} x {track.deep} cells, {1e-6 * track.particles:.1f} "
        f"million particles, {track.levels} levels of nodes"
    )
    print("| ranks | blocks | messages | MB | particles | contact | halo | collective | sum [ms] | "
          "efficiency |")  # fmt: skip
    print("|---|---|---|---|---|---|---|---|---|---|")
    for ranks in (1, 2, 8, 64, 256, 1024, 4096):
        slabs, blocks = track.slabs(ranks), track.layout(ranks)
        for axes in (slabs, blocks) if blocks[1].blocks > 1 else (slabs,):
            step = track.step(*axes)
            messages, sent = track.halo(*axes)
            times = " | ".join(f"{1e3 * time:.3g}" for time in (*step.values(), sum(step.values())))
            print(
                f"| {ranks} | {axes[0].blocks} x {axes[1].blocks} | {messages} | "
                f"{1e-6 * sent:.3g} | {times} | {track.efficiency(ranks, axes):.2f} |"
            )
    for name, blocks in (("slabs", False), ("blocks", True)):
        cells = ", ".join(f"{ranks} ranks up to {1e3 * coarsest(ranks, blocks):.0f} mm" for ranks in (64, 1024))
        print(f"{name}: half used with up to {half_at(track, blocks)} ranks; cells of which {cells}")


if __name__ == "__main__":
    main()
