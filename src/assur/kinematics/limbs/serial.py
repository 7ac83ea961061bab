"""Serial limbs as products of elementary motions: E1(q1) ... En(qn) takes the platform from the zeros to its pose.

Axes are lines of space where all joint values of the limb are zero (R. W. Brockett 1984). A universal joint is two
turns, a cylindrical joint a slide and a turn; a ball joint is one motion about its point, a screw one along its axis.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame, child_frame
from assur.joint_graph.geometry import WRITTEN, characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
EXACT = 1e-12
"""Cosine of square axes, or sine of parallel ones, by rounding alone."""


class NotSerialError(Exception):
    """A limb that is no series of joints, or is not solved as one; the message says which, and why."""


@dataclass(frozen=True, eq=False)
class ElementaryMotion:
    """One motion of a serial limb.

    Attributes:
        kind: a turn about a line, a slide along it, a screw on it, or a ball joint about a point.
        axis: (3,) unit vector; of a ball joint the rows (3, 3) of the frame in which its rotation vector is given.
        point: (3,) on the line, or the ball joint's.
        index: the first of its coordinates in the joint values.
        sense: -1 where the limb runs through the joint from its child to its parent.
        advance: of a screw, by a radian.
    """

    kind: Literal["turn", "slide", "screw", "ball"]
    axis: FloatArray
    point: FloatArray
    index: int
    sense: int
    advance: float = 0.0

    def moved(self, rotation: FloatArray, shift: FloatArray) -> ElementaryMotion:
        """The same about a line that was displaced."""
        return replace(self, axis=self.axis @ rotation.T, point=rotation @ self.point + shift)

    @property
    def indices(self) -> tuple[int, ...]:
        """Of all its coordinates."""
        return tuple(range(self.index, self.index + (3 if self.kind == "ball" else 1)))

    @property
    def back(self) -> ElementaryMotion:
        """The opposite motion."""
        return replace(self, sense=-self.sense)


@dataclass(frozen=True, eq=False)
class SerialLimb:
    """A limb from the base to the platform.

    Attributes:
        joints: names, from the base on.
        motions: in the same order.
        zero: the platform's frame at joint values zero.
        length: of the mechanism, to which points compare where all of the limb are in one place.
    """

    joints: tuple[str, ...]
    motions: tuple[ElementaryMotion, ...]
    zero: Frame
    length: float = 1.0

    def from_platform(self, platform: Frame) -> SerialLimb:
        """The same from the base to where it begins, the platform held at a frame."""
        displaced = composed(platform, inverted(self.zero))
        back = tuple(motion.moved(*displaced).back for motion in reversed(self.motions))
        return replace(self, motions=back, zero=displaced)


def serial_limb(record: MechanismRecord, names: Sequence[str], base: str, platform: str) -> SerialLimb:
    """Joints as a series from one link to another; `zero` and the motions are in the frame of the first.

    Errors:
        NotSerialError: they are none.

    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rrr")
    >>> limb = serial_limb(record, ["leg1.C", "leg1.A", "leg1.B"], record.base, record.platform.link)
    >>> limb.joints, len(limb.motions)
    (('leg1.A', 'leg1.B', 'leg1.C'), 3)
    """
    ordered = _in_order(record, names, base, platform)
    frame, link = (np.eye(3), np.zeros(3)), base
    motions: list[ElementaryMotion] = []
    for name in ordered:
        joint = record.joints[name]
        forward = joint.parent == link
        parent = frame if forward else _parent_frame(joint, frame)
        steps = [*_motions(record, joint, parent)]
        motions += steps if forward else [step.back for step in reversed(steps)]
        frame = child_frame(joint, parent, np.zeros(joint.type.freedoms)) if forward else parent
        link = _other(joint, link)
    return SerialLimb(ordered, tuple(as_meant(motions)), frame, characteristic_length(record))


def as_meant(motions: Iterable[ElementaryMotion]) -> Iterator[ElementaryMotion]:
    """Motions whose axes are parallel or square to those before them where they are so to the digits that a file has.

    What holds for such axes alone, as that a slide square to a hinge stays in a plane, is no longer told from rounding
    else; solutions are closed on the joint graph as it is written.

    >>> origin = np.zeros(3)
    >>> hinge = ElementaryMotion("turn", np.array([1.0, 0.0, 0.0]), origin, 0, 1)
    >>> slide = ElementaryMotion("slide", np.array([1e-9, 0.6, 0.8]), origin, 1, 1)
    >>> [float(own.axis[0]) for own in as_meant([hinge, slide])]
    [1.0, 0.0]
    """
    before: list[FloatArray] = []
    for motion in motions:
        if motion.kind == "ball":
            yield motion
            continue
        axis = _as_meant(motion.axis, before)
        before.append(axis)
        yield motion if axis is motion.axis else replace(motion, axis=axis)


def _as_meant(axis: FloatArray, before: Sequence[FloatArray]) -> FloatArray:
    """An axis among those before it."""
    for other in before:
        if EXACT < np.linalg.norm(np.cross(axis, other)) < WRITTEN:
            return np.asarray(np.copysign(1.0, axis @ other) * other)
    square = np.array([other for other in before if abs(axis @ other) < WRITTEN])
    if not len(square) or np.max(np.abs(square @ axis)) <= EXACT:
        return axis
    across = axis - np.linalg.pinv(square, rcond=WRITTEN) @ (square @ axis)
    return np.asarray(across / np.linalg.norm(across))


def _in_order(record: MechanismRecord, names: Sequence[str], base: str, platform: str) -> tuple[str, ...]:
    """Each joint on the link that the one before leads to."""
    left, link, order = [*names], base, list[str]()
    while left:
        following = [name for name in left if link in (record.joints[name].parent, record.joints[name].child)]
        if len(following) != 1:
            raise NotSerialError(f"{', '.join(names)} are no series from {base} to {platform}")
        order += following
        left.remove(following[0])
        link = _other(record.joints[following[0]], link)
    if link != platform:
        raise NotSerialError(f"{', '.join(names)} do not end at {platform}")
    return tuple(order)


def _motions(record: MechanismRecord, joint: Joint, parent: Frame) -> Iterator[ElementaryMotion]:
    start = joint_graph(record).slices[joint.name].start
    point = parent[0] @ joint.at + parent[1]
    for step, place in joint.type.places:
        axis = parent[0].T if step.kind == "ball" else parent[0] @ joint.axes[step.direction]
        advance = joint.pitch / (2 * np.pi) if step.kind == "screw" else 0.0
        yield ElementaryMotion(step.kind, axis, point, start + place, 1, advance)


def _parent_frame(joint: Joint, child: Frame) -> Frame:
    """Frame of the parent link where that of the child is given and the joint's values are zero."""
    rotation, origin = child_frame(joint, (np.eye(3), np.zeros(3)), np.zeros(joint.type.freedoms))
    turned = child[0] @ rotation.T
    return turned, child[1] - turned @ origin


