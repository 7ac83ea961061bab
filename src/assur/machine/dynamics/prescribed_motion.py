"""A motion of the platform that is prescribed in time: its pose, rates and accelerations at any moment.

Harmonic, pose = centre + amplitude sin(omega t + phase), or a smooth curve through samples: a spline of the fifth
degree, so that accelerations are smooth too, of a lower one through fewer than six samples.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics import border
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, Pose, has_quaternion, is_angle

FloatArray = NDArray[np.float64]
A_PERIOD = 64
"""Moments in the shortest period, so that the largest values are met within 0.2 %."""
MOST = 20_000
"""Moments at most."""
BACK = 1e-3
"""Of a turn: so near to where it began a coordinate is back, as a file has few digits of omega."""
PERIODS = 12
"""So many periods of the slowest coordinate at most until all are where they began; else so many are looked at."""
LEAST = 4
"""Samples without which a curve has no accelerations of its own."""
DEGREE = 5


@dataclass(frozen=True, eq=False)
class PrescribedMotion:
    """A motion that is prescribed.

    Attributes:
        names: of the pose's coordinates.
        times: (N,) in s, at which it is asked for.
        coordinates: the coordinates (N, m) at times (N,), in the mechanism's unit and rad, or their derivative of an
            order; a quaternion's need not be of length 1.
    """

    names: Pose
    times: FloatArray
    coordinates: Callable[[FloatArray, int], FloatArray]

    def at(self, times: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Pose (N, m), rates and accelerations (N, k) at times (N,), in the mechanism's unit, rad and s.

        Of a quaternion these are the angular velocity and acceleration in the base frame.

        >>> import assur
        >>> motion = harmonic(assur.load("fivebar"), [0.0, 224.0], [10.0, 0.0], omega=2.0)
        >>> [values[0].round(9).tolist() for values in motion.at(np.array([0.0]))]
        [[0.0, 224.0], [20.0, 0.0], [0.0, 0.0]]
        """
        pose, first, second = (self.coordinates(times, order) for order in range(3))
        if not has_quaternion(self.names):
            return pose, first, second
        turning = [self.names.index(name) for name in QUATERNION]
        others = [k for k, name in enumerate(self.names) if name not in QUATERNION]
        unit, angular, speeding = _turning(*(part[:, turning] for part in (pose, first, second)))
        pose = pose.copy()
        pose[:, turning] = unit
        rates, changes = (
            np.concatenate([part[:, others], own], axis=1) for part, own in ((first, angular), (second, speeding))
        )
        return pose, rates, changes


def harmonic(
    record: MechanismRecord,
    centre: ArrayLike,
    amplitude: ArrayLike,
    omega: ArrayLike,
    phase: ArrayLike = 0.0,
    *,
    t_end: float | None = None,
    count: int | None = None,
) -> PrescribedMotion:
    """The motion centre + amplitude sin(omega t + phase) of each coordinate of the pose.

    Args:
        record: the mechanism.
        centre: (m,) in the mechanism's unit and rad.
        amplitude: the same.
        omega: (m,), or one number for all, in rad/s.
        phase: the same in rad.
        t_end: in s; until all are where they began, twelve periods of the slowest where that is later.
        count: of moments, evenly spaced; 64 in the shortest period if left out.

    Errors:
        UsageError: wrong shapes, nothing that moves.

    >>> from assur.model.registry import load_record
    >>> way = harmonic(load_record("fivebar"), [0, 224], [10, 0], 2.0)
    >>> float(way.times[-1].round(6)), way.at(np.array([0.0]))[1].tolist()
    (3.141593, [[20.0, 0.0]])
    """
    names = record.platform.pose
    shape = (len(names),)
    middle, size = (
        border.checked(part, names, f"{what} of {record.name}")
        for what, part in (("centre", centre), ("amplitude", amplitude))
    )
    speed, begin = (
        border.checked(np.broadcast_to(part, shape) if np.ndim(part) == 0 else part, names, f"{what} of {record.name}")
        for what, part in (("omega", omega), ("phase", phase))
    )
    moving = np.abs(speed[size != 0.0])
    if not np.any(moving > 0.0):
        raise UsageError(f"{record.name}: nothing moves", hint="give an amplitude and an omega that are not 0")
    end = _whole_period(moving[moving > 0.0]) if t_end is None else float(t_end)
    number = _count(float(moving.max()), end) if count is None else count

    def coordinates(times: FloatArray, order: int) -> FloatArray:
        at_rest = middle if order == 0 else np.zeros(shape)
        return np.asarray(at_rest + size * speed**order * np.sin(speed * times[:, None] + begin + order * np.pi / 2))

    return PrescribedMotion(names, np.linspace(0.0, end, number), coordinates)


