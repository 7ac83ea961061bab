"""Branches of a derivation held against the joint graph of the file: modulo a prime, at a place that is drawn.

A formula that is wrong closes the loops there by chance alone, with a probability of its degree over 2^160.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from assur.verifier.derivations.assembly import FileAssembly, given_names
from assur.verifier.derivations.turning import ClaimedTurn, same
from assur.verifier.field import CircleField, Element, NoRootError, few_digits
from assur.verifier.formula import AngleSum, plain, value
from assur.verifier.mechanism import FileMechanism
from assur.verifier.reading import RefusedError
from assur.verifier.vectors import Matrix, Vector, apply, product, subtract, transposed

TRIES = 200
"""Places that are drawn until every radicand has a root there."""
MOST = 64
"""Branches that are looked at, of more the first."""


class _Place(CircleField):
    """A prime field in which numbers that are drawn have roots too."""

    def root(self, value: Any) -> Element:
        """A root; of what stands for a rational of few digits that of the rational."""
        if not isinstance(value, Element):
            return super().root(value)
        plain_one = few_digits(value)
        return value.root() if plain_one is None else super().root(plain_one)


def closing_branches(mechanism: FileMechanism, problem: Mapping[str, Any], conditions: Sequence[str]) -> int:
    """How many branches were looked at, each of which closes every loop. Errors: RefusedError."""
    field = _Place()
    for _ in range(TRIES):
        try:
            place = _DrawnBranches(mechanism, problem, field.fresh())
            return place.closing(conditions)
        except NoRootError:
            continue
    raise RefusedError("the formulas have no values")


class _DrawnBranches:
    def __init__(self, mechanism: FileMechanism, problem: Mapping[str, Any], field: CircleField) -> None:
        self.problem, self.field = problem, field
        self.names: dict[str, Any] = {
            name: AngleSum({name: Fraction(1)}) if unit else field.uniform()
            for name, (_, unit) in mechanism.parameters.items()
        }
        lengths, angles = given_names(mechanism, problem["problem"])
        given: dict[str, Any] = {name: field.uniform() for name in lengths}
        for name in angles:
            given[f"cos_{name}"], given[f"sin_{name}"] = field.circle(AngleSum({f" {name}": Fraction(1)}))
        self.values = {**self.names, **given}
        self.assembly = FileAssembly(mechanism, problem["problem"], field, self.names, given, _zero)

    def closing(self, conditions: Sequence[str]) -> int:
        roots = [choice["root"] for own in self.problem["sets"] for choice in own["choices"]]
        looked = 0
        seen = set[tuple[tuple[int, int], ...]]()
        for signs in itertools.islice(itertools.product((1, -1), repeat=len(roots)), MOST):
            values = self._branch(dict(zip(roots, signs, strict=True)))
            if any(_zero(self._value(text.removesuffix(" != 0"), values)) for text in conditions):
                raise RefusedError("a condition that never holds")
            self._closed(values)
            seen.add(tuple((values[root].a, values[root].b) for root in roots))
            looked += 1
        if len(seen) != looked:
            raise RefusedError("branches that are one")
        return looked

    def _value(self, text: str, values: Mapping[str, Any]) -> Any:
        own = plain(value(text, values, self.field, len(text)), self.field)
        return own if isinstance(own, Element) else self.field.number(Fraction(own))

    def _branch(self, signs: Mapping[str, int]) -> dict[str, Any]:
        values = dict(self.values)
        formulas = [item for own in self.problem["sets"] for item in own["formulas"].items()]
        for name, text in [*formulas, *self.problem["lengths"].items()]:
            values[name] = self._value(text, values) * signs.get(name, 1)
        return values

    def _closed(self, values: Mapping[str, Any]) -> None:
        proof = self.problem["proof"]
        for name, text in proof["units"].items():
            if not _zero(self._value(text, values)):
                raise RefusedError(f"{name} is not 1 in every branch")
        turns = {own["link"]: self._turn(own, values) for own in proof["orientations"]}
        sliding = {name: values[own] for name, own in proof["sliding"].items()}
        gaps, _ = self.assembly.loops(turns, values, sliding)
        if not all(map(_zero, gaps)):
            raise RefusedError(f"a branch does not close every loop (modulo {self.field.p})")
        rotations = {link: own.rotation(values) for link, own in turns.items()}
        for hop in self.assembly.hops:
            start, end = rotations.get(hop.start), rotations.get(hop.end)
            if start is None or end is None:
                continue
            after = product(start, hop.after)
            if hop.axis is None:
                fits = same(after, end, _zero)
            else:
                own = apply(transposed(hop.after), hop.axis)
                fits = all(map(_zero, subtract(apply(after, own), apply(end, own))))
            if not fits:
                raise RefusedError(f"{hop.start} and {hop.end} are turned as their joint does not let them")

    def _turn(self, own: Mapping[str, Any], values: Mapping[str, Any]) -> ClaimedTurn:
        axis, hinge, line = (
            None if own[key] is None else self._vector(own[key], values) for key in ("axis", "hinge", "line")
        )
        a, b, c = (self._vector(row, values) for row in own["constant"])
        constant: Matrix = (a, b, c)
        circle, rod = (None if own[key] is None else tuple(own[key]) for key in ("circle", "rod"))
        return ClaimedTurn(own["link"], own["kind"], constant, axis, circle, hinge, line, rod)

    def _vector(self, parts: Sequence[str], values: Mapping[str, Any]) -> Vector:
        x, y, z = (self._value(part, values) for part in parts)
        return x, y, z


def _zero(number: Any) -> bool:
    return number.zero if isinstance(number, Element) else bool(number == 0)
