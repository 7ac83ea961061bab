"""The platform on the joint graph over any number type: its pose, and the equations that a given pose makes."""

from __future__ import annotations

from typing import Any

import numpy as np

from assur.joint_graph.configuration import Placed
from assur.kinematics.certified.given import turn
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, Pose, has_quaternion, is_angle
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.krawczyk import parts
from assur.numerics.number_types import Intervals
from assur.numerics.vectors import minus, plus, product, times, transposed


def pose_parts(names: Pose, platform: Placed) -> list[Any]:
    """A pose's coordinates over bounds of the platform's frame, an angle as (cosine, sine) up to a positive factor.

    Theta is between -90 and 90 deg, qw not negative. Where qw may be 0 the other parts may have either sign, since q
    and -q are one orientation.

    >>> level = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    >>> x, y, _ = pose_parts(("x", "y", "phi"), (level, (Interval.of(1.0), 2, 0)))
    >>> float(x.middle), y
    (1.0, 2)
    """
    rotation, point = platform
    level = plus(times(rotation[0][0], rotation[0][0]), times(rotation[1][0], rotation[1][0]))
    scalar = Intervals().sqrt(plus(plus(plus(1, rotation[0][0]), rotation[1][1]), rotation[2][2])) / 2
    coordinates: dict[str, Any] = {
        **dict(zip(LENGTHS, point, strict=True)),
        "phi": (as_interval(rotation[0][0]), as_interval(rotation[1][0])),
        "theta": (Intervals().sqrt(level), as_interval(minus(0, rotation[2][0]))),
        "psi": (as_interval(rotation[2][2]), as_interval(rotation[2][1])),
        "qw": scalar,
    }
    for k, (i, j) in enumerate(((2, 1), (0, 2), (1, 0))):
        quotient = as_interval(minus(rotation[i][j], rotation[j][i])) / (scalar * 4)
        coordinates[QUATERNION[k + 1]] = _at_most(quotient, _size(rotation, k))
    return [coordinates[name] for name in names]


def _size(rotation: Any, axis: int) -> Interval:
    """Absolute value of the part of a quaternion about an axis, without its sign: 4 qx^2 = 1 + r11 - r22 - r33."""
    own, *others = (as_interval(rotation[k][k]) for k in (axis, (axis + 1) % 3, (axis + 2) % 3))
    return (1 + own - others[0] - others[1]).sqrt() / 2


def _at_most(number: Interval, size: Interval) -> Interval:
    """Bounds of a number that is no larger than a size, where dividing by what may be zero has left it without any."""
    known = np.isfinite(number.low) & np.isfinite(number.high)
    return Interval(np.where(known, number.low, -size.high), np.where(known, number.high, size.high), number.defined)


def pose_rows(names: Pose, platform: Placed, pose: Interval) -> tuple[list[Any], list[Any]]:
    """What is zero, and what is positive, where the platform is at a pose (m,) within bounds."""
    rotation, point = platform
    asked = dict(zip(names, parts(pose), strict=True))
    rows: list[Any] = [minus(point[LENGTHS.index(name)], asked[name]) for name in LENGTHS if name in asked]
    positive: list[Any] = []
    if has_quaternion(names) or all(name in asked for name in ANGLES):
        # the whole orientation by one rotation: three angles lose a direction where theta is a right angle
        own, more = _turned_to(rotation, _wanted_rotation(asked))
        return rows + own, positive + more
    pairs = {"phi": (rotation[0][0], rotation[1][0]), "psi": (rotation[2][2], rotation[2][1])}
    for name in (name for name in asked if is_angle(name)):
        cosine, sine = turn(asked[name])
        if name == "theta":
            rows.append(plus(rotation[2][0], sine))
            continue
        rows.append(minus(times(pairs[name][1], cosine), times(pairs[name][0], sine)))
        positive.append(plus(times(pairs[name][0], cosine), times(pairs[name][1], sine)))
    return rows, positive


def _wanted_rotation(pose: dict[str, Interval]) -> Any:
    """Rows of the rotation that a quaternion of any length, or phi, theta and psi mean."""
    if QUATERNION[0] not in pose:
        (cf, sf), (ct, st), (cp, sp) = (turn(pose[name]) for name in ANGLES)
        return (
            (cf * ct, cf * st * sp - sf * cp, cf * st * cp + sf * sp),
            (sf * ct, sf * st * sp + cf * cp, sf * st * cp - cf * sp),
            (-st, ct * sp, ct * cp),
        )
    w, x, y, z = (pose[name] for name in QUATERNION)
    twice = 2 / (w * w + x * x + y * y + z * z)
    return (
        (1 - twice * (y * y + z * z), twice * (x * y - w * z), twice * (x * z + w * y)),
        (twice * (x * y + w * z), 1 - twice * (x * x + z * z), twice * (y * z - w * x)),
        (twice * (x * z - w * y), twice * (y * z + w * x), 1 - twice * (x * x + y * y)),
    )


def _turned_to(rotation: Any, target: Any) -> tuple[list[Any], list[Any]]:
    """Skew part and trace of the turn from a wanted rotation to a rotation."""
    gap = product(transposed(target), rotation)
    skew = [minus(gap[2][1], gap[1][2]), minus(gap[0][2], gap[2][0]), minus(gap[1][0], gap[0][1])]
    return skew, [plus(plus(gap[0][0], gap[1][1]), gap[2][2])]
