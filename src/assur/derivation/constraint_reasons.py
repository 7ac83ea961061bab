"""Why a body does not turn against another, though joints that turn hold it.

A body that hangs on another by axes of one direction u has, against it, the orientation Rot(u, psi) C. If it hangs on
it by axes of u and, by other joints, by axes of v as well, it cannot turn: Rot(u, a) C1 = Rot(v, b) C2 has one solution
at most (the rule r1(u) ∩ r1(v) = r0 of the theory). Bodies that hang on each other three times, about u, v and w, do
not turn either: Rot(u, a) Rot(w, c) = Rot(v, b) has two solutions where the three directions are independent.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import sympy

from assur.derivation.hinges import HOME, RigidPair
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.rotations_at_home import rotations_at_home
from assur.derivation.turning_bodies import TurningBodies, TurningWay
from assur.joints.steps import about
from assur.numerics.vectors import Matrix, Vector, apply, cross, dot, product, transposed, triple


@dataclass(frozen=True)
class ConstraintReason:
    """Why a link does not turn: it hangs on another by axes along two directions.

    Attributes:
        link, carrier: the two links.
        first, second: the directions.
        first_joints, second_joints: the joints of both chains.
        constant: the orientation of the link against the carrier.
        third: another direction of axes of the second chain, on its way. Such a link may stand in one way more.
    """

    link: str
    carrier: str
    first: Vector
    second: Vector
    first_joints: tuple[str, ...]
    second_joints: tuple[str, ...]
    constant: Matrix
    third: Vector | None = None

    @property
    def other_way(self) -> tuple[sympy.Expr, sympy.Expr] | None:
        """Cosine and sine of the angle about `first` by which the link is turned in its other way, if it has one.

        Rot(u, a) leaves v . Rot(u, a) w as it is at a = 0, for u, v, w `first`, `third`, `second`.

        >>> x, y, z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
        >>> ConstraintReason("bar", "base", x, z, (), (), (x, y, z), y).other_way
        (-1, 0)
        """
        if self.third is None:
            return None
        u, v, w = self.first, self.third, self.second
        share, volume = map(sympy.sympify, (dot(v, w) - dot(u, v) * dot(u, w), triple(u, w, v)))
        size = share**2 + volume**2
        return sympy.simplify((share**2 - volume**2) / size), sympy.simplify(2 * share * volume / size)


def held(bodies: TurningBodies) -> tuple[RigidPair, ConstraintReason] | None:
    """Two bodies that cannot turn against each other, and why. Errors: NotDerivedError."""
    return next(_held_together(bodies), None) or next(_triangles(bodies), None)


def _roots(bodies: TurningBodies) -> dict[str, None]:
    return dict.fromkeys(body for turn in bodies.free for body in (turn.parent, turn.child))


def _held_together(bodies: TurningBodies) -> Iterator[tuple[RigidPair, ConstraintReason]]:
    """Two bodies that turn against each other about two directions, so not at all."""
    for root in _roots(bodies):
        for body, ways in bodies.ways(root).items():
            if len(ways) > 1:
                first, second = ways[:2]
                after = _meeting(bodies, first, second, body)
                reason = ConstraintReason(body, root, first.axis, second.axis, first.joints, second.joints, after)
                yield RigidPair(root, body, after, ()), reason


def _meeting(bodies: TurningBodies, first: TurningWay, second: TurningWay, body: str) -> Matrix:
    """Rot(u, a) C1 = Rot(v, b) C2."""
    u, v, is_zero = first.axis, second.axis, bodies.symbols.witness.is_zero
    between = apply(product(first.constant, transposed(second.constant)), v)
    if not is_zero(dot(u, between) - dot(u, v)):
        raise NotDerivedError(f"{body} cannot have the orientation that its joints ask for")
    if all(is_zero(a - b) for a, b in zip(between, v, strict=True)):
        return first.constant
    share = dot(u, v)
    size = 1 - share**2
    cosine, sine = (dot(between, v) - share**2) / size, dot(u, cross(between, v)) / size
    return bodies.exact.tidy(product(about(u, sympy.simplify(cosine), sympy.simplify(sine)), first.constant))


def _triangles(bodies: TurningBodies) -> Iterator[tuple[RigidPair, ConstraintReason]]:
    """Two bodies that turn against a third about u and v, and against each other about w: as they stand at home."""
    witness = bodies.symbols.witness
    for root in _roots(bodies):
        ways = {body: own[0] for body, own in bodies.ways(root).items()}
        for body, first in ways.items():
            inner = bodies.ways(body, first.constant)
            for second, between in ((ways[other], way) for other in ways for way in inner.get(other, ())):
                volume = triple(first.axis, second.axis, between.axis)
                fits = bodies.exact.equal(between.constant, second.constant)
                if not witness.is_zero(volume) and fits and _as_at_home(bodies, root, body, first):
                    joints = first.joints, (*second.joints, *between.joints)
                    axes = first.axis, between.axis
                    reason = ConstraintReason(body, root, *axes, *joints, first.constant, second.axis)
                    yield RigidPair(root, body, first.constant, ()), reason


def _as_at_home(bodies: TurningBodies, root: str, body: str, way: TurningWay) -> bool:
    """Whether a body stands at home as if it had not turned."""
    rotations = rotations_at_home(bodies.symbols.record)
    if not {root, body} <= rotations.keys() or any(
        sympy.sympify(part).free_symbols for row in way.constant for part in row
    ):
        return False
    apart = rotations[root].T @ rotations[body] - np.array(sympy.Matrix(way.constant).evalf(30), dtype=float)
    return bool(np.max(np.abs(apart)) < HOME)
