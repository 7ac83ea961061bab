"""Collisions: how near links come to one another, over poses of the workspace or along a motion.

Broad phase: a box and a capsule about every part; the distances of all of them at all poses at once, along their
axes, are never larger than those of the parts. Narrow phase: the distance of the parts, all convex, where a bound is
smaller than what was found. Links that share a joint are left out: they touch where they are hinged.

Links are those that `assur.scene.bodies` draws, thicknesses and all. Between two poses links may come nearer.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.frames import Frame, frames
from assur.model.mechanism import MechanismRecord
from assur.numerics.convex_distance import convex_distance, nearest_points
from assur.numerics.segments import segment_distances
from assur.scene.bodies import LinkBody, bodies, corners

FloatArray = NDArray[np.float64]
Step = Callable[[int, int], None]
CLOSE = 1e-4
"""Share of a clearance within which it is the least one."""


@dataclass(frozen=True, eq=False)
class Nearest:
    """How near two links come.

    Attributes:
        links: their names.
        clearance: the least distance of their solids over all poses, in length units; 0 where they meet.
        parts: names of the parts that are nearest there.
        joints: (n,) joint values of that configuration.
        row: which one of those given it is.
        meeting: how many configurations have them meet.
    """

    links: tuple[str, str]
    clearance: float
    parts: tuple[str, str]
    joints: FloatArray
    row: int
    meeting: int


@dataclass(frozen=True, eq=False)
class Collisions:
    """Every pair of links that share no joint, the nearest first; `poses` is how many configurations were asked."""

    record: MechanismRecord
    pairs: tuple[Nearest, ...]
    poses: int

    @property
    def meeting(self) -> tuple[Nearest, ...]:
        """The pairs that meet somewhere."""
        return tuple(pair for pair in self.pairs if pair.meeting)


def collisions(record: MechanismRecord, joints: FloatArray, step: Step | None = None) -> Collisions:
    """The least distance of every two links over configurations (k, n), k at least 1.

    `step` is told how many pairs of links are done, of how many.

    Errors: `UsageError` for another shape.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("fivebar")
    >>> [item.links for item in collisions(record, home_values(record)[None]).pairs[:2]]
    [('base', 'rod2'), ('base', 'rod1')]
    """
    if joints.ndim != 2 or not len(joints):
        raise UsageError(f"collisions: joint values of shape {joints.shape}; (k, {len(record.coordinates)}) are wanted")
    placed = frames(record, joints)
    made = {body.link: _hulls(body, placed[body.link]) for body in bodies(record)}
    hinged = [{joint.parent, joint.child} for joint in record.joints.values()]
    asked = [pair for pair in combinations(made, 2) if set(pair) not in hinged]
    nearest = []
    for k, (first, second) in enumerate(asked):
        distance, row, names, meeting = _nearest(made[first], made[second])
        nearest.append(Nearest((first, second), distance, names, joints[row], row, meeting))
        if step is not None:
            step(k + 1, len(asked))
    nearest.sort(key=lambda pair: (pair.clearance, -pair.meeting))
    return Collisions(record, tuple(nearest), len(joints))


def ends(record: MechanismRecord, nearest: Nearest) -> FloatArray:
    """The nearest points (2, 3) of two links, in the base frame of their configuration; one point where they meet.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("fivebar")
    >>> nearest = collisions(record, home_values(record)[None]).pairs[0]
    >>> first, second = ends(record, nearest)
    >>> bool(abs(np.linalg.norm(second - first) - nearest.clearance) < 1e-3)
    True
    """
    placed = frames(record, nearest.joints)
    clouds = []
    for link, name in zip(nearest.links, nearest.parts, strict=True):
        rotation, origin = placed[link]
        body = next(candidate for candidate in bodies(record) if candidate.link == link)
        of_name = [part for part in (*body.fused, *body.pins) if part.name == name]  # plates of a fork share a name
        clouds.append([np.unique(corners(part.shape), axis=0) @ rotation.T + origin for part in of_name])
    pairs = [nearest_points(near, far) for near in clouds[0] for far in clouds[1]]
    return min(pairs, key=lambda pair: float(np.linalg.norm(pair[1] - pair[0])))


def _nearest(first: _Hulls, second: _Hulls) -> tuple[float, int, tuple[str, str], int]:
    """Least distance of two links, where it is, the parts' names, and in how many configurations they meet."""
    bounds = _bounds(first, second)  # (k, p, q)
    rotation, origin = _relative(first.placed, second.placed)
    meets = np.zeros(len(origin), dtype=bool)
    best, where, names = np.inf, 0, ("", "")
    pairs = np.dstack(np.unravel_index(np.argsort(bounds.min(axis=0), axis=None), bounds.shape[1:]))[0]
    for a, b in pairs:
        lower = bounds[:, a, b]
        lowest = int(np.argmin(lower))
        for rows in (np.array([lowest]), np.arange(len(lower))):  # the first tells which of the others are worth it
            rows = rows[(lower[rows] < (1.0 - CLOSE) * best) | ((lower[rows] <= 0.0) & ~meets[rows])]
            if not len(rows):
                continue
            gaps = convex_distance(first.points[a], second.points[b], rotation[rows], origin[rows], CLOSE / 10)
            meets[rows] |= gaps <= 0.0
            if gaps.min() < best:
                k = int(np.argmin(gaps))
                best, where, names = float(gaps[k]), int(rows[k]), (first.names[a], second.names[b])
    return best, where, names, int(meets.sum())


