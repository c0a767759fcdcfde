# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions and discretisation of a wheel run, from its results folder; base of comparisons.

Definitions are aligned here, once. Load is the vertical force that the ground carries at rest. Slip
is counted as in the history ((v_rim - v)/max(|v_rim|, |v|), driving positive) and by vehicle speed.
The datum of the hub drop is the top of the undisturbed ground (of grains: of a uniform bed of the
same mass). The resistance coefficient is -force_x/force_z.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import ResultsError
from .ground_kinds import GroundKind, ground_kind
from .results import Grains, Results, Style
from ..run.record import FINISHED, read_record
from ..run.summary import SteadyValue, Summary
from .terrain import FILE, read_terrain_fields, terrain_file

STEADY_QUANTITIES = (
    "hub_drop",
    "resistance_coefficient",
    "force_z",
    "drawbar_pull",
    "drive_torque",
    "slip",
)
# Those that are means of a channel of the history
FROM_CHANNELS = ("hub_drop", "force_z", "drawbar_pull", "drive_torque")
SAME_MEAN = 0.02  # relative difference of means over one window: rows at its ends
ANGLES = ("slip_angle", "camber", "slope", "side_slope")  # of a rig


@dataclass(frozen=True)
class Condition:
    """One condition of a run: a number with its unit, or a word."""

    value: float | str
    unit: str = ""

    @property
    def number(self) -> float:
        """Number of a condition; NaN for a word."""
        return self.value if isinstance(self.value, float) else float("nan")

    def text(self) -> str:
        if isinstance(self.value, str):
            return self.value
        value = 0.0 if abs(self.value) < 1e-9 else self.value  # rounding of a sum that vanishes
        return f"{value:.4g} {self.unit}".strip()


@dataclass
class WheelRun:
    """One results folder of a wheel on a rig: on grains, continuum (terrain.h5), or neither."""

    folder: Path
    results: Results
    label: str
    ground: str  # "grains", "continuum", "hybrid": grains on a continuum; "scm" or "none"
    deformable: bool  # a tyre, whose outline changes under load
    conditions: dict[str, Condition] = field(default_factory=dict)
    size: float = float("nan")  # cell or mean grain diameter [m]
    elements: int = 0  # particles or grains
    half: bool = False  # half model, mirrored at y = 0
    domain: tuple[float, ...] = ()  # length and width of the ground [m]
    seed: str = ""  # of the packing of grains
    floor: float = float("-inf")  # z of the ground under a bed whose lowest grains are frozen [m]
    below: float = 0.0  # depth of the continuum under the grains of a hybrid [m]
    values: dict[str, SteadyValue] = field(default_factory=dict)  # STEADY_QUANTITIES
    rolling_radius: float = float("nan")  # travel along x per turn in the window [m/rad]
    slip_radius: float = float("nan")  # that gives the rim speed of the slip [m]; NaN: tips of a mesh
    wall_time: float = float("nan")  # [s]
    cpu_time: float = float("nan")  # measured by the runner, else wall time x ranks [s]

    def number(self, condition: str) -> float:
        """Number of a condition; NaN where it is not known."""
        found = self.conditions.get(condition)
        return float("nan") if found is None else found.number

    def text(self, condition: str, missing: str = "") -> str:
        found = self.conditions.get(condition)
        return missing if found is None else found.text()

    @property
    def wheel(self) -> str:
        """Name of the rolling body: "rigid wheel", "tyre"."""
        return self.text("wheel")

    @property
    def ground_level(self) -> float:
        """z from which the rig counts the hub drop [m]."""
        return self.number("ground_level")

    @property
    def radius(self) -> float:
        """Radius of the undeformed wheel [m]."""
        return 0.5 * self.number("wheel_diameter")

    @property
    def model(self) -> str:
        return "half" if self.half else "whole"

    @property
    def ground_kind(self) -> GroundKind:
        return ground_kind(self.ground)

    def describe_size(self) -> str:
        if self.ground == "none":
            return "none"
        return f"{self.ground_kind.sizes} of {1e3 * self.size:.3g} mm"

    def relabelled(self, label: str) -> "WheelRun":
        return replace(self, label=label)


