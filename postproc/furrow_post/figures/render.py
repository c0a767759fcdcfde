# SPDX-License-Identifier: GPL-2.0-or-later
"""A shaded picture of spheres and triangles: one sun with shadow, ambient occlusion; cuts of triangles by a plane."""

import numpy as np
from scipy.ndimage import uniform_filter

from ..arrays import Floats
from ..read.results import Surface
from .canvas import NOTHING, Canvas, View, counted

SUPERSAMPLE = 2  # pixels of the canvas along each side of one of the picture
CREASE = 40.0  # largest turn over a smooth edge [degrees]
SURFACE_COLOUR = (0.36, 0.40, 0.45)
SUN = View.of_angles(-75.0, 48.0)
FOLLOWING = [1, 2, 0]  # corner at the other end of an edge of a triangle
OBLIQUE = View.of_angles(-112.0, 30.0)  # from behind and beside the wheel


def corner_normals(surface: Surface) -> Floats:
    """(m, 3, 3) Unit normals at the corners of triangles: smooth, but sharp over edges that turn by more than CREASE."""
    x, triangles = surface.x, surface.triangles
    corners = x[triangles]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = face / np.maximum(np.linalg.norm(face, axis=1, keepdims=True), 1e-300)
    # pairs of a corner with all corners at its node, sorted by node
    node = triangles.ravel()
    at_node = np.bincount(node, minlength=len(x))
    sorted_corners = np.argsort(node, kind="stable")
    corner, number = counted(at_node[node])
    near = sorted_corners[(np.cumsum(at_node) - at_node)[node[corner]] + number] // 3
    limit = np.cos(np.radians(CREASE))
    smooth = (unit[near] * unit[corner // 3]).sum(axis=1) > limit
    corner, near = corner[smooth], near[smooth]
    sums = [np.bincount(corner, face[near, k], len(node)) for k in range(3)]
    normals = np.stack(sums, axis=1).reshape(-1, 3, 3)
    length = np.linalg.norm(normals, axis=2, keepdims=True)
    unit_normals: Floats = normals / np.maximum(length, 1e-300)
    return unit_normals


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
    shadow_map = Canvas(SUN, *_bounds(SUN, everything, margin), max(pixel, 0.35 * radius.mean()))
    shadow_map.add_spheres(x, radius)
    if surface is not None:
        at_corners = corner_normals(surface)
        canvas.add_triangles(surface, at_corners, len(radius), normal)
        shadow_map.add_triangles(surface, at_corners, len(radius))
        of_surface = np.tile(SURFACE_COLOUR, (len(surface.triangles), 1))
        colours = np.concatenate([colours, of_surface])

    seen = np.flatnonzero(canvas.object != NOTHING)
    facing = np.clip(normal[seen] @ canvas.view.project(SUN.towards), 0, 1)
    light = facing * _lit(shadow_map, canvas.world_points(seen), 0.7 * radius.mean())
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
    depth = canvas.image(canvas.depth)[::SUPERSAMPLE, ::SUPERSAMPLE]  # the depth varies little within a pixel
    filled = np.where(np.isfinite(depth), depth, 0.0)
    weight = np.isfinite(depth).astype(float)
    factor = np.ones_like(depth)
    for reach, strength in ((length, 0.10), (3 * length, 0.10)):
        cells = max(int(reach / (SUPERSAMPLE * canvas.pixel)), 1)
        around, known = (uniform_filter(image, 2 * cells + 1, mode="nearest") for image in (filled, weight))
        mean = around / np.maximum(known, 1e-9)
        buried = np.where(np.isfinite(depth), mean - filled, 0.0) / reach
        factor -= strength * np.clip(4.0 * buried, -0.6, 2.0)
    for axis in (0, 1):
        factor = factor.repeat(SUPERSAMPLE, axis)
    return factor[: canvas.height, : canvas.width]


def _shrunk(picture: Floats, factor: int) -> Floats:
    """Averages factor x factor pixels; colours, 0 where nothing is seen, weighted by opacity."""
    rows, columns = (size // factor for size in picture.shape[:2])
    blocks = picture[: factor * rows, : factor * columns].reshape(rows, factor, columns, factor, 4)
    mean: Floats = blocks.mean(axis=(1, 3))
    mean[..., :3] /= np.maximum(mean[..., 3:], 1e-9)
    return mean


def cut(surface: Surface, axis: int, position: float) -> Floats:
    """Segments (k, 2, 3) in which triangles cross the plane x[axis] = position [m]."""
    corners = surface.x[surface.triangles]
    side = corners[:, :, axis] - position
    crossed = (side < 0) != (side[:, FOLLOWING] < 0)  # (m, 3) edges: two of a triangle, or none
    a, b = corners[crossed], corners[:, FOLLOWING][crossed]
    side_a, side_b = side[crossed], side[:, FOLLOWING][crossed]
    segments: Floats = (a + (side_a / (side_a - side_b))[:, None] * (b - a)).reshape(-1, 2, 3)
    return segments