def sampled(record: MechanismRecord, times: ArrayLike, poses: ArrayLike) -> PrescribedMotion:
    """A smooth motion through poses (N, m) at times (N,) in s that grow; angles go the short way from one to the next.

    Errors:
        UsageError: fewer than four samples, times that do not grow, wrong shapes.

    >>> from assur.model.registry import load_record
    >>> way = sampled(load_record("fivebar"), [0, 1, 2, 3], [[0, 224], [1, 225], [4, 226], [9, 227]])
    >>> way.at(np.array([1.5]))[2].round(9).tolist()
    [[2.0, 0.0]]
    """
    given = border.checked_poses(record, poses)
    from scipy.interpolate import make_interp_spline  # which takes half a second to load

    moments = np.asarray(times, dtype=float)
    if moments.ndim != 1 or given.ndim != 2 or len(moments) != len(given) or len(given) < LEAST:
        raise UsageError(
            f"{record.name}: {len(np.atleast_1d(moments))} times and {len(np.atleast_2d(given))} poses",
            hint=f"as many of each, {LEAST} at least",
        )
    if not np.all(np.isfinite(moments)) or np.any(np.diff(moments) <= 0.0):
        raise UsageError(f"{record.name}: times do not grow", hint="give them in s, each later than the one before")
    curve = make_interp_spline(moments, _steady(record, given), k=DEGREE if len(given) > DEGREE else 3)
    return PrescribedMotion(record.platform.pose, moments, lambda at, order: np.asarray(curve(at, nu=order)))


def _whole_period(speeds: FloatArray) -> float:
    """After which all are where they began, or many periods of the slowest."""
    slowest = 2.0 * np.pi / float(speeds.min())
    for number in range(1, PERIODS):
        turns = number * speeds / speeds.min()
        if np.all(np.abs(turns - np.round(turns)) < BACK):
            return number * slowest
    return PERIODS * slowest


def _count(fastest: float, end: float) -> int:
    return 1 + int(min(MOST, max(A_PERIOD, np.ceil(A_PERIOD * fastest * end / (2.0 * np.pi)))))


def _steady(record: MechanismRecord, poses: FloatArray) -> FloatArray:
    """The same poses (N, m) without jumps by whole turns, or of a quaternion's sign."""
    names, steady = record.platform.pose, poses.copy()
    turning = [k for k, name in enumerate(names) if is_angle(name)]
    steady[:, turning] = np.unwrap(steady[:, turning], axis=0)
    if has_quaternion(names):
        columns = [names.index(name) for name in QUATERNION]
        along = np.sum(steady[1:, columns] * steady[:-1, columns], axis=1)
        signs = np.cumprod(np.where(along < 0.0, -1.0, 1.0))
        steady[1:, columns] *= signs[:, None]
    return steady


def _turning(value: FloatArray, first: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The unit quaternion (N, 4), angular velocity and acceleration (N, 3) of a quaternion of any length.

    With r = q / |q| the angular velocity is twice the vector part of r' r*, in which the change of |q| is real.
    """
    square = np.sum(value**2, axis=1, keepdims=True)
    once, twice = (2.0 * _vector_part(part, value) / square for part in (first, second))
    shrinking = 2.0 * np.sum(value * first, axis=1, keepdims=True) / square
    return value / np.sqrt(square), once, twice - shrinking * once


def _vector_part(left: FloatArray, right: FloatArray) -> FloatArray:
    """That of the quaternions left right* (N, 3)."""
    return np.asarray(right[:, :1] * left[:, 1:] - left[:, :1] * right[:, 1:] - np.cross(left[:, 1:], right[:, 1:]))
