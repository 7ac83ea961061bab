"""What holds where a condition of a set does not: the set derived again, with inputs for which it vanishes.

A sum of squares of real numbers vanishes where each does, a product where a factor does. Each such case is told to a
witness: a length, a dimension or an angle that is given becomes what makes the factor vanish. Then the set is solved
again. Where fewer equations are left than the unknowns need, the links move while everything that is given stands.

Of a coupled set the solutions are counted there, by a Groebner basis. Its determinant is another matter: the polynomial
vanishes at every solution, also where the determinant does, and both have no root in common for general inputs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Literal

import sympy
from sympy.polys.polyerrors import PolynomialError

from assur.derivation.definitions import Definition
from assur.derivation.elimination import SolvedSet, meeting
from assur.derivation.linear import ONE, never_zero, rank, value_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.residue_systems import residue_system
from assur.derivation.solution import AnalyticSolution
from assur.derivation.witness import ModularWitness, NoResidueRootError
from assur.numerics.prime_field import LARGE, SMALL

SEEDS = range(1, 7)
"""Of the two angles at which a line meets a circle each is one of the draws, by the sign of the residue's root.
Solutions of a coupled set are counted at two of them."""
ZERO = sympy.Integer(0)
MOST = 16
"""Cases of one condition that are looked at."""
SECONDS = 10.0
"""Of the processor, for the solutions of a coupled set in one case."""
LONG = 400
"""Operations of a condition, written out, that is left open."""


Outcome = Literal["self-motion", "roots", "no solution", "apart", "open"]


@dataclass(frozen=True)
class ClosedCondition:
    """One case in which a condition does not hold.

    Attributes:
        condition: what vanishes.
        vanish: the factors that do in this case, written out.
        outcome: "self-motion", "roots", "no solution", or "open"; of the determinant of a coupled set "apart": it fails
            at no solution, but for inputs at which the polynomial has a root with it in common.
        freedoms: of the self-motion.
        links: that move so, the first of them freely.
        formulas: what else follows of the unknowns of the first, each zero.
    """

    condition: sympy.Expr
    vanish: tuple[sympy.Expr, ...]
    outcome: Outcome
    freedoms: int = 0
    links: tuple[str, ...] = ()
    formulas: tuple[sympy.Expr, ...] = ()


def closed_conditions(solution: AnalyticSolution) -> Iterator[ClosedCondition]:
    """All cases of all conditions of a solution.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> own = next(closed_conditions(analytic_solution(load_record("zeng2019"), "direct")))
    >>> own.vanish, own.outcome, own.links
    ((l3 - yA1 + yA2,), 'self-motion', ('link9', 'link10'))
    """
    for place, part in enumerate(solution.sets):
        for condition in part.conditions:
            yield from _cases(solution, place, part, condition)
    yield from (ClosedCondition(condition, (), "open") for condition in solution.length_conditions)


def _cases(solution: AnalyticSolution, place: int, part: SolvedSet, condition: sympy.Expr) -> Iterator[ClosedCondition]:
    left = ClosedCondition(condition, (), "open")
    if part.eliminant and condition in part.eliminant.divisors:
        yield ClosedCondition(condition, (), "apart")
        return
    components = [_factors(own, part) for own in _squares(condition, part)]
    if None in components:
        yield left
        return
    if not all(components):
        return  # a square that never vanishes
    choices = dict.fromkeys(
        tuple(sorted({*choice} - {ZERO}, key=str)) for choice in product(*(own or () for own in components))
    )
    if len(choices) > MOST:
        yield left
        return
    for vanish in choices:
        seeds = SEEDS[:2] if part.eliminant else SEEDS
        own_cases = (_Case(solution, place, part, condition, vanish, seed).closed() for seed in seeds)
        yield from dict.fromkeys(own for own in own_cases if own is not None)


def _squares(condition: sympy.Expr, part: SolvedSet) -> list[sympy.Expr]:
    """Of a sum of squares what is squared, else the formula."""
    names = {own.symbol: own.formula for own in part.definitions}
    formula = names.get(condition, condition)
    terms = sympy.Add.make_args(formula)
    if len(terms) > 1 and all(own.is_Pow and own.exp == 2 for own in terms):
        return [own.base for own in terms]
    return [formula]


def _factors(formula: sympy.Expr, part: SolvedSet) -> tuple[sympy.Expr, ...] | None:
    """Factors that may vanish, names written out; None where they are not found."""
    unknowns = {own for direction in part.directions for own in direction.unknowns}
    for own in reversed(part.definitions):
        if own.symbol not in unknowns:
            formula = formula.subs(own.symbol, own.formula)
    if int(sympy.count_ops(formula)) > LONG:
        return None
    over = sympy.expand(sympy.fraction(sympy.together(formula))[0])
    if over.is_number:
        return () if over != 0 else (over,)
    try:
        factors = sympy.factor_list(over)[1]
    except PolynomialError:  # of roots of dimensions
        return None
    return tuple(factor for factor, _ in factors if not never_zero(factor))


class _Case:
    """Factors that vanish together, at values that a seed draws."""

    def __init__(
        self,
        solution: AnalyticSolution,
        place: int,
        part: SolvedSet,
        condition: sympy.Expr,
        vanish: tuple[sympy.Expr, ...],
        seed: int,
    ) -> None:
        self.solution, self.place, self.part, self.seed = solution, place, part, seed
        self.plain = ClosedCondition(condition, vanish, "open")
        self.used: set[sympy.Symbol] = set()
        for relation in solution.loops.relations:
            self.used |= {relation.symbol, *relation.formula.free_symbols}
        self.before = [own for part in solution.sets[:place] for own in part.definitions]

    def closed(self) -> ClosedCondition | None:
        """What holds; None where the case cannot be."""
        try:
            witness = ModularWitness(self.seed, SMALL if self.part.eliminant else LARGE)
            for cosine, sine in self.solution.symbols.circles:
                witness.on_circle(cosine, sine)
            solved = {own.symbol for own in self.before}
            late = [own for own in self.plain.vanish if own.free_symbols & solved]
            early = [own for own in self.plain.vanish if own not in late]
            if not all(self._vanishes(own, witness) for own in sorted(early, key=lambda own: bool(self._free(own)))):
                return self.plain
            witness = self.solution.witness_before(self.place, self.seed, witness)
            witness.home = dict(self.solution.symbols.witness.home)
            witness.draw_again()  # what is solved before follows of what was chosen
            self.used |= {symbol for own in self.before for symbol in own.formula.free_symbols}
            if not all(self._vanishes(own, witness) for own in late):
                return self.plain
            if self._impossible(witness):
                return None
            return self._derived(witness)
        # TimeoutError: not counted; ValueError: a division by what vanishes too
        except (NotDerivedError, NoResidueRootError, TimeoutError, ValueError):
            return self.plain

    def _free(self, factor: sympy.Expr) -> list[sympy.Symbol]:
        """Lengths and dimensions that may be chosen so that a factor vanishes, inputs and coordinates first."""
        angles = {own for circle in self.solution.symbols.circles for own in circle}
        dimensions = {*self.solution.symbols.parameters.values()}
        earlier = {own for part in self.solution.sets for direction in part.directions for own in direction.unknowns}
        choices = factor.free_symbols - angles - earlier - self.used
        free = [own for own in choices if own not in sympy.expand(factor.diff(own)).free_symbols]
        return sorted(free, key=lambda own: (own in dimensions, own.name))

    def _vanishes(self, factor: sympy.Expr, witness: ModularWitness) -> bool:
        """Tell the witness what makes a factor vanish, if something does and it does not already."""
        if witness.is_zero(factor):
            return True
        for symbol in self._free(factor):
            share = sympy.expand(factor.diff(symbol))
            if not witness.is_zero(share):
                witness.define(symbol, -factor.subs(symbol, 0) / share)
                return self._holds(factor, witness)
        for circle in self.solution.symbols.circles:
            if {*circle} & factor.free_symbols and not {*circle} & self.used:
                return self._turned(factor, circle, witness)
        return False

    def _turned(self, factor: sympy.Expr, circle: Sequence[sympy.Symbol], witness: ModularWitness) -> bool:
        """By the angle of a circle on which a factor is a line: a c + b s = d."""
        cosine, sine = circle
        a, b = (sympy.expand(factor).coeff(own) for own in circle)
        d = -factor.subs(dict.fromkeys(circle, 0))
        if not witness.is_zero(a * cosine + b * sine - d - factor) or {*circle} & (a.free_symbols | b.free_symbols):
            return False
        square = a**2 + b**2
        root = sympy.sqrt(square - d**2)
        witness.define(cosine, (a * d - b * root) / square)
        witness.define(sine, (b * d + a * root) / square)
        return self._holds(factor, witness)

    def _holds(self, factor: sympy.Expr, witness: ModularWitness) -> bool:
        """Whether a factor vanishes with what was defined last; all is drawn anew, since it had another value."""
        self.used |= factor.free_symbols
        witness.draw_again()
        return witness.is_zero(factor)

    def _impossible(self, witness: ModularWitness) -> bool:
        """Whether a dimension vanishes that is positive, or an axis has no direction."""
        symbols = self.solution.symbols
        try:
            for joint in symbols.geometry.joints.values():
                for axis in joint.axes:
                    [witness.is_zero(part) for part in axis]
        except ValueError:  # a division by its length
            return True
        return any(witness.is_zero(own) for own in symbols.parameters.values() if own.is_positive)

    def _derived(self, witness: ModularWitness) -> ClosedCondition:
        part = self.part
        if part.eliminant is not None:
            return self._counted(part.eliminant.known, witness)
        unknowns = {own for direction in part.directions for own in direction.unknowns}
        roots = {root.symbol for root in part.roots}
        for own in part.definitions:
            if own.symbol in unknowns | roots:
                break
            witness.define(own.symbol, own.formula)
        forms = [{key: share for key, share in form.items() if not witness.is_zero(share)} for form in part.equations]
        forms = [form for form in forms if form]
        if any({*form} == {ONE} for form in forms):
            return self._case("no solution")
        values, lines, base = meeting(part.directions, forms, witness)
        count = rank(lines, base.unknowns, witness)
        if rank(lines, (*base.unknowns, ONE), witness) > count:
            return self._case("no solution")
        freedoms = base.freedoms - count
        if freedoms <= 0:
            return self._case("roots")
        links = tuple(dict.fromkeys((base.name, *(own.name for own in part.directions))))
        follows = (key - value_of(form) for key, form in values.items())
        return ClosedCondition(self.plain.condition, self.plain.vanish, "self-motion", freedoms, links, tuple(follows))

    def _counted(self, known: Sequence[Definition], witness: ModularWitness) -> ClosedCondition:
        """What a coupled set has for solutions."""
        for own in known:
            witness.define(own.symbol, own.formula)
        directions = self.part.directions
        unknowns = [unknown for direction in directions for unknown in direction.unknowns]
        equations = [*map(value_of, self.part.equations)]
        equations += [direction.quadric for direction in directions if direction.kind != "stroke"]
        system = residue_system(equations, unknowns, witness)
        if system is None:
            return self.plain
        freedoms = system.dimension(SECONDS)
        if freedoms <= 0:
            return self._case("roots" if freedoms == 0 else "no solution")
        links = tuple(own.name for own in directions)
        return ClosedCondition(self.plain.condition, self.plain.vanish, "self-motion", freedoms, links)

    def _case(self, outcome: Outcome) -> ClosedCondition:
        return ClosedCondition(self.plain.condition, self.plain.vanish, outcome)
