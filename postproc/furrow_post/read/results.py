# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading history.h5, the results file of a run (its layout: src/io/results/history_file.h), with the styles of the run.

The dataset /run/styles is JSON, an array in the order of the script: {"id", "group", "style", "kind", "options"}; the
page coupling/output/histories/fix_wheel_history.md has the kinds. Options are lists of numbers, booleans or texts, with defaults
filled in.
"""

import importlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Fields, Floats, Integers, Named, read_only
from ..errors import ResultsError
from ..json_text import parse_json
from .ground_kinds import TERRAINS
from .hdf5 import opened

# channel in files of earlier versions -> its name
FORMER_CHANNELS = {"sinkage": "hub_drop"}
HISTORY = "history.h5"
Option = float | int | bool | str  # of a style
REPEAT = "repeat the run, into a folder of its own"


def decoded(value: Any) -> str:
    """Text of an HDF5 attribute or scalar dataset, which h5py gives as bytes or str."""
    return value.decode() if isinstance(value, bytes) else str(value)


def require_layout(content: Any, file: Path) -> None:
    """Refuses files that an older Furrow wrote; content: an open history.h5 or terrain.h5.

    @raises ResultsError with the version that wrote the file
    """
    if "run" in content and "run/styles" not in content:
        run = content["run"].attrs
        version = decoded(run.get("version", "?"))
        started = decoded(run.get("started", "an unknown date"))
        raise ResultsError(
            f"{file}: was written by an older Furrow, version {version}, on {started}: it has no "
            "/run/styles. Read it with the furrow-post of the source tree that made the run, or "
            "repeat the run"
        )


def require_same_run(file: Path, history: Path) -> None:
    """@raises ResultsError where a terrain.h5 is not of the run whose history lies beside it"""
    if not history.is_file():
        return
    mine, theirs = read_effective_input(file), read_effective_input(history)
    if mine and theirs and mine != theirs:
        raise ResultsError(
            f"{file}: is of another run than {history.name} beside it: their inputs differ; {REPEAT}"
        )


def require_different(folders: Sequence[Path | str]) -> None:
    """@raises ResultsError where one results folder is named twice"""
    places = [Path(folder).resolve() for folder in folders]
    for folder, place in zip(folders, places):
        if places.count(place) > 1:
            raise ResultsError(f"{folder}: is given twice; name each results folder once")


MIRROR = np.array([1.0, -1.0, 1.0])  # of a half model in its plane of symmetry, y = 0


class Surface(NamedTuple):
    """A triangulated surface."""

    triangles: Integers  # (m, 3): nodes of each triangle
    x: Floats  # (n, 3) [m]

    @classmethod
    def together(cls, surfaces: Sequence["Surface"]) -> "Surface":
        """Joins several surfaces into one."""
        first = np.cumsum([0, *(len(one.x) for one in surfaces)])
        return cls(
            np.concatenate([one.triangles + n for one, n in zip(surfaces, first)]),
            np.concatenate([one.x for one in surfaces]),
        )

    def mirrored(self) -> "Surface":
        """Mirror image of the surface in y = 0."""
        # the other way round: normals stay outward
        return Surface(self.triangles[:, ::-1], self.x * MIRROR)


@dataclass
class Grains:
    """Spheres at one instant."""

    id: Integers  # (n)
    x: Floats  # (n, 3) [m]
    radius: Floats  # (n) [m]
    period: Floats  # (3) [m], 0 along an axis that is not periodic
    bed_level: float  # [m], NaN for a bed that was not measured
    # (n, 3) [J] xx, yy, zz of stress times volume by contacts between grains, tension positive
    virial: Floats | None = None

    def displacement_from(self, reference: "Grains") -> Floats:
        """(n, 3) [m]: matched by id, the shortest way round a periodic box; NaN without a match."""
        order = np.argsort(reference.id)
        place = np.searchsorted(reference.id, self.id, sorter=order).clip(max=len(order) - 1)
        match = order[place]
        moved = reference.nearest_image(self.x - reference.x[match])
        moved[reference.id[match] != self.id] = np.nan
        return moved

    def nearest_image(self, apart: Floats) -> Floats:
        """Distances (n, 3) [m] to the nearest image in a periodic box."""
        period = np.where(self.period > 0, self.period, np.inf)
        nearest: Floats = apart - self.period * np.round(apart / period)
        return nearest

    def image_of(self, surface: Surface) -> Surface:
        """Image among these grains of a body that goes round and round in a periodic box."""
        middle = np.mean(self.corners, axis=0)
        body = 0.5 * (surface.x.min(axis=0) + surface.x.max(axis=0))
        place = middle + self.nearest_image(body - middle)
        return surface._replace(x=surface.x + (place - body))

    def volume_above(self, z: float) -> Floats:
        """(n) [m3] of the spheres' parts above a plane."""
        height = np.clip(self.x[:, 2] - z, -self.radius, self.radius)
        volume: Floats = np.pi / 3 * (self.radius + height) ** 2 * (2 * self.radius - height)
        return volume

    @property
    def corners(self) -> tuple[Floats, Floats]:
        """Lowest and highest coordinates (3) of the spheres' surfaces [m]."""
        reach = self.radius[:, None]
        return (self.x - reach).min(axis=0), (self.x + reach).max(axis=0)


