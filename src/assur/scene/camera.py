"""Cameras: parallel projections of space on paper. Every line of a drawing is straight, and parallels stay parallel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
AXES = {"x": np.array([1.0, 0.0, 0.0]), "y": np.array([0.0, 1.0, 0.0]), "z": np.array([0.0, 0.0, 1.0])}


@dataclass(frozen=True, eq=False)
class Camera:
    """A parallel projection.

    Attributes:
        image: (2, 3), its columns are the images of the unit vectors X, Y, Z on paper.
        toward: (3,) unit vector towards the reader, the direction that the projection forgets.
        front: (3,) unit normal of the plane that is seen in true shape.
    """

    image: FloatArray
    toward: FloatArray
    front: FloatArray

    def project(self, points: FloatArray) -> FloatArray:
        """Points (..., 3) on paper (..., 2), in the same unit."""
        flat: FloatArray = np.asarray(points, dtype=float) @ self.image.T
        return flat

    def depth(self, points: FloatArray) -> FloatArray:
        """How near to the reader points (..., 3) are; the largest is nearest."""
        near: FloatArray = np.asarray(points, dtype=float) @ self.toward
        return near


def orthographic(azimuth: float, elevation: float) -> Camera:
    """The reader looks from far away, from an azimuth about Z (0 is from +X) and an elevation, both in degrees.

    >>> orthographic(0, 90).project(np.array([[0.0, 2.0, 5.0]])).round(12)
    array([[2., 0.]])
    """
    a, e = np.radians(azimuth), np.radians(elevation)
    toward = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    return Camera(np.stack([right, np.cross(toward, right)]), toward, toward)


def oblique(right: str, up: str, angle: float, scale: float) -> Camera:
    """The plane of two axes in true shape; the third comes out of it at an angle in degrees, shortened by a scale.

    The third axis is right x up, so that X, Y, Z stay right-handed; an angle of 215 points down to the left.

    >>> oblique("y", "z", 180, 0.5).project(np.array([[2.0, 3.0, 4.0]])).round(12)
    array([[2., 4.]])
    """
    across, upward = AXES[right], AXES[up]
    out = np.cross(across, upward)
    slope = scale * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    image = np.stack([across, upward]) + slope[:, None] * out
    toward = out - slope[0] * across - slope[1] * upward
    return Camera(image, toward / np.linalg.norm(toward), out)


def plane(right: str, up: str) -> Camera:
    """The plane of two axes, seen at a right angle.

    >>> plane("x", "z").project(np.array([1.0, 2.0, 3.0]))
    array([1., 3.])
    """
    across, upward = AXES[right], AXES[up]
    out = np.cross(across, upward)
    return Camera(np.stack([across, upward]), out, out)