def _relative(first: Frame, second: Frame) -> Frame:
    """The second frames (k, ...) in the first ones."""
    back = np.swapaxes(first[0], -1, -2)
    return back @ second[0], np.einsum("kij,kj->ki", back, second[1] - first[1])


def _bounds(first: _Hulls, second: _Hulls) -> FloatArray:
    """Lower bounds (k, p, q) of the distances of two links' parts; not positive where their hulls meet."""
    a, b = first.ends[:, :, None], second.ends[:, None]
    axes = segment_distances(a[..., 0, :], a[..., 1, :], b[..., 0, :], b[..., 1, :])
    gaps = axes - first.radii[:, None] - second.radii
    way = second.middles[:, None] - first.middles[:, :, None]
    for box in (first.sides[:, :, None], second.sides[:, None]):
        size = np.linalg.norm(box, axis=-1, keepdims=True)
        for k in range(3):
            axis = box[..., k, :] / np.maximum(size[..., k, :], 1e-300)
            reach = sum(
                np.sum(np.abs(np.sum(sides * axis[..., None, :], axis=-1)), axis=-1)
                for sides in (first.sides[:, :, None], second.sides[:, None])
            )
            gaps = np.maximum(gaps, np.abs(np.sum(way * axis, axis=-1)) - reach)
    return np.asarray(gaps)


@dataclass(frozen=True, eq=False)
class _Hulls:
    """The parts of a link, a box and a capsule about each, in the base frame.

    Attributes:
        names: of the parts.
        points: per part its corners (c, 3) in the link's frame.
        placed: the link's frame (k, 3, 3), (k, 3).
        middles: (k, p, 3) middles of the boxes.
        sides: (k, p, 3, 3) their half sides as rows.
        ends: (k, p, 2, 3) ends of the capsules' axes.
        radii: (p,) of the capsules.
    """

    names: tuple[str, ...]
    points: tuple[FloatArray, ...]
    placed: Frame
    middles: FloatArray
    sides: FloatArray
    ends: FloatArray
    radii: FloatArray


def _hulls(body: LinkBody, placed: Frame) -> _Hulls:
    all_parts = (*body.fused, *body.pins)
    points = tuple(np.unique(corners(part.shape), axis=0) for part in all_parts)
    rows = [_hull(cloud) for cloud in points]
    middles, sides, ends, radii = (np.array(column) for column in zip(*rows, strict=True))
    rotation, origin = placed
    ends = np.einsum("kij,pej->kpei", rotation, ends) + origin[:, None, None]
    middles = np.einsum("kij,pj->kpi", rotation, middles) + origin[:, None]
    sides = np.einsum("kij,psj->kpsi", rotation, sides)
    return _Hulls(tuple(part.name for part in all_parts), points, placed, middles, sides, ends, radii)


def _hull(points: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Middle and half sides of a box, ends and radius of a capsule, along the main axes of points (n, 3)."""
    mean = points.mean(axis=0)
    axes = np.linalg.svd(points - mean, full_matrices=False)[2]
    local = (points - mean) @ axes.T
    low, high = local.min(axis=0), local.max(axis=0)
    middle = mean + (low + high) / 2 @ axes
    sides = (high - low)[:, None] / 2 * axes
    off = np.linalg.norm((points - middle) @ axes[1:].T, axis=1)
    radius = float(off.max())
    slack = np.sqrt(np.maximum(radius**2 - off**2, 0.0))  # what a round end covers beyond the end of the axis
    along = (points - middle) @ axes[0]
    ends = np.array([min(float((along + slack).min()), 0.0), max(float((along - slack).max()), 0.0)])
    return middle, sides, middle + ends[:, None] * axes[0], radius
