"""A platform that turns about a fixed point: each limb with its drives held says one linear condition on its rotation.

A limb of turns about that point, two of them free, keeps an angle between an axis of the base and one of the platform.
A limb that keeps a distance between two points keeps the scalar product of their arms from the fixed point.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.limbs.rotations import RotationCondition
from assur.kinematics.limbs.serial import SerialLimb, displacement
from assur.kinematics.limbs.solving import still_point
from assur.kinematics.platforms.distances import point_distance

FloatArray = NDArray[np.float64]
CONDITIONS = 3
SAME_POINT = 1e-9
"""Distance, in lengths of the limbs, up to which fixed points are one."""


def fixed_point(limbs: Sequence[SerialLimb]) -> tuple[FloatArray, FloatArray] | None:
    """The point about which the platform turns, in the base and in the platform (3,), if a limb holds one."""
    for limb in limbs:
        point = still_point(limb)
        if point is not None:
            return point, limb.zero[0].T @ (point - limb.zero[1])
    return None


def rotation_conditions(
    limbs: Sequence[SerialLimb], held: Mapping[int, float], fixed: tuple[FloatArray, FloatArray]
) -> list[RotationCondition] | None:
    """Three conditions on the rotation of a platform with a fixed point; None where limbs say anything else."""
    conditions = []
    for limb in limbs:
        if len(limb.motions) == 1 and limb.motions[0].kind == "ball":
            continue
        condition = _of_turns(limb, held, fixed[0]) or _of_distance(limb, held, fixed)
        if condition is None:
            return None
        conditions.append(condition)
    return conditions if len(conditions) == CONDITIONS else None


def _of_turns(limb: SerialLimb, held: Mapping[int, float], centre: FloatArray) -> RotationCondition | None:
    """U . R w of the two free turns of a limb all of whose axes meet in the fixed point."""
    point = still_point(limb)
    free = [k for k, motion in enumerate(limb.motions) if motion.index not in held]
    size = float(np.max(np.abs([motion.point - centre for motion in limb.motions]))) or 1.0
    if point is None or len(free) != 2 or float(np.linalg.norm(point - centre)) > SAME_POINT * size:
        return None
    turned = [np.eye(3), np.eye(3), np.eye(3)]
    for k, motion in enumerate(limb.motions):
        if k not in free:
            part = sum(k > own for own in free)
            turned[part] = turned[part] @ displacement(motion, np.asarray(held[motion.index]))[0]
    u, w = (limb.motions[k].axis for k in free)
    on_platform = (turned[2] @ limb.zero[0]).T @ w
    return RotationCondition(np.outer(turned[0] @ u, on_platform), float(u @ turned[1] @ w))


def _of_distance(
    limb: SerialLimb, held: Mapping[int, float], fixed: tuple[FloatArray, FloatArray]
) -> RotationCondition | None:
    """2 (a - c) . R (b - o) = |a - c|^2 + |b - o|^2 - d^2."""
    leg = point_distance(limb, held)
    if leg is None:
        return None
    arm, other = leg.base - fixed[0], leg.platform - fixed[1]
    return RotationCondition(np.outer(arm, other), 0.5 * float(arm @ arm + other @ other - leg.distance**2))
