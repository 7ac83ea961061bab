"""Branches of a solution in numbers: every choice of signs at given values, by the solution's own formulas."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of

SIGNS = (1, -1)


@dataclass(frozen=True)
class ExampleBranch:
    """A branch in numbers.

    Attributes:
        signs: of the roots, in the order of solution: whether each has its sign's, not its own.
        values: symbol -> number; empty where the branch is not real.
        negative: the radicand that is negative there.
    """

    signs: tuple[int, ...]
    values: Mapping[sympy.Symbol, float]
    negative: sympy.Symbol | None = None


def example_branches(
    solution: AnalyticSolution, given: Mapping[sympy.Symbol, float], senses: Sequence[int]
) -> Iterator[ExampleBranch]:
    """All branches at given values of dimensions and of inputs or pose, plus first, the last sign running fastest.

    `senses`: of each root, whether it has its sign or its opposite.
    """
    compiled = [
        (own.symbol, arguments, sympy.lambdify(arguments, own.formula, "math"))
        for own in solution.definitions
        for arguments in [sorted(own.formula.free_symbols, key=str)]
    ]
    for signs in itertools.product(SIGNS, repeat=len(solution.roots)):
        yield _branch(solution, given, signs, senses, compiled)


def _branch(
    solution: AnalyticSolution,
    given: Mapping[sympy.Symbol, float],
    signs: tuple[int, ...],
    senses: Sequence[int],
    compiled: Sequence[tuple[sympy.Symbol, list[sympy.Symbol], object]],
) -> ExampleBranch:
    turned = {
        root.symbol: (sign * sense, root.radicand)
        for root, sign, sense in zip(solution.roots, signs, senses, strict=True)
    }
    values = dict(given)
    for symbol, arguments, formula in compiled:
        if symbol in turned:
            sign, radicand = turned[symbol]
            if values[radicand] < 0.0:
                return ExampleBranch(signs, {}, radicand)
            values[symbol] = sign * math.sqrt(values[radicand])
        else:
            values[symbol] = float(formula(*(values[own] for own in arguments)))  # type: ignore[operator]
    return ExampleBranch(signs, values)


def angle(values: Mapping[sympy.Symbol, float], name: str) -> float:
    """An angle in rad, by the symbols of its cosine and its sine."""
    cosine, sine = circle_of(name)
    return math.atan2(values[sine], values[cosine])
