"""A pose that leaves coordinates open as a limb of its own: what is open are its joints, what is told is held.

With one limb of the mechanism it is a single loop. Where that closes in finitely many ways, these are all poses there
can be, whatever else the limb says than quadrics: a leg of two universal joints and a slide says a quartic.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.limbs.networks import Limb
from assur.kinematics.limbs.point_closure import MovingLimbError
from assur.kinematics.limbs.serial import ElementaryMotion, NotSerialError, SerialLimb, composed, displacement
from assur.kinematics.platforms.chains import FREEDOMS, closed_series, freedoms, loop_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
SAME = 1e-7
"""Distance, in characteristic lengths and rad, up to which two frames are one that was found twice."""


@dataclass(frozen=True, eq=False)
class OpenPoses:
    """All poses in which one limb holds what a pose leaves open.

    Attributes:
        frames: of the platform.
        limb: the first joint of the limb.
        complex: how many ways its loop has, complex ones too.
        sure: whether none of them was a real one by rounding alone.
    """

    frames: tuple[Frame, ...]
    limb: str
    complex: int
    sure: bool

    @property
    def right(self) -> str:
        """What was solved."""
        return f"the platform as the limb of {self.limb} holds it, {self.complex} complex ways of their loop"


def open_limb(record: MechanismRecord, pose: FloatArray) -> SerialLimb | None:
    """A pose (m,) as a limb: slides along x, y, z, then turns phi, theta, psi, those that it tells held; None where it
    tells a whole orientation by a quaternion, or no angle.

    >>> from assur.model.registry import load_record
    >>> limb = open_limb(load_record("planar_3rrr"), np.array([1.0, 2.0, 0.3]))
    >>> [motion.kind for motion in limb.motions]
    ['slide', 'turn', 'turn']
    """
    named = dict(zip(record.platform.pose, pose, strict=True))
    if not named.keys() & {*ANGLES}:
        return None
    point = np.array([named.get(name, 0.0) for name in LENGTHS])
    index, motions = len(record.coordinates), list[ElementaryMotion]()
    for name, axis in zip(LENGTHS, np.eye(3), strict=True):
        if name not in named:
            motions.append(ElementaryMotion("slide", axis, point, index + len(motions), 1))
    turned = np.eye(3)
    for name, axis in zip(ANGLES, np.eye(3)[::-1], strict=True):
        if name not in named:
            motions.append(ElementaryMotion("turn", turned @ axis, point, index + len(motions), 1))
        turned = turned @ rotations.about_axis(axis, np.asarray(named.get(name, 0.0)))
    zero = turned, point - turned @ record.platform.point
    return SerialLimb(("the pose",), tuple(motions), zero, characteristic_length(record))


def poses_by_limb(record: MechanismRecord, pose: FloatArray, limbs: Sequence[Limb]) -> OpenPoses | None:
    """All poses, by the first limb whose loop with what the pose (m,) leaves open closes in finitely many ways."""
    own = open_limb(record, pose)
    if own is None:
        return None
    for limb in limbs:
        if not isinstance(limb, SerialLimb) or sum(map(freedoms, limb.motions)) + len(own.motions) > FREEDOMS:
            continue
        try:
            open_values = [motion.index for motion in own.motions]  # which may differ where no point does
            ways = closed_series(loop_of(limb, own), (np.eye(3), np.zeros(3)), open_values)
        except (NotSerialError, MovingLimbError):
            continue
        places = [int(np.flatnonzero(np.equal(ways.indices, motion.index))[0]) for motion in own.motions]
        frames: list[Frame] = []
        for row in ways.values:
            frame = own.zero
            for motion, place in zip(reversed(own.motions), reversed(places), strict=True):
                frame = composed(displacement(motion, row[place]), frame)
            if all(_apart(frame, other, own.length) > SAME for other in frames):
                frames.append(frame)
        return OpenPoses(tuple(frames), limb.joints[0], ways.roots, bool(np.all(ways.bent < SAME)))
    return None


def _apart(first: Frame, second: Frame, length: float) -> float:
    return float(max(np.max(np.abs(first[0] - second[0])), np.max(np.abs(first[1] - second[1])) / length))
