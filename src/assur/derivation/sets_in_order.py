"""All sets of a problem, one after another: each is known in those after it."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.eliminants import eliminated
from assur.derivation.elimination import SolvedSet, solution, with_known
from assur.derivation.linear import ONE, Form, divided, form_of, size, sparse, value_of
from assur.derivation.loop_equations import LoopEquations
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import LinkOrientations
from assur.derivation.resisting_set import ResistingSetError
from assur.derivation.sets import equations_alone, next_set
from assur.derivation.strokes import StrokeVector, with_strokes
from assur.derivation.symbols import GivenSymbols
from assur.derivation.trigonometric import shorter
from assur.derivation.unknown_directions import UnknownDirection
from assur.model.mechanism import MechanismRecord


@dataclass(frozen=True, eq=False)
class SetProblem:
    """What sets are looked for in.

    Attributes:
        forms: equations that are short.
        plain: makes equations in which known angles are not coefficients, where they are in those.
        loops: the loop equations.
        vectors: that stand in the place of lengths along directions that turn.
        symbols: what is given.
        placed: orientations of the links.
    """

    forms: Sequence[Form]
    plain: Callable[[], Sequence[Form]]
    loops: LoopEquations
    vectors: Sequence[StrokeVector]
    symbols: GivenSymbols
    placed: LinkOrientations

    def sets(self) -> tuple[SolvedSet, ...]:
        """All sets in their order. Errors: ResistingSetError."""
        return _Order(self).sets()


class _Order:
    def __init__(self, problem: SetProblem) -> None:
        symbols, vectors, loops = problem.symbols, problem.vectors, problem.loops
        self.problem, self.forms, self.symbols = problem, [*problem.forms], symbols
        self.witness, self.placed = symbols.witness, problem.placed
        self.vectors, self.carriers = vectors, loops.carriers
        self.taken = _names(symbols.record) | {own.symbol.name for own in problem.placed.named.definitions}
        instead = {vector.circle: vector.direction for vector in vectors}
        self.every = [instead.get(own, own) for own in loops.directions if own not in loops.cranks]
        self.left = [*self.every]

    def sets(self) -> tuple[SolvedSet, ...]:
        sets: list[SolvedSet] = []
        while self.left:
            number, self.chosen = len(sets) + 1, tuple(self.left)
            try:
                part = self._coupled() or self._solved(number, *self._next(bool(sets)))
            except NotDerivedError as error:
                raise ResistingSetError(str(error), self.placed, tuple(sets), self.chosen) from error
            part = part if sets else with_known(part, self.placed.named.definitions)
            sets.append(with_strokes(part, self.vectors, number, self.witness, self.taken))
            self.left = [direction for direction in self.left if direction not in part.directions]
            self.forms = self._rest(self.forms)
        for crank, equations in self.problem.loops.cranks.items():
            sets.append(self._solved(len(sets) + 1, (crank,), [*equations]))
        if sum(own.eliminant is not None for own in sets) > 1:
            names = " and ".join(own.name for own in sets if own.eliminant)
            last = sets.pop()
            said = f"a polynomial for each root of another: {names}"
            raise ResistingSetError(said, self.placed, tuple(sets), last.directions)
        return tuple(sets)

    @property
    def _after(self) -> tuple[UnknownDirection, ...]:
        """Directions of links whose vectors are still unknown."""
        return tuple(own.circle for own in self.vectors if own.direction in self.left)

    def _next(self, later: bool) -> tuple[tuple[UnknownDirection, ...], list[Form]]:
        chosen, equations = next_set(self.forms, self.left, self.witness, after=self._after)
        if later and not self.problem.loops.axes and not self.carriers and self._follow(equations):
            turning = [vector.circle for vector in self.vectors]
            apart = [own for own in (*self.every, *turning) if own not in chosen]
            if alone := equations_alone(self.problem.forms, chosen, apart, self.witness):
                return chosen, alone
        if later and not self.problem.loops.axes and not self._plain(equations):
            own = [divided(form) for form in self._rest(self.problem.plain())]
            other, others = next_set(sparse(own, self.witness), self.left, self.witness, after=self._after)
            if self._steady(others) and (not self._steady(equations) or size(others) < size(equations)):
                return other, others
        return chosen, equations

    def _rest(self, forms: Sequence[Form]) -> list[Form]:
        """Equations in what is still unknown."""
        left = []
        for form in forms:
            factors = {symbol for key, part in form.items() if key != ONE for symbol in part.free_symbols}
            turning = [own for own in self.carriers if factors & {*own.unknowns}]
            unknowns = _unknowns([own for own in (*self.left, *self._after) if own not in turning])
            left.append(form_of(value_of(form), unknowns, self.witness))
        unknowns = _unknowns(self.left)
        return [form for form in left if any({*unknowns} & part.free_symbols for part in (*form, *form.values()))]

    def _plain(self, equations: Sequence[Form]) -> bool:
        """Whether coefficients of unknowns are single dimensions, as in loop equations that nothing was added to."""
        dimensions = {*self.symbols.parameters.values()}
        own = [part.as_coeff_Mul()[1] for form in equations for key, part in form.items() if key != ONE]
        return all(part in dimensions or part.is_number for part in own)

    def _steady(self, equations: Sequence[Form]) -> bool:
        """Whether coefficients of unknowns are of dimensions alone, so that they vanish nowhere in the motion."""
        dimensions = {*self.symbols.parameters.values()}
        return all(part.free_symbols <= dimensions for form in equations for key, part in form.items() if key != ONE)

    def _follow(self, equations: Sequence[Form]) -> bool:
        """Whether what is solved before is in equations."""
        before = {*_unknowns([own for own in self.every if own not in self.left])}
        return any(before & part.free_symbols for form in equations for part in form.values())

    def _coupled(self) -> SolvedSet | None:
        """A set of links on axes that turn, where no set is determined without them."""
        turning = [own for own in self.carriers if own in self.left]
        if not turning:
            return None
        if len(turning) > 1:
            names = " and ".join(own.name for own in turning)
            raise NotDerivedError(f"links turn about axes that turn with {names}: more than one")
        others = [own for own in self.left if own not in turning]
        forms = [form_of(value_of(form), _unknowns(others), self.witness) for form in self.forms]
        others.sort(key=lambda own: -sum(form.keys() <= {ONE, *own.unknowns} for form in forms))
        chosen, equations = next_set(forms, others, self.witness, more=1, after=self._after)
        self.chosen = *turning, *chosen
        return eliminated(self.chosen, equations, self.witness, self.taken, carrier=turning[0])

    def _solved(self, number: int, chosen: Sequence[UnknownDirection], equations: Sequence[Form]) -> SolvedSet:
        """A set by square roots, else by one polynomial."""
        self.chosen = tuple(chosen)
        equations = [shorter(form, self.symbols.circles, self.witness) for form in equations]
        try:
            return solution(number, chosen, equations, self.witness, self.taken)
        except NotDerivedError as error:
            try:
                return eliminated(chosen, equations, self.witness, self.taken, self.symbols.record.platform.link)
            except NotDerivedError as other:
                raise NotDerivedError(f"{error}; {other}") from other


def _unknowns(directions: Sequence[UnknownDirection]) -> list[sympy.Symbol]:
    return [unknown for direction in directions for unknown in direction.unknowns]


def _names(record: MechanismRecord) -> set[str]:
    """Names of the file, and every number of a letter that points or joints have."""
    given: Mapping[str, object] = record.parameters
    points = [*record.points, *(name for joint in record.joints.values() for name in (joint.name, joint.alias))]
    letters = {match[1] for name in points if (match := re.fullmatch(r"(?:.*\.)?([A-Z])(?![A-Z]).{0,2}", name))}
    numbered = {f"{letter}{number}" for letter in letters for number in range(1, len(record.joints) + 1)}
    return {*given, *(driven.name for driven in record.inputs), *record.platform.pose, *numbered}
