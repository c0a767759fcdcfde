# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors against Table 6, contact stress, treads, the shape below the axle, rolling; and which tyre
for which error, as tables that `inputs/run SCENE --error` chooses from."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import atan2, degrees
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt

from furrow_post.analyse.evaluations import cost_ratio, tyre_states
from furrow_post.analyse.statistics import block_mean
from furrow_post.csv_table import read_numbers, read_rows
from furrow_post.figures.style import save
from furrow_post.read.results import Results
from furrow_post.read.vtk import read_vtp
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

HERE = Path(__file__).resolve().parent
MEASURED = HERE.parent / "tyre_table6" / "reference.csv"
LOAD = 6227  # [N] Table 6
PRESSURES = (103, 138, 179, 241)  # [kPa] of Table 6
COARSE, SECTIONS = 60, 120  # round the tyre; the report's mesh has the second
STRESS = (207, 6627)  # [kPa], [N] of Fig 52
BETWEEN_AT = 241  # [kPa]
WALL = 1.2  # [cm] rubber outside of the carcass, both sides; assumed
GOAL = 0.10
SAME = 5e-3  # relative difference of a state that is made again
CHECKED = ("deflection_cm", "area_cm2", "section_width_cm")
MIDDLE = 1e-3  # [m] from the middle of the print: its nodes there
# [m] y from the middle of one groove of the ribbed tyre to that of the next
RIBS = {"centre": (0.0, 0.0198), "middle": (0.0198, 0.0516), "shoulder": (0.0516, 0.1)}
STEADY = 1.2  # [m] of rolling at the end of which the mean is taken
TIMED = [  # pairs of runs that differ in the ribs alone
    ("contact_stress/ribbed_60", "contact_stress/smooth_60"),
    ("contact_stress/ribbed_120", "contact_stress/smooth_120"),
    ("treads/ribbed_103", "treads/smooth_103"),
    ("treads/ribbed_241", "treads/smooth_241"),
]
# ---- the choice
DARNELL = HERE.parent / "tyre_table6"
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
# ---- the shape below the axle
BELOW = 1e-3  # [m] from the section below the axle: its nodes
BESIDE = 0.08  # [m] from the mid-plane: next to the tread
WALL_HEIGHT = (4e-3, 6.5e-3)  # [m] of a groove's wall
WALL_LEAN = 2.5e-3  # [m] by which an unloaded wall is out of the vertical at most

Point = tuple[float, float]  # [m] y, z
Row = dict[str, Any]


def errors(rows: Sequence[dict[str, float]], load: float = LOAD) -> list[Row]:
    """The states of Table 6, and their relative errors."""
    found: list[Row] = []
    for measured in read_rows(MEASURED):
        pressure = float(measured["pressure_kPa"])
        for row in rows:
            if row["load_N"] != load or abs(row["pressure_kPa"] - pressure) > 0.5:
                continue
            mine: Row = {
                "pressure_kPa": round(pressure),
                "used_for": measured["used_for"],
                "touching_area_cm2": row["nodal_area_cm2"],
            }
            for what, value in (
                ("deflection_cm", row["deflection_cm"]),
                ("area_cm2", row["perimeter_area_cm2"]),
                ("section_width_cm", row["section_width_cm"] + WALL),
            ):
                mine[what] = round(value, 3)
                name = what.removesuffix("_cm2").removesuffix("_cm")
                mine[f"{name}_error"] = round(value / float(measured[what]) - 1, 4)
            found.append(mine)
    return found


def inflated(rows: Sequence[dict[str, float]]) -> list[Row]:
    """Size without load, rubber included."""
    return [
        {
            "pressure_kPa": round(row["pressure_kPa"]),
            "diameter_cm": round(2 * row["crown_radius_cm"], 2),
            "width_cm": round(row["section_width_cm"] + WALL, 2),
        }
        for row in rows
        if row["load_N"] == 0
    ]


def between_table(runs: Runs) -> list[Row]:
    """From the smooth tyre to its equivalent, one change after the other."""
    found: list[Row] = []
    for run in (*runs.ended("between"), *runs.ended("table6")):
        rows = tyre_states(run.folder)
        for row in errors(rows):
            if row["pressure_kPa"] == BETWEEN_AT:
                size = inflated(rows)[-1]
                kept = ("deflection_cm", "deflection_error", "area_cm2", "area_error")
                found.append({"tyre": run.what, **size, **{key: row[key] for key in kept}})
    return found


def stored(name: str) -> list[Row]:
    """A table of Table 6's columns next to this file."""
    return [
        {key: text if key == "used_for" else float(text) for key, text in row.items()}
        for row in read_rows(HERE / name)
    ]


