"""Orientations of links, and why: which do not turn, and which turn about one fixed direction.

Joints that cannot turn join links to bodies. A body that hangs on another by axes of one direction u has, against it,
the orientation Rot(u, psi) C. If it hangs on it by axes of u and, by other joints, by axes of v as well, it cannot
turn: Rot(u, a) C1 = Rot(v, b) C2 has one solution at most (the rule r1(u) ∩ r1(v) = r0 of the theory). The two are
one body then, and the argument goes round again.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import sympy

from assur.derivation.exact_vectors import ExactVectors
from assur.derivation.hinges import HOME, Hinge, RigidPair, hinges, point_on, rods_of, slides
from assur.derivation.named_directions import NamedDirections
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.posed_orientation import posed_orientation
from assur.derivation.rotations_at_home import rotations_at_home
from assur.derivation.symbols import GivenSymbols
from assur.joints.steps import UNTURNED, about
from assur.model.mechanism import Joint
from assur.numerics.vectors import Matrix, Vector, apply, cross, dot, product, scaled, subtract, transposed, triple


@dataclass(frozen=True)
class ConstraintReason:
    """Why a link does not turn: it hangs on another by axes along two directions.

    Attributes:
        link, carrier: the two links.
        first, second: the directions.
        first_joints, second_joints: the joints of both chains.
        constant: the orientation of the link against the carrier.
        third: another direction of axes of the second chain, on its way.
    """

    link: str
    carrier: str
    first: Vector
    second: Vector
    first_joints: tuple[str, ...]
    second_joints: tuple[str, ...]
    constant: Matrix
    third: Vector | None = None


@dataclass(frozen=True)
class Orientation:
    """Rot(axis, psi) constant; psi of circle number `circle`. Fixed where there is no axis.

    A rod has the number `rod`, which rods that stay parallel share, and a direction `line` in the frame of `constant`.
    It lies between ball joints, or on a hinge across the axis about which what carries it turns:
    Rot(axis, psi) Rot(hinge, phi) constant. Another link on a hinge has phi of circle number `second`.
    """

    constant: Matrix = UNTURNED
    axis: Vector | None = None
    circle: int | None = None
    line: Vector | None = None
    rod: int | None = None
    hinge: Vector | None = None
    second: int | None = None


@dataclass(frozen=True)
class _Way:
    """A direction u by whose axes a body hangs on a root, C of Rot(u, psi) C, and the joints."""

    axis: Vector
    constant: Matrix
    joints: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class LinkOrientations:
    """Orientation of each link, and of the crosses of universal joints, with the reasons of those that do not turn.

    Attributes:
        links: their orientations.
        reasons: of those that do not turn.
        hinges: axes that two links share.
        named: entries of rotations and directions that what is given turns.
    """

    links: Mapping[str, Orientation]
    reasons: tuple[ConstraintReason, ...]
    hinges: tuple[Hinge, ...]
    named: NamedDirections


def _with_names(own: Orientation, named: NamedDirections) -> Orientation:
    """An orientation about a direction that what is given turns, by names."""
    if own.axis is None or own.rod is not None or not any(map(named.turned, own.axis)):
        return own
    a, b, c = (named.vector(row) for row in own.constant)
    hinge = None if own.hinge is None else named.vector(own.hinge)
    return replace(own, constant=(a, b, c), axis=named.vector(own.axis), hinge=hinge)


def orientations(symbols: GivenSymbols) -> LinkOrientations:
    """Orientations of all links. Errors: NotDerivedError."""
    return _Reading(symbols).orientations()


class _Reading:
    def __init__(self, symbols: GivenSymbols) -> None:
        self.symbols, self.record, self.witness = symbols, symbols.record, symbols.witness
        self.exact = ExactVectors(symbols.witness)

    def orientations(self) -> LinkOrientations:
        joints = [*hinges(self.symbols)]
        if (posed := posed_orientation(self.symbols)) is not None:
            joints.append(posed.pair)
        reasons: list[ConstraintReason] = []
        bodies = self._bodies(joints)
        while (more := self._held(self._free(joints, bodies))) is not None:
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
            line = self._across(body, self._side(body, bodies), constant, hinge)
            for link, (own, inside) in bodies.items():
                if own == body:
                    whole = self.exact.tidy(product(constant, inside))
                    links[link] = Orientation(whole, way.axis, numbers[self._carrier[body]], line, number, hinge)
        links |= self._rods(links, bodies, len(hinged))
        while (carried := self._carried_in_space(free, links, bodies)) is not None:
            moved, orientation = carried
            number = 1 + max((part.second or part.circle or 0 for part in links.values()), default=0)
            for link, (other, inside) in bodies.items():
                if other == moved:
                    whole = self.exact.tidy(product(orientation.constant, inside))
                    links[link] = replace(orientation, constant=whole, second=number)
        missing = [link for link in self.record.links if link not in links]
        if missing:
            held = "; ".join(
                f"{link} turns in space, held by {', '.join(joint.name for joint in self._joints_of(link))}"
                for link in missing
            )
            raise NotDerivedError(
                f"{', '.join(missing)}: neither fixed in orientation, nor turning about one direction or about an axis "
                f"that does: {held}"
            )
        shared = [turn for turn in free if {turn.parent, turn.child} <= links.keys()]
        named = NamedDirections(self.symbols, posed.definitions if posed else ())
        links = {link: _with_names(own, named) for link, own in links.items()}
        return LinkOrientations(links, tuple(reasons), tuple(shared), named)

    def _carried_in_space(
        self, free: Sequence[Hinge], links: Mapping[str, Orientation], bodies: Mapping[str, tuple[str, Matrix]]
    ) -> tuple[str, Orientation] | None:
        """A body on an axis that a link carries which turns about one direction: the platform if it is one."""
        both = [*free, *(turn.back for turn in free)]
        platform, _ = bodies[self.record.platform.link]
        for turn in sorted(both, key=lambda own: own.child != platform):
            carrier = links.get(turn.parent)
            real = any(own == turn.child and link in self.record.links for link, (own, _) in bodies.items())
            if carrier is None or turn.child in links or not real:
                continue
            if carrier.circle is not None and carrier.second is None and carrier.rod is None:
                hinge = self.exact.tidied(apply(carrier.constant, turn.axis))
                constant = self.exact.tidy(product(carrier.constant, turn.after))
                return turn.child, replace(carrier, constant=constant, hinge=hinge)
        return None

    def _bodies(self, joints: Sequence[RigidPair | Hinge]) -> dict[str, tuple[str, Matrix]]:
        """Link -> its body, called by its first link, and the link's orientation in it."""
        named = (link for joint in joints for link in (joint.parent, joint.child))
        links = dict.fromkeys((self.record.base, *named, *self.record.links))
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

    def _held(self, free: Sequence[Hinge]) -> tuple[RigidPair, ConstraintReason] | None:
        return self._held_together(free) or self._triangle(free)

    def _triangle(self, free: Sequence[Hinge]) -> tuple[RigidPair, ConstraintReason] | None:
        """Two bodies that turn against a third about u and v, and against each other about w, so not at all.

        Rot(u, a) Rot(w, c) = Rot(v, b) has two solutions where the three directions are independent, one of them as
        the links stand where all angles are zero.
        """
        bodies = dict.fromkeys(body for turn in free for body in (turn.parent, turn.child))
        for root in bodies:
            ways = {body: own[0] for body, own in self._ways(free, root, UNTURNED).items()}
            for body, first in ways.items():
                inner = self._ways(free, body, first.constant)
                for other, second in ways.items():
                    for between in inner.get(other, ()):
                        volume = triple(first.axis, second.axis, between.axis)
                        fits = self.exact.equal(between.constant, second.constant)
                        if not self.witness.is_zero(volume) and fits and self._as_at_home(root, body, first):
                            axes = first.axis, between.axis
                            joints = (*second.joints, *between.joints)
                            reason = ConstraintReason(
                                body, root, *axes, first.joints, joints, first.constant, second.axis
                            )
                            return RigidPair(root, body, first.constant, ()), reason
        return None

    def _as_at_home(self, root: str, body: str, way: _Way) -> bool:
        """Whether a body stands at home as if it had not turned."""
        rotations = rotations_at_home(self.record)
        if not {root, body} <= rotations.keys() or any(
            sympy.sympify(part).free_symbols for row in way.constant for part in row
        ):
            return False
        apart = rotations[root].T @ rotations[body] - np.array(sympy.Matrix(way.constant).evalf(30), dtype=float)
        return bool(np.max(np.abs(apart)) < HOME)

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

    def _side(self, body: str, bodies: Mapping[str, tuple[str, Matrix]]) -> Vector | None:
        """From one joint of a body to another, or the direction in which parts of it slide, in the body's frame."""
        for link, (own, inside) in bodies.items():
            if own == body and link in self.record.links:
                start, *points = (point_on(self.symbols, joint, link) for joint in self._joints_of(link))
                sides = [subtract(point, start) for point in points]
                sides += [axis for joint in self._joints_of(link) for axis in slides(self.symbols, joint, link)]
                for side in sides:
                    if any(side):
                        return apply(inside, side)
        return None

    def _joints_of(self, link: str) -> list[Joint]:
        return [joint for joint in self.record.joints.values() if link in (joint.parent, joint.child)]

    def _across(self, body: str, side: Vector | None, constant: Matrix, hinge: Vector) -> Vector:
        """The direction of a rod across its hinge, where psi and phi are zero; along the hinge it may reach too."""
        if side is None:
            raise NotDerivedError(f"{body}: all its joints have one point, so it has no direction")
        along = apply(constant, side)
        across = self.exact.tidied(subtract(along, scaled(hinge, dot(along, hinge))))
        if not any(across):
            raise NotDerivedError(f"{body} reaches along its hinge alone")
        return self.exact.tidied(self.exact.unit(across))

    def _rods(
        self, links: Mapping[str, Orientation], bodies: Mapping[str, tuple[str, Matrix]], first_number: int
    ) -> dict[str, Orientation]:
        """Rods between two ball or universal joints, each one link or two that slide on each other."""
        together = {}
        for group in self.record.generalised.values():
            if group.kind == "P(4S)":
                first, second = rods_of(self.record, group)
                together[second] = first
        lines: dict[str, Vector] = {}
        for body in dict.fromkeys(own for own, _ in bodies.values()):
            own = [link for link, (other, _) in bodies.items() if other == body and link in self.record.links]
            ends = [joint for joint in self.record.joints.values() if (joint.parent in own) != (joint.child in own)]
            held = len(ends) == len(("near", "far")) and all(joint.type.ball or joint.type.turns > 1 for joint in ends)
            if own and held and not links.keys() & {*own}:
                side = self._side(body, bodies)
                if side is not None:
                    lines |= dict.fromkeys(own, self.exact.unit(side))
        alone = [body for body in dict.fromkeys(bodies[link][0] for link in lines) if body not in together]
        numbers = {body: number for number, body in enumerate(alone, start=first_number)}
        rods = ((link, *bodies[link], line) for link, line in lines.items())
        return {
            link: Orientation(inside, line=line, rod=numbers[together.get(body, body)])
            for link, body, inside, line in rods
        }
