"""What is given, as exact numbers in intervals: parameters, inputs, poses; and angles of pairs (cosine, sine).

A float counts as the exact number that it is. An angle of an input or a pose is exact in rad, whatever the file's unit.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion, is_angle
from assur.numerics.dual import Dual
from assur.numerics.intervals.functions import ERROR, cosine_sine
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.number_types import Intervals

FloatArray = NDArray[np.float64]


def parameters(record: MechanismRecord) -> SimpleNamespace:
    """The record's parameters as exact intervals, each its own object, so that products of them are enclosed."""
    return SimpleNamespace(**{name: Interval.of(value) for name, value in vars(record.values).items()})


def joint_inputs(record: MechanismRecord, inputs: FloatArray) -> tuple[Any, ...]:
    """A kernel's inputs at printed ones (n,): an interval, or a pair of them (cosine, sine)."""
    found: list[Any] = []
    for item, value in zip(record.inputs, inputs.tolist(), strict=True):
        joint = (Interval.of(value) - item.offset) * item.sign
        found.append(cosine_sine(joint) if item.coordinate.kind == "angle" else joint)
    return tuple(found)


def pose_numbers(record: MechanismRecord, numbers: tuple[Any, ...]) -> tuple[Any, ...]:
    """A kernel's pose at intervals, or duals of them: an angle becomes a pair (cosine, sine).

    Of a quaternion, whose floats cannot have length 1 exactly, the direction counts.
    """
    names = record.platform.pose
    if has_quaternion(names):
        parts = [value for name, value in zip(names, numbers, strict=True) if name in QUATERNION]
        size = Intervals().sqrt(sum((part.square() for part in parts[1:]), parts[0].square()))
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
    return tuple(value * item.sign + item.offset for value, item in zip(values, record.inputs, strict=True))


def number(value: Any) -> Interval:
    """An interval as it is, a pair (cosine, sine) as bounds of its angle in rad; they may reach beyond a half turn.

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
    return Interval.of(middle) * Interval.of(1 - ERROR, 1 + ERROR) + spread
