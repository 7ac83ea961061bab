"""Dials: what can be turned of a mechanism, its inputs and its platform's coordinates, each with its range and unit.

An orientation that the pose gives by a quaternion is turned by the three angles phi, theta, psi.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations
from assur.page.ranges import input_ranges, pose_ranges

FloatArray = NDArray[np.float64]
TURN = {"phi": math.pi, "theta": math.pi / 2, "psi": math.pi}


@dataclass(frozen=True)
class Dial:
    """One number that can be turned.

    Attributes:
        name: as in the file.
        low, high: its range, in lengths or rad.
        angle: whether it is an angle.
        unit: as it is shown, "mm" or "deg".
        limits: whether the range is the stroke of the file.
    """

    name: str
    low: float
    high: float
    angle: bool
    unit: str
    limits: bool = False

    @property
    def step(self) -> float:
        """What one step of it is, as it is shown: a round number, a thousandth of the range or less."""
        return float(10.0 ** math.floor(math.log10(max((self.high - self.low) * self.scale, 1e-300)) - 3))

    @property
    def ends(self) -> tuple[float, float]:
        """Its range as it is shown, to whole steps: outwards, but the stroke of a file as it is.

        >>> Dial("x", -0.12345, 2.0, False, "m").ends
        (-0.124, 2.0)
        """
        low, high = self.low * self.scale, self.high * self.scale
        if self.limits:
            return round(low, 9), round(high, 9)
        first, last = math.floor(round(low / self.step, 6)), math.ceil(round(high / self.step, 6))
        return round(first * self.step, 9), round(last * self.step, 9)

    @property
    def scale(self) -> float:
        """What a number inside is multiplied by to be shown."""
        return 180.0 / math.pi if self.unit == "deg" else 1.0

    def shown(self, value: float) -> float:
        """A value as it is shown.

        >>> round(Dial("phi", -1.0, 1.0, True, "deg").shown(math.pi), 12)
        180.0
        """
        return value * self.scale

    def inside(self, shown: float) -> float:
        """A value from what is shown."""
        return shown / self.scale


@lru_cache(maxsize=16)
def inputs(record: MechanismRecord) -> tuple[Dial, ...]:
    """A dial for each input.

    >>> from assur.model.registry import load_record
    >>> [(item.name, item.unit, item.limits) for item in inputs(load_record("three_rps"))][0]
    ('rho1', 'mm', True)
    """
    sliders = []
    for actuated, (low, high) in zip(record.inputs, input_ranges(record), strict=True):
        angle = actuated.coordinate.kind == "angle"
        sliders.append(Dial(actuated.name, low, high, angle, _unit(record, angle), actuated.stroke is not None))
    return tuple(sliders)


@lru_cache(maxsize=16)
def dials(record: MechanismRecord) -> tuple[Dial, ...]:
    """A dial for each coordinate of the platform.

    >>> from assur.model.registry import load_record
    >>> [item.name for item in dials(load_record("gough_stewart"))]
    ['x', 'y', 'z', 'phi', 'theta', 'psi']
    """
    pose = record.platform.pose
    ranges = dict(zip(pose, pose_ranges(record), strict=True))
    names = [name for name in pose if name not in QUATERNION]
    sliders = [
        Dial(name, ranges[name][0], ranges[name][1], is_angle(name), _unit(record, is_angle(name))) for name in names
    ]
    if has_quaternion(pose):
        sliders += [Dial(name, -TURN[name], TURN[name], True, _unit(record, True)) for name in ANGLES]
    return tuple(sliders)


def read(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Where the platform's dials stand (d,) at joint values (n,), in lengths and rad."""
    pose = pose_of(record, values)
    named = dict(zip(record.platform.pose, pose.tolist(), strict=True))
    if has_quaternion(record.platform.pose):
        turn = rotations.from_quaternion(np.array([named[name] for name in QUATERNION]))
        named |= {name: float(angle) for name, angle in zip(ANGLES, rotations.to_angles(turn), strict=True)}
    return np.array([named[dial.name] for dial in dials(record)])


def pose_with(record: MechanismRecord, named: Mapping[str, float]) -> FloatArray:
    """The pose (m,) where the dials stand at these values.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("gough_stewart")
    >>> home = home_values(record)
    >>> named = dict(zip([item.name for item in dials(record)], read(record, home), strict=True))
    >>> turned = pose_with(record, named) - pose_of(record, home)
    >>> bool(np.max(np.abs(turned)) < 1e-12)
    True
    """
    known = dict(named)
    if has_quaternion(record.platform.pose):
        turn = rotations.from_angles(*(np.asarray(known[name]) for name in ANGLES))
        known |= dict(zip(QUATERNION, rotations.to_quaternion(turn).tolist(), strict=True))
    return np.array([known[name] for name in record.platform.pose])


def _unit(record: MechanismRecord, angle: bool) -> str:
    return record.angle if angle else record.unit
