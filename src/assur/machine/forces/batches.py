"""Forces of the actuators at many configurations: by recorded programs, where their pivots are good.

Where a configuration is near a singularity, or pivots are not good, singular values decide.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.graph_program import GraphProgram
from assur.joint_graph.programs import program
from assur.kinematics.closure import CLOSED
from assur.kinematics.pose import platform_frame
from assur.kinematics.rates.motions import SINGULAR, closure_share, drive_units, general_share, pose_units
from assur.kinematics.status import NEAR_SINGULAR, Status
from assur.kinematics.turns import joint_units
from assur.kinematics.validation.check import METRES
from assur.machine.forces.balance import Asked, Balance, balanced
from assur.machine.masses.rigid_body import RigidBody
from assur.machine.motion.inertia import rotors
from assur.machine.motion.loop_equations import angle_numbers, angles_given, angular_motion
from assur.machine.motion.pivots import graph_pivots, weighs
from assur.machine.motion.recorded_dynamics import InverseDynamics
from assur.machine.motion.screws import rate_metres
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

BLOCK = 2048
"""Configurations that are worked on at a time."""
LEFT = 1e-12
"""Share of an equation that rows may leave."""
CLEAR = 3.0
"""How far the estimate of the closure is from where it is near a singularity, so that it need not be looked at."""
WIDE = 10.0
"""How far what is singular is from what pivots may tell."""


def balanced_in_batches(asked: Asked) -> Balance:
    """Forces of the actuators by pivots, and by singular values where these are not good."""
    batch = batch_of(asked)
    if batch is None:
        return balanced(asked)
    parts = [batch.balanced(part) for part in asked.parts(BLOCK)]
    answer = Balance.joined([part for part, _ in parts])
    left = np.flatnonzero(~np.concatenate([clear for _, clear in parts]))
    if len(left):
        answer.put(left, balanced(asked.part(left)))
    return answer


@dataclass(frozen=True, eq=False)
class Batch:
    """A recorded program and what it is given beside configurations: numbers (g,) that are the same for all."""

    record: MechanismRecord
    question: InverseDynamics
    same: FloatArray

    @cached_property
    def program(self) -> GraphProgram:
        """Of the question, lengths in the mechanism's unit."""
        return program(self.record, self.question, self.question.given, self.question.same)

    def balanced(self, asked: Asked) -> tuple[Balance, BoolArray]:
        """Forces, and where (N,) they are clear; elsewhere numbers mean nothing."""
        record, metre, count = self.record, METRES[self.record.unit], len(asked.values)
        lengths = np.array([item.kind == "length" for item in record.coordinates])
        angles = any(name in ANGLES for name in record.platform.pose)
        rotation = platform_frame(record, asked.values)[0] if angles else None
        numbers = self.program(record, asked.values, self._given(asked, rotation), self.same.tolist())
        with np.errstate(all="ignore"):
            driven = self._matrix("driven", numbers, len(record.drives), len(self.units))
            inverse = _inverse(driven)
            forces = (np.swapaxes(inverse, -1, -2) @ self._matrix("needed", numbers, len(self.units), 1))[..., 0]
            clear, near = self._judged(numbers, (driven, inverse), asked.values)
        if rotation is not None:
            clear &= np.abs(np.cos(rotations.to_angles(rotation)[1])) > SINGULAR
        rates, second = (self._matrix(kind, numbers, len(lengths), 1)[..., 0] for kind in ("rate", "second"))
        of_drives = lengths[[column for column, _ in self.question.drives]]
        kinetic, potential = (metre**2 * self._row(kind, numbers) for kind in ("kinetic", "potential"))
        balance = Balance(
            status=np.where(near, int(Status.near_singular), int(Status.regular)).astype(np.int8),
            rated=np.ones(count, dtype=bool),
            forces=forces * np.where(of_drives, metre, metre**2),
            joint_rates=rates * np.where(lengths, metre, 1.0),
            joint_accelerations=second * np.where(lengths, metre, 1.0),
            kinetic_energy=kinetic,
            potential_energy=potential,
        )
        return balance, clear

    @cached_property
    def units(self) -> FloatArray:
        """What a rate of the pose (k,) in the mechanism's unit is in SI units."""
        return rate_metres(self.record)

    def _given(self, asked: Asked, rotation: FloatArray | None) -> FloatArray:
        """What is given (g, N)."""
        count, metre, pose = len(asked.values), METRES[self.record.unit], self.record.platform.pose
        given = [np.empty((0, count))]
        if self.question.loaded:
            parts = asked.load.force / metre, asked.load.moment / metre**2
            given += [np.broadcast_to(part, (count, 3)).T for part in parts]
        if self.question.moving:
            still = np.zeros((count, len(self.units)))
            motion = [still if part is None else part / self.units for part in (asked.velocity, asked.acceleration)]
            if rotation is not None and not angles_given(pose):
                motion = angular_motion(pose, rotation, *motion)
            given += [part.T for part in motion]
        if rotation is not None and angles_given(pose):
            given.append(angle_numbers(rotation))
        return np.concatenate(given)

    def _judged(
        self, numbers: FloatArray, drives: tuple[FloatArray, FloatArray], values: FloatArray
    ) -> tuple[BoolArray, BoolArray]:
        """Where (N,) loops close, nothing is singular and pivots leave nothing; what of it is near a singularity.

        `drives` are the rates (N, d, k) of these per rate of the pose, and their inverse.
        """
        units = pose_units(self.record) / drive_units(self.record)[:, None]
        driven, backward = drives[0] * units, drives[1] / units.T
        sizes = np.linalg.norm(driven, axis=(-1, -2))  # at least the largest singular value
        size, inverse = self._row("size", numbers), self._row("inverse", numbers)
        left, among, gaps = (numbers[self.program.rows(kind)] for kind in ("left", "among", "square"))
        clear = np.isfinite(sizes) & np.isfinite(inverse)
        clear &= np.all(gaps <= (0.1 * CLOSED) ** 2, axis=0) & (1.0 / np.sqrt(1.0 + sizes**2) > WIDE * SINGULAR)
        clear &= np.all(left <= LEFT**2 * among * size, axis=0)
        output = 1.0 / np.linalg.norm(backward, axis=(-1, -2))
        doubtful = clear & ~(output > CLEAR * NEAR_SINGULAR)
        output[doubtful] = np.linalg.svd(driven[doubtful], compute_uv=False)[:, -1]
        closure = 1.0 / np.sqrt(size * inverse) / general_share(self.record)
        doubtful = clear & ~(closure > CLEAR * NEAR_SINGULAR)
        closure[doubtful] = closure_share(self.record, values[doubtful])
        doubtful = clear & (sizes > 1.0 / (CLEAR * NEAR_SINGULAR))
        sizes[doubtful] = np.linalg.svd(driven[doubtful], compute_uv=False)[:, 0]
        least = np.minimum(output / np.sqrt(1.0 + output**2), np.minimum(closure, 1.0 / np.sqrt(1.0 + sizes**2)))
        return clear & (least > WIDE * SINGULAR), least < NEAR_SINGULAR

    def _matrix(self, kind: str, numbers: FloatArray, rows: int, columns: int) -> FloatArray:
        return self.program.matrix(kind, numbers, (rows, columns))

    def _row(self, kind: str, numbers: FloatArray) -> FloatArray:
        return np.asarray(numbers[self.program.rows(kind)][0])


