#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the gallery of scenes, README.md next to this file, from the heads of the scenes."""

import io
import sys
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np
from PIL import Image

from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, command, flag, option
from furrow_post.errors import ResultsError
from furrow_post.figures.film import MovingPictures
from furrow_post.read.motion import read_motion
from furrow_post.scene.catalogue import GROUPS, head_of

PAGE = HERE / "README.md"
PICTURES = HERE / "pictures"
SIZE = (480, 270)  # [pixel]
LARGEST = 60_000  # [byte] of a picture
ENTRIES = ("Run time", "Expect", "Limits")  # of a head, in the order of the page
HEAD = """# Scenes

Use this page to choose a scene. Each is a LIGGGHTS input script that you can run, change and copy:
```
bash inputs/run tyre_on_snow
```
`--quick` runs a small, coarse version within a minute, and `-v NAME VALUE` changes a variable. Results go
to `results/SCENE`. New users start with the [first tutorial](../guide/tutorials/1_first_run.md).

Run times are those of one fast core. Another machine needed 2.4 times as long.
Expected values are those of the full version. Pictures show the quick one. `gallery.py` writes this page.
"""


def page() -> str:
    """The page of all scenes that are there."""
    groups: dict[str, list[str]] = {group: [] for group in GROUPS}
    for script in sorted(HERE.glob("*.lig")):
        title, entries = head_of(script)
        for name in ("Group", "Shows", "Run time", "Expect"):
            if name not in entries:
                raise ResultsError(f"{script}: its head has no '{name}:'")
        if entries["Group"] not in groups:
            raise ResultsError(f"{script}: its group is none of {', '.join(GROUPS)}")
        groups[entries["Group"]].append(_entry(script, title, entries))
    parts = [HEAD, *(f"- [{group}](#{_anchor(group)})" for group in GROUPS), ""]
    for group, scenes in groups.items():
        parts += [f"## {group}\n", *scenes]
    return "\n".join(parts)


def _anchor(heading: str) -> str:
    return heading.lower().replace(" ", "-")


def _entry(script: Path, title: str, entries: dict[str, str]) -> str:
    """Entry of a scene on the page of the gallery."""
    name = script.stem
    lines = [f"### [{name}]({script.name})", _wrapped(f"{_sentence(title)} {_sentence(entries['Shows'])}"), ""]
    if (PICTURES / f"{name}.png").is_file():
        lines += [f"![{name}](pictures/{name}.png)", ""]
    cells = [_wrapped(entries.get(entry, "")).replace("\n", " ") for entry in ENTRIES]
    lines += ["| run time | expected values | limits |", "|---|---|---|", f"| {' | '.join(cells)} |"]
    return "\n".join(lines) + "\n"


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _wrapped(text: str, indent: str = "") -> str:
    """Text in lines of 100 characters, with characters of Markdown escaped."""
    for letter in "[]<>*":
        text = text.replace(letter, f"\\{letter}")
    return textwrap.fill(
        text, 100, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )


def write_picture(scene: str, results: Path) -> None:
    """@raises ResultsError for a scene or results that are not there, or a picture too large"""
    if not (HERE / f"{scene}.lig").is_file():
        raise ResultsError(f"there is no scene '{scene}'")
    curve = results / "curve.txt"
    if curve.is_file() and not (results / "terrain.h5").is_file():
        pixels = _curve(curve)
    else:
        motion = read_motion(results)
        pixels = MovingPictures(motion, size=SIZE, title=scene).rgb(motion.times[-1])
    content = io.BytesIO()
    Image.fromarray(pixels).quantize(128).save(content, "png", optimize=True)
    if content.tell() > LARGEST:
        raise ResultsError(f"the picture of {scene} has {content.tell()} bytes, not {LARGEST}")
    PICTURES.mkdir(exist_ok=True)
    (PICTURES / f"{scene}.png").write_bytes(content.getvalue())
    print(PICTURES / f"{scene}.png")


def _curve(file: Path) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    """Pressure against sinkage of a plate, as pixels."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    rows = np.loadtxt(file)
    figure = Figure(figsize=(SIZE[0] / 100, SIZE[1] / 100), dpi=100, layout="constrained")
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.plot(1e3 * rows[:, 1], 1e-3 * rows[:, 3], color="#1f5a8a")
    axes.set_xlabel("sinkage [mm]")
    axes.set_ylabel("pressure [kPa]")
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[:, :, :3].copy()


@command(
    option("--picture", nargs=2, metavar="SCENE RESULTS", help="the picture of a scene, from a results folder of it"),
    flag("--check", help="refuses a page that is not what this command writes"),
    description=__doc__ or "",
)
def gallery(given: Given) -> None:
    if given.picture:
        write_picture(given.picture[0], Path(given.picture[1]))
        return
    text = page()
    if not given.check:
        PAGE.write_text(text, encoding="utf-8")
    elif text != PAGE.read_text(encoding="utf-8"):
        raise ResultsError(f"{PAGE}: is not what the heads of the scenes say; run {Path(__file__)}")
    for script in HERE.glob("*.lig") if given.check else ():
        picture = PICTURES / f"{script.stem}.png"
        if not picture.is_file() or picture.stat().st_size > LARGEST:
            raise ResultsError(f"{picture}: is missing, or larger than {LARGEST} bytes")


if __name__ == "__main__":
    sys.exit(start(gallery, "gallery"))
