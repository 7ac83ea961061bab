"""What of a solution vanishes at home: conditions, and radicands, whose two branches meet there."""

from __future__ import annotations

import math
from collections.abc import Iterator

import sympy

from assur.derivation.solution import AnalyticSolution

VANISHED = 1e-10
"""Of what a formula could be, were all its terms of one sign."""


def conditions_at_home(solution: AnalyticSolution) -> Iterator[sympy.Expr]:
    """Conditions and radicands of a solution that vanish at home, in their order.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> [*conditions_at_home(analytic_solution(load_record("zeng2019"), "direct"))]
    []
    """
    known = {own.symbol: own.formula for own in solution.definitions}
    radicands = {root.radicand for root in solution.roots}
    numbers = _numbers(solution)
    sizes: dict[sympy.Expr, float] = {}

    def size(formula: sympy.Expr) -> float:
        """What a formula is at home with all its terms added up as positive ones."""
        if formula not in sizes:
            sizes[formula] = worked_out(formula)
        return sizes[formula]

    def worked_out(formula: sympy.Expr) -> float:
        if formula.is_Add:
            return sum(map(size, formula.args))
        if formula.is_Mul:
            return float(sympy.prod([size(part) for part in formula.args]))
        if formula.is_Pow and formula.exp.is_positive:
            return float(size(formula.base) ** float(formula.exp))
        if formula.is_Symbol and formula in known and formula not in unknowns:
            return size(known[formula])
        return abs(_value(formula, numbers))

    unknowns = {unknown for own in solution.loops.directions for unknown in own.unknowns}
    named = ((own.symbol for own in part.definitions if own.symbol in radicands) for part in solution.sets)
    of_sets = (own for part, names in zip(solution.sets, named, strict=True) for own in (*part.conditions, *names))
    for condition in (*of_sets, *solution.length_conditions):
        if abs(_value(condition, numbers)) <= VANISHED * size(condition):
            yield condition


def _numbers(solution: AnalyticSolution) -> dict[sympy.Symbol, float]:
    """Every symbol at home; what is defined and not known there by its formula."""
    numbers = dict(solution.symbols.witness.home)
    for own in solution.definitions:
        if own.symbol not in numbers:
            numbers[own.symbol] = _value(own.formula, numbers)
    return numbers


def _value(formula: sympy.Expr, numbers: dict[sympy.Symbol, float]) -> float:
    """Not a number where it divides by what vanishes, or where rounding makes a radicand negative."""
    try:
        return float(sympy.sympify(formula).evalf(30, subs=numbers))
    except (ZeroDivisionError, TypeError):
        return math.nan
