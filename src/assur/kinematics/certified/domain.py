"""A box that holds every pose of the platform at given inputs, from the lengths of links alone.

Along a limb without a free slider the platform's point stays in a ball about the limb's base joint, of the sum of the
lengths on the way. Along a limb whose turning joints are all parallel to its sliders it stays in a cylinder. Balls and
cylinders together bound every coordinate, or there is no box.

Nothing limits how far a free slider goes, so that axes which are parallel to so many digits bound nothing: parallel is
decided exactly, of the floats that the axes are. Rounding of lengths is covered by what every radius has to spare.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import Joint, MechanismRecord
from assur.model.pose import LENGTHS, has_quaternion, is_angle

FloatArray = NDArray[np.float64]
SPARE = 1e-9
"""Part of a radius that is added to it for rounding."""
SKEW = 1e-15
"""By how much a row that is computed may lean along the axis that it should be across."""
DEPENDENT = 1e-3
"""Directions of two regions of which a singular value is below this do not bound the space together."""
HALF_TURN = 3.1415926535897936
"""The float above pi."""
BEGINNING = -2.9
"""Where the turn of an angle begins: not at the half turn, where poses that are symmetric lie."""


@dataclass(frozen=True, eq=False)
class ReachBound:
    """|(p - centre) without its part along `axis`| <= radius for the platform's point p; a ball where axis is None."""

    centre: FloatArray
    radius: float
    axis: FloatArray | None = None


