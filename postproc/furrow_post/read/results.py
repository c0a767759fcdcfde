# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading history.h5, the results file of a run (its layout is written down in src/io/history_file.h)."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np


class ResultsError(Exception):
    """Something asked for is not in the results; the message names file and remedy."""


@dataclass
class Grains:
    """Spheres at one instant: id (n), x (n, 3) [m], radius (n) [m], period (3) [m], bed_level [m] or NaN."""

    id: np.ndarray
    x: np.ndarray
    radius: np.ndarray
    period: np.ndarray
    bed_level: float

    def displacement_from(self, reference):
        """(n, 3) [m]: matched by id, the shortest way round a periodic box; NaN where the reference lacks the grain."""
        order = np.argsort(reference.id)
        place = np.searchsorted(reference.id, self.id, sorter=order).clip(max=len(order) - 1)
        match = order[place]
        moved = self.x - reference.x[match]
        for axis in range(3):
            period = reference.period[axis]
            if period > 0:
                moved[:, axis] -= period * np.round(moved[:, axis] / period)
        moved[reference.id[match] != self.id] = np.nan
        return moved


class Results:
    """One results folder, or the history.h5 in it."""

    def __init__(self, where):
        path = Path(where)
        self.file = path / "history.h5" if path.is_dir() else path
        self.folder = self.file.parent
        if not self.file.is_file():
            raise ResultsError(f"{self.file}: no such file; name the results folder of a run, or its history.h5")
        try:
            with h5py.File(self.file, "r") as content:
                self._read(content)
        except (OSError, KeyError) as error:
            raise ResultsError(f"{self.file}: is not a results file of Furrow ({error})") from error

    def _read(self, content):
        self.run = {name: self._text(value) for name, value in content["run"].attrs.items()}
        self.columns = {name: data[()] for name, data in content["history"].items()}
        self.units = {name: self._text(data.attrs["unit"]) for name, data in content["history"].items()}
        self.meanings = {name: self._text(data.attrs["meaning"]) for name, data in content["history"].items()}

    @staticmethod
    def _text(value):
        return value.decode() if isinstance(value, bytes) else value

    @property
    def title(self):
        return self.run.get("title") or self.folder.resolve().name

    @property
    def has_grains(self):
        """Whether the run kept grains; continuum ground has its own file, ground.h5."""
        with h5py.File(self.file, "r") as content:
            return "grains/final" in content

    def grains(self, when):
        """when: "reference" (the settled bed) or "final"."""
        with h5py.File(self.file, "r") as content:
            group = content.get(f"grains/{when}")
            if group is None:
                raise ResultsError(f"{self.file}: has no /grains/{when}; a picture needs the grains of a run that came to its end")
            return Grains(group["id"][()], group["x"][()], group["radius"][()], group["period"][()],
                          float(group.attrs["bed_level"]))

    def surface(self):
        """(triangles (m, 3), x (n, 3) [m]) of the wheel or tyre at the end, or None where the run kept none."""
        with h5py.File(self.file, "r") as content:
            group = content.get("surface")
            return None if group is None else (group["triangles"][()], group["x"][()])
