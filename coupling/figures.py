#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the figures of the style pages, one SVG next to each page: figures.py [NAME...].

A name is that of a page without its suffix, for example fix_wheel_rig. Without names the program
draws all figures.
"""

import math
import sys
from collections.abc import Callable
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Polygon, Rectangle

HERE = Path(__file__).parent
INK, GREY, SOIL, FINE, RED, BLUE = "#222222", "#8a8a8a", "#e6d3b3", "#c9a86a", "#b3261e", "#1f5fa8"

Figure = Callable[[Axes], None]
FIGURES: dict[str, tuple[tuple[float, float], Figure]] = {}


def figure(page: str, width: float, height: float) -> Callable[[Figure], Figure]:
    """Registers the figure of a page; width and height in inches."""

    def register(draw: Figure) -> Figure:
        FIGURES[page] = ((width, height), draw)
        return draw

    return register


Point = tuple[float, float]


def arrow(ax: Axes, start: Point, end: Point, colour: str = INK) -> None:
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.4})


def dimension(ax: Axes, start: Point, end: Point) -> None:
    ax.annotate("", end, start, arrowprops={"arrowstyle": "<->", "color": GREY, "lw": 0.9})


def note(ax: Axes, x: float, y: float, text: str, colour: str = INK, **how: object) -> None:
    style: dict[str, object] = {"ha": "center", "va": "center", "fontsize": 9, "color": colour}
    ax.text(x, y, text, **{**style, **how})


def spring(ax: Axes, start: Point, end: Point) -> None:
    """A zigzag between two points."""
    (x0, y0), (x1, y1) = start, end
    length = math.hypot(x1 - x0, y1 - y0)
    along = (x1 - x0) / length, (y1 - y0) / length
    across = -along[1], along[0]
    turns, points = 8, [start]
    for k in range(turns + 1):
        s = length * (0.2 + 0.6 * k / turns)
        side = 0.0 if k in (0, turns) else 0.05 * (-1) ** k
        points.append((x0 + s * along[0] + side * across[0], y0 + s * along[1] + side * across[1]))
    points.append(end)
    ax.plot(*zip(*points, strict=True), color=BLUE, lw=1.3)


@figure("terrain/fix_terrain_continuum", 7.2, 3.0)
def terrain(ax: Axes) -> None:
    """Side view: graded cells, boundaries, and the window that follows the wheel."""
    x = [-1.5, -1.15, -0.85, *[-0.6 + 0.1 * k for k in range(13)], 0.85, 1.15, 1.5]
    z = [-0.62, -0.42, -0.3, -0.2, -0.1, 0.0]
    ax.add_patch(Rectangle((x[0], z[0]), x[-1] - x[0], -z[0], color=SOIL))
    ax.add_patch(Rectangle((-0.6, -0.3), 1.2, 0.3, color=FINE))
    for each in x:
        ax.plot([each, each], [z[0], z[-1]], color="white", lw=0.7)
    for each in z:
        ax.plot([x[0], x[-1]], [each, each], color="white", lw=0.7)
    ax.add_patch(Rectangle((x[0], 0.0), x[-1] - x[0], 0.28, fill=False, ls=":", ec=GREY))
    note(ax, 1.08, 0.2, "clearance_above", GREY)
    ax.add_patch(Circle((0.0, 0.24), 0.3, fc="white", ec=INK, lw=1.6))
    arrow(ax, (0.0, 0.24), (0.75, 0.24))
    note(ax, 0.5, 0.31, "follow")
    ax.plot([x[0], x[-1]], [z[0], z[0]], color=INK, lw=2.5)
    note(ax, 0.0, -0.7, "base")
    for side in (x[0], x[-1]):
        ax.plot([side, side], [z[0], 0.0], color=INK, lw=2.5)
    note(ax, -1.62, -0.31, "ends", rotation=90)
    note(ax, 1.62, -0.31, "ends", rotation=90)
    dimension(ax, (-0.6, -0.36), (0.6, -0.36))
    note(ax, 0.0, -0.42, "fine_length, cells of size cell", va="top")
    dimension(ax, (-1.5, -0.8), (1.5, -0.8))
    note(ax, 0.0, -0.87, "length")
    dimension(ax, (1.78, -0.62), (1.78, 0.0))
    note(ax, 1.86, -0.31, "depth", rotation=90)
    arrow(ax, (-1.25, 0.12), (-1.85, 0.12), RED)
    note(ax, -1.62, 0.2, "dropped: rut", RED)
    arrow(ax, (2.35, -0.1), (1.95, -0.1), RED)
    note(ax, 2.2, 0.0, "added: undisturbed", RED)
    ax.set_xlim(-2.1, 2.7)
    ax.set_ylim(-0.95, 0.6)


@figure("terrain/fix_terrain_scm", 7.2, 2.6)
def scm(ax: Axes) -> None:
    """Side view: cells of the height field under a wheel; section: rut and soil at its sides."""
    cell, radius, axle, depth = 0.1, 0.5, 0.3, 0.2
    for k in range(-9, 8):
        left = k * cell
        x = left + 0.5 * cell
        below = axle - math.sqrt(max(0.0, radius**2 - x * x)) if abs(x) < radius else 1.0
        top = -depth + 0.02 if x < 0 else min(0.0, below)
        ax.add_patch(Rectangle((left, -0.6), cell, 0.6 + top, fc=SOIL, ec="white", lw=0.7))
        if 0 < x < 0.42:
            arrow(ax, (x, top - 0.24 * top / -depth - 0.04), (x, top), BLUE)
    ax.plot([-0.9, 0.8], [0.0, 0.0], color=GREY, lw=0.8, ls="--")
    ax.add_patch(Circle((0.0, axle), radius, fill=False, ec=INK, lw=1.8))
    arrow(ax, (0.0, axle), (0.75, axle))
    note(ax, 0.8, axle, "v", ha="left")
    note(ax, 0.17, -0.5, "pressure k z$^n$", BLUE)
    arrow(ax, (0.42, -0.03), (0.2, -0.16), RED)
    note(ax, 0.5, -0.12, "shear", RED, ha="left")
    note(ax, -0.62, -0.3, "rut")
    dimension(ax, (-0.8, -depth), (-0.8, 0.0))
    note(ax, -0.85, -0.1, "z", ha="right")
    middle = 1.9
    heights = [0.0, 0.03, 0.08, 0.12, -0.18, -0.18, -0.18, -0.18, 0.12, 0.08, 0.03, 0.0]
    for k, top in enumerate(heights):
        left = middle + (k - 6) * cell
        ax.add_patch(Rectangle((left, -0.6), cell, 0.6 + top, fc=SOIL, ec="white", lw=0.7))
    ax.plot([middle - 0.6, middle + 0.6], [0.0, 0.0], color=GREY, lw=0.8, ls="--")
    note(ax, middle, 0.35, "section: flow puts soil on the sides")
    arrow(ax, (middle - 0.1, -0.1), (middle - 0.32, 0.2), RED)
    arrow(ax, (middle + 0.1, -0.1), (middle + 0.32, 0.2), RED)
    dimension(ax, (middle - 0.2, -0.66), (middle - 0.1, -0.66))
    note(ax, middle - 0.15, -0.73, "cell", va="top")
    ax.set_xlim(-1.0, 2.6)
    ax.set_ylim(-0.85, 0.85)


@figure("drive/fix_wheel_rig", 7.2, 3.0)
def rig(ax: Axes) -> None:
    """Forces on the wheel, and the three stages over time."""
    ground, axle, radius = 0.0, 0.32, 0.5
    ax.add_patch(Rectangle((-1.3, -0.5), 2.4, 0.5, color=SOIL))
    rut = [(-1.3, -0.15), (-0.1, -0.18), (0.0, ground), (-1.3, ground)]
    ax.add_patch(Polygon(rut, color="white"))
    ax.plot([-1.3, 1.1], [ground, ground], color=GREY, lw=0.8, ls="--")
    ax.add_patch(Circle((0.0, axle), radius, fc="white", ec=INK, lw=1.8))
    ax.plot([0], [axle], "o", color=INK, ms=4)
    arrow(ax, (0.0, 1.25), (0.0, axle + 0.04), BLUE)
    note(ax, 0.1, 1.14, "load", BLUE, ha="left")
    arrow(ax, (0.04, axle), (0.95, axle), INK)
    note(ax, 1.0, axle, "speed v", ha="left")
    arrow(ax, (-0.04, axle), (-0.95, axle), BLUE)
    note(ax, -0.98, axle + 0.12, "drawbar_load", BLUE)
    ax.add_patch(Arc((0.0, axle), 0.5, 0.5, theta1=20, theta2=130, color=BLUE, lw=1.4))
    arrow(ax, (0.232, axle + 0.1), (0.25, axle + 0.03), BLUE)
    note(ax, 0.29, axle + 0.27, "torque", BLUE, ha="left")
    dimension(ax, (0.72, ground), (0.72, axle - radius))
    note(ax, 0.77, -0.09, "hub drop", ha="left")
    ax.plot([0.0, 0.78], [axle - radius, axle - radius], color=GREY, lw=0.8, ls=":")
    note(ax, -1.27, 0.07, "ground_level", GREY, ha="left")
    left, bottom, width, height = 2.0, -0.3, 2.5, 1.3
    for x, name in ((0.0, "settle"), (0.8, "accelerate"), (1.5, "cruise")):
        ax.plot([left + x, left + x], [bottom, bottom + height], color=GREY, lw=0.7, ls=":")
        note(ax, left + x + 0.06, bottom + height + 0.08, name, ha="left")
    arrow(ax, (left, bottom), (left + width, bottom))
    note(ax, left + width + 0.03, bottom, "t", ha="left")

    def ramp(begin: float, end: float, level: float, colour: str) -> None:
        u = [k / 40 for k in range(41)]
        points = [(begin + (end - begin) * v, level * v**3 * (10 - 15 * v + 6 * v * v)) for v in u]
        points = [(0.0, 0.0), *points, (width - 0.1, level)]
        times, levels = zip(*points, strict=True)
        ax.plot([left + x for x in times], [bottom + y for y in levels], color=colour, lw=1.6)

    ramp(0.0, 0.4, 1.0, BLUE)
    ramp(0.8, 1.5, 0.7, RED)
    note(ax, left + 0.45, bottom + 1.08, "load", BLUE, ha="left")
    note(ax, left + 1.62, bottom + 0.58, "speed, spin or torque", RED, ha="left")
    ax.set_xlim(-1.5, 4.75)
    ax.set_ylim(-0.55, 1.35)


@figure("contact/fix_contact_continuum", 5.2, 2.6)
def contact(ax: Axes) -> None:
    """A particle, its reach, its closest triangle and the springs between them."""
    ax.add_patch(Rectangle((-1.6, -1.0), 3.2, 0.62, color=SOIL))
    for k in range(9):
        for row in range(2):
            ax.plot([-1.4 + 0.35 * k], [-0.56 - 0.3 * row], "o", color=FINE, ms=7)
    facets = [(-1.5, 0.62), (-0.75, 0.2), (0.05, 0.06), (0.85, 0.24), (1.5, 0.66)]
    ax.plot(*zip(*facets, strict=True), "-o", color=INK, lw=2, ms=4)
    note(ax, 1.02, 0.62, "surface of the body", ha="right")
    particle, point = (0.35, -0.56), (0.35, 0.13)
    ax.plot(*particle, "o", color=RED, ms=8)
    ax.add_patch(Circle(particle, 0.19, fill=False, ec=RED, ls="--"))
    note(ax, 0.58, -0.71, "particle and its reach", RED, ha="left")
    spring(ax, (0.35, -0.37), point)
    note(ax, 0.46, -0.1, "normal spring", BLUE, ha="left")
    ax.plot(*point, "o", color=BLUE, ms=5)
    spring(ax, (-0.35, -0.2), (0.3, -0.2))
    ax.plot([0.3, 0.35], [-0.2, -0.2], color=BLUE, lw=1.3)
    note(ax, -0.4, -0.2, "tangential spring", BLUE, ha="right")
    note(ax, 0.35, 0.34, "closest point", BLUE)
    ax.set_xlim(-1.7, 1.7)
    ax.set_ylim(-1.05, 0.8)


@figure("terrain/bed/fix_bed_window", 7.2, 2.4)
def window(ax: Axes) -> None:
    """The periodic bed with its slabs, the rut and the slab that is renewed."""
    slabs, pitch, wheel = 12, 0.3, 2.55
    length = slabs * pitch
    for k in range(slabs):
        x = k * pitch
        rut = x + pitch < wheel and k >= 4
        height = 0.36 if rut else 0.5
        colour = {3: RED}.get(k, FINE if rut else SOIL)
        opacity = 0.55 if k == 3 else 1.0
        ax.add_patch(Rectangle((x, 0.0), pitch, height, fc=colour, ec="white", alpha=opacity))
    ax.add_patch(Circle((wheel, 0.72), 0.34, fc="white", ec=INK, lw=1.8))
    arrow(ax, (wheel, 0.72), (wheel + 0.75, 0.72))
    note(ax, wheel + 0.55, 0.8, "travel")
    note(ax, 3.5 * pitch, 0.62, "slab renewed last,\nfrozen", RED, va="bottom")
    note(ax, 6.3 * pitch, 0.17, "rut")
    note(ax, 10.6 * pitch, 0.25, "stored bed")
    note(ax, 1.5 * pitch, 0.25, "stored bed")
    dimension(ax, (4 * pitch, 0.56), (wheel, 0.56))
    note(ax, 1.75, 0.63, "behind", va="bottom")
    dimension(ax, (0.0, -0.1), (length, -0.1))
    note(ax, length / 2, -0.19, "period of the box, divided into slabs")
    for x in (0.0, length):
        ax.plot([x, x], [-0.04, 0.95], color=GREY, ls="--", lw=0.9)
    note(ax, length + 0.05, 0.85, "periodic", GREY, ha="left")
    ax.set_xlim(-0.2, length + 0.6)
    ax.set_ylim(-0.28, 1.12)


def chain(theta: list[float], start: Point, step: float) -> list[Point]:
    points = [start]
    for angle in theta:
        x, y = points[-1]
        points.append((x + step * math.cos(angle), y + step * math.sin(angle)))
    return points


def sidewall(side: int) -> list[Point]:
    """From bead to tread, as a chain of segments; side -1 or 1."""
    begin, turn, count = math.radians(20), math.radians(140), 9
    angles = [begin + turn * k / (count - 1) for k in range(count)]
    return [(side * x, y) for x, y in chain(angles, (0.72, 0.0), 0.135)]


@figure("wheels/fix_tyre_darnell", 5.0, 2.9)
def darnell(ax: Axes) -> None:
    """Section: shell as tread, chains as sidewalls, rigid rim."""
    right = sidewall(1)
    edge = right[-1]
    for side in (-1, 1):
        points = sidewall(side)
        ax.plot(*zip(*points, strict=True), "-o", color=BLUE, lw=1.6, ms=4)
    half = edge[0]
    tread = [(half * s / 4, edge[1] + 0.05 * (1 - (s / 4) ** 2)) for s in range(-4, 5)]
    ax.plot(*zip(*tread, strict=True), "-", color=RED, lw=4)
    ax.add_patch(Rectangle((-0.72, -0.14), 1.44, 0.14, color=GREY))
    note(ax, 0.0, -0.25, "rigid rim: position, spin, yaw, camber", GREY)
    note(ax, 0.0, edge[1] + 0.2, "tread: shell", RED)
    note(ax, 1.2, 0.35, "sidewall: chain with\nbending springs", BLUE, ha="left")
    for x in (-0.4, 0.0, 0.4):
        arrow(ax, (x, 0.35), (x, 0.72))
    arrow(ax, (0.55, 0.42), (0.85, 0.42))
    arrow(ax, (-0.55, 0.42), (-0.85, 0.42))
    note(ax, 0.0, 0.25, "pressure")
    ax.set_xlim(-1.35, 2.1)
    ax.set_ylim(-0.35, edge[1] + 0.3)


@figure("wheels/fix_tyre_brick", 5.0, 2.9)
def brick(ax: Axes) -> None:
    """Section: shell carcass from bead to bead, bricks as tread, grooves."""
    right = sidewall(1)
    edge = right[-1]
    count, thick = 12, 0.22
    half = edge[0] + 0.12
    crown = [(half * (2 * k / count - 1), edge[1]) for k in range(count + 1)]
    for k in range(count):
        depth = 0.1 if k in (3, 8) else thick
        (x0, y0), (x1, y1) = crown[k], crown[k + 1]
        outer0, outer1 = depth * (0.2 if k == 0 else 1.0), depth * (0.2 if k == count - 1 else 1.0)
        shape = [(x0, y0), (x1, y1), (x1, y1 + outer1), (x0, y0 + outer0)]
        ax.add_patch(Polygon(shape, fc=SOIL, ec=INK, lw=0.8))
        middle0, middle1 = outer0 / 2, outer1 / 2
        ax.plot([x0, x1], [y0 + middle0, y1 + middle1], color=INK, lw=0.5)
    carcass = [*[(-x, y) for x, y in right], *crown[2:-2], *right[::-1]]
    ax.plot(*zip(*carcass, strict=True), "-o", color=BLUE, lw=1.8, ms=3.5)
    ax.add_patch(Rectangle((-0.72, -0.14), 1.44, 0.14, color=GREY))
    note(ax, 0.0, -0.25, "rigid rim", GREY)
    note(ax, 0.0, edge[1] + 0.36, "tread: layers of bricks, with grooves")
    note(ax, 1.2, 0.35, "carcass: shells\nfrom bead to bead", BLUE, ha="left")
    for x in (-0.4, 0.0, 0.4):
        arrow(ax, (x, 0.35), (x, 0.72))
    note(ax, 0.0, 0.25, "pressure")
    ax.set_xlim(-1.35, 2.1)
    ax.set_ylim(-0.35, edge[1] + 0.48)


@figure("output/histories/fix_wheel_arc", 4.6, 3.0)
def arc(ax: Axes) -> None:
    """The angle, the unit vectors and both stresses on a sector."""
    radius, axle = 1.0, (0.0, 0.75)
    ground = [(-1.7, -0.12), (-0.1, -0.25), (0.0, 0.05), (1.7, 0.05), (1.7, -0.6), (-1.7, -0.6)]
    ax.add_patch(Polygon(ground, color=SOIL))
    ax.add_patch(Circle(axle, radius, fc="white", ec=INK, lw=1.8))
    ax.plot(*axle, "o", color=INK, ms=4)
    theta = math.radians(-90 + 30)
    half = math.radians(6)

    def rim(angle: float, r: float = radius) -> Point:
        return axle[0] + r * math.cos(angle), axle[1] + r * math.sin(angle)

    ax.plot([axle[0], axle[0]], [axle[1], axle[1] - radius], color=GREY, ls="--", lw=0.9)
    ax.add_patch(Polygon([axle, rim(theta - half), rim(theta + half)], fc=BLUE, alpha=0.2))
    ax.add_patch(Arc(axle, 0.9, 0.9, theta1=-90, theta2=-60, color=GREY))
    note(ax, 0.2, 0.17, "θ")
    point = rim(theta)
    arrow(ax, rim(theta, 1.42), rim(theta, 1.03), RED)
    note(ax, *rim(theta, 1.52), "σ", RED)
    tangent = (-math.sin(theta), math.cos(theta))
    arrow(ax, point, (point[0] + 0.4 * tangent[0], point[1] + 0.4 * tangent[1]), BLUE)
    note(ax, point[0] + 0.5 * tangent[0] + 0.05, point[1] + 0.5 * tangent[1], "τ", BLUE)
    arrow(ax, (0.0, axle[1]), (0.8, axle[1]))
    note(ax, 0.65, axle[1] + 0.12, "travel")
    note(ax, -0.95, -0.4, "ground")
    ax.set_xlim(-1.7, 1.7)
    ax.set_ylim(-0.65, 1.85)


@figure("contact/grains/fix_mesh_body", 7.2, 2.3)
def mesh(ax: Axes) -> None:
    """Body, mesh and wall: who moves whom."""
    for x, name, detail in (
        (0.0, "body", "wheel, tyre, plate,\nterrain with surface_mesh"),
        (2.6, "mesh/body", "triangles at the\nnodes of the body"),
        (5.2, "wall/gran/body", "contacts between\ngrains and triangles"),
    ):
        ax.add_patch(Rectangle((x, 0.0), 1.7, 0.9, fc="white", ec=INK, lw=1.4))
        note(ax, x + 0.85, 0.68, name, weight="bold")
        note(ax, x + 0.85, 0.28, detail)
    arrow(ax, (1.75, 0.6), (2.55, 0.6))
    note(ax, 2.15, 0.95, "position,\nvelocity", va="bottom")
    arrow(ax, (4.35, 0.6), (5.15, 0.6))
    note(ax, 4.75, 0.95, "meshes", va="bottom")
    ax.plot([6.05, 6.05, 0.85], [-0.05, -0.42, -0.42], color=RED, lw=1.4)
    arrow(ax, (0.85, -0.42), (0.85, -0.03), RED)
    note(ax, 3.45, -0.56, "forces on the nodes", RED)
    ax.set_xlim(-0.15, 7.05)
    ax.set_ylim(-0.7, 1.35)


def main(names: list[str]) -> None:
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "furrow", "font.size": 9})
    unknown = set(names) - {Path(page).name for page in FIGURES}
    if unknown:
        sys.exit(f"figures.py: no figure {', '.join(sorted(unknown))}")
    for page, (size, draw) in FIGURES.items():
        if names and Path(page).name not in names:
            continue
        drawing, ax = plt.subplots(figsize=size)
        ax.set_aspect("equal")
        ax.axis("off")
        draw(ax)
        path = HERE / f"{page}.svg"
        drawing.savefig(path, bbox_inches="tight", metadata={"Date": None})
        plt.close(drawing)
        print(path.relative_to(HERE.parent))


if __name__ == "__main__":
    main(sys.argv[1:])
