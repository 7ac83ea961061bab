"""Orientations of links: which do not turn, and which turn about one fixed direction, or about an axis that does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from assur.derivation.ball_triangles import SIDES, BallTriangle, ball_triangles
from assur.derivation.constraint_reasons import ConstraintReason, held
from assur.derivation.exact_vectors import ExactVectors
from assur.derivation.hinges import Hinge, hinges, point_on, rods_of, slides
from assur.derivation.named_directions import NamedDirections
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.posed_orientation import posed_orientation
from assur.derivation.symbols import GivenSymbols
from assur.derivation.turning_bodies import TurningBodies, TurningWay
from assur.joints.steps import UNTURNED
from assur.model.mechanism import Joint
from assur.numerics.vectors import Matrix, Vector, apply, dot, product, subtract, transposed


@dataclass(frozen=True)
class Orientation:
    """Rot(axis, psi) constant; psi of circle number `circle`. Fixed where there is no axis.

    A rod has the number `rod`, which rods that stay parallel share, and a direction `line` in the frame of `constant`.
    It lies between ball joints, or on a hinge across the axis about which what carries it turns, across that hinge or
    oblique to it: Rot(axis, psi) Rot(hinge, phi) constant. Another link on a hinge has phi of circle number `second`.
    One that three balls hold turns as the sides of their `triangle` do, which is in the frame of `constant`.
    """

    constant: Matrix = UNTURNED
    axis: Vector | None = None
    circle: int | None = None
    line: Vector | None = None
    rod: int | None = None
    hinge: Vector | None = None
    second: int | None = None
    triangle: BallTriangle | None = None


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

    @property
    def sides(self) -> dict[str, tuple[str, str]]:
        """Vector along the side of a triangle -> the ball joints that it is from and to."""
        named: dict[BallTriangle, str] = {}
        for link, own in self.links.items():
            if own.triangle is not None:
                named.setdefault(own.triangle, link.replace(".", "_"))
        return {f"{name}_{ends}": own.ends(ends) for own, name in named.items() for ends in SIDES}


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
        turning = TurningBodies(self.symbols, tuple(joints))
        while (more := held(turning)) is not None:
            stiff, reason = more
            joints.append(stiff)
            reasons.append(reason)
            turning = TurningBodies(self.symbols, tuple(joints))
        free, bodies = turning.free, turning.of_links
        root, inside_root = bodies[self.record.base]
        ways = {body: own[0] for body, own in turning.ways(root, transposed(inside_root)).items()}
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
            line = self._reach(body, self._side(body, bodies), constant, hinge)
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
        triangles = ball_triangles(self.symbols, bodies, links)
        links |= {
            link: Orientation(inside, triangle=triangles[body])
            for link, (body, inside) in bodies.items()
            if body in triangles
        }
        missing = [link for link in self.record.links if link not in links]
        if missing:
            why = "; ".join(
                f"{link} turns in space, held by {', '.join(joint.name for joint in self._joints_of(link))}"
                for link in missing
            )
            raise NotDerivedError(
                f"{', '.join(missing)}: neither fixed in orientation, nor turning about one direction or about an axis "
                f"that does: {why}"
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

    def _hinged(
        self, free: Sequence[Hinge], ways: Mapping[str, TurningWay]
    ) -> dict[str, tuple[TurningWay, Vector, Matrix]]:
        """Rods on hinges: how what carries them turns, the hinge's direction and C, both where its psi is zero."""
        self._carrier: dict[str, str] = {}
        hinged: dict[str, tuple[TurningWay, Vector, Matrix]] = {}
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

    def _reach(self, body: str, side: Vector | None, constant: Matrix, hinge: Vector) -> Vector:
        """The direction in which a rod reaches, across its hinge or oblique to it, where psi and phi are zero."""
        if side is None:
            raise NotDerivedError(f"{body}: all its joints have one point, so it has no direction")
        along = apply(constant, side)
        if self.exact.along(along, hinge):
            raise NotDerivedError(f"{body} reaches along its hinge alone")
        return self.exact.tidied(self.exact.unit(along))

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