def read_wheel_run(folder: Path | str, label: str | None = None) -> WheelRun:
    """The run of a results folder; label: its name in tables. @raises ResultsError"""
    results = Results(folder)
    styles = results.styles()
    rig, wheel = styles.of_kind("rig"), styles.of_kind("wheel")
    if rig is None or wheel is None:
        raise ResultsError(
            f"{results.file}: is not the run of a wheel on a rig "
            "(none of its styles is of the kind wheel, or none is a rig)"
        )
    soil, bed = styles.terrain(), styles.of_style("bed")
    if soil and soil.kind == "terrain" and not terrain_file(results.folder).is_file():
        raise ResultsError(
            f"{results.folder}: has no {FILE}; give the scene a fix terrain/history with the same "
            "folder"
        )
    reference = results.grains("reference") if results.has_grains else None
    if reference is not None and len(reference.id) == 0:
        reference = None
    run = WheelRun(
        results.folder,
        results,
        label or results.folder.resolve().name,
        _ground_of(soil, reference),
        deformable=not wheel.style.startswith("wheel/"),
    )
    run.conditions.update(_rig_conditions(rig))
    run.conditions.update(_wheel_conditions(wheel, results))
    run.slip_radius = _slip_radius(rig, wheel, run.radius)
    if soil and run.ground == "scm":
        _read_scm(run, soil)
    elif soil and run.ground == "continuum":
        _read_continuum(run, soil)
    elif reference:
        _read_grains(run, bed, reference, soil)
    _read_values(run, reference)
    _read_cost(run)
    return run


def _ground_of(soil: Style | None, reference: Grains | None) -> str:
    if soil and soil.kind == "scm":
        return "scm"
    if soil:
        return "hybrid" if reference else "continuum"
    return "grains" if reference else "none"


def _rig_conditions(rig: Style) -> dict[str, Condition]:
    gravity, unknown = rig.number("gravity"), float("nan")
    load = rig.number("load_force") if rig.has("load_force") else rig.number("load_mass", unknown) * gravity
    return {
        "load": Condition(load, "N"),
        "speed": Condition(rig.number("speed", unknown), "m/s"),
        "mode": Condition(rig.text("mode")),
        **{angle: Condition(rig.number(angle, 0.0), "deg") for angle in ANGLES},
        "slip_definition": Condition(_slip_definition(rig)),
        "travel": Condition(rig.text("travel") if rig.has("travel") else "prescribed"),
        "gravity": Condition(gravity, "m/s2"),
        "ground_level": Condition(rig.number("ground_level"), "m"),
    }


def _slip_definition(rig: Style) -> str:
    """Radius and speed; those of a rig that does not have them are the default."""
    radius, speed = (
        rig.text(key) if rig.has(key) else default
        for key, default in (("slip_radius", "bare"), ("slip_speed", "forward"))
    )
    if radius == "effective":
        radius = f"effective radius {rig.number('effective_radius'):g} m"
    else:
        radius = f"{radius} radius"
    return f"{radius}, {speed} speed"


def _slip_radius(rig: Style, wheel: Style, bare: float) -> float:
    kind = rig.text("slip_radius") if rig.has("slip_radius") else "bare"
    if kind == "effective":
        return rig.number("effective_radius")
    if kind == "bare":
        return bare
    height = wheel.number("grouser_height") if wheel.has("grouser_height") else 0.0
    return bare + height if wheel.has("diameter") else float("nan")


def _wheel_conditions(wheel: Style, results: Results) -> dict[str, Condition]:
    """Sizes are those that the style has, else those of its surface at the end of the run."""
    head, _, tail = wheel.style.partition("/")
    found = {"wheel": Condition(f"{tail} {head}" if head == "wheel" else head)}
    if wheel.has("pressure"):
        found["pressure"] = Condition(wheel.number("pressure"), "Pa")
    if wheel.has("diameter"):
        diameter, width = wheel.number("diameter"), wheel.number("width")
    else:
        surface = results.surface()
        if surface is None:
            raise ResultsError(
                f"{results.file}: has no surface of the {head} at the end of the run"
            )
        low, high = surface.x.min(axis=0), surface.x.max(axis=0)
        diameter = float(high[0] - low[0])
        width = float(2 * high[1] if wheel.flag("half") else high[1] - low[1])
        if wheel.has("radius"):  # without the grousers of the surface
            diameter = 2.0 * wheel.number("radius")
    found["wheel_diameter"] = Condition(diameter, "m")
    found["wheel_width"] = Condition(width, "m")
    return found


def _read_continuum(run: WheelRun, soil: Style) -> None:
    fields = read_terrain_fields(run.folder)
    fields.require_finite("density", "compaction", "volume")
    if fields.require_rows() == 0:
        raise ResultsError(f"{fields.file}: has no particles; {fields.remedy}")
    density, compaction, volume = (fields[name] for name in ("density", "compaction", "volume"))
    run.size, run.elements = soil.number("cell"), len(density)
    run.half = soil.flag("symmetry")
    run.domain = (soil.number("length"), soil.number("width"))
    run.conditions["depth"] = Condition(soil.number("depth"), "m")
    # compaction is ln(rho/rho_0) of a particle
    initial = float(np.average(density * np.exp(-compaction), weights=volume * density))
    run.conditions["density"] = Condition(initial, "kg/m3")


