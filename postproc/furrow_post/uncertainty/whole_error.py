# SPDX-License-Identifier: GPL-2.0-or-later
"""The whole error of each value of a run: where its parts come from.

Cells or grains: of the scene's convergence; else of a table of its runs or of the nearest series of sizes.csv, the
larger one. The size counts over the width of the wheel, and an error grows in proportion to it beyond the largest of
the series. Width of a continuum: the study ground_size. Step and contact of a continuum: scheme.csv. Model: model_error.py. Depths have relative errors, coefficients
absolute ones; forces those of their coefficients times the vertical force.
"""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import ResultsError
from ..formatting import value_text as with_known_error
from ..read.wheel_run import WheelRun, read_wheel_run
from ..run.summary import BUDGET, SteadyValue, Summary
from .budget import IMPOSED, Budget
from .cost_table import Family, FamilyKey, parsed_row
from .model_error import MISMATCH, OF_RUN, REGIMES, RELATIVE, TESTS, Case, ModelError, Test, model_error
from .scene_errors import convergence_of, material_error_of, steady_values, summary_values
from .statistics import grouped, rms
from .validation_table import Rows, ValidationTable

Families = Mapping[FamilyKey, Family]
Scheme = Mapping[tuple[str, str], tuple[float, str]]  # part, key -> error and what was changed
SNOW = 700.0  # [kg/m3] bulk density below which a ground is snow
STRAIGHT = 0.02  # slip within which a driven wheel is not braked
KEYS = {  # quantity of a run -> that of the tables: depths and coefficients
    "hub_drop": "sinkage",
    "rut_depth": "sinkage",
    "resistance_coefficient": "coefficient",
    "net_traction_coefficient": "coefficient",
}
FORCES = ("drawbar_pull", "tractive_force", "force_x")  # coefficient times vertical force


def case_of(run: WheelRun) -> Case:
    """Case of a run: the conditions that decide which tests are near."""
    style = run.results.styles().of_kind("wheel")
    grousers = bool(style and style.has("grousers") and style.number("grousers") > 0)
    slip = run.number("slip")
    torque = run.values["drive_torque"]
    towed = run.text("mode") == "towed" or not (torque.mean or torque.standard_error)
    density = run.number("density")
    ground = "road" if run.ground == "none" else "snow" if density < SNOW else "sand"
    return Case(
        ground,
        "tyre" if run.deformable else "rigid wheel",
        "towed" if towed else "braked" if slip < -STRAIGHT else "driven",
        "yes" if grousers else "no",
        math.nan if towed else slip,
        abs(run.number("slip_angle")),
        run.number("slope"),
        run.values["hub_drop"].mean / run.radius,
        run.radius,
    )


# ---- cells, grains and packings of like wheels


@dataclass(frozen=True)
class SizeSeries:
    """Runs of one scene in several sizes."""

    name: str
    words: Mapping[str, str]  # ground, wheel, motion
    width: float  # of the wheel [m]
    family: Family
    radius: float  # [m]

    def distance(self, case: Case) -> float:
        return math.hypot(*(MISMATCH[name] for name, word in self.words.items() if word != getattr(case, name)))

    def errors(self, key: str, size_over_width: float) -> tuple[float, float]:
        """Errors of the size and of a packing; relative for a depth."""
        size, scale = size_over_width * self.width, abs(self.family.reference(key)[0]) if key == "sinkage" else 1.0
        largest = max(row.size for row in self.family.bases)
        parts = self.family.components(key, min(size, largest))
        return max(size / largest, 1.0) * parts.size / scale, parts.packing / scale


def series_of(rows: Rows) -> tuple[SizeSeries, ...]:
    """Size series from the rows of sizes.csv. @raises ValueError"""
    found = []
    for group in grouped(rows, lambda row: (row["series"], row["ground"], row["wheel"])).values():
        first, family = group[0], Family([parsed_row({**row, "run": row["series"], "model": ""}) for row in group])
        words = {"ground": first["soil"], "wheel": first["wheel"], "motion": first["motion"]}
        found.append(SizeSeries(first["series"], words, float(first["width"]), family, float(first["radius"])))
    return tuple(found)


def scheme_of(rows: Rows) -> Scheme:
    """Errors of the scheme from the rows of scheme.csv. @raises ValueError"""
    columns = (("sinkage", "depth"), ("coefficient", "coefficient"))
    return {(row["part"], key): (float(row[column]), row["what"]) for row in rows for key, column in columns}


