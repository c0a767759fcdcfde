# SPDX-License-Identifier: GPL-2.0-or-later
"""The frames of a run as a film: the pictures of render.py, one behind another, through ffmpeg."""

import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from ..errors import ResultsError
from ..read.motion import REMEDY, Motion
from .moving import MovingPictures

SLOWEST, FASTEST = 2.0, 30.0  # frames a second


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
        raise ResultsError(
            "ffmpeg is missing; install Debian's package of that name (apt-get install ffmpeg)"
        )
    command = [program, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{size[0]}x{size[1]}", "-r", f"{rate:.3f}", "-i", "-", "-an"]
    command += ["-pix_fmt", "yuv420p", "-movflags", "+faststart", str(target)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    ) as process:
        assert process.stdin and process.stderr
        try:
            yield process.stdin
            process.stdin.close()
        except BrokenPipeError:
            pass  # it has said why
        said = process.stderr.read().decode(errors="replace").strip()
        if process.wait():
            raise ResultsError(f"{target}: ffmpeg could not write it ({' '.join(said.split())})")
