# SPDX-License-Identifier: GPL-2.0-or-later
"""The frames of a run: pictures at any of them, for the gallery of scenes, and a film of all, through ffmpeg."""

import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from ..arrays import Floats
from ..errors import ResultsError
from ..read.motion import REMEDY, Motion
from ..read.results import Surface
from .canvas import View
from .ground_quantities import COLOURS, Quantity, quantities_of
from .render import SURFACE_COLOUR, shaded_picture
from .style import GROUND_COLOURS, use_style

SLOWEST, FASTEST = 2.0, 30.0  # frames a second
DOTS = 100  # per inch
ROOM_ABOVE = 0.2  # for text and scale, as a share of the height in view
VIEW = View.of_angles(-62.0, 24.0)
GREY = (0.62, 0.62, 0.60)  # of points without a known quantity


def _chosen(motion: Motion, key: str | None) -> Quantity | None:
    """The quantity of this key, or the first; None where the run has none. @raises ResultsError"""
    quantities = {quantity.key: quantity for quantity in quantities_of([motion])}
    if key is None:
        return next(iter(quantities.values()), None)
    if key not in quantities:
        raise ResultsError(f"{motion.folder}: has no {key} of its points; it has {', '.join(quantities) or 'none'}")
    return quantities[key]


class MovingPictures:
    """Pictures of one run that all show the same part of the surroundings of its wheels."""

    def __init__(
        self,
        motion: Motion,
        key: str | None = None,
        cut: float = -np.inf,
        size: tuple[int, int] = (960, 540),
        title: str = "",
    ) -> None:
        """key: of the quantity of the colours, None: the first; size: [pixel]; title: or the run's

        cut: points of smaller y are left out [m]. @raises ResultsError
        """
        self.motion, self.quantity, self.cut = motion, _chosen(motion, key), cut
        self.width, self.height = size
        self.title = title or motion.title
        use_style()
        first, last = (self._parts(time) for time in motion.times[[0, -1]])
        shown = VIEW.project(np.concatenate([first[0], last[0]]))[:, :2]
        bodies = [part[3].x for part in (first, last) if part[3] is not None]
        if bodies:
            shown = np.concatenate([shown, VIEW.project(np.concatenate(bodies))[:, :2]])
        low, high = shown.min(axis=0), shown.max(axis=0)
        high[1] += ROOM_ABOVE * (high[1] - low[1])
        centre, half = 0.5 * (low + high), 0.53 * (high - low)
        half = np.maximum(half, half[::-1] * [self.width / self.height, self.height / self.width])
        self.corners = centre - half, centre + half
        self.pixel = float(2 * half[0] / self.width)

    def _parts(self, time: float) -> tuple[Floats, Floats, Floats, Surface | None]:
        """Centres, radii and colours of spheres, and the bodies; x is measured from the middle of the bodies."""
        bodies = [body.at(time) for body in self.motion.bodies]
        if self.motion.bodies_mirrored:
            bodies += [one.mirrored() for one in bodies]
        body = Surface.together(bodies) if bodies else None
        x, radius, colours = [np.empty((0, 3))], [np.empty(0)], [np.empty((0, 3))]
        for cloud in self.motion.clouds:
            points = cloud.at(time)
            colour = self._colours(points.fields, len(points.id))
            for side in (1, -1) if cloud.mirrored else (1,):
                place = points.x * [1, side, 1]
                kept = place[:, 1] >= self.cut
                x.append(place[kept])
                radius.append(points.radius[kept])
                colours.append(colour[kept])
        places = np.concatenate(x)
        if body is not None:
            shift = np.array([0.5 * (body.x[:, 0].min() + body.x[:, 0].max()), 0, 0])
            body, places = Surface(body.triangles, body.x - shift), places - shift
        return places, np.concatenate(radius), np.concatenate(colours), body

    def _colours(self, fields: dict[str, Floats], count: int) -> Floats:
        if self.quantity is None or self.quantity.key not in fields:
            return np.tile(GREY, (count, 1))
        levels = self.quantity.levels(fields[self.quantity.key])
        colours: Floats = GROUND_COLOURS(levels / (COLOURS - 1))[:, :3]
        colours[levels == COLOURS] = GREY
        return colours

    def rgb(self, time: float) -> Any:
        """(height, width, 3) of bytes, rows from the top."""
        x, radius, colours, body = self._parts(time)
        if not len(x):  # a wheel on a road: the renderer takes its scale from spheres
            assert body is not None
            x, radius, colours = body.x[:1], np.full(1, 1e-3), np.array([SURFACE_COLOUR])
        image, _ = shaded_picture(x, radius, colours, body, VIEW, self.pixel, corners=self.corners)
        figure = plt.figure(figsize=(self.width / DOTS, self.height / DOTS), dpi=DOTS)
        figure.figimage(image[-self.height :, : self.width], origin="upper", zorder=-1)
        figure.text(0.02, 0.94, f"{self.title}   t = {time:.3f} s", fontsize=10)
        if self.quantity is not None:
            axes = figure.add_axes((0.66, 0.94, 0.31, 0.025))
            scale = ScalarMappable(Normalize(self.quantity.low, self.quantity.high), GROUND_COLOURS)
            label = f"{self.quantity.name} [{self.quantity.unit}]"
            figure.colorbar(scale, cax=axes, orientation="horizontal", label=label)
        figure.canvas.draw()
        pixels = np.asarray(figure.canvas.buffer_rgba())[: self.height, : self.width, :3].copy()
        plt.close(figure)
        return pixels


def draw_film(motion: Motion, target: Path, key: str | None, seconds: float, cut: float) -> int:
    """Writes the film; the result is its number of frames.

    key: of the quantity of the colours, None: the first; cut: points of smaller y are left out [m].
    @raises ResultsError without frames, quantity or ffmpeg
    """
    if not motion.has_frames:
        raise ResultsError(f"{motion.folder}: the run wrote no frames; {REMEDY}")
    pictures = MovingPictures(motion, key, cut)
    rate = min(max(len(motion.times) / seconds, SLOWEST), FASTEST)
    with _encoder(target, (pictures.width, pictures.height), rate) as stream:
        for time in motion.times:
            stream.write(pictures.rgb(time).tobytes())
    return len(motion.times)


@contextmanager
def _encoder(target: Path, size: tuple[int, int], rate: float) -> Iterator[IO[bytes]]:
    """A stream of RGB frames into a film. @raises ResultsError where ffmpeg is missing or fails"""
    program = shutil.which("ffmpeg")
    if program is None:
        raise ResultsError("ffmpeg is missing; install Debian's package of that name (apt-get install ffmpeg)")
    command = [program, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{size[0]}x{size[1]}", "-r", f"{rate:.3f}", "-i", "-", "-an"]
    command += ["-pix_fmt", "yuv420p", "-movflags", "+faststart", str(target)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        assert process.stdin and process.stderr
        try:
            yield process.stdin
            process.stdin.close()
        except BrokenPipeError:
            pass  # the program has printed the reason
        said = process.stderr.read().decode(errors="replace").strip()
        if process.wait():
            raise ResultsError(f"{target}: ffmpeg could not write it ({' '.join(said.split())})")