def _read_scm(run: WheelRun, scm: Style) -> None:
    run.size = scm.number("cell")
    run.domain = (scm.number("length"), scm.number("width"))
    run.elements = round(run.domain[0] * run.domain[1] / run.size**2)


def _read_grains(
    run: WheelRun, bed: Style | None, reference: Grains, soil: Style | None = None
) -> None:
    """soil: the continuum that they lie on, in the place of a floor."""
    run.size, run.elements = float(2 * reference.radius.mean()), len(reference.id)
    level = reference.bed_level if np.isfinite(reference.bed_level) else run.ground_level
    low, high = reference.corners
    inner: Floats = (high - low)[:2]  # size of the region with grains; walls can lie outside the bed
    run.domain = (float(inner[0]), float(inner[1]))
    base = bed.number("base", 0.0) if bed else 0.0
    floor = float(low[2]) + base
    floor = 0.0 if abs(floor) < run.size else floor
    if soil:
        floor = soil.number("surface")
    if base > 0.0:
        run.floor = floor
    depth = float(level - floor)
    run.below = soil.number("depth") if soil else 0.0
    run.conditions["depth"] = Condition(depth + run.below, "m")
    if bed is None:
        return
    run.domain = (bed.number("length", run.domain[0]), bed.number("width", run.domain[1]))
    if bed.has("density"):
        solid = np.sum(reference.volume_above(run.floor))
        bulk = float(bed.number("density") * solid / (inner[0] * inner[1] * depth))
        run.conditions["density"] = Condition(bulk, "kg/m3")
    if bed.has("seed"):
        run.seed = f"{bed.number('seed'):.0f}"


def _read_values(run: WheelRun, reference: Grains | None) -> None:
    """Steady values, and the slip in both definitions; reference: grains before, or None."""
    summary = Summary(run.folder)
    for name in STEADY_QUANTITIES:
        value = summary.quantity(name)
        if value is None or summary.window is None:
            raise ResultsError(
                f"{run.folder}: has no steady {name} in summary.json; write it with "
                f"'furrow-post resistance --write {run.folder}', or run longer"
            )
        run.values[name] = value
    assert summary.window is not None
    begin, end = summary.window
    columns = run.results.columns
    inside = (columns["time"] >= begin) & (columns["time"] <= end)
    if not inside.any():
        raise ResultsError(
            f"{run.folder}: the window of summary.json, {begin:g} to {end:g} s, lies outside of "
            f"the history; write it again with 'furrow-post resistance --write {run.folder}'"
        )
    for name in FROM_CHANNELS:
        _require_mean(run, name, float(columns[name][inside].mean()))
    v, spin = (float(columns[name][inside].mean()) for name in ("velocity_x", "spin_rate"))
    run.rolling_radius = v / spin if spin else float("nan")
    if run.text("travel") == "free":  # an answer of the ground
        run.conditions["speed"] = Condition(v, "m/s")
    slip = float(run.values["slip"].mean)
    run.conditions["slip"] = Condition(slip)
    run.conditions["slip_by_vehicle_speed"] = Condition(slip_by_vehicle_speed(slip))
    # The rig counts the hub drop from ground_level, which may differ from the top of the ground
    if reference is not None and np.isfinite(reference.bed_level):
        shift = float(reference.bed_level - run.ground_level)
        hub_drop = run.values["hub_drop"]
        run.values["hub_drop"] = replace(hub_drop, mean=hub_drop.mean + shift)
        run.conditions["datum_shift"] = Condition(shift, "m")


def slip_by_vehicle_speed(slip: float) -> float:
    """(v_rim - v)/v of a wheel that moves forward, from (v_rim - v)/max(|v_rim|, |v|); NaN where it does not move."""
    if slip < 0.0:  # the vehicle is the faster one
        return slip
    return slip / (1.0 - slip) if slip < 1.0 else float("nan")


def _require_mean(run: WheelRun, name: str, mean: float) -> None:
    """@raises ResultsError where summary.json has another mean than the history"""
    value = run.values[name]
    if not abs(value.mean - mean) <= max(SAME_MEAN * abs(mean), value.standard_error):
        raise ResultsError(
            f"{run.folder}: summary.json has a {name.replace('_', ' ')} of {value.mean:.4g} {value.unit}, "
            f"its history {mean:.4g}; write it again with 'furrow-post resistance --write {run.folder}'"
        )


def _read_cost(run: WheelRun) -> None:
    cost = run.results.cost
    run.wall_time = cost.get("wall_time", float("nan"))
    run.cpu_time = run.wall_time * cost.get("ranks", 1.0)
    if record := read_record(run.folder / FINISHED):  # the CPU time of the record excludes other programs
        run.cpu_time = record.cpu_time
