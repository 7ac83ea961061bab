"""Steps: the elementary motions that a joint is made of, over any number type.

A revolute is one turn, a cylindrical joint a slide and a turn along one axis, a universal joint two turns, a planar
joint two slides and a turn. A step moves the frame at the joint's point, by numbers without trigonometry: a length as
itself, an angle as its cosine and sine, a ball joint as a quaternion of any length. Its rates are twists.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.numerics.rotations import quaternion_rates
from assur.numerics.vectors import Matrix, Vector, minus, plus, scaled, times, transposed

FloatArray = NDArray[np.float64]
CoordinateKind = Literal["angle", "length"]
Motion = tuple[Matrix, Vector]
"""Turn (3, 3), and shift (3,), of the frame after a step in the frame before it."""
Twist = tuple[Vector, Vector]
"""Angular velocity, and velocity of the frame's origin, in the frame before a step, at unit rate."""

UNTURNED: Matrix = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
STILL: Vector = (0, 0, 0)


@dataclass(frozen=True)
class Step:
    """One elementary motion.

    Attributes:
        kind: what it is called.
        kinds: of its coordinates.
        numbers: names of the numbers that say where it stands.
        state: these numbers (k, ...) of joint values (c, ...), real or complex.
        changes: how fast the numbers (k, ...) change at rates (c, ...); a ball's are its angular velocity in the frame
            before the step.
        motion: turn and shift by them along a unit vector; a screw advances by a length per rad.
        twists: one for each coordinate; a ball's are given by a matrix, as its columns.
        direction: which of the joint's axes it is along.
    """

    kind: Literal["turn", "slide", "screw", "ball"]
    kinds: tuple[CoordinateKind, ...]
    numbers: tuple[str, ...]
    state: Callable[[Any], Any]
    changes: Callable[[Any, Any], Any]
    motion: Callable[[Vector, Any, tuple[Any, ...]], Motion]
    twists: Callable[[Vector, Any, Matrix], tuple[Twist, ...]]
    direction: int = 0

    def along(self, direction: int) -> Step:
        """The same along another of the joint's axes."""
        return replace(self, direction=direction)


def about(axis: Vector, cosine: Any, sine: Any) -> Matrix:
    """The turn about a unit vector, by Rodrigues' formula.

    >>> about((0, 0, 1), 0, 1)
    ((0, -1, 0), (1, 0, 0), (0, 0, 1))
    """
    x, y, z = axis
    own = [[times(a, b) for b in axis] for a in axis]
    across = ((0, minus(0, z), y), (z, 0, minus(0, x)), (minus(0, y), x, 0))

    def row(i: int) -> Vector:
        p, q, r = (
            plus(plus(own[i][j], times(cosine, minus(int(i == j), own[i][j]))), times(sine, across[i][j]))
            for j in range(3)
        )
        return p, q, r

    return row(0), row(1), row(2)


def of_quaternion(w: Any, x: Any, y: Any, z: Any) -> Matrix:
    """The rotation of a quaternion of any length.

    >>> of_quaternion(0.0, 0.0, 0.0, 2.0)
    ((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0))
    """
    twice = 2 / (w * w + x * x + y * y + z * z)
    a, b, c = twice * x, twice * y, twice * z
    return (
        (1 - (b * y + c * z), a * y - c * w, a * z + b * w),
        (a * y + c * w, 1 - (a * x + c * z), b * z - a * w),
        (a * z - b * w, b * z + a * w, 1 - (a * x + b * y)),
    )


def quaternions(vectors: FloatArray) -> FloatArray:
    """Unit quaternions (4, ...) of rotation vectors (3, ...).

    >>> quaternions(np.array([[0.0], [0.0], [np.pi]])).round(12).ravel() + 0.0
    array([0., 0., 0., 1.])
    """
    angle = np.sqrt(np.sum(vectors**2, axis=0))
    return np.concatenate([np.cos(0.5 * angle)[None], 0.5 * np.sinc(0.5 * angle / np.pi) * vectors])


TURN = Step(
    kind="turn",
    kinds=("angle",),
    numbers=("cos", "sin"),
    state=lambda values: np.concatenate([np.cos(values), np.sin(values)]),
    changes=lambda numbers, rates: rates * np.stack([-numbers[1], numbers[0]]),
    motion=lambda axis, _advance, numbers: (about(axis, *numbers), STILL),
    twists=lambda axis, _advance, _rates: ((axis, STILL),),
)
"""About an axis."""

SLIDE = Step(
    kind="slide",
    kinds=("length",),
    numbers=("length",),
    state=lambda values: values,
    changes=lambda _numbers, rates: rates,
    motion=lambda axis, _advance, numbers: (UNTURNED, scaled(axis, numbers[0])),
    twists=lambda axis, _advance, _rates: ((STILL, axis),),
)
"""Along an axis."""

SCREW = Step(
    kind="screw",
    kinds=("angle",),
    numbers=("cos", "sin", "angle"),
    state=lambda values: np.concatenate([np.cos(values), np.sin(values), values]),
    changes=lambda numbers, rates: rates * np.stack([-numbers[1], numbers[0], np.ones_like(numbers[2])]),
    motion=lambda axis, advance, numbers: (about(axis, *numbers[:2]), scaled(axis, times(advance, numbers[2]))),
    twists=lambda axis, advance, _rates: ((axis, scaled(axis, advance)),),
)
"""About an axis and along it; whole turns count."""

BALL = Step(
    kind="ball",
    kinds=("angle", "angle", "angle"),
    numbers=("w", "x", "y", "z"),
    state=quaternions,
    changes=lambda numbers, rates: quaternion_rates(numbers.T, rates.T).T,
    motion=lambda _axis, _advance, numbers: (of_quaternion(*numbers), STILL),
    twists=lambda _axis, _advance, rates: tuple((column, STILL) for column in transposed(rates)),
)
"""About any axis; its coordinates are a rotation vector."""
