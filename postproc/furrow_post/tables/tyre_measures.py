# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of tyres on a rigid plane by furrow-tyre, and of their treads: contact stress, lift, shift, profile."""

import math
from collections.abc import Mapping, Sequence
from itertools import combinations
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from ..analyse.evaluations import AGAIN, tyre_states
from ..arrays import Floats
from ..csv_table import read_columns, read_rows
from ..errors import ResultsError, content_of
from ..read.results import Results
from ..read.terrain import read_terrain_fields
from ..read.vtk import read_vtp
from ..run.executor import Run
from .frames import Row, read_frame

Print = dict[str, Floats]  # x, y [m], pressure [Pa], area [m2] of the nodes that touch


def tyre(run: Run, least: int = 0) -> list[Row]:
    """A row for each state that furrow-tyre printed: its columns."""
    return [dict(state) for state in tyre_states(run.folder, least)]


def tyre_states_of(run: Run) -> Row:
    """states: the same rows as a list; loaded and unloaded: those with and without load."""
    states = tyre_states(run.folder)
    loaded, unloaded = ([one for one in states if (one["load_N"] > 0) is with_load] for with_load in (True, False))
    return {"states": states, "loaded": loaded, "unloaded": unloaded}


def tyre_at_measured(run: Run, measured: str, load: float | None = None) -> list[Row]:
    """A row for each loaded state at a pressure of a table: the state's columns, and measured.NAME. load: of the states
    that count [N]."""
    rows: list[Row] = []
    for one in read_frame(Path(measured)).to_dict("records"):
        for state in tyre_states(run.folder):
            close = abs(state["pressure_kPa"] - one["pressure_kPa"]) < 0.5
            if close and (state["load_N"] > 0 if load is None else state["load_N"] == load):
                rows.append({"measured": SimpleNamespace(**one), **state})
    return rows


def tyre_print(run: Run, pressure: float, load: float) -> Print:
    """Nodes of the tread that touch, under a pressure [kPa] and a load [N]."""
    columns = read_columns(run.folder / f"{pressure:.0f}kPa_{load:.0f}N_pressure.csv")
    names = {"x_m": "x", "y_m": "y", "pressure_Pa": "p", "area_m2": "area"}
    return {short: columns[name] for name, short in names.items() if name in columns}


def line_means(run: Run, pressure: float, load: float, lines: int, half_tread: float, near: float) -> Row:
    """lines: mean pressure [kPa] of the tread's lines from its middle to its edge, over the middle of the print [m]."""
    nodes = tyre_print(run, pressure, load)
    chosen = np.abs(nodes["x"]) < near
    line = np.minimum(lines, np.round(nodes["y"][chosen] / half_tread * lines).astype(int))
    kept = nodes["p"][chosen] / 1e3
    means = [sum(kept[line == n].tolist()) / np.count_nonzero(line == n) if (line == n).any() else 0.0 for n in range(lines + 1)]
    least = means.index(min(means))
    return {"lines": means, "least": least, "from_edge": half_tread * (1 - least / lines)}


def across_middle(run: Run, pressure: float, load: float, near: float) -> Row:
    """Pressures [Pa] and places [m] across the middle of the print: of its centre, of the largest beside it (side), and
    of the least between the two (between); and the least pressure of the whole print."""
    nodes = tyre_print(run, pressure, load)
    middle = sorted((float(y), float(p)) for x, y, p in zip(nodes["x"], nodes["y"], nodes["p"]) if abs(x) < near)
    side = max(range(1, len(middle)), key=lambda i: middle[i][1])
    between = min(range(side + 1), key=lambda i: middle[i][1])
    found: Row = {"centre": middle[0][1], "least_pressure": min(nodes["p"])}
    for name, place in (("side", side), ("between", between)):
        found |= {f"{name}_place": middle[place][0], name: middle[place][1]}
    return found


def rib_shares(run: Run, pressure: float, ribs: Mapping[str, Sequence[float]]) -> list[Row]:
    """A row for each loaded state: its columns, and NAME_share, the share of the load on each rib (y from, to [m])."""
    rows = []
    for state in tyre_states(run.folder):
        if state["load_N"] == 0:
            continue
        nodes = tyre_print(run, pressure, state["load_N"])
        force = nodes["p"] * nodes["area"]
        total = sum(force.tolist())
        shares = {
            f"{rib}_share": sum(force[(inner <= nodes["y"]) & (nodes["y"] < outer)].tolist()) / total
            for rib, (inner, outer) in ribs.items()
        }
        rows.append({**state, **shares})
    return rows


# ---- the section below the axle

BELOW = 1e-3  # [m] from the section below the axle: its nodes
Point = tuple[float, float]  # [m] y, z


def below_axle(file: Path) -> list[Point]:
    """Nodes of the outside below the axle, in the file's order: the same in every state, along the sidewall from the
    tread to the bead."""
    x = read_vtp(file).x
    middle = 0.5 * (x[:, 2].min() + x[:, 2].max())
    return [(float(y), float(z)) for at, y, z in x if abs(at) < BELOW and z < middle]


