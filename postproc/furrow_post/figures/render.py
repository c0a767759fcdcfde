# SPDX-License-Identifier: GPL-2.0-or-later
"""A z-buffer for spheres and triangles in numpy: parallel projection, one sun with shadow,
ambient occlusion.

Points x are (n, 3) in world units; images have row 0 at the bottom unless it is said otherwise.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Integers
from ..read.results import Surface

NOTHING = -1
SUPERSAMPLE = 2  # pixels of the canvas along each side of one of the picture
SURFACE_COLOUR = (0.36, 0.40, 0.45)


def round_up(value: float) -> float:
    """The end of a scale: to 1, 1.5, 2, 3, 5, 7 times a power of ten."""
    if not value > 0:
        return 1e-3
    power = float(10.0 ** np.floor(np.log10(value)))
    steps = (1, 1.5, 2, 3, 5, 7, 10)
    return power * min(step for step in steps if step * power >= value * (1 - 1e-9))


@dataclass
class View:
    """A parallel projection: world point -> (right, up, towards the viewer), each a unit vector."""

    right: Floats
    up: Floats
    towards: Floats

    @classmethod
    def of_angles(cls, azimuth: float, elevation: float) -> "View":
        """The viewer looks at the origin from these angles [degrees].

        azimuth: from the x axis; elevation: above the ground
        """
        a, e = np.radians([azimuth, elevation])
        towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        right = np.array([-np.sin(a), np.cos(a), 0.0])
        return cls(right, np.cross(towards, right), towards)

    @classmethod
    def from_above(cls) -> "View":
        return cls(np.array([1.0, 0, 0]), np.array([0, 1.0, 0]), np.array([0, 0, 1.0]))

    def project(self, points: Floats) -> Floats:
        """(..., 3) along right, up, towards."""
        axes: Floats = np.column_stack([self.right, self.up, self.towards])
        projected: Floats = points @ axes
        return projected


SUN = View.of_angles(-75.0, 48.0)


class Canvas:
    """Depth (towards the viewer, in world units) and the nearest object at each pixel.

    low, high: opposite corners in the (right, up) plane; pixel: side of a pixel in world units.
    """

    def __init__(self, view: View, low: Floats, high: Floats, pixel: float) -> None:
        self.view, self.pixel = view, pixel
        self.low = np.asarray(low, float)
        size = np.maximum(np.ceil((np.asarray(high) - self.low) / pixel).astype(int), 1)
        self.width, self.height = int(size[0]), int(size[1])
        self.depth: Floats = np.full(self.height * self.width, -np.inf)
        self.object: Integers = np.full(self.height * self.width, NOTHING, np.int64)

    def image(self, values: Floats) -> Floats:
        """(height, width, ...) of values of all pixels."""
        return values.reshape(self.height, self.width, *values.shape[1:])

    def add_spheres(self, x: Floats, radius: Floats) -> None:
        """Spheres become the objects 0 ... n-1."""
        centre = self.view.project(x)
        place = (centre[:, :2] - self.low) / self.pixel - 0.5  # of a pixel's middle: whole numbers
        base = np.round(place).astype(int)
        offset = place - base
        size = radius / self.pixel
        reach = int(np.ceil(size.max() + 0.5))
        for dy in range(-reach, reach + 1):
            for dx in range(-reach, reach + 1):
                cap = size**2 - (dx - offset[:, 0]) ** 2 - (dy - offset[:, 1]) ** 2
                column, row = base[:, 0] + dx, base[:, 1] + dy
                on_canvas = (column >= 0) & (column < self.width) & (row >= 0) & (row < self.height)
                hit = np.flatnonzero((cap > 0) & on_canvas)
                depth = centre[hit, 2] + self.pixel * np.sqrt(cap[hit])
                self._keep_nearest(row[hit] * self.width + column[hit], depth, hit)

    def _keep_nearest(self, pixel: Integers, depth: Floats, what: Integers) -> None:
        nearer = depth > self.depth[pixel]
        pixel, depth, what = pixel[nearer], depth[nearer], what[nearer]
        order = np.argsort(depth, kind="stable")  # of several on one pixel the nearest comes last
        pixel = pixel[order]
        self.depth[pixel] = depth[order]
        self.object[pixel] = what[order]

    def sphere_normals(self, x: Floats, radius: Floats) -> Floats:
        """(pixels, 3) unit normals (view axes) of pixels that show a sphere; zero elsewhere."""
        normal = np.zeros((self.depth.size, 3))
        seen = np.flatnonzero(self.object != NOTHING)
        row, column = np.divmod(seen, self.width)
        what = self.object[seen]
        centre = self.view.project(x[what])
        normal[seen, 0] = self.low[0] + (column + 0.5) * self.pixel - centre[:, 0]
        normal[seen, 1] = self.low[1] + (row + 0.5) * self.pixel - centre[:, 1]
        normal[seen, 2] = self.depth[seen] - centre[:, 2]
        normal[seen] /= radius[what, None]
        return normal

    def add_triangles(
        self,
        surface: Surface,
        corner_normals: Floats,
        first_object: int,
        normal: Floats | None = None,
    ) -> None:
        """Triangles become the objects first_object ...

        corner_normals (m, 3, 3), world axes; where they show, their normals (view axes) are written
        into normal (pixels, 3).
        """
        pixels = self.view.project(surface.x)[surface.triangles]
        normals = self.view.project(corner_normals)
        pixels[..., :2] = (pixels[..., :2] - self.low) / self.pixel - 0.5
        lowest = np.maximum(np.floor(pixels[..., :2].min(axis=1)).astype(int), 0)
        highest = np.ceil(pixels[..., :2].max(axis=1)).astype(int) + 1
        highest = np.minimum(highest, [self.width, self.height])
        sides = pixels[:, 1:, :2] - pixels[:, :1, :2]
        area = np.cross(sides[:, 0], sides[:, 1])
        for t in np.flatnonzero((highest > lowest).all(axis=1) & (area != 0)):
            column, row = np.meshgrid(
                np.arange(lowest[t, 0], highest[t, 0]), np.arange(lowest[t, 1], highest[t, 1])
            )
            a, b, c = pixels[t, :, :2]
            # barycentric coordinates of the pixels' middles
            v = ((column - a[0]) * (c[1] - a[1]) - (row - a[1]) * (c[0] - a[0])) / area[t]
            w = ((b[0] - a[0]) * (row - a[1]) - (b[1] - a[1]) * (column - a[0])) / area[t]
            u = 1 - v - w
            inside = (u >= 0) & (v >= 0) & (w >= 0)
            depth = u * pixels[t, 0, 2] + v * pixels[t, 1, 2] + w * pixels[t, 2, 2]
            where = row * self.width + column
            inside &= depth > self.depth[where]
            where = where[inside]
            self.depth[where] = depth[inside]
            self.object[where] = first_object + t
            if normal is not None:
                mixed = np.stack([u[inside], v[inside], w[inside]], axis=1) @ normals[t]
                normal[where] = mixed / np.linalg.norm(mixed, axis=1, keepdims=True)

    def world_points(self) -> Floats:
        """(pixels, 3) The point each pixel shows; at infinity where it shows none."""
        row, column = np.divmod(np.arange(self.depth.size), self.width)
        right = self.low[0] + (column + 0.5) * self.pixel
        up = self.low[1] + (row + 0.5) * self.pixel
        axes: Floats = np.vstack([self.view.right, self.view.up, self.view.towards])
        shown: Floats = np.column_stack([right, up, self.depth])
        points: Floats = shown @ axes
        return points


def corner_normals(surface: Surface, crease: float = 40.0) -> Floats:
    """(m, 3, 3) Unit normals at the corners of triangles: smooth, but sharp over edges.

    crease: largest turn over a smooth edge [degrees]
    """
    x, triangles = surface.x, surface.triangles
    corners = x[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = face / np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-300)
    around: list[list[int]] = [[] for _ in range(len(x))]
    for t, nodes in enumerate(triangles):
        for node in nodes:
            around[node].append(t)
    normals = np.empty((len(triangles), 3, 3))
    limit = np.cos(np.radians(crease))
    for t, nodes in enumerate(triangles):
        for k, node in enumerate(nodes):
            near = around[node]
            normals[t, k] = face[near][unit[near] @ unit[t] > limit].sum(axis=0)
    length = np.linalg.norm(normals, axis=2, keepdims=True)
    unit_normals: Floats = normals / np.maximum(length, 1e-300)
    return unit_normals


def _box_mean(image: Floats, reach: int) -> Floats:
    """Over (2 reach + 1)^2 pixels, the edge repeated."""
    for axis in (0, 1):
        first = np.repeat(image.take([0], axis), reach + 1, axis)
        last = np.repeat(image.take([-1], axis), reach, axis)
        total = np.concatenate([first, image, last], axis).cumsum(axis)
        size, window = image.shape[axis], 2 * reach + 1
        sums = total.take(range(window, window + size), axis) - total.take(range(size), axis)
        image = sums / window
    return image


def _bounds(view: View, x: Floats, margin: float) -> tuple[Floats, Floats]:
    projected = view.project(x)[:, :2]
    return projected.min(axis=0) - margin, projected.max(axis=0) + margin


def shaded_picture(
    x: Floats,
    radius: Floats,
    colours: Floats,
    surface: Surface | None,
    view: View,
    pixel: float,
    sun: View = SUN,
    corners: tuple[Floats, Floats] | None = None,
) -> tuple[Floats, tuple[float, float, float, float]]:
    """An RGBA picture (rows from the top, 0 ... 1) of spheres and a surface.

    x (n, 3), radius (n), colours (n, 3) of the spheres; pixel: world units per pixel; corners: of
    the picture in the view's plane (right, up), by default around all that is there. The second
    is its extent (left, right, bottom, top) in the view's plane, world units.
    """
    everything = x if surface is None else np.concatenate([x, surface.x])
    margin = 2 * radius.max()
    seen_part = corners or _bounds(view, everything, margin)
    canvas = Canvas(view, *seen_part, pixel / SUPERSAMPLE)
    canvas.add_spheres(x, radius)
    normal = canvas.sphere_normals(x, radius)
    shadow_map = Canvas(sun, *_bounds(sun, everything, margin), max(pixel, 0.35 * radius.mean()))
    shadow_map.add_spheres(x, radius)
    if surface is not None:
        at_corners = corner_normals(surface)
        canvas.add_triangles(surface, at_corners, len(radius), normal)
        shadow_map.add_triangles(surface, at_corners, len(radius))
        of_surface = np.tile(SURFACE_COLOUR, (len(surface.triangles), 1))
        colours = np.concatenate([colours, of_surface])

    seen = np.flatnonzero(canvas.object != NOTHING)
    facing = np.clip(normal[seen] @ canvas.view.project(sun.towards), 0, 1)
    light = facing * _lit(shadow_map, canvas.world_points()[seen], 0.7 * radius.mean())
    upward = normal[seen] @ canvas.view.project(np.array([0, 0, 1.0])).clip(0)
    brightness = np.zeros(canvas.depth.size)
    brightness[seen] = 0.42 + 0.26 * upward + 0.62 * light
    shaded = canvas.image(brightness) * _openness(canvas, 3.0 * radius.mean())

    picture = np.zeros((canvas.height, canvas.width, 4))
    flat = picture.reshape(-1, 4)
    flat[seen, :3] = np.clip(colours[canvas.object[seen]] * shaded.reshape(-1)[seen, None], 0, 1)
    flat[seen, 3] = 1
    left, bottom = float(canvas.low[0]), float(canvas.low[1])
    right, top = left + canvas.width * canvas.pixel, bottom + canvas.height * canvas.pixel
    return _shrunk(picture, SUPERSAMPLE)[::-1], (left, right, bottom, top)


def _lit(shadow_map: Canvas, points: Floats, bias: float) -> Floats:
    """Share of the sun that reaches points, 0 ... 1, smoothed over cells of the shadow map."""
    projected = shadow_map.view.project(points)
    depth = shadow_map.image(shadow_map.depth)
    place = ((projected[:, :2] - shadow_map.low) / shadow_map.pixel).astype(int)
    share = np.zeros(len(points))
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            column = (place[:, 0] + dx).clip(0, shadow_map.width - 1)
            row = (place[:, 1] + dy).clip(0, shadow_map.height - 1)
            share += projected[:, 2] >= depth[row, column] - bias
    return share / 9.0


def _openness(canvas: Canvas, length: float) -> Floats:
    """Ambient occlusion: darker where the surroundings (within length) are nearer to the viewer."""
    depth = canvas.image(canvas.depth)
    filled = np.where(np.isfinite(depth), depth, 0.0)
    weight = np.isfinite(depth).astype(float)
    factor = np.ones_like(depth)
    for reach, strength in ((length, 0.10), (3 * length, 0.10)):
        cells = max(int(reach / canvas.pixel), 1)
        mean = _box_mean(filled, cells) / np.maximum(_box_mean(weight, cells), 1e-9)
        buried = np.where(np.isfinite(depth), mean - filled, 0.0) / reach
        factor -= strength * np.clip(4.0 * buried, -0.6, 2.0)
    return factor


def _shrunk(picture: Floats, factor: int) -> Floats:
    """Averages factor x factor pixels; colours weighted by opacity."""
    rows, columns = (size // factor for size in picture.shape[:2])
    kept = picture[: rows * factor, : columns * factor]
    blocks = kept.reshape(rows, factor, columns, factor, 4).copy()
    blocks[..., :3] *= blocks[..., 3:]
    mean: Floats = blocks.mean(axis=(1, 3))
    mean[..., :3] /= np.maximum(mean[..., 3:], 1e-9)
    return mean


def top_heights(x: Floats, radius: Floats, low: Floats, high: Floats, cell: float) -> Floats:
    """Height of the uppermost sphere over each cell of a grid, NaN where there is none.

    low, high: corners (2) of the grid in plan; row 0 at the lowest y
    """
    canvas = Canvas(View.from_above(), low, high, cell)
    canvas.add_spheres(x, radius)
    heights = canvas.image(canvas.depth).copy()
    heights[~np.isfinite(heights)] = np.nan
    return heights
