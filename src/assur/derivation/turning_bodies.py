"""Bodies: links that do not turn against each other, and the directions about which one body turns against another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy

from assur.derivation.exact_vectors import ExactVectors
from assur.derivation.hinges import Hinge, RigidPair
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.symbols import GivenSymbols
from assur.joints.steps import UNTURNED
from assur.numerics.vectors import Matrix, Vector, apply, product, subtract, transposed


@dataclass(frozen=True)
class TurningWay:
    """A direction u by whose axes a body hangs on a root, C of Rot(u, psi) C, and the joints."""

    axis: Vector
    constant: Matrix
    joints: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class TurningBodies:
    """What joints say of the bodies of a mechanism.

    Attributes:
        symbols: of the mechanism.
        joints: links that do not turn against each other, and hinges.
    """

    symbols: GivenSymbols
    joints: Sequence[RigidPair | Hinge]

    @cached_property
    def exact(self) -> ExactVectors:
        """Compares vectors."""
        return ExactVectors(self.symbols.witness)

    @cached_property
    def of_links(self) -> Mapping[str, tuple[str, Matrix]]:
        """Link -> its body, called by its first link, and the link's orientation in it. Errors: NotDerivedError."""
        record = self.symbols.record
        named = (link for joint in self.joints for link in (joint.parent, joint.child))
        links = dict.fromkeys((record.base, *named, *record.links))
        stiff = [joint for joint in self.joints if isinstance(joint, RigidPair)]
        bodies: dict[str, tuple[str, Matrix]] = {}
        for link in links:
            if link in bodies:
                continue
            bodies[link] = (link, UNTURNED)
            waiting = [link]
            for near in waiting:
                for joint in stiff:
                    for start, end, after in (
                        (joint.parent, joint.child, joint.after),
                        (joint.child, joint.parent, transposed(joint.after)),
                    ):
                        if start != near:
                            continue
                        inside = self.exact.tidy(product(bodies[near][1], after))
                        if end not in bodies:
                            bodies[end] = (link, inside)
                            waiting.append(end)
                        elif not self.exact.equal(bodies[end][1], inside):
                            raise NotDerivedError(f"the orientation of {end} is given twice, in two ways")
        return bodies

    @cached_property
    def free(self) -> Sequence[Hinge]:
        """Hinges from body to body."""
        free = []
        for joint in self.joints:
            if isinstance(joint, Hinge):
                (first, inside), (second, other) = self.of_links[joint.parent], self.of_links[joint.child]
                if first != second:
                    after = self.exact.tidy(product(product(inside, joint.after), transposed(other)))
                    axis = self.exact.tidied(apply(inside, joint.axis))
                    free.append(Hinge(first, second, after, axis, joint.joints))
        return free

    @cached_property
    def both(self) -> Sequence[Hinge]:
        """The hinges, seen from either body."""
        return [*self.free, *(turn.back for turn in self.free)]

    def ways(self, root: str, rotation: Matrix = UNTURNED) -> dict[str, list[TurningWay]]:
        """For each body, the directions by whose axes alone it hangs on the root, whose orientation is given."""
        directions: list[Vector] = []
        for turn in self.both:
            axis = self.exact.upright(self.exact.tidied(apply(rotation, turn.axis)))
            if turn.parent == root and not any(self.exact.along(axis, other) for other in directions):
                directions.append(axis)
        ways: dict[str, list[TurningWay]] = {}
        for axis in directions:
            reached: dict[str, tuple[Matrix, tuple[str, ...]]] = {root: (rotation, ())}
            waiting = [root]
            for near in waiting:
                own, joints = reached[near]
                for turn in self.both:
                    if (
                        turn.parent == near
                        and turn.child not in reached
                        and self.exact.along(apply(own, turn.axis), axis)
                    ):
                        reached[turn.child] = self.exact.tidy(product(own, turn.after)), (*joints, *turn.joints)
                        waiting.append(turn.child)
            for body in waiting[1:]:
                constant, joints = reached[body]
                ways.setdefault(body, []).append(TurningWay(axis, self._unturned(constant, axis), joints))
        return ways

    def _unturned(self, constant: Matrix, axis: Vector) -> Matrix:
        """C of Rot(u, psi) C without turns about u by what is given, which psi has in it."""
        zero = {
            symbol: number for circle in self.symbols.circles for symbol, number in zip(circle, (1, 0), strict=True)
        }
        a, b, c = (tuple(sympy.sympify(part).subs(zero) for part in row) for row in constant)
        plain = self.exact.tidy((a, b, c))
        turned = apply(product(constant, transposed(plain)), axis)
        return plain if all(map(self.symbols.witness.is_zero, subtract(turned, axis))) else constant
