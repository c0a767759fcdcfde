# SPDX-License-Identifier: GPL-2.0-or-later
"""A z-buffer for spheres and triangles in numpy, seen in parallel projection.

Points x are (n, 3) in world units; images have row 0 at the bottom unless stated otherwise.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Integers
from ..read.results import Surface

NOTHING = -1  # index of the object in pixels that show none
AT_ONCE = 200_000  # pixels of the rectangles around triangles, which limits the memory


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

        def weights(t: Integers, column: Integers, row: Integers) -> Floats:
            """(3, n) barycentric coordinates of pixels' middles in triangles"""
            a, b, c = pixels[t, :, :2].transpose(1, 2, 0)
            v = ((column - a[0]) * (c[1] - a[1]) - (row - a[1]) * (c[0] - a[0])) / area[t]
            w = ((b[0] - a[0]) * (row - a[1]) - (b[1] - a[1]) * (column - a[0])) / area[t]
            return np.stack([1 - v - w, v, w])

        drawn = np.flatnonzero((highest > lowest).all(axis=1) & (area != 0))
        size = highest - lowest
        batch = np.cumsum(size[drawn].prod(axis=1)) // AT_ONCE
        for part in np.split(drawn, np.flatnonzero(np.diff(batch)) + 1):
            which, number = counted(size[part].prod(axis=1))
            t = part[which]
            row, column = lowest[t, 1] + number // size[t, 0], lowest[t, 0] + number % size[t, 0]
            share = weights(t, column, row)
            # the first of triangles equally near is kept, as the last of the reversed ones
            inside = np.flatnonzero((share >= 0).all(axis=0))[::-1]
            t = t[inside]
            depth = (share[:, inside] * pixels[t, :, 2].T).sum(axis=0)
            where = row[inside] * self.width + column[inside]
            self._keep_nearest(where, depth, first_object + t)
        if normal is not None:
            of_these = (self.object >= first_object) & (self.object < first_object + len(area))
            seen = np.flatnonzero(of_these)
            t = self.object[seen] - first_object
            share = weights(t, seen % self.width, seen // self.width)
            mixed = (share.T[..., None] * normals[t]).sum(axis=1)
            normal[seen] = mixed / np.linalg.norm(mixed, axis=1, keepdims=True)

    def world_points(self, pixels: Integers) -> Floats:
        """(n, 3) The points that n pixels show; at infinity where they show none."""
        row, column = np.divmod(pixels, self.width)
        right = self.low[0] + (column + 0.5) * self.pixel
        up = self.low[1] + (row + 0.5) * self.pixel
        axes: Floats = np.vstack([self.view.right, self.view.up, self.view.towards])
        shown: Floats = np.column_stack([right, up, self.depth[pixels]])
        points: Floats = shown @ axes
        return points


def counted(counts: Integers) -> tuple[Integers, Integers]:
    """For counts (2, 3) the groups 0 0 1 1 1, and numbers in each group 0 1 0 1 2."""
    which = np.repeat(np.arange(len(counts)), counts)
    number = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    return which, number


def top_heights(x: Floats, radius: Floats, low: Floats, high: Floats, cell: float) -> Floats:
    """Height of the uppermost sphere over each cell of a grid, NaN where there is none.

    low, high: corners (2) of the grid in plan; row 0 at the lowest y
    """
    canvas = Canvas(View.from_above(), low, high, cell)
    canvas.add_spheres(x, radius)
    heights = canvas.image(canvas.depth).copy()
    heights[~np.isfinite(heights)] = np.nan
    return heights
