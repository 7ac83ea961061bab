"""Bounds: strokes of inputs, limits of joints and cones as margins, one rule for closed forms and followed modes.

A length, or an angle whose turns count, gives two margins, value - low and high - value; any other angle one,
cos(value - middle) - cos(half the interval), which knows no turns; a cone one, the cosine of the tilt less that of
the largest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, Literal

import numpy as np

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.limits import Limit, stated_limits
from assur.kinematics.turns import periodic
from assur.model.mechanism import MechanismRecord
from assur.numerics.intervals.functions import cosine_sine, from_degrees
from assur.numerics.intervals.interval import Interval

Stroke = tuple[float, float]
Kind = Literal["turn", "value"]
"""An angle that is the same after a whole turn, or a number."""

Values = Mapping[str, Any]
"""By joint or joint.component: a length, an angle as (cosine, sine) or, where its turns count, in rad, a spherical
joint as three rows of a rotation."""

Bound = Callable[[Values], Any]
"""A margin of joint values, of their number type."""

Constant = Callable[[Interval], Any]
"""What stands in a margin for a constant of which an enclosure is known."""


def nearest(constant: Interval) -> float:
    """The float in the middle: of an enclosure a few roundings wide, the constant as floats have it."""
    return float(constant.middle)


def bounds(
    record: MechanismRecord,
    strokes: Mapping[str, Stroke | None] | None = None,
    constant: Constant = nearest,
) -> dict[str, Bound]:
    """Every bound as a margin of joint values: strokes (the user's, else the file's), then limits and cones of joints.

    Args:
        record: the mechanism.
        strokes: input -> (low, high), or None for no stroke; the file's for what is left out.
        constant: what stands for a constant (a sum, a cosine) whose enclosure is given; a float by default.

    >>> from assur.model.registry import load_record
    >>> list(bounds(load_record("zeng2019"), {"yA1": (-300, 300), "yA2": (-math.inf, 5)}))
    ['yA1 >= -300', 'yA1 <= 300', 'yA2 <= 5']
    """
    margins: dict[str, Bound] = {}
    for limit in stated_limits(record, _checked(record, strokes)):
        shown = _shown(record, (limit.low, limit.high), angular=limit.angular)
        if limit.axis is not None:
            margins[f"tilt of {limit.of} <= {shown[1]}"] = partial(_cone, limit, constant)
            continue
        key = record.coordinate_label(record.coordinates[limit.index])
        kind: Kind = "turn" if periodic(record)[limit.index] else "value"
        margins |= _interval(limit, key, kind, shown, constant)
    return margins


def not_reached(margin: str) -> str:
    """Why a pose is not reached at which a margin is negative: what a bound asks does not hold.

    >>> not_reached("M3"), not_reached("-95 deg <= B1 <= -60 deg")
    ('M3 < 0: not reached', 'not -95 deg <= B1 <= -60 deg: not reached')
    """
    return f"not {margin}: not reached" if "<=" in margin or ">=" in margin else f"{margin} < 0: not reached"


def _shown(record: MechanismRecord, ends: Stroke, *, angular: bool) -> tuple[str, str]:
    """Both ends of an interval as the file would have them, with a unit where they are angles."""
    if not angular:
        return f"{ends[0]:g}", f"{ends[1]:g}"
    return quantity_text(record, ends[0], "angle"), quantity_text(record, ends[1], "angle")


def _checked(record: MechanismRecord, strokes: Mapping[str, Stroke | None] | None) -> dict[str, Stroke | None]:
    """The user's strokes as pairs of floats, or a clear refusal."""
    names = [item.name for item in record.inputs]
    for name in strokes or {}:
        if name not in names:
            raise UnknownNameError(f"input of {record.name}", name, names)
    return {name: None if stroke is None else _pair(name, stroke) for name, stroke in (strokes or {}).items()}


def _pair(name: str, stroke: Any) -> Stroke:
    try:
        low, high = (float(value) for value in stroke)
    except (TypeError, ValueError) as error:
        raise UsageError(f"stroke of {name}: {stroke!r} is not (low, high)") from error
    if not low < high:  # a NaN ends here too
        raise UsageError(f"stroke of {name}: [{low:g}, {high:g}] is turned round or empty", hint="give low < high")
    return low, high


def _interval(limit: Limit, key: str, kind: Kind, shown: tuple[str, str], constant: Constant) -> dict[str, Bound]:
    """Margins of low <= sign * value + offset <= high."""
    low, high, name = limit.low, limit.high, limit.of
    if kind == "turn":
        if high - low >= 2 * math.pi:
            return {}
        first, last = from_degrees(low), from_degrees(high)
        middle, half = ((first + last) / 2 - limit.offset) * limit.sign, (last - first) / 2
        circle = (*cosine_sine(middle), cosine_sine(half)[0])
        return {f"{shown[0]} <= {name} <= {shown[1]}": partial(_angle, key, *map(constant, circle))}
    margins: dict[str, Bound] = {}
    if math.isfinite(low):
        margins[f"{name} >= {shown[0]}"] = partial(_value, key, limit.sign, constant(Interval.of(limit.offset) - low))
    if math.isfinite(high):
        margins[f"{name} <= {shown[1]}"] = partial(_value, key, -limit.sign, constant(Interval.of(high) - limit.offset))
    return margins


def _value(key: str, slope: float, start: Any, values: Values) -> Any:
    return slope * values[key] + start


def _angle(key: str, cosine_at: Any, sine_at: Any, least: Any, values: Values) -> Any:
    cosine, sine = values[key]
    return cosine * cosine_at + sine * sine_at - least


def _cone(limit: Limit, constant: Constant, values: Values) -> Any:
    axis: Sequence[float] = np.asarray(limit.axis).tolist()
    tilted = [sum(entry * part for entry, part in zip(row, axis, strict=True)) for row in values[limit.of]]
    cosine = sum(entry * part for entry, part in zip(tilted, axis, strict=True))
    size = sum(entry * entry for entry in map(Interval.of, axis))  # of an axis that is a unit vector to 16 digits
    return cosine - constant(cosine_sine(from_degrees(limit.high))[0] * size)
