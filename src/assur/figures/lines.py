"""Line work: outlines, creases and the curves in which parts meet, as exact vectors without what is hidden.

Where a line runs is geometry: the edges of the mesh, and the segments in which two of its triangles cross. Where it is
seen is asked of the painter: a sample of it is seen if the smooth face that it bounds is what shows within a fine
pixel of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.figures.canvas import View
from assur.figures.raster import SAMPLES, Buffers
from assur.scene.mesh import Mesh

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

SAME = 1e-7
"""Corners nearer to one another than this share of the whole are one."""

EDGE_ON = 1e-9
"""A face that is turned to the reader by no more is seen as a line."""

SPACING = 0.5
"""Distance of the samples of a line, in fine pixels."""

GAP, SHORT = 3, 2
"""So many hidden samples between seen ones, or at an end of an edge, are seen too; of a run at least so many steps."""

ON_IT = 5e-3
"""A line that is deeper than a face by less than this share of its own depth lies on it."""

DEEP = 0.1
"""A line is hidden by its own smooth face only where that is nearer by more than this share of the whole depth."""


@dataclass(frozen=True, eq=False)
class Edges:
    """Lines of a mesh, hidden or not.

    Attributes:
        ends: (e, 2, 3) in space.
        faces: (e, 2) the two triangles that it bounds; twice the same one at the rim of an open surface.
        outline: (e,) whether one of them is turned to the reader and the other one is not.
    """

    ends: FloatArray
    faces: IntArray
    outline: BoolArray


@dataclass(frozen=True, eq=False)
class LineWork:
    """Segments on the page, in points.

    Attributes:
        outlines: (k, 2, 2) where something ends for the eye.
        creases: (k, 2, 2) where two faces meet that are both turned to the reader.
    """

    outlines: FloatArray
    creases: FloatArray


def line_work(mesh: Mesh, view: View, buffers: Buffers, dots: float) -> LineWork:
    """What is seen of the lines of a mesh on a page that the painter has filled with `dots` pixels per inch.

    >>> from assur.figures.raster import filled
    >>> from assur.scene.camera import orthographic
    >>> from assur.scene.mesh import box
    >>> view = View(orthographic(30, 30), 10.0, np.array([30.0, 30.0]))
    >>> cube = box(np.zeros(3), np.eye(3), "#808080")
    >>> seen = line_work(cube, view, filled(cube, view, (60.0, 60.0), 144.0), 144.0)
    >>> len(seen.outlines), len(seen.creases)  # six of its twelve edges bound it, three are hidden
    (6, 3)
    """
    facing = facing_of(mesh, view)
    edges = _joined(mesh_edges(mesh, facing), meetings(mesh, buffers))
    scale = SAMPLES * dots / 72.0
    segments, owner = _seen(mesh, edges, view, buffers, scale)
    outline = edges.outline[owner]
    return LineWork(segments[outline], segments[~outline])


def facing_of(mesh: Mesh, view: View) -> FloatArray:
    """How much triangles (f,) are turned to the reader, from -1 to 1; NaN for those without an area."""
    a, b, c = (mesh.corners[:, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    sense = np.sign(np.sum(normal * mesh.normals.mean(axis=1), axis=1))
    extent = float(np.max(np.ptp(mesh.corners.reshape(-1, 3), axis=0), initial=0.0))
    whole = length > (SAME * extent) ** 2
    return np.where(whole, sense * (normal @ view.camera.toward) / np.where(whole, length, 1.0), np.nan)


def mesh_edges(mesh: Mesh, facing: FloatArray) -> Edges:
    """Edges that a reader could see: rims, those where the smooth face changes, and where it turns away.

    Args:
        mesh: closed parts or open surfaces.
        facing: (f,) how much a triangle is turned to the reader; NaN for those to be left out.
    """
    used = np.flatnonzero(np.isfinite(facing))
    extent = float(np.max(np.ptp(mesh.corners.reshape(-1, 3), axis=0), initial=0.0)) or 1.0
    keys = np.round(mesh.corners[used].reshape(-1, 3) / (SAME * extent)).astype(np.int64)
    point = np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1, 3)
    pairs = np.sort(point[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(used)), 3)
    side = np.tile(np.arange(3), len(used))
    order = np.lexsort((owner, pairs[:, 1], pairs[:, 0]))
    order = order[pairs[order, 0] != pairs[order, 1]]
    new = np.ones(len(order), dtype=bool)
    new[1:] = np.any(pairs[order[1:]] != pairs[order[:-1]], axis=1)
    rank = np.arange(len(order)) - np.maximum.accumulate(np.where(new, np.arange(len(order)), 0))
    # parts that share an edge have their faces one after the other: they are paired two by two
    first = np.flatnonzero(rank % 2 == 0)
    paired = np.append(rank[1:] % 2 == 1, False)[first]  # the next one is of the same edge
    one, two = order[first], np.where(paired, order[np.minimum(first + 1, len(order) - 1)], order[first])
    faces = used[owner[np.stack([one, two], axis=1)]]
    turned = facing[faces] > EDGE_ON
    outline = (turned[:, 0] != turned[:, 1]) | ~paired
    crease = mesh.patch[faces[:, 0]] != mesh.patch[faces[:, 1]]
    wanted = (outline | crease) & (np.any(turned, axis=1) | ~paired)
    start = mesh.corners[used[owner[one]], side[one]]
    end = mesh.corners[used[owner[one]], (side[one] + 1) % 3]
    return Edges(np.stack([start, end], axis=1)[wanted], faces[wanted], outline[wanted])


def meetings(mesh: Mesh, buffers: Buffers) -> Edges:
    """Segments in which two triangles cross that show side by side, as where a pin leaves a plate."""
    both = []
    for one, two in ((buffers.face[:, 1:], buffers.face[:, :-1]), (buffers.face[1:], buffers.face[:-1])):
        change = (one != two) & (one >= 0) & (two >= 0)
        change[change] = mesh.patch[one[change]] != mesh.patch[two[change]]
        both.append(np.stack([one[change], two[change]], axis=1))
    pairs = np.unique(np.sort(np.concatenate(both), axis=1), axis=0).astype(np.int64).reshape(-1, 2)
    first, second = mesh.corners[pairs[:, 0]], mesh.corners[pairs[:, 1]]
    cut, fine = _cut(first, second)
    other, also = _cut(second, first)
    along = cut[:, 1] - cut[:, 0]
    length = np.linalg.norm(along, axis=1)
    fine &= also & (length > 0)
    unit = along / np.where(length > 0, length, 1.0)[:, None]
    places = np.sort(np.einsum("pkx,px->pk", other - cut[:, :1], unit), axis=1)
    low, high = np.maximum(places[:, 0], 0.0), np.minimum(places[:, 1], length)
    extent = float(np.max(np.ptp(mesh.corners.reshape(-1, 3), axis=0), initial=0.0))
    fine &= high - low > SAME * extent
    ends = cut[:, :1] + np.stack([low, high], axis=1)[..., None] * unit[:, None]
    return Edges(ends[fine], pairs[fine], np.zeros(int(fine.sum()), dtype=bool))


def _cut(first: FloatArray, second: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Where the sides of triangles (p, 3, 3) cross the planes of others: (p, 2, 3), and where they do."""
    normal = np.cross(second[:, 1] - second[:, 0], second[:, 2] - second[:, 0])
    away = np.einsum("pkx,px->pk", first - second[:, :1], normal)
    after = np.roll(away, -1, axis=1)
    crosses = (away > 0) != (after > 0)
    fine = np.sum(crosses, axis=1) == 2
    share = away / np.where(away == after, 1.0, away - after)
    points = first + share[..., None] * (np.roll(first, -1, axis=1) - first)
    order = np.argsort(~crosses, axis=1, kind="stable")[:, :2]
    return np.take_along_axis(points, order[..., None], axis=1), fine


