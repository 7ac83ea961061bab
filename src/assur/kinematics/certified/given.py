"""What is given, as exact numbers in intervals: parameters, inputs, poses; and angles of pairs (cosine, sine).

A float counts as the exact number that it is. Only an angle that is given, of a mechanism with angles in degrees,
counts as every number within 2^-51 of it, as a share: a proof then holds of the degrees that it came from, too.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.turns import periodic_inputs
from assur.model.kernel_dimensions import angle_components, kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion, is_angle
from assur.numerics.dual import Dual
from assur.numerics.intervals.functions import ERROR, TURN, cosine_sine, from_degrees
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.krawczyk import parts
from assur.numerics.number_types import Intervals

FloatArray = NDArray[np.float64]


def parameters(record: MechanismRecord) -> SimpleNamespace:
    """The record's parameters as exact intervals, each its own object, so that products of them are enclosed."""
    return kernel_dimensions(record, dimension_intervals(record).__getitem__)


def dimension_intervals(record: MechanismRecord) -> dict[str, Interval]:
    """Bounds of the numbers that kernels take, by name: a length is exact, an angle as one that is given."""
    intervals: dict[str, Interval] = {}
    for name, value in vars(record.values).items():
        if record.parameters[name].angular:
            angle = from_degrees(value) if record.parameters[name].unit == "deg" else Interval.of(value)
            intervals |= zip(angle_components(name), cosine_sine(angle), strict=True)
        else:
            intervals[name] = Interval.of(value)
    return intervals


def inputs_meant(record: MechanismRecord, inputs: FloatArray) -> Interval:
    """Bounds (n,) of the printed inputs that floats (n,) in lengths and rad stand for.

    >>> from assur.model.registry import load_record
    >>> found = inputs_meant(load_record("fivebar"), np.radians([127.0, 53.0]))
    >>> bool(np.all((0 < found.width) & (found.width < 4e-15)))
    True
    """
    return _meant(record, inputs, [item.coordinate.kind == "angle" for item in record.inputs])


def pose_meant(record: MechanismRecord, pose: FloatArray) -> Interval:
    """Bounds (m,) of the pose that floats (m,) in lengths and rad stand for; a quaternion's are exact."""
    return _meant(record, pose, [is_angle(name) for name in record.platform.pose])


def _meant(record: MechanismRecord, values: FloatArray, angular: list[bool]) -> Interval:
    converted = np.array(angular, dtype=bool) & (record.angle == "deg")
    exact, wide = Interval.of(values), from_degrees(values)
    return Interval.of(np.where(converted, wide.low, exact.low), np.where(converted, wide.high, exact.high))


def joint_inputs(record: MechanismRecord, inputs: FloatArray) -> tuple[Any, ...]:
    """A kernel's inputs at printed ones (n,): an interval, or a pair of them (cosine, sine)."""
    found: list[Any] = []
    meant = zip(record.inputs, periodic_inputs(record), parts(inputs_meant(record, inputs)), strict=True)
    for item, same, value in meant:
        joint = item.joint_value(value)
        found.append(cosine_sine(joint) if same else joint)
    return tuple(found)


def pose_numbers(record: MechanismRecord, numbers: tuple[Any, ...]) -> tuple[Any, ...]:
    """A kernel's pose at intervals, or duals of them: an angle becomes a pair (cosine, sine).

    Of a quaternion, whose floats cannot have length 1 exactly, the direction counts.
    """
    names = record.platform.pose
    if has_quaternion(names):
        own = [value for name, value in zip(names, numbers, strict=True) if name in QUATERNION]
        size = Intervals().sqrt(sum((part.square() for part in own[1:]), own[0].square()))
        numbers = tuple(
            value / size if name in QUATERNION else value for name, value in zip(names, numbers, strict=True)
        )
    return tuple(turn(value) if is_angle(name) else value for name, value in zip(names, numbers, strict=True))


def turn(angle: Interval | Dual) -> tuple[Any, Any]:
    """Cosine and sine of an angle in rad.

    >>> cosine, sine = turn(Dual(Interval.of(0.0), Interval.of(1.0)))
    >>> bool(cosine.derivative.contains(0.0)), bool(sine.derivative.contains(1.0))
    (True, True)
    """
    if not isinstance(angle, Dual):
        return cosine_sine(angle)
    cosine, sine = cosine_sine(as_interval(angle.value))
    return Dual(cosine, -sine * angle.derivative), Dual(sine, cosine * angle.derivative)


def printed(record: MechanismRecord, components: tuple[Any, ...]) -> tuple[Interval, ...]:
    """Printed inputs from a kernel's; angles in rad."""
    values = (number(value) for value in components)
    return tuple(item.printed(value) for value, item in zip(values, record.inputs, strict=True))


def number(value: Any) -> Interval:
    """An interval as it is, a pair (cosine, sine) as bounds of its angle in rad; they may reach beyond a half turn.

    Where the pair may be (0, 0) it has no angle: the bounds are then a whole turn, -pi to pi, and not defined.

    >>> angle = number((Interval.of(-0.6), Interval.of(0.8)))
    >>> bool(angle.contains(np.arctan2(0.8, -0.6))), bool(angle.width < 1e-14)
    (True, True)
    """
    if not isinstance(value, tuple):
        return as_interval(value)
    cosine, sine = (as_interval(part) for part in value)
    c, s = cosine.middle, sine.middle
    middle = np.arctan2(s, c)
    off = abs(cosine - c) + abs(sine - s)
    size = abs(Interval.of(c)) + abs(Interval.of(s))
    # a vector of length d from the end of one of length r turns it by at most asin(d/r) <= (pi/2) d/r;
    # r is at least the sum of its parts over the root of 2, and pi/2 times that root is below 2.3
    share = off / size * 2.3
    bound = np.where(np.isfinite(share.high) & (share.high < 1), share.high, np.inf)
    spread = Interval(-bound, bound, share.defined & np.isfinite(bound))
    near = Interval.of(middle) * Interval.of(1 - ERROR, 1 + ERROR) + spread
    known = np.isfinite(bound)
    half = 0.5 * TURN.high
    return Interval(np.where(known, near.low, -half), np.where(known, near.high, half), near.defined)
