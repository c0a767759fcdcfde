# SPDX-License-Identifier: GPL-2.0-or-later
"""How far a list of runs is: a line per run, and on a terminal one line over all with the time left."""

import re
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from ..formatting import duration
from .process import ERRORS, SCREEN, show_line
from .record import Record

DONE = re.compile(rb"^\[[^\]]*\]\s+([\d.]+) %", re.MULTILINE)  # line of fix progress
TAIL = 4096  # [bytes] of a run's output that are looked at


class Progress:
    """Progress of so many runs, some at a time. The time left is estimated from the runs before; until
    the first has ended, from the share that those running have done.

    watch: the programs' own lines go to the screen instead, with their own estimate
    """

    def __init__(self, runs: int, jobs: int, watch: bool = False) -> None:
        self.watch = watch
        self.runs, self.jobs, self.done, self.failed = runs, jobs, 0, 0
        self.wall_time = 0.0  # of all that are done [s]
        self._began: dict[Path, float] = {}  # folder of a run -> when it was first seen
        self._shown = ""
        self._terminal = sys.stdout.isatty()

    def printer(self, name: str) -> Callable[[str], None] | None:
        """Receiver of a run's lines for the screen; several runs have their names before them."""
        label = f"{name}: " if self.runs > 1 else ""
        return (lambda line: show_line(label + line)) if self.watch else None

    def report(self, name: str, folder: Path, record: Record) -> None:
        """Shows the end of a run."""
        if self.watch:
            if record.error:
                _show_end(folder)
            return
        self.done += 1
        self.failed += bool(record.error)
        self.wall_time += record.wall_time
        left = self.runs - self.done
        seconds = self.wall_time / self.done * left / min(self.jobs, max(left, 1))
        rest = f", about {duration(seconds)} left" if left else ""
        self.clear()
        print(
            f"{time.strftime('%H:%M:%S')}  {name:34} {record.wall_time:7.1f} s wall "
            f"{record.cpu_time:7.1f} s user  ({self.done} of {self.runs}{rest})"
            f"{'  ' + record.error if record.error else ''}",
            flush=True,
        )

    def show(self, running: Sequence[Path]) -> None:
        """The line over all, on a terminal; running: folders of runs."""
        now = time.monotonic()
        self._began = {folder: self._began.get(folder, now) for folder in running}
        if not self._terminal or self.watch:
            return
        self.clear()
        if running:
            self._shown = self.line([(now - self._began[f], share_done(f)) for f in running])
            print(self._shown, end="", flush=True)

    def line(self, running: Sequence[tuple[float, float]]) -> str:
        """running: time so far [s] and share done of each run."""
        shares = ", ".join(f"{100 * share:.0f} %" for _, share in running)
        failed = f", {self.failed} failed" if self.failed else ""
        seconds = self._time_left(running)
        left = f", about {duration(seconds)} left" if seconds is not None else ""
        return f"{self.done} of {self.runs} done{failed}, {len(running)} running ({shares}){left}"

    def _time_left(self, running: Sequence[tuple[float, float]]) -> float | None:
        """[s], None where nothing is known yet."""
        if self.done:
            each = self.wall_time / self.done
        else:
            expected = [elapsed / share for elapsed, share in running if share > 0.02]
            if not expected:
                return None
            each = max(expected)
        waiting = self.runs - self.done - len(running)
        of_running = sum(max(each - elapsed, 0.0) for elapsed, _ in running)
        return (of_running + waiting * each) / max(min(self.jobs, len(running) + waiting), 1)

    def clear(self) -> None:
        """Removes the line of progress from the screen."""
        if self._shown:
            print(f"\r{' ' * len(self._shown)}\r", end="", flush=True)
            self._shown = ""


def _show_end(folder: Path) -> None:
    print(f"The run stopped; the last lines of {folder / SCREEN}:", file=sys.stderr)
    for file in (folder / SCREEN, folder / ERRORS):
        lines = file.read_text(errors="replace").splitlines() if file.is_file() else []
        sys.stderr.writelines(f"{line}\n" for line in lines[-5:])


def share_done(folder: Path) -> float:
    """Share that a run has done, from the last line of fix progress in its folder; 0: not known."""
    try:
        with open(folder / SCREEN, "rb") as file:
            file.seek(max(file.seek(0, 2) - TAIL, 0))
            found: list[bytes] = DONE.findall(file.read())
    except OSError:
        return 0.0
    return min(float(found[-1]) / 100, 1.0) if found else 0.0
