"""Orientations of links, and why: which do not turn, and which turn about one fixed direction.

Joints that cannot turn join links to bodies. A body that hangs on another by axes of one direction u has, against it,
the orientation Rot(u, psi) C. If it hangs on it by axes of u and, by other joints, by axes of v as well, it cannot
turn: Rot(u, a) C1 = Rot(v, b) C2 has one solution at most (the rule r1(u) ∩ r1(v) = r0 of the theory). The two are
one body then, and the argument goes round again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.exact_vectors import ExactVectors
from assur.derivation.hinges import Hinge, RigidPair, hinges, point_on, rods_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.symbols import GivenSymbols
from assur.joints.steps import UNTURNED, about
from assur.numerics.vectors import Matrix, Vector, apply, cross, dot, product, scaled, subtract, transposed


@dataclass(frozen=True)
class ConstraintReason:
    """Why a link does not turn: it hangs on another by axes along two directions.

    Attributes:
        link, carrier: the two links.
        first, second: the directions.
        first_joints, second_joints: the joints of both chains.
        constant: the orientation of the link against the carrier.
    """

    link: str
    carrier: str
    first: Vector
    second: Vector
    first_joints: tuple[str, ...]
    second_joints: tuple[str, ...]
    constant: Matrix


@dataclass(frozen=True)
class Orientation:
    """Rot(axis, psi) constant; psi of circle number `circle`. Fixed where there is no axis.

    A rod has the number `rod`, which rods that stay parallel share, and a direction `line` in the frame of `constant`.
    It lies between ball joints, or on a hinge across the axis about which what carries it turns:
    Rot(axis, psi) Rot(hinge, phi) constant.
    """

    constant: Matrix = UNTURNED
    axis: Vector | None = None
    circle: int | None = None
    line: Vector | None = None
    rod: int | None = None
    hinge: Vector | None = None


@dataclass(frozen=True)
class _Way:
    """A direction u by whose axes a body hangs on a root, C of Rot(u, psi) C, and the joints."""

    axis: Vector
    constant: Matrix
    joints: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class LinkOrientations:
    """Orientation of each link, and of the crosses of universal joints, with the reasons of those that do not turn."""

    links: Mapping[str, Orientation]
    reasons: tuple[ConstraintReason, ...]


def orientations(symbols: GivenSymbols) -> LinkOrientations:
    """Orientations of all links. Errors: NotDerivedError."""
    return _Reading(symbols).orientations()


class _Reading:
    def __init__(self, symbols: GivenSymbols) -> None:
        self.symbols, self.record, self.witness = symbols, symbols.record, symbols.witness
        self.exact = ExactVectors(symbols.witness)

    def orientations(self) -> LinkOrientations:
        joints = [*hinges(self.symbols)]
        if self.symbols.orientation is not None:
            joints.append(RigidPair(self.record.base, self.record.platform.link, self.symbols.orientation))
        reasons: list[ConstraintReason] = []
        bodies = self._bodies(joints)
        while (more := self._held_together(self._free(joints, bodies))) is not None:
            stiff, reason = more
            joints.append(stiff)
            reasons.append(reason)
            bodies = self._bodies(joints)
        free = self._free(joints, bodies)
        root, inside_root = bodies[self.record.base]
        ways = {body: own[0] for body, own in self._ways(free, root, transposed(inside_root)).items()}
        numbers = {body: number for number, body in enumerate(ways)}
        links: dict[str, Orientation] = {}
        for link, (body, inside) in bodies.items():
            if body == root:
                links[link] = Orientation(product(transposed(inside_root), inside))
            elif body in ways:
                way = ways[body]
                links[link] = Orientation(product(way.constant, inside), way.axis, numbers[body])
        hinged = self._hinged(free, ways)
        for number, (body, (way, hinge, constant)) in enumerate(hinged.items()):
            for link, (own, inside) in bodies.items():
                if own == body:
                    whole = self.exact.tidy(product(constant, inside))
                    line = self._line(link, whole, hinge)
                    links[link] = Orientation(whole, way.axis, numbers[self._carrier[body]], line, number, hinge)
        links |= self._rods(links, len(hinged))
        missing = [link for link in self.record.links if link not in links]
        if missing:
            raise NotDerivedError(
                f"{', '.join(missing)}: neither fixed in orientation, nor turning about one direction"
            )
        return LinkOrientations(links, tuple(reasons))

    def _bodies(self, joints: Sequence[RigidPair | Hinge]) -> dict[str, tuple[str, Matrix]]:
        """Link -> its body, called by its first link, and the link's orientation in it."""
        links = dict.fromkeys((self.record.base, *(link for joint in joints for link in (joint.parent, joint.child))))
        stiff = [joint for joint in joints if isinstance(joint, RigidPair)]
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

    def _free(self, joints: Sequence[RigidPair | Hinge], bodies: Mapping[str, tuple[str, Matrix]]) -> list[Hinge]:
        free = []
        for joint in joints:
            if isinstance(joint, Hinge):
                (first, inside), (second, other) = bodies[joint.parent], bodies[joint.child]
                if first != second:
                    after = self.exact.tidy(product(product(inside, joint.after), transposed(other)))
                    axis = self.exact.tidied(apply(inside, joint.axis))
                    free.append(Hinge(first, second, after, axis, joint.joints))
        return free

    def _ways(self, free: Sequence[Hinge], root: str, rotation: Matrix) -> dict[str, list[_Way]]:
        """For each body, the directions by whose axes alone it hangs on the root, whose orientation is given."""
        both = [*free, *(turn.back for turn in free)]
        directions: list[Vector] = []
        for turn in both:
            axis = self.exact.upright(self.exact.tidied(apply(rotation, turn.axis)))
            if turn.parent == root and not any(self.exact.along(axis, other) for other in directions):
                directions.append(axis)
        ways: dict[str, list[_Way]] = {}
        for axis in directions:
            reached: dict[str, tuple[Matrix, tuple[str, ...]]] = {root: (rotation, ())}
            waiting = [root]
            for near in waiting:
                own, joints = reached[near]
                for turn in both:
                    if (
                        turn.parent == near
                        and turn.child not in reached
                        and self.exact.along(apply(own, turn.axis), axis)
                    ):
                        reached[turn.child] = self.exact.tidy(product(own, turn.after)), (*joints, *turn.joints)
                        waiting.append(turn.child)
            for body in waiting[1:]:
                constant, joints = reached[body]
                ways.setdefault(body, []).append(_Way(axis, self._unturned(constant, axis), joints))
        return ways

    def _unturned(self, constant: Matrix, axis: Vector) -> Matrix:
        """C of Rot(u, psi) C without turns about u by what is given, which psi has in it."""
        zero = {
            symbol: number for circle in self.symbols.circles for symbol, number in zip(circle, (1, 0), strict=True)
        }
        a, b, c = (tuple(sympy.sympify(part).subs(zero) for part in row) for row in constant)
        plain = self.exact.tidy((a, b, c))
        turned = apply(product(constant, transposed(plain)), axis)
        return plain if all(map(self.witness.is_zero, subtract(turned, axis))) else constant

    def _held_together(self, free: Sequence[Hinge]) -> tuple[RigidPair, ConstraintReason] | None:
        """Two bodies that turn against each other about two directions, so not at all."""
        for root in dict.fromkeys(body for turn in free for body in (turn.parent, turn.child)):
            for body, ways in self._ways(free, root, UNTURNED).items():
                if len(ways) > 1:
                    first, second = ways[:2]
                    after = self._meeting(first, second, body)
                    reason = ConstraintReason(body, root, first.axis, second.axis, first.joints, second.joints, after)
                    return RigidPair(root, body, after, ()), reason
        return None

    def _meeting(self, first: _Way, second: _Way, body: str) -> Matrix:
        """Rot(u, a) C1 = Rot(v, b) C2."""
        u, v = first.axis, second.axis
        between = apply(product(first.constant, transposed(second.constant)), v)
        if not self.witness.is_zero(dot(u, between) - dot(u, v)):
            raise NotDerivedError(f"{body} cannot have the orientation that its joints ask for")
        if all(self.witness.is_zero(a - b) for a, b in zip(between, v, strict=True)):
            return first.constant
        share = dot(u, v)
        size = 1 - share**2
        cosine, sine = (dot(between, v) - share**2) / size, dot(u, cross(between, v)) / size
        return self.exact.tidy(product(about(u, sympy.simplify(cosine), sympy.simplify(sine)), first.constant))

    def _hinged(self, free: Sequence[Hinge], ways: Mapping[str, _Way]) -> dict[str, tuple[_Way, Vector, Matrix]]:
        """Rods on hinges: how what carries them turns, the hinge's direction and C, both where its psi is zero."""
        self._carrier: dict[str, str] = {}
        hinged: dict[str, tuple[_Way, Vector, Matrix]] = {}
        both = [*free, *(turn.back for turn in free)]
        for turn in both:
            if turn.parent not in ways or turn.child in ways or turn.child in hinged:
                continue
            way = ways[turn.parent]
            hinge = self.exact.tidied(apply(way.constant, turn.axis))
            others = [other for other in both if other.child == turn.child]
            alike = all(
                other.parent == turn.parent and self.exact.along(apply(way.constant, other.axis), hinge)
                for other in others
            )
            if alike and self.witness.is_zero(dot(hinge, way.axis)):
                self._carrier[turn.child] = turn.parent
                hinged[turn.child] = way, hinge, self.exact.tidy(product(way.constant, turn.after))
        return hinged

    def _line(self, link: str, constant: Matrix, hinge: Vector) -> Vector:
        """The direction of a rod across its hinge, where psi and phi are zero; along the hinge it may reach too."""
        joints = [joint for joint in self.record.joints.values() if link in (joint.parent, joint.child)]
        start, *points = (point_on(self.symbols, joint, link) for joint in joints)
        side = next((vector for vector in (subtract(point, start) for point in points) if any(vector)), None)
        if side is None:
            raise NotDerivedError(f"{link}: all its joints have one point, so it has no direction")
        along = apply(constant, side)
        across = self.exact.tidied(subtract(along, scaled(hinge, dot(along, hinge))))
        if not any(across):
            raise NotDerivedError(f"{link} reaches along its hinge alone")
        return self.exact.tidied(self.exact.unit(across))

    def _rods(self, links: Mapping[str, Orientation], first_number: int) -> dict[str, Orientation]:
        """Rods between two ball joints."""
        together = {}
        for group in self.record.generalised.values():
            if group.kind == "P(4S)":
                first, second = rods_of(self.record, group)
                together[second] = first
        lines = {}
        for link in self.record.links:
            joints = [joint for joint in self.record.joints.values() if link in (joint.parent, joint.child)]
            if link not in links and len(joints) == 2 and all(joint.type.ball for joint in joints):
                near, far = (point_on(self.symbols, joint, link) for joint in joints)
                lines[link] = self.exact.unit(subtract(far, near))
        alone = [link for link in lines if link not in together]
        numbers = {link: number for number, link in enumerate(alone, start=first_number)}
        return {
            link: Orientation(UNTURNED, line=line, rod=numbers[together.get(link, link)])
            for link, line in lines.items()
        }
