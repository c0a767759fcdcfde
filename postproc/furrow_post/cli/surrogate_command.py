# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post surrogate: fits Gaussian processes to sweeps, and predicts with them."""

from collections.abc import Mapping, Sequence
from datetime import datetime, timezone
from pathlib import Path

from ..arguments import path
from ..errors import ResultsError
from ..formatting import in_unit, with_error
from ..run.record import FINISHED, read_record
from ..csv_table import in_columns
from ..surrogate.surrogate_figures import draw_held_out
from ..surrogate.gaussian_process import Z_95, HeldOut
from ..surrogate.model import Surrogate, fit, read_surrogate
from ..surrogate.training import PULL, QUANTITIES, RADIUS, TORQUE, Training, read_training
from .parameters import Given, argument, assignments, command, target_option


@command(
    argument("sources", "folders of sweeps or their sweep.csv; or a surrogate, with --at", path, nargs=-1, required=True),
    target_option("file to write, .json (default: surrogate.json in the first folder)"),
    assignments("--at", "predicts here: all inputs of the surrogate"),
)
def surrogate_(given: Given) -> None:
    sources: Sequence[Path] = given.sources
    if sources[0].suffix == ".json":
        if given.output or len(sources) > 1 or not given.at:
            raise ResultsError(
                f"{sources[0]}: is a surrogate; give it alone, with --at NAME=NUMBER ..."
            )
        surrogate = read_surrogate(sources[0])
    else:
        surrogate = _fit(sources, given.output)
    if given.at:
        print("\n".join(_prediction(surrogate, dict(given.at))))


def _fit(sources: Sequence[Path], output: Path | None) -> Surrogate:
    folder = sources[0] if sources[0].is_dir() else sources[0].parent
    target = output or folder / "surrogate.json"
    if target.suffix != ".json":
        raise ResultsError(f"-o {target}: the name of a surrogate ends in .json")
    training = read_training(sources)
    surrogate, held_out = fit(training, _origin(sources))
    target.parent.mkdir(parents=True, exist_ok=True)
    surrogate.write(target)
    draw_held_out(training.quantities, held_out, target.with_suffix(".png"))
    print("\n".join(_report(surrogate, training, held_out)))
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


def _report(surrogate: Surrogate, training: Training, held_out: Mapping[str, HeldOut]) -> list[str]:
    rows = [["quantity", "rms error", "of spread", "inside 95 % band"]]
    for name, held in held_out.items():
        rows.append(
            [
                f"{name}{in_unit(QUANTITIES[name])}",
                f"{held.rms_error:.2g}",
                f"{100 * held.rms_error / held.spread:.1f} %",
                f"{100 * held.coverage:.1f} %",
            ]
        )
    ranges = [
        [one.name, f"{one.low:g} to {one.high:g} {one.unit}".strip()] for one in surrogate.inputs
    ]
    lines = [f"{len(training.inputs)} runs, held out in ten parts"]
    if training.left_out:
        lines.append(f"{training.left_out} runs have no steady values and are left out")
    return [*lines, "", *in_columns(rows), "", *in_columns([["input", "range"], *ranges])]


def _prediction(surrogate: Surrogate, at: Mapping[str, float]) -> list[str]:
    """With 95 % bands, also of pull and torque of this load."""
    surrogate.require(at)
    x = surrogate.scaled(at).reshape(1, -1)
    rows = [["quantity", "value ± 95 % band"]]
    load = at.get("load", surrogate.constants.get("load"))
    for name, process in surrogate.processes.items():
        mean, deviation = (float(part[0]) for part in process.predict(x))
        rows.append([f"{name}{in_unit(QUANTITIES[name])}", with_error(mean, Z_95 * deviation)])
        forces = {
            PULL: ("drawbar_pull [N]", 1.0),
            TORQUE: ("drive_torque [N m]", surrogate.constants[RADIUS]),
        }
        if name in forces and load:
            label, lever = forces[name]
            rows.append([label, with_error(lever * load * mean, lever * load * Z_95 * deviation)])
    return in_columns(rows)