def effects_of(rows: Rows) -> dict[tuple[str, str], tuple[float, float, float]]:
    """(kind of ground, "sinkage" or "coefficient") -> a, c and residual of a exp(-x/c), the change by the sides of the
    ground under a wheel over x, their distance in widths of the wheel. @raises ValueError"""
    keys = {"hub_drop_m": "sinkage", "net_traction": "coefficient"}
    rows = [row for row in rows if row["body"] == "wheel" and row["edge"] == "width"]
    return {(r["kind"], keys[r["quantity"]]): (float(r["a"]), float(r["c"]), float(r["residual"])) for r in rows}


SIZES = ValidationTable("sizes.csv", series_of)
SCHEME = ValidationTable("scheme.csv", scheme_of)
EFFECTS = ValidationTable("ground_size/effects.csv", effects_of, "ground_size")


def width_of_ground(run: WheelRun, case: Case, key: str) -> Budget:
    """Error by the sides of a continuum; relative for a depth."""
    effect = EFFECTS.stored().get((case.ground, key)) if run.ground == "continuum" else None
    if not effect or len(run.domain) < 2:
        return Budget()
    a, c, residual = effect
    x = 0.5 * (run.domain[1] / run.number("wheel_width") - 1.0)
    error = math.hypot(a * math.exp(-x / c), residual)
    return Budget.single("domain", error, f"ground_size: sides {x:.2g} widths away")


def of_like_wheels(run: WheelRun, case: Case, key: str) -> Budget:
    soil = run.results.styles().terrain()
    particles = soil.number("particles", 2) if soil else 2
    ratio = run.size / run.number("wheel_width")
    return like_wheels(SIZES.stored(), SCHEME.stored(), run.ground, ratio, case, key, particles)


def like_wheels(
    known: Sequence[SizeSeries], scheme: Scheme, ground: str, size_over_width: float, case: Case, key: str, particles: float = 2
) -> Budget:
    """Size, packing, step and contact by the nearest series: of a depth relative. particles: of a cell in each direction"""
    near = [one for one in known if one.family.key.ground == ground]
    if not near or not math.isfinite(size_over_width):
        return Budget()
    least = min(one.distance(case) for one in near)
    near = [one for one in near if one.distance(case) == least]
    pairs = np.array([one.errors(key, size_over_width) for one in near])
    size, packing = (rms(column[np.isfinite(column)]) * math.hypot(1.0, least) for column in pairs.T)
    from_ = f"{', '.join(one.name for one in near)}{' of other wheels' if least else ''}"
    found = Budget.single("size", size, from_)
    found = found.updated(Budget.single("packing", packing, from_ if packing else "a continuum has none"))
    if ground == "continuum" and scheme:
        for part in ("step", "contact"):
            error, what = scheme[part, key]
            found = found.updated(Budget.single(part, error, f"convergence: {what}"))
        error, what = scheme["size", key]
        if particles < 3:
            found = found.updated(Budget.single("size", math.hypot(size, error), f"{from_}; {what}"))
    return found


# ---- a run


