"""Small motions about a pose that the actuators hold by forces which stay as they are: M a + C v + K x = 0.

Per rate of the pose, M is the mass matrix, C what the viscous friction of the actuators does, and K how what is out of
balance changes with the pose: gravity less the forces of the actuators and the load. K is a difference of the fourth
order over poses at which the loops are closed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eigh

from assur.kinematics.border import checked_poses
from assur.kinematics.closure import assemble
from assur.kinematics.rates.motions import pose_units as in_lengths
from assur.machine.forces.actuator_forces import ActuatorForces, forces, forces_at
from assur.machine.forces.loads import Load, load_of
from assur.machine.motion.joint_motion import pose_units
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion, rate_names
from assur.numerics import rotations
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
STEP = 2e-4
"""Of the pose, in characteristic lengths and rad: what is left out and rounding are some 1e-9 of what differs."""
WEIGHTS = {-2.0: 1.0 / 12.0, -1.0: -8.0 / 12.0, 1.0: 8.0 / 12.0, 2.0: -1.0 / 12.0}
NEUTRAL = 1e-5
"""Share of the fastest pole within which another one neither grows nor swings: the root of what K may be wrong by."""


@dataclass(frozen=True, eq=False)
class SmallMotions(Tabulated):
    """The equation about a pose, in SI units, per rate of the pose; NaN where there is none, as `answer` says.

    Attributes:
        answer: what holds the mechanism there.
        mass, damping, stiffness: (k, k).
    """

    answer: ActuatorForces
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray

    def _title(self) -> str:
        return str(self)

    def _entries(self) -> Entries:
        return [{"grows [1/s]": float(pole.real), "turns [rad/s]": float(pole.imag)} for pole in self.poles]

    @cached_property
    def poles(self) -> NDArray[np.complex128]:
        """The 2 k numbers p, in 1/s, for which exp(p t) solves it, in the order of their imaginary parts."""
        count = len(self.mass)
        if not np.all(np.isfinite(self.stiffness)):
            return np.full(2 * count, np.nan + 0j)
        own = -np.linalg.solve(self.mass, np.hstack([self.stiffness, self.damping]))
        found = np.linalg.eigvals(np.vstack([np.hstack([np.zeros((count, count)), np.eye(count)]), own]))
        small = NEUTRAL * np.abs(found).max(initial=0.0)
        parts = [np.where(np.abs(part) <= small, 0.0, part) for part in (found.real, found.imag)]
        order = np.lexsort((parts[0], parts[1]))
        return np.asarray((parts[0] + 1j * parts[1])[order], dtype=np.complex128)

    @property
    def frequencies(self) -> FloatArray:
        """Of what swings, in Hz, ascending, damping left aside."""
        if not np.all(np.isfinite(self.stiffness)):
            return np.empty(0)
        squares = eigh(0.5 * (self.stiffness + self.stiffness.T), self.mass, eigvals_only=True)
        kept = squares > NEUTRAL**2 * np.abs(squares).max(initial=0.0)
        return np.asarray(np.sqrt(squares[kept]) / (2.0 * np.pi))

    @property
    def stable(self) -> bool:
        """Whether nothing grows."""
        return bool(np.all(self.poles.real <= 0.0))

    def __str__(self) -> str:
        listed = ", ".join(f"{value:.6g} Hz" for value in self.frequencies) or "nothing swings"
        return f"small motions of {self.answer.record.name}: {'stable' if self.stable else 'not stable'}; {listed}"


def small_motions(
    record: MechanismRecord,
    pose: ArrayLike,
    mode: str | None = None,
    load: ArrayLike | None = None,
    *,
    gravity: bool = True,
) -> SmallMotions:
    """Small motions about a pose (m,), in the mechanism's unit and rad, in a working mode.

    Args:
        record: the mechanism.
        pose: where the actuators hold it.
        mode: the working mode, the file's default where none is given.
        load: (3,) force in N on the platform at its point, or (6,) with a moment in N m, in the base frame; it stays.
        gravity: whether it acts.

    Errors:
        UsageError: links without a mass, a pose of a wrong shape.

    Example: a five-bar that lies flat stays where it is pushed to.

    >>> from assur.model.registry import load_record
    >>> flat = small_motions(load_record("fivebar"), [0.0, 224.0])
    >>> flat.stable, len(flat.frequencies)
    (True, 0)
    """
    place = checked_poses(record, pose)
    answer = forces(record, place, load=load, gravity=gravity, mode=mode)
    count = len(rate_names(record.platform.pose))
    units = np.diag(pose_units(record))
    changes = np.array([sense * STEP * row for sense in WEIGHTS for row in units])
    near = assemble(
        record, np.repeat(answer.values, len(changes), axis=0), poses=displaced(record, place, changes), near=True
    )
    acting = load_of(load, gravity)
    left = _left_over(record, near.values, acting, answer.forces[0])
    left[~near.closed] = np.nan
    weights = np.array([weight for weight in WEIGHTS.values() for _ in range(count)])
    slopes = (weights[:, None] * left).reshape(len(WEIGHTS), count, count).sum(axis=0)  # row: which coordinate moved
    stiffness = (slopes / (STEP * pose_units(record)[:, None])).T
    moving = answer.motion.drives @ answer.motion.of_pose[0]
    known = [record.machine.actuators.get(record.coordinate_label(item.coordinate)) for item in record.drives]
    viscous = np.array([item.viscous if item else 0.0 for item in known])
    lost = np.isnan(answer.forces[0]).any()
    return SmallMotions(
        answer,
        answer.mass_matrix[0],
        np.full((count, count), np.nan) if lost else moving.T * viscous @ moving,
        stiffness,
    )


def _left_over(record: MechanismRecord, values: FloatArray, acting: Load, held: FloatArray) -> FloatArray:
    """What is out of balance (N, k) at joint values (N, n) with forces (d,) of the actuators."""
    there = forces_at(record, values, load_of(None, acting.gravity))
    of_pose, motion = there.motion.of_pose, there.motion
    pushed = np.einsum("nkj,nk->nj", motion.platform, acting.wrench_at(motion.point)) + held @ motion.drives
    weight = there.gravity if acting.gravity else np.zeros_like(there.bias)
    return np.asarray(weight - np.einsum("njk,nj->nk", of_pose, pushed))


def displaced(record: MechanismRecord, pose: FloatArray, changes: FloatArray) -> FloatArray:
    """Poses (N, m) that a pose (m,) becomes by changes (N, k) in m and rad; a quaternion turns in the base frame."""
    names = record.platform.pose
    steps = changes / pose_units(record) * in_lengths(record)
    if not has_quaternion(names):
        return np.asarray(pose + steps)
    moved = np.repeat(pose[None], len(steps), axis=0)
    columns = [names.index(name) for name in QUATERNION]
    others = [k for k, name in enumerate(names) if name not in QUATERNION]
    moved[:, others] += steps[:, : len(others)]
    turns = rotations.from_vector(steps[:, len(others) :])
    moved[:, columns] = rotations.to_quaternion(turns @ rotations.from_quaternion(pose[columns]))
    return moved
