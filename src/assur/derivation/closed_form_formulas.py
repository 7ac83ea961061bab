"""The formulas of a closed form: what is solved, and in the same unknowns inputs, signs, margins and factors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import sympy

from assur.derivation.circle_pairs import PairEliminant
from assur.derivation.definitions import FreeNames
from assur.derivation.direct_pose import direct_rest, hinge_angles, of_triangle, turned_by, upright
from assur.derivation.elimination import SolvedSet
from assur.derivation.joint_formulas import SolvedJoints, joint_formulas
from assur.derivation.linear import ONE, divisors
from assur.derivation.mirror_polynomials import MirrorPolynomials, mirror_polynomials
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.sizes import Sizes
from assur.derivation.solution import AnalyticSolution
from assur.derivation.symbols import circle_of
from assur.derivation.three_quadrics import ThreeQuadrics, three_quadrics
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.velocities import VelocityEquations, velocity_equations
from assur.kinematics.modes import Problem
from assur.model.pose import ANGLES
from assur.numerics.vectors import dot

ZERO = sympy.Integer(0)
LENIENT = 2
"""So much larger a direct problem's margins may be: it finds again what the inverse problem gives at its borders."""
APART = sympy.Symbol("apart", real=True)
"""Of a root in askew coordinates: a square without scale that vanishes where two solutions have the same one."""
ASIDE = sympy.Symbol("aside", real=True)
"""1 less the square of a cosine or a sine: two solutions that are mirror images merge where it vanishes."""


@dataclass(frozen=True)
class SignProduct:
    """What a root's sign has beside its name, where it is a product.

    Attributes:
        names: of further signs.
        divisors: what was divided by, whose signs it has too.
    """

    names: tuple[str, ...] = ()
    divisors: tuple[sympy.Expr, ...] = ()


