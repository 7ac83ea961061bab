"""The platform's frames at a pose that leaves coordinates open: these follow from what limbs hold it to.

A limb of three freedoms says all where the place is given. A ball joint that a limb keeps in a plane says one condition
n . (p + R b) = h, linear in p and R: three of them leave eight rotations at a place; where one angle is open, the open
lengths are eliminated, and what is left of the angle is A cos + B sin + C = 0. Solutions of such a kind may be several:
operation modes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.limbs.point_closure import point_closure
from assur.kinematics.limbs.rotations import RotationCondition, rotations_under
from assur.kinematics.limbs.serial import SerialLimb, composed, displacement
from assur.kinematics.loops.loops import PositionQuestion
from assur.model.pose import ANGLES, LENGTHS
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
PARALLEL = 1e-9
"""Sine of an angle between axes up to which they are parallel."""
SURE = 1e-7
"""Least |A, B| - |C| over |A, B| of an angle that is told from a double one."""


@dataclass(frozen=True, eq=False)
class Completion:
    """Frames of the platform, whether they are certainly all, and by what."""

    frames: tuple[Frame, ...]
    sure: bool
    right: str


@dataclass(frozen=True, eq=False)
class PlaneCondition:
    """A point (3,) of the platform stays in a plane of the base, normal . x = height; or dual, one of the base in one
    of the platform.
    """

    normal: FloatArray
    height: float
    point: FloatArray
    of_platform: bool

    def at(self, place: FloatArray) -> RotationCondition:
        """The condition on the rotation where the platform's origin is at a place (3,)."""
        if self.of_platform:
            return RotationCondition(np.outer(self.normal, self.point), self.height - float(self.normal @ place))
        return RotationCondition(np.outer(self.point - place, self.normal), self.height)


def plane_condition(limb: SerialLimb) -> PlaneCondition | None:
    """What a limb says that keeps the centre of its one ball joint in a plane; None where it says anything else."""
    balls = [k for k, motion in enumerate(limb.motions) if motion.kind == "ball"]
    if len(balls) != 1 or balls[0] not in (0, len(limb.motions) - 1) or len(limb.motions) != 3:
        return None
    first, second = (motion for motion in limb.motions if motion.kind != "ball")
    turns = [motion.axis for motion in (first, second) if motion.kind == "turn"]
    across = np.cross(first.axis, second.axis)
    if len(turns) == 2:
        fits, normal = float(np.linalg.norm(across)) < PARALLEL, turns[0]
    elif len(turns) == 1:
        fits, normal = abs(float(first.axis @ second.axis)) < PARALLEL, turns[0]
    else:
        fits, normal = float(np.linalg.norm(across)) > PARALLEL, across
    if not fits:
        return None
    centre = limb.motions[balls[0]].point
    own = limb.zero[0].T @ (centre - limb.zero[1])
    if balls[0]:
        return PlaneCondition(normal, float(normal @ centre), own, of_platform=True)
    return PlaneCondition(limb.zero[0].T @ normal, float(limb.zero[0].T @ normal @ own), centre, of_platform=False)


def completion(question: PositionQuestion, limbs: Sequence[SerialLimb]) -> Completion | None:
    """All frames of the platform at a pose that leaves coordinates open; None where limbs are of another kind."""
    angles = [name for name in ANGLES if name in question.record.platform.pose]
    point = question.record.platform.point
    if question.place.keys() == {*LENGTHS} and not angles:
        place = np.array([question.place[name] for name in LENGTHS])
        return _by_limb(limbs, place, point) or _by_planes(limbs, place, point)
    if len(angles) == len(ANGLES) - 1:
        return _by_angle(question, limbs)
    return None


