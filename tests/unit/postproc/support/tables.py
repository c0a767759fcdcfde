# SPDX-License-Identifier: GPL-2.0-or-later
"""A table of runs whose values lie on exact lines."""

from furrow_post.uncertainty.cost_table import FamilyKey, Row

CONTINUUM = FamilyKey("continuum", "half", "rigid wheel")
GRAINS = FamilyKey("grains", "whole", "rigid wheel")


def row(
    name: str,
    ground: str,
    size: float,
    sinkage: float,
    coefficient: float,
    cpu: float,
    domain: str = "2x1",
    seed: str = "1",
    error: float = 0.0,
) -> Row:
    family = CONTINUUM if ground == "continuum" else GRAINS
    values = (sinkage, error, coefficient, error)
    return Row(name, ground, family.model, family.wheel, size, domain, seed, *values, cpu)


def made_runs() -> list[Row]:
    """Continuum: f0 + C h with f0 = 0.1 m and 0.2; grains: another line.

    Two packings of grains of 40 mm, and a wider domain too
    """
    rows = [
        row(f"c{h}", "continuum", h, 0.1 * (1 + 2 * h), 0.2 * (1 - 5 * h), 1e-4 / h**4, seed="", error=1e-9)
        for h in (0.04, 0.02, 0.01)
    ]
    for h in (0.04, 0.02, 0.01):
        sinkage, cpu = 0.12 * (1 + 3 * h), 5e-4 / h**4
        rows.append(row(f"g{h}", "grains", h, sinkage, 0.25, cpu, error=1e-9))
    base = 0.12 * 1.12
    rows.append(row("seed", "grains", 0.04, base + 0.002, 0.25, 1.0, seed="2"))
    rows.append(row("wide", "grains", 0.04, base - 0.005, 0.26, 1.0, domain="2x2"))
    return rows