def _joined(one: Edges, two: Edges) -> Edges:
    return Edges(
        np.concatenate([one.ends, two.ends]),
        np.concatenate([one.faces, two.faces]),
        np.concatenate([one.outline, two.outline]),
    )


def _seen(mesh: Mesh, edges: Edges, view: View, buffers: Buffers, scale: float) -> tuple[FloatArray, IntArray]:
    """Segments (k, 2, 2) in points that are seen, and the edge (k,) that each is a part of."""
    flat, steps, owner, share, at, depth = _samples(edges.ends, view, scale)
    room = DEEP * float(np.ptp(view.camera.depth(mesh.corners)))
    visible = _shows(mesh, mesh.patch[edges.faces][owner], at, depth + room, buffers)
    return _runs(visible, owner, share, steps, flat)


def before(lines: FloatArray, view: View, buffers: Buffers, dots: float) -> FloatArray:
    """What of segments (e, 2, 3) in space nothing on a page hides: segments (k, 2, 2) on it, in points.

    They need not be edges of what the page shows. One that lies on a face is seen.

    >>> from assur.figures.raster import filled
    >>> from assur.scene.camera import orthographic
    >>> from assur.scene.mesh import box
    >>> view = View(orthographic(0, 0), 10.0, np.array([30.0, 30.0]))
    >>> found = filled(box(np.zeros(3), np.eye(3), "#808080"), view, (60.0, 60.0), 144.0)
    >>> behind = np.array([[[-5.0, -2.0, 0.0], [-5.0, 2.0, 0.0]]])
    >>> before(behind, view, found, 144.0)[:, :, 0].round(0).tolist()
    [[10.0, 20.0], [40.0, 50.0]]
    """
    flat, steps, owner, share, at, depth = _samples(lines, view, SAMPLES * dots / 72.0)
    height, width = buffers.depth.shape
    column, row = np.round(at).astype(int).T
    inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    there = buffers.depth[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
    room = ON_IT * float(np.ptp(depth)) if len(depth) else 0.0
    return _runs(~inside | (depth >= there - room), owner, share, steps, flat)[0]


def _samples(
    lines: FloatArray, view: View, scale: float
) -> tuple[FloatArray, IntArray, IntArray, FloatArray, FloatArray, FloatArray]:
    """Of segments (e, 2, 3): their ends on the page and numbers of steps; of samples: segment, share, pixel, depth."""
    flat, near = view(lines), view.camera.depth(lines)
    steps = np.ceil(scale * np.linalg.norm(flat[:, 1] - flat[:, 0], axis=1) / SPACING).astype(np.int64) + 1
    count = steps + 1
    owner = np.repeat(np.arange(len(steps)), count)
    place = np.arange(int(count.sum())) - np.repeat(np.cumsum(count) - count, count)
    share = place / steps[owner]
    at = scale * (flat[owner, 0] + share[:, None] * (flat[owner, 1] - flat[owner, 0])) - 0.5
    return flat, steps, owner, share, at, near[owner, 0] + share * (near[owner, 1] - near[owner, 0])


def _shows(mesh: Mesh, patch: IntArray, at: FloatArray, depth: FloatArray, buffers: Buffers) -> BoolArray:
    """Whether samples (s,) at fine pixels (s, 2) are seen: one of their patches (s, 2) shows beside them, no nearer."""
    height, width = buffers.face.shape
    column, row = np.round(at).astype(int).T
    visible = np.zeros(len(at), dtype=bool)
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            y, x = row + down, column + right
            inside = (y >= 0) & (y < height) & (x >= 0) & (x < width)
            y, x = np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)
            face = buffers.face[y, x]
            own = inside & (face >= 0) & np.any(mesh.patch[face][:, None] == patch, axis=1)
            visible |= own & (depth >= buffers.depth[y, x])
    return visible


def _runs(
    visible: BoolArray, owner: IntArray, share: FloatArray, steps: IntArray, flat: FloatArray
) -> tuple[FloatArray, IntArray]:
    """Segments from the first to the last of the samples that are seen one after the other."""
    seen = np.flatnonzero(visible)
    if not len(seen):
        return np.zeros((0, 2, 2)), np.zeros(0, dtype=np.int64)
    broken = (np.diff(seen) > GAP + 1) | (np.diff(owner[seen]) != 0)
    first = seen[np.append(True, broken)]
    last = seen[np.append(broken, True)]
    begin = np.cumsum(steps + 1) - steps - 1
    # what begins or ends next to an end of its edge begins or ends there
    first = np.where(first - begin[owner[first]] <= GAP, begin[owner[first]], first)
    finish = begin[owner[first]] + steps[owner[first]]
    last = np.where(finish - last <= GAP, finish, last)
    kept = (last - first >= steps[owner[first]]) | (last - first >= SHORT)
    first, last = first[kept], last[kept]
    start, way = flat[owner[first], 0], flat[owner[first], 1] - flat[owner[first], 0]
    ends = np.stack([start + share[k][:, None] * way for k in (first, last)], axis=1)
    return ends, owner[first].astype(np.int64)
