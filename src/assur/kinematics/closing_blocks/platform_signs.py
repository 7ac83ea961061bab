"""Signs of the platform's place: its operation mode, which way its axes point, on which side of a hinge it lies.

Limbs that hold a platform to fewer than six coordinates often do so in several operation modes. As a polynomial of the
orientation their condition is a product then, of which no block is a factor. Where the quaternions of all assemblies
fill two linear spaces, home's and another, a path from one into the other leads through both at once, and there the
closure loses rank. Where no such product is seen, what could be zero at singularities alone is tried: ways across it
are halved, and the smallest singular value of the whole closure must fall to nothing with it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.kinematics.closing_blocks.spaces import span
from assur.kinematics.closing_blocks.strokes import with_zero
from assur.kinematics.closure import RANK_GAP, assemble
from assur.kinematics.configurations import places
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.rates.motions import general, motions
from assur.kinematics.still import assemblies_about_home
from assur.numerics.rotations import to_quaternion

FloatArray = NDArray[np.float64]
SignArray = NDArray[np.int8]
NEAR_HOME = 24
"""Assemblies about home whose quaternions span the space of home's operation mode."""

SAME, APART = 1e-6, 1e-3
"""How far a quaternion in a space is from it at most, and one in another space from it at least."""

PAIRS, HALVINGS, LOST = 6, 16, 0.02
"""Ways across a side that are halved, how often, and the share of its usual value that the smallest singular value then
has at most: 16 halvings leave some 1e-5 of a way, on which it falls to nothing about evenly."""


BESIDE = 0.05
"""Share of what a side is at home below which an assembly is so near to its end that it cannot be more regular than
half of all are."""

SLANT = 0.1
"""Cosine at home below which axes are nearly square to each other, and point no way."""


@dataclass(frozen=True, eq=False)
class OperationSign:
    """In which of two operation modes the platform stands: + in that of home.

    Attributes:
        home: (3, 3) the platform's orientation at home; quaternions turn it from there, in the base frame.
        form: (4, 4) what it is as a quadratic form of these: 1 at home, 0 where the modes meet.
        axes: (3, k) directions that no axis of such a turn has a part of in home's mode, orthonormal.
    """

    home: FloatArray
    form: FloatArray
    axes: FloatArray

    @property
    def joints(self) -> tuple[str, ...]:
        """None of them alone."""
        return ()

    @property
    def meaning(self) -> str:
        """What holds where it is +."""
        from assur.kinematics.validation.claims import axis_name  # which only who reads it needs

        if self.axes.shape[1] == 3:
            return "the platform is turned as at home"
        if self.axes.shape[1] == 2:
            along = axis_name(np.linalg.svd(self.axes)[0][:, 2:])
            return f"the platform is turned from home about {along} alone"
        return f"the platform is turned from home about a line square to {axis_name(self.axes)}"

    def shares(self, screws: ScrewColumns) -> FloatArray:
        """The form (N,): positive in home's mode, negative in the other one."""
        turn = _turns(screws, self.home)
        return np.asarray(np.einsum("ni,ij,nj->n", turn, self.form, turn))

    def signs(self, screws: ScrewColumns) -> SignArray:
        """Signs (N,); 0 where the modes meet."""
        return with_zero(self.shares(screws))


@dataclass(frozen=True, eq=False)
class ReachSign:
    """On which side of a hinge the platform's point lies, in the plane through the hinge's axis that turns with it.

    Attributes:
        hinge: a joint, whose first axis it is.
        direction: (3,) that of the plane across the axis, in the frame of the joint's child link; towards home's side.
        length: by which a distance is divided.
    """

    hinge: str
    direction: FloatArray
    length: float

    @property
    def joints(self) -> tuple[str, ...]:
        """The hinge."""
        return (self.hinge,)

    @property
    def meaning(self) -> str:
        """What holds where it is +."""
        return f"the platform's point lies on home's side of the axis of {self.hinge}, seen from the link behind it"

    def shares(self, screws: ScrewColumns) -> FloatArray:
        """Distances (N,) from the axis."""
        return np.asarray(_reach(screws, self.hinge) @ self.direction / self.length)

    def signs(self, screws: ScrewColumns) -> SignArray:
        """Signs (N,); 0 where the point lies on the axis."""
        return with_zero(self.shares(screws))


@dataclass(frozen=True, eq=False)
class FacingSign:
    """Which way an axis of the platform points.

    Attributes:
        row, column: axis of the base's frame, and of the platform's, of whose angle it is the cosine.
        home: the cosine at home.
    """

    row: int
    column: int
    home: float

    @property
    def joints(self) -> tuple[str, ...]:
        """None of them alone."""
        return ()

    @property
    def meaning(self) -> str:
        """What holds where it is +."""
        angle = "less" if self.home > 0.0 else "more"
        return f"the platform's {'xyz'[self.column]} axis is {angle} than 90 deg from {'xyz'[self.row]}"

    def shares(self, screws: ScrewColumns) -> FloatArray:
        """Cosines (N,) over that at home."""
        rotation, _ = screws.frame(screws.record.platform.link)
        return np.asarray(rotation[:, self.row, self.column] / self.home)

    def signs(self, screws: ScrewColumns) -> SignArray:
        """Signs (N,); 0 where the axes are square to each other."""
        return with_zero(self.shares(screws))


