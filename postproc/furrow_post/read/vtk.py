# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading the frames of a run: .pvd collections and .vtp files as src/io/formats/vtk_file.h writes them.

Python's VTK would read any .vtp; this needs numpy alone, and reads what Furrow writes: appended raw
data in blocks of zlib.
"""

import xml.etree.ElementTree as ET
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Floats, Integers
from ..errors import ResultsError, content_of

REMEDY = "repeat the run, or remove its folder vtk"
TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "<u1"}
APPENDED = b'<AppendedData encoding="raw">'


@dataclass(frozen=True)
class Frames:
    """Frames of a body or of grains in the order of time: times[k] [s] belongs to files[k]."""

    times: Floats
    files: tuple[Path, ...]

    def at(self, time: float) -> int:
        """The last frame that is no later, or the first."""
        return max(int(np.searchsorted(self.times, time * (1 + 1e-12), side="right")) - 1, 0)


@dataclass(frozen=True)
class PolyData:
    """Points, triangles between them, and named values at the points."""

    x: Floats  # (n, 3)
    triangles: Integers  # (m, 3), empty for points alone
    fields: dict[str, Any]  # name -> (n) or (n, 3)


def read_frames(collection: Path) -> Frames | None:
    """The frames that a .pvd lists; None where there is no such file, or it lists none.

    @raises ResultsError for a file that is no collection
    """
    if not collection.is_file():
        return None
    with _content_of(collection):
        entries = list(ET.parse(collection).getroot().iter("DataSet"))
        times = np.array([float(entry.attrib["timestep"]) for entry in entries])
        files = tuple(collection.parent / entry.attrib["file"] for entry in entries)
    outside = [file for file in files if not file.resolve().is_relative_to(collection.parent.resolve())]
    if outside:
        raise ResultsError(f"{collection}: names {outside[0]}, outside of its folder; {REMEDY}")
    return Frames(times, files) if files else None


def read_vtp(file: Path) -> PolyData:
    """@raises ResultsError for a file that Furrow has not written, or that is damaged"""
    with _content_of(file):
        content = file.read_bytes()
        head, mark, tail = content.partition(APPENDED)
        if not mark:
            raise ValueError("it has no appended raw data")
        root = ET.fromstring(head + mark + b"</AppendedData></VTKFile>")
        if root.attrib.get("compressor") != "vtkZLibDataCompressor":
            raise ValueError("it is not compressed by zlib")
        start = len(content) - len(tail) + tail.index(b"_") + 1
        word = np.dtype("<u8" if root.attrib.get("header_type") == "UInt64" else "<u4")

        def array(element: ET.Element) -> Any:
            values = np.frombuffer(
                _unpacked(content, start + int(element.attrib["offset"]), word),
                TYPES[element.attrib["type"]],
            )
            width = int(element.attrib.get("NumberOfComponents", 1))
            return values.reshape(-1, width) if width > 1 else values

        piece = next(root.iter("Piece"))
        named = {
            group: {e.attrib["Name"]: e for e in piece.findall(f"{group}/DataArray")}
            for group in ("PointData", "Points", "Polys")
        }
        x: Floats = np.asarray(array(named["Points"]["Points"]), float).reshape(-1, 3)
        triangles: Integers = np.asarray(array(named["Polys"]["connectivity"]), np.int64)
        fields = {name: array(element) for name, element in named["PointData"].items()}
        for name, values in fields.items():
            if len(values) != len(x):
                raise ValueError(f"'{name}' has {len(values)} values for {len(x)} points")
        return PolyData(x, triangles.reshape(-1, 3), fields)


def _unpacked(content: bytes, place: int, word: np.dtype[Any]) -> bytes:
    """Unpacks blocks of zlib: number, size, size of the last, packed sizes, data."""
    blocks = int(np.frombuffer(content, word, 1, place)[0])
    sizes = np.frombuffer(content, word, blocks, place + 3 * word.itemsize)
    place += (3 + blocks) * word.itemsize
    parts = []
    for size in sizes.tolist():
        parts.append(zlib.decompress(content[place : place + size]))
        place += size
    return b"".join(parts)


@contextmanager
def _content_of(file: Path) -> Iterator[None]:
    """Calls content_of() and converts errors of the parsers of XML and zlib too."""
    try:
        with content_of(file, REMEDY):
            yield
    except (ET.ParseError, zlib.error) as error:
        raise ResultsError(f"{file}: is damaged ({error}); {REMEDY}") from error
