"""A box that holds every pose of the platform at given inputs, from the lengths of links alone.

Along a limb without a free slider the platform's point stays in a ball about the limb's base joint, of the sum of the
lengths on the way. Along a limb whose turning joints are all parallel to its sliders it stays in a cylinder. Balls and
cylinders together bound every coordinate, or there is no box.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import Joint, MechanismRecord
from assur.model.pose import LENGTHS, has_quaternion, is_angle
from assur.topology.joints import HELICAL, PRISMATIC

FloatArray = NDArray[np.float64]
PARALLEL = 1e-12
"""Sine below which two written axes are parallel; the bounds are widened by it."""
SPARE = 1e-9
"""Part of a radius that is added to it, for rounding and for axes that are parallel to so many digits only."""
HALF_TURN = 3.1415926535897936
"""The float above pi."""
BEGINNING = -2.9
"""Where the turn of an angle begins: not at the half turn, where poses that are symmetric lie."""


@dataclass(frozen=True, eq=False)
class Reach:
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
    for k, name in enumerate(record.platform.pose):
        if is_angle(name):
            low[k], high[k] = (
                (-HALF_TURN / 2, HALF_TURN / 2) if name == "theta" else (BEGINNING, BEGINNING + 2 * HALF_TURN)
            )
            continue
        bounds = _along(np.eye(3)[LENGTHS.index(name)], regions)
        if bounds is None:
            return None
        low[k], high[k] = bounds
    return low, high


def reaches(record: MechanismRecord, inputs: FloatArray) -> Iterable[Reach]:
    """Balls and cylinders, each of which holds the platform's point at printed inputs (n,)."""
    driven = [pair for pair in zip(record.inputs, inputs.tolist(), strict=True) if pair[0].coordinate.kind == "length"]
    known = {item.coordinate.joint: (value - item.offset) * item.sign for item, value in driven}
    free = [joint for joint in record.joints.values() if "length" in joint.type.kinds and joint.name not in known]
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
        return joint.type is not HELICAL and ("length" not in joint.type.kinds or joint.name in known)
    return not joint.turned and len(joint.axes) == 1 and _parallel(joint.axes[0], axis)


def _parallel(a: FloatArray, b: FloatArray) -> bool:
    return bool(np.linalg.norm(np.cross(a, b)) <= PARALLEL * np.linalg.norm(a) * np.linalg.norm(b))


def _from(
    record: MechanismRecord, first: Joint, usable: list[Joint], axis: FloatArray | None, known: dict[str, float]
) -> Iterable[Reach]:
    """The region of the platform's point along the shortest way that begins with a joint of the base, if there is one.

    Lengths of links are added up from joint to joint, and how far sliders are driven out.
    """
    centre, link = _point(first, record.base), _other(first, record.base)
    moved = known.get(first.name, 0.0)
    start = 0.0
    if first.type is PRISMATIC and record.base == first.parent:
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
        yield Reach(centre, float(best) + SPARE * (best + float(np.linalg.norm(centre))), axis)


def _length(vector: FloatArray, axis: FloatArray | None) -> float:
    """Length of a vector, or of its part across an axis."""
    if axis is not None:
        vector = vector - axis * (axis @ vector) / (axis @ axis)
    return float(np.linalg.norm(vector))


def _point(joint: Joint, link: str) -> FloatArray:
    return joint.at if link == joint.parent else joint.child_at


def _other(joint: Joint, link: str) -> str:
    return joint.child if link == joint.parent else joint.parent


def _along(direction: FloatArray, regions: tuple[Reach, ...]) -> tuple[float, float] | None:
    """Bounds of the platform's point along a direction (3,), or None.

    A direction is a sum of such along which one ball, or two cylinders, bound the point. That the sum is right to 15
    digits only moves the bound by less than what every radius has to spare.
    """
    low, high = -np.inf, np.inf
    for count, one in enumerate(regions):
        for other in regions[count:]:
            rows = np.concatenate([_across(one), _across(other)])
            centres = np.concatenate([_across(item) @ item.centre for item in (one, other)])
            radii = np.repeat([one.radius, other.radius], [len(_across(one)), len(_across(other))])
            weights = np.linalg.lstsq(rows.T, direction, rcond=1e-6)[0]
            if np.linalg.norm(rows.T @ weights - direction) > PARALLEL:
                continue
            middle, spread = float(weights @ centres), _size(weights, radii, len(_across(one)))
            spread += SPARE * (spread + abs(middle) + float(np.abs(weights) @ np.abs(centres)))
            low, high = max(low, middle - spread), min(high, middle + spread)
    return (low, high) if np.isfinite(low) and np.isfinite(high) else None


def _size(weights: FloatArray, radii: FloatArray, first: int) -> float:
    """How far a weighted sum of coordinates reaches, those of each region being in a ball of its radius."""
    return sum(
        float(np.linalg.norm(part) * size[0])
        for part, size in ((weights[:first], radii[:first]), (weights[first:], radii[first:]))
    )


def _across(region: Reach) -> FloatArray:
    """Orthonormal directions (k, 3) along which a region bounds the point."""
    if region.axis is None:
        return np.eye(3)
    return np.linalg.svd(region.axis[None])[2][1:]
