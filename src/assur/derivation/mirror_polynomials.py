"""A polynomial in even powers of a cosine or a sine: its components, each root two solutions that are mirror images."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.definitions import FreeNames
from assur.derivation.solution import AnalyticSolution

TWO = 2
"""Components that one sign tells apart."""


@dataclass(frozen=True)
class MirrorPolynomials:
    """The polynomial of a direct problem in a cosine or a sine, both angles of which are solutions.

    Attributes:
        unknown: the cosine or the sine.
        beside: the other one.
        polynomials: the two components, of one degree, or one polynomial; coefficients, the constant term first.
        signs: which component it is, where there are two, and on which side of the mirror the solution is.
    """

    unknown: sympy.Symbol
    beside: sympy.Symbol
    polynomials: tuple[tuple[sympy.Expr, ...], ...]
    signs: tuple[str, ...]


def mirror_polynomials(solution: AnalyticSolution, names: FreeNames) -> MirrorPolynomials | None:
    """Those of a direct problem whose components are written out; None where there are no such.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> own = mirror_polynomials(analytic_solution(load_record("three_rps"), "direct"), FreeNames(set()))
    >>> own.unknown, [len(part) for part in own.polynomials], own.signs
    (sin_leg2_cylinder, [5, 5], ('part', 'side'))
    """
    own, eliminant = solution.components, solution.eliminant
    if own is None or own.unknown is None or not own.polynomials or eliminant is None or solution.roots:
        return None
    polynomials = own.polynomials
    if len(polynomials) != TWO or len({*map(len, polynomials)}) > 1:
        whole: tuple[sympy.Expr, ...] = (sympy.Integer(1),)
        for factor in polynomials:
            whole = _multiplied(whole, factor)
        polynomials = (whole,)
    signs = tuple(str(names.named(name)) for name in ("part", "side")[-len(polynomials) :])
    (beside,) = (symbol for symbol in eliminant.direction.unknowns if symbol != own.unknown)
    return MirrorPolynomials(own.unknown, beside, polynomials, signs)


def _multiplied(first: Sequence[sympy.Expr], second: Sequence[sympy.Expr]) -> tuple[sympy.Expr, ...]:
    """Coefficients of a product, the constant term first."""
    return tuple(
        sympy.Add(*(first[i] * second[k - i] for i in range(len(first)) if 0 <= k - i < len(second)))
        for k in range(len(first) + len(second) - 1)
    )