def sidewalls(run: Run, pressures: Sequence[float], load: float, beside: float) -> list[Row]:
    """A row for each pressure: of the sidewall below the axle, inflated and loaded, the half width and the height of
    its widest place and the height of the bead [m], above the lowest point. beside: [m] from the mid-plane, where it
    begins."""
    rows = []
    for pressure in pressures:
        row: Row = {"pressure": pressure}
        for name, force in (("inflated", 0), ("loaded", load)):
            points = below_axle(run.folder / f"{pressure}kPa_{force}N.vtp")
            floor = min(z for _, z in points)
            profile = [(y, z - floor) for y, z in points if y > beside]
            row |= {f"{name}_width": max(profile)[0], f"{name}_height": max(profile)[1], f"{name}_bead": profile[-1][1]}
        rows.append(row)
    return rows


def walls(points: Sequence[Point], height: Sequence[float], lean: float) -> list[tuple[int, int]]:
    """Feet and tops of walls of grooves in the unloaded section, as places in it. height: from, to [m]; lean: [m] by
    which a wall is out of the vertical at most."""
    found = []
    for a, b in combinations(range(len(points)), 2):
        (y0, z0), (y1, z1) = points[a], points[b]
        if height[0] < abs(z1 - z0) < height[1] and abs(y1 - y0) < lean:
            found.append((a, b) if z0 > z1 else (b, a))
    return sorted(found, key=lambda wall: points[wall[1]][0])


def wall_lean(points: Sequence[Point], wall: tuple[int, int]) -> float:
    """[degrees] of the top, outwards from the mid-plane."""
    (y0, z0), (y1, z1) = points[wall[0]], points[wall[1]]
    return math.degrees(math.atan2(y1 - y0, z0 - z1))


def rib_lean(run: Run, pressure: float, height: Sequence[float], lean: float, places: Sequence[str] = ()) -> list[Row]:
    """Lean of the walls of ribs below the axle under each load: leans[PLACE] [degrees]. places: names of the walls by
    their y [cm], of another pressure."""
    unloaded = below_axle(run.folder / f"{pressure:.0f}kPa_0N.vtp")
    found = walls(unloaded, height, lean)
    names = places or [f"{100 * unloaded[wall[1]][0]:.1f}" for wall in found]
    rows: list[Row] = []
    for load in (round(state["load_N"]) for state in tyre_states(run.folder) if state["load_N"] > 0):
        file = run.folder / f"{pressure:.0f}kPa_{load}N.vtp"
        if file.is_file():
            loaded = below_axle(file)
            turned = [wall_lean(loaded, wall) - wall_lean(unloaded, wall) for wall in found]
            leans = {place: round(turn, 1) for place, turn in zip(names, turned, strict=True)}
            rows.append({"load": load, "leans": leans})
    return rows


# ---- the tread as a whole

AROUND_MIDDLE, INNER = 0.06, 0.30  # [m] from the middle, radius: nodes of the tread


def shift(tread: Floats, axle: Floats, around: int) -> Row:
    """forward, upward [mm]: of the tread as a whole from where it stands round the axle. tread: (n, 3) nodes in whole
    rings, evenly spaced, whose mean is the axle's place without load."""
    if len(tread) % around:
        raise ResultsError(f"{len(tread)} nodes of the tread are no rings of {around}")
    moved = 1e3 * (tread.mean(axis=0) - axle)
    return {"forward": float(moved[0]), "upward": float(moved[2])}


def tread_nodes(x: Floats, axle: Floats) -> Floats:
    """Nodes of the tread, of all nodes of a surface (n, 3)."""
    radius = np.hypot(x[:, 0] - axle[0], x[:, 2] - axle[2])
    tread: Floats = x[(np.abs(x[:, 1]) < AROUND_MIDDLE) & (radius > INNER)]
    return tread


def shift_on_plane(run: Run, pressure: float, load: float, around: int) -> Row:
    """Deflection of the last state, and shift, [mm]."""
    deflection = 10 * tyre_states(run.folder, 2)[-1]["deflection_cm"]
    x, axle = read_vtp(run.folder / f"{pressure:.0f}kPa_{load:.0f}N.vtp").x, np.array([0.0, 0.0, -1e-3 * deflection])
    return {"deflection": deflection, **shift(tread_nodes(x, axle), axle, around)}


def shift_in_run(run: Run, around: int) -> Row:
    """Shift at the end of a run [mm]."""
    nodes, x, z = _nodes_at_the_end(run)
    axle = np.array([x, 0.0, z])
    return shift(tread_nodes(nodes, axle), axle, around)


def _nodes_at_the_end(run: Run) -> tuple[Floats, float, float]:
    """Nodes (n, 3) of the tyre at the end of a run, x and z of its axle [m]. @raises ResultsError without a surface"""
    results = Results(run.folder)
    surface = results.surface()
    if surface is None:
        raise ResultsError(f"{results.file}: has no surface of the tyre")
    return surface.x, float(results.columns["x"][-1]), float(results.columns["z"][-1])


MODE_KINDS = {  # waves around the tread, whether it moves along the axle
    ("0", False): "turning",
    ("0", True): "along the axle",
    ("1", False): "shaking in the wheel's plane",
    ("1", True): "tilting",
}


