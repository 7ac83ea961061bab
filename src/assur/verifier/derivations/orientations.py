"""Orientations as a derivation claims them, each held against what the joints of the file say."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from assur.verifier.derivations.assembly import FileAssembly
from assur.verifier.derivations.known_formulas import KnownFormulas
from assur.verifier.derivations.terms import Term, term
from assur.verifier.derivations.turning import ClaimedTurn, Hop, fixes, is_rotation, reached, rods, same
from assur.verifier.reading import require
from assur.verifier.vectors import ONE, Matrix, Vector, apply, cross, dot, plus, product, subtract, transposed


class OrientationCheck:
    """The orientations of a proof.

    Args:
        assembly: the joint graph; reasons that hold are added to its hops.
        formulas: by which texts are read.
        proof: as it is written.

    Attributes:
        ways: links that may stand in one way more than they are said to, "<link> against <carrier>".
    """

    def __init__(self, assembly: FileAssembly, formulas: KnownFormulas, proof: Mapping[str, Any]) -> None:
        self.assembly, self.mechanism, self.formulas, self.proof = assembly, assembly.mechanism, formulas, proof
        self.zero = formulas.zero
        self.ways: list[str] = []

    def _vector(self, parts: Any) -> Vector:
        x, y, z = (self._entry(self.formulas.read(part)) for part in parts)
        return x, y, z

    def _matrix(self, rows: Any) -> Matrix:
        a, b, c = map(self._vector, rows)
        return a, b, c

    def _tidy(self, turn: Matrix) -> Matrix:
        a, b, c = (tuple(map(self._entry, row)) for row in turn)
        return a, b, c

    def _entry(self, own: Any) -> Any:
        """0, 1 and -1 where a number is that."""
        constant = self.formulas.quotients([own], {}).constant(own) if isinstance(own, Term) else None
        return int(constant) if constant in (0, 1, -1) else own

    def _reached(self, root: str, axis: Vector | None) -> dict[str, Matrix]:
        return reached(self.assembly.hops, root, axis, self.zero, self._tidy)

    def turns(self) -> dict[str, ClaimedTurn]:
        """Orientations as they are claimed, each held against what the joints say."""
        for reason in self.proof["reasons"]:
            self._reason(reason)
        claimed = (self.assembly.claimed(own, self._vector) for own in self.proof["orientations"])
        turns = {turn.link: turn for turn in claimed}
        fixed = self._reached(self.mechanism.base, None)
        fine = {"circle": self._on_circle, "carried": self._carried, "triangle": self._by_balls, "rod": self._on_rod}
        for link, turn in turns.items():
            still = turn.kind == "fixed" and link in fixed and same(fixed[link], turn.constant, self.zero)
            so = still or (turn.kind in fine and fine[turn.kind](turn, turns))
            require(so, f"the joints do not say that {link} is turned so")
        return turns

    def _by_balls(self, turn: ClaimedTurn, turns: Mapping[str, ClaimedTurn]) -> bool:
        """Whether three balls hold a link, which are not on a line, and nothing else does.

        Vectors between them that close and keep their lengths are those of one rotation, and of no other.
        """
        triangle = turn.triangle
        if triangle is None:
            return False
        inside = self._reached(triangle.link, None)
        leaving = self._leaving(inside)
        held = leaving.keys() == {*triangle.joints} and {*leaving.values()} == {"spherical"}
        between, own = inside.get(turn.link), turns[triangle.link]
        if not held or between is None or self.mechanism.base in inside or own.kind != "triangle":
            return False
        alike = own.triangle is not None and own.triangle.sides == triangle.sides
        fits = same(product(own.constant, between), turn.constant, self.zero) and is_rotation(turn.constant, self.zero)
        return alike and fits and not self.zero(triangle.size)

    def _reason(self, reason: Mapping[str, Any]) -> None:
        """A link that hangs on another along two directions does not turn against it."""
        carrier, link, constant = str(reason["carrier"]), str(reason["link"]), self._matrix(reason["constant"])
        first, second = self._vector(reason["first"]), self._vector(reason["second"])
        fine = is_rotation(constant, self.zero) and self._turned_about(first, carrier, link, constant)
        if "third" in reason:
            fine = fine and self._triangle(first, second, self._vector(reason["third"]), carrier, link, constant)
            self.ways.append(f"{link} against {carrier}")
        else:
            across = [self.zero(part) for part in cross(first, second)]
            fine = fine and not all(across) and self._turned_about(second, carrier, link, constant)
        require(fine, f"the joints do not say that {link} does not turn against {carrier}")
        self.assembly.hops.append(Hop(carrier, link, constant))

    def _turned_about(self, axis: Vector, carrier: str, link: str, constant: Matrix) -> bool:
        """Whether a link turns against its carrier about a direction alone, and is there by `constant` as it turns."""
        own = self._reached(carrier, axis).get(link)
        return own is not None and fixes(product(constant, transposed(own)), axis, self.zero)

    def _triangle(self, u: Vector, w: Vector, v: Vector, carrier: str, link: str, constant: Matrix) -> bool:
        """Whether some link turns about v against the carrier and about w against the link, which `constant` lets meet.

        Rot(u, a) Rot(w, c) M = Rot(v, b), and M = Rot(w, c') Rot(v, b') where w . M v = w . v. So v . Rot(u, a) w is as
        it is at a = 0, which a has two values for where u, v and w are independent.
        """
        on_carrier, on_link = self._reached(carrier, v), self._reached(link, apply(transposed(constant), w))
        between = (
            product(product(constant, on_link[own]), transposed(on_carrier[own]))
            for own in on_carrier
            if own in on_link
        )
        meet = any(self.zero(dot(w, subtract(apply(turn, v), v))) for turn in between)
        return meet and not self.zero(dot(u, cross(v, w)))

    def _on_circle(self, turn: ClaimedTurn, turns: Mapping[str, ClaimedTurn]) -> bool:
        """It turns about the axis alone, as far as the first link does that has the same unknowns."""
        axis = turn.axis
        own = self._reached(self.mechanism.base, axis).get(turn.link)
        if axis is None or own is None or not self.zero(plus(dot(axis, axis), -1)):
            return False
        psi = product(turn.constant, transposed(own))
        leader = next(o for o in turns.values() if o.circle == turn.circle and o.kind == "circle")
        if turn.circle is None or leader is turn:
            return is_rotation(psi, self.zero) and fixes(psi, axis, self.zero)
        return self._same(axis, leader.axis) and self._stands(turn, leader)

    def _carried(self, turn: ClaimedTurn, turns: Mapping[str, ClaimedTurn]) -> bool:
        """A link on a hinge of one that turns by the same circle: Rot(axis, psi) Rot(hinge, phi) constant."""
        hinge = turn.hinge
        if turn.second is None or hinge is None or not self.zero(plus(dot(hinge, hinge), -1)):
            return False
        leader = next(own for own in turns.values() if own.second == turn.second)
        if leader is not turn:
            alike = (leader.axis, leader.circle, leader.hinge) == (turn.axis, turn.circle, hinge)
            return alike and self._stands(turn, leader)
        return any(self._hung(own, turn, hinge, turns) for hop in self.assembly.hops for own in (hop, hop.back))

    def _hung(self, hop: Hop, turn: ClaimedTurn, hinge: Vector, turns: Mapping[str, ClaimedTurn]) -> bool:
        """Whether a hop is that hinge, seen from what carries it."""
        carrier = turns.get(hop.start)
        if carrier is None or carrier.kind != "circle" or carrier.circle != turn.circle:
            return False
        return self._same(carrier.axis, turn.axis) and self._about(hop, carrier.constant, turn, hinge)

    def _about(self, hop: Hop, carried: Matrix, turn: ClaimedTurn, hinge: Vector) -> bool:
        """Whether a link turns by a hop about a hinge against its carrier, by what it is said to be turned at zero."""
        inside = self._reached(turn.link, None)
        if hop.axis is None or hop.end not in inside:
            return False
        whole = product(product(carried, hop.after), transposed(inside[hop.end]))
        # the carrier's psi may count from elsewhere: then the hinge tells from where
        turned = product(turn.constant, transposed(whole))
        along = all(map(self.zero, cross(apply(carried, hop.axis), hinge)))
        return along and fixes(turned, hinge, self.zero) and is_rotation(turned, self.zero)

    def _on_rod(self, turn: ClaimedTurn, turns: Mapping[str, ClaimedTurn]) -> bool:
        """A link between balls, with what slides on it, or one on a hinge across the axis of its carrier.

        Its line is not along that hinge. So Rot(axis, psi) Rot(hinge, phi) takes it to any direction but for a few.
        """
        line, hinge = turn.line, turn.hinge
        if turn.rod is None or line is None or not self.zero(plus(dot(line, line), -1)):
            return False
        leader = next(own for own in turns.values() if own.rod == turn.rod)
        parallel = any(
            {leader.link, turn.link} == {*rods(self.mechanism, own)} for own in self.mechanism.parallelograms
        )
        axis = turn.axis
        if hinge is None and (leader is turn or parallel):
            return self._between_balls(turn.link, line) and same(turn.constant, ONE, self.zero)
        if hinge is None:
            return self._same(turn.line, leader.line) and self._stands(turn, leader)
        if axis is None or not self.zero(dot(hinge, axis)) or all(map(self.zero, cross(hinge, line))):
            return False
        if leader is not turn:
            return self._same(turn.line, leader.line) and self._stands(turn, leader)
        return any(self._carries(own, turn, axis, hinge) for hop in self.assembly.hops for own in (hop, hop.back))

    def _between_balls(self, link: str, line: Vector) -> bool:
        """Whether ball joints alone hold a link and what does not turn against it, and at most one universal joint.

        That lets the line point anywhere too, if its axes are perpendicular, and the link's to the line.
        """
        inside = self._reached(link, None)
        leaving = self._leaving(inside)
        crosses = [name for name, kind in leaving.items() if kind == "universal"]
        balls = len(crosses) < len(leaving) and {*leaving.values()} <= {"spherical", "universal"}
        fine = self.mechanism.base not in inside and balls and len(crosses) < 2
        return fine and all(self._across_universal(name, inside, line) for name in crosses)

    def _across_universal(self, name: str, inside: Mapping[str, Matrix], line: Vector) -> bool:
        first, second = (own for own in self.assembly.hops if own.joint == name)
        near = second.back if second.end in inside else first
        if first.axis is None or second.axis is None or near.axis is None:
            return False
        return self.zero(dot(first.axis, second.axis)) and self.zero(dot(apply(inside[near.start], near.axis), line))

    def _carries(self, hop: Hop, turn: ClaimedTurn, axis: Vector, hinge: Vector) -> bool:
        """Whether a hop is the hinge of a rod: Rot(axis, psi) Rot(hinge, phi) constant is its orientation."""
        carried = self._reached(self.mechanism.base, axis).get(hop.start)
        return carried is not None and self._about(hop, carried, turn, hinge)

    def shared(self, row: Term, claim: Mapping[str, Any], turns: Mapping[str, ClaimedTurn]) -> bool:
        """Whether it vanishes, as an axis of a joint is one in both links, either first, or at one angle to a rod."""
        known = self.formulas.known
        if any(self.zero(row - term(own.leaning(known, self.zero))) for own in turns.values()):
            return True
        x, y, z = map(self.formulas.checked, claim["along"])
        for hop in self.assembly.hops:
            if hop.axis is None or hop.joint != claim["joint"] or not {hop.start, hop.end} <= turns.keys():
                continue
            ends = ((own.start, own.axis or hop.axis) for own in (hop, hop.back))
            first, second = (turns[link].image(axis, known, self.zero) for link, axis in ends)
            gap = term(dot((x, y, z), subtract(first, second)))
            if self.zero(row - gap) or self.zero(row + gap):
                return True
        return False

    def _stands(self, turn: ClaimedTurn, leader: ClaimedTurn) -> bool:
        """Whether a link's constant is that of another which it does not turn against."""
        between = self._reached(leader.link, None).get(turn.link)
        return between is not None and same(product(leader.constant, between), turn.constant, self.zero)

    def _same(self, first: Vector | None, second: Vector | None) -> bool:
        """Whether two vectors are one."""
        return first is not None and second is not None and all(map(self.zero, subtract(first, second)))

    def _leaving(self, inside: Mapping[str, Matrix]) -> dict[str, str]:
        """Joints that hold some links, with their types."""
        joints = self.mechanism.joints.items()
        return {name: own.type for name, own in joints if (own.parent in inside) != (own.child in inside)}
