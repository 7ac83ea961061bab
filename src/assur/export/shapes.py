"""What a body looks like: a ball at each joint centre, and a round arm from the mean of the centres to each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.export.bodies import THICKNESS, Bodies, Body

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Arm:
    """A round bar: its ends, (3,) each, in the body's frame in m."""

    start: FloatArray
    end: FloatArray

    @property
    def middle(self) -> FloatArray:
        """The point half-way (3,)."""
        return np.asarray((self.start + self.end) / 2)

    @property
    def length(self) -> float:
        """Its length in m."""
        return float(np.linalg.norm(self.end - self.start))

    @property
    def turn(self) -> FloatArray:
        """A rotation (3, 3) that takes the Z axis along it.

        >>> Arm(np.zeros(3), np.array([0.0, 2.0, 0.0])).turn.round(12)[:, 2] + 0.0
        array([0., 1., 0.])
        """
        along = (self.end - self.start) / self.length
        across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
        side = across / np.linalg.norm(across)
        return np.stack([np.cross(side, along), side, along], axis=1)


def radius(model: Bodies) -> float:
    """Radius of every ball and arm, in m."""
    return THICKNESS * model.size


def arms(body: Body, model: Bodies) -> list[Arm]:
    """The arms of a body; none for the base, and none that its balls would hide."""
    found = [Arm(body.centre, centre) for centre in body.centres] if body.parent else []
    return [arm for arm in found if arm.length > radius(model)]
