"""What a joint type is: its names, and the steps that it is made of."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from assur.joints.steps import STILL, UNTURNED, CoordinateKind, Motion, Step, Twist
from assur.numerics.vectors import Matrix, Vector, add, apply, product

Directions = Callable[[Sequence[Vector]], tuple[Vector, ...]]


@dataclass(frozen=True)
class JointType:
    """A pair of links that move against each other.

    `components` name its coordinates in the order in which they move the child. An "angle" is in rad, a "length" in the
    unit of the mechanism. The three components of a spherical joint are the parts of one rotation vector.

    Attributes:
        name, letter: as files and as notation write it.
        components: names of its coordinates.
        steps: what moves the child, one after the other.
        axes: how many unit vectors are written for it; the first is the one that it is known by.
        lookalikes: letters of other alphabets that are read as its own.
        room: half of what is drawn about it, along its first axis and across it, in thicknesses of a bar.
        directions: unit vectors that its steps go along, of those that are written, which come first.
    """

    name: str
    letter: str
    components: tuple[str, ...]
    steps: tuple[Step, ...] = field(repr=False)
    axes: int
    lookalikes: str = ""
    room: tuple[float, float] = (2.55, 1.15)
    directions: Directions = field(default=tuple, repr=False)

    @property
    def ball(self) -> bool:
        """Whether it turns about a point, its coordinates a rotation vector."""
        return any(step.kind == "ball" for step in self.steps)

    @property
    def screw(self) -> bool:
        """Whether it advances as it turns, by a pitch."""
        return any(step.kind == "screw" for step in self.steps)

    @property
    def turns(self) -> int:
        """How many axes it turns about; none for a ball."""
        return sum(step.kind in ("turn", "screw") for step in self.steps)

    @property
    def slides(self) -> int:
        """How many lengths are among its coordinates."""
        return sum(step.kind == "slide" for step in self.steps)

    @property
    def turning(self) -> bool:
        """Whether it turns its child at all: where it lies matters then."""
        return any(step.kind != "slide" for step in self.steps)

    @property
    def carries(self) -> bool:
        """Whether the distance of the points of parent and child is free."""
        return any(step.kind in ("slide", "screw") for step in self.steps)

    @property
    def axial(self) -> bool:
        """Whether all it does is about and along one axis: such a joint is driven where nothing else is said."""
        return self.axes == 1 and all(step.direction == 0 for step in self.steps)

    @property
    def kinds(self) -> tuple[CoordinateKind, ...]:
        """Whether each coordinate is an angle or a length."""
        return tuple(kind for step in self.steps for kind in step.kinds)

    @property
    def freedoms(self) -> int:
        """Number of freedoms f_i of Eq. (3)."""
        return len(self.components)

    @property
    def places(self) -> Iterator[tuple[Step, int]]:
        """Each step, and the place of its first coordinate."""
        first = 0
        for step in self.steps:
            yield step, first
            first += len(step.kinds)

    def numbers(self, state: Sequence[Any]) -> Iterator[tuple[Any, ...]]:
        """Those of each step, of the numbers of all."""
        start = 0
        for step in self.steps:
            yield tuple(state[start : start + len(step.numbers)])
            start += len(step.numbers)

    def motion(self, axes: Sequence[Vector], advance: Any, state: Sequence[Any]) -> Motion:
        """Turn and shift of the child's joint frame in the parent's.

        >>> from assur.joints.universal import UNIVERSAL
        >>> UNIVERSAL.motion([(0, 0, 1), (1, 0, 0)], 0, [0, 1, 1, 0])
        (((0, -1, 0), (1, 0, 0), (0, 0, 1)), (0, 0, 0))
        """
        turned, shift = UNTURNED, STILL
        for step, numbers in zip(self.steps, self.numbers(state), strict=True):
            own, way = step.motion(_axis(axes, step), advance, numbers)
            turned, shift = product(turned, own), add(shift, apply(turned, way))
        return turned, shift

    def twists(
        self, axes: Sequence[Vector], advance: Any, state: Sequence[Any], rates: Matrix = UNTURNED
    ) -> Iterator[tuple[Vector, Twist]]:
        """For each coordinate the point that it moves, and angular velocity and that point's, in the parent's frame.

        The point is the origin of the child's joint frame before the step, from the joint's point. The columns of
        `rates` are the angular velocities that a ball joint's three coordinates stand for.
        """
        turned, shift = UNTURNED, STILL
        for step, numbers in zip(self.steps, self.numbers(state), strict=True):
            axis = _axis(axes, step)
            for angular, velocity in step.twists(axis, advance, rates):
                yield shift, (apply(turned, angular), apply(turned, velocity))
            own, way = step.motion(axis, advance, numbers)
            turned, shift = product(turned, own), add(shift, apply(turned, way))


def _axis(axes: Sequence[Vector], step: Step) -> Vector:
    return axes[step.direction] if axes else STILL