PlatformSign = OperationSign | ReachSign | FacingSign


def platform_signs(screws: ScrewColumns, problem: Problem) -> Iterator[PlatformSign]:
    """Those that a mechanism's assemblies, home first, have; sides name ways to reach a pose alone.

    >>> from assur.kinematics.closing_blocks.signs import screws_apart
    >>> from assur.model.registry import load_record
    >>> [sign.meaning for sign in platform_signs(screws_apart(load_record("fivebar")), "direct")]
    []
    """
    yield from _operation_signs(screws)
    if problem == "inverse":
        met = set[bytes]()
        sides: list[ReachSign | FacingSign] = [*_reach_signs(screws), *_facing_signs(screws)]
        for sign in sides:
            senses = sign.signs(screws).tobytes()
            if senses not in met and _ends_in_singularities(sign, screws):
                yield sign
            met.add(senses)


def _turns(screws: ScrewColumns, home: FloatArray) -> FloatArray:
    """Quaternions (N, 4) of the turns from home's orientation to the platform's, in the base frame."""
    rotation, _ = screws.frame(screws.record.platform.link)
    return to_quaternion(rotation @ home.T)


def _operation_signs(screws: ScrewColumns) -> Iterator[OperationSign]:
    record = screws.record
    values = np.concatenate([home_values(record)[None], assemblies_about_home(record, NEAR_HOME)])
    about = ScrewColumns(record, values, platform=False)
    home = about.frame(record.platform.link)[0][0]
    own, every = span(_turns(about, home)[:, :, None]), _turns(screws, home)
    off = np.linalg.norm(every - every @ own @ own.T, axis=1)
    far = off > APART
    if own.shape[1] == 4 or not np.any(far) or np.any((off > SAME) & ~far):
        return
    other = span(every[far][:, :, None])
    if other.shape[1] < 4:
        form = own @ own.T - other @ other.T
        yield OperationSign(home, form, np.linalg.svd(own)[0][1:, own.shape[1] :])


def _reach(screws: ScrewColumns, hinge: str) -> FloatArray:
    """From the hinge's axis square to it to the platform's point: (N, 3) in the frame of its child link."""
    record = screws.record
    joint = record.joints[hinge]
    rotation, origin = screws.frame(record.platform.link)
    way = rotation @ record.platform.point + origin - screws.centre(hinge)
    axis = screws.axis(hinge)
    across = way - np.einsum("ni,ni->n", way, axis)[:, None] * axis
    return np.asarray(np.einsum("nij,ni->nj", screws.frame(joint.child)[0], across))


def _reach_signs(screws: ScrewColumns) -> Iterator[ReachSign]:
    record, length = screws.record, characteristic_length(screws.record)
    for name, joint in record.joints.items():
        if joint.type.turns != 1 or joint.parent != record.base or joint.child == record.platform.link:
            continue
        reach = _reach(screws, name)
        plane = span(reach[:, :, None])
        if plane.shape[1] != 1 or np.ptp(np.linalg.norm(reach, axis=1)) < APART * length:
            continue
        direction = plane[:, 0] * np.sign(reach[0] @ plane[:, 0])
        if np.any(direction):
            yield ReachSign(name, direction, length)


def _facing_signs(screws: ScrewColumns) -> Iterator[FacingSign]:
    for row, column in product(range(3), repeat=2):
        home = float(FacingSign(row, column, 1.0).shares(screws)[0])
        if abs(home) > SLANT:
            yield FacingSign(row, column, home)


def _ends_in_singularities(sign: ReachSign | FacingSign, screws: ScrewColumns) -> bool:
    """Whether the closure with the pose held loses rank where the sign changes, on ways between near assemblies.

    A way on which it never is small leads to another branch half-way, and says nothing.
    """
    record, shares, where = screws.record, sign.shares(screws), places(screws.record, screws.values)
    least, usual = _least(screws), np.median(_least(screws))
    if np.any(least[np.abs(shares) < BESIDE] > usual):
        return False
    first, second = np.nonzero(np.triu(shares[:, None] * shares < 0.0))
    near = np.argsort(np.linalg.norm(where[first] - where[second], axis=1), kind="stable")[:PAIRS]
    low, high, begun = screws.values[first[near]], screws.values[second[near]], shares[first[near]]
    sound = np.ones(len(near), dtype=bool)
    for _ in range(HALVINGS):
        closed = assemble(record, 0.5 * (low + high), near=True)
        sound &= closed.closed
        onward = sign.shares(ScrewColumns(record, closed.values, platform=False)) * begun > 0.0
        low, high = np.where(onward[:, None], closed.values, low), np.where(onward[:, None], high, closed.values)
    ends = ScrewColumns(record, low[sound], platform=False)
    arrived = np.abs(sign.shares(ends)) < LOST * np.abs(begun[sound])
    lost = _least(ends)[arrived] / usual
    return len(lost) > PAIRS // 2 and bool(np.max(lost) < LOST)


def _least(screws: ScrewColumns) -> FloatArray:
    """The smallest singular value (N,) of what motions do to the pose."""
    motion = motions(screws.record, screws.values, RANK_GAP)
    return np.asarray(np.linalg.svd(motion.pose, compute_uv=False)[:, int(general(screws.record).pose) - 1])
