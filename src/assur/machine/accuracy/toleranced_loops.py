"""Equations of loops and coordinates of the pose with their derivatives, over boxes of joints and of what is off."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Placed
from assur.joint_graph.tree import joint_graph
from assur.kinematics.certified.enclosed import enclosed, loop_rows
from assur.kinematics.certified.given import number
from assur.kinematics.certified.platform import pose_parts
from assur.machine.accuracy.toleranced_geometry import toleranced_geometry
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS
from assur.numerics.dual import Dual
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import broadcast, stack

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LoopSlopes:
    """Values (r,) and bounds (r, q + t) of the derivatives of equations, and those of coordinates of the pose.

    `whole` is whether the frames at all cuts certainly differ by less than a quarter turn.
    """

    values: Interval
    rows: Interval
    pose: dict[str, Interval]
    whole: bool


@dataclass(frozen=True, eq=False)
class TolerancedLoops:
    """The chosen equations of a joint graph near joint values (n,), over unknown joints and what is off.

    What is `fixed` is off by a number.
    """

    record: MechanismRecord
    values: FloatArray
    names: tuple[str, ...]
    equations: Sequence[int]
    unknown: Sequence[int]
    fixed: Mapping[str, float] = field(default_factory=dict)

    def slopes(self, joints: Interval, off: Interval) -> LoopSlopes:
        """Values and derivatives over boxes of the unknown joints (q,) and of what is off (t,)."""
        count = len(self.unknown) + len(self.names)
        unit = np.eye(count)
        boxes = [*(joints[[k]] for k in range(len(self.unknown))), *(off[[k]] for k in range(len(self.names)))]
        duals = [Dual(part, Interval.of(unit[:, [k]])) for k, part in enumerate(boxes)]
        shifts: dict[str, Any] = dict(zip(self.names, duals[len(self.unknown) :], strict=True))
        shifts |= {name: Interval.of(np.array([value])) for name, value in self.fixed.items()}
        numbers: list[Any] = [Interval.of(np.array([value])) for value in centred(self.record, self.values)]
        for place, dual in zip(self.unknown, duals, strict=False):
            numbers[place] = dual
        for item in self.record.drives:
            if item.name in shifts:
                numbers[item.coordinate.index] = shifts[item.name] * item.sign + self.values[item.coordinate.index]
        near = enclosed(self.record, self.values[None], numbers)
        configuration = type(near)(near.graph, toleranced_geometry(self.record, shifts), near.state)
        rows, positive = loop_rows(configuration)
        chosen = [rows[k] for k in self.equations]
        pose = {name: _slope(value, count) for name, value in _coordinates(self.record, configuration.platform).items()}
        exact = pose_parts(self.record.platform.pose, _plain(configuration.platform))
        pose |= {f"value {name}": number(part) for name, part in zip(self.record.platform.pose, exact, strict=True)}
        return LoopSlopes(
            values=stack([broadcast(_value(row), (1,)) for row in chosen], axis=0)[:, 0],
            rows=stack([_slope(row, count) for row in chosen], axis=0),
            pose=pose,
            whole=all(bool(np.all(_value(number_).positive)) for number_ in positive),
        )


def centred(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Joint values (n,), those of balls counted from where they stand."""
    centre = values.copy()
    for turn in joint_graph(record).turns:
        centre[turn] = 0.0
    return centre


def _coordinates(record: MechanismRecord, platform: Placed) -> dict[str, Any]:
    """Lengths of the pose as they are, of angles numbers with their derivatives alone."""
    rotation, point = platform
    pairs = {"phi": (rotation[0][0], rotation[1][0]), "psi": (rotation[2][2], rotation[2][1])}
    own: dict[str, Any] = {}
    for name in record.platform.pose:
        if name in LENGTHS:
            own[name] = point[LENGTHS.index(name)]
        elif name in pairs:
            own[name] = _turned(*pairs[name])
        elif name == "theta":
            sine = -_dual(rotation[2][0])
            cosine = (1.0 - as_interval(sine.value).square()).sqrt()
            own[name] = Dual(as_interval(0.0), sine.derivative / cosine)
    return own


def _turned(cosine: Any, sine: Any) -> Dual:
    """The derivative of the angle of a pair of any length."""
    c, s = _dual(cosine), _dual(sine)
    square = as_interval(c.value).square() + as_interval(s.value).square()
    return Dual(as_interval(0.0), (c.value * s.derivative - s.value * c.derivative) / square)


def _dual(value: Any) -> Dual:
    return value if isinstance(value, Dual) else Dual(as_interval(value), as_interval(0.0))


def _plain(platform: Placed) -> Placed:
    """The platform's frame without derivatives, whole numbers as they are."""

    def plain(value: Any) -> Any:
        return as_interval(value.value) if isinstance(value, Dual) else value

    (a, b, c), point = platform
    rows = tuple((plain(row[0]), plain(row[1]), plain(row[2])) for row in (a, b, c))
    return (rows[0], rows[1], rows[2]), (plain(point[0]), plain(point[1]), plain(point[2]))


def _value(number_: Any) -> Interval:
    return as_interval(number_.value if isinstance(number_, Dual) else number_)


def _slope(number_: Any, count: int) -> Interval:
    """Derivatives (count,)."""
    slope = as_interval(number_.derivative if isinstance(number_, Dual) else 0.0)
    return broadcast(slope, (count, 1))[:, 0]
