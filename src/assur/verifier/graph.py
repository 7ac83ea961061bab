"""A plain joint graph over any number type: where its links are, how its loops gape, how its joints move them.

It knows nothing of the program whose proofs are checked with it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from assur.verifier.formula import AngleSum, FloatNumbers, NumberType, number
from assur.verifier.mechanism import FileJoint, FileLimb, FileMechanism, Triple
from assur.verifier.vectors import (
    ONE,
    ZERO,
    Matrix,
    Vector,
    about,
    add,
    apply,
    cross,
    dot,
    is_zero,
    product,
    scaled,
    subtract,
    taking,
    times,
    transposed,
)

Frame = tuple[Matrix, Vector]
"""Rows of an orientation, and an origin, in the base frame."""
State = Mapping[str, Sequence[Any]]
"""Of each joint: a length, or cosine and sine of an angle, one after the other; cosine, sine and angle of a screw; the
nine entries of a rotation, row by row, of a spherical joint."""
STEPS = {
    "revolute": (("turn", 0),),
    "prismatic": (("slide", 0),),
    "helical": (("screw", 0),),
    "cylindrical": (("slide", 0), ("turn", 0)),
    "universal": (("turn", 0), ("turn", 1)),
    "spherical": (("ball", 0),),
    "planar": (("slide", 1), ("slide", 2), ("turn", 0)),
}
"""What each joint does to its child, one motion after the other, and along which of its directions."""
SIZES = {"turn": 2, "slide": 1, "screw": 3, "ball": 9}
"""How many numbers say where each motion stands."""


@dataclass(frozen=True)
class Dimensions:
    """Of one joint: points in both frames, unit vectors, the child's orientation at zero, and advance per rad."""

    at: Vector
    child_at: Vector
    axes: tuple[Vector, ...]
    turn: Matrix
    advance: Any


class Graph:
    """The joint graph of a mechanism with dimensions.

    Args:
        mechanism: as its file has it.
        numbers: the number type.
        names: values of its parameters, as `FileMechanism.dimensions` gives them or as they are drawn.

    Attributes:
        joints: dimensions of each joint.
        tree: (joint, whether from parent to child), breadth first from the base; `cut` closes a loop each.
    """

    def __init__(self, mechanism: FileMechanism, numbers: NumberType, names: Mapping[str, Any]) -> None:
        self.mechanism = mechanism
        own = _Reading(mechanism, numbers, names)
        self.point = own.vector(mechanism.point, None)
        self.joints = {name: own.dimensions(joint) for name, joint in mechanism.joints.items()}
        self.tree: list[tuple[str, bool]] = []
        placed = [mechanism.base]
        for link in placed:
            for name, joint in mechanism.joints.items():
                other = {joint.parent: joint.child, joint.child: joint.parent}.get(link)
                if other is not None and other not in placed:
                    placed.append(other)
                    self.tree.append((name, link == joint.parent))
        used = {name for name, _ in self.tree}
        self.cut = [name for name in mechanism.joints if name not in used]
        if not {link for joint in mechanism.joints.values() for link in (joint.parent, joint.child)} <= set(placed):
            raise ValueError("links that hang on nothing")

    def frames(self, state: State) -> dict[str, Frame]:
        """Frames of all links, along the tree."""
        result: dict[str, Frame] = {self.mechanism.base: (ONE, ZERO)}
        for name, forward in self.tree:
            joint, own = self.mechanism.joints[name], self.joints[name]
            turned, shift = self._motion(name, state[name])
            rotation, origin = result[joint.parent if forward else joint.child]
            if forward:
                child = product(rotation, turned)
                reached = add(origin, apply(rotation, add(own.at, shift)))
                result[joint.child] = child, subtract(reached, apply(child, own.child_at))
            else:
                parent = product(rotation, transposed(turned))
                reached = add(origin, apply(rotation, own.child_at))
                result[joint.parent] = parent, subtract(reached, apply(parent, add(own.at, shift)))
        return result

    def gap(self, name: str, state: State, frames: Mapping[str, Frame]) -> tuple[Vector, Matrix]:
        """From where the tree has a cut joint's child to where the joint has it: (0, 0, 0) and 1 where it closes."""
        joint, own = self.mechanism.joints[name], self.joints[name]
        (rotation, origin), (child, child_origin) = frames[joint.parent], frames[joint.child]
        turned, shift = self._motion(name, state[name])
        reached = add(origin, apply(rotation, add(own.at, shift)))
        distance = subtract(reached, add(child_origin, apply(child, own.child_at)))
        return distance, product(product(rotation, turned), transposed(child))

    def twists(self, name: str, state: State, frames: Mapping[str, Frame]) -> Iterator[tuple[Vector, Vector]]:
        """Angular velocity, and velocity at the base's origin, per rate of each coordinate; of a ball about x, y, z."""
        joint, own = self.mechanism.joints[name], self.joints[name]
        rotation, origin = frames[joint.parent]
        place = add(origin, apply(rotation, own.at))
        for kind, axis, numbers in self._steps(name, state[name]):
            if kind == "ball":
                yield from ((turning, cross(place, turning)) for turning in transposed(rotation))
                continue
            along = apply(rotation, axis)
            if kind == "slide":
                yield ZERO, along
            else:
                advance = scaled(along, own.advance) if kind == "screw" else ZERO
                yield along, add(cross(place, along), advance)
            turned, shift = _moved(kind, axis, own.advance, numbers)
            place = add(place, apply(rotation, shift))
            rotation = product(rotation, turned)

    def _steps(self, name: str, state: Sequence[Any]) -> Iterator[tuple[str, Vector, Sequence[Any]]]:
        start = 0
        for kind, direction in STEPS[self.mechanism.joints[name].type]:
            axes = self.joints[name].axes
            yield kind, axes[direction] if axes else ZERO, state[start : start + SIZES[kind]]
            start += SIZES[kind]

    def _motion(self, name: str, state: Sequence[Any]) -> Frame:
        """The child's frame in the parent's, less both points."""
        turned, shift = ONE, ZERO
        for kind, axis, numbers in self._steps(name, state):
            own, way = _moved(kind, axis, self.joints[name].advance, numbers)
            turned, shift = product(turned, own), add(shift, apply(turned, way))
        return product(turned, self.joints[name].turn), shift


