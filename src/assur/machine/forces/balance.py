"""Forces that balance all links by virtual work, for each configuration by singular values: singular ones too."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Self

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.rates.instantaneous import Instant, instantaneous
from assur.kinematics.rates.motions import general
from assur.kinematics.status import NEAR_SINGULAR, Status
from assur.machine.forces.loads import Load
from assur.machine.masses.link_masses import Masses
from assur.machine.motion.inertia import link_inertia
from assur.machine.motion.joint_motion import ClosedMotion, closed_motion, drive_units
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
HELD = 1e-9
"""Singular values of the drives below this hold nothing."""
AT_ONCE = 1024
"""Configurations whose matrices are kept at a time."""
NO_FORCES = (
    Status.parallel,
    Status.comprehensive,
    Status.constraint,
    Status.self_motion,
    Status.not_closed,
    Status.unreachable,
    Status.undecided,
)
"""Where actuators hold nothing, or nobody can tell."""


@dataclass(frozen=True, eq=False)
class Balance:
    """Forces and motion at N configurations, in SI units; numbers that a status takes away are still there.

    Attributes:
        status: (N,) of `Status`.
        rated: (N,) whether the rates of the pose are free, so that a mass matrix exists in them.
        forces: (N, d) of the drives.
        joint_rates, joint_accelerations: (N, n).
        kinetic_energy, potential_energy: (N,).
    """

    status: NDArray[np.int8]
    rated: BoolArray
    forces: FloatArray
    joint_rates: FloatArray
    joint_accelerations: FloatArray
    kinetic_energy: FloatArray
    potential_energy: FloatArray

    @classmethod
    def joined(cls, parts: list[Self]) -> Self:
        """One after the other."""
        return cls(*(np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(cls)))

    def put(self, rows: NDArray[np.intp], other: Balance) -> None:
        """Another's numbers into some rows."""
        for item in fields(self):
            getattr(self, item.name)[rows] = getattr(other, item.name)


@dataclass(frozen=True, eq=False)
class Asked:
    """What is asked: configurations (N, n) of a mechanism, what its links weigh and bear, and how its pose moves.

    `velocity` and `acceleration` (N, k) of the pose are in SI units, None at rest; `joint_rates` (N, n) where more than
    the velocity is known, else they have the least kinetic energy.
    """

    record: MechanismRecord
    values: FloatArray
    known: Masses
    load: Load
    velocity: FloatArray | None = None
    acceleration: FloatArray | None = None
    joint_rates: FloatArray | None = None

    @property
    def moves(self) -> bool:
        """Whether a motion is asked for."""
        return self.velocity is not None or self.acceleration is not None

    def part(self, rows: NDArray[np.intp] | slice) -> Asked:
        """Of some configurations alone."""
        known = self.velocity, self.acceleration, self.joint_rates
        motion = (None if part is None else part[rows] for part in known)
        return Asked(self.record, self.values[rows], self.known, self.load.part(rows, len(self.values)), *motion)

    def parts(self, count: int) -> list[Asked]:
        """So many at a time."""
        starts = range(0, max(len(self.values), 1), count)
        return [self.part(slice(first, first + count)) for first in starts]

    def motion(self) -> ClosedMotion:
        """Of all joints."""
        return closed_motion(link_inertia(self.record, self.values, self.known), self.values)


def balanced(asked: Asked) -> Balance:
    """Forces of the actuators by singular values, a few configurations at a time."""
    return Balance.joined([_balanced(part) for part in asked.parts(AT_ONCE)])


def _balanced(asked: Asked) -> Balance:
    motion, load = asked.motion(), asked.load
    inertia, instant = motion.inertia, instantaneous(asked.record, asked.values)
    zero = np.zeros((len(asked.values), motion.pose.shape[1]))
    rates, speeding = (zero if part is None else part for part in (asked.velocity, asked.acceleration))
    joint_rates = motion.rates(rates) if asked.joint_rates is None else asked.joint_rates
    second = motion.second(joint_rates, speeding)
    weight = inertia.weight if load.gravity else np.zeros_like(second)
    pushed = np.einsum("nkj,nk->nj", motion.platform, load.wrench_at(motion.point))
    second = second + motion.idle_accelerations(inertia.needed(joint_rates, second) + weight - pushed)
    needed = inertia.needed(joint_rates, second) + weight - pushed
    return Balance(
        status=_status(instant, asked.moves),
        rated=np.asarray(instant.closed & ~instant.singular_input & ~instant.no_rates),
        forces=_forces(motion, needed),
        joint_rates=joint_rates,
        joint_accelerations=second,
        kinetic_energy=inertia.kinetic(joint_rates),
        potential_energy=inertia.potential,
    )


def _status(instant: Instant, moves: bool) -> NDArray[np.int8]:
    """Of each configuration; one that moves where the pose's rates are not free is not determined."""
    output, given = instant.singular_output, instant.singular_input
    status = np.full(output.shape, int(Status.regular), dtype=np.int8)
    for name in ("output", "input", "closure"):
        near = np.nan_to_num(instant.measures[name], nan=1.0) < NEAR_SINGULAR
        status[near] = int(Status.near_singular)
    status[given] = int(Status.serial)
    if moves:
        status[given | instant.no_rates] = int(Status.undecided)
    status[output] = int(Status.parallel)
    status[output & given] = int(Status.comprehensive)
    status[instant.ranks.freedoms > instant.general.freedoms] = int(Status.constraint)
    status[~instant.closed] = int(Status.not_closed)
    return status


def _forces(motion: ClosedMotion, needed: FloatArray) -> FloatArray:
    """Forces (N, d) of the drives for forces (N, n) of the joint rates; of redundant ones the least, in newtons."""
    units = np.ones(len(motion.drives)) if redundant(motion.record) else drive_units(motion.record)
    free = np.swapaxes(motion.free, -1, -2)
    driven = free @ (motion.drives / units[:, None]).T  # (N, n, d)
    inverse = np.linalg.pinv(driven, rcond=HELD)
    return np.asarray((inverse @ (free @ needed[..., None]))[..., 0] / units)


def redundant(record: MechanismRecord) -> int:
    """How many more drives there are than independent rates of theirs.

    >>> from assur.model.registry import load_record
    >>> redundant(load_record("fivebar"))
    0
    """
    return len(record.drives) - int(general(record).inputs)


def preload(motion: ClosedMotion) -> FloatArray:
    """Forces (N, d, r) of redundant drives that balance one another, orthonormal columns."""
    count = redundant(motion.record)
    if not count:
        return np.empty((len(motion.free), len(motion.drives), 0))
    right = np.linalg.svd(np.swapaxes(motion.free, -1, -2) @ motion.drives.T, full_matrices=True)[2]
    return np.asarray(np.swapaxes(right[:, -count:], -1, -2))


def growth(motion: ClosedMotion) -> FloatArray:
    """Largest force (N,) of an actuator per unit force at the platform, moments over the characteristic length."""
    units = np.repeat([motion.length, 1.0], 3)
    free = np.swapaxes(motion.free, -1, -2)
    per_load = np.linalg.pinv(free @ motion.drives.T, rcond=HELD) @ free @ np.swapaxes(motion.platform, -1, -2) * units
    return np.asarray(np.max(np.linalg.norm(per_load, axis=-1), axis=-1))
