"""Steps to neighbouring poses: along the tangent, corrected, and taken only where the working mode is kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import held_inputs
from assur.kinematics.following.course import Prescribed
from assur.kinematics.following.platform_held import PlatformHeld, holding, passes_zero
from assur.kinematics.following.stepping import Pace, Places, followed
from assur.kinematics.following.ways import Straight
from assur.kinematics.naming import declared_signs
from assur.kinematics.newton import moved
from assur.kinematics.turns import joint_units, whole_turns_less
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]

FURTHEST = 1.0
"""How far a joint value may move in one step, in rad or characteristic lengths."""

LONG = 0.3
"""How far a step goes along the tangent at most."""

PARTS = 4
"""What cannot be reached in one step is tried in so many."""


@dataclass(frozen=True, eq=False)
class SignGuard:
    """The guard of many ways of poses or inputs: the signs of one mode stay, and no two branches merge between.

    Of these two, the first is what names the mode, the second is told by one determinant (`passes_zero`). What it knows
    of assemblies is how fast joint values change with what is held (`Newton.rates`).
    """

    record: MechanismRecord
    signs: NDArray[np.int8]
    held: Prescribed = "poses"

    def step(
        self, way: Straight, places: Places, ends: FloatArray, rows: IntArray
    ) -> tuple[Places, BoolArray, FloatArray]:
        """Where steps lead, which of them may not be taken, and steps twice as long."""
        move = (places.known @ way.change(places.shares, ends, rows)[..., None])[..., 0]
        move *= (LONG / np.maximum(np.max(np.abs(move), axis=1, initial=0.0), LONG))[:, None]
        foreseen = moved(self.record, places.joints, move * joint_units(self.record))
        near = holding(self.record, self.held)(*_holding(self.record, self.held, foreseen, way.at(ends, rows)))
        reached = Places(ends, near.values, near.derivative)
        far = np.max(np.abs(near.values - places.joints) / joint_units(self.record), axis=1, initial=0.0)
        good = near.closed & (far <= FURTHEST)
        good[good] = self.kept(places.of(good), reached.of(good))
        return replace(reached, joints=whole_turns_less(self.record, near.values)), good, 2.0 * (ends - places.shares)

    def kept(self, left: Places, reached: Places) -> BoolArray:
        """Whether assemblies (N,) near others are of the mode, with no merging between."""
        same = np.all(held_signs(self.record, self.held, reached.joints) * self.signs >= 0, axis=1)
        return np.asarray(same & ~passes_zero(left.known, reached.known))


@dataclass(frozen=True, eq=False)
class Steps:
    """Steps from assemblies at poses (N, m), or at inputs where the guard holds those."""

    guard: SignGuard
    poses: FloatArray
    places: Places

    def of(self, rows: IntArray | BoolArray) -> Steps:
        """Those of some of the assemblies, which may repeat."""
        return Steps(self.guard, self.poses[rows], self.places.of(rows))

    @cached_property
    def held(self) -> PlatformHeld:
        """The first-order motion there."""
        return PlatformHeld(self.guard.record, self.places.known)

    def to(self, poses: FloatArray) -> tuple[Steps, BoolArray]:
        """Steps from assemblies at other poses (N, m), and where they may be reached (N,); elsewhere they are near."""
        if not len(poses):
            return self, np.zeros(0, dtype=bool)
        way, rows = Straight(self.guard.record, self.poses, poses, self.guard.held), np.arange(len(poses))
        places, good, _ = self.guard.step(way, self.places, np.ones(len(poses)), rows)
        return steps_from(self.guard, poses, places), good

    def in_parts(self, poses: FloatArray) -> tuple[Steps, BoolArray]:
        """The same in several parts, none of which may fail."""
        places = self.places.of(np.arange(len(poses)))
        way = Straight(self.guard.record, self.poses, poses, self.guard.held)
        part = np.full(len(poses), 1.0 / PARTS)
        good = followed(way, places, self.guard, Pace(1.0 / PARTS, 1.0 / PARTS), part)
        return steps_from(self.guard, poses, places), good


def steps_from(guard: SignGuard, poses: FloatArray, places: Places) -> Steps:
    """Steps from places at poses (N, m), where new ways begin."""
    return Steps(guard, poses, replace(places, shares=np.zeros(len(poses))))


def joined(parts: Sequence[Steps]) -> Steps:
    """Steps of one guard after one another."""
    parts = [steps for steps in parts if len(steps.poses)] or parts[:1]
    if len(parts) == 1:
        return parts[0]
    places = [steps.places for steps in parts]
    shares, joints, known = (
        np.concatenate([getattr(own, name) for own in places]) for name in ("shares", "joints", "known")
    )
    return Steps(parts[0].guard, np.concatenate([steps.poses for steps in parts]), Places(shares, joints, known))


def steps_at(guard: SignGuard, poses: FloatArray, joints: FloatArray) -> Steps:
    """Steps from assemblies (N, n) at poses (N, m)."""
    rates = holding(guard.record, guard.held).rates(*_holding(guard.record, guard.held, joints, poses))
    return Steps(guard, poses, Places(np.zeros(len(poses)), joints, rates))


def _holding(
    record: MechanismRecord, held: Prescribed, joints: FloatArray, targets: FloatArray
) -> tuple[FloatArray, FloatArray | None]:
    """Joint values (N, n) at which Newton's method is to start, and poses (N, m) where it holds these."""
    return (joints, targets) if held == "poses" else (held_inputs(record, joints, targets), None)


def held_signs(record: MechanismRecord, held: Prescribed, joints: FloatArray) -> NDArray[np.int8]:
    """Signs (..., s) of what names the modes with the platform held (working modes) or the inputs (assembly modes)."""
    return declared_signs(record, "inverse" if held == "poses" else "direct", joints)
