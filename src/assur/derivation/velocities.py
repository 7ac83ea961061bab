"""Velocity equations Jp v = Jq q', derived from the loop equations: what is passive is eliminated.

Each unknown of the inverse problem has a rate. The loops say linear equations between these, those of the pose and of
the inputs; each circle and each rod says that its rate is across it: c c' + s s' = 0. An equation is divided by what
all of its coefficients share, so that it stays regular where that vanishes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import combinations

import sympy

from assur.derivation.determinant_factors import factors_of
from assur.derivation.elimination import Root, SolvedSet
from assur.derivation.factor_meanings import FactorMeanings
from assur.derivation.linear import ONE, Form, combined, divided, form_of, replaced, solved, sparse, tidy
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.parasitic_rate import parasitic_circle, without_rate
from assur.derivation.quotients import primitive
from assur.derivation.solution import AnalyticSolution
from assur.derivation.space import turning_in_space
from assur.derivation.steady_sums import steady_sum, with_steady_sum
from assur.derivation.symbols import circle_of
from assur.derivation.turning_slides import along_slides
from assur.derivation.unknown_directions import UnknownDirection
from assur.model.mechanism import Joint
from assur.model.pose import ANGLES
from assur.numerics.vectors import Vector, apply, scaled, subtract


@dataclass(frozen=True, eq=False)
class VelocityEquations:
    """Rows of Jp and of Jq, and the factors of their determinants with their powers.

    Attributes:
        jp, jq: (n, n) formulas in the unknowns of the inverse problem, the pose and dimensions.
        parallel, serial: factors of det Jp and det Jq, a number first.
    """

    jp: sympy.Matrix
    jq: sympy.Matrix
    parallel: tuple[tuple[sympy.Expr, int], ...]
    serial: tuple[tuple[sympy.Expr, int], ...]


@lru_cache(maxsize=8)
def velocity_equations(solution: AnalyticSolution) -> VelocityEquations:
    """The velocity equations of an inverse problem that was solved. Errors: NotDerivedError."""
    for what in turning_in_space(solution):
        raise NotDerivedError(f"no velocity equations are derived for {what}")
    return _with_borders(solution, _Velocities(solution).equations())


def _with_borders(solution: AnalyticSolution, equations: VelocityEquations) -> VelocityEquations:
    """The same where a limb that is straight is a factor too.

    Where a root of the inverse problem vanishes, two ways to stand are one, and the links there can move while platform
    and inputs stand. An equation that holds all the same says nothing of that: it is multiplied by what vanishes.
    """
    meanings, known = FactorMeanings(solution), [*equations.parallel, *equations.serial]
    jp, jq, more = equations.jp.copy(), equations.jq.copy(), []
    for part in solution.sets:
        for root in part.roots:
            if any(meanings.proportional(root.quantity, base) for base, _ in known if not base.is_number):
                continue
            if (factor := _knee(part, root, meanings)) is None:
                continue
            row = _row_of(solution, part, jq)
            for matrix in (jp, jq):
                matrix[row, :] = factor * matrix[row, :]
            more.append((factor, 1))
    return VelocityEquations(jp, jq, (*equations.parallel, *more), (*equations.serial, *more)) if more else equations


def _knee(part: SolvedSet, root: Root, meanings: FactorMeanings) -> sympy.Expr | None:
    """The sine of the angle between two links of a set, where that vanishes with its root; else None."""
    circles = [direction.unknowns for direction in part.directions if direction.kind == "circle"]
    sines = (c1 * s2 - c2 * s1 for (c1, s1), (c2, s2) in combinations(circles, 2))
    return next((sine for sine in sines if meanings.proportional(root.quantity, sine)), None)


def _row_of(solution: AnalyticSolution, part: SolvedSet, jq: sympy.Matrix) -> int:
    """The equation of the input that stands in the limb of a set's first link; the first one where there is none."""
    record, links = solution.symbols.record, {*part.directions[0].links}
    limbs = [
        {
            end
            for name in names
            if name in record.joints
            for end in (record.joints[name].parent, record.joints[name].child)
        }
        for names in ((*limb.serial, *limb.loop, *limb.tail) for limb in record.chains.values())
    ]
    fixed = {record.base, record.platform.link}
    for column, driven in enumerate(record.inputs):
        joint = record.joints[driven.coordinate.joint]
        own = [limb for limb in limbs if ({joint.parent, joint.child} - fixed) & limb and (links - fixed) & limb]
        rows = [row for row in range(jq.rows) if jq[row, column] != 0]
        if own and rows:
            return rows[0]
    return 0