def batch_of(asked: Asked) -> Batch | None:
    """The program for what is asked; None where pivots tell nothing, or only some idle motions weigh."""
    record, metre = asked.record, METRES[asked.record.unit]
    pivots = graph_pivots(record)
    heavy = None if pivots is None else weighs(record, asked.known)
    if pivots is None or heavy is None:
        return None
    bodies = {link: _numbers(body, metre) for link, body in asked.known.carried(record.platform.link).items()}
    lengths = np.array([item.kind == "length" for item in record.coordinates])
    driven, units = rotors(record) / np.where(lengths, 1.0, metre**2), joint_units(record)
    gravity = asked.known.gravity / metre * asked.load.gravity
    question = InverseDynamics(
        pose=record.platform.pose,
        loops=pivots.loops,
        held=pivots.held,
        idle=pivots.idle,
        drives=tuple((item.coordinate.index, item.sign) for item in record.drives),
        bodies=tuple((link, _places(numbers)) for link, numbers in bodies.items() if numbers.any()),
        rotors=_places(driven),
        units=_places(units - 1.0),
        gravity=_places(gravity),
        loaded=bool(np.any(asked.load.force) or np.any(asked.load.moment)),
        moving=asked.moves,
        heavy=heavy,
    )
    same = [bodies[link][list(places)] for link, places in question.bodies]
    same += [driven[list(question.rotors)], units[list(question.units)], gravity[list(question.gravity)]]
    return Batch(record, question, np.concatenate(same))


def _numbers(body: RigidBody, metre: float) -> FloatArray:
    """The ten numbers of a body, in kg and the mechanism's unit."""
    own = body.inertia / metre**2
    return np.array([body.mass, *body.centre / metre, *np.diag(own), own[0, 1], own[0, 2], own[1, 2]])


def _places(numbers: FloatArray) -> tuple[int, ...]:
    return tuple(np.flatnonzero(numbers).tolist())


def _inverse(driven: FloatArray) -> FloatArray:
    """Inverses (N, k, d), of more drives than rates the least; NaN of matrices that have none."""
    square = driven.shape[1] == driven.shape[2]
    own = driven if square else np.swapaxes(driven, -1, -2) @ driven
    size = np.linalg.det(own)
    own = np.where((np.isfinite(size) & (size != 0.0))[:, None, None], own, np.nan)
    inverse = np.linalg.inv(np.where(np.isnan(own), np.eye(own.shape[1]), own)) + 0.0 * own
    return np.asarray(inverse if square else inverse @ np.swapaxes(driven, -1, -2))
