# SPDX-License-Identifier: GPL-2.0-or-later
"""A z-buffer for spheres and triangles in numpy: parallel projection, one sun with shadow, ambient occlusion."""

from dataclasses import dataclass

import numpy as np

NOTHING = -1


def round_up(value):
    """The end of a scale: to 1, 1.5, 2, 3, 5, 7 times a power of ten."""
    if not value > 0:
        return 1e-3
    power = 10.0 ** np.floor(np.log10(value))
    return power * min(step for step in (1, 1.5, 2, 3, 5, 7, 10) if step * power >= value * (1 - 1e-9))


@dataclass
class View:
    """A parallel projection: world point -> (right, up, towards the viewer), each a unit vector."""

    right: np.ndarray
    up: np.ndarray
    towards: np.ndarray

    @classmethod
    def of_angles(cls, azimuth, elevation):
        """The viewer stands at this azimuth from the x axis and elevation above the ground [degrees], looking at the origin."""
        a, e = np.radians([azimuth, elevation])
        towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
        right = np.array([-np.sin(a), np.cos(a), 0.0])
        return cls(right, np.cross(towards, right), towards)

    @classmethod
    def from_above(cls):
        return cls(np.array([1.0, 0, 0]), np.array([0, 1.0, 0]), np.array([0, 0, 1.0]))

    def project(self, points):
        return points @ np.column_stack([self.right, self.up, self.towards])


class Canvas:
    """Depth (towards the viewer, in world units) and the nearest object at each pixel.

    low, high: opposite corners in the (right, up) plane; pixel: side of a pixel in world units. Row 0 is at the bottom.
    """

    def __init__(self, view, low, high, pixel):
        self.view, self.pixel = view, pixel
        self.low = np.asarray(low, float)
        self.width, self.height = np.maximum(np.ceil((np.asarray(high) - self.low) / pixel).astype(int), 1)
        self.depth = np.full(self.height * self.width, -np.inf)
        self.object = np.full(self.height * self.width, NOTHING, np.int64)
        self.normal = None

    def image(self, values):
        return values.reshape(self.height, self.width, *values.shape[1:])

    def add_spheres(self, x, radius):
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
                hit = np.flatnonzero((cap > 0) & (column >= 0) & (column < self.width) & (row >= 0) & (row < self.height))
                self._keep_nearest(row[hit] * self.width + column[hit], centre[hit, 2] + self.pixel * np.sqrt(cap[hit]), hit)

    def _keep_nearest(self, pixel, depth, what):
        nearer = depth > self.depth[pixel]
        pixel, depth, what = pixel[nearer], depth[nearer], what[nearer]
        order = np.argsort(depth, kind="stable")  # of several on one pixel the last assignment stays: the nearest
        pixel = pixel[order]
        self.depth[pixel] = depth[order]
        self.object[pixel] = what[order]

    def sphere_normals(self, x, radius):
        """Unit normals (view axes) of the pixels that show a sphere; zero elsewhere."""
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

    def add_triangles(self, x, triangles, corner_normals, first_object, normal=None):
        """Triangles become the objects first_object ...; their normals (world axes) are written into normal (view axes)."""
        corners = self.view.project(x)[triangles]
        normals = self.view.project(corner_normals)
        pixels = corners.copy()
        pixels[..., :2] = (corners[..., :2] - self.low) / self.pixel - 0.5
        lowest = np.maximum(np.floor(pixels[..., :2].min(axis=1)).astype(int), 0)
        highest = np.minimum(np.ceil(pixels[..., :2].max(axis=1)).astype(int) + 1, [self.width, self.height])
        area = np.cross(pixels[:, 1, :2] - pixels[:, 0, :2], pixels[:, 2, :2] - pixels[:, 0, :2])
        for t in np.flatnonzero((highest > lowest).all(axis=1) & (area != 0)):
            column, row = np.meshgrid(np.arange(lowest[t, 0], highest[t, 0]), np.arange(lowest[t, 1], highest[t, 1]))
            a, b, c = pixels[t, :, :2]
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

    def world_points(self):
        """The point each pixel shows (n, 3); pixels without an object give points at infinity."""
        row, column = np.divmod(np.arange(self.depth.size), self.width)
        right = self.low[0] + (column + 0.5) * self.pixel
        up = self.low[1] + (row + 0.5) * self.pixel
        return np.column_stack([right, up, self.depth]) @ np.vstack([self.view.right, self.view.up, self.view.towards])


def corner_normals(x, triangles, crease=40.0):
    """Unit normals (m, 3, 3) at the corners of triangles: smooth, but sharp over edges that turn more than crease [degrees]."""
    corners = x[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = face / np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-300)
    around = [[] for _ in range(len(x))]
    for t, nodes in enumerate(triangles):
        for node in nodes:
            around[node].append(t)
    normals = np.empty((len(triangles), 3, 3))
    limit = np.cos(np.radians(crease))
    for t, nodes in enumerate(triangles):
        for k, node in enumerate(nodes):
            near = around[node]
            normals[t, k] = face[near][unit[near] @ unit[t] > limit].sum(axis=0)
    return normals / np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-300)