class RunErrors:
    """Errors of the values of one run. families: of a table of runs of the scene, may be empty"""

    def __init__(self, run: WheelRun, families: Families | None = None) -> None:
        self.run, self.case = run, case_of(run)
        self.family = (families or {}).get(FamilyKey(run.ground, run.model, run.wheel))
        self.stored = convergence_of(run)
        self.soil = material_error_of(run)
        self.load = abs(run.values["force_z"].mean)
        self.regimes = REGIMES.stored() if run.ground_kind.has_tests else ()
        self.elements = "mesh" if run.ground == "none" else run.ground_kind.sizes

    def of(self, name: str, value: SteadyValue) -> Budget:
        """Error of a value, also of one that the summary does not have."""
        return replace(self._whole(name, value), elements=self.elements)

    def all(self) -> dict[str, Budget]:
        """Quantity of the run and its summary -> its error."""
        return {name: self.of(name, value) for name, value in steady_values(self.run).items()}

    def model(self, name: str) -> ModelError | None:
        """Error of the model by the nearest tests of a quantity; None without a near test."""
        if name == "slip" and self.case.motion == "towed":
            return None  # the tests are of wheels that drive
        quantity = "depth" if name == "hub_drop" and not self.run.deformable else OF_RUN.get(name, "")
        return model_error(self.regimes, quantity, self.case)

    def _whole(self, name: str, value: SteadyValue) -> Budget:
        time = value.standard_error
        if value.imposed or name == "force_z":  # the load, which the rig holds
            return replace(IMPOSED, time=0.0 if value.imposed else time)
        if name in FORCES:
            coefficient = self._parts("net_traction_coefficient", self.run.values["resistance_coefficient"])
            return replace(coefficient.scaled(self.load), time=time)
        return self._parts(name, value)

    def _parts(self, name: str, value: SteadyValue) -> Budget:
        key, found = KEYS.get(name, ""), Budget()
        if key:
            found = of_like_wheels(self.run, self.case, key).updated(width_of_ground(self.run, self.case, key))
            found = found.scaled(value.mean if key == "sinkage" else 1.0)
        found = found.updated(self._certain())
        if self.soil and (error := self.soil.error(name, value.mean)) is not None:
            found = found.updated(Budget.single("material", error, self.soil.source))
        found = self._with_scene(found, name, value, key)
        found = replace(found, time=value.standard_error, held=self._held(value))
        if not (model := self.model(name)):
            return found
        quantity = model.nearest.quantity
        size = model.value * (abs(value.mean) if quantity in RELATIVE else self.load if quantity == "lateral" else 1.0)
        return found.updated(Budget.single("model", size, model.source()))

    def _certain(self) -> Budget:
        """Parts of the error that are 0: packing on cells, ground on a road."""
        if self.run.ground == "none":
            return Budget(packing=0.0, domain=0.0)
        return Budget() if self.run.ground_kind.random else Budget(packing=0.0)

    def _with_scene(self, parts: Budget, name: str, value: SteadyValue, key: str) -> Budget:
        """Parts with the errors from the runs of this scene in other sizes, where there are any."""
        error = self.stored.size_error(name, self.run.size, value.mean) if self.stored else None
        if self.stored and error is not None:
            parts = parts.updated(Budget.single("size", error, self.stored.source))
        if not self.family or not key or name == "rut_depth":
            return parts
        known = replace(self.family.components(key, self.run.size, value.standard_error), time=math.nan)
        if error is not None or known.size < parts.size:
            # tables of inputs/costs are of runs without cell averages, which hide a part of it
            known = replace(known, size=math.nan)
        return parts.updated(replace(known, sources=dict.fromkeys(known.known, "table of runs of the scene")))

    def _held(self, value: SteadyValue) -> float:
        """The vertical force over the window against the load, of what grows with it."""
        level = self.run.number("slope") == 0 and self.run.number("side_slope") == 0
        load = self.run.number("load")
        if not level or not load > 0:
            return math.nan
        return abs(self.load / load - 1.0) * (abs(value.mean) if value.unit else 0.0)


def budgets_of(folder: Path) -> dict[str, Budget]:
    """Error budgets of a results folder by quantity. Without a complete run of a wheel only the error over time is known."""
    return _budgets_and_reason(folder)[0]


def _budgets_and_reason(folder: Path) -> tuple[dict[str, Budget], str]:
    """Error budgets, with the reason why the run is not complete, else ""."""
    try:
        return RunErrors(read_wheel_run(folder)).all(), ""
    except ResultsError as error:
        reason = str(error)
    values = summary_values(folder).items()
    return {name: IMPOSED if value.imposed else Budget(time=value.standard_error) for name, value in values}, reason


# ---- a value over the nearest tests


@dataclass(frozen=True)
class OverTests:
    """A value of a run with its whole error, and the tests of the nearest regime; depths over the radius."""

    name: str
    value: float
    error: float
    missing: str  # errors that are excluded
    sign: float  # of the tests' values: -1 where a run resists and the tests pull
    tests: Sequence[Test]  # tests with known values
    nearest: str  # regime; empty: no test is near

    @property
    def title(self) -> str:
        missing = f" ({self.missing})" if self.missing else ""
        # the values of groups are not known
        tests = f"Nearest: {self.nearest}; {len(self.tests)} are drawn" if self.nearest else "No measured test is near"
        return f"{self.name} {with_known_error(self.value, self.error)}{missing}. {tests}"


