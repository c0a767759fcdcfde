# SPDX-License-Identifier: GPL-2.0-or-later
"""What a wheel run was: its conditions and discretisation, read from its results folder; the base of every comparison.

Definitions are aligned here, once: load is the vertical force the ground carries at rest, slip is counted in the definition of the
history ((v_rim - v)/max(|v_rim|, |v|), driving positive) and by vehicle speed, the datum of the sinkage is the top of the undisturbed ground
(of grains: of a uniform bed of the same mass), the coefficient is -force_x/force_z.
"""

import json
import re
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from .results import Results, ResultsError
from .summary import Summary


@dataclass
class Value:
    """A steady value with the standard error of its time average."""

    mean: float
    error: float
    unit: str
    steady: bool


@dataclass
class Condition:
    value: object
    unit: str = ""

    def text(self):
        if not isinstance(self.value, float):
            return str(self.value)
        value = 0.0 if abs(self.value) < 1e-9 else self.value  # rounding of a sum that should vanish
        return f"{value:.4g} {self.unit}".strip()


def _after(words, key, default=None, count=1):
    """The number(s) behind a keyword of a fix line."""
    if key not in words:
        return default
    at = words.index(key) + 1
    return float(words[at]) if count == 1 else [float(w) for w in words[at:at + count]]


def _substituted_bed(folder, effective_input):
    """Words of the scene's bed line with its variables replaced: from the log, or from the script's own defaults."""
    log = folder / "log.liggghts"
    if log.is_file():
        lines = [line.split() for line in log.read_text(errors="replace").splitlines() if line.startswith("bed ") and "${" not in line]
        if lines:
            return lines[0]
    script = effective_input.partition("\n# script ")[2].replace("&\n", " ")
    values = dict(re.findall(r"^variable\s+(\S+)\s+index\s+(\S+)", script, re.MULTILINE))
    found = re.search(r"^bed\s.*$", script, re.MULTILINE)
    return re.sub(r"\$\{(\w+)\}", lambda name: values.get(name[1], name[0]), found[0]).split() if found else []


@dataclass
class WheelRun:
    """One results folder of a wheel on a rig, on grains (history.h5) or continuum (ground.h5 beside it)."""

    folder: Path
    results: Results
    label: str
    ground: str                                   # "grains", "continuum" or "none"
    conditions: dict = field(default_factory=dict)  # name -> Condition
    size: float = float("nan")                    # m: cell or mean grain diameter
    elements: int = 0                             # particles or grains
    half: bool = False
    domain: tuple = ()                            # m: length, width of the ground
    seed: str = ""
    soften: float = 1.0
    values: dict = field(default_factory=dict)    # name -> Value
    wall_time: float = float("nan")
    cpu_time: float = float("nan")                # s: measured by the runner, else wall time x ranks

    @property
    def wheel(self):
        return self.conditions["wheel"].value

    @property
    def ground_level(self):
        return self.conditions["ground_level"].value

    @property
    def radius(self):
        return 0.5 * self.conditions["wheel_diameter"].value

    def describe_size(self):
        kind = "cells" if self.ground == "continuum" else "grains"
        return f"{kind} of {1e3 * self.size:.3g} mm"


def _styles(effective_input):
    """style -> words of its line."""
    styles = {}
    for line in effective_input.split("\n# script ")[0].splitlines():
        words = line.split()
        if len(words) > 3 and words[0] == "fix":
            styles.setdefault(words[3], words)
    return styles


def _rig_conditions(run, rig, wheel, tyre):
    conditions = run.conditions
    gravity = _after(rig, "gravity", 9.80665)
    load = _after(rig, "load_force") if "load_force" in rig else \
        _after(rig, "load_mass") * gravity if "load_mass" in rig else float("nan")
    conditions["load"] = Condition(load, "N")
    conditions["speed"] = Condition(_after(rig, "speed"), "m/s")
    conditions["mode"] = Condition(rig[rig.index("mode") + 1])
    for name in ("slip_angle", "camber"):
        conditions[name] = Condition(_after(rig, name, 0.0), "deg")
    conditions["gravity"] = Condition(gravity, "m/s2")
    conditions["ground_level"] = Condition(_after(rig, "ground_level"), "m")
    if tyre:
        conditions["wheel"] = Condition("tyre")
        conditions["pressure"] = Condition(_after(tyre, "pressure", float("nan")), "Pa")
        surface = run.results.surface()
        low, high = surface[1].min(axis=0), surface[1].max(axis=0)
        conditions["wheel_diameter"] = Condition(float(high[0] - low[0]), "m")
        half = "half" in tyre and tyre[tyre.index("half") + 1] == "yes"
        conditions["wheel_width"] = Condition(float(2 * high[1] if half else high[1] - low[1]), "m")
    else:
        conditions["wheel"] = Condition("rigid wheel")
        conditions["wheel_diameter"] = Condition(_after(wheel, "diameter"), "m")
        conditions["wheel_width"] = Condition(_after(wheel, "width"), "m")


