"""The solution of one problem: sets in their order, lengths and the pose, as formulas one after another."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from itertools import product as choices_of

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.angle_residues import cycle_type, some_root
from assur.derivation.components import Components, components
from assur.derivation.cycle_types import CycleType, GroupFindings, findings
from assur.derivation.definitions import Definition
from assur.derivation.elimination import Root, SolvedSet
from assur.derivation.home_numbers import home_numbers
from assur.derivation.linear import (
    ONE,
    Form,
    divided,
    divisors,
    form_of,
    never_zero,
    projected,
    rank,
    replaced,
    solved,
    sparse,
    value_of,
)
from assur.derivation.loop_equations import LoopEquations, loop_equations
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import LinkOrientations, orientations
from assur.derivation.resisting_set import ResistingSetError
from assur.derivation.sets_in_order import SetProblem
from assur.derivation.strokes import stroke_vectors
from assur.derivation.symbols import GivenSymbols
from assur.derivation.trigonometric import shorter
from assur.derivation.witness import ModularWitness, NoResidueRootError
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord

PRIMES = 60
"""Modulo which a polynomial is factored; of the permutations of six roots a fifth has five in a cycle."""


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
        """How many branches there are, over complex numbers."""
        degree = self.eliminant.degree if self.eliminant else 1
        return int(2 ** len(self.roots)) * degree

    @property
    def eliminant(self) -> AngleEliminant | None:
        """The one polynomial, where there is one."""
        return next((part.eliminant for part in self.sets if part.eliminant), None)

    @cached_property
    def length_conditions(self) -> tuple[sympy.Expr, ...]:
        """What may vanish of what is divided by after the sets: for lengths, and for the platform's point."""
        sizes = self.symbols.witness.sizes
        found = (*(own.formula for own in self.lengths), *(self.point if self.symbols.problem == "direct" else ()))
        factors = {factor: None for formula in found for factor in divisors(formula)}
        return tuple(own for own in factors if not never_zero(own, sizes))

    @property
    def definitions(self) -> tuple[Definition, ...]:
        """All formulas in the order of computation."""
        return (*(own for part in self.sets for own in part.definitions), *self.lengths)

    def closes(self) -> bool:
        """Whether every branch closes every loop, exactly, at values modulo a large prime; of a polynomial a root."""
        return all(self._closes(signs) for signs in choices_of((1, -1), repeat=len(self.roots)))

    def held_against_loops(self) -> None:
        """Errors: NotDerivedError, where a branch leaves a loop open."""
        if not self.closes():
            less = ", or the pose says too little" if self.symbols.problem == "inverse" else ""
            raise NotDerivedError(
                "the formulas that were found do not close every loop: some loops close for special dimensions alone, "
                f"or on some of the branches{less}"
            )

    def _closes(self, signs: Sequence[int]) -> bool:
        witness = self._replayed(1, self.sets, signs)
        for own in self.lengths:
            witness.define(own.symbol, own.formula)
        quadrics = (direction.quadric for direction in self.loops.directions)
        leanings = (form for forms in self.loops.cranks.values() for form in forms)
        return all(map(witness.is_zero, (*map(value_of, (*self.loops.forms, *leanings)), *quadrics)))

    def drawn(self, seed: int, signs: Sequence[int]) -> ModularWitness:
        """A witness of a branch, at dimensions that stay what they are when all is drawn anew."""
        witness = ModularWitness(seed)
        witness.with_roots(self.symbols.radicands)
        dimensions = [*self.symbols.parameters.values()]
        values = [witness.value(symbol) for symbol in dimensions]
        witness.drawn(dimensions, lambda: values)
        witness = self._replayed(seed, self.sets, signs, witness)
        for own in self.lengths:
            witness.define(own.symbol, own.formula)
        return witness

    def witness_before(self, place: int, seed: int, witness: ModularWitness | None = None) -> ModularWitness:
        """A witness of its own, or one that knows something, with everything that the sets before one define."""
        return self._replayed(seed, self.sets[:place], (), witness)

    def _replayed(
        self, seed: int, sets: Sequence[SolvedSet], signs: Sequence[int], witness: ModularWitness | None = None
    ) -> ModularWitness:
        """A witness of its own, with everything that sets define."""
        witness = witness or ModularWitness(seed)
        self.symbols.draw(witness)
        for relation in self.loops.relations:
            witness.define(relation.symbol, relation.formula)
        turned = {root.symbol: sign for root, sign in zip(self.roots, signs, strict=False)}
        for part in sets:
            before = len(part.eliminant.known) if part.eliminant else 0
            for own in part.definitions[:before]:
                witness.define(own.symbol, own.formula)
            if (eliminant := part.eliminant) is not None:
                witness.drawn(eliminant.direction.unknowns, partial(some_root, eliminant, witness))
            for own in part.definitions[before:]:
                witness.define(own.symbol, turned.get(own.symbol, 1) * own.formula)
        return witness

    @cached_property
    def group(self) -> GroupFindings | None:
        """What is proved of the polynomial's roots, where its coefficients have no roots in them but of numbers."""
        if self.eliminant is None or any(part.roots for part in self.sets[: self._place]) or self.components:
            return None
        types: dict[CycleType, int] = {}
        for seed in range(2, 2 + PRIMES):
            witness = self._replayed(seed, self.sets[: self._place], ())
            for own in self.eliminant.known:
                witness.define(own.symbol, own.formula)
            with contextlib.suppress(NoResidueRootError):
                if (own_type := cycle_type(self.eliminant, witness)) is not None:
                    types.setdefault(own_type, witness.field.p)
            known = findings(self.eliminant.degree, types)
            if known.insoluble:
                break
        return known

    @cached_property
    def components(self) -> Components | None:
        """The components of its solutions, where two circles follow of the polynomial's: others have one component."""
        if self.eliminant is None or not self.eliminant.backward or self._place or self.placed.named.definitions:
            return None
        own = components(self.eliminant)
        return own if own is not None and own.count == self.eliminant.degree else None

    @property
    def _place(self) -> int:
        """Of the set with the polynomial."""
        return next(k for k, part in enumerate(self.sets) if part.eliminant is not None)


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
    witness.home = home_numbers(symbols, placed, loops)
    try:
        return _solved(symbols, placed, loops)
    except ResistingSetError as error:  # where links slide on one that turns, its angle taken as known may say all else
        for circle in dict.fromkeys(own for own in loops.strokes.values() if own.kind == "circle"):
            with contextlib.suppress(NotDerivedError):
                return _solved(symbols, placed, loops.carried_by(circle, witness))
        raise error