def modes(run: Run, pressure: float) -> list[Row]:
    """mode, frequency [Hz]: the lowest of each kind of the inflated tyre without load."""
    file = run.folder / f"{pressure:.0f}kPa_0N_modes.csv"
    found: dict[str, float] = {}
    with content_of(file, AGAIN):
        for mode in read_rows(file):
            if kind := MODE_KINDS.get((mode["waves"], float(mode["axial"]) > 0.5)):
                found.setdefault(kind, float(mode["frequency_Hz"]))
    return [{"mode": kind, "frequency": frequency} for kind, frequency in found.items()]


def shift_by_mode(run: Run, pressure: float, load: float, mass: float) -> Row:
    """by_mode [mm]: how far the load moves the tread as a whole, from the natural frequency at which it shakes in the
    wheel's plane. mass: of the tread [kg]"""
    frequency = {row["mode"]: row["frequency"] for row in modes(run, pressure)}[MODE_KINDS["1", False]]
    return {"by_mode": 1e3 * load / (mass * (2 * math.pi * frequency) ** 2)}


def come_in(run: Run, around: int, across: int) -> Row:
    """largest [m], at [degrees from straight down]: how far the middle of the tread of a shell tyre, half a model, has
    come in at the end."""
    nodes, axle_x, axle_z = _nodes_at_the_end(run)
    tread = nodes[: around * across].reshape(around, across, 3)[:, 0]
    x, z = tread[:, 0] - axle_x, tread[:, 2] - axle_z
    radius, angle = np.hypot(x, z), np.degrees(np.arctan2(x, -z))
    inwards = np.median(radius[np.abs(angle) > 120]) - radius
    most = int(np.argmax(inwards))
    return {"largest": inwards[most], "at": angle[most]}


# ---- where the tread lifts

LOADED = 0.05  # of the inflation: what a place of the contact bears at least that has not lifted


def lines_of_plane(nodes: Print, step: float, half_tread: float, across: int, finer: int = 1) -> list[Floats]:
    """Pressures [Pa] along the travel at nodes of the tread, a step [m] apart; 0 where a node does not touch. across:
    elements of half the tread; finer: so many times as many elements both ways, in lines from each first node on."""
    index = np.round(nodes["x"] / (step / finer)).astype(int)
    line = np.round(nodes["y"] / half_tread * (finer * across))
    lines: list[Floats] = []
    for number in np.unique(line):
        mine = line == number
        places = index[mine] - index[mine].min()
        whole = np.zeros(places.max() + 1)
        whole[places] = nodes["p"][mine]
        lines += [whole[start::finer] for start in range(finer)]
    return lines


def lines_of_ground(folder: Path, inflation: float, step: float, half_tread: float) -> list[Floats]:
    """Pressures [Pa] along the travel in the uppermost particles below the tread, from the first to the last loaded one."""
    terrain = read_terrain_fields(folder)
    initial, pressure = terrain["initial_position"], -terrain["vertical_stress"]
    top = initial[:, 2] > initial[:, 2].max() - 1e-5
    lines: list[Floats] = []
    for y in np.unique(np.round(initial[top & (np.abs(initial[:, 1]) < half_tread), 1], 6)):
        line = np.flatnonzero(top & (np.abs(initial[:, 1] - y) < 1e-5))
        line = line[np.argsort(initial[line, 0])]
        bears = np.flatnonzero(pressure[line] > LOADED * inflation)
        if len(bears):
            x = terrain["x"][line, 0]
            steps = np.arange(x[bears[0]], x[bears[-1]], step)
            lines.append(np.interp(steps, x, pressure[line]))
    if not lines:
        raise ResultsError(f"{folder}: the tread does not touch the snow")
    return lines


def unevenness(lines: Sequence[Floats], inflation: float) -> Row:
    """lifted: share of the places in the contact that bear nothing; alternation: mean of |p_i - (p_(i-1) + p_(i+1))/2|
    over the mean of p."""
    every = np.concatenate(lines)
    lifted = np.count_nonzero(every < LOADED * inflation) / len(every)
    bends = np.concatenate([line[1:-1] - 0.5 * (line[:-2] + line[2:]) for line in lines])
    return {"lifted": float(lifted), "alternation": float(np.abs(bends).mean() / every.mean())}


def lift_on_plane(
    run: Run, pressure: float, load: float, around: int, radius: float, half_tread: float, across: int, finer: int
) -> Row:
    """Unevenness on a plane under a pressure [kPa] and a load [N]. around: elements of the tread; radius: of it [m]"""
    step = 2 * math.pi * radius / around
    nodes = tyre_print(run, pressure, load)
    return unevenness(lines_of_plane(nodes, step, half_tread, across, finer), 1e3 * pressure)


def lift_on_ground(run: Run, pressure: float, around: int, radius: float, half_tread: float) -> Row:
    """unevenness() of the contact lines on a continuum."""
    step = 2 * math.pi * radius / around
    return unevenness(lines_of_ground(run.folder, 1e3 * pressure, step, half_tread), 1e3 * pressure)
