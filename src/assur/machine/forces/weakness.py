"""Where actuators are weakest: the motion of the platform that moves them least, and who bears a load against it.

Near a singularity forces grow as one over what the actuators move by; at it they hold nothing of such a load.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.rates.motions import SINGULAR, general
from assur.machine.motion.joint_motion import ClosedMotion, drive_units, joint_scales_si, pose_units

FloatArray = NDArray[np.float64]
NOTHING = 1e-9
"""Share of the largest below which a number is rounding."""


@dataclass(frozen=True, eq=False)
class Weakness:
    """The motion of the platform that its actuators hold least, at one configuration.

    Attributes:
        twist: (6,) velocity of the platform's point, angular velocity times the characteristic length: of unit size.
        moved: how fast the actuators move then, lengths and screws in their units; 0 where they do not at all.
        drives: (d,) unit vector: in which ratio they bear a load against it.
        joint: the joint that moves most then, in its unit.
    """

    twist: FloatArray
    moved: float
    drives: FloatArray
    joint: str


def loosest(motion: ClosedMotion, place: int = 0) -> str:
    """The joint that moves most in what the loops nearly let go: where they lose a constraint, reactions grow.

    >>> import assur
    >>> loosest(assur.load("fivebar").forces([0.0, 224.0], gravity=False).motion) in ("A1", "A2", "B1", "B2", "P")
    True
    """
    record = motion.record
    right = np.linalg.svd(motion.closure[place] * joint_scales_si(record))[2]
    moved = np.abs(right[int(general(record).closure) - 1])
    return record.coordinates[int(np.argmax(moved))].joint


def unfelt(motion: ClosedMotion, place: int = 0) -> tuple[str, ...]:
    """Names of the actuators that can move while the pose stays as it is.

    >>> import assur
    >>> angle = np.arctan2(200.0, 150.0)  # the first crank and its rod in one line
    >>> pose = [-70 + 250 * np.cos(angle), 250 * np.sin(angle)]
    >>> stretched = assur.load("fivebar", l2=150).forces(pose, gravity=False, mode="++")
    >>> unfelt(stretched.motion)
    ('theta1',)
    """
    record = motion.record
    free = motion.free[place]
    _, sizes, right = np.linalg.svd(motion.pose[place] @ free / pose_units(record)[:, None])
    still = right[int(np.sum(sizes > SINGULAR * float(sizes[0]))) :].T
    moved = np.linalg.norm(motion.drives @ free @ still / drive_units(record)[:, None], axis=1)
    return tuple(item.name for item, rate in zip(record.drives, moved, strict=True) if rate > SINGULAR)


def fastest(motion: ClosedMotion, place: int = 0) -> tuple[float, FloatArray]:
    """How many times as fast as the pose the actuators move at most, and in which ratio (d,): a unit vector.

    >>> import assur
    >>> times, ratio = fastest(assur.load("orthoglide").forces([0, 0, 0], gravity=False).motion)
    >>> round(times, 9), ratio.shape
    (1.0, (3,))
    """
    per_unit = motion.drives @ motion.of_pose[place] * pose_units(motion.record)
    left, sizes, _ = np.linalg.svd(per_unit / drive_units(motion.record)[:, None])
    return float(sizes[0]), left[:, 0]


def weakness(motion: ClosedMotion, place: int = 0) -> Weakness:
    """Of one of the configurations of a motion.

    >>> import assur
    >>> answer = assur.load("fivebar", l2=150).forces([0.0, 60.0], gravity=False, mode="-+")
    >>> weak = weakness(answer.motion)
    >>> weak.twist.round(3).tolist(), weak.moved < 1e-6, weak.joint  # up, while the first rod turns
    ([0.0, 0.707, 0.0, 0.0, 0.0, 0.707], True, 'P')
    """
    record, length = motion.record, motion.length
    platform = motion.platform[place][[3, 4, 5, 0, 1, 2]] / np.repeat([length, 1.0], 3)[:, None]
    free = motion.free[place]
    left, sizes, right = np.linalg.svd(platform @ free)
    rank = int(np.sum(sizes > NOTHING * max(float(sizes[0]), 1.0)))
    along = right[:rank].T / sizes[:rank]  # free motions per unit twist
    scaled = motion.drives @ free / drive_units(record)[:, None]
    drives, moved, turned = np.linalg.svd(scaled @ along)
    last = rank - 1
    held = moved[last] if last < len(moved) else 0.0
    twist = left[:, :rank] @ turned[last]
    sense = 1.0 if twist[np.argmax(np.abs(twist))] > 0 else -1.0
    rates = np.abs(free @ (along @ turned[last])) / joint_scales_si(record)
    return Weakness(
        twist=np.where(np.abs(twist) < NOTHING, 0.0, sense * twist),
        moved=float(held),
        drives=sense * drives[:, min(last, len(moved) - 1)],
        joint=record.coordinates[int(np.argmax(rates))].joint,
    )
