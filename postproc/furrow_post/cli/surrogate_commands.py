# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands surrogate, a fast model from sweeps; map, on a terrain raster; slopes, slip over slope; fit soil, from wheel tests."""

import math
import time
from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime, timezone
from pathlib import Path

import numpy as np

from ..arguments import WrongText, between, path, positive, series
from ..arrays import Booleans, Floats
from ..csv_table import in_columns, write_rows
from ..errors import ResultsError
from ..formatting import in_unit, with_error
from ..run.record import FINISHED, read_record
from ..surrogate.gaussian_process import Z_95, HeldOut
from ..surrogate.mobility import Vehicle
from ..surrogate.model import Surrogate, fit, read_surrogate
from ..surrogate.posterior import identify, read_tests
from ..surrogate.raster import read_raster, read_slope
from ..surrogate.slopes import draw_slopes, limits, slip_over_slope, write_slopes
from ..surrogate.surrogate_figures import draw_held_out, draw_posterior
from ..surrogate.terrain_map import GO, NO_GO, UNCERTAIN, make_map, read_classes, write_map, write_mobility_table
from ..surrogate.two_fidelities import Gain
from ..surrogate.training import PULL, QUANTITIES, RADIUS, TORQUE, Training, read_training
from .parameters import Given, argument, assignments, command, option, repeated, require_file, target_option

CHOSEN = ("slip", "load", "slope")  # inputs that the map chooses
SHARES = (0.95, 0.5, 0.05)  # probabilities of climbing
QUANTILES = (2.5, 50.0, 97.5)


@command(
    argument("sources", "folders of sweeps or their sweep.csv; or a surrogate, with --at", path, nargs=-1, required=True),
    repeated("--better", parse=path, metavar="PATH", help="the same of few runs on a better ground, which correct the others"),
    target_option("file to write, .json (default: surrogate.json in the first folder)"),
    assignments("--at", "predicts here: all inputs of the surrogate"),
)
def surrogate_(given: Given) -> None:
    sources: Sequence[Path] = given.sources
    if sources[0].suffix == ".json":
        if given.output or given.better or len(sources) > 1 or not given.at:
            raise ResultsError(f"{sources[0]}: is a surrogate; give it alone, with --at NAME=NUMBER ...")
        surrogate = read_surrogate(sources[0])
    else:
        surrogate = _fit(sources, given.better, given.output)
    if given.at:
        print("\n".join(_prediction(surrogate, dict(given.at))))


def _fit(sources: Sequence[Path], better_sources: Sequence[Path], output: Path | None) -> Surrogate:
    folder = sources[0] if sources[0].is_dir() else sources[0].parent
    target = output or folder / "surrogate.json"
    training = read_training(sources)
    require_file(target, "json", make_folder=True)
    better = read_training(better_sources) if better_sources else None
    surrogate, held_out, gains = fit(training, _origin([*sources, *better_sources]), better)
    surrogate.write(target)
    draw_held_out((better or training).quantities, held_out, target.with_suffix(".png"))
    print("\n".join([*_report(surrogate, training, better, held_out), *_gains(held_out, gains)]))
    print(f"\n{target}, {target.with_suffix('.png').name}")
    return surrogate


def _origin(sources: Sequence[Path]) -> dict[str, str]:
    files = (file for source in sources for file in source.glob(f"*/{FINISHED}"))
    commits = {record.commit for record in map(read_record, files) if record}
    return {
        "source": ", ".join(source.name for source in sources),
        "commit": " ".join(sorted(commits)),
        "fitted": datetime.now(timezone.utc).strftime("%Y-%m-%d"),
    }


def _report(
    surrogate: Surrogate, training: Training, better: Training | None, held_out: Mapping[str, HeldOut]
) -> list[str]:
    rows = [["quantity", "rms error", "of spread", "inside 95 % band"]]
    for name, held in held_out.items():
        percents = [f"{100 * share:.1f} %" for share in (held.rms_error / held.spread, held.coverage)]
        rows.append([name + in_unit(QUANTITIES[name]), f"{held.rms_error:.2g}", *percents])
    ranges = [[one.name, f"{one.low:g} to {one.high:g} {one.unit}".strip()] for one in surrogate.inputs]
    how = f"corrected by {len(better.inputs)} better ones, each held out" if better else "held out in ten parts"
    lines = [f"{len(training.inputs)} runs, {how}"]
    if training.left_out:
        lines.append(f"{training.left_out} runs have no steady values and are left out")
    return [*lines, "", *in_columns(rows), "", *in_columns([["input", "range"], *ranges])]