class _Velocities:
    def __init__(self, solution: AnalyticSolution) -> None:
        self.solution, self.symbols, self.witness = solution, solution.symbols, solution.symbols.witness
        self.record = self.symbols.record
        self.circles = [own.unknowns for own in solution.loops.directions if own.kind == "circle"]
        self.pose = [sympy.Symbol(f"d_{name}", real=True) for name in self.record.platform.pose]
        self.inputs = [sympy.Symbol(f"d_{driven.name}", real=True) for driven in self.record.inputs]
        self.passive: list[sympy.Symbol] = []
        self.steady: list[tuple[sympy.Expr, sympy.Expr]] = []
        self.carriers: dict[UnknownDirection, sympy.Symbol] = {}
        self.parasitic = parasitic_circle(solution)
        if self.parasitic is not None:
            self.carriers[self.parasitic] = sympy.Symbol(f"d_{self.parasitic.name}", real=True)
        self.rates = dict(self._rates())

    def equations(self) -> VelocityEquations:
        driven = [*self._driven()]
        loops = sparse(self.solution.loops.forms, self.witness, everywhere=True)
        loops += [form for forms in self.solution.loops.cranks.values() for form in forms]
        forms = along_slides(map(self._rate, loops), self.passive, self.circles, self.witness)
        values, rows = solved(forms, self.passive, self.witness)
        for direction in self.solution.loops.directions:
            if direction not in driven and direction not in self.carriers:
                across = {self.rates[unknown]: unknown for unknown in direction.unknowns}
                rows.append(replaced(across, values, self.witness))
        _, rows = solved(rows, self.passive, self.witness)
        rows = [divided(self._alike(row)) for row in rows if row]
        if self.parasitic is not None:
            rows = [{key: self._on_circles(part) for key, part in row.items()} for row in rows]
            rate = self.carriers[self.parasitic]
            return VelocityEquations(*without_rate(self.solution, rows, rate, self.pose, self.inputs))
        rows = [divided(row) for row in sparse(rows, self.witness, everywhere=True)]
        size = len(self.pose)
        if len(rows) != size or len(self.inputs) != size:
            raise NotDerivedError(f"{len(rows)} velocity equations for {size} rates of the pose")
        rows = [{key: self._on_circles(part) for key, part in row.items()} for row in rows]
        looked_at = set[sympy.Expr]()
        while True:
            jp = sympy.Matrix([[row.get(rate, 0) for rate in self.pose] for row in rows])
            jq = sympy.Matrix([[-row.get(rate, 0) for rate in self.inputs] for row in rows])
            parallel, serial = (self._on_given_circles(factors_of(own)) for own in (jp, jq))
            shared = {base for base, _ in parallel} & {base for base, _ in serial if base.free_symbols} - looked_at
            better = self._regular(rows, shared) if shared and not looked_at else None
            if better is None:
                return VelocityEquations(jp, jq, parallel, serial)
            looked_at, rows = shared, better

    def _on_given_circles(self, factors: tuple[tuple[sympy.Expr, int], ...]) -> tuple[tuple[sympy.Expr, int], ...]:
        """Factors without those that are sums of the squares of a cosine and its sine, or sums that loops keep."""
        plain = [(self._on_circles(base), power) for base, power in factors]
        for total, whole in self.steady:
            plain = [(with_steady_sum({ONE: base}, total, whole)[ONE], power) for base, power in plain]
        number = sympy.prod([base**power for base, power in plain if base.is_number])
        return ((number, 1), *((base, power) for base, power in plain if not base.is_number))

    def _regular(self, rows: list[Form], shared: set[sympy.Expr]) -> list[Form] | None:
        """Equations two of which were multiples of each other where a shared factor vanishes; None: there are none.

        Of a and b, whose sum l a + m b has the factor, that sum without it and l b - m a take the place: these say the
        same but where l and m vanish together. Where loops keep a sum of multiples of l and m as it is, they do so
        nowhere, and by these multiples nothing is added that could vanish.
        """
        shares = [
            (i, j, *primitive([rows[j][key], -rows[i][key]]))
            for i, j in combinations(range(len(rows)), 2)
            for key in rows[i]
            if key in rows[j]
        ]
        for i, j, first, second in sorted(shares, key=lambda own: sympy.count_ops(own[2:])):
            if {first, second} & shared:
                continue
            total = self._sum(rows[i], first, rows[j], second)
            if any(self.witness.is_zero(part) for part in total.values()) or not total:
                continue
            plain = divided(total)
            own = next(iter(total))
            factor, _ = sympy.fraction(tidy(total[own] / plain[own]))
            if not {part for part, _ in sympy.factor_list(factor)[1]} & shared:
                continue
            if (steady := steady_sum(self.solution, first, second)) is None:
                across = divided(self._sum(rows[j], first, rows[i], -second))
            else:
                along, other, whole = steady
                across = self._sum(rows[j], along, rows[i], -other)
                total = along * first + other * second
                across = divided(with_steady_sum(across, total, whole))
                self.steady.append((total, whole))
            return [plain if k == i else across if k == j else row for k, row in enumerate(rows)]
        return None

    def _sum(self, first: Form, share: sympy.Expr, second: Form, other: sympy.Expr) -> Form:
        """Multiples of two equations added up."""
        return combined({key: tidy(share * part) for key, part in first.items()}, other, second, self.witness)

    def _on_circles(self, entry: sympy.Expr) -> sympy.Expr:
        """A number where an entry is a multiple of the sum of the squares of a cosine and its sine; else the entry."""
        own = sympy.expand(entry)
        for cosine, sine in (*self.circles, *self.symbols.circles):
            own = sympy.expand(own.subs(sine**2, 1 - cosine**2))
        return own if own.is_number else entry

    def _alike(self, row: Form) -> Form:
        """A row in which of unknowns that are multiples of each other, by dimensions alone, one is left."""
        return {key: part.subs(self._multiples) for key, part in row.items()}

    @cached_property
    def _multiples(self) -> dict[sympy.Symbol, sympy.Expr]:
        """Unknown -> a multiple of another, by dimensions alone; of what the pose says alone the first is kept."""
        alike: dict[sympy.Symbol, sympy.Expr] = {}
        posed: dict[sympy.Symbol, sympy.Expr] = {}
        parameters = {*self.symbols.parameters.values()}
        for form in sparse(self.solution.loops.forms, self.witness):
            unknowns = [key for key in form if isinstance(key, sympy.Symbol)]
            if len(form) != 2 or not unknowns:
                continue
            (first, a), others = (unknowns[0], form[unknowns[0]]), unknowns[1:]
            if others:
                known = {others[0]: tidy(-form[others[0]] / a)}
            else:
                posed[first] = tidy(-form[ONE] / a)
                known = {other: tidy(posed[first] / value) for other, value in posed.items() if other != first}
            for second, ratio in known.items():
                if not ratio.free_symbols - parameters:
                    alike[first] = ratio * second
                    break
        return alike

    def _driven(self) -> Iterator[UnknownDirection]:
        """Circles of links that inputs turn."""
        for driven in self.record.inputs:
            if driven.coordinate.kind == "angle":
                yield self._circle(self._turning(self.record.joints[driven.coordinate.joint]))

    def _turning(self, joint: Joint) -> str:
        """The link that a driven joint turns: its parent where the child, as a platform, stands fast."""
        parent, child = (self.solution.placed.links[link] for link in (joint.parent, joint.child))
        return joint.parent if parent.axis is not None and child.axis is None and child.hinge is None else joint.child

    def _circle(self, link: str) -> UnknownDirection:
        for direction in self.solution.loops.directions:
            if direction.kind == "circle" and link in direction.links:
                return direction
        raise NotDerivedError(f"{link} is driven, and on no circle")

    def _rates(self) -> Iterator[tuple[sympy.Symbol, sympy.Expr]]:
        """Symbol -> its rate."""
        for name, rate in zip(self.record.platform.pose, self.pose, strict=True):
            if name in ANGLES:
                cosine, sine = circle_of(name)
                yield from ((cosine, -sine * rate), (sine, cosine * rate))
            else:
                yield sympy.Symbol(name, real=True), rate
        lengths = self.solution.loops.lengths
        for driven, rate in zip(self.record.inputs, self.inputs, strict=True):
            index = driven.coordinate.index
            if index in lengths:
                yield lengths[index], int(driven.sign) * rate
            else:
                joint = self.record.joints[driven.coordinate.joint]
                direction, sense = self._circle(self._turning(joint)), self._sense(joint.name) * int(driven.sign)
                cosine, sine = direction.unknowns
                whole = sense * rate + self._carried(joint)
                yield from ((cosine, -sine * whole), (sine, cosine * whole))
        driven_items = [*self._driven()]
        indices = {driven.coordinate.index for driven in self.record.inputs}
        free = [symbol for index, symbol in lengths.items() if index not in indices]
        free += [
            unknown
            for direction in self.solution.loops.directions
            if direction not in driven_items and direction not in self.carriers
            for unknown in direction.unknowns
        ]
        for direction, rate in self.carriers.items():
            cosine, sine = direction.unknowns
            yield from ((cosine, -sine * rate), (sine, cosine * rate))
        for unknown in free:
            rate = sympy.Symbol(f"d_{unknown.name}", real=True)
            self.passive.append(rate)
            yield unknown, rate

    def _carried(self, joint: Joint) -> sympy.Expr:
        """The rate of what carries a driven joint, about the axis of its child."""
        carrier, child = (self.solution.placed.links[link] for link in (joint.parent, joint.child))
        if carrier.axis is None or child.axis is None:
            return sympy.Integer(0)
        direction = self._circle(joint.parent)
        same = all(map(self.witness.is_zero, subtract(carrier.axis, child.axis)))
        for driven, input_rate in zip(self.record.inputs, self.inputs, strict=True):
            turned = self.record.joints[driven.coordinate.joint]
            if driven.coordinate.kind == "angle" and self._circle(self._turning(turned)) == direction:
                own = self._sense(turned.name) * int(driven.sign) * input_rate + self._carried(turned)
                return own if same else -own
        rate = sympy.Symbol(f"d_angle_{direction.name}", real=True)
        if rate not in self.passive:
            self.passive.append(rate)
            self.carriers[direction] = rate
        return rate if same else -rate

    def _sense(self, name: str) -> int:
        """Whether a driven joint turns its link about the circle's axis, or against it."""
        joint, links = self.record.joints[name], self.solution.placed.links
        turning = self._turning(joint)
        own, other = links[turning], links[joint.parent if turning == joint.child else joint.child]
        if other.hinge is not None or own.axis is None:
            raise NotDerivedError(f"{name} is driven, and what carries it turns about two axes")
        axis: Vector = apply(other.constant, self.symbols.geometry.joints[name].axes[0])
        same = all(map(self.witness.is_zero, subtract(axis, own.axis)))
        if not same and not all(map(self.witness.is_zero, subtract(scaled(axis, -1), own.axis))):
            raise NotDerivedError(f"{name} is driven about another axis than its link turns")
        return 1 if same == (turning == joint.child) else -1

    def _rate(self, form: Form) -> Form:
        expression = sum((part * key for key, part in form.items()), sympy.Integer(0))
        total = sum(expression.diff(symbol) * rate for symbol, rate in self.rates.items())
        return form_of(total, [*self.passive, *self.carriers.values(), *self.pose, *self.inputs], self.witness)
