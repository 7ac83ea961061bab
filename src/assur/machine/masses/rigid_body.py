"""A rigid body: its mass, its centre and its inertia in the frame of its link."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RigidBody:
    """A mass in kg, its centre (3,) in the link's frame in m, its inertia (3, 3) about it in the link's axes in kg m2.

    `source` says where these come from.
    """

    mass: float
    centre: FloatArray
    inertia: FloatArray
    source: str

    def with_body(self, other: RigidBody) -> RigidBody:
        """Both as one."""
        mass = self.mass + other.mass
        if mass == 0.0:
            return self
        centre = (self.mass * self.centre + other.mass * other.centre) / mass
        inertia = self._about(centre) + other._about(centre)
        return RigidBody(mass, centre, inertia, f"{self.source}; {other.source}")

    def _about(self, point: FloatArray) -> FloatArray:
        return self.inertia + self.mass * spread(self.centre - point)


def spread(vector: FloatArray) -> FloatArray:
    """The tensor (3, 3) of a point of 1 kg at a vector (3,)."""
    return float(vector @ vector) * np.eye(3) - np.outer(vector, vector)