def pose_box(record: MechanismRecord, inputs: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Bounds low (m,) and high (m,) of every pose at printed inputs (n,), or None where links do not bound it.

    An angle has a whole turn, theta a half one. A pose that is a quaternion has no box here.

    Example: links 9 and 12 let the platform of Zeng et al. 2019 no farther from a slider than this.

    >>> from assur.model.registry import load_record
    >>> low, high = pose_box(load_record("zeng2019"), np.array([162.6907, -143.3209, -24.6776]))
    >>> bool(np.all(low < [-15.4714, 9.6849, 456.3315])), bool(np.all(high - low < 2000))
    (True, True)
    """
    if has_quaternion(record.platform.pose):
        return None
    regions = tuple(reaches(record, inputs))
    low, high = np.empty(len(record.platform.pose)), np.empty(len(record.platform.pose))
    both = [known for one, other in combinations(regions, 2) if (known := _by_both(one, other))]
    for k, name in enumerate(record.platform.pose):
        if is_angle(name):
            low[k], high[k] = (
                (-HALF_TURN / 2, HALF_TURN / 2) if name == "theta" else (BEGINNING, BEGINNING + 2 * HALF_TURN)
            )
            continue
        bounds = _along(LENGTHS.index(name), regions, both)
        if bounds is None:
            return None
        low[k], high[k] = bounds
    return low, high


def reaches(record: MechanismRecord, inputs: FloatArray) -> Iterable[ReachBound]:
    """Balls and cylinders, each of which holds the platform's point at printed inputs (n,)."""
    driven = [pair for pair in zip(record.inputs, inputs.tolist(), strict=True) if pair[0].coordinate.kind == "length"]
    known = {item.coordinate.joint: item.joint_value(value) for item, value in driven}
    free = [joint for joint in record.joints.values() if joint.type.slides > (joint.name in known)]
    axes: list[FloatArray | None] = [None]
    for joint in free:
        if not any(axis is not None and _parallel(axis, joint.axes[0]) for axis in axes):
            axes.append(joint.axes[0])
    for axis in axes:
        usable = [joint for joint in record.joints.values() if _usable(joint, axis, known)]
        for first in usable:
            if record.base in (first.parent, first.child):
                yield from _from(record, first, usable, axis, known)


def _usable(joint: Joint, axis: FloatArray | None, known: dict[str, float]) -> bool:
    """Whether a joint leaves the distance bounded: of everything, or of what is across an axis."""
    if axis is None:
        return not joint.type.screw and joint.type.slides == (joint.name in known)
    return not joint.turned and len(joint.axes) == 1 and _parallel(joint.axes[0], axis)


def _parallel(a: FloatArray, b: FloatArray) -> bool:
    """Whether two axes (3,) are parallel, exactly.

    >>> _parallel(np.array([0.6, 0.8, 0.0]), np.array([-1.2, -1.6, 0.0]))
    True
    >>> _parallel(np.array([0.6, 0.8, 0.0]), np.array([0.6, np.nextafter(0.8, 1.0), 0.0]))
    False
    """
    first, second = ([Fraction(value) for value in axis.tolist()] for axis in (a, b))
    return all(first[i] * second[j] == first[j] * second[i] for i, j in combinations(range(3), 2))


def _from(
    record: MechanismRecord, first: Joint, usable: list[Joint], axis: FloatArray | None, known: dict[str, float]
) -> Iterable[ReachBound]:
    """The region of the platform's point along the shortest way that begins with a joint of the base, if there is one.

    Lengths of links are added up from joint to joint, and how far sliders are driven out.
    """
    centre, link = _point(first, record.base), _other(first, record.base)
    moved = known.get(first.name, 0.0)
    start = 0.0
    if not first.type.turning and record.base == first.parent:
        centre = centre + moved * first.axes[0]
    else:
        start = abs(moved)
    open_ = [(start, 0, link, _point(first, link))]
    done: set[tuple[str, bytes]] = set()
    tickets = 1
    best = np.inf
    while open_:
        so_far, _, link, here = heapq.heappop(open_)
        if (link, here.tobytes()) in done:
            continue
        done.add((link, here.tobytes()))
        if link == record.platform.link:
            best = min(best, so_far + _length(record.platform.point - here, axis))
        for joint in usable:
            if link in (joint.parent, joint.child):
                far = _other(joint, link)
                out = 0.0 if axis is not None else abs(known.get(joint.name, 0.0))
                total = so_far + _length(_point(joint, link) - here, axis) + out
                heapq.heappush(open_, (total, tickets, far, _point(joint, far)))
                tickets += 1
    if np.isfinite(best):
        yield ReachBound(centre, float(best) + SPARE * (best + float(np.linalg.norm(centre))), axis)


def _length(vector: FloatArray, axis: FloatArray | None) -> float:
    """Length of a vector, or of its part across an axis."""
    if axis is not None:
        vector = vector - axis * (axis @ vector) / (axis @ axis)
    return math.hypot(*vector.tolist())


def _point(joint: Joint, link: str) -> FloatArray:
    return joint.at if link == joint.parent else joint.child_at


def _other(joint: Joint, link: str) -> str:
    return joint.child if link == joint.parent else joint.parent


def _along(
    coordinate: int, regions: tuple[ReachBound, ...], both: list[tuple[FloatArray, FloatArray]]
) -> tuple[float, float] | None:
    """Bounds of a coordinate of the platform's point, or None.

    A ball bounds it, a cylinder whose axis has exactly no part along it, and two cylinders that are not parallel.
    """
    found = [
        (float(item.centre[coordinate]), item.radius)
        for item in regions
        if item.axis is None or item.axis[coordinate] == 0.0
    ]
    found += [(float(middle[coordinate]), float(spread[coordinate])) for middle, spread in both]
    if not found:
        return None
    spare = [spread + SPARE * (spread + abs(middle)) for middle, spread in found]
    low = max(middle - spread for (middle, _), spread in zip(found, spare, strict=True))
    high = min(middle + spread for (middle, _), spread in zip(found, spare, strict=True))
    return low, high


def _by_both(one: ReachBound, other: ReachBound) -> tuple[FloatArray, FloatArray] | None:
    """Middle (3,) and spread (3,) of a point in two regions, or None where they do not bound the space together.

    A coordinate is a weighted sum of places along the rows, along which each region is bounded, and of a rest that
    rounding leaves. The rows span the space, so that the point is not farther than their places allow, and the rest
    times that distance is added.
    """
    parts = (_across(one), _across(other))
    rows, first = np.concatenate(parts), len(parts[0])
    smallest = float(np.linalg.svd(rows, compute_uv=False)[2])
    if smallest < DEPENDENT:
        return None
    weights = np.linalg.lstsq(rows.T, np.eye(3), rcond=None)[0]  # (rows, coordinates)
    places = np.concatenate([parts[0] @ one.centre, parts[1] @ other.centre])
    farthest = (float(np.linalg.norm(places)) + one.radius + other.radius) / smallest
    rest = np.linalg.norm(rows.T @ weights - np.eye(3), axis=0) + SKEW * np.sum(np.abs(weights), axis=0)
    sizes = [np.linalg.norm(part, axis=0) for part in (weights[:first], weights[first:])]
    spread = sizes[0] * one.radius + sizes[1] * other.radius
    return places @ weights, spread + rest * farthest + SPARE * (np.abs(places) @ np.abs(weights))


def _across(region: ReachBound) -> FloatArray:
    """Orthonormal directions (k, 3) along which a region bounds the point."""
    if region.axis is None:
        return np.eye(3)
    return np.linalg.svd(region.axis[None])[2][1:]
