# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures, plots, tables and studies from the results of Furrow.

Folders, each of which imports only from those to its left: run (what makes and records runs), read
(files), study (runs and values of studies), uncertainty (the error of a number), laws (formulas, and fits of
parameters), analyse (readings of runs), laboratory (tests on samples), figures, sweep (curves over a
variable), scene (the command inputs/run), soil (soil cards), tables (what studies make of their runs),
surrogate (fast models), cli (the command furrow-post). Steady values and their standard errors come from the program
furrow-resistance, never from here.
"""

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas

    from .read.results import Results

__version__ = "0.2.0"  # of the whole project: pyproject.toml and CMakeLists.txt read this line

# Checked before any module imports them; programs that need them import this package first.
_absent = [name for name in ("numpy", "click", "h5py", "jinja2", "matplotlib", "pandas", "scipy", "yaml") if not find_spec(name)]
if _absent:
    raise ImportError(
        f"furrow_post: {sys.executable} has no {', '.join(_absent)}; write 'apt install "
        f"{' '.join('python3-' + name for name in _absent)}' and use Debian's /usr/bin/python3, "
        "or 'pip install ./postproc'"
    )


def load(where: "Path | str") -> "Results":
    """A results folder, or its history.h5: load("results/x").channels is its history.

    @raises ResultsError where there is no such file, or it is damaged
    """
    from .read.results import Results  # a command that reads nothing does not wait for h5py

    return Results(where)


def answer(size: str, **options: Any) -> "pandas.DataFrame":
    """The command 'furrow-post answer' and its table: value, whole error and the band of the formulas by quantity.

    answer("265/70R17", load=6000, pressure=200, soil="sand", cone_index=150, slip=0.2): options are those of the command,
    in N and kPa; quick=True is --quick. Forces are over the load, depths in m.
    @raises ResultsError where an option is wrong or the run fails
    """
    import pandas

    from .cli.answer_command import TABLE, default_folder
    from .cli.run_commands import post
    from .errors import ResultsError

    folder = Path(options.setdefault("output", default_folder()))
    words = [
        word
        for name, value in options.items()
        if value is not False
        for word in (f"--{name.replace('_', '-')}", value)
        if word is not True
    ]
    if status := post("answer", size, *words):
        raise ResultsError(f"furrow-post answer ended with status {status}; its error is above")
    return pandas.read_csv(folder / TABLE, index_col="quantity")