def changed(again: Sequence[Row], before: Sequence[Row]) -> Iterator[str]:
    """What differs of states made again from those that are stored."""
    for row, old in zip(again, before, strict=True):
        for what in CHECKED:
            change = row[what] / old[what] - 1
            if abs(change) > SAME:
                yield (
                    f"{row['pressure_kPa']:.0f} kPa, {COARSE} sections: {what} {row[what]} "
                    f"was {old[what]}, {100 * change:+.2f} %; the tables are of another program"
                )


def missed_goals(table: Sequence[Row]) -> Iterator[str]:
    """What lies beyond the goals, and pressures without a result."""
    for pressure in sorted(set(PRESSURES) - {int(row["pressure_kPa"]) for row in table}):
        yield f"{pressure} kPa: no result"
    for row in table:
        for what in ("deflection", "area", "section_width"):
            error = row[f"{what}_error"]
            if abs(error) > GOAL:
                yield f"{row['pressure_kPa']:.0f} kPa: {what} {100 * error:+.1f} %, goal 10 %"


def print_of(folder: Path, pressure: float, load: float) -> list[dict[str, float]]:
    """Position [m], pressure [Pa] and area [m2] of the tread's nodes that touch."""
    return read_numbers(folder / f"{pressure:.0f}kPa_{load:.0f}N_pressure.csv")


def stress_table(runs: Runs) -> list[Row]:
    """Across the middle of the print: the centreline, the largest to its side, the least between
    the two."""
    found: list[Row] = []
    for run in runs.done("contact_stress"):
        tread, sections = run.name.rpartition("/")[2].split("_")
        rows = tyre_states(run.folder)
        if len(rows) < 3:
            continue
        nodes = print_of(run.folder, *STRESS)
        middle = sorted((n["y_m"], n["pressure_Pa"]) for n in nodes if abs(n["x_m"]) < MIDDLE)
        side = max(range(1, len(middle)), key=lambda i: middle[i][1])
        least = min(range(side + 1), key=lambda i: middle[i][1])
        found.append(
            {
                "tread": tread,
                "sections": int(sections),
                "deflection_cm": rows[-1]["deflection_cm"],
                "largest_kPa": round(rows[-1]["largest_pressure_kPa"], 1),
                "least_kPa": round(1e-3 * min(n["pressure_Pa"] for n in nodes), 1),
                "centreline_kPa": round(1e-3 * middle[0][1], 1),
                "shoulder_kPa": round(1e-3 * middle[side][1], 1),
                "shoulder_cm": round(100 * middle[side][0], 2),
                "between_kPa": round(1e-3 * middle[least][1], 1),
                "between_cm": round(100 * middle[least][0], 2),
                "user_s": run.seconds,
            }
        )
    return found


def draw_stress(maps: dict[str, list[dict[str, float]]], path: Path) -> None:
    """Like the report's Figure 52."""
    figure, panels = plt.subplots(
        1, len(maps), figsize=(5.2 * len(maps), 4.6), squeeze=False, constrained_layout=True
    )
    for axes, (tread, nodes) in zip(panels[0], maps.items()):
        x = [100 * n["x_m"] for n in nodes] * 2
        y = [100 * side * n["y_m"] for side in (1, -1) for n in nodes]
        stress = [1e-3 * n["pressure_Pa"] for n in nodes] * 2
        shown = axes.scatter(y, x, c=stress, s=45, marker="s", vmin=0.0)
        axes.set(xlabel="across [cm]", ylabel="along the travel [cm]", aspect="equal")
        axes.set(xlim=(-10, 10), ylim=(-12, 12))
        axes.set_title(f"{tread}: {min(stress):.0f} to {max(stress):.0f} kPa")
        figure.colorbar(shown, ax=axes, label="contact pressure [kPa]", shrink=0.8)
    save(figure, path, dpi=90)


def tread_table(runs: Runs) -> list[Row]:
    """Smooth, ribbed and lugged: area without voids, and which share of the load is carried where
    the ribs are."""
    found: list[Row] = []
    for run in runs.ended("treads"):
        tread, pressure = run.name.rpartition("/")[2].split("_")
        for state in tyre_states(run.folder):
            if state["load_N"] == 0:
                continue
            row: Row = {
                "tread": tread,
                "pressure_kPa": int(pressure),
                "load_N": round(state["load_N"]),
                "deflection_cm": state["deflection_cm"],
                "area_cm2": state["nodal_area_cm2"],
                "outline_area_cm2": state["perimeter_area_cm2"],
                "largest_kPa": state["largest_pressure_kPa"],
            }
            nodes = print_of(run.folder, float(pressure), state["load_N"])
            total = sum(n["pressure_Pa"] * n["area_m2"] for n in nodes)
            for rib, (inner, outer) in RIBS.items():
                on_rib = [n for n in nodes if inner <= n["y_m"] < outer]
                carried = sum(n["pressure_Pa"] * n["area_m2"] for n in on_rib)
                row[f"{rib}_share"] = round(carried / total, 3)
            found.append(row)
    return found


