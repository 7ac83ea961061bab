"""How links may be turned: what joints, and parallelograms that stay such, say of their orientations alone.

A hop from link to link is rigid, R_b = R_a C, or turns about an axis of the first, R_b = R_a Rot(axis, q) C. Links that
are reached from another by hops about parallel axes turn about one direction against it. One that is reached so along
two directions does not turn against it, since no turn about one direction is one about another.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from assur.verifier.field import NoExactError
from assur.verifier.graph import STEPS, Graph
from assur.verifier.mechanism import FileMechanism, FileParallelogram
from assur.verifier.reading import RefusedError
from assur.verifier.vectors import (
    ONE,
    Matrix,
    Vector,
    about,
    add,
    apply,
    cross,
    dot,
    plus,
    product,
    scaled,
    subtract,
    times,
    transposed,
)

Circle = tuple[Any, Any]
IsZero = Callable[[Any], bool]


@dataclass(frozen=True)
class Hop:
    """R_end = R_start Rot(axis, q) after; rigid where there is no axis."""

    start: str
    end: str
    after: Matrix
    axis: Vector | None = None
    joint: str = ""

    @cached_property
    def back(self) -> Hop:
        """The same from its end, where it turns the other way."""
        after = transposed(self.after)
        return Hop(self.end, self.start, after, None if self.axis is None else apply(after, self.axis), self.joint)


def hops(graph: Graph, locked: Mapping[str, Circle]) -> Iterator[Hop]:
    """Of all joints, those at angles that are given rigid, and of parallelograms.

    Args:
        graph: the joint graph.
        locked: "joint coordinate" -> cosine and sine of an angle that is given.
    """
    mechanism = graph.mechanism
    for name, joint in mechanism.joints.items():
        own = graph.joints[name]
        turning = [(place, kind, axis) for place, (kind, axis) in enumerate(STEPS[joint.type]) if kind != "slide"]
        if not turning:
            yield Hop(joint.parent, joint.child, own.turn)
        links = (joint.parent, *[f"{name}'s cross"] * (len(turning) - 1), joint.child)
        for k, (place, kind, direction) in enumerate(turning):
            after = own.turn if k == len(turning) - 1 else ONE
            if kind == "screw":
                raise NoExactError(f"{name} is a screw, whose angle and length belong together")
            if kind != "turn":
                continue
            axis, given = own.axes[direction], locked.get(f"{name} {place}")
            turned = after if given is None else product(about(axis, *given), after)
            yield Hop(links[k], links[k + 1], turned, axis if given is None else None, name)
    for group in mechanism.parallelograms:
        yield from _kept(graph, group)


def _kept(graph: Graph, group: FileParallelogram) -> Iterator[Hop]:
    """What a parallelogram says that stays one."""
    first, second = rods(graph.mechanism, group)
    if group.kind == "P(4R)":
        yield Hop(group.parent, group.child, ONE)
        yield Hop(first, second, ONE)
    elif group.kind in ("P(4S)", "P(2US)"):
        joints, link = graph.mechanism.joints, group.parent
        held = (name for name in group.joints if link in (joints[name].parent, joints[name].child))
        near, far = (point(graph, name, link) for name in held)
        yield Hop(group.parent, group.child, ONE, subtract(far, near))
        if group.kind == "P(2US)":
            yield Hop(first, second, ONE)


def rods(mechanism: FileMechanism, group: FileParallelogram) -> tuple[str, str]:
    """The two rods of a parallelogram."""
    links = {link for name in group.joints for link in (mechanism.joints[name].parent, mechanism.joints[name].child)}
    first, second = sorted(links - {group.parent, group.child})
    return first, second


def point(graph: Graph, joint: str, link: str) -> Vector:
    """A joint's point in one of its links."""
    own = graph.joints[joint]
    return own.at if graph.mechanism.joints[joint].parent == link else own.child_at


def reached(
    all_hops: Sequence[Hop], root: str, axis: Vector | None, zero: IsZero, tidy: Callable[[Matrix], Matrix]
) -> dict[str, Matrix]:
    """Links that hang on a root by rigid hops, and by ones about one direction of it; their C of Rot(axis, psi) C."""
    result: dict[str, Matrix] = {root: ONE}
    for link in (waiting := [root]):
        for hop in (own for both in all_hops for own in (both, both.back)):
            if link != hop.start or hop.end in result:
                continue
            own = result[link]
            if hop.axis is None or (axis is not None and all(map(zero, cross(apply(own, hop.axis), axis)))):
                result[hop.end] = tidy(product(own, hop.after))
                waiting.append(hop.end)
    return result


def is_rotation(turn: Matrix, zero: IsZero) -> bool:
    """Whether a matrix is one: orthogonal, of determinant 1."""
    a, b, c = turn
    return same(product(turn, transposed(turn)), ONE, zero) and zero(plus(dot(a, cross(b, c)), -1))


