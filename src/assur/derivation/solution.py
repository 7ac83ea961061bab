"""The solution of one problem: sets in their order, lengths and the pose, as formulas one after another."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product as choices_of

import sympy

from assur.derivation.elimination import Definition, Root, SolvedSet, solution
from assur.derivation.home_numbers import home_numbers
from assur.derivation.linear import Form, divided, form_of, projected, sparse, value_of
from assur.derivation.loop_equations import LoopEquations, UnknownDirection, loop_equations
from assur.derivation.orientations import LinkOrientations, orientations
from assur.derivation.sets import next_set
from assur.derivation.symbols import GivenSymbols
from assur.derivation.witness import ModularWitness
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord


@dataclass(frozen=True, eq=False)
class AnalyticSolution:
    """What was derived of one problem.

    Attributes:
        symbols: what is given.
        placed: orientations of the links, and why.
        loops: the loop equations.
        sets: in the order of solution.
        lengths: definitions of lengths that are sought, after the sets.
        point: the platform's point, after these.
    """

    symbols: GivenSymbols
    placed: LinkOrientations
    loops: LoopEquations
    sets: tuple[SolvedSet, ...]
    lengths: tuple[Definition, ...]
    point: tuple[sympy.Expr, sympy.Expr, sympy.Expr]

    @property
    def roots(self) -> tuple[Root, ...]:
        """The choices of two, in the order of solution."""
        return tuple(root for part in self.sets for root in part.roots)

    @property
    def branches(self) -> int:
        """How many branches there are."""
        return int(2 ** len(self.roots))

    @property
    def definitions(self) -> tuple[Definition, ...]:
        """All formulas in the order of computation."""
        return (*(own for part in self.sets for own in part.definitions), *self.lengths)

    def closes(self) -> bool:
        """Whether every branch closes every loop, exactly, at values modulo a large prime."""
        return all(self._closes(signs) for signs in choices_of((1, -1), repeat=len(self.roots)))

    def _closes(self, signs: Sequence[int]) -> bool:
        witness = ModularWitness(1)
        for cosine, sine in self.symbols.circles:
            witness.on_circle(cosine, sine)
        turned = {root.symbol: sign for root, sign in zip(self.roots, signs, strict=True)}
        for own in self.definitions:
            witness.define(own.symbol, turned.get(own.symbol, 1) * own.formula)
        quadrics = (direction.quadric for direction in self.loops.directions)
        return all(map(witness.is_zero, (*map(value_of, self.loops.forms), *quadrics)))


@lru_cache(maxsize=8)
def analytic_solution(record: MechanismRecord, problem: Problem) -> AnalyticSolution:
    """The direct or the inverse problem solved by formulas.

    Errors:
        NotDerivedError: what the method does not reach.

    >>> from assur.model.registry import load_record
    >>> analytic_solution(load_record("zeng2019"), "direct").branches
    8
    """
    witness = ModularWitness()
    symbols = GivenSymbols(record, problem, witness)
    placed = orientations(symbols)
    loops = loop_equations(symbols, placed)
    witness.home = home_numbers(symbols, placed, loops.directions)
    lengths, forms = projected(sparse(loops.forms, witness), list(loops.lengths.values()), witness)
    sets = _sets(sparse([divided(form) for form in forms], witness), loops.directions, witness, _names(record))
    backward = tuple(Definition(symbol, value_of(form)) for symbol, form in lengths.items())
    for own in backward:
        witness.define(own.symbol, own.formula)
    x, y, z = (value_of(form) for form in loops.point)
    return AnalyticSolution(symbols, placed, loops, sets, backward, (x, y, z))


def _sets(
    forms: Sequence[Form], directions: Sequence[UnknownDirection], witness: ModularWitness, taken: set[str]
) -> tuple[SolvedSet, ...]:
    left, sets = list(directions), list[SolvedSet]()
    while left:
        chosen, equations = next_set(forms, left, witness)
        sets.append(solution(len(sets) + 1, chosen, equations, witness, taken))
        left = [direction for direction in left if direction not in chosen]
        unknowns = [unknown for direction in left for unknown in direction.unknowns]
        forms = [form_of(value_of(form), unknowns, witness) for form in forms]
        forms = [form for form in forms if form.keys() & {*unknowns}]
    return tuple(sets)


def _names(record: MechanismRecord) -> set[str]:
    given: Mapping[str, object] = record.parameters
    return {*given, *(driven.name for driven in record.inputs), *record.platform.pose}
