"""A coupled set of which three quadrics in three unknowns are left: its roots in a coordinate askew to all of them.

Where inputs are alike, solutions that are mirror images share the angle of a link that stands on the mirror: a
polynomial in that angle has double roots there, though its solutions are far apart. So where all links are circles and
rods, and linear equations leave three unknowns, numbers are worked out in a coordinate that lies along none of them. It
is the same set with the same solutions: its quadrics meet in eight points.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.definitions import Definition
from assur.derivation.elimination import SolvedSet
from assur.derivation.linear import ONE, Form, never_zero, rank, replaced, solved, tidy, value_of
from assur.derivation.reduced_quadrics import quadric_form
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness

SPACE = 3
POINTS = 2**SPACE
"""In which three quadrics meet."""


@dataclass(frozen=True)
class ThreeQuadrics:
    """What is left of a set.

    Attributes:
        unknowns: the three.
        sums: of each quadric the forms in these whose squares add up to 1.
        values: what all other unknowns are.
        conditions: what was divided by and may vanish.
    """

    unknowns: tuple[sympy.Symbol, ...]
    sums: tuple[tuple[Form, ...], ...]
    values: tuple[Definition, ...]
    conditions: tuple[sympy.Expr, ...]


def three_quadrics(part: SolvedSet, witness: ModularWitness) -> ThreeQuadrics | None:
    """The quadrics of a set whose polynomial has as many roots as they have points; else None.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> solution = analytic_solution(load_record("three_rrc"), "direct")
    >>> [str(own) for own in three_quadrics(solution.sets[0], solution.symbols.witness).unknowns]
    ['cos_leg2_rod', 'sin_leg2_rod', 'cos_leg1_rod']
    """
    if part.eliminant is None or part.eliminant.degree != POINTS:
        return None
    if any(own.kind not in ("circle", "rod") for own in part.directions):
        return None
    unknowns = [unknown for own in part.directions for unknown in own.unknowns]
    if any(share.free_symbols & {*unknowns} for form in part.equations for share in form.values()):
        return None
    return _left(part.directions, part.equations, unknowns, witness)


def _left(
    directions: Sequence[UnknownDirection],
    equations: Sequence[Form],
    unknowns: Sequence[sympy.Symbol],
    witness: ModularWitness,
) -> ThreeQuadrics | None:
    """By linear equations and by sums of quadrics that are linear, as long as there are any."""
    conditions: list[sympy.Expr] = []
    values, more = solved(equations, [*reversed(unknowns)], witness, conditions)[0], dict[sympy.Symbol, Form]()
    while True:
        values = {own: replaced(form, more, witness) for own, form in values.items()} | more
        left = tuple(own for own in unknowns if own not in values)
        forms = values | {own: {own: ONE} for own in left}
        quadrics = {own: _quadric(own, forms, left, witness) for own in directions}
        products = sorted(
            {key for form in quadrics.values() for key in form if key not in left and key != ONE}, key=str
        )
        _, lines = solved(quadrics.values(), products, witness)
        more, _ = solved(lines, left, witness, conditions)
        if not more:
            break
    kept = _independent(quadrics, [*products, *left, ONE], witness)
    if len(left) != SPACE or len(kept) != SPACE:
        return None
    sums = tuple(tuple(forms[unknown] for unknown in own.unknowns) for own in kept)
    formulas = tuple(Definition(own, value_of(values[own])) for own in unknowns if own in values)
    over = (sympy.fraction(tidy(own))[0] for own in conditions)
    divided_by = dict.fromkeys(part for own in over for part, _ in sympy.factor_list(own)[1] if not never_zero(part))
    return ThreeQuadrics(left, sums, formulas, tuple(divided_by))


def _quadric(
    direction: UnknownDirection,
    forms: Mapping[sympy.Symbol, Form],
    left: Sequence[sympy.Symbol],
    witness: ModularWitness,
) -> Form:
    whole = quadric_form(direction, forms, left)
    return {key: tidy(part) for key, part in whole.items() if not witness.is_zero(part)}


def _independent(
    quadrics: Mapping[UnknownDirection, Form], keys: Sequence[sympy.Symbol], witness: ModularWitness
) -> list[UnknownDirection]:
    """The shortest quadrics of which all others are sums."""
    kept: list[UnknownDirection] = []
    for own in sorted(quadrics, key=lambda own: sum(int(sympy.count_ops(part)) for part in quadrics[own].values())):
        if rank([quadrics[other] for other in (*kept, own)], keys, witness) > len(kept):
            kept.append(own)
    return kept
