"""Checking a path without intervals: the closed form at many of its poses, and following it over the joint graph."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.following.following import follow
from assur.kinematics.position import inverse
from assur.model.mechanism import MechanismRecord
from assur.results.answers.region import PathCheck
from assur.workspace.aspects.aspects import Aspects
from assur.workspace.aspects.path import AspectPath

FloatArray = NDArray[np.float64]


def check_path(
    record: MechanismRecord, aspects: Aspects, path: AspectPath, samples: int = 16, follow_it: bool = True
) -> PathCheck:
    """Check a path at so many poses of each piece, and by following it with all joints.

    Errors:
        UsageError: there is no path.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.aspects.aspects import aspects
    >>> record = load_record("fivebar")
    >>> found = aspects(record, "-+")
    >>> check_path(record, found, found.path([-60.0, 150.0], [60.0, 220.0])).passed
    True
    """
    if path.status != "connected":
        raise UsageError(f"no path to check: {path.why}")
    points = _sampled(path.points, samples)
    answer = inverse(record, aspects.slice.poses(points), aspects.mode)
    exists = np.asarray(np.any(answer.exists, axis=-1))
    place = np.argmax(answer.exists, axis=-1)[:, None]
    reached = bool(exists.all()) and _within(
        record, aspects, np.take_along_axis(answer.inputs, place[..., None], 1)[:, 0]
    )
    values = [np.take_along_axis(answer.factors[name], place, 1) for name in aspects.aspects[0].signs]
    kept = all(bool(np.all(row > 0) or np.all(row < 0)) for row in values)
    followed, stopped = _followed(record, aspects, path) if follow_it and bool(exists[0]) else (None, "")
    return PathCheck(covered(path), len(points), reached, kept, followed, stopped)


def covered(path: AspectPath) -> bool:
    """Whether both ends of every piece lie in its box, which being convex then holds the piece."""
    keep = [path.coordinates.index(name) for name in path.names]
    points = path.points[:, keep].T
    low, high = path.boxes.low, path.boxes.high
    if points.shape[1] != len(path.boxes) + 1:
        return False
    return all(bool(np.all((low <= end) & (end <= high))) for end in (points[:, :-1], points[:, 1:]))


def _sampled(points: FloatArray, count: int) -> FloatArray:
    """Points (n, free) on a polyline, so many on each piece, and its end."""
    share = np.arange(count)[None, :, None] / count
    inner = points[:-1, None] + share * (points[1:, None] - points[:-1, None])
    return np.concatenate([inner.reshape(-1, points.shape[1]), points[-1:]])


def _within(record: MechanismRecord, aspects: Aspects, inputs: FloatArray) -> bool:
    """Whether inputs (N, n) keep to the strokes that were given."""
    for k, item in enumerate(record.inputs):
        stroke = (aspects.strokes or {}).get(item.name)
        if stroke is not None and not np.all((inputs[:, k] >= stroke[0]) & (inputs[:, k] <= stroke[1])):
            return False
    return True


def _followed(record: MechanismRecord, aspects: Aspects, path: AspectPath) -> tuple[bool, str]:
    """Whether every joint can be moved along, and what stops it."""
    poses = aspects.slice.poses(path.points)
    start = next(iter(inverse(record, poses[0], aspects.mode)))
    values = list(start.joints.values())
    way = follow(record, values, poses=poses[1:], turns="given", use_limits=aspects.strokes is None)
    return way.stopped is None, "" if way.stopped is None else str(way.stopped)