def _by_limb(limbs: Sequence[SerialLimb], place: FloatArray, point: FloatArray) -> Completion | None:
    """By a limb of three freedoms, which takes the platform's point to its place."""
    for limb in limbs:
        if len(limb.motions) != 3 or any(motion.kind == "ball" for motion in limb.motions):
            continue
        start = limb.zero[0] @ point + limb.zero[1]
        size = float(np.max(np.ptp([start, place, *(motion.point for motion in limb.motions)], axis=0)))
        closure = point_closure(limb.motions, start, place, size)
        frames: list[Frame] = []
        for values in closure.values:
            frame = limb.zero
            for motion, value in zip(reversed(limb.motions), reversed(values), strict=True):
                frame = composed(displacement(motion, value), frame)
            if not any(np.allclose(frame[0], other[0], rtol=0, atol=1e-6) for other in frames):
                frames.append(frame)
        right = f"the platform as {limb.joints[0]} to {limb.joints[-1]} hold it, {len(frames)} ways"
        return Completion(tuple(frames), bool(np.all(closure.bent == 0.0)), right)
    return None


def _by_planes(limbs: Sequence[SerialLimb], place: FloatArray, point: FloatArray) -> Completion | None:
    """By three ball joints that stay in planes, of which the rotation is solved about the platform's point."""
    conditions = [plane_condition(limb) for limb in limbs]
    known = [condition for condition in conditions if condition is not None]
    if len(known) != len(limbs) or len(known) != 3:
        return None
    moved = [
        PlaneCondition(own.normal, own.height, own.point - point, own.of_platform)
        if own.of_platform
        else PlaneCondition(own.normal, own.height - float(own.normal @ point), own.point, own.of_platform)
        for own in known
    ]
    solved = rotations_under([own.at(place) for own in moved])
    frames = tuple((rotation, place - rotation @ point) for rotation in solved.values)
    right = f"three ball joints in planes, {solved.complex} complex rotations of at most 8, {len(frames)} of them real"
    return Completion(frames, solved.sure, right)


def _by_angle(question: PositionQuestion, limbs: Sequence[SerialLimb]) -> Completion | None:
    """By ball joints in planes of the base, where one angle and some lengths are open."""
    known = [own for own in map(plane_condition, limbs) if own is not None and own.of_platform]
    open_lengths = [k for k, name in enumerate(LENGTHS) if name not in question.place]
    if len(known) != len(limbs) or len(known) != len(open_lengths) + 1:
        return None
    pose = dict(zip(question.record.platform.pose, question.given, strict=True))
    (open_angle,) = (name for name in ANGLES if name not in pose)

    def turned(angle: float) -> FloatArray:
        values = {**pose, open_angle: angle}
        return rotations.from_angles(*(np.asarray(values[name]) for name in ANGLES))

    ends = turned(0.0), turned(0.5 * np.pi), turned(np.pi)
    parts = 0.5 * (ends[0] - ends[2]), ends[1] - 0.5 * (ends[0] + ends[2]), 0.5 * (ends[0] + ends[2])
    point = question.record.platform.point
    place = np.array([pose.get(name, 0.0) for name in LENGTHS])
    normals = np.array([own.normal for own in known])
    rows = np.array([[own.normal @ part @ (own.point - point) for part in parts] for own in known])
    rows[:, 2] += normals @ place - [own.height for own in known]
    left, singular, _ = np.linalg.svd(normals[:, open_lengths])
    if len(singular) and singular[-1] < PARALLEL:
        return None
    a, b, c = left[:, len(open_lengths) :].T[0] @ rows
    size = float(np.hypot(a, b))
    if size < PARALLEL * float(np.max(np.abs(rows))):
        return None
    half = np.arccos(np.clip(-c / size, -1.0, 1.0))
    frames: list[Frame] = []
    for angle in np.arctan2(b, a) + np.array([half, -half] if abs(c) <= size else []):
        own = parts[0] * np.cos(angle) + parts[1] * np.sin(angle) + parts[2]
        shift = np.linalg.lstsq(normals[:, open_lengths], -(rows @ [np.cos(angle), np.sin(angle), 1.0]), rcond=None)[0]
        full = place.copy()
        full[open_lengths] += shift
        frames.append((own, full - own @ point))
    sure = abs(abs(c) - size) > SURE * size
    return Completion(tuple(frames), sure, f"{len(known)} ball joints in planes, 2 complex angles {open_angle}")