@dataclass(frozen=True)
class Style:
    """One fix or command of the script."""

    id: str
    style: str  # e.g. "terrain/continuum"
    kind: str  # kind of the fix for any style, e.g. "terrain"
    options: dict[str, list[Option]]  # keyword -> its values, SI units and degrees

    def has(self, keyword: str) -> bool:
        return keyword in self.options

    def values(self, keyword: str) -> list[Option]:
        """All values of a keyword. @raises ResultsError where the style has none"""
        if keyword not in self.options:
            raise ResultsError(
                f"{self.style} '{self.id}': the results have no value of '{keyword}'"
            )
        return self.options[keyword]

    def number(self, keyword: str, default: float | None = None) -> float:
        """The only value of a keyword. @raises ResultsError for a text, or without a default"""
        if default is not None and keyword not in self.options:
            return default
        value = self.values(keyword)[0]
        if isinstance(value, str):
            raise ResultsError(f"{self.style} '{self.id}': '{keyword}' is '{value}', not a number")
        return float(value)

    def text(self, keyword: str) -> str:
        return str(self.values(keyword)[0])

    def flag(self, keyword: str) -> bool:
        """Value of a yes/no keyword; no where it is not there."""
        return self.options.get(keyword, [False])[0] is True


def _style_of(entry: dict[str, Any]) -> Style:
    """@raises KeyError, TypeError, ValueError where the entry is no style"""
    identity, style, kind = names = [entry[key] for key in ("id", "style", "kind")]
    options = dict(entry["options"])
    for keyword, values in options.items():
        if not isinstance(values, list) or not values:
            raise ValueError(f"'{keyword}' of {style} has no values")
    if not all(isinstance(name, str) for name in names):
        raise TypeError(f"{names} are no texts")
    return Style(identity, style, kind, options)


class Styles:
    """The styles of a run in the order of its script."""

    def __init__(self, styles: Sequence[Style]) -> None:
        self._styles = tuple(styles)

    @classmethod
    def from_json(cls, text: str) -> "Styles":
        """@raises ValueError, KeyError, TypeError where the text is not such an array"""
        return cls([_style_of(entry) for entry in parse_json(text)])

    def of_kind(self, kind: str) -> Style | None:
        """The first of a kind, or None."""
        return next((style for style in self._styles if style.kind == kind), None)

    def terrain(self) -> Style | None:
        """The first line terrain/..., or None."""
        return next((style for style in self._styles if style.kind in TERRAINS), None)

    def of_style(self, name: str) -> Style | None:
        """The first of a style, or None."""
        return next((style for style in self._styles if style.style == name), None)


