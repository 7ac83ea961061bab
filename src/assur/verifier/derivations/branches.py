"""Branches of a derivation held against the joint graph of the file: modulo a prime, at a place that is drawn.

A formula that is wrong closes the loops there by chance alone, with a probability of its degree over 2^160. Of a
polynomial all roots are looked at together, as a number t modulo it; so are both signs of roots that follow of it.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from assur.verifier.derivations.assembly import QUATERNION, FileAssembly, given_names, has_quaternion
from assur.verifier.derivations.relations import Relations
from assur.verifier.derivations.roots import RootNumber, circle_at_roots, interpolated
from assur.verifier.derivations.turning import same
from assur.verifier.field import CircleField, Element, NoRootError, few_digits
from assur.verifier.formula import AngleSum, plain, value
from assur.verifier.mechanism import FileMechanism
from assur.verifier.reading import RefusedError, require
from assur.verifier.vectors import Vector, apply, product, subtract

TRIES = 200
"""Places that are drawn until every radicand has a root there."""
FEW = 4
"""Of them modulo one prime: modulo most of them some root of a number may be no residue, at any place."""
MOST = 64
"""Branches that are looked at, of more the first."""


class _Place(CircleField):
    """A prime field in which numbers that are drawn have roots too, and numbers at the roots of a polynomial."""

    last: RootNumber | None = None
    rooted = True

    def root(self, value: Any) -> Any:
        """A root; of what stands for a rational of few digits that of the rational."""
        if isinstance(value, RootNumber):
            self.last = value.root(self.last)
            return self.last
        plain_one = few_digits(value) if isinstance(value, Element) else value
        return value.root() if plain_one is None else super().root(plain_one)


def closing_branches(mechanism: FileMechanism, problem: Mapping[str, Any], conditions: Sequence[str]) -> int:
    """How many branches were looked at, each of which closes every loop. Errors: RefusedError."""
    field = _Place()
    for number in range(TRIES):
        try:
            place = _DrawnBranches(mechanism, problem, field.fresh())
            return place.closing(conditions)
        except NoRootError:
            if number % FEW == FEW - 1:
                field = _Place()  # where other numbers have roots
    raise RefusedError("the formulas have no values")


class _DrawnBranches:
    def __init__(self, mechanism: FileMechanism, problem: Mapping[str, Any], field: _Place) -> None:
        self.problem, self.field = problem, field
        self.names: dict[str, Any] = {
            name: AngleSum({name: Fraction(1)}) if unit else field.uniform()
            for name, (_, unit) in mechanism.parameters.items()
        }
        self.names = Relations(mechanism, problem["proof"]["relations"]).among(self.names, field)
        lengths, angles = given_names(mechanism, problem["problem"])
        given: dict[str, Any] = {name: field.uniform() for name in lengths}
        for name in angles:
            given[f"cos_{name}"], given[f"sin_{name}"] = field.circle(AngleSum({f" {name}": Fraction(1)}))
        self.values = dict(self.names)
        if has_quaternion(mechanism, problem["problem"]):
            given |= zip(QUATERNION, _unit_quaternion(*(field.uniform() for _ in range(3))), strict=True)
        self.values |= given
        claims = problem["proof"]["orientations"]
        self.assembly = FileAssembly(mechanism, problem["problem"], field, self.names, given, _zero, claims)

    def closing(self, conditions: Sequence[str]) -> int:
        """How many branches close, of as many as are looked at."""
        roots = list(self._roots_before())
        seen: list[tuple[tuple[int, int], ...]] = []
        for signs in itertools.islice(itertools.product((1, -1), repeat=len(roots)), MOST):
            values = self._branch(dict(zip(roots, signs, strict=True)))
            self._hold(conditions, values)
            self._closed(values)
            seen.append(tuple((values[root].a, values[root].b) for root in roots))
        require(len({*seen}) == len(seen), "branches that are one")
        return int(len(seen) * self.problem["branches"] // 2 ** len(roots))

    def _hold(self, conditions: Sequence[str], values: Mapping[str, Any]) -> None:
        """Conditions hold at what is drawn, and at every root of the polynomial."""
        for text in conditions:
            own = self._value(text.removesuffix(" != 0"), values)
            require(not _zero(own), "a condition that never holds")
            if isinstance(own, RootNumber):
                own.inverse()

    def _roots_before(self) -> Iterator[str]:
        """Roots of what is drawn, of which a sign is chosen: those before a polynomial."""
        for own, proved in self._sets():
            if "polynomial" in proved:
                return
            yield from (choice["root"] for choice in own["choices"])

    def _sets(self) -> Iterator[tuple[Mapping[str, Any], Mapping[str, Any]]]:
        return zip(self.problem["sets"], self.problem["proof"]["sets"], strict=True)

    def _value(self, text: str, values: Mapping[str, Any]) -> Any:
        own = plain(value(text, values, self.field, len(text)), self.field)
        return own if isinstance(own, (Element, RootNumber)) else self.field.number(Fraction(own))

    def _branch(self, signs: Mapping[str, int]) -> dict[str, Any]:
        values = dict(self.values)
        self.field.last = None
        for own, proved in self._sets():
            if "polynomial" in proved:
                self._at_roots(own["formulas"], proved["polynomial"], values)
            self._work_out(own["formulas"], values, signs)
        self._work_out(self.problem["lengths"], values, signs)
        return values

    def _work_out(self, formulas: Mapping[str, str], values: dict[str, Any], signs: Mapping[str, int]) -> None:
        for name, text in formulas.items():
            values[name] = self._value(text, values) * signs.get(name, 1)

    def _at_roots(self, formulas: Mapping[str, str], own: Mapping[str, Any], values: dict[str, Any]) -> None:
        """Cosine and sine of the circle that the polynomial is about, at all of its roots."""
        names, last = [*formulas], own["vanishes"]
        before = {name: formulas[name] for name in names[: names.index(last) + 1]}

        def vanishing(cosine: Element, sine: Element) -> Any:
            inside = values | dict(zip(own["circle"], (cosine, sine), strict=True))
            self._work_out(before, inside, {})
            return inside[last]

        polynomial = interpolated(vanishing, int(own["degree"]), self.field.p)
        values |= dict(zip(own["circle"], circle_at_roots(polynomial), strict=True))

    def _closed(self, values: Mapping[str, Any]) -> None:
        proof = self.problem["proof"]
        for name, text in proof["units"].items():
            require(_zero(self._value(text, values)), f"{name} is not 1 in every branch")
        claims = proof["orientations"]
        read = partial(self._vector, values)
        turns = {own["link"]: self.assembly.claimed(own, read) for own in claims}
        sliding = {name: values[own] for name, own in proof["sliding"].items()}
        gaps, _ = self.assembly.loops(turns, values, sliding)
        gaps += [own.leaning(values, _zero) for own in turns.values()]
        require(all(map(_zero, gaps)), f"a branch does not close every loop (modulo {self.field.p})")
        rotations = {link: own.rotation(values, _zero) for link, own in turns.items()}
        for hop in self.assembly.hops:
            start, end = rotations.get(hop.start), rotations.get(hop.end)
            if start is None or end is None:
                continue
            gap = hop.axis and subtract(apply(start, hop.axis), apply(end, hop.back.axis or hop.axis))
            fits = all(map(_zero, gap)) if gap else same(product(start, hop.after), end, _zero)
            require(fits, f"{hop.start} and {hop.end} are turned as their joint does not let them")

    def _vector(self, values: Mapping[str, Any], parts: Sequence[str]) -> Vector:
        x, y, z = (self._value(part, values) for part in parts)
        return x, y, z


def _unit_quaternion(x: Element, y: Element, z: Element) -> tuple[Element, Element, Element, Element]:
    """That of which the vector part over the scalar one, where both are doubled, is drawn."""
    square = x * x + y * y + z * z
    return (1 - square) / (1 + square), 2 * x / (1 + square), 2 * y / (1 + square), 2 * z / (1 + square)


def _zero(number: Any) -> bool:
    return number.zero if isinstance(number, (Element, RootNumber)) else bool(number == 0)
