"""How all joints move where the platform moves as given: rates and accelerations that keep every loop closed.

Motions that neither inputs nor platform feel, as the spin of a rod between ball joints, take part as they are driven by
inertia alone: with the least kinetic energy.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.pose import platform_frame, twist_rates
from assur.kinematics.rates.acceleration import angle_accelerations
from assur.kinematics.rates.motions import SINGULAR, general, general_share
from assur.kinematics.turns import joint_units
from assur.kinematics.validation.check import METRES
from assur.machine.motion.inertia import LinkInertia
from assur.machine.motion.screws import paths, rate_units, screw_rates
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, rate_names

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
ROUNDED = 1e-14
"""A rate that all joints together make no larger than this share of the largest is rounding."""
MASSLESS = 1e-12
"""A freedom whose inertia is below this share of the largest has none: the spin of a slender rod."""
ALIKE = 1e-9
"""Share of all masses times characteristic lengths, and their squares, below which a change is rounding."""


@dataclass(frozen=True, eq=False)
class ClosedMotion:
    """Motions of N configurations that keep the loops closed, in SI units.

    Attributes:
        inertia: the links.
        point: (N, 3) the platform's.
        rotation: (N, 3, 3) the platform's.
        closure: (N, 6 v, n) twists around the loops at the platform's point, in characteristic lengths.
        inverse: (N, n, 6 v) its pseudo-inverse.
        free: (N, n, n) its null space; columns that are none are zero.
        pose: (N, k, n) rates of the pose per joint rate.
        drives: (d, n) rates of the printed inputs per joint rate.
    """

    inertia: LinkInertia
    point: FloatArray
    rotation: FloatArray
    closure: FloatArray
    inverse: FloatArray
    free: FloatArray
    pose: FloatArray
    drives: FloatArray

    @property
    def record(self) -> MechanismRecord:
        """The mechanism."""
        return self.inertia.record

    @cached_property
    def _split(self) -> tuple[FloatArray, FloatArray]:
        """Motions (N, n, k) for each rate of the pose, and those (N, n, ·) that leave the pose as it is."""
        return _pseudo_inverse(self.pose, self.free, pose_units(self.record), int(general(self.record).pose))

    @cached_property
    def idle(self) -> FloatArray:
        """Motions (N, n, ·) that leave every input as it is, spins among them; columns that are none are zero."""
        return _pseudo_inverse(self.drives, self.free, drive_units(self.record), int(general(self.record).inputs))[1]

    @cached_property
    def of_pose(self) -> FloatArray:
        """Joint rates (N, n, k) per rate of the pose."""
        along, still = self._split
        return along + self._carried(still, -(self.inertia.matrix @ along))

    def _carried(self, still: FloatArray, needed: FloatArray) -> FloatArray:
        """How motions (N, n, ·) that nothing drives answer to forces (N, n, ·)."""
        across = np.swapaxes(still, -1, -2)
        own = across @ self.inertia.matrix @ still
        sizes, vectors = np.linalg.eigh(own)
        kept = sizes > MASSLESS * self._largest[:, None]
        moved = np.swapaxes(vectors, -1, -2) @ (across @ needed)
        moved *= np.where(kept, 1.0 / np.where(kept, sizes, 1.0), 0.0)[..., None]
        return np.asarray(still @ (vectors @ moved))

    @cached_property
    def _largest(self) -> FloatArray:
        """A bound (N,) of the inertia of free motions."""
        own = np.swapaxes(self.free, -1, -2) @ self.inertia.matrix @ self.free
        return np.asarray(np.trace(own, axis1=-2, axis2=-1))

    @cached_property
    def weighing(self) -> NDArray[np.intp]:
        """How many (N,) of the motions that leave the pose as it is have inertia."""
        still = self._split[1]
        sizes = np.linalg.eigvalsh(np.swapaxes(still, -1, -2) @ self.inertia.matrix @ still)
        return np.asarray(np.sum(sizes > MASSLESS * self._largest[:, None], axis=-1))

    def idle_accelerations(self, needed: FloatArray) -> FloatArray:
        """How idle motions speed up (N, n) where forces (N, n) would be needed that nothing exerts."""
        return -self._carried(self.idle, needed[..., None])[..., 0]

    @property
    def swings(self) -> bool:
        """Whether a link is not the same in space while it moves as nothing drives it: beside its axis, not round."""
        inertia, idle = self.inertia, self.idle[:, None]
        if not idle.shape[-1]:
            return False
        moved = inertia.masses[:, None, None] * (inertia.moving @ idle)
        turning = np.swapaxes(inertia.turning @ idle, -1, -2)[..., None, :]  # (N, L, ·, 1, 3)
        half = np.cross(turning, inertia.tensors[:, :, None])  # row for row: the transpose of w x T, as T is symmetric
        turned = half + np.swapaxes(half, -1, -2)
        size = float(inertia.masses.sum()) * self.length
        return bool(np.abs(moved).max() > ALIKE * size or np.abs(turned).max() > ALIKE * size * self.length)

    def rates(self, velocity: FloatArray) -> FloatArray:
        """Joint rates (N, n) at rates (N, k) of the pose."""
        return np.asarray((self.of_pose @ velocity[..., None])[..., 0])

    def along(self, velocity: FloatArray) -> FloatArray:
        """Joint rates (N, n), least by their size, at rates (N, k) of the pose."""
        return np.asarray((self._split[0] @ velocity[..., None])[..., 0])

    def second(self, rates: FloatArray, acceleration: FloatArray) -> FloatArray:
        """Joint accelerations (N, n) at joint rates (N, n), for accelerations (N, k) of the pose."""
        changes = screw_rates(self.record, self.inertia.screws, rates)  # (N, n, 6)
        loops = np.einsum("lj,njk->nlk", paths(self.record).of_loops, changes)
        bias = at_point(loops.swapaxes(-1, -2), self.point, self.length).swapaxes(-1, -2)
        own = -(self.inverse @ bias.reshape(len(rates), -1, 1))[..., 0]
        missing = acceleration - self.pose_bias(rates, changes) - (self.pose @ own[..., None])[..., 0]
        return own + self.along(missing)

    def pose_bias(self, rates: FloatArray, changes: FloatArray) -> FloatArray:
        """Accelerations (N, k) of the pose at joint rates (N, n) that stay as they are."""
        signs = _platform_signs(self.record)
        twist = np.einsum("nkj,nj->nk", self.inertia.screws, signs * rates)
        change = np.einsum("j,njk->nk", signs, changes)
        speed = twist[:, 3:] + np.cross(twist[:, :3], self.point)
        moved = change[:, 3:] + np.cross(change[:, :3], self.point) + np.cross(twist[:, :3], speed)
        named = dict(zip(("wx", "wy", "wz", *LENGTHS), np.concatenate([change[:, :3], moved], axis=1).T, strict=True))
        if any(name in ANGLES for name in self.record.platform.pose):
            named |= zip(ANGLES, angle_accelerations(self.rotation, twist[:, :3], change[:, :3]), strict=True)
        return np.stack([named[name] for name in rate_names(self.record.platform.pose)], axis=-1)

    @property
    def length(self) -> float:
        """The characteristic length in m."""
        return METRES[self.record.unit] * characteristic_length(self.record)

    @cached_property
    def platform(self) -> FloatArray:
        """Angular velocity and velocity (N, 6, n) of the platform's point per joint rate."""
        return at_point(self.inertia.screws * _platform_signs(self.record), self.point)


