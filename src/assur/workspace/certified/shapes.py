"""Shapes about a point that grow with a number, their size: how large one is when it first touches a box or a point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.pose import is_angle
from assur.numerics.intervals import rounding
from assur.workspace.certified.boxes import Boxes

FloatArray = NDArray[np.float64]
ShapeName = Literal["cube", "cylinder", "ball"]


@dataclass(frozen=True)
class Shape:
    """A shape about a centre.

    The size is the edge of the cube (a square in a plane), the diameter of the cylinder, which stands along the last
    coordinate and is `ratio` times as high as wide, or that of the ball (a disc in a plane).

    >>> cube = Shape("cube", ("x", "y"), (0.0, 0.0))
    >>> float(cube.size(np.array([[1.0], [3.0]]))[0])
    6.0
    """

    name: ShapeName
    names: tuple[str, ...]
    centre: tuple[float, ...]
    ratio: float = 1.0

    def size(self, points: FloatArray) -> FloatArray:
        """Sizes (N,) at which it reaches points (k, N)."""
        return self._size(np.abs(points - np.array(self.centre)[:, None]))

    def touching(self, boxes: Boxes) -> FloatArray:
        """Lower bounds (N,) of the sizes at which it reaches boxes."""
        centre = np.array(self.centre)[:, None]
        apart = np.maximum(np.maximum(boxes.low - centre, centre - boxes.high), 0.0)
        return np.maximum(self._size(rounding.down_sum(apart)) * (1 - 1e-14), 0.0)

    def around(self, size: float) -> tuple[FloatArray, FloatArray]:
        """Low and high (k,) of a box that holds the shape of a size."""
        half = np.full(len(self.names), 0.5 * size)
        if self.name == "cylinder":
            half[-1] *= self.ratio
        half *= 1 + 1e-12
        return np.array(self.centre) - half, np.array(self.centre) + half

    def _size(self, apart: FloatArray) -> FloatArray:
        if self.name == "cube":
            return np.asarray(2 * np.max(apart, axis=0))
        if self.name == "ball":
            return np.asarray(2 * np.sqrt(np.sum(apart * apart, axis=0)))
        across = np.sqrt(np.sum(apart[:-1] * apart[:-1], axis=0))
        return np.asarray(2 * np.maximum(across, apart[-1] / self.ratio))


def shape_about(
    name: ShapeName, free: Sequence[str], centre: Mapping[str, float] | Sequence[float], ratio: float = 1.0
) -> Shape:
    """The shape about a point given in the order of the free coordinates, or by name.

    Errors:
        UsageError: a coordinate that is an angle, one too many or too few, a ratio that is not positive.
    """
    turning = [item for item in free if is_angle(item)]
    if turning:
        raise UsageError(f"a {name} has no extent along {', '.join(turning)}", hint=f"hold {turning[0]}")
    if name == "cylinder" and len(free) != 3:
        raise UsageError(f"a cylinder needs three lengths; {', '.join(free)} vary")
    if not (ratio > 0 and np.isfinite(ratio)):
        raise UsageError(f"ratio: {ratio!r} is not positive", hint="height over diameter, as 0.5")
    if not isinstance(centre, Mapping):
        if len(centre) != len(free):
            raise UsageError(f"centre: {len(centre)} values for {', '.join(free)}")
        centre = dict(zip(free, centre, strict=True))
    if set(centre) != set(free):
        raise UsageError(f"centre: {', '.join(centre) or 'nothing'} given; {', '.join(free)} wanted")
    values = tuple(float(centre[item]) for item in free)
    if not np.all(np.isfinite(values)):
        raise UsageError("centre: a value is not finite")
    return Shape(name, tuple(free), values, float(ratio))
