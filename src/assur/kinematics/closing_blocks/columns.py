"""Columns: the screws of all joints, and of what a pose leaves free of the platform, seen from any link."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame, frames, screws
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closing_blocks.by_name import sorted_by_name
from assur.kinematics.closure import RANK_GAP, Assembly, assemble
from assur.kinematics.home import home_values
from assur.kinematics.pose import whole_orientation
from assur.kinematics.rates.motions import general, general_share, motions
from assur.kinematics.related import closed_as_related
from assur.kinematics.starts import by_chance
from assur.kinematics.still import otherwise
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, rate_names
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
STARTS, AROUND = 64, 0.05
"""Assemblies that are looked at: so many starts by chance, and as many around home, by this share of the way."""

TO_ALL_DIGITS = 1e-11
"""Share of the characteristic length within which loops close: where they only do so to `CLOSED`, after many steps, two
roots nearly meet, and what the loops keep parallel is so to half of the digits."""

NEAR_SINGULAR = 1e-3
"""Share of what the least singular value of the closure is around home, below which an assembly is nearly singular."""

FEW = 12
"""Assemblies that tell already of most blocks that their screws span no one space."""
PARASITIC = 1e-6
"""Share of the largest singular value by which platforms' twists fill no further direction."""


@lru_cache(maxsize=64)
def assemblies_by_chance(record: MechanismRecord) -> FloatArray:
    """Assemblies (N, n), home first, from starts by chance and from starts around home.

    They are in any working and assembly mode, but what stands still about home stands as there: a Delta robot whose
    platform is turned is another mechanism. Nor is it the mechanism where there are fewer freedoms than inputs: loops
    that move by their special dimensions, as Bricard's, may close elsewhere and be rigid. Beside home, singular ones
    are left out, which close to half of the digits, and those at which inputs or pose tell less than about home: there
    loops move otherwise, as two equal cranks do that stand on one centre.

    >>> from assur.model.registry import load_record
    >>> len(assemblies_by_chance(load_record("fivebar"))) > 100
    True
    """
    home, rng = home_values(record), np.random.default_rng(0)
    far = by_chance(record, STARTS, rng)
    near = home + AROUND * (by_chance(record, STARTS, rng) - home)
    values = _sound(record, home[None], assemble(record, np.concatenate([near, far]), far=True))
    if len(values) < len(near) + STARTS // 2:  # loops seldom close as about home
        values = _sound(record, values, closed_as_related(record, far))
    return values


def _sound(record: MechanismRecord, known: FloatArray, closed: Assembly) -> FloatArray:
    """Known assemblies (K, n), home first, and those that close to all digits, are regular and as about home."""
    sound = closed.residual <= TO_ALL_DIGITS * characteristic_length(record)
    values = np.concatenate([known, closed.values[sound]])
    usual, at = general(record), motions(record, values, RANK_GAP)
    least, ranks = at.values[:, int(usual.closure) - 1] / at.values[:, 0], at.ranks
    regular = least > NEAR_SINGULAR * general_share(record)
    moving = ranks.freedoms >= len(record.inputs)
    regular &= (ranks.inputs >= usual.inputs) & (ranks.pose >= usual.pose)
    regular[0] = True
    alike = np.array([not other for other in otherwise(record, values)], dtype=bool)
    return np.asarray(values[regular & moving & alike])


@lru_cache(maxsize=64)
def open_freedoms(record: MechanismRecord) -> tuple[str, ...]:
    """Coordinates of the platform that the pose does not tell; none where the limbs hold what it does not tell.

    >>> from assur.model.registry import load_record
    >>> open_freedoms(load_record("zeng2019")), open_freedoms(load_record("three_rps"))
    ((), ('x', 'y', 'phi'))
    """
    angles = () if whole_orientation(record.platform.pose) else ANGLES
    untold = tuple(name for name in (*LENGTHS, *angles) if name not in record.platform.pose)
    ordered = sorted_by_name(record)  # whose assemblies are known where modes are named
    moving = motions(ordered, assemblies_by_chance(ordered), RANK_GAP).twists
    spread = np.linalg.svd(np.concatenate([*moving], axis=1), compute_uv=False)
    moved = int(np.sum(spread > PARASITIC * spread[0]))
    return untold if moved > len(rate_names(record.platform.pose)) else ()


