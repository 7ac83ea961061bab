"""Sums of two unknowns that loops keep as they are: they vanish nowhere in the motion."""

from __future__ import annotations

import sympy

from assur.derivation.linear import Form, value_of
from assur.derivation.solution import AnalyticSolution

VANISHED = 1e-9
"""Of a sum, in the file's units: with such dimensions it is zero throughout the motion."""


def steady_sum(
    solution: AnalyticSolution, first: sympy.Expr, second: sympy.Expr
) -> tuple[sympy.Expr, sympy.Expr, sympy.Expr] | None:
    """Multiples of two quantities, by dimensions, whose sum is of dimensions alone by a loop equation, and it; or None.

    Of a five-bar the heights of both rods differ by what the cranks say, which is no dimension; those of two rods that
    hang on one rail do by how far apart their joints are.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> first, second = sympy.symbols("cos_rod1 cos_rod2", real=True)
    >>> steady_sum(analytic_solution(load_record("fivebar"), "inverse"), first, second) is None
    True
    """
    unknowns = {unknown for part in solution.sets for own in part.directions for unknown in own.unknowns}
    known = {own.symbol: own.formula for own in solution.definitions if own.symbol not in unknowns}
    witness = solution.symbols.witness
    dimensions, zero = {*solution.symbols.parameters.values()}, witness.is_zero
    parts = [own.as_independent(*unknowns) for own in (first, second)]
    if not all(own in unknowns and share.free_symbols <= dimensions for share, own in parts):
        return None
    for form in (form for part in solution.sets for form in part.equations):
        value = value_of(form)
        while value.free_symbols & known.keys():
            value = value.xreplace(known)
        value = sympy.expand(value)
        a, b = (value.coeff(own) / share for share, own in parts)
        rest = sympy.expand(value - a * first - b * second)
        steady = (a.free_symbols | b.free_symbols | rest.free_symbols) <= dimensions
        if steady and not any(map(zero, (a, b, rest))) and abs(witness.at_home(rest)) > VANISHED:
            return a, b, -rest
    return None


def with_steady_sum(form: Form, total: sympy.Expr, steady: sympy.Expr) -> Form:
    """A form in which that sum is what it always is.

    >>> x, a, b, d = sympy.symbols("x a b d")
    >>> with_steady_sum({x: a * (b + 2), d: b}, b + 2, d)
    {x: a*d, d: b}
    """
    unknowns = total.free_symbols - steady.free_symbols
    answer = dict(form)
    for key, part in form.items():
        quotient, divisor = sympy.fraction(sympy.cancel(part / total))
        if not divisor.free_symbols & unknowns:
            answer[key] = quotient / divisor * steady
    return answer
