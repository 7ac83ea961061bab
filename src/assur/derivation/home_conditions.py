"""What of a solution vanishes at home: conditions, and radicands, whose two branches meet there."""

from __future__ import annotations

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
    witness = solution.symbols.witness
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
        return abs(witness.at_home(formula))

    unknowns = {unknown for own in solution.loops.directions for unknown in own.unknowns}
    for part in solution.sets:
        own = [definition.symbol for definition in part.definitions if definition.symbol in radicands]
        for condition in (*part.conditions, *own):
            if abs(witness.at_home(condition)) <= VANISHED * size(condition):
                yield condition
