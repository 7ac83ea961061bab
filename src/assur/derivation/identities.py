"""Identities of a solved set: each equation and each formula as a sum of multiples of equations before it.

A sum of multiples of what vanishes vanishes. So where no multiplier is divided by zero, every solution of the loop
equations has the values that the formulas give, and none is missing. Multipliers may be read by anybody who can
multiply polynomials: nothing of the way on which they were found is needed to check them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.elimination import Root, SolvedSet
from assur.derivation.linear import ONE, Form, form_of, solved, tidy, value_of
from assur.derivation.linear_span import ZERO, LinearSpan, Multipliers, NoIdentityError, times, total_of, unit
from assur.derivation.strokes import StrokeVector
from assur.derivation.witness import ModularWitness
from assur.numerics.vectors import Vector, cross, dot, scaled, subtract


@dataclass(frozen=True)
class SetIdentities:
    """Why what is said of a set holds, each as multipliers.

    Attributes:
        equations: of each linear equation, in the loop equations.
        lines: of each line that quadrics give, in the equations `e1` .. and quadrics `unit <direction>`.
        formulas: of each unknown less its formula, and of the square of each root less its radicand, in these and in
            lines `l1` ..; a root stands for its quantity there.
    """

    equations: tuple[Multipliers, ...]
    lines: tuple[Multipliers, ...]
    formulas: Mapping[sympy.Symbol, Multipliers]


def set_identities(
    part: SolvedSet, loops: LinearSpan, vectors: Sequence[StrokeVector], witness: ModularWitness
) -> SetIdentities:
    """The identities of a set that square roots solve. Errors: NoIdentityError."""
    return _SetOfRoots(part, loops, vectors, witness).identities()


class _SetOfRoots:
    def __init__(
        self, part: SolvedSet, loops: LinearSpan, vectors: Sequence[StrokeVector], witness: ModularWitness
    ) -> None:
        self.part, self.loops, self.witness = part, loops, witness
        self.base, *self.others = part.directions
        self.formulas = {own.symbol: own.formula for own in part.definitions}
        self.unknowns = [unknown for direction in part.directions for unknown in direction.unknowns]
        self.vectors = [vector for vector in vectors if vector.direction in part.directions]
        self.rows = {f"e{k}": form for k, form in enumerate(part.equations, start=1)}
        self.given = LinearSpan(self.rows, self.unknowns, witness)
        lines = {f"l{k}": form for k, form in enumerate(part.lines, start=1)}
        self.all = LinearSpan(self.rows | lines, self.unknowns, witness)
        unknowns = [unknown for direction in self.others for unknown in direction.unknowns]
        _, left = solved(part.equations, unknowns, witness)
        self.planes = [(form, self.given.multipliers(form)) for form in left]
        self.planes += [(form, {name: ONE}) for name, form in lines.items()]
        self.names = {own.formula: own.symbol for own in part.definitions}

    def identities(self) -> SetIdentities:
        equations = tuple(self.loops.multipliers(form) for form in self.part.equations)
        lines = tuple(self._line(form) for form in self.part.lines)
        formulas: dict[sympy.Symbol, Multipliers] = {}
        for vector in self.vectors:
            formulas |= stroke_identities(self.part, vector, self.witness)
        for root in self.part.roots:
            if root.symbol not in formulas:
                formulas[root.symbol] = self._square(root)
        quantities = {root.symbol: root.quantity for root in self.part.roots}
        for unknown in self.unknowns:
            formulas[unknown] = self._unknown(unknown, self.formulas[unknown].subs(quantities))
        return SetIdentities(equations, lines, formulas)

    def _line(self, line: Form) -> Multipliers:
        """A quadric, less what the linear equations say of its unknowns, less a multiple of the base's."""
        for direction in self.others:
            if direction.kind == "stroke":
                continue
            forms = {own: self._form(self.formulas[own]) for own in direction.unknowns}
            square = sum(form.get(self.base.unknowns[0], ZERO) ** 2 for form in forms.values())
            total = sum(value_of(form) ** 2 for form in forms.values())
            rest = total - square * self.base.quadric - 1
            whole = form_of(sympy.expand(rest), self.base.unknowns, self.witness)
            factor = tidy(next((whole.get(key, ZERO) / part for key, part in line.items()), ZERO))
            gaps = (whole.get(key, ZERO) - factor * line.get(key, ZERO) for key in whole.keys() | line.keys())
            if self.witness.is_zero(factor) or not all(map(self.witness.is_zero, gaps)):
                continue
            own = {unit(direction): 1 / factor, unit(self.base): -square / factor}
            for unknown, form in forms.items():
                target = {unknown: ONE} | {key: -part for key, part in form.items()}
                for name, share in self.given.multipliers(target).items():
                    own[name] = own.get(name, ZERO) - share * (unknown + value_of(form)) / factor
            return {name: tidy(share) for name, share in own.items() if not self.witness.is_zero(share)}
        raise NoIdentityError(f"{value_of(line)} is not what two quadrics say together")

    def _form(self, formula: sympy.Expr) -> Form:
        return form_of(formula, self.base.unknowns, self.witness)

    def _square(self, root: Root) -> Multipliers:
        """The square of a quantity less its radicand."""
        if root.quantity.is_Symbol:
            return {unit(self.base): ONE}
        if self.base.kind == "circle":
            (form, shares), cosine, sine = self.planes[0], *self.base.unknowns
            a, b, d = (
                self._short(part) for part in (form.get(cosine, ZERO), form.get(sine, ZERO), -form.get(ONE, ZERO))
            )
            return total_of({unit(self.base): a**2 + b**2}, times(shares, -(a * cosine + b * sine + d)))
        (n, h), (m, k) = (self._plane(form) for form, _ in self.planes[:2])
        e, square = self.base.unknowns, self._across(n, m)[1]
        both = subtract(scaled(n, dot(m, e) + k), scaled(m, dot(n, e) + h))
        (_, first), (_, second) = self.planes[:2]
        return total_of({unit(self.base): square}, times(first, dot(m, both)), times(second, -dot(n, both)))

    def _plane(self, form: Form) -> tuple[Vector, sympy.Expr]:
        x, y, z = (self._short(form.get(key, ZERO)) for key in self.base.unknowns)
        return (x, y, z), self._short(-form.get(ONE, ZERO))

    def _short(self, formula: sympy.Expr) -> sympy.Expr:
        """The symbol of a formula that has one."""
        return self.names.get(sympy.factor_terms(formula), formula)

    def _across(self, n: Vector, m: Vector) -> tuple[Vector, sympy.Expr]:
        """The vector product of two normals, and its square."""
        x, y, z = (self._short(part) for part in cross(n, m))
        return (x, y, z), self._short(x**2 + y**2 + z**2)

    def _unknown(self, unknown: sympy.Symbol, formula: sympy.Expr) -> Multipliers:
        """An unknown less its formula, which is linear in the unknowns."""
        if (
            unknown in self.base.unknowns
            and self.base.kind == "circle"
            and self.formulas[unknown].free_symbols & {root.symbol for root in self.part.roots}
        ):
            return self._on_circle(unknown)
        if unknown in self.base.unknowns and self.base.kind == "rod":
            return self._on_sphere(unknown)
        return self.all.multipliers(form_of(unknown - formula, self.unknowns, self.witness))

    def _on_circle(self, unknown: sympy.Symbol) -> Multipliers:
        (form, shares), cosine = self.planes[0], self.base.unknowns[0]
        a, b = (self._short(form.get(key, ZERO)) for key in self.base.unknowns)
        if a == 0 or b == 0:
            return {}
        return times(shares, (a if unknown == cosine else b) / self._short(a**2 + b**2))

    def _on_sphere(self, unknown: sympy.Symbol) -> Multipliers:
        """W.w e - (h m x w + k w x n + w (w.e)) = (m x w) (n.e - h) + (w x n) (m.e - k)."""
        ((n, _), (m, _)), place = (self._plane(form) for form, _ in self.planes[:2]), self.base.unknowns.index(unknown)
        w, square = self._across(n, m)
        (_, first), (_, second) = self.planes[:2]
        return total_of(times(first, cross(m, w)[place] / square), times(second, cross(w, n)[place] / square))


def stroke_identities(
    part: SolvedSet, vector: StrokeVector, witness: ModularWitness
) -> dict[sympy.Symbol, Multipliers]:
    """Length and angle of a vector by the quadric of the angle's circle."""
    reach, components = vector.length + vector.along, vector.direction.unknowns
    name, size = unit(vector.circle), reach**2 + vector.beside**2
    root = next(own for own in part.roots if witness.is_zero(own.quantity - reach))
    square = sum((own**2 for own in components), ZERO)
    angle = {own: {name: own * size / square} if vector.beside != 0 else {} for own in vector.circle.unknowns}
    return {root.symbol: {name: -size}, vector.length: {}} | angle