def _gains(held_out: Mapping[str, HeldOut], gains: Mapping[str, Gain]) -> list[str]:
    if not gains:
        return []
    rows = [["rms error at the better runs", "fast alone", "better alone", "both"]]
    for name, gain in gains.items():
        errors = (gain.fast, gain.better, held_out[name].rms_error)
        rows.append([name + in_unit(QUANTITIES[name]), *(f"{error:.2g}" for error in errors)])
    return ["", *in_columns(rows)]


def _prediction(surrogate: Surrogate, at: Mapping[str, float]) -> list[str]:
    """Lines of a prediction with 95 % bands, including pull and torque at this load."""
    surrogate.require(at)
    x = surrogate.scaled(at).reshape(1, -1)
    rows = [["quantity", "value ± 95 % band"]]
    load = at.get("load", surrogate.constants.get("load"))
    forces = {PULL: ("drawbar_pull [N]", 1.0), TORQUE: ("drive_torque [N m]", surrogate.constants[RADIUS])}
    for name, process in surrogate.processes.items():
        mean, deviation = (float(part[0]) for part in process.predict(x))
        rows.append([f"{name}{in_unit(QUANTITIES[name])}", with_error(mean, Z_95 * deviation)])
        if name in forces and load:
            label, lever = forces[name]
            rows.append([label, with_error(lever * load * mean, lever * load * Z_95 * deviation)])
    return in_columns(rows)


def _raster(text: str) -> tuple[str, Path]:
    name, equals, file = text.partition("=")
    if not name or not equals:
        raise WrongText(f"'{text}' is not NAME=FILE, e.g. phi=phi.tif")
    return name, path(file)


@command(
    argument("surrogate", "file of furrow-post surrogate", path),
    argument("elevation", "elevation model, any raster that GDAL reads; in metres, or with its unit in the file", path),
    target_option("folder to write: map.tif, map.png, mobility.csv", required=True),
    repeated("--raster", parse=_raster, metavar="NAME=FILE", help="raster of a soil parameter; may be repeated"),
    option("--classes", nargs=2, parse=path, metavar="RASTER TABLE", help="raster of soil classes, and a CSV with their parameters"),
    assignments("--set", "soil parameters of all cells"),
    option("--load", parse=positive, help="N, weight on the wheel (default: that of the training runs)"),
    option("--speed", parse=positive, help="m/s, wanted (default: that of the training runs)"),
    option("--power", parse=positive, default=math.inf, help="W per wheel, limits speed and pull"),
    option("--confidence", parse=between(0.5, 1.0), default=0.95, help="probability that a go needs (default 0.95)"),
)
def map_(given: Given) -> None:
    begin = time.perf_counter()
    surrogate = read_surrogate(given.surrogate)
    vehicle = _vehicle(surrogate, given.load, given.speed, given.power)
    slope = read_slope(given.elevation)
    rasters: dict[str, Floats] = {}
    for name, file in given.raster:
        raster = read_raster(file)
        slope.require_same(raster, str(file))
        rasters[name] = raster.values
    constants = dict(given.set)
    of_classes = [name for name in _parameters(surrogate) if name not in rasters and name not in constants]
    _require_known(surrogate, (*rasters, *constants))
    fixed: list[tuple[Booleans | None, Mapping[str, float]]] = [(None, constants)]
    soils: dict[str, Mapping[str, float]] = {"all": constants}
    if given.classes:
        classes = read_raster(given.classes[0])
        slope.require_same(classes, str(given.classes[0]))
        found = read_classes(given.classes[1], of_classes)
        soils = {str(key): {**constants, **parameters} for key, parameters in found.items()}
        fixed = [(classes.values == int(key), parameters) for key, parameters in soils.items()]
    elif of_classes:
        raise ResultsError(
            f"no soil parameter {', '.join(of_classes)}; give it by --set NAME=NUMBER, --raster or --classes"
        )
    for parameters in soils.values():
        for name, value in parameters.items():
            surrogate.require_range(name, value)
    result = make_map(surrogate, vehicle, slope, rasters, fixed, given.confidence)
    files = write_map(result, slope, given.output)
    if not rasters:
        write_mobility_table(given.output / "mobility.csv", surrogate, vehicle, soils)
        files.append("mobility.csv")
    for name, value in (("go", GO), ("uncertain", UNCERTAIN), ("no-go", NO_GO)):
        print(f"{name:10} {100 * np.mean(result.verdict == value):6.1f} % of the cells")
    print("\n".join(result.notes))
    print(f"\n{given.output}: {', '.join(files)}; {slope.values.size} cells in {time.perf_counter() - begin:.1f} s")


def _parameters(surrogate: Surrogate) -> list[str]:
    """Inputs of the soil."""
    return [name for name in surrogate.names if name not in CHOSEN]


def _require_known(surrogate: Surrogate, names: Iterable[str]) -> None:
    """@raises ResultsError for a name that is no soil parameter"""
    known = _parameters(surrogate)
    for name in names:
        if name not in known:
            raise ResultsError(f"the surrogate has no soil parameter '{name}'; it has {', '.join(known) or 'none'}")