def _moved(kind: str, axis: Vector, advance: Any, numbers: Sequence[Any]) -> Frame:
    if kind == "slide":
        return ONE, scaled(axis, numbers[0])
    if kind == "ball":
        a, b, c, d, e, f, g, h, i = numbers
        return ((a, b, c), (d, e, f), (g, h, i)), ZERO
    return about(axis, numbers[0], numbers[1]), scaled(axis, times(advance, numbers[2])) if kind == "screw" else ZERO


class _Reading:
    """Vectors of a file as numbers, turned with their limbs."""

    def __init__(self, mechanism: FileMechanism, numbers: NumberType, names: Mapping[str, Any]) -> None:
        self.mechanism, self.numbers, self.names = mechanism, numbers, names
        self.floats = mechanism.dimensions(FloatNumbers())  # for choices alone: a sense, and which axis is the nearest
        self._turns: dict[FileLimb, Matrix] = {}

    def dimensions(self, joint: FileJoint) -> Dimensions:
        axes = [self.unit(axis) for axis in joint.axes]
        if joint.type == "planar":
            axes += self._plane(axes[0], [float(number(part, self.floats, FloatNumbers())) for part in joint.axes[0]])
        child_axis = self.unit(joint.child_axis) if joint.child_axis else None
        axes = [self._turned(axis, joint.limb) for axis in axes]
        turn = taking(self._turned(child_axis, joint.limb), axes[0]) if child_axis else ONE
        advance: Any = 0
        if joint.pitch is not None:
            advance = number(joint.pitch, self.names, self.numbers) / (2 * self.numbers.radians(AngleSum({"pi": 1})))
        points = self.vector(joint.at, joint.limb), self.vector(joint.child_at, joint.limb)
        return Dimensions(*points, tuple(axes), turn, advance)

    def vector(self, written: Triple, limb: FileLimb | None) -> Vector:
        x, y, z = (number(part, self.names, self.numbers) for part in written)
        return self._turned((x, y, z), limb)

    def unit(self, written: Triple) -> Vector:
        """A unit vector, in its template; of one along an axis of the frame its sense alone."""
        x, y, z = (number(part, self.names, self.numbers) for part in written)
        along = [k for k, part in enumerate((x, y, z)) if not is_zero(part)]
        if len(along) == 1:
            sense = 1 if float(number(written[along[0]], self.floats, FloatNumbers())) > 0 else -1
            return tuple(sense * (k == along[0]) for k in range(3))  # type: ignore[return-value]
        return self._normed((x, y, z))

    def _normed(self, vector: Vector) -> Vector:
        square = dot(vector, vector)
        if type(square) is int:
            square = self.numbers.number(Fraction(square))
        return scaled(vector, 1 / self.numbers.root(square))

    def _plane(self, normal: Vector, floats: Sequence[float]) -> list[Vector]:
        """The axis that follows the one next to the normal, less what it has along the normal, and across both."""
        following = (max(range(3), key=lambda k: abs(floats[k] / math.hypot(*floats))) + 1) % 3
        first = subtract(ONE[following], scaled(normal, normal[following]))
        first = self._normed(first)
        return [first, cross(normal, first)]

    def _turned(self, vector: Vector, limb: FileLimb | None) -> Vector:
        if limb is None:
            return vector
        if limb not in self._turns:
            angle = self.mechanism.angle(limb.angle, self.names, self.numbers)
            self._turns[limb] = about(self.unit(limb.about), *self.numbers.circle(angle))
        return apply(self._turns[limb], vector)
