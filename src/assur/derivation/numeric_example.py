"""Branches of a solution in numbers, by its own formulas: every choice of signs, every real root of a polynomial."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.definitions import Definition
from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of

SIGNS = (1, -1)
REAL = 1e-6
"""How far from 1 the absolute value of a root may be that is a real angle: roots are known to about 1e-10, double ones
to the root of that."""
STEPS, NEAR = 3, 1e-6
"""Of Newton, and in rad of its differences."""


@dataclass(frozen=True)
class ExampleBranch:
    """A branch in numbers.

    Attributes:
        signs: of the roots, in the order of solution: whether each has its sign's, not its own.
        values: symbol -> number; empty where the branch is not real.
        root: which root of the polynomial it has, from 1 on; 0 where there is no polynomial.
        negative: the radicand that is negative there.
    """

    signs: tuple[int, ...]
    values: Mapping[sympy.Symbol, float]
    negative: sympy.Symbol | None = None
    root: int = 0


Compiled = Sequence[tuple[sympy.Symbol, list[sympy.Symbol], Callable[..., float]]]


def example_branches(
    solution: AnalyticSolution, given: Mapping[sympy.Symbol, float], senses: Sequence[int]
) -> Iterator[ExampleBranch]:
    """All branches at given values of dimensions and of inputs or pose, plus first, the last sign running fastest.

    `senses`: of each root, whether it has its sign or its opposite.
    """
    place = next((k for k, part in enumerate(solution.sets) if part.eliminant is not None), None)
    if place is not None and solution.eliminant is not None:
        yield from _of_polynomial(solution, solution.eliminant, place, given, senses)
        return
    compiled = _compiled(solution.definitions)
    for signs in itertools.product(SIGNS, repeat=len(solution.roots)):
        yield _branch(solution, given, signs, senses, compiled)


def _compiled(definitions: Iterable[Definition]) -> Compiled:
    return [
        (own.symbol, arguments, sympy.lambdify(arguments, own.formula, "math"))
        for own in definitions
        for arguments in [sorted(own.formula.free_symbols, key=str)]
    ]


def _of_polynomial(
    solution: AnalyticSolution,
    eliminant: AngleEliminant,
    place: int,
    given: Mapping[sympy.Symbol, float],
    senses: Sequence[int],
) -> Iterator[ExampleBranch]:
    """Branches at the real roots, whose sets before the polynomial have no choice of signs; else none."""
    if any(part.roots for part in solution.sets[:place]):
        return
    before = [own for part in solution.sets[:place] for own in part.definitions]
    ahead = _branch(solution, given, (), senses, _compiled([*before, *eliminant.known])).values
    inner = _compiled([*eliminant.entries, *eliminant.steps])

    def left_over(turn: float) -> float:
        values = {**ahead, **dict(zip(eliminant.direction.unknowns, (math.cos(turn), math.sin(turn)), strict=True))}
        return _worked_out(values, inner)[eliminant.steps[-1].symbol]

    known = {own.symbol for own in eliminant.known}
    after = [own for part in solution.sets[place:] for own in part.definitions if own.symbol not in known]
    compiled = _compiled([*after, *solution.lengths])
    for number, turn in enumerate(real_turns(left_over, eliminant.degree), start=1):
        circle = dict(zip(eliminant.direction.unknowns, (math.cos(turn), math.sin(turn)), strict=True))
        for signs in itertools.product(SIGNS, repeat=len(solution.roots)):
            yield replace(_branch(solution, {**ahead, **circle}, signs, senses, compiled), root=number)


def real_turns(function: Callable[[float], float], degree: int) -> list[float]:
    """The angles, in rad, at which a trigonometric polynomial vanishes whose degree in the tangent of half is known.

    Its Fourier coefficients are those of a polynomial in exp(i turn); real angles are its roots of absolute value 1.

    >>> [round(turn, 6) for turn in real_turns(lambda turn: math.cos(turn) - 0.5, 2)]
    [-1.047198, 1.047198]
    """
    count = 2 * degree + 1
    samples = [function(2.0 * math.pi * k / count) for k in range(count)]
    order = degree // 2
    coefficients = np.roll(np.fft.fft(samples), order)[: degree + 1]
    roots = np.roots(coefficients[::-1])
    turns = sorted(float(np.angle(root)) for root in roots if abs(abs(root) - 1.0) < REAL)
    return [_polished(function, turn) for turn in turns]


def _polished(function: Callable[[float], float], turn: float) -> float:
    """A root after steps of Newton with differences."""
    for _ in range(STEPS):
        slope = (function(turn + NEAR) - function(turn - NEAR)) / (2.0 * NEAR)
        if slope:
            turn -= function(turn) / slope
    return turn


def _worked_out(given: Mapping[sympy.Symbol, float], compiled: Compiled) -> dict[sympy.Symbol, float]:
    values = dict(given)
    for symbol, arguments, formula in compiled:
        values[symbol] = float(formula(*(values[own] for own in arguments)))
    return values


def _branch(
    solution: AnalyticSolution,
    given: Mapping[sympy.Symbol, float],
    signs: tuple[int, ...],
    senses: Sequence[int],
    compiled: Compiled,
) -> ExampleBranch:
    turned = {
        root.symbol: (sign * sense, root.radicand)
        for root, sign, sense in zip(solution.roots, signs, senses, strict=False)
    }
    values = dict(given)
    for symbol, arguments, formula in compiled:
        if symbol in turned:
            sign, radicand = turned[symbol]
            if values[radicand] < 0.0:
                return ExampleBranch(signs, {}, radicand)
            values[symbol] = sign * math.sqrt(values[radicand])
        else:
            values[symbol] = float(formula(*(values[own] for own in arguments)))
    return ExampleBranch(signs, values)


def angle(values: Mapping[sympy.Symbol, float], name: str) -> float:
    """An angle in rad, by the symbols of its cosine and its sine."""
    cosine, sine = circle_of(name)
    return math.atan2(values[sine], values[cosine])
