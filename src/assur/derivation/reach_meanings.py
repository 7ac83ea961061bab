"""What it means that a radicand is negative or a condition fails: which links do not reach, which circles coincide.

A set is links that hang on what is known, each on a circle or a sphere about a joint, and meet. Two circles about
parallel axes meet unless their centres are too far apart or too near; where their equations are one they coincide.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy

from assur.derivation.circle_pairs import PairEliminant
from assur.derivation.elimination import Root, SolvedSet
from assur.derivation.linear import Form
from assur.derivation.link_lines import LinkLine, LinkLines
from assur.derivation.phrases import (
    GeometricPhrase,
    NamedDirection,
    NamedJoint,
    NamedLink,
    PhrasePart,
    joined,
    listed,
    phrase,
)
from assur.derivation.solution import AnalyticSolution
from assur.derivation.unknown_directions import UnknownDirection
from assur.joint_graph.tree import joint_graph
from assur.numerics.vectors import Vector, add, cross, scaled

ZERO = sympy.Integer(0)
PAIR = 2


@dataclass(frozen=True, eq=False)
class ReachMeanings:
    """The meanings of the radicands and conditions of a solution."""

    solution: AnalyticSolution

    @cached_property
    def lines(self) -> LinkLines:
        """Where links point and hang."""
        return LinkLines(self.solution.symbols, self.solution.placed, self.solution.loops)

    @cached_property
    def radicands(self) -> Mapping[sympy.Symbol, GeometricPhrase]:
        """Radicand -> what it means that it is negative.

        >>> from assur.derivation.solution import analytic_solution
        >>> from assur.model.registry import load_record
        >>> own = ReachMeanings(analytic_solution(load_record("zeng2019"), "direct")).radicands
        >>> [meaning.text for meaning in own.values()][0]
        'B1 and B2 are too far apart for link 9 and link 10 to meet at link 11'
        """
        return {
            root.radicand: _Meeting(self, part).radicand(root) for part in self.solution.sets for root in part.roots
        }

    def leaning(self, rod: UnknownDirection, axis: Vector, too_far: bool = False) -> GeometricPhrase:
        """What it means that a rod points along the axis of what carries it, or too far along it to lean as it does."""
        return phrase(f"{{}} points{' too far' * too_far} along {{}}", self.lines.name(rod), NamedDirection(axis))

    def condition(self, part: SolvedSet, condition: sympy.Expr) -> GeometricPhrase:
        """What it means that a condition of a set fails."""
        return _Meeting(self, part).condition(condition)

    def merged(self, part: SolvedSet, root: Root) -> GeometricPhrase:
        """What it means that both solutions of a root are one."""
        return _Meeting(self, part).merged(root)

    def known_links(self, part: SolvedSet) -> set[str]:
        """Links whose place is known before a set is solved."""
        record, loops = self.solution.symbols.record, self.solution.loops
        solved = self.solution.sets[: self.solution.sets.index(part)]
        before = {own.links for other in solved for own in other.directions}
        unknown = {link for own in loops.directions if own.links not in before for link in own.links}
        known = {record.base} | ({record.platform.link} if self.solution.symbols.problem == "inverse" else set())
        still = [joint for joint in record.joints.values() if not self._slides(joint.name)]
        grown = True
        while grown:
            more = {
                far
                for joint in still
                for near, far in ((joint.parent, joint.child), (joint.child, joint.parent))
                if near in known and far not in unknown
            }
            grown = not more <= known
            known |= more
        return known

    def _slides(self, name: str) -> bool:
        """Whether a joint slides by a length that is not given."""
        joint = self.solution.symbols.record.joints[name]
        start = joint_graph(self.solution.symbols.record).slices[name].start
        lengths = (start + first for step, first in joint.type.places if step.kind in ("slide", "screw"))
        return any(index not in self.solution.symbols.locked for index in lengths)


class _Meeting:
    """The links of a set, and what they meet about."""

    def __init__(self, meanings: ReachMeanings, part: SolvedSet) -> None:
        self.lines, self.part = meanings.lines, part
        self.witness = meanings.solution.symbols.witness
        self.known = meanings.known_links(part)
        symbols = meanings.solution.symbols
        self.poses = symbols.record.platform.link if symbols.problem == "inverse" else None
        self.own = {own: self.lines.of(own) for own in part.directions}
        self.meanings, loops = meanings, meanings.solution.loops
        forms = [form for own in part.directions for form in loops.cranks.get(own, ())]
        used = {symbol for form in forms for share in form.values() for symbol in share.free_symbols}
        self.rods = [own for own in loops.directions if own.kind == "rod" and {*own.unknowns} & used]

    def radicand(self, root: Root) -> GeometricPhrase:
        if self.rods:
            return self._leaning(too_far=True)
        stroke = self._stroke(root.radicand)
        if stroke is not None:
            if len(self._ends(stroke)) > PAIR:  # the vector joins two of them
                return phrase("the vector along which {} slides is shorter than its offset", self.lines.name(stroke))
            return self._offset(root, stroke, "nearer than")
        return self._alone() if len(self.part.directions) == 1 else self._together()

    def merged(self, root: Root) -> GeometricPhrase:
        stroke = self._stroke(root.radicand)
        if stroke is not None and len(self._ends(stroke)) <= PAIR:
            return self._offset(root, stroke, "as near as")
        text, names = joined([self.lines.name(own) for own in self.part.directions])
        return phrase(f"both ways in which {text} may stand are one", *names)

    def _offset(self, root: Root, stroke: UnknownDirection, how: str) -> GeometricPhrase:
        """How far the ends of a vector are apart that slides at some distance; they coincide where there is none."""
        text, names = joined(self._ends(stroke))
        if any(own.symbol == root.radicand and own.formula.is_Add for own in self.part.definitions):
            return phrase(f"{text} are {how} the offset of {{}}", *names, self.lines.name(stroke))
        return phrase(f"{text} coincide", *names)

    def _leaning(self, too_far: bool = False) -> GeometricPhrase:
        axis = self.meanings.solution.placed.links[self.part.directions[0].links[0]].axis
        return self.meanings.leaning(self.rods[0], axis or (0, 0, 0), too_far)

    def condition(self, condition: sympy.Expr) -> GeometricPhrase:
        if self.rods:
            return self._leaning()
        stroke = self._stroke(condition)
        if stroke is not None:
            if len(ends := self._ends(stroke)) > PAIR:
                return phrase("the vector along which {} slides has no length", self.lines.name(stroke))
            text, names = joined(ends)
            return phrase(f"{text} coincide", *names)
        own = self.part.eliminant
        if isinstance(own, PairEliminant) and own.pair is not None and condition in own.divisors:
            first, last = own.pair.circles
            free = last if condition == own.divisors[0] else first
            return phrase("{} may stand in two ways at one angle of {}", *map(self.lines.name, (free, own.direction)))
        if condition in self.part.shared and len(self.part.directions) > 1:
            text, names = self._curves()
            return phrase(f"{text}{self._shift(', shifted to meet at {},')} coincide", *names, *self._floating)
        if condition.is_Symbol and condition.name.startswith("N") and len(self.part.directions) > 1:
            return self._one_centre()
        line = self.own[self.part.directions[0]] if len(self.part.directions) == 1 else None
        if line is not None and self.witness.is_zero(condition - line.square):
            return phrase("{} and {} coincide", *map(NamedJoint, line.joints))
        text, names = joined([self.lines.name(own) for own in self.part.directions])
        return phrase(f"the linear equations of {text} lose rank", *names)

    def _alone(self) -> GeometricPhrase:
        """One link, between two joints whose distance is known along a direction, or across one."""
        (direction,), equations = self.part.directions, self.part.equations
        line = self.own[direction]
        name = self.lines.name(direction)
        if line is None:
            return phrase("{} does not reach", name)
        joints = [NamedJoint(joint) for joint in line.joints]
        along, word = self._along(direction, line, equations), "along"
        if direction.kind == "rod" and len(equations) > 1:
            first, second = (self._normal(form, direction.unknowns) for form in equations[:2])
            along, word = cross(first, second), "seen along"
        named = None if along is None else self.lines.named(along)
        if named is None:
            return phrase("{} and {} are too far apart for {}", *joints, name)
        of = "the axis of {}" if isinstance(named, NamedJoint) else "{}"
        comma = "," if word.startswith("seen") else ""
        return phrase(f"{{}} and {{}} are too far apart{comma} {word} {of}{comma} for {{}}", *joints, named, name)

    def _along(self, direction: UnknownDirection, line: LinkLine, equations: Sequence[Form]) -> Vector | None:
        """The direction along which one equation says how far the link reaches."""
        if line.axis is None or direction.kind != "circle" or not equations:
            return None
        a, b = (equations[0].get(own, ZERO) for own in direction.unknowns)
        return add(scaled(line.still, a), scaled(cross(line.axis, line.still), b))

    def _normal(self, form: Form, unknowns: Sequence[sympy.Symbol]) -> Vector:
        x, y, z = (form.get(own, ZERO) for own in unknowns)
        return x, y, z

    def _together(self) -> GeometricPhrase:
        if not self._plane:
            text, names = self._curves()
            meet = self._shift(" do not meet at {}") or " do not meet"
            return phrase(f"{text}{meet}", *names, *self._floating)
        first, second = (self.own[own] for own in self.part.directions)
        alike = first is not None and second is not None and self.witness.is_zero(first.square - second.square)
        far = "too far apart" if alike else "too far apart or too near"
        centres, links = joined(self._centres), joined([self.lines.name(own) for own in self.part.directions])
        at = self._shift(" at {}")
        return phrase(f"{centres[0]} are {far} for {links[0]} to meet{at}", *centres[1], *links[1], *self._floating)

    def _one_centre(self) -> GeometricPhrase:
        """The squares of the line on which curves meet add up to zero."""
        text, names = self._curves()
        shift = self._shift(", shifted to meet at {},")
        if self._plane:
            return phrase(f"{text}{shift} have one centre", *names, *self._floating)
        circles = [own for own in self.part.directions if own.kind == "circle"]
        if not circles:
            return phrase(f"the centres of {text}{shift} lie on one line", *names, *self._floating)
        spheres, inner = joined([NamedJoint(name) for own, name in self._hangs.items() if own.kind == "rod" and name])
        centre = self._hangs[circles[0]]
        if len(circles) > 1 or not inner or centre is None:
            return phrase(f"{text}{shift} have one line of centres", *names, *self._floating)
        lie = "lies" if len(inner) == 1 else "lie"
        return phrase(f"{spheres} {lie} on the axis of {{}}", *inner, NamedJoint(centre))

    @property
    def _plane(self) -> bool:
        """Whether two links turn about parallel axes, each on a joint."""
        lines = [self.own[own] for own in self.part.directions]
        axes = [line.axis for line in lines if line is not None and line.axis is not None]
        if len(axes) != len(lines) or len(lines) != PAIR:
            return False
        return None not in self._hangs.values() and self.lines.exact.along(*axes)

    def _curves(self) -> tuple[str, tuple[PhrasePart, ...]]:
        """The circles and spheres of all links, each about its joint."""
        kinds = [own.kind for own in self.part.directions]
        places = [self._about(own) for own in self.part.directions]
        names = tuple(name for _, inner in places for name in inner)
        if len({*kinds}) == 1:
            head = "the circles of " if kinds[0] == "circle" else "the spheres of "
            return head + listed([text if k == 0 else f"of {text}" for k, (text, _) in enumerate(places)]), names
        heads = ["the circle of " if kind == "circle" else "the sphere of " for kind in kinds]
        return listed([head + text for head, (text, _) in zip(heads, places, strict=True)]), names

    def _about(self, direction: UnknownDirection) -> tuple[str, tuple[PhrasePart, ...]]:
        centre = self._hangs[direction]
        name = self.lines.name(direction)
        return ("{}", (name,)) if centre is None else ("{} about {}", (name, NamedJoint(centre)))

    @cached_property
    def _hangs(self) -> Mapping[UnknownDirection, str | None]:
        return {own: self.lines.centre(own, self.part.directions, self.known) for own in self.part.directions}

    @property
    def _centres(self) -> list[PhrasePart]:
        return [NamedJoint(centre) for centre in self._hangs.values() if centre is not None]

    @cached_property
    def _floating(self) -> tuple[NamedLink, ...]:
        """The link on which the set's links meet, where it is one that is not known."""
        moving = {link for own in self.part.directions for link in own.links}
        ends = [
            {self._other(joint.parent, joint.child, link) for link in own.links for joint in self.lines.joints(link)}
            for own in self.part.directions
        ]
        common = set.intersection(*ends) - self.known - moving
        return (NamedLink(min(common)),) if common else ()

    def _other(self, parent: str, child: str, link: str) -> str:
        return parent if child == link else child

    def _shift(self, text: str) -> str:
        return text if self._floating else ""

    def _stroke(self, symbol: sympy.Expr) -> UnknownDirection | None:
        """The vector with a length in it, of whose square a radicand or condition is."""
        formulas = {own.symbol: own.formula for own in self.part.definitions}
        used = sympy.sympify(formulas.get(symbol, symbol)).free_symbols
        used |= {inner for own in used if own in formulas for inner in formulas[own].free_symbols}
        strokes = (own for own in self.part.directions if own.kind == "stroke")
        return next((own for own in strokes if used & {*own.unknowns}), None)

    def _ends(self, direction: UnknownDirection) -> list[PhrasePart]:
        """What the vector of links that slide along each other joins: joints at both ends, or the platform's point."""
        links = {*direction.links}
        joints = [joint for link in direction.links for joint in self.lines.joints(link)
                  if not {joint.parent, joint.child} <= links]  # fmt: skip
        if self.poses in links:
            joints = [joint for joint in joints if {joint.parent, joint.child} - links <= self.known]
        names: list[PhrasePart] = [NamedJoint(name) for name in dict.fromkeys(joint.name for joint in joints)]
        return [*names, "the platform's point"] if self.poses in links else names
