"""A derivation that somebody else can check: what is assumed, loop equations, an identity for each step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.circle_pairs import PairEliminant
from assur.derivation.elimination import SolvedSet
from assur.derivation.identities import SetIdentities, set_identities
from assur.derivation.linear import Form, form_of, value_of
from assur.derivation.linear_span import LinearSpan, Multipliers, NoIdentityError, unit
from assur.derivation.loop_equations import SharedAxis
from assur.derivation.orientations import Orientation
from assur.derivation.pair_identities import pair_identities
from assur.derivation.polynomial_identities import PolynomialIdentities, polynomial_identities
from assur.derivation.solution import AnalyticSolution
from assur.derivation.space import without_identities
from assur.derivation.strokes import StrokeVector, stroke_vectors
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness
from assur.results.answers.answer import ABSENT, Absent
from assur.results.answers.derivation import (
    DerivationProof,
    ProvedAxis,
    ProvedOrientation,
    ProvedPolynomial,
    ProvedReason,
    ProvedSet,
    ProvedTriangle,
)


def proof(solution: AnalyticSolution) -> DerivationProof:
    """The identities of a solution. Errors: NoIdentityError.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> own = proof(analytic_solution(load_record("fivebar"), "direct"))
    >>> own.loops["loop2"], own.sets[0].equations[0]
    ('l1*sin_theta1 - l1*sin_theta2 + l2*sin_rod1 - l2*sin_rod2', {'loop2': '1'})
    """
    for what in without_identities(solution):
        raise NoIdentityError(f"no identities are written for {what}")
    return _Proof(solution).whole()


class _Proof:
    def __init__(self, solution: AnalyticSolution) -> None:
        self.solution, self.loops, self.witness = solution, solution.loops, solution.symbols.witness
        self.vectors, forms = stroke_vectors(self.loops.forms, self.loops.strokes, self.witness)
        self.names = [f"loop{k}" for k in range(1, len(forms) + 1)]
        self.rows = dict(sorted(zip(self.names, forms, strict=True), key=lambda row: len(row[1])))
        instead = {vector.circle: vector.direction for vector in self.vectors}
        cranks = [(crank, form) for crank, forms in self.loops.cranks.items() for form in forms]
        self.leanings = {f"loop{k}": own for k, own in enumerate(cranks, start=len(forms) + 1)}
        self.directions = [instead.get(own, own) for own in self.loops.directions]
        self.fixed = [length for length in self.loops.lengths.values() if length not in self.loops.strokes]

    def whole(self) -> DerivationProof:
        sets = [self._set(k, part) for k, part in enumerate(self.solution.sets)]
        lengths = self._lengths()
        loops = {name: str(value_of(form)) for name, form in zip(self.names, self.loops.forms, strict=True)}
        loops |= {name: str(value_of(form)) for name, (_, form) in self.leanings.items()}
        return DerivationProof(
            {str(own.symbol): str(own.formula) for own in self.loops.relations},
            {str(own.symbol): str(own.formula) for own in self.solution.placed.named.definitions},
            tuple(self._orientations()),
            tuple(self._reasons()),
            self._named_lengths(),
            {str(own): str(formula) for vector in self.vectors for own, formula in _components(vector)},
            {unit(own): str(own.quadric) for own in self.loops.directions},
            loops,
            dict(zip(self.names, map(_axis, self.loops.shared), strict=False)) | dict(self._hinges()),
            tuple(sets),
            lengths,
        )

    def _set(self, k: int, part: SolvedSet) -> ProvedSet:
        done = {
            own for before in self.solution.sets[:k] for direction in before.directions for own in direction.unknowns
        }
        after = [vector.circle for vector in self.vectors if not done & {*vector.direction.unknowns}]
        left = [own for direction in (*self.directions, *after) for own in direction.unknowns if own not in done]
        rows = {name: self._within(form, (*self.fixed, *left)) for name, form in self.rows.items()}
        rows |= {name: form for name, (crank, form) in self.leanings.items() if crank in part.directions}
        span = LinearSpan(rows, left, self.witness, self.fixed)
        if part.eliminant is not None:
            coupled = _coupled(part, part.eliminant, span, self.vectors, self.witness)
            return replace(_proved(coupled), polynomial=_polynomial(part.eliminant, coupled))
        return _proved(set_identities(part, span, self.vectors, self.witness))

    def _within(self, form: Form, unknowns: Sequence[sympy.Symbol]) -> Form:
        """A form in which everything else is known."""
        if form.keys() <= {*unknowns, sympy.Integer(1)}:
            return form
        return form_of(value_of(form), unknowns, self.witness)

    def _lengths(self) -> dict[str, Mapping[str, str]]:
        turning = [direction for direction in self.directions if direction not in self.loops.carriers]
        unknowns = [*self.fixed, *(own for direction in turning for own in direction.unknowns)]
        span = LinearSpan(self.rows, unknowns, self.witness, self.fixed)
        return {
            str(own.symbol): _texts(span.multipliers(form_of(own.symbol - own.formula, unknowns, self.witness)))
            for own in self.solution.lengths
        }

    def _orientations(self) -> Iterator[ProvedOrientation]:
        used = {link: own for own in self.loops.directions for link in own.links if own.kind == "circle"}
        rods = {link: own for own in self.loops.directions for link in own.links if own.kind == "rod"}
        circles: dict[int, UnknownDirection] = {}
        placed = self.solution.placed.links
        for link, own in placed.items():
            if link in used and own.circle is not None and own.second is None:
                circles[own.circle] = used[link]
        for link, own in placed.items():
            circle = circles.get(own.circle) if own.circle is not None else None
            second = used.get(link) if own.second is not None else None
            yield replace(_orientation(link, own, circle, rods.get(link), second), triangle=self._triangle(link))

    def _hinges(self) -> Iterator[tuple[str, ProvedAxis]]:
        """Of each equation of a crank the hinge on which its rod leans, along the rod."""
        links, rods = self.solution.placed.links, [own for own in self.loops.directions if own.kind == "rod"]
        for name, (crank, form) in self.leanings.items():
            used = {symbol for part in form.values() for symbol in part.free_symbols}
            rod = next(own for own in rods if {*own.unknowns} & used)
            joint = next(name for name, own in self.solution.symbols.record.joints.items()
                         if {own.parent, own.child} & {*rod.links}
                         and any(links[end].circle == links[crank.links[0]].circle and links[end].rod is None
                                 for end in (own.parent, own.child)))  # fmt: skip
            yield name, ProvedAxis(joint, _vector(rod.unknowns))

    def _triangle(self, link: str) -> ProvedTriangle | Absent:
        own = self.solution.placed.links[link].triangle
        if own is None:
            return ABSENT
        record, sides = self.solution.symbols.record, [one for one in self.loops.directions if link in one.links]
        ends = {self.solution.placed.links[end].triangle: end for name in own.joints[:1]
                for end in (record.joints[name].parent, record.joints[name].child)}  # fmt: skip
        return ProvedTriangle(ends[own], own.joints, tuple(tuple(map(str, side.unknowns)) for side in sides))

    def _reasons(self) -> Iterator[ProvedReason]:
        for own in self.solution.placed.reasons:
            third = ABSENT if own.third is None else _vector(own.third)
            first, second = _vector(own.first), _vector(own.second)
            yield ProvedReason(own.link, own.carrier, first, second, _matrix(own.constant), third)

    def _named_lengths(self) -> dict[str, str]:
        coordinates = self.solution.symbols.record.coordinates
        return {
            f"{coordinates[index].joint}.{coordinates[index].component}": str(symbol)
            for index, symbol in self.loops.lengths.items()
        }


def _coupled(
    part: SolvedSet,
    eliminant: AngleEliminant,
    span: LinearSpan,
    vectors: Sequence[StrokeVector],
    witness: ModularWitness,
) -> PolynomialIdentities:
    if isinstance(eliminant, PairEliminant) and eliminant.pair is not None:
        return pair_identities(part, eliminant, eliminant.pair, span, vectors, witness)
    return polynomial_identities(part, eliminant, span, vectors, witness)


def _proved(own: SetIdentities) -> ProvedSet:
    return ProvedSet(
        tuple(map(_texts, own.equations)),
        tuple(map(_texts, own.lines)),
        {str(symbol): _texts(shares) for symbol, shares in own.formulas.items()},
    )


def _polynomial(eliminant: AngleEliminant, own: PolynomialIdentities) -> ProvedPolynomial:
    cosine, sine = map(str, eliminant.direction.unknowns)
    return ProvedPolynomial(
        (cosine, sine),
        str(eliminant.steps[-1].symbol),
        eliminant.degree,
        f"{quadric} = 0" if (quadric := eliminant.left_quadric) != 0 else "",
        _texts(own.quadric),
        _texts(own.polynomial),
    )


def _axis(own: SharedAxis) -> ProvedAxis:
    return ProvedAxis(next(iter(own.turn.joints)), _vector(own.along))


def _components(vector: StrokeVector) -> Iterator[tuple[sympy.Symbol, sympy.Expr]]:
    reach = vector.length + vector.along
    if vector.circle.kind == "rod":
        yield from (
            (own, reach * part) for own, part in zip(vector.direction.unknowns, vector.circle.unknowns, strict=True)
        )
        return
    (x, y), (cosine, sine) = vector.direction.unknowns, vector.circle.unknowns
    yield x, reach * cosine - vector.beside * sine
    yield y, reach * sine + vector.beside * cosine


def _orientation(
    link: str,
    own: Orientation,
    circle: UnknownDirection | None,
    rod: UnknownDirection | None,
    second: UnknownDirection | None,
) -> ProvedOrientation:
    kind = "rod" if own.rod is not None else "circle" if own.circle is not None else "fixed"
    kind = kind if own.second is None else "carried"
    kind = kind if own.triangle is None else "triangle"
    return ProvedOrientation(
        link, kind, _matrix(own.constant),
        None if own.axis is None else _vector(own.axis),
        None if circle is None else tuple(map(str, circle.unknowns)),
        None if own.hinge is None else _vector(own.hinge),
        None if own.line is None else _vector(own.line),
        None if rod is None else tuple(map(str, rod.unknowns)),
        ABSENT if second is None else tuple(map(str, second.unknowns)),
    )  # fmt: skip


def _vector(parts: Sequence[Any]) -> tuple[str, ...]:
    return tuple(str(part) for part in parts)


def _matrix(rows: Sequence[Sequence[Any]]) -> tuple[tuple[str, ...], ...]:
    return tuple(map(_vector, rows))


def _texts(shares: Multipliers) -> dict[str, str]:
    return {name: str(share) for name, share in shares.items() if share != 0}