@dataclass(frozen=True, eq=False)
class ScrewColumns:
    """Screws of a mechanism at joint values (N, n).

    Columns are the joint coordinates, then what the pose leaves free of the platform. Velocities count in
    characteristic lengths. A ball joint's are rotations about the base's axes through its centre, which have the same
    orientation everywhere.

    Attributes:
        record: the mechanism.
        values: (N, n) joint values.
        platform: whether the platform's are there; to know which it has costs assemblies by chance.
    """

    record: MechanismRecord
    values: FloatArray
    platform: bool = True

    @cached_property
    def few(self) -> ScrewColumns:
        """The first of these assemblies."""
        return self if len(self.values) <= FEW else ScrewColumns(self.record, self.values[:FEW], self.platform)

    def rows(self, own: NDArray[np.bool_]) -> ScrewColumns:
        """Those of some of the assemblies (N,), with the shares that are known of them."""
        part = ScrewColumns(self.record, self.values[own], self.platform)
        part.shares.update({sign: values[own] for sign, values in self.shares.items()})
        return part

    @classmethod
    def together(cls, parts: Sequence[ScrewColumns]) -> ScrewColumns:
        """Those of the assemblies of several, with the shares that are known of all."""
        whole = cls(parts[0].record, np.concatenate([part.values for part in parts]))
        known = [sign for sign in parts[0].shares if all(sign in part.shares for part in parts)]
        whole.shares.update({sign: np.concatenate([part.shares[sign] for part in parts]) for sign in known})
        return whole

    @cached_property
    def in_base(self) -> FloatArray:
        """The columns (N, 6, c) in the base frame: angular velocity, velocity at the base's origin."""
        columns = screws(self.record, self.values)
        for place in joint_graph(self.record).turns:
            columns[:, :3, place] = np.eye(3)
            columns[:, 3:, place] = _about(self.centre(self.record.coordinates[place.start].joint))
        columns[:, 3:] /= characteristic_length(self.record)
        return np.concatenate([columns, self._platform(self._open_names)], axis=2)

    def seen_from(self, link: str) -> FloatArray:
        """The columns (N, 6, c) in the frame of a link."""
        if link == self.record.base:
            return self.in_base
        if link not in self._seen:
            rotation, origin = self._frames[link]
            turned = np.swapaxes(np.broadcast_to(rotation, (len(self.values), 3, 3)), -1, -2)
            shift = np.broadcast_to(origin / characteristic_length(self.record), (len(self.values), 3))
            angular, velocity = self.in_base[:, :3], self.in_base[:, 3:]
            moved = velocity - _about(shift) @ angular
            self._seen[link] = np.concatenate([turned @ angular, turned @ moved], axis=1)
        return self._seen[link]

    @cached_property
    def motions(self) -> FloatArray:
        """Motions (N, c, F) of the mechanism as rates of the columns."""
        record, count = self.record, len(self.record.coordinates)
        owners = [item.joint for item in record.coordinates]
        graph = joint_graph(record)
        joints = self.in_base[:, :, :count]
        loops = [{cut.name: 1, **loop} for cut, loop in zip(graph.cut, graph.loops, strict=True)]
        rows = [joints * [loop.get(name, 0) for name in owners] for loop in loops]
        _, sizes, right = np.linalg.svd(np.concatenate(rows, axis=1))
        rank = int(np.max(np.sum(sizes > RANK_GAP * sizes[:, :1], axis=1)))
        rates = np.swapaxes(right[:, rank:], -1, -2)
        twists = joints * [graph.paths[graph.platform].get(name, 0) for name in owners] @ rates
        names = [*LENGTHS, *ANGLES] if self._open_names else []
        told = np.linalg.pinv(self._platform(names)) @ twists
        return np.concatenate([rates, told[:, [names.index(name) for name in self._open_names]]], axis=1)

    def centre(self, name: str) -> FloatArray:
        """Point (N, 3) of a joint on its parent link, in the base frame."""
        joint = self.record.joints[name]
        rotation, origin = self._frames[joint.parent]
        return np.broadcast_to(rotation @ joint.at + origin, (len(self.values), 3))

    def axis(self, name: str) -> FloatArray:
        """First axis (N, 3) of a joint, in the base frame."""
        joint = self.record.joints[name]
        return np.broadcast_to(self._frames[joint.parent][0] @ joint.axes[0], (len(self.values), 3))

    def frame(self, link: str) -> Frame:
        """Orientation (N, 3, 3) and origin (N, 3) of a link."""
        rotation, origin = self._frames[link]
        count = len(self.values)
        return np.broadcast_to(rotation, (count, 3, 3)), np.broadcast_to(origin, (count, 3))

    @cached_property
    def _frames(self) -> dict[str, Frame]:
        return frames(self.record, self.values)

    @cached_property
    def widths(self) -> dict[tuple[tuple[str, ...], tuple[int, ...]], Mapping[str, int]]:
        """Loop, columns -> dimension of the space that these span seen from each link, of those that were asked for."""
        return {}

    @cached_property
    def signs(self) -> dict[object, Any]:
        """Block and rates -> its sign, or None, of those that were asked for."""
        return {}

    @cached_property
    def spins(self) -> dict[object, FloatArray]:
        """Spin -> its rates (N, c), of those that were asked for."""
        return {}

    @cached_property
    def shares(self) -> dict[object, FloatArray]:
        """Sign -> its values (N,) as shares, of those that were asked for."""
        return {}

    @cached_property
    def _seen(self) -> dict[str, FloatArray]:
        return {}

    @property
    def _open_names(self) -> tuple[str, ...]:
        """Coordinates of the platform that the pose leaves free."""
        return open_freedoms(self.record) if self.platform else ()

    def _platform(self, names: Sequence[str]) -> FloatArray:
        """Screws (N, 6, k) of coordinates of the platform, in characteristic lengths."""
        if not names:
            return np.zeros((len(self.values), 6, 0))
        rotation, origin = self._frames[self.record.platform.link]
        rotation = np.broadcast_to(rotation, (len(self.values), 3, 3))
        point = rotation @ self.record.platform.point + origin
        columns = np.zeros((len(self.values), 6, len(names)))
        about = _about(point)
        axes = _angle_axes(self.record, rotation)
        for k, name in enumerate(names):
            if name in LENGTHS:
                columns[:, 3 + LENGTHS.index(name), k] = 1.0
            else:
                axis = axes[:, :, ANGLES.index(name)]
                columns[:, :3, k] = axis
                columns[:, 3:, k] = np.einsum("nij,nj->ni", about, axis)
        columns[:, 3:] /= characteristic_length(self.record)
        return columns


def _about(point: FloatArray) -> FloatArray:
    """Velocities (N, 3, 3) at the base's origin of unit rotations about the base's axes through points (N, 3)."""
    return np.swapaxes(rotations.cross(point[:, None, :], np.eye(3)), -1, -2)


def _angle_axes(record: MechanismRecord, rotation: FloatArray) -> FloatArray:
    """Axes (N, 3, 3), as columns, about which phi, theta and psi turn; the base's where the pose tells none of them."""
    if not {*ANGLES} & {*record.platform.pose}:
        return np.broadcast_to(np.eye(3), rotation.shape)
    phi, theta, _ = rotations.to_angles(rotation)
    zero = np.zeros_like(phi)
    across = np.stack([-np.sin(phi), np.cos(phi), zero], axis=-1)
    last = np.stack([np.cos(phi) * np.cos(theta), np.sin(phi) * np.cos(theta), -np.sin(theta)], axis=-1)
    return np.stack([np.broadcast_to([0.0, 0.0, 1.0], across.shape), across, last], axis=-1)