def _vehicle(surrogate: Surrogate, load: float | None, speed: float | None, power: float = math.inf) -> Vehicle:
    """Those that are not given: of the training runs. @raises ResultsError where the surrogate does not fit"""
    if "slip" not in surrogate.names:
        raise ResultsError("this needs a surrogate over slip; sweep slip too")
    constants = surrogate.constants
    load, speed = load or constants.get("load"), speed or constants.get("speed")
    if load is None or speed is None:
        raise ResultsError("the surrogate has no single load and speed; give --load and --speed")
    if "load" not in surrogate.names and load != constants.get("load"):
        known = f"a load of {constants['load']:g} N only" if "load" in constants else "loads that follow another input"
        raise ResultsError(f"--load {load:g}: the surrogate knows {known}; sweep load too")
    return Vehicle(load, speed, power)


@command(
    argument("surrogate", "file of furrow-post surrogate", path),
    option("--slope", parse=series(51), default="0:25", metavar="FIRST:LAST", show_default=True, help="degrees; FIRST:LAST:COUNT or a list too"),
    option("--load", parse=series(4), metavar="FIRST:LAST:COUNT", help="N on level ground, or a list (default: that of the training runs)"),
    assignments("--set", "soil parameters"),
    target_option("folder to write: slopes.csv, slopes.png", required=True),
)
def slopes(given: Given) -> None:
    surrogate = read_surrogate(given.surrogate)
    soil = dict(given.set)
    _require_known(surrogate, soil)
    for name in _parameters(surrogate):
        if name not in soil:
            raise ResultsError(f"no soil parameter {name}; give it by --set {name}=NUMBER")
        surrogate.require_range(name, soil[name])
    slope = np.array(given.slope)
    # The balance has no speed in it
    vehicles = [_vehicle(surrogate, load, surrogate.constants.get("speed", 1.0)) for load in given.load or (None,)]
    found = [slip_over_slope(surrogate, vehicle, slope, soil) for vehicle in vehicles]
    curves = [curve for curve in found if len(curve)]
    if not curves:
        one = surrogate.inputs[surrogate.names.index("load" if "load" in surrogate.names else "slope")]
        raise ResultsError(f"no slope and load lie inside the training range: {one.name} {one.low:g} to {one.high:g} {one.unit}")
    folder: Path = given.output
    folder.mkdir(parents=True, exist_ok=True)
    write_slopes(curves, surrogate, folder / "slopes.csv")
    draw_slopes(curves, surrogate, folder / "slopes.png")
    rows = [[f"{curve['load_N'].iloc[0]:.4g}", *limits(curve, SHARES)] for curve in curves]
    print("\n".join(in_columns([["load [N]", *(f"climbs at {100 * share:.0f} % [degrees]" for share in SHARES)], *rows])))
    missing = len(vehicles) * len(slope) - sum(map(len, curves))
    if missing:
        print(f"{missing} slopes and loads lie outside of the training ranges and are left out")
    print(f"\n{folder}: slopes.csv, slopes.png")


@command(
    argument("surrogate", "file of furrow-post surrogate", path),
    argument("tests", "CSV: inputs, quantities and their errors of wheel tests on one soil", path),
    assignments("--set", "inputs that are known in all tests"),
    target_option("folder to write: posterior.csv, posterior.png", required=True),
)
def fit_soil(given: Given) -> None:
    surrogate = read_surrogate(given.surrogate)
    posterior = identify(surrogate, read_tests(given.tests, surrogate, dict(given.set)))
    rows = [["parameter", "median", "95 % interval", "width over prior"]]
    for name, samples, ratio in zip(posterior.names, posterior.samples.T, posterior.ratio):
        unit = surrogate.inputs[surrogate.names.index(name)].unit
        low, median, high = np.percentile(samples, QUANTILES)
        rows.append([f"{name}{in_unit(unit)}", f"{median:.4g}", f"{low:.4g} to {high:.4g}", f"{ratio:.2f}"])
    folder: Path = given.output
    folder.mkdir(parents=True, exist_ok=True)
    thinned = posterior.samples[:: max(1, len(posterior.samples) // 2000)]
    write_rows(
        folder / "posterior.csv",
        [dict(zip(posterior.names, map("{:.6g}".format, sample))) for sample in thinned],
        ("# Samples of the posterior of furrow-post fit soil, in the units of the surrogate.",),
    )
    draw_posterior(posterior, surrogate, folder / "posterior.png")
    print("\n".join([*in_columns(rows), "", *posterior.remarks(), f"R-hat {posterior.rhat:.3f}"]))
    print(f"\n{folder}: posterior.csv, posterior.png")
