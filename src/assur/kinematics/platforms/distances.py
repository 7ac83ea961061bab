"""What a limb with its drives held leaves of the platform: a point of it keeps a distance from a point of the base."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.limbs.serial import ElementaryMotion, SerialLimb, composed, displacement, inverted
from assur.kinematics.limbs.solving import meeting

FloatArray = NDArray[np.float64]
MEETING = 1e-9
"""Distance of axes, in lengths of the limb, up to which they meet."""


@dataclass(frozen=True, eq=False)
class PointDistance:
    """A point (3,) of the platform, in its frame, keeps a distance from a point (3,) of the base."""

    base: FloatArray
    platform: FloatArray
    distance: float


def point_distance(limb: SerialLimb, held: Mapping[int, float]) -> PointDistance | None:
    """What a limb with held joint values says; None where it is anything else than one distance between two points.

    Each of the two is a ball joint, or a universal one, whose axes meet; a rod may spin between two ball joints.
    """
    free = [k for k, motion in enumerate(limb.motions) if motion.index not in held]
    groups = _groups(limb.motions, free)
    if groups is None:
        return None
    (first, start), (second, end) = groups
    before, between, after = (
        _held(limb.motions, [k for k in range(low, high) if k not in free], held)
        for low, high in ((0, first[0]), (first[-1] + 1, second[0]), (second[-1] + 1, len(limb.motions)))
    )
    reached = between[0] @ end + between[1]
    own = composed(inverted(limb.zero), inverted(after))
    return PointDistance(before[0] @ start + before[1], own[0] @ end + own[1], float(np.linalg.norm(reached - start)))


Group = tuple[list[int], FloatArray]


def _groups(motions: Sequence[ElementaryMotion], free: Sequence[int]) -> tuple[Group, Group] | None:
    """The free motions as two groups about a point each, not both of turns alone."""
    balls = [k for k in free if motions[k].kind == "ball"]
    if not balls or any(motions[k].kind == "slide" for k in free):
        return None
    rest = [k for k in free if k not in balls]
    if len(balls) == 2 and not rest:
        return ([balls[0]], motions[balls[0]].point), ([balls[1]], motions[balls[1]].point)
    if len(balls) != 1 or len(rest) != 2 or rest[1] != rest[0] + 1:
        return None
    point = meeting(motions[rest[0]], motions[rest[1]])
    if np.linalg.norm(np.cross(motions[rest[1]].axis, point - motions[rest[1]].point)) > MEETING * _length(motions):
        return None
    ball = [balls[0]], motions[balls[0]].point
    return ((rest, point), ball) if rest[0] < balls[0] else (ball, (rest, point))


def _held(motions: Sequence[ElementaryMotion], chosen: Sequence[int], held: Mapping[int, float]) -> Frame:
    frame: Frame = (np.eye(3), np.zeros(3))
    for k in chosen:
        frame = composed(frame, displacement(motions[k], np.asarray(held[motions[k].index])))
    return frame


def _length(motions: Sequence[ElementaryMotion]) -> float:
    return float(np.max(np.ptp([motion.point for motion in motions], axis=0))) or 1.0
