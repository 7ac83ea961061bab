"""The motion that is required of a platform: translations and rotations along fixed directions of the base."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.numerics.rotations import about_axis
from assur.topology.directions import NAMED, Vector
from assur.topology.poc import PocSet

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class RequiredMotion:
    """A POC set to be reached, all of it independent and permanent.

    Attributes:
        name: how it is asked for, "3T1R".
        translations: orthonormal directions of the t part, in the base frame.
        rotations: directions of the r part, in the base frame.
        axis: the direction that the motion singles out, None where it has no preferred one.
    """

    name: str
    translations: tuple[Vector, ...]
    rotations: tuple[Vector, ...] = ()
    axis: Vector | None = None

    @property
    def dim(self) -> int:
        """Independent elements: freedoms of the platform, and limbs with one actuator each."""
        return len(self.translations) + len(self.rotations)

    @property
    def marks(self) -> tuple[tuple[Vector, ...], tuple[Vector, ...]]:
        """Directions that it singles out in the base and in the platform."""
        single = () if self.axis is None else (self.axis,)
        return single, single

    @property
    def poc(self) -> PocSet:
        """The numbers of its POC set."""
        return PocSet(len(self.translations), len(self.rotations), self.dim)

    @property
    def twists(self) -> FloatArray:
        """Basis (6, dim) of the platform's twists (omega, v): the same space at every point, as T holds what R adds."""
        columns = [(*direction, 0.0, 0.0, 0.0) for direction in self.rotations]
        columns += [(0.0, 0.0, 0.0, *direction) for direction in self.translations]
        return np.array(columns).T

    def orientations(self, angles: FloatArray) -> FloatArray:
        """Rotations (N, 3, 3) of the platform by angles (N,) in rad about its axes; identities where it has none.

        About a second and a third axis it turns by the same angles in another order.
        """
        turned: FloatArray = np.broadcast_to(np.eye(3), (len(angles), 3, 3))
        for place, axis in enumerate(self.rotations):
            turned = turned @ about_axis(np.array(axis), np.roll(angles, place))
        return turned


_X, _Y, _Z = NAMED["x"], NAMED["y"], NAMED["z"]

MOTIONS = {
    motion.name: motion
    for motion in (
        RequiredMotion("3T", (_X, _Y, _Z)),
        RequiredMotion("3T1R", (_X, _Y, _Z), (_Z,), _Z),
        RequiredMotion("2T1R", (_X, _Y), (_Z,), _Z),
        RequiredMotion("3T3R", (_X, _Y, _Z), (_X, _Y, _Z)),
    )
}
"""Motions that can be asked for; what singles out a direction has it along z."""

PARASITIC = {
    motion.name: motion
    for motion in (
        RequiredMotion("1T2R", (_Z,), (_X, _Y), _Z),
        RequiredMotion("2R", (), (_X, _Y), _Z),
        RequiredMotion("1T3R", (_Z,), (_X, _Y, _Z), _Z),
        RequiredMotion("2T3R", (_X, _Y), (_X, _Y, _Z), _Z),
    )
}
"""Motions at home, where others come with them as soon as it is left; translations are across or along z."""


def motion_named(name: str, among: Mapping[str, RequiredMotion] = MOTIONS) -> RequiredMotion:
    """The motion of a name, upper or lower case.

    >>> motion_named("3T").dim
    3
    """
    motion = among.get(name.strip().upper())
    if motion is None:
        hint = "T counts translations, R rotations: 3T is three translations without rotation"
        raise UnknownNameError("motion", name, among, hint=hint)
    return motion
