"""One limb closed with the platform held: all its joint values, by a point that many of its joints leave in place.

A ball joint does, and so do the turns of a universal joint, or of axes that meet. The other motions, three at most,
take that point to its place; those about it then make the rotation that is left. A rod between two ball joints may
spin: one other motion decides the distance of the two.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.limbs.concurrent import along, ball_values, concurrent_turns
from assur.kinematics.limbs.networks import Limb
from assur.kinematics.limbs.point_closure import (
    CLOSE,
    MovingLimbError,
    PointClosure,
    distance_closure,
    point_closure,
)
from assur.kinematics.limbs.screw_closure import screw_closure
from assur.kinematics.limbs.serial import (
    ElementaryMotion,
    NotSerialError,
    SerialLimb,
    applied,
    composed,
    displacement,
    inverted,
)
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
MEETING = 1e-9
"""Distance of axes from a point, in sizes of the limb, up to which they meet there."""
SAME = 1e-6
"""Distance, in sizes of the limb or of a turn, up to which two of its configurations are one."""
OTHERS = 3
"""Motions that can be found from where they take a point."""


@dataclass(frozen=True, eq=False)
class LimbSolutions:
    """All ways in which a limb closes.

    Attributes:
        limb: the limb.
        indices: its coordinates in the joint values.
        values: (K, k) of these.
        bent: (K,) by how much roots were made real.
        roots: how many complex roots were looked at.
    """

    limb: Limb
    indices: tuple[int, ...]
    values: FloatArray
    bent: FloatArray
    roots: int

    def with_value(self, limb: Limb, index: int, value: float) -> LimbSolutions:
        """Those of a limb in which one more joint value is known."""
        place = int(np.searchsorted(self.indices, index))
        indices = (*self.indices[:place], index, *self.indices[place:])
        return replace(self, limb=limb, indices=indices, values=np.insert(self.values, place, value, axis=1))


def limb_solutions(limb: SerialLimb, platform: Frame, driven: Collection[int] = ()) -> LimbSolutions:
    """A limb at a frame of the platform; ways that differ in neither points, nor slides' directions,
    nor `driven` joint values count once.

    Errors:
        NotSerialError: no point of it is left in place by enough of its joints.
        MovingLimbError: it closes in infinitely many ways.
    """
    displaced = composed(platform, inverted(limb.zero))
    if not limb.motions:
        off = max(float(np.max(np.abs(displaced[0] - np.eye(3)))), float(np.linalg.norm(displaced[1])))
        return LimbSolutions(limb, (), np.zeros((1, 0)), np.full(1, off), 1)
    balls = [k for k, motion in enumerate(limb.motions) if motion.kind == "ball"]
    if len(balls) == 2:
        rows, roots = _of_rod(limb, balls[0], balls[1], displaced)
    else:
        rows, roots = _about_any(limb, displaced)
    columns = [index for motion in limb.motions for index in motion.indices]
    values = np.array([values for values, _ in rows]).reshape(len(rows), len(columns))[:, np.argsort(columns)]
    bent = np.array([bent for _, bent in rows])
    kept = told_apart(limb, values, bent, driven)
    return LimbSolutions(limb, tuple(sorted(columns)), values[kept], bent[kept], roots)


def size_of(motions: Sequence[ElementaryMotion], length: float) -> float:
    """A length to which the points of a limb compare: how far they are apart, if that is no rounding of a length."""
    points = [motion.point for motion in motions]
    apart, away = float(np.max(np.ptp(points, axis=0))), float(np.max(np.abs(points)))
    return apart if apart > MEETING * max(away, length) else length


@dataclass(frozen=True, eq=False)
class _Centre:
    """Motions `start` to `end`, the last left out, leave a point (3,) in place."""

    point: FloatArray
    start: int
    end: int


def _centres(limb: SerialLimb) -> list[_Centre]:
    """That of the ball joint, else those of the turns that leave the fewest other motions."""
    motions = limb.motions
    balls = [k for k, motion in enumerate(motions) if motion.kind == "ball"]
    if len(balls) > 1:
        raise NotSerialError(f"{', '.join(limb.joints)}: more than two ball joints")
    centres = [_Centre(motions[k].point, k, k + 1) for k in balls] or [*_meetings(limb)]
    if all(motion.kind == "slide" for motion in motions):  # which any point tells
        centres = [_Centre(motions[0].point, 0, 0)]
    others = [len(motions) - (centre.end - centre.start) for centre in centres]
    if min(others, default=OTHERS + 1) > OTHERS:
        raise NotSerialError(f"{', '.join(limb.joints)}: no point that all but three freedoms leave in place")
    return [centre for centre, count in zip(centres, others, strict=True) if count == min(others)]


def _meetings(limb: SerialLimb) -> Iterator[_Centre]:
    """Successive turns whose axes meet in a point; a turn alone has all points of its axis, of which one is taken."""
    motions = limb.motions
    size = size_of(motions, limb.length)
    turns = [k for k, motion in enumerate(motions) if motion.kind == "turn"]
    for start in turns:
        points = [motions[start].point]
        if start + 1 in turns:
            points.append(meeting(motions[start], motions[start + 1]))
        for point in points:
            end = start
            while end in turns and _distance(motions[end], point) < MEETING * size:
                end += 1
            yield _Centre(point, start, end)


def _distance(motion: ElementaryMotion, point: FloatArray) -> float:
    return float(np.linalg.norm(rotations.cross(motion.axis, point - motion.point)))


def meeting(first: ElementaryMotion, second: ElementaryMotion) -> FloatArray:
    """The point of the first axis that is nearest to the second."""
    across = rotations.cross(rotations.cross(first.axis, second.axis), second.axis)
    share = across @ first.axis
    if abs(share) < MEETING:
        return first.point
    return first.point + first.axis * (across @ (second.point - first.point)) / share


Rows = list[tuple[list[float], float]]


def _about_any(limb: SerialLimb, displaced: Frame) -> tuple[Rows, int]:
    """About the first of its points that is taken to its place in finitely many ways."""
    *others, last = _centres(limb)
    for centre in others:
        try:
            return _about_point(limb, centre, displaced)
        except MovingLimbError:
            continue
    return _about_point(limb, last, displaced)


def _about_point(limb: SerialLimb, centre: _Centre, displaced: Frame) -> tuple[Rows, int]:
    """Values of all motions, in their order, and by how much roots were made real."""
    motions = limb.motions
    before, about, after = motions[: centre.start], motions[centre.start : centre.end], motions[centre.end :]
    others = _others(before, after, displaced)
    moved = displaced[0] @ centre.point + displaced[1]
    closure = _point_closure(others, moved, centre.point, size_of([*motions, *others], limb.length))
    rows: Rows = []
    for values, bent in zip(closure.values, closure.bent, strict=True):
        near, far = values[: len(before)][::-1], values[len(before) :][::-1]
        rotation = _left(before, near, displaced, after, far)[0]
        if about and about[0].kind == "ball":
            rows.append(([*near, *ball_values(about[0], rotation), *far], bent))
            continue
        turned, more = concurrent_turns(about, rotation)
        rows += [([*near, *own, *far], max(bent, other)) for own, other in zip(turned, more, strict=True)]
    return rows, closure.roots


def _point_closure(
    motions: Sequence[ElementaryMotion], point: FloatArray, place: FloatArray, size: float
) -> PointClosure:
    """A screw slides a point of its axis, and is solved as the slide; one that does not has an equation of its own."""
    try:
        slides = [_slide_of(motions, k, point, place, size) for k in range(len(motions))]
    except NotSerialError:
        screws = [k for k, motion in enumerate(motions) if motion.kind == "screw"]
        if len(screws) > 1:
            raise
        return screw_closure(motions, screws[0], point, place, size)
    closure = point_closure(slides, point, place, size)
    return replace(closure, values=closure.values / [motion.advance or 1.0 for motion in motions])


def _slide_of(
    motions: Sequence[ElementaryMotion], number: int, point: FloatArray, place: FloatArray, size: float
) -> ElementaryMotion:
    """One of several motions that take a point to a place; of a screw the slide that it is on its axis."""
    screw = motions[number]
    if screw.kind != "screw":
        return screw
    for end, others in ((point, motions[number + 1 :]), (place, motions[:number])):
        points = [end, *(motion.point for motion in others)]
        tips = [screw.point + motion.axis for motion in others]
        if max(_distance(screw, own) / size for own in points) < MEETING and all(
            _distance(screw, tip) < MEETING for tip in tips
        ):
            return replace(screw, kind="slide")
    raise NotSerialError("a screw moves a point beside its axis")


def _others(
    before: Sequence[ElementaryMotion], after: Sequence[ElementaryMotion], displaced: Frame
) -> list[ElementaryMotion]:
    """E_before (point) = D E_after^-1 (point) as motions of the displaced point to its place."""
    near = [motion.back for motion in reversed(before)]
    return near + [motion.moved(*displaced).back for motion in reversed(after)]


def _left(
    before: Sequence[ElementaryMotion],
    near: Sequence[float],
    displaced: Frame,
    after: Sequence[ElementaryMotion],
    far: Sequence[float],
) -> Frame:
    """E_before^-1 D E_after^-1."""
    left = displaced
    for motion, value in zip(before, near, strict=True):
        left = composed(inverted(displacement(motion, np.asarray(value))), left)
    for motion, value in zip(reversed(after), reversed(far), strict=True):
        left = composed(left, inverted(displacement(motion, np.asarray(value))))
    return left


def _of_rod(limb: SerialLimb, first: int, second: int, displaced: Frame) -> tuple[Rows, int]:
    """A limb with two ball joints and one other motion, or none: then the points are as far apart as they are."""
    motions = limb.motions
    before, middle, after = motions[:first], motions[first + 1 : second], motions[second + 1 :]
    start, end = motions[first], motions[second]
    others = [*before, *middle, *after]
    if len(others) > 1 or any(motion.kind == "screw" for motion in others):
        raise NotSerialError("two ball joints, and more than a turn or a slide beside them")
    far_end = displaced[0] @ end.point + displaced[1]
    if not others:
        off = float(abs(np.linalg.norm(far_end - start.point) - np.linalg.norm(end.point - start.point)))
        size = size_of(motions, limb.length)
        near_enough = int(off < CLOSE * size)
        closure = PointClosure(np.zeros((near_enough, 0)), np.full(near_enough, off / size), 1)
    elif middle:
        closure = distance_closure(middle[0], end.point, start.point, float(np.linalg.norm(far_end - start.point)))
    else:
        length = float(np.linalg.norm(end.point - start.point))
        closure = (
            distance_closure(before[0], start.point, far_end, length)
            if before
            else distance_closure(after[0].moved(*displaced).back, far_end, start.point, length)
        )
    rows: Rows = []
    for values, bent in zip(closure.values.tolist(), closure.bent, strict=True):
        near, between, far = (values if part else [] for part in (before, middle, after))
        left = _left(before, near, displaced, after, far)
        reached = applied(middle[0], np.asarray(*between), end.point) if middle else end.point
        target = left[0] @ end.point + left[1]
        turned = along(reached - start.point, target - start.point)
        rest = turned.T @ left[0]
        if middle:
            rest = displacement(middle[0], np.asarray(*between))[0].T @ rest
        rows.append(([*near, *ball_values(start, turned), *between, *ball_values(end, rest), *far], bent))
    return rows, closure.roots


def told_apart(limb: SerialLimb, values: FloatArray, bent: FloatArray, driven: Collection[int]) -> list[int]:
    """Rows of values (K, k), in the order of their indices, that put points of the limb elsewhere, point slides
    elsewhere, or have other `driven` joint values; of equal ones the most real.
    """
    size = size_of(limb.motions, limb.length)
    order = np.argsort(np.argsort([index for motion in limb.motions for index in motion.indices]))
    places = np.array([[*_places(limb.motions, row[order], driven, size)] for row in values])
    kept: list[int] = []
    for k in np.argsort(bent, kind="stable"):
        if all(np.max(np.abs(places[k] - places[j])) > SAME for j in kept):
            kept.append(int(k))
    return sorted(kept)


def _places(
    motions: Sequence[ElementaryMotion], row: FloatArray, driven: Collection[int], size: float
) -> Iterator[float]:
    """Where the points of turns are, in sizes, which way slides point, and driven joint values."""
    frame: Frame = (np.eye(3), np.zeros(3))
    column = 0
    for motion in motions:
        slides = motion.kind == "slide"
        yield from frame[0] @ motion.axis if slides else (frame[0] @ motion.point + frame[1]) / size
        own = row[column : column + len(motion.indices)]
        column += len(own)
        if motion.kind != "ball":
            frame = composed(frame, displacement(motion, own[0]))
            if motion.index in driven:
                if motion.kind == "turn":
                    yield from (np.cos(own[0]), np.sin(own[0]))
                else:
                    yield own[0] * (motion.advance or 1.0) / size
        else:
            turned = rotations.from_vector(motion.axis.T @ own)
            turned = turned if motion.sense > 0 else turned.T
            frame = composed(frame, (turned, motion.point - turned @ motion.point))