def _other(joint: Joint, link: str) -> str:
    return joint.child if joint.parent == link else joint.parent


def displacement(motion: ElementaryMotion, value: FloatArray) -> Frame:
    """Rotation (..., 3, 3) and shift (..., 3) of space by a turn, a slide or a screw with joint values (...)."""
    amount = np.asarray(motion.sense * value)
    if motion.kind == "slide":
        return np.broadcast_to(np.eye(3), (*amount.shape, 3, 3)), amount[..., None] * motion.axis
    turned = rotations.about_axis(motion.axis, amount)
    return turned, motion.point - turned @ motion.point + motion.advance * amount[..., None] * motion.axis


def applied(motion: ElementaryMotion, value: FloatArray, points: FloatArray) -> FloatArray:
    """Points (..., 3) moved by a turn, a slide or a screw with joint values (...)."""
    rotation, shift = displacement(motion, value)
    return np.asarray((rotation @ points[..., None])[..., 0] + shift)


def composed(first: Frame, second: Frame) -> Frame:
    """One displacement after another, the second first."""
    return first[0] @ second[0], (first[0] @ second[1][..., None])[..., 0] + first[1]


def inverted(frame: Frame) -> Frame:
    """The displacement back."""
    back = np.swapaxes(frame[0], -1, -2)
    return back, -(back @ frame[1][..., None])[..., 0]