def _continuum(run, soil):
    with h5py.File(run.folder / "ground.h5", "r") as content:
        home, density = content["ground/home"][()], content["ground/density"][()]
        compaction, volume = content["ground/compaction"][()], content["ground/volume"][()]
    run.size, run.elements = _after(soil, "cell"), len(home)
    run.half = "symmetry" in soil and soil[soil.index("symmetry") + 1] == "yes"
    run.domain = (_after(soil, "length"), _after(soil, "width"))
    run.soften = _after(soil, "soften", 1.0)
    run.conditions["depth"] = Condition(_after(soil, "depth"), "m")
    # compaction is ln(rho/rho_0) of a particle
    run.conditions["density"] = Condition(float(np.average(density * np.exp(-compaction), weights=volume * density)), "kg/m3")


def _grains(run, bed):
    reference = run.results.grains("reference")
    run.size, run.elements = float(2 * reference.radius.mean()), len(reference.id)
    level = reference.bed_level if np.isfinite(reference.bed_level) else run.ground_level
    low, high = (reference.x - reference.radius[:, None]).min(axis=0), (reference.x + reference.radius[:, None]).max(axis=0)
    inner = (high - low)[:2]  # what the grains fill: a bed's walls may stand outside of its length and width
    run.domain = tuple(_after(bed, key, float(inner[k])) for k, key in enumerate(("length", "width")))
    floor = 0.0 if abs(low[2]) < run.size else float(low[2])
    run.conditions["depth"] = Condition(float(level - floor), "m")
    if bed and _after(bed, "density"):
        solid = 4 / 3 * np.pi * np.sum(reference.radius**3)
        run.conditions["density"] = Condition(float(_after(bed, "density") * solid / (inner[0] * inner[1] * (level - floor))), "kg/m3")
    run.seed = bed[bed.index("seed") + 1] if "seed" in bed else ""


def _cost(run):
    with h5py.File(run.results.file, "r") as content:
        attributes = dict(content["cost"].attrs) if "cost" in content else {}
    run.wall_time = float(attributes.get("wall_time", "nan"))
    run.cpu_time = run.wall_time * float(attributes.get("ranks", 1))
    try:  # the runner's own measurement does not count what other programs took
        run.cpu_time = float(json.loads((run.folder / "run.json").read_text())["cpu_time"])
    except (OSError, ValueError, KeyError):
        pass


def read(folder, label=None):
    """WheelRun of a results folder. @raises ResultsError"""
    results = Results(folder)
    with h5py.File(results.file, "r") as content:
        text = content["run/effective_input"][()]
    text = text.decode() if isinstance(text, bytes) else str(text)
    styles = _styles(text)
    rig, wheel, tyre = styles.get("wheel/rig"), styles.get("wheel/rigid"), styles.get("tyre/darnell")
    if rig is None or (wheel is None and tyre is None):
        raise ResultsError(f"{results.file}: is not the run of a wheel on a rig (no line of wheel/rig and wheel/rigid or tyre/darnell)")
    soil = styles.get("terrain/continuum")
    if soil and not (results.folder / "ground.h5").is_file():
        raise ResultsError(f"{results.folder}: has no ground.h5; give the scene a fix terrain/history with the same folder")
    with h5py.File(results.file, "r") as content:
        has_grains = "grains/reference" in content and len(content["grains/reference/id"]) > 0
    run = WheelRun(results.folder, results, label or results.folder.resolve().name,
                   "continuum" if soil else "grains" if has_grains else "none")
    _rig_conditions(run, rig, wheel, tyre)
    if soil:
        _continuum(run, soil)
    elif has_grains:
        _grains(run, _substituted_bed(results.folder, text))
    _values(run)
    _cost(run)
    return run


def _values(run):
    summary = Summary(run.folder)
    names = ("sinkage", "resistance_coefficient", "force_z", "drawbar_pull", "drive_torque", "slip")
    for name in names:
        value = summary.quantity(name)
        if value is None:
            raise ResultsError(f"{run.folder}: has no steady {name} in summary.json; write it with "
                               f"'furrow-post resistance --write {run.folder}', or run longer")
        run.values[name] = Value(value["mean"], value["standard_error"], value["unit"], value["steady"])
    columns = run.results.columns
    begin, end = summary.window
    inside = (columns["time"] >= begin) & (columns["time"] <= end)
    v, rim = columns["velocity_x"][inside].mean(), run.radius * columns["spin_rate"][inside].mean()
    slip = run.values["slip"]
    run.conditions["slip"] = Condition(slip.mean)
    run.conditions["slip_by_vehicle_speed"] = Condition(float((rim - v) / v) if v else float("nan"))
    # The datum: the rig counts from ground_level, which may differ from the top of the undisturbed ground
    depth = run.conditions.get("depth")
    if run.ground == "grains" and depth is not None:
        reference = run.results.grains("reference")
        if np.isfinite(reference.bed_level):
            shift = reference.bed_level - run.ground_level
            run.values["sinkage"].mean += shift
            run.conditions["datum_shift"] = Condition(float(shift), "m")
