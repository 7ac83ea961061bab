"""The painter: triangles to pixels with a depth for every pixel, so that what is hidden is hidden exactly.

A parallel projection keeps depth linear over a triangle; the nearest one wins at each pixel. Edges are
drawn where the smooth face behind a pixel changes. Four pixels of this picture become one of the result.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import View
from assur.scene.mesh import Mesh

FloatArray = NDArray[np.float64]
Floats = NDArray[np.float32]
SAMPLES = 2
"""Fine pixels along each side of a pixel."""

LIGHTS = ((np.array([-0.35, 0.55, 0.76]), 0.53), (np.array([0.75, 0.1, 0.65]), 0.22))
"""Directions on the page (right, up, towards the reader) and strengths."""

TIE = 2e-4
"""Of faces nearer to one another than this share of the whole depth the first one is seen, so that they do not mix."""

SEAM = 1e-5
"""By what share of its size a triangle is painted too large, so that rounding leaves no seam to the next one."""

AMBIENT = 0.48
EDGE = np.array([0.12, 0.12, 0.12])


@dataclass(frozen=True, eq=False)
class Buffers:
    """What is nearest at every fine pixel, row 0 at the bottom.

    Attributes:
        face: (h, w) index of the triangle, -1 where there is none.
        depth: (h, w) how near it is; -inf where there is none.
    """

    face: NDArray[np.int32]
    depth: NDArray[np.float32]


def buffers(flat: FloatArray, near: FloatArray, faces: NDArray[np.intp], width: int, height: int) -> Buffers:
    """Fill the buffers with some of the triangles, their corners at (f, 3, 2) in fine pixels and (f, 3) near.

    Pixel (i, j) stands for the point (j, i).

    >>> square = np.array([[[0.0, 0], [2, 0], [2, 2]], [[0, 0], [2, 2], [0, 2]]])
    >>> found = buffers(square, np.ones((2, 3)), np.arange(2), 4, 4)
    >>> int((found.face >= 0).sum()), float(found.depth.max())
    (9, 1.0)
    """
    face = np.full((height, width), -1, dtype=np.int32)
    depth = np.full((height, width), -np.inf, dtype=np.float32)
    low = np.clip(np.ceil(flat.min(axis=1)).astype(int), 0, [width, height])
    high = np.clip(np.floor(flat.max(axis=1)).astype(int) + 1, 0, [width, height])
    tie = TIE * float(np.ptp(near)) if near.size else 0.0
    for k in faces[np.all(high > low, axis=1)[faces]]:
        (x0, y0), (x1, y1) = low[k], high[k]
        (ax, ay), (bx, by), (cx, cy) = flat[k].tolist()
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if abs(area) < 1e-12:
            continue
        dx = (np.arange(x0, x1) - ax).astype(np.float32)
        dy = (np.arange(y0, y1) - ay).astype(np.float32)[:, None]
        second = dx * ((cy - ay) / area) - dy * ((cx - ax) / area)  # barycentric weights of b and c
        third = dy * ((bx - ax) / area) - dx * ((by - ay) / area)
        first, *others = near[k].tolist()
        here = first + second * (others[0] - first) + third * (others[1] - first)
        part = (slice(y0, y1), slice(x0, x1))
        wins = (second >= -SEAM) & (third >= -SEAM) & (second + third <= 1 + SEAM)
        wins &= here > depth[part] + tie
        depth[part][wins] = here[wins]
        face[part][wins] = k
    return Buffers(face, depth)


def filled(mesh: Mesh, view: View, size: tuple[float, float], dots: float, *, solid: bool = True) -> Buffers:
    """What is nearest on a page of size points, at `SAMPLES` times `dots` fine pixels per inch.

    `solid` says that all is closed, so that faces turned away need not be painted.
    """
    scale = SAMPLES * dots / 72.0
    width, height = (SAMPLES * max(1, round(side * scale / SAMPLES)) for side in size)
    turned = np.any(mesh.normals @ view.camera.toward > -1e-9, axis=1)
    faces = np.flatnonzero(turned) if solid else np.arange(len(turned))
    return buffers(_fine(mesh, view, dots), view.camera.depth(mesh.corners), faces, width, height)


def _fine(mesh: Mesh, view: View, dots: float) -> FloatArray:
    """Corners (f, 3, 2) in fine pixels, whose centres are at whole numbers."""
    return SAMPLES * dots / 72.0 * view(mesh.corners) - 0.5


def lit(mesh: Mesh, view: View, buffers: Buffers, dots: float, *, edges: bool = True) -> FloatArray:
    """The picture (h, w, 4) of what is nearest, with light on it."""
    flat = _fine(mesh, view, dots)
    height, width = buffers.face.shape
    seen = buffers.face >= 0
    index = buffers.face[seen]
    weights = _weights(flat, index, seen)
    colour = mesh.colour.astype(np.float32)[index]
    light = _light(_interpolated(mesh.normals.astype(np.float32), index, weights), view)
    image = np.zeros((height, width, 4), dtype=np.float32)
    image[seen, :3] = np.minimum(colour * light[:, None], 1.0)
    image[seen, 3] = 1.0
    if edges:
        line = _changes(np.where(seen, mesh.patch[buffers.face], -1))
        image[line] = [*EDGE, 1.0]
    return _coarse(image)


def _weights(flat: FloatArray, index: NDArray[np.int32], seen: NDArray[np.bool_]) -> tuple[Floats, Floats]:
    """Barycentric weights (n,) of the second and third corner at the pixels that show something."""
    row, column = np.nonzero(seen)
    first = flat[:, 1] - flat[:, 0]
    second = flat[:, 2] - flat[:, 0]
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    area = np.where(np.abs(area) < 1e-12, 1.0, area)
    # each weight is linear over the page
    slopes = np.stack([second[:, 1] / area, -second[:, 0] / area, -first[:, 1] / area, first[:, 0] / area], axis=1)
    starts = np.einsum("fkx,fx->fk", slopes.reshape(-1, 2, 2), flat[:, 0])
    b = column * slopes[index, 0] + row * slopes[index, 1] - starts[index, 0]
    c = column * slopes[index, 2] + row * slopes[index, 3] - starts[index, 1]
    return b.astype(np.float32), c.astype(np.float32)


def _interpolated(values: Floats, index: NDArray[np.int32], weights: tuple[Floats, Floats]) -> Floats:
    """Values at corners (f, 3, d), as they are at pixels (n, d)."""
    first, second = values[:, 1] - values[:, 0], values[:, 2] - values[:, 0]
    found: Floats = values[index, 0]
    varying = np.flatnonzero(np.any(np.abs(first) + np.abs(second) > 1e-7, axis=1)[index])
    own = index[varying]
    found[varying] += weights[0][varying, None] * first[own] + weights[1][varying, None] * second[own]
    return found


def _light(normals: Floats, view: View) -> Floats:
    """Brightness (n,) of faces with these normals; both sides of a face are lit."""
    towards = view.camera.toward
    up = np.array([0.0, 0.0, 1.0]) if abs(towards[2]) < 0.999 else np.array([0.0, 1.0, 0.0])
    right = np.cross(up, towards)
    right = right / np.linalg.norm(right)
    page = np.stack([right, np.cross(towards, right), towards])
    ways = np.stack([towards, *(way / np.linalg.norm(way) @ page for way, _ in LIGHTS)]).astype(np.float32)
    local = normals @ ways.T  # (n, 1 + lights)
    sense = np.where(local[:, 0] < 0, np.float32(-1), np.float32(1)) / np.maximum(
        np.linalg.norm(normals, axis=1), 1e-12
    )
    bright = np.full(len(local), AMBIENT, dtype=np.float32)
    for k, (_, strength) in enumerate(LIGHTS):
        bright += np.float32(strength) * np.maximum(local[:, k + 1] * sense, 0.0)
    return bright


def _changes(patch: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Fine pixels beside which the patch is another one."""
    change = np.zeros(patch.shape, dtype=bool)
    across, along = patch[:, 1:] != patch[:, :-1], patch[1:] != patch[:-1]
    change[:, 1:] |= across
    change[:, :-1] |= across
    change[1:] |= along
    change[:-1] |= along
    return change


def _coarse(image: NDArray[np.float32]) -> FloatArray:
    """Means over squares of fine pixels, colours weighted by how opaque they are, row 0 at the top."""
    parts = [image[i::SAMPLES, k::SAMPLES] for i in range(SAMPLES) for k in range(SAMPLES)]
    alpha = sum(part[..., 3:] for part in parts) / len(parts)
    colour = sum(part[..., :3] * part[..., 3:] for part in parts) / len(parts)
    return np.concatenate([colour / np.maximum(alpha, 1e-12), alpha], axis=-1)[::-1].astype(float)