def closed_motion(inertia: LinkInertia, values: FloatArray) -> ClosedMotion:
    """The motions at joint values (N, n) that close the loops."""
    record = inertia.record
    metre = METRES[record.unit]
    rotation, origin = platform_frame(record, values)
    point, length = metre * origin, metre * characteristic_length(record)
    loops = inertia.screws[:, None] * paths(record).of_loops[:, None]  # (N, v, 6, n)
    closure = at_point(loops, point[:, None], length).reshape(len(values), -1, values.shape[-1])
    scale = joint_scales_si(record)
    left, sizes, right = np.linalg.svd(closure * scale, full_matrices=True)
    kept = sizes > SINGULAR * general_share(record) * sizes[:, :1]
    count = sizes.shape[-1]
    reciprocal = np.where(kept, 1.0 / np.where(kept, sizes, 1.0), 0.0)
    across = np.swapaxes(right, -1, -2)
    inverse = (across[..., :count] * reciprocal[:, None]) @ np.swapaxes(left[..., :count], -1, -2)
    rank = kept.sum(axis=-1)
    free = across * (np.arange(values.shape[-1]) >= rank[:, None])[:, None]
    platform = at_point(inertia.screws * _platform_signs(record), point)
    drives = np.zeros((len(record.drives), values.shape[-1]))
    for row, item in enumerate(record.drives):
        drives[row, item.coordinate.index] = item.sign
    return ClosedMotion(
        inertia=inertia,
        point=point,
        rotation=rotation,
        closure=closure,
        inverse=scale[:, None] * inverse,
        free=scale[:, None] * free,
        pose=twist_rates(record.platform.pose, rotation, platform),
        drives=drives,
    )


def at_point(twists: FloatArray, point: FloatArray, length: float = 1.0) -> FloatArray:
    """Twists (..., 6, n) at points (..., 3), velocities over a length."""
    moved = twists.copy()
    moved[..., 3:, :] += np.cross(twists[..., :3, :], point[..., None], axis=-2)
    moved[..., 3:, :] /= length
    return moved


def joint_scales_si(record: MechanismRecord) -> FloatArray:
    """What a joint rate (n,) is divided by to be a number: the characteristic length, 1, or a screw's turns for it."""
    return joint_units(record) * rate_units(record)


def pose_units(record: MechanismRecord) -> FloatArray:
    """The same for rates (k,) of the pose."""
    length = METRES[record.unit] * characteristic_length(record)
    return np.array([length if name in LENGTHS else 1.0 for name in rate_names(record.platform.pose)])


def drive_units(record: MechanismRecord) -> FloatArray:
    """The same for rates (d,) of the inputs."""
    return joint_scales_si(record)[[item.coordinate.index for item in record.drives]]


def _platform_signs(record: MechanismRecord) -> FloatArray:
    own = paths(record)
    return np.asarray(own.of_links[own.links.index(record.platform.link)])


def _pseudo_inverse(rates: FloatArray, free: FloatArray, units: FloatArray, rank: int) -> tuple[FloatArray, FloatArray]:
    """Free motions (N, n, r) for each of r rates (N, r, n), and those (N, n, n - rank) that leave them as they are.

    How many rates are independent is what it is in general: near a singularity one is small, and counts all the same.
    """
    carried = rates @ free / units[:, None]
    left, sizes, right = np.linalg.svd(carried, full_matrices=True)
    kept = sizes[:, :rank] > ROUNDED * sizes[:, :1]
    across = np.swapaxes(right, -1, -2)
    reciprocal = np.where(kept, 1.0 / np.where(kept, sizes[:, :rank], 1.0), 0.0)
    inverse = (across[..., :rank] * reciprocal[:, None]) @ np.swapaxes(left[..., :rank], -1, -2)
    return free @ inverse / units, free @ across[..., rank:]
