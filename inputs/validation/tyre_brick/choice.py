# SPDX-License-Identifier: GPL-2.0-or-later
"""Which tyre for which error: tyre/darnell and tyre/brick against the same measurements, as tables
that `inputs/run SCENE --error` chooses from."""

from collections.abc import Mapping, Sequence
from typing import Any

import cases

from furrow_post.csv_table import read_rows

DARNELL = cases.HERE.parent / "tyre_table6"
ERRORS = ("deflection_error", "area_error", "section_width_error")
SPRING = "10"  # [N m/rad/m] of p235_75r15.yaml at the tread; Table 6 was met with it

TABLE6_COMMENTS = (
    "# measured: [Shoop2001] Table 6 at four pressures",
    "# Largest error over the pressures, at rest under 6227 N; cpu_time: s of one core for the four",
    "# states and the loads on the way to them, half model.",
)
STRESS_COMMENTS = (
    "# measured: the largest contact stress on the next mesh",
    "# At rest, 207 kPa, 6627 N, half model. mesh_error: change of the peak to the next finer mesh of the",
    "# table, of the finest to the next coarser. [Shoop2001] Fig 52 has no measured peak: its 765 kPa is",
    "# the end of a colour scale.",
)

Row = dict[str, Any]


def worst(rows: Sequence[Mapping[str, Any]]) -> Row:
    """Largest errors over the states of Table 6, without sign."""
    return {name: round(max(abs(float(row[name])) for row in rows), 4) for name in ERRORS}


def seconds_of_darnell() -> dict[str, float]:
    """[core s] by name of the run."""
    return {row["run"]: float(row["user_s"]) for row in read_rows(DARNELL / "costs.csv")}


def darnell(mesh: str, run: str, errors: Row, state: str = "") -> Row:
    return {
        "run": f"mesh {mesh}",
        "wheel": "tyre/darnell",
        **errors,
        "cpu_time": seconds_of_darnell()[run],
        "options": f"tyre_on_plane -v mesh '{mesh.replace('x', ' ')}'{state}",
    }


def brick(tread: str, sections: int, seconds: float, errors: Row, state: str = "") -> Row:
    tyre = f"-v tyre p235_75r15_{tread} -v sections {sections}"
    return {
        "run": f"{tread}, {sections} sections",
        "wheel": "tyre/brick",
        **errors,
        "cpu_time": seconds,
        "options": f"brick_tyre_on_plane {tyre}{state}",
    }


def table6(mine: Mapping[int, tuple[Sequence[Row], float]]) -> list[Row]:
    """mine: by sections the equivalent tyre's errors and its core seconds."""
    half = [row for row in read_rows(DARNELL / "meshes.csv") if row["half"] == "1"]
    meshes = dict.fromkeys(row["mesh"] for row in half)
    return [
        *(
            darnell(mesh, f"meshes/{mesh}_half", worst([r for r in half if r["mesh"] == mesh]))
            for mesh in meshes
        ),
        *(
            brick("equivalent", sections, seconds, worst(rows))
            for sections, (rows, seconds) in mine.items()
        ),
    ]


def stress(mine: Sequence[Row]) -> list[Row]:
    """mine: rows of contact_stress.csv. Treads on one mesh are left out: how much their stress
    depends on it is not known."""
    state = f" -v pressure {cases.STRESS_PRESSURE}e3 -v load {cases.STRESS_LOAD}"
    theirs = [
        row for row in read_rows(DARNELL / "contact_stress.csv") if row["tread_stiffness"] == SPRING
    ]
    found: list[Row] = []
    for row, errors in zip(theirs, mesh_errors(theirs)):
        found.append(darnell(row["mesh"], f"contact_stress/{row['mesh']}_{SPRING}", errors, state))
    for tread in dict.fromkeys(row["tread"] for row in mine):
        rows = [row for row in mine if row["tread"] == tread]
        if len(rows) < 2:
            continue
        for row, errors in zip(rows, mesh_errors(rows)):
            seconds = float(row["user_s"])
            found.append(brick(tread, int(row["sections"]), seconds, errors, state))
    return found


def mesh_errors(rows: Sequence[Mapping[str, Any]]) -> list[Row]:
    """Of one tyre, the finest mesh last; of two meshes at least."""
    peaks = [float(row["largest_kPa"]) for row in rows]
    others = [*peaks[1:], peaks[-2]]
    return [
        {"mesh_error": round(abs(other / peak - 1), 4)} for peak, other in zip(peaks, others)
    ]