@dataclass(frozen=True, eq=False)
class ClosedFormFormulas:
    """Formulas of a mechanism whose direct and inverse problems were solved.

    Attributes:
        direct, inverse: the solutions.
        signs: problem, symbol of a root -> the name of its sign, and whether it is that sign or its opposite.
        factor_signs: name of a sign that no root has -> a formula that has it.
        products: problem, symbol of a root -> what its sign is multiplied with.
    """

    direct: AnalyticSolution
    inverse: AnalyticSolution
    signs: Mapping[tuple[Problem, sympy.Symbol], tuple[str, int]]
    factor_signs: Mapping[str, sympy.Expr] = field(default_factory=dict)
    products: Mapping[tuple[Problem, sympy.Symbol], SignProduct] = field(default_factory=dict)

    def solution(self, problem: Problem) -> AnalyticSolution:
        """Of one problem."""
        return self.direct if problem == "direct" else self.inverse

    def in_unknowns(self, solution: AnalyticSolution, value: sympy.Expr) -> sympy.Expr:
        """A formula with what is defined written out, down to the unknowns of the solution."""
        kept = {unknown for direction in solution.loops.directions for unknown in direction.unknowns}
        kept |= {*solution.loops.strokes}
        known = {own.symbol: own.formula for own in solution.definitions if own.symbol not in kept}
        while defined := value.free_symbols & known.keys():
            value = value.subs({symbol: known[symbol] for symbol in defined})
        return value

    @property
    def relations(self) -> tuple[str, ...]:
        """Dimensions as what others say that they are, of either problem."""
        both = (*self.direct.loops.relations, *self.inverse.loops.relations)
        return tuple(dict.fromkeys(f"{own.symbol} = {own.formula}" for own in both))

    @cached_property
    def joints(self) -> SolvedJoints:
        """Formulas of all joints."""
        return joint_formulas(self.inverse)

    @cached_property
    def velocities(self) -> VelocityEquations:
        """Jp and Jq."""
        return velocity_equations(self.inverse)

    @cached_property
    def unknowns(self) -> list[sympy.Symbol]:
        """What the core is made of, beside the pose: unknowns of the inverse problem."""
        lengths = [*self.inverse.loops.lengths.values()]
        return lengths + [unknown for direction in self.inverse.loops.directions for unknown in direction.unknowns]

    @cached_property
    def posed(self) -> list[sympy.Symbol]:
        """Symbols of the pose."""
        names = self.inverse.symbols.record.platform.pose
        return [symbol for name in names for symbol in (circle_of(name) if name in ANGLES else (_real(name),))]

    @cached_property
    def posed_pairs(self) -> list[Any]:
        """Coordinates of the pose as a branch has them."""
        names = self.inverse.symbols.record.platform.pose
        return [circle_of(name) if name in ANGLES else _real(name) for name in names]

    @cached_property
    def printed_inputs(self) -> list[Any]:
        """Symbols of the inputs of the direct problem."""
        record = self.direct.symbols.record
        return [
            circle_of(driven.name) if driven.coordinate.kind == "angle" else _real(driven.name)
            for driven in record.inputs
        ]

    @cached_property
    def input_pairs(self) -> list[Any]:
        """Inputs as formulas of the unknowns of the inverse problem."""
        own: list[Any] = []
        for driven in self.inverse.symbols.record.inputs:
            name = driven.coordinate.joint
            value: Any = self.joints.values.get(name, self.joints.values.get(f"{name}.{driven.coordinate.component}"))
            if driven.coordinate.kind == "angle":
                if driven.offset:
                    raise NotDerivedError(f"{driven.name} is an angle with an offset")
                cosine, sine = value
                own.append((cosine, int(driven.sign) * sine))
            else:
                own.append(value * int(driven.sign) + sympy.nsimplify(driven.offset, rational=True))
        return own

    def rest(self, problem: Problem) -> Iterator[tuple[sympy.Symbol, sympy.Expr]]:
        """What the core asks for and the problem's own formulas do not say."""
        if problem == "direct":
            yield from direct_rest(self.direct, self.inverse)

    @cached_property
    def three_quadrics(self) -> ThreeQuadrics | None:
        """Those of the set with a polynomial of the direct problem, where it leaves three."""
        part = next((part for part in self.direct.sets if part.eliminant is not None), None)
        return None if part is None else three_quadrics(part, self.direct.symbols.witness)

    @cached_property
    def mirrored(self) -> MirrorPolynomials | None:
        """The polynomial of the direct problem in components and sides, where it is one in even powers."""
        record = self.direct.symbols.record
        names = FreeNames({*record.parameters, *record.modes.working, *record.modes.assembly, *self.sign_values})
        return mirror_polynomials(self.direct, names)

    @cached_property
    def three_circles(self) -> tuple[UnknownDirection, ...]:
        """Those that a polynomial of the direct problem is left of, where they carry the balls of one link."""
        own = self.direct.eliminant
        return (own.direction, *own.pair.circles) if isinstance(own, PairEliminant) and own.pair is not None else ()

    @property
    def sides(self) -> list[Any]:
        """The square of each side between such balls, and its parts: beside, and of each circle."""
        own = self.direct.eliminant
        values = own.pair.values if isinstance(own, PairEliminant) and own.pair is not None else {}
        forms = ([values[unknown] for unknown in side.unknowns] for side in self.direct.loops.directions
                 if side.kind == "side")  # fmt: skip
        squares = (side.square for side in self.direct.loops.directions if side.kind == "side")
        parts = [[(form.get(ONE, ZERO), [tuple(form.get(unknown, ZERO) for unknown in circle.unknowns)
                 for circle in self.three_circles]) for form in side] for side in forms]  # fmt: skip
        return [*zip(squares, parts, strict=True)]

    def margins(self, problem: Problem) -> Iterator[tuple[str, sympy.Expr]]:
        """Names and formulas of what must not vanish, and of radicands."""
        solution = self.solution(problem)
        for part in solution.sets:
            three = self.three_quadrics if problem == "direct" and part.eliminant is not None else None
            for number, condition in enumerate(part.conditions if three is None else three.conditions, start=1):
                if self._divides(solution, part, condition):
                    yield self._condition_name(condition, part.directions[0].name, number), condition
            if three is not None:
                yield APART.name, APART
            if problem == "direct" and part.eliminant is not None and self.mirrored is not None:
                yield ASIDE.name, ASIDE
            for root in part.roots:
                yield root.radicand.name, root.radicand
        if of_triangle(self.direct):
            yield from upright(problem)
        for tilt in self.joints.tilts:
            yield f"upright_{tilt.name.removeprefix('tilt_')}", 1 + dot(tilt.line, tilt.direction)
        for value, own in self.joints.leaning.items():
            yield f"{'room' if value == own.room else 'square'}_{own.name}", value

    def _divides(self, solution: AnalyticSolution, part: SolvedSet, condition: sympy.Expr) -> bool:
        """Whether a condition is of more than dimensions, and of a polynomial's unknowns one that is divided by."""
        if not self.in_unknowns(solution, condition).free_symbols - {*self.inverse.symbols.parameters.values()}:
            return False
        if part.eliminant is None or condition.is_Symbol:
            return True
        under = {factor for own in part.definitions for factor in divisors(own.formula)}
        return bool({*divisors(1 / condition)} & under)

    def _condition_name(self, condition: sympy.Expr, link: str, number: int) -> str:
        return condition.name if condition.is_Symbol else f"c{number}_{link}"

    @cached_property
    def direct_divisors(self) -> list[sympy.Expr]:
        """What the roots of the direct problem are divided by and what is no sum of squares: its sign may be either."""
        if self.direct.eliminant is not None:
            return []
        squares = {own.symbol for own in self.direct.definitions if _is_sum_of_squares(own.formula)}
        divisors = [own for name, own in self.margins("direct") if own not in {*squares}]
        radicands = {root.radicand for root in self.direct.roots}
        tilted = {1 + dot(tilt.line, tilt.direction) for tilt in self.joints.tilts}
        others = radicands | tilted | self.joints.leaning.keys()
        return [own for own in dict.fromkeys(divisors) if own not in others]

    def of_direct(self, value: sympy.Expr) -> sympy.Expr:
        """A formula of the direct problem in the unknowns of the inverse one."""
        return self.in_unknowns(self.direct, value).subs(self.inputs_in_unknowns)

    def sign_product(self, problem: Problem, root: sympy.Symbol) -> SignProduct:
        """What the sign of a root is multiplied with."""
        return self.products.get((problem, root), SignProduct())

    @property
    def one_sided(self) -> bool:
        """Whether legs keep the sign of their length at home."""
        return any(not name for name, _ in self.signs.values())

    def merging(self, problem: Problem, root: sympy.Symbol) -> tuple[str, ...]:
        """The signs that change where a root vanishes: those of whose products it is one factor."""
        return tuple(name for name, roots in self._named_roots(problem).items() if root in roots)

    def _named_roots(self, problem: Problem) -> dict[str, set[sympy.Symbol]]:
        """Name of a sign -> the roots whose signs it is the product of: the products of names, solved for these."""
        names = {
            root.symbol: {self.signs[problem, root.symbol][0], *self.sign_product(problem, root.symbol).names}
            for root in self.solution(problem).roots
            if self.signs[problem, root.symbol][0]
        }
        made = {symbol: {symbol} for symbol in names}
        pivots: dict[str, sympy.Symbol] = {}
        for symbol in names:
            name = min(names[symbol])
            pivots[name] = symbol
            for other in names:
                if other != symbol and name in names[other]:
                    names[other], made[other] = names[other] ^ names[symbol], made[other] ^ made[symbol]
        order = {self.signs[problem, symbol][0]: None for symbol in names}
        return {name: made[pivots[name]] for name in order}

    @cached_property
    def sign_values(self) -> dict[str, sympy.Expr]:
        """Name of a sign -> what it is the sign of, in the unknowns of the inverse problem and the pose."""
        values = dict(self.factor_signs)
        for solution in (self.inverse, self.direct):
            problem = solution.symbols.problem
            quantities = {
                root.symbol: self.signs[problem, root.symbol][1]
                * root.quantity
                * sympy.prod(self.sign_product(problem, root.symbol).divisors)
                for root in solution.roots
            }
            for name, roots in self._named_roots(problem).items():
                value = self.in_unknowns(solution, sympy.prod([quantities[root] for root in sorted(roots, key=str)]))
                if solution is self.direct:
                    value = value.subs(self.inputs_in_unknowns)
                values[name] = sympy.factor_terms(value)
        return values

    @cached_property
    def inputs_in_unknowns(self) -> dict[sympy.Symbol, sympy.Expr]:
        """Symbols of the direct problem's inputs as formulas of the inverse problem's unknowns."""
        pairs = zip(self.printed_inputs, self.input_pairs, strict=True)
        posed = [name for name in self.direct.symbols.record.platform.pose if name in ANGLES]
        if of_triangle(self.direct):
            posed = []
        values: dict[sympy.Symbol, sympy.Expr] = {}
        for name in posed:
            values |= dict(zip(turned_by(self.direct, name), circle_of(name), strict=True))
        for printed, own in pairs:
            values |= dict(zip(printed, own, strict=True)) if isinstance(printed, tuple) else {printed: own}
        for name in posed:  # of the platform's own angle
            values |= dict(zip(turned_by(self.direct, name), circle_of(name), strict=True))
        values |= {
            symbol: self.in_unknowns(self.direct, own).subs(values)
            for symbol, own in hinge_angles(self.direct, self.inverse)
        }
        return {symbol: own for symbol, own in values.items() if symbol not in self.unknowns}

    @cached_property
    def factors(self) -> list[tuple[str, str, sympy.Expr]]:
        """Name, kind and value of each factor of both determinants, numbers and dimensions in the first ones."""
        own: list[tuple[str, str, sympy.Expr]] = []
        parameters = {*self.inverse.symbols.parameters.values()}
        for kind, letter, powers in (
            ("parallel", "f", self.velocities.parallel), ("serial", "g", self.velocities.serial),
        ):  # fmt: skip
            constants = [base for base, power in powers for _ in range(power) if not base.free_symbols - parameters]
            varying = [base for base, power in powers for _ in range(power) if base.free_symbols - parameters]
            if not varying:
                if sympy.simplify(sympy.prod(constants) - 1) != 0:
                    varying = [sympy.prod(constants)]
                constants = []
            for k, constant in enumerate(constants):
                varying[k % len(varying)] *= constant
            own += [(f"{letter}{k}", kind, value) for k, value in enumerate(varying, start=1)]
        return own or [("f1", "parallel", sympy.Integer(1))]  # where inputs are the pose's coordinates

    def is_shared(self, value: sympy.Expr) -> bool:
        """Whether both determinants have a factor, but for dimensions."""
        parameters = {*self.inverse.symbols.parameters.values()}
        alike = {kind for _, kind, own in self.factors if not sympy.cancel(own / value).free_symbols - parameters}
        return len(alike) > 1

    def unit(self, value: sympy.Expr) -> int:
        """Power of the length unit."""
        return self._sizes.unit(value)

    def scale(self, value: sympy.Expr) -> str:
        """A formula of dimensions: the size of a quantity, its terms added up."""
        return self._sizes.scale(value)

    def margin_scale(self, problem: Problem, value: sympy.Expr) -> str:
        """The same of a margin, by what its terms are at home."""
        solution = self.solution(problem)
        formulas = {own.symbol: own.formula for own in solution.definitions}
        formula, home = formulas.get(value, value), solution.symbols.witness.home
        known = formula.free_symbols <= home.keys()  # what follows of a polynomial's root is not
        terms = sympy.Add.make_args(formula) if known else ()
        lenient = LENIENT if problem == "direct" else 1
        at_home = lenient * sum(abs(solution.symbols.witness.at_home(term)) for term in terms) if known else None
        return self._sizes.scale(self.in_unknowns(solution, value), at_home)

    @cached_property
    def _sizes(self) -> Sizes:
        return Sizes(self.inverse, frozenset(own for own in self.printed_inputs if not isinstance(own, tuple)))


def _is_sum_of_squares(formula: sympy.Expr) -> bool:
    return all(part.is_Pow and part.exp == 2 for part in sympy.Add.make_args(formula))


def _real(name: str) -> sympy.Symbol:
    return sympy.Symbol(name, real=True)
