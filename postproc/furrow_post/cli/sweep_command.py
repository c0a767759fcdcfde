# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post sweep: the curves of sweeps, or of folders with several runs, in one figure."""

from pathlib import Path

from ..sweep.sweep_files import Named, Wanted, evaluate, report_lines, write_sweep
from .comparing import folders, folders_argument, labelled, reference_options
from .parameters import Given, command, option, repeated, target_option


@command(
    folders_argument("folder of a sweep or of runs"),
    option("--against", help="what lies on the x axis (default: the first variable of the sweep, or the one condition that differs)"),
    *reference_options(),
    repeated("--measured", parse=labelled, help="CSV with columns named as in sweep.csv, or LABEL=FILE; may be repeated"),
    target_option("folder to write (default: the first one)"),
)
def sweep(given: Given) -> None:
    named = folders(given)
    wanted = Wanted(
        given.against,
        given.errors,
        given.formula,
        [Named(Path(file), label) for file, label in given.measured],
        given.extrapolate,
    )
    result = evaluate([Named(Path(folder), label) for folder, label in named], wanted)
    target: Path = given.output or Path(named[0].folder)
    files = write_sweep(result, target)
    print("\n".join(report_lines(result)))
    print(f"\n{target}: {', '.join(files)}")