class Results:
    """One results folder, or the history.h5 in it.

    run: attributes of /run; columns, units, meanings: of every channel of the history.
    """

    def __init__(self, where: Path | str) -> None:
        """@raises ResultsError where there is no such file, or an older Furrow wrote it"""
        path = Path(where)
        self.file = path / HISTORY if path.is_dir() else path
        self.folder = self.file.parent
        if not self.file.is_file():
            raise ResultsError(
                f"{self.file}: no such file; name the results folder of a run, or its history.h5"
            )
        with opened(self.file) as content:
            require_layout(content, self.file)
            self._read(content)
        _require_history(self.columns, self.file)

    def _read(self, content: Any) -> None:
        self.run = {name: decoded(value) for name, value in content["run"].attrs.items()}
        columns: dict[str, Floats] = {}
        self.units: Named[str] = Named(self.file, {}, REPEAT)
        self.meanings: Named[str] = Named(self.file, {}, REPEAT)
        for stored, data in content["history"].items():
            name = FORMER_CHANNELS.get(stored, stored)
            columns[name] = data[()]
            for attribute in ("unit", "meaning"):
                if attribute not in data.attrs:
                    raise ResultsError(f"{self.file}: {data.name} has no {attribute}; {REPEAT}")
            self.units[name] = decoded(data.attrs["unit"])
            self.meanings[name] = decoded(data.attrs["meaning"])
        self.columns = Fields(self.file, columns, REPEAT)

    @property
    def title(self) -> str:
        return self.run.get("title") or self.folder.resolve().name

    @property
    def channels(self) -> Any:
        """The history as a data frame of pandas, a row for each time; units in .attrs["units"].

        @raises ResultsError without pandas; columns has the same in arrays of numpy
        """
        try:
            pandas = importlib.import_module("pandas")  # nothing else needs it
        except ImportError:
            raise ResultsError(
                "channels needs pandas; install Debian's python3-pandas, or use .columns, which has "
                "the same in arrays of numpy"
            ) from None
        frame = pandas.DataFrame(dict(self.columns))
        frame.attrs.update(units=dict(self.units), meanings=dict(self.meanings))
        return frame

    @property
    def has_grains(self) -> bool:
        """True where the run kept grains; continuum terrain has its own file, terrain.h5."""
        with opened(self.file) as content:
            return "grains/final" in content

    @property
    def effective_input(self) -> str:
        """Text of the styles with their values, and of the script."""
        return read_effective_input(self.file)

    @property
    def cost(self) -> dict[str, float]:
        """Attributes of /cost: wall_time [s], ranks, ...; empty for a run that did not end."""
        with opened(self.file) as content:
            attributes: Any = content["cost"].attrs if "cost" in content else {}
            return {name: float(value) for name, value in attributes.items()}

    def styles(self) -> Styles:
        """@raises ResultsError where /run/styles is not what a writer puts there"""
        with opened(self.file) as content:
            text = decoded(content["run/styles"][()])
        try:
            return Styles.from_json(text)
        except (ValueError, KeyError, TypeError) as error:
            raise ResultsError(f"{self.file}: /run/styles cannot be read ({error})") from error

    def grains(self, when: str) -> Grains:
        """when: "reference" (the settled bed) or "final". @raises ResultsError without them"""
        with opened(self.file) as content:
            group = content.get(f"grains/{when}")
            if group is None:
                raise ResultsError(
                    f"{self.file}: has no /grains/{when}; a picture needs the grains of a run that "
                    "came to its end"
                )
            number, x, radius = (group[name][()] for name in ("id", "x", "radius"))
            columns = {"id": number, "x": x, "radius": radius}
            if "virial" in group:
                columns["virial"] = group["virial"][()]
            fields = Fields(self.file, columns, REPEAT)
            fields.require_rows()
            fields.require_finite(*(name for name in columns if name != "id"))
            period, level = group["period"][()], float(group.attrs["bed_level"])
            return Grains(number, x, radius, period, level, columns.get("virial"))

    def surface(self) -> Surface | None:
        """The wheel, tyre or plate at the end, or None where the run kept none."""
        return read_surface(self.file)


def read_effective_input(file: Path) -> str:
    """Effective input of a history.h5; empty where it has none. @raises ResultsError where the file is damaged"""
    with opened(file) as content:
        text = content.get("run/effective_input")
        return "" if text is None else decoded(text[()])


def read_surface(file: Path) -> Surface | None:
    """The surface of a body at the end of a run, or None where it kept none or there is no file.

    @raises ResultsError where the file is damaged
    """
    if not file.is_file():
        return None
    with opened(file) as content:
        group = content.get("surface")
        if group is None:
            return None
        triangles, x = read_only(group["triangles"][()]), read_only(group["x"][()])
        return _require_surface(Surface(triangles, x), file)


def _require_history(columns: Fields, file: Path) -> None:
    """@raises ResultsError for a history without rows, of unequal columns, or back in time"""
    for name, values in columns.items():
        if values.ndim != 1 or values.dtype.kind not in "fiu":
            raise ResultsError(f"{file}: channel '{name}' is no row of numbers; {REPEAT}")
    if columns.require_rows() < 2:
        raise ResultsError(
            f"{file}: its history has fewer than two rows; run longer, or write it more often "
            "('every')"
        )
    time = columns["time"]
    wrong = np.flatnonzero(~(np.diff(time) > 0))
    if len(wrong):
        row = int(wrong[0]) + 1
        raise ResultsError(
            f"{file}: time does not run forwards: row {row + 1} of the history is at "
            f"{time[row]:g} s, after {time[row - 1]:g} s; two runs wrote into one folder, or the "
            f"file is damaged: {REPEAT}"
        )
    columns.require_finite(*columns)


def _require_surface(surface: Surface, file: Path) -> Surface:
    """@raises ResultsError for triangles of nodes that are not there"""
    triangles, x = surface
    if (
        (triangles.ndim, triangles.shape[-1], x.ndim, x.shape[-1]) != (2, 3, 2, 3)
        or not np.isfinite(x).all()
        or not ((triangles >= 0) & (triangles < len(x))).all()
    ):
        raise ResultsError(f"{file}: /surface has triangles without nodes; {REPEAT}")
    return surface