def rolling_row(run: Run) -> Row:
    """Resistance of rolling over the last part of the travel, with the error of eight blocks."""
    wheel = Results(run.folder).columns
    steady = wheel["x"] > wheel["x"][-1] - STEADY
    mean, error = block_mean(-wheel["force_x"][steady])
    return {
        "damping": round(run.number("damping")),
        "travel_m": round(float(wheel["x"][-1] - wheel["x"][0]), 2),
        "resistance_N": round(mean, 2),
        "resistance_error_N": round(error, 2),
        "deflection_mm": round(1e3 * float(wheel["hub_drop"][steady].mean()), 2),
        "user_s": run.seconds,
    }


# ---- the shape in the section below the axle: the sidewall (Fig 55), leaning walls of ribs (Fig 54)


def below(file: Path) -> list[Point]:
    """Nodes of the outside below the axle, in the file's order: of every state of a tyre the same,
    and along the sidewall from the tread to the bead."""
    x = read_vtp(file).x
    middle = 0.5 * (x[:, 2].min() + x[:, 2].max())
    return [(float(y), float(z)) for at, y, z in x if abs(at) < BELOW and z < middle]


def sidewall(points: Sequence[Point]) -> list[Point]:
    """The profile from the tread to the bead, heights above the lowest point."""
    floor = min(z for _, z in points)
    return [(y, z - floor) for y, z in points if y > BESIDE]


def profile_table(folder: Path) -> list[Row]:
    """Where the sidewall is widest, without load and under it; the carcass is inside of it."""
    found: list[Row] = []
    for pressure in PRESSURES:
        row: Row = {"pressure_kPa": pressure}
        for name, load in (("inflated", 0), ("loaded", LOAD)):
            profile = sidewall(below(folder / f"{pressure}kPa_{load}N.vtp"))
            widest = max(profile)
            row[f"{name}_half_width_cm"] = round(100 * widest[0], 2)
            row[f"{name}_height_of_it_cm"] = round(100 * widest[1], 2)
            row[f"{name}_bead_height_cm"] = round(100 * profile[-1][1], 2)
        found.append(row)
    return found


@dataclass(frozen=True)
class Wall:
    """Of a groove: nodes of a section, by their places in it."""

    foot: int
    top: int

    def lean(self, points: Sequence[Point]) -> float:
        """[degrees] of the top, outwards from the mid-plane."""
        (y0, z0), (y1, z1) = points[self.foot], points[self.top]
        return degrees(atan2(y1 - y0, z0 - z1))


def walls(points: Sequence[Point]) -> list[Wall]:
    """Of the unloaded section."""
    found = []
    for a, b in combinations(range(len(points)), 2):
        (y0, z0), (y1, z1) = points[a], points[b]
        if WALL_HEIGHT[0] < abs(z1 - z0) < WALL_HEIGHT[1] and abs(y1 - y0) < WALL_LEAN:
            found.append(Wall(a, b) if z0 > z1 else Wall(b, a))
    return sorted(found, key=lambda wall: points[wall.top][0])


def rib_table(runs: Runs) -> list[Row]:
    """By how much the load leans the walls of ribs, below the axle."""
    found: list[Row] = []
    places: list[str] = []  # of the walls, at the first pressure
    for run in runs.ended("treads/ribbed*"):
        folder, pressure = run.folder, run.name.rpartition("_")[2]
        unloaded = below(folder / f"{pressure}kPa_0N.vtp")
        places = places or [f"{100 * unloaded[wall.top][0]:.1f}" for wall in walls(unloaded)]
        loads = (round(state["load_N"]) for state in tyre_states(folder) if state["load_N"] > 0)
        for load in loads:
            file = folder / f"{pressure}kPa_{load}N.vtp"
            if not file.is_file():
                continue
            loaded = below(file)
            row: Row = {"run": run.name, "pressure_kPa": int(pressure), "load_N": load}
            for place, wall in zip(places, walls(unloaded), strict=True):
                lean = wall.lean(loaded) - wall.lean(unloaded)
                row[f"lean_at_{place}_cm_deg"] = round(lean, 1)
            found.append(row)
    return found


# ---- which tyre for which error


def worst(rows: Sequence[Mapping[str, Any]]) -> Row:
    """Largest errors over the states of Table 6, without sign."""
    return {name: round(max(abs(float(row[name])) for row in rows), 4) for name in ERRORS}


def seconds_of_darnell() -> dict[str, float]:
    """[core s] by name of the run."""
    return {row["run"]: float(row["user_s"]) for row in read_rows(DARNELL / "costs.csv")}


