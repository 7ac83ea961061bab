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
from assur.kinematics.turns import periodic
from assur.model.mechanism import Coordinate, Input, Joint, MechanismRecord
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
    found: dict[str, Bound] = {}
    same = periodic(record)
    for item, stroke in _strokes(record, strokes):
        if stroke is not None:
            key = record.coordinate_label(item.coordinate)
            kind: Kind = "turn" if same[item.coordinate.index] else "value"
            shown = _shown(record, stroke, angular=item.coordinate.kind == "angle")
            found |= _interval(item.name, key, kind, stroke, shown, constant, item.sign, item.offset)
    for coordinate in record.coordinates:
        limit = _limit(record, coordinate)
        if limit is not None:
            key = record.coordinate_label(coordinate)
            shown = _shown(record, limit, angular=coordinate.kind == "angle")
            found |= _interval(key, key, "turn" if same[coordinate.index] else "value", limit, shown, constant)
    for joint in record.joints.values():
        if joint.cone is not None and joint.cone_axis is not None:
            _, cone = _shown(record, (0.0, joint.cone), angular=True)
            found[f"tilt of {joint.name} <= {cone}"] = partial(_cone, joint, constant)
    return found


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
    factor = math.degrees(1.0) if record.angle == "deg" else 1.0
    return f"{ends[0] * factor:g} {record.angle}", f"{ends[1] * factor:g} {record.angle}"


def _limit(record: MechanismRecord, coordinate: Coordinate) -> Stroke | None:
    joint = record.joints[coordinate.joint]
    place = coordinate.index - record.joint_coordinates(joint.name)[0].index
    return joint.limits[place] if joint.limits else None


def _strokes(record: MechanismRecord, strokes: Mapping[str, Stroke | None] | None) -> list[tuple[Input, Stroke | None]]:
    """Each input with its stroke: the user's, else the file's, else none."""
    given = dict(strokes or {})
    names = [item.name for item in record.inputs]
    for name, stroke in given.items():
        if name not in names:
            raise UnknownNameError(f"input of {record.name}", name, names)
        if stroke is not None:
            given[name] = _checked(name, stroke)
    return [(item, given.get(item.name, item.stroke)) for item in record.inputs]


def _checked(name: str, stroke: Any) -> Stroke:
    try:
        low, high = (float(value) for value in stroke)
    except (TypeError, ValueError) as error:
        raise UsageError(f"stroke of {name}: {stroke!r} is not (low, high)") from error
    if not low < high:  # a NaN ends here too
        raise UsageError(f"stroke of {name}: [{low:g}, {high:g}] is turned round or empty", hint="give low < high")
    return low, high


def _interval(
    name: str,
    key: str,
    kind: Kind,
    interval: Stroke,
    shown: tuple[str, str],
    constant: Constant,
    sign: float = 1.0,
    offset: float = 0.0,
) -> dict[str, Bound]:
    """Margins of low <= sign * value + offset <= high."""
    low, high = interval
    if kind == "turn":
        if high - low >= 2 * math.pi:
            return {}
        first, last = from_degrees(low), from_degrees(high)
        middle, half = ((first + last) / 2 - offset) * sign, (last - first) / 2
        circle = (*cosine_sine(middle), cosine_sine(half)[0])
        return {f"{shown[0]} <= {name} <= {shown[1]}": partial(_angle, key, *map(constant, circle))}
    found: dict[str, Bound] = {}
    if math.isfinite(low):
        found[f"{name} >= {shown[0]}"] = partial(_value, key, sign, constant(Interval.of(offset) - low))
    if math.isfinite(high):
        found[f"{name} <= {shown[1]}"] = partial(_value, key, -sign, constant(Interval.of(high) - offset))
    return found


def _value(key: str, slope: float, start: Any, values: Values) -> Any:
    return slope * values[key] + start


def _angle(key: str, cosine_at: Any, sine_at: Any, least: Any, values: Values) -> Any:
    cosine, sine = values[key]
    return cosine * cosine_at + sine * sine_at - least


def _cone(joint: Joint, constant: Constant, values: Values) -> Any:
    axis: Sequence[float] = np.asarray(joint.cone_axis).tolist()
    tilted = [sum(entry * part for entry, part in zip(row, axis, strict=True)) for row in values[joint.name]]
    cosine = sum(entry * part for entry, part in zip(tilted, axis, strict=True))
    size = sum(entry * entry for entry in map(Interval.of, axis))  # of an axis that is a unit vector to 16 digits
    return cosine - constant(cosine_sine(from_degrees(joint.cone or 0.0))[0] * size)