def _blur(image, reach):
    """Box mean over (2 reach + 1)^2 pixels, the edge repeated."""
    for axis in (0, 1):
        padded = np.concatenate([np.repeat(image.take([0], axis), reach + 1, axis), image,
                                 np.repeat(image.take([-1], axis), reach, axis)], axis)
        total = padded.cumsum(axis)
        n = image.shape[axis]
        image = (total.take(range(2 * reach + 1, 2 * reach + 1 + n), axis) - total.take(range(n), axis)) / (2 * reach + 1)
    return image


def _bounds(view, x, margin):
    projected = view.project(x)[:, :2]
    return projected.min(axis=0) - margin, projected.max(axis=0) + margin


def shaded_picture(grains_x, radius, grain_colours, surface, view, pixel, sun=View.of_angles(-75.0, 48.0),
                   surface_colour=(0.36, 0.40, 0.45), supersample=2):
    """An RGBA picture (rows from the top, 0 ... 1) of spheres and a triangulated surface or None; pixel: world units a pixel.

    Returns (picture, extent) with extent (left, right, bottom, top) in the view's plane, world units.
    """
    solid = [grains_x]
    if surface is not None:
        triangles, nodes = surface
        normals = corner_normals(nodes, triangles)
        solid.append(nodes)
    everything = np.concatenate(solid)
    margin = 2 * radius.max()

    canvas = Canvas(view, *_bounds(view, everything, margin), pixel / supersample)
    canvas.add_spheres(grains_x, radius)
    normal = canvas.sphere_normals(grains_x, radius)
    colours = grain_colours
    if surface is not None:
        canvas.add_triangles(nodes, triangles, normals, len(radius), normal)
        colours = np.concatenate([colours, np.tile(surface_colour, (len(triangles), 1))])

    shadow_map = Canvas(sun, *_bounds(sun, everything, margin), max(pixel, 0.35 * radius.mean()))
    shadow_map.add_spheres(grains_x, radius)
    if surface is not None:
        shadow_map.add_triangles(nodes, triangles, normals, len(radius))

    seen = np.flatnonzero(canvas.object != NOTHING)
    facing = np.clip(normal[seen] @ canvas.view.project(sun.towards), 0, 1)
    light = facing * _lit(shadow_map, canvas.world_points()[seen], 0.7 * radius.mean())
    brightness = np.zeros(canvas.depth.size)
    brightness[seen] = 0.42 + 0.26 * normal[seen] @ canvas.view.project(np.array([0, 0, 1.0])).clip(0) + 0.62 * light
    brightness = canvas.image(brightness) * _openness(canvas, 3.0 * radius.mean())

    picture = np.zeros((canvas.height, canvas.width, 4))
    flat = picture.reshape(-1, 4)
    flat[seen, :3] = np.clip(colours[canvas.object[seen]] * brightness.reshape(-1)[seen, None], 0, 1)
    flat[seen, 3] = 1
    extent = (canvas.low[0], canvas.low[0] + canvas.width * canvas.pixel, canvas.low[1],
              canvas.low[1] + canvas.height * canvas.pixel)
    return _shrink(picture, supersample)[::-1], extent


def _lit(shadow_map, points, bias):
    """Share of the sun that reaches points, 0 ... 1, smoothed over neighbouring cells of the shadow map."""
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


def _openness(canvas, length):
    """Ambient occlusion: darker where the surroundings (within length) stand nearer to the viewer than the pixel."""
    depth = canvas.image(canvas.depth)
    filled = np.where(np.isfinite(depth), depth, 0.0)
    weight = np.isfinite(depth).astype(float)
    factor = np.ones_like(depth)
    for reach, strength in ((length, 0.10), (3 * length, 0.10)):
        cells = max(int(reach / canvas.pixel), 1)
        mean = _blur(filled, cells) / np.maximum(_blur(weight, cells), 1e-9)
        buried = np.where(np.isfinite(depth), mean - filled, 0.0) / reach
        factor -= strength * np.clip(4.0 * buried, -0.6, 2.0)
    return factor


def _shrink(picture, n):
    """Averages n x n pixels; colours weighted by opacity."""
    rows, columns = (size // n * n for size in picture.shape[:2])
    blocks = picture[:rows, :columns].reshape(rows // n, n, columns // n, n, 4).copy()
    blocks[..., :3] *= blocks[..., 3:]
    mean = blocks.mean(axis=(1, 3))
    mean[..., :3] /= np.maximum(mean[..., 3:], 1e-9)
    return mean


def top_heights(x, radius, low, high, cell):
    """Height of the uppermost sphere over each cell of a grid [m], NaN where there is none; row 0 at the lowest y."""
    canvas = Canvas(View.from_above(), low, high, cell)
    canvas.add_spheres(x, radius)
    heights = canvas.image(canvas.depth).copy()
    heights[~np.isfinite(heights)] = np.nan
    return heights