def over_tests(run: WheelRun) -> list[OverTests]:
    """Hub drop and coefficient that the run is made for, each with the tests of the nearest regime."""
    errors, values = RunErrors(run), steady_values(run)
    found = []
    for name in Summary(run.folder).headline:
        if name != "hub_drop" and KEYS.get(name) != "coefficient":
            continue
        budget, near = errors.of(name, values[name]), errors.model(name)
        scale, label, opposed = 1 / run.radius, "hub drop over radius", False
        if name != "hub_drop":
            scale, label = 1.0, name.replace("_", " ")
            towed = near is not None and near.nearest.words["motion"] == "towed"
            opposed = near is not None and (name == "resistance_coefficient") != towed
        tests = [test for test in TESTS.stored() if near and near.nearest.has(test) and math.isfinite(test.computed)]
        value, error = scale * values[name].mean, scale * budget.total
        source = near.source() if near else ""
        found.append(OverTests(label, value, error, budget.missing_text(), -1.0 if opposed else 1.0, tests, source))
    return found


# ---- output as text and as files

IN_PEOPLES_UNITS = {"m": (1e3, "mm"), "": (1.0, "")}
TITLES = {"drive_torque": "torque"}


def _scaled(name: str, value: SteadyValue) -> tuple[float, str]:
    """Factor and unit that people read."""
    return (100.0, "%") if name == "slip" else IN_PEOPLES_UNITS.get(value.unit, (1.0, value.unit))


def value_text(name: str, value: SteadyValue, budget: Budget) -> str:
    """ "94 ± 12 mm", "20 % imposed"."""
    factor, unit = _scaled(name, value)
    text = f"{budget.scaled(factor).value_text(factor * value.mean)} {unit}".rstrip()
    return f"{text} imposed" if value.imposed else text


def headline(folder: Path, known: Mapping[str, Budget] | None = None) -> str:
    """For a title: "hub drop 94 ± 12 mm, pull 0.06 ± 0.12 (+ material unknown); torque 12 ± 1 N m (over time only)".

    known: budgets of the folder, if they were read before
    """
    summary, values = Summary(folder), summary_values(folder)
    known = budgets_of(folder) if known is None else known
    texts: dict[str, list[str]] = {}  # errors excluded from ± -> values
    for name in summary.headline:
        text = f"{TITLES.get(name, name.replace('_', ' '))} {value_text(name, values[name], known[name])}"
        texts.setdefault(known[name].missing_text(), []).append(text)
    if not texts:
        return ""
    line = "; ".join(", ".join(values) + f" ({missing})" * bool(missing) for missing, values in texts.items())
    return line + ("" if summary.content.get("steady", False) else "; not all steady, see summary.txt")


def report(folder: Path) -> str:
    """The headline quantities with their parts, and the nearest tests. @raises ResultsError without steady values"""
    names, values, (known, reason) = Summary(folder).headline, summary_values(folder), _budgets_and_reason(folder)
    if not names:
        raise ResultsError(f"{folder}: has no steady values in summary.json; run longer")
    lines = ["± is one standard error of all that is known; in brackets its parts"]
    if reason:
        lines.append(f"  only the error over time is known: {reason}")
    sources: dict[str, dict[str, None]] = {}
    for name in names:
        value, budget, title = values[name], known[name], name.replace("_", " ")
        factor, unit = _scaled(name, value)
        state = ", imposed" if value.imposed else "" if value.steady else ", not steady"
        lines.append(f"  {title:24} {budget.scaled(factor).text(factor * value.mean, unit)}{state}")
        for part, source in budget.sources.items():
            if budget.part(part) > 0:
                label = f"nearest tests of {title}" if part == "model" else budget.label(part)
                sources.setdefault(label, {})[source] = None
    lines += [f"  {label}: {'; '.join(found)}" for label, found in sorted(sources.items(), key=lambda one: one[0][:7] == "nearest")]
    return "\n".join(lines)


def write_budget(folder: Path) -> None:
    """Writes budget.json. @raises ResultsError"""
    (folder / BUDGET).write_text(json.dumps(as_json(folder), indent=1) + "\n", encoding="utf-8")


def as_json(folder: Path) -> dict[str, object]:
    """Quantity -> value, whole error, parts (null: unknown) and their sources, in SI units."""
    values, found = summary_values(folder), {}
    for name, budget in budgets_of(folder).items():
        if name in values:
            parts = {part: budget.part(part) if part in budget.known else None for part in budget.NAMES}
            found[name] = {"value": values[name].mean, "unit": values[name].unit, "error": budget.total, "parts": parts}
            found[name]["sources"] = dict(budget.sources)
    return dict(found)
