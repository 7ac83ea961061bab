"""What it means that a factor of det Jp or det Jq vanishes: links that are parallel, coplanar, across, or meet.

A meaning is a polynomial of the lines of links, as the triple product of three. It is the factor's if their quotient
is the same at several draws of everything but the dimensions, modulo a large prime: then they differ by a formula of
dimensions alone, on all that closes the loops.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy

from assur.derivation.hinges import point_on
from assur.derivation.linear import never_zero
from assur.derivation.link_lines import LinkLine, LinkLines
from assur.derivation.parasitic_rate import RIGHT_ANGLE, UNSAID, parasitic_circle
from assur.derivation.phrases import (
    GeometricPhrase,
    NamedDirection,
    NamedJoint,
    PhrasePart,
    joined,
    listed,
    phrase,
)
from assur.derivation.reach_meanings import ReachMeanings
from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import Element, ModularWitness
from assur.model.pose import LENGTHS
from assur.numerics.vectors import Vector, add, apply, cross, dot, subtract, triple

DRAWS = 6
"""Each on another branch, so that quantities that agree on some branches are told apart."""
FIRST = {
    "parallel": "the platform can move at first order while every input stands",
    "serial": "an input can move at first order while the platform stands",
}
SHARED = "both determinants vanish, and the velocity equations say too little"
BASE: tuple[Vector, ...] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@dataclass(frozen=True, eq=False)
class FactorMeanings:
    """The meanings of the factors of an inverse problem that was solved."""

    solution: AnalyticSolution

    def of(self, factor: sympy.Expr, kind: str, *, shared: bool = False) -> GeometricPhrase:
        """What it means that a factor vanishes, which both determinants may have.

        >>> from assur.derivation.solution import analytic_solution
        >>> from assur.model.registry import load_record
        >>> c1, s1, c2, s2 = sympy.symbols("cos_rod1 sin_rod1 cos_rod2 sin_rod2", real=True)
        >>> own = FactorMeanings(analytic_solution(load_record("fivebar"), "inverse"))
        >>> own.of(c1 * s2 - c2 * s1, "parallel").text
        'rod 1 and rod 2 are parallel'
        """
        if not factor.free_symbols - {*self.solution.symbols.parameters.values()}:
            return phrase("it never vanishes" if never_zero(factor) else "it vanishes at special dimensions alone")
        if factor == circle_of("theta")[0]:
            return phrase(RIGHT_ANGLE)
        values = self._values(factor)
        if self._alike(values, self._values(sympy.Integer(1))):
            return phrase("it never vanishes")
        along = [(axis, name) for own, axis, name in self._singles if self._alike(values, own)]
        if along:
            (text, plural, axis), _ = along[0]
            names = [name for (_, _, other), name in along if self._same(axis, other)]
            places, links = joined(list(dict.fromkeys(names)))
            return phrase(f"{places} {text if len(links) == 1 else plural}", *links, axis)
        for candidate, meaning in itertools.chain(self._candidates, self._last_candidates):
            if self._alike(values, candidate):
                return meaning
        return phrase(SHARED if shared else FIRST[kind])

    def proportional(self, first: sympy.Expr, second: sympy.Expr) -> bool:
        """Whether two formulas differ by a formula of dimensions alone, on all that closes the loops."""
        return self._alike(self._values(first), self._values(second))

    @cached_property
    def lines(self) -> LinkLines:
        """Where links point and hang."""
        return LinkLines(self.solution.symbols, self.solution.placed, self.solution.loops)

    @cached_property
    def _witnesses(self) -> list[ModularWitness]:
        """One for each draw, modulo the same prime, at the same dimensions."""
        random = np.random.default_rng(0)
        own = []
        for number in range(DRAWS):
            witness = self.solution.drawn(1, [1 if plus else -1 for plus in random.integers(0, 2, self._choices)])
            for _ in range(number):
                witness.draw_again()
            own.append(witness)
        return own

    @property
    def _choices(self) -> int:
        return len(self.solution.roots)

    def _values(self, formula: sympy.Expr) -> list[Element]:
        return [witness.value(sympy.sympify(formula)) for witness in self._witnesses]

    def _alike(self, first: Sequence[Element], second: Sequence[Element]) -> bool:
        """Whether one is a multiple of the other over all draws."""
        place = next((k for k, own in enumerate(first) if own != (0, 0)), None)
        if place is None or second[place] == (0, 0):
            return False
        p = self._witnesses[0].field.p
        return all(
            _times(first[place], other, p) == _times(own, second[place], p)
            for own, other in zip(first, second, strict=True)
        )

    @cached_property
    def _candidates(self) -> list[tuple[list[Element], GeometricPhrase]]:
        """What two links and more may do: values at all draws, and in words."""
        return [(self._values(formula), meaning) for formula, meaning in self._formulas()]

    @cached_property
    def _last_candidates(self) -> list[tuple[list[Element], GeometricPhrase]]:
        """The same of lines within links that are not theirs, and of ways to stand that become one."""
        return [(self._values(formula), meaning) for formula, meaning in self._last_formulas()]

    @cached_property
    def _singles(self) -> list[tuple[list[Element], tuple[str, str, PhrasePart], PhrasePart]]:
        """What one link may do: values, in words of one link and of several with their axis, and the link."""
        return [
            (self._values(formula), words, self.lines.name(line.direction))
            for line in self._lines
            for formula, words in self._single(line)
        ]

    def _same(self, first: PhrasePart, second: PhrasePart) -> bool:
        if isinstance(first, NamedDirection) and isinstance(second, NamedDirection):
            return self.lines.exact.along(first.vector, second.vector)
        return first == second

    @cached_property
    def _lines(self) -> list[LinkLine]:
        return [line for own in self.solution.loops.directions if (line := self.lines.of(own)) is not None]

    def _formulas(self) -> Iterator[tuple[sympy.Expr, GeometricPhrase]]:
        parasitic = parasitic_circle(self.solution)
        for part in self.solution.sets:
            if parasitic is not None and parasitic in part.directions:
                yield from ((own.quantity, phrase(UNSAID, self.lines.name(parasitic))) for own in part.roots)
        for first, second in itertools.combinations(self._lines, 2):
            yield from self._pair(first, second)
        for three in itertools.combinations(self._lines, 3):
            text, names = joined([self.lines.name(own.direction) for own in three])
            a, b, c = (own.vector for own in three)
            yield triple(a, b, c), phrase(f"{text} are parallel to one plane", *names)
        yield from self._meeting()

    def _last_formulas(self) -> Iterator[tuple[sympy.Expr, GeometricPhrase]]:
        lines = [(own, line) for own in self.solution.loops.directions for line in self._within(own)]
        for (own, first), (other, second) in itertools.combinations(lines, 2):
            if own != other and self._turn_alike(first, second):
                (one, names), (two, more) = self._called(first), self._called(second)
                yield from self._turned(first, second, f"{one} and {two}", (*names, *more))
        reach = ReachMeanings(self.solution)
        for part in self.solution.sets:
            yield from ((root.quantity, reach.merged(part, root)) for root in part.roots)

    def _within(self, direction: UnknownDirection) -> Iterator[LinkLine]:
        """All lines of links that turn with a direction, and to the platform's point."""
        yield from self.lines.all(direction)
        if self.solution.symbols.record.platform.link in direction.links:
            yield from self.lines.to_platform(direction)

    def _called(self, line: LinkLine) -> tuple[str, tuple[PhrasePart, ...]]:
        """A line in words: its link where it is that one's own, else what it joins, or what slides along it."""
        if line == self.lines.of(line.direction):
            return "{}", (self.lines.name(line.direction),)
        first, second = line.joints
        end: PhrasePart = NamedJoint(second) if second else "the platform's point"
        if first == second:
            return "the slide of {}", (end,)
        return "the line from {} to {}", (NamedJoint(first), end)

    def _single(self, line: LinkLine) -> Iterator[tuple[sympy.Expr, tuple[str, str, PhrasePart]]]:
        """A link across a direction; where it turns, along the one across that and its axis."""
        for axis in (*BASE, *self.lines.fixed_axes.values()):
            across = dot(line.vector, axis)
            if line.axis is None:
                text, named = self._of(axis)
                yield across, (f"is across {text}", f"are across {text}", named)
            elif not self.lines.exact.along(line.axis, axis):
                text, named = self._of(cross(line.axis, axis))
                yield across, (f"lies along {text}", f"lie along {text}", named)

    def _of(self, axis: Vector) -> tuple[str, PhrasePart]:
        named = self.lines.named(axis)
        if isinstance(named, NamedJoint):
            return "the axis of {}", named
        return "{}", named or NamedDirection(axis)

    def _pair(self, first: LinkLine, second: LinkLine) -> Iterator[tuple[sympy.Expr, GeometricPhrase]]:
        text, names = joined([self.lines.name(own.direction) for own in (first, second)])
        p, q = first.vector, second.vector
        if self._turn_alike(first, second):
            yield from self._turned(first, second, text, names)
            alike = self.solution.symbols.witness.is_zero(first.square - second.square)
            for vector in (subtract(p, q), add(p, q)) if alike else ():
                for part in self._alone(vector):
                    yield part, phrase(f"{text} are parallel", *names)
            return
        for carrier, other in ((first, second), (second, first)):
            if carrier.axis is not None:
                own = [self.lines.name(line.direction) for line in (other, carrier)]
                yield (
                    triple(carrier.axis, carrier.vector, other.vector),
                    phrase("{} is parallel to the plane of {} and the axis of its turns", *own),
                )
        for joint, axis in self.lines.fixed_axes.items():
            yield (
                triple(axis, p, q),
                phrase(f"{text} and the axis of {{}} are parallel to one plane", *names, NamedJoint(joint)),
            )

    def _turn_alike(self, first: LinkLine, second: LinkLine) -> bool:
        """Whether two lines turn about one direction."""
        return first.axis is not None and second.axis is not None and self.lines.exact.along(first.axis, second.axis)

    def _turned(
        self, first: LinkLine, second: LinkLine, text: str, names: Sequence[PhrasePart]
    ) -> Iterator[tuple[sympy.Expr, GeometricPhrase]]:
        p, q = first.vector, second.vector
        yield triple(first.axis or (0, 0, 0), p, q), phrase(f"{text} are parallel", *names)
        yield dot(p, q), phrase(f"{text} are at right angles", *names)

    def _alone(self, vector: Vector) -> Iterator[sympy.Expr]:
        """The component of a vector that does not vanish, where only one along the axes of the base does not."""
        parts = [sympy.sympify(part) for part in vector]
        witness = self._witnesses[0]
        left = [part for part in parts if not witness.is_zero(part)]
        if len(left) == 1:
            yield left[0]

    def _meeting(self) -> Iterator[tuple[sympy.Expr, GeometricPhrase]]:
        """Three lines in the plane of a platform that turns in it."""
        pose = self.solution.symbols.record.platform.pose
        if {*pose} != {"x", "y", "phi"}:
            return
        for chosen in itertools.combinations(self._hung, len(pose)):
            rows = [
                [*(own.vector[LENGTHS.index(name)] for name in pose if name in LENGTHS), cross(place, own.vector)[2]]
                for own, _, place in chosen
            ]
            names = [part for own, name, _ in chosen for part in (self.lines.name(own.direction), NamedJoint(name))]
            text = f"the lines {listed(['along {} at {}'] * len(chosen))} meet in one point or are parallel"
            yield sympy.Matrix(rows).det(method="berkowitz"), phrase(text, *names)

    @property
    def _hung(self) -> list[tuple[LinkLine, str, Vector]]:
        """Lines of links that are joined to the platform: at which joint, and where that is from its point."""
        record, geometry = self.solution.symbols.record, self.solution.symbols.geometry
        platform = self.solution.placed.links[record.platform.link]
        hung = []
        for line in self._lines:
            joints = {joint.name: joint for link in line.direction.links for joint in self.lines.joints(link)}
            for name, joint in joints.items():
                if record.platform.link in (joint.parent, joint.child):
                    point = point_on(self.solution.symbols, joint, record.platform.link)
                    hung.append((line, name, apply(platform.constant, subtract(point, geometry.platform))))
                    break
        return hung


def _times(a: Element, b: Element, p: int) -> Element:
    return (a[0] * b[0] - a[1] * b[1]) % p, (a[0] * b[1] + a[1] * b[0]) % p