def _solved(symbols: GivenSymbols, placed: LinkOrientations, loops: LoopEquations) -> AnalyticSolution:
    """Set by set.

    Errors:
        NotDerivedError: a set that resists, or lengths.
    """
    witness = symbols.witness
    vectors, forms = stroke_vectors(loops.forms, loops.strokes, witness)
    fixed = [length for length in loops.lengths.values() if length not in {*loops.strokes, *loops.oblique}]
    forms = [_with_turning_lengths(form, loops) for form in forms]
    axes, forms = forms[: loops.axes], _more_than(forms[: loops.axes], forms[loops.axes :], loops, witness)
    given = {symbol for circle in symbols.circles for symbol in circle}
    shares = [form[length] for form in forms for length in fixed if length in form]
    turned = any(share.free_symbols & given or share.has(sympy.sin) for share in shares)
    lengths, short = projected(
        forms if turned else sparse(forms, witness, everywhere=bool(loops.framed)), fixed, witness
    )
    lengths = {length: shorter(form, symbols.circles, witness) for length, form in lengths.items()}
    short = [*axes, *sparse([divided(shorter(form, symbols.circles, witness)) for form in short], witness)]
    _refuse_oblique(short, loops)
    sets = SetProblem(short, lambda: projected(forms, fixed, witness)[1], loops, vectors, symbols, placed).sets()
    carrying = {symbol for own in loops.carriers for symbol in own.unknowns}
    if any(share.free_symbols & carrying for share in shares):  # along a direction that is of length 1 at a root alone
        lengths, _ = projected(forms, fixed, witness)
    known = {**loops.oblique, **{symbol: value_of(form) for symbol, form in lengths.items()}}
    backward = tuple(Definition(symbol, formula) for symbol, formula in known.items())
    for own in backward:
        witness.define(own.symbol, own.formula)
    point = (value_of(_without_unknowns(form, sets, witness)) for form in loops.point)
    x, y, z = (part + beside for part, beside in zip(point, loops.beside, strict=True))
    return AnalyticSolution(symbols, placed, loops, sets, backward, (x, y, z))


def _without_unknowns(form: Form, sets: Sequence[SolvedSet], witness: ModularWitness) -> Form:
    """A form by the equations of sets, where these say it whatever their unknowns are; else as it is."""
    unknowns = [own for part in sets for direction in part.directions for own in direction.unknowns]
    rows = [row for part in sets for row in part.equations]
    if not {*unknowns} & form.keys() or rank([*rows, form], unknowns, witness) > rank(rows, unknowns, witness):
        return form
    values, _ = solved(rows, unknowns, witness)
    return {key: part for key, part in replaced(form, values, witness).items() if key not in unknowns}


def _with_turning_lengths(form: Form, loops: LoopEquations) -> Form:
    """An equation in which a slider oblique to the axis of its turns has the symbol of what turns."""
    own = {key: part for key, part in form.items() if key not in loops.oblique}
    turning = sum(
        (form[length] * across for length, across in loops.oblique.items() if length in form), sympy.Integer(0)
    )
    return own if turning == 0 else {**own, ONE: form.get(ONE, sympy.Integer(0)) + turning}


def _refuse_oblique(forms: Sequence[Form], loops: LoopEquations) -> None:
    """Errors: NotDerivedError, where such a slider has equations beside that of its vector."""
    for length, across in loops.oblique.items():
        if any(part.has(across) for form in forms for part in form.values()):
            name = length.name.removeprefix("q_").replace("_", ".")
            raise NotDerivedError(
                f"{name} slides oblique to the axis about which it turns, and no vector alone says how far"
            )


def _more_than(
    axes: Sequence[Form], forms: Sequence[Form], loops: LoopEquations, witness: ModularWitness
) -> list[Form]:
    """Loop equations that do not follow from those of axes that links share, as they do where all axes meet."""
    if not axes:
        return list(forms)
    keys = list(dict.fromkeys(key for form in (*axes, *forms) for key in form))
    carriers = {unknown for own in loops.carriers for unknown in own.unknowns}
    keys = [key for key in keys if key not in carriers]
    known = [form_of(value_of(form), [key for key in keys if key != ONE], witness) for form in axes]
    size, kept = rank(known, keys, witness), list[Form]()
    for form in forms:
        own = form_of(value_of(form), [key for key in keys if key != ONE], witness)
        if (larger := rank([*known, own], keys, witness)) > size:
            known, size = [*known, own], larger
            kept.append(form)
    return kept