def darnell_row(mesh: str, run: str, errors: Row, state: str = "") -> Row:
    return {
        "run": f"mesh {mesh}",
        "wheel": "tyre/darnell",
        **errors,
        "cpu_time": seconds_of_darnell()[run],
        "options": f"tyre_on_plane -v mesh '{mesh.replace('x', ' ')}'{state}",
    }


def brick_row(tread: str, sections: int, seconds: float, errors: Row, state: str = "") -> Row:
    tyre = f"-v tyre ../tyres/p235_75r15_{tread}.yaml -v sections {sections}"
    return {
        "run": f"{tread}, {sections} sections",
        "wheel": "tyre/brick",
        **errors,
        "cpu_time": seconds,
        "options": f"brick_tyre_on_plane {tyre}{state}",
    }


def choice_of_table6(mine: Mapping[int, tuple[Sequence[Row], float]]) -> list[Row]:
    """mine: by sections the equivalent tyre's errors and its core seconds."""
    half = [row for row in read_rows(DARNELL / "meshes.csv") if row["half"] == "1"]
    meshes = dict.fromkeys(row["mesh"] for row in half)
    return [
        *(
            darnell_row(mesh, f"meshes/{mesh}_half", worst([r for r in half if r["mesh"] == mesh]))
            for mesh in meshes
        ),
        *(
            brick_row("equivalent", sections, seconds, worst(rows))
            for sections, (rows, seconds) in mine.items()
        ),
    ]


def choice_of_stress(mine: Sequence[Row]) -> list[Row]:
    """mine: rows of contact_stress.csv. Treads on one mesh are left out: how much their stress
    depends on it is not known."""
    state = f" -v pressure {STRESS[0]}e3 -v load {STRESS[1]}"
    theirs = [
        row for row in read_rows(DARNELL / "contact_stress.csv") if row["tread_stiffness"] == SPRING
    ]
    found: list[Row] = []
    for row, errors in zip(theirs, mesh_errors(theirs)):
        found.append(darnell_row(row["mesh"], f"contact_stress/{row['mesh']}_{SPRING}", errors, state))
    for tread in dict.fromkeys(row["tread"] for row in mine):
        rows = [row for row in mine if row["tread"] == tread]
        if len(rows) < 2:
            continue
        for row, errors in zip(rows, mesh_errors(rows)):
            seconds = float(row["user_s"])
            found.append(brick_row(tread, int(row["sections"]), seconds, errors, state))
    return found


def mesh_errors(rows: Sequence[Mapping[str, Any]]) -> list[Row]:
    """Of one tyre, the finest mesh last; of two meshes at least."""
    peaks = [float(row["largest_kPa"]) for row in rows]
    others = [*peaks[1:], peaks[-2]]
    return [
        {"mesh_error": round(abs(other / peak - 1), 4)} for peak, other in zip(peaks, others)
    ]


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    def states(name: str) -> list[dict[str, float]]:
        return [state for run in runs.ended(name) for state in tyre_states(run.folder)]

    of_table6, coarse, check = states("table6"), states("meshes/60"), errors(states("check"))
    table, mesh, stress = errors(of_table6), errors(coarse), stress_table(runs)
    seconds = [{"run": run.name, "user_s": run.seconds} for run in runs.ended("*")]
    timed = {str(row["run"]): float(row["user_s"]) for row in output.known("costs.csv", seconds)}
    profiles = [row for run in runs.done("table6") for row in profile_table(run.folder)]
    for name, rows in (
        ("table6.csv", table),
        ("meshes.csv", mesh),
        ("between.csv", between_table(runs)),
        ("check.csv", check),
        ("inflated.csv", inflated(of_table6)),
        ("load_deflection.csv", coarse),
        ("contact_stress.csv", stress),
        ("treads.csv", tread_table(runs)),
        ("ribs.csv", rib_table(runs)),
        ("profiles.csv", profiles),
        ("rolling.csv", [rolling_row(run) for run in runs.done("rolling")]),
        ("costs.csv", seconds),
        ("timing.csv", cost_ratio("ribbed over smooth", timed, TIMED)),
    ):
        output.table(name, rows)
    costs = {run.name: run.seconds for run in runs.ended("table6", "meshes")}
    if table and mesh and stress:
        mine = {COARSE: (mesh, costs["meshes/60"]), SECTIONS: (table, costs["table6"])}
        output.table("errors_tyre_on_plane.csv", choice_of_table6(mine), TABLE6_COMMENTS)
        output.table("errors_brick_tyre_on_plane.csv", choice_of_stress(stress), STRESS_COMMENTS)
    finest = {run.name.split("/")[1].split("_")[0]: run for run in runs.done("contact_stress")}
    if finest:
        prints = {tread: print_of(run.folder, *STRESS) for tread, run in finest.items()}
        draw_stress(prints, output.path("contact_stress.png"))
    missed = list(missed_goals(table or stored("table6.csv")))
    return [*missed, *changed(check, stored("check.csv"))] if check else missed