def fixes(turn: Matrix, axis: Vector, zero: IsZero) -> bool:
    """Whether a vector stays where it is."""
    return all(map(zero, subtract(apply(turn, axis), axis)))


def same(first: Matrix, second: Matrix, zero: IsZero) -> bool:
    """Whether two matrices are one."""
    return all(zero(part) for rows in zip(first, second, strict=True) for part in subtract(*rows))


@dataclass(frozen=True)
class Triangle:
    """Three balls of a link, in the frame in which it has its orientation, and the components of the sides by names."""

    link: str
    joints: tuple[str, ...]
    corners: Matrix
    sides: tuple[tuple[str, ...], ...]

    @property
    def vectors(self) -> Matrix:
        """From each corner to the next."""
        a, b, c = self.corners
        return subtract(b, a), subtract(c, b), subtract(a, c)

    @property
    def size(self) -> Any:
        """What vanishes where the corners are on one line."""
        first, _, last = self.vectors
        return plus(times(dot(first, first), dot(last, last)), times(-1, times(dot(first, last), dot(first, last))))

    def image(self, vector: Vector, values: Mapping[str, Any], zero: IsZero) -> Vector:
        """A vector of the link in the base, by the first and the last side and what is across both."""
        u, _, w = self.vectors
        uu, uw, ww, uv, wv = dot(u, u), dot(u, w), dot(w, w), dot(u, vector), dot(w, vector)
        over = 1 / (Fraction(self.size) if isinstance(self.size, int) else self.size)
        first = times(plus(times(uv, ww), times(-1, times(wv, uw))), over)
        last = times(plus(times(wv, uu), times(-1, times(uv, uw))), over)
        (a, b, c), _, (x, y, z) = (tuple(values[name] for name in side) for side in self.sides)
        along = add(scaled((a, b, c), first), scaled((x, y, z), last))
        beside = dot(cross(u, w), vector)
        return along if zero(beside) else add(along, scaled(cross((a, b, c), (x, y, z)), times(beside, over)))


@dataclass(frozen=True)
class ClaimedTurn:
    """How a link is said to be turned; circle and rod by names of unknowns, all else as numbers of a type."""

    link: str
    kind: str
    constant: Matrix
    axis: Vector | None
    circle: tuple[str, ...] | None
    hinge: Vector | None
    line: Vector | None
    rod: tuple[str, ...] | None
    second: tuple[str, ...] | None = None
    triangle: Triangle | None = None

    def image(self, vector: Vector, values: Mapping[str, Any], zero: IsZero) -> Vector:
        """A vector of the link, in the base. Errors: RefusedError, of one that a rod does not have."""
        own = apply(self.constant, vector)
        if self.triangle is not None:
            return self.triangle.image(own, values, zero)
        if self.kind != "rod":
            return self._turned(own, values, zero)
        line, hinge, rod = self.line or (0, 0, 0), self.hinge or (0, 0, 0), self.rod or ()
        share, beside = dot(line, own), dot(hinge, own) if zero(dot(hinge, line)) else 0
        if not all(zero(part) for part in subtract(own, add(scaled(line, share), scaled(hinge, beside)))):
            raise RefusedError(f"{self.link} has a point beside its line")
        x, y, z = (values[name] for name in rod)
        along = scaled((x, y, z), share)
        return along if zero(beside) else add(along, scaled(self._turned(hinge, values, zero), beside))

    def leaning(self, values: Mapping[str, Any], zero: IsZero) -> Any:
        """What vanishes, as a rod stands at one angle to the hinge on a link that turns; 0 of all others."""
        if self.rod is None or self.line is None or self.hinge is None or self.circle is None:
            return 0
        x, y, z = (values[name] for name in self.rod)
        return plus(dot((x, y, z), self._turned(self.hinge, values, zero)), times(-1, dot(self.line, self.hinge)))

    def _turned(self, own: Vector, values: Mapping[str, Any], zero: IsZero) -> Vector:
        if self.kind == "carried" and self.hinge is not None:
            cosine, sine = (values[name] for name in self.second or ())
            own = apply(about(self.hinge, cosine, sine), own)
        if self.kind == "fixed" or self.axis is None or all(map(zero, cross(self.axis, own))):
            return own
        if self.circle is None:
            raise RefusedError(f"{self.link} turns, and by what is not said")
        cosine, sine = (values[name] for name in self.circle)
        return apply(about(self.axis, cosine, sine), own)

    def rotation(self, values: Mapping[str, Any], zero: IsZero) -> Matrix | None:
        """The orientation, where it is said."""
        if self.kind != "fixed" and (self.kind not in ("circle", "carried") or self.circle is None):
            return None
        x, y, z = (self.image(axis, values, zero) for axis in ONE)
        return transposed((x, y, z))
