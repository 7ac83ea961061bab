"""One set solved: all its directions by that one whose two roots are left, these by a line and a circle or a sphere.

All unknowns but those of one direction follow from the linear equations. The quadrics of the others, less multiples of
its own, are then linear too: two circles meet on a line, three spheres on one. A factor that all coefficients of such
an equation share is divided out and kept as a condition: where it vanishes, the equation says nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.definitions import Definition
from assur.derivation.linear import ONE, Form, divided, never_zero, rank, solved, tidy, value_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.trigonometric import shorter
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness
from assur.numerics.vectors import add, cross, dot, scaled, subtract

ZERO = sympy.Integer(0)
SUMS = "HBCDEFGPQSTUV"
"""Letters for what is known of an equation, with the number of its set."""


@dataclass(frozen=True)
class Root:
    """A choice of two: `symbol` is the root of `radicand` with either sign, and is `quantity` of the unknowns."""

    symbol: sympy.Symbol
    radicand: sympy.Symbol
    quantity: sympy.Expr


@dataclass(frozen=True)
class SolvedSet:
    """One set, solved.

    Attributes:
        directions: what was solved for; the first is the one whose two roots are left.
        equations: linear in the unknowns, as the loops give them.
        lines: linear equations that the quadrics give.
        conditions: what was divided by, and must not vanish.
        definitions: symbols in the order of computation, those of the directions last.
        roots: the choices of two.
        shared: of the conditions those that all of a line had in common: where one fails, two curves coincide.
        eliminant: of a coupled set the polynomial by whose roots it is solved; definitions of what follows of a root
            stand after those of what is known before.
    """

    directions: tuple[UnknownDirection, ...]
    equations: tuple[Form, ...]
    lines: tuple[Form, ...]
    conditions: tuple[sympy.Expr, ...]
    definitions: tuple[Definition, ...]
    roots: tuple[Root, ...]
    shared: tuple[sympy.Expr, ...] = ()
    eliminant: AngleEliminant | None = None

    @property
    def name(self) -> str:
        """The links that are solved for."""
        return " and ".join(direction.name for direction in self.directions)

    @property
    def count(self) -> int:
        """How many solutions it has, over complex numbers, for each of those before."""
        return int(2 ** len(self.roots)) * (self.eliminant.degree if self.eliminant else 1)

    @property
    def formulas(self) -> tuple[Definition, ...]:
        """The definitions, and the polynomial that vanishes before what follows of a root."""
        if self.eliminant is None:
            return self.definitions
        before = len(self.eliminant.known) + len(self.eliminant.entries) + len(self.eliminant.steps) - 1
        return (*self.definitions[:before], self.eliminant.steps[-1], *self.definitions[before:])


def solution(
    number: int,
    directions: Sequence[UnknownDirection],
    equations: Sequence[Form],
    witness: ModularWitness,
    taken: set[str],
) -> SolvedSet:
    """A set solved for its directions. Errors: NotDerivedError, where more than two roots are left."""
    for base in directions:
        others = [unknown for direction in directions if direction is not base for unknown in direction.unknowns]
        if rank(equations, others, witness) == len(others):
            return _Set(number, base, directions, equations, witness, taken).solved()
    names = " and ".join(direction.name for direction in directions)
    raise NotDerivedError(f"{names} belong together: {len(equations)} linear equations")


def meeting(
    directions: Sequence[UnknownDirection], equations: Sequence[Form], witness: ModularWitness
) -> tuple[dict[sympy.Symbol, Form], list[Form], UnknownDirection]:
    """What equations and quadrics leave of a set: all unknowns but those of one direction, lines for these, and it.

    Errors:
        NotDerivedError: of no direction do the others follow linearly.
    """
    for base in directions:
        others = [unknown for direction in directions if direction is not base for unknown in direction.unknowns]
        if rank(equations, others, witness) == len(others):
            own = _Set(0, base, directions, equations, witness, set())
            return (*own.meeting(), base)
    raise NotDerivedError("of no direction do the others follow")


class _Set:
    def __init__(
        self,
        number: int,
        base: UnknownDirection,
        directions: Sequence[UnknownDirection],
        equations: Sequence[Form],
        witness: ModularWitness,
        taken: set[str],
    ) -> None:
        self.number, self.base, self.witness = number, base, witness
        self.others = [direction for direction in directions if direction is not base]
        self.definitions: list[Definition] = []
        self.conditions: list[sympy.Expr] = []
        self.roots: list[Root] = []
        self.shared: list[sympy.Expr] = []
        self.taken = taken
        self.sums: dict[sympy.Expr, sympy.Symbol] = {}
        self.letters = (letter for letter in SUMS if f"{letter}{number}" not in taken)
        self.equations = [self._with_names(form) for form in equations]

    def _with_names(self, form: Form) -> Form:
        """What is known of an equation under one name, and so a coefficient of dimensions that may vanish."""
        form = {key: part if key == ONE else self._short(part) for key, part in form.items()}
        known = form.get(ONE, ZERO)
        if not sympy.fraction(sympy.sympify(known))[0].is_Add:
            return form
        return {**form, ONE: self._named(next(self.letters), known)}

    def _short(self, coefficient: sympy.Expr) -> sympy.Expr:
        """A sum of dimensions by its name, which its multiples share: so sums of squares show that none vanishes."""
        dimensions = coefficient.free_symbols <= self.witness.dimensions
        if not coefficient.is_Add or not dimensions or self._never_zero(coefficient):
            return coefficient
        factor, own = coefficient.primitive()
        if -own in self.sums:
            factor, own = -factor, -own
        if own not in self.sums:
            self.sums[own] = self._named(next(self.letters), own)
        return factor * self.sums[own]

    def meeting(self) -> tuple[dict[sympy.Symbol, Form], list[Form]]:
        """The unknowns of the others, and lines for those of the base, those first that the equations leave.

        A line without an unknown says that there is no solution.
        """
        unknowns = [unknown for direction in self.others for unknown in direction.unknowns]
        conditions: list[sympy.Expr] = []
        values, lines = solved(self.equations, unknowns, self.witness, conditions)
        self.conditions += [shorter({ONE: own}, self.witness.circles, self.witness)[ONE] for own in conditions]
        curved = [direction for direction in self.others if direction.kind != "stroke"]
        lines += [line for direction in curved if (line := self._line(direction, values)) is not None]
        return values, lines

    def solved(self) -> SolvedSet:
        unknowns = [unknown for direction in self.others for unknown in direction.unknowns]
        given = len(self.equations) - len(unknowns)
        values, lines = self.meeting()
        lines = self._independent(lines)
        if self.base.kind not in (meets := {"circle": self._circle, "rod": self._sphere, "stroke": self._vector}):
            raise NotDerivedError(f"{self.base.name}: of a side no more than its length is known")
        meets[self.base.kind](lines)
        for unknown in unknowns:
            self._define(unknown, value_of(values[unknown]))
        return SolvedSet(
            (self.base, *self.others),
            tuple(self.equations),
            tuple(lines[given:]),
            tuple(dict.fromkeys(self.conditions)),
            tuple(self.definitions),
            tuple(self.roots),
            tuple(self.shared),
        )

    def _line(self, direction: UnknownDirection, values: dict[sympy.Symbol, Form]) -> Form | None:
        """What an direction's quadric says beside the base's: a linear equation of the base's unknowns."""
        own, total = self.base.unknowns, dict[tuple[sympy.Expr, sympy.Expr], sympy.Expr]()
        keys = (*own, ONE)
        for form in (values[unknown] for unknown in direction.unknowns):
            for k, a in enumerate(keys):
                for b in keys[k:]:
                    share = form.get(a, ZERO) * form.get(b, ZERO)
                    total[a, b] = total.get((a, b), ZERO) + (share if a == b else 2 * share)
        square = total[own[0], own[0]]
        total |= {(a, a): total[a, a] - square for a in own}
        if not all(self.witness.is_zero(total[a, b]) for k, a in enumerate(own) for b in own[k:]):
            raise NotDerivedError(f"the quadrics of {self.base.name} and {direction.name} have no line in common")
        line = {a: total[a, ONE] for a in own} | {ONE: total[ONE, ONE] + square - 1}
        line = {key: tidy(part) for key, part in line.items() if not self.witness.is_zero(part)}
        return self._divided(line) if line else None

    def _divided(self, form: Form) -> Form:
        """A form without the factor that all of it shares, which is kept as a condition."""
        plain = divided(form)
        key = next(iter(form))
        shared, _ = sympy.fraction(tidy(form[key] / plain[key]))
        factors = [factor for factor, _ in sympy.factor_list(shared)[1] if not self._never_zero(factor)]
        self.conditions += factors
        self.shared += factors
        return plain

    def _independent(self, lines: Sequence[Form]) -> list[Form]:
        kept: list[Form] = []
        for line in lines:
            if rank([*kept, line], self.base.unknowns, self.witness) > len(kept):
                kept.append(line)
        return kept

    def _define(self, symbol: sympy.Symbol, formula: sympy.Expr, meaning: str = "") -> sympy.Symbol:
        self.definitions.append(Definition(symbol, formula, meaning))
        self.witness.home.setdefault(symbol, self.witness.at_home(formula))
        self.witness.define(symbol, formula)
        return symbol

    def _named(self, letter: str, formula: sympy.Expr) -> sympy.Expr:
        """A formula of more than one symbol gets a name."""
        if sympy.sympify(formula).is_number or sympy.sympify(formula).is_Symbol:
            return sympy.sympify(formula)
        return self._define(self._symbol(letter), sympy.factor_terms(formula))

    def _symbol(self, letter: str) -> sympy.Symbol:
        """A symbol of a name that nothing has."""
        name = f"{letter}{self.number}"
        while name in self.taken:
            name += "_"
        self.taken.add(name)
        return sympy.Symbol(name, real=True)

    def _square(self, whole: sympy.Expr, short: sympy.Expr) -> sympy.Expr:
        """The name of a sum of squares that is divided by: a condition, unless it is seen that it never vanishes."""
        if self._never_zero(short):
            return self._named("N", short)
        steady = self._never_zero(whole)
        square = self._named("N", sympy.factor(whole) if steady else short)
        if not steady:
            self.conditions.append(square)
        return square

    def _written_out(self, formula: sympy.Expr) -> sympy.Expr:
        """A formula without names."""
        for own in reversed(self.definitions):
            formula = formula.subs(own.symbol, own.formula)
        return formula

    def _never_zero(self, formula: sympy.Expr) -> bool:
        return never_zero(formula, self.witness.sizes)

    def _root(self, radicand: sympy.Expr, quantity: sympy.Expr) -> sympy.Symbol:
        """The root of a radicand, with the sign that it has at home."""
        own, root = self._define(self._symbol("M"), radicand), self._symbol("r")
        at_home = self.witness.home[root] = self.witness.at_home(quantity)
        self.roots.append(Root(root, own, quantity))
        self.definitions.append(Definition(root, sympy.sqrt(own)))
        self.witness.define(root, -sympy.sqrt(own) if at_home < 0.0 else sympy.sqrt(own))
        return root

    def _circle(self, lines: Sequence[Form]) -> None:
        """A cos + b sin + d = 0 on the unit circle."""
        cosine, sine = self.base.unknowns
        if len(lines) > 1:
            self._vector(lines)
            return
        (line,) = lines
        a, b, d = line.get(cosine, ZERO), line.get(sine, ZERO), -line.get(ONE, ZERO)
        if a == 0 or b == 0:
            known, other = (sine, cosine) if a == 0 else (cosine, sine)
            divisor = b if a == 0 else a
            if not self._never_zero(divisor):
                self.conditions.append(divisor)
            self._define(known, tidy(d / divisor))
            self._define(other, self._root(1 - known**2, other))
            return
        square = (a**2 + b**2).subs({name: own for own, name in self.sums.items()})
        whole = tidy(shorter({ONE: square}, self.witness.circles, self.witness)[ONE])
        a, b, d = self._named("J", a), self._named("K", b), self._named("L", d)
        square = self._square(whole, a**2 + b**2)
        root = self._root(square - d**2, a * sine - b * cosine)
        self._define(cosine, (a * d - b * root) / square)
        self._define(sine, (b * d + a * root) / square)

    def _vector(self, lines: Sequence[Form]) -> None:
        """As many linear equations as unknowns."""
        values, _ = solved(lines, self.base.unknowns, self.witness, self.conditions)
        for unknown in self.base.unknowns:
            self._define(unknown, value_of(values[unknown]))

    def _sphere(self, lines: Sequence[Form]) -> None:
        """Two planes n.e = k meet in a line along w = n1 x n2, which meets the unit sphere."""
        own = self.base.unknowns
        if len(lines) != 2:
            raise NotDerivedError(f"{self.base.name}: {len(lines)} linear equations for a direction")
        normals, shares = [], []
        for letter, line in zip(("u", "v"), lines, strict=True):
            x, y, z = (
                self._named(f"{letter}{axis}", line.get(key, ZERO)) for axis, key in zip("xyz", own, strict=True)
            )
            normals.append((x, y, z))
            shares.append(self._named("h" if letter == "u" else "k", -line.get(ONE, ZERO)))
        (n, m), (h, k) = normals, shares
        x, y, z = (self._named(f"w{axis}", part) for axis, part in zip("xyz", cross(n, m), strict=True))
        w = x, y, z
        square = self._square(self._written_out(dot(w, w)), dot(w, w))
        apart = subtract(scaled(m, h), scaled(n, k))
        root = self._root(square - dot(apart, apart), dot(w, own))
        start = add(scaled(cross(m, w), h), scaled(cross(w, n), k))
        for unknown, part, along in zip(own, start, w, strict=True):
            self._define(unknown, (part + along * root) / square)


def with_known(part: SolvedSet, known: tuple[Definition, ...]) -> SolvedSet:
    """A set with definitions before its own, in which nothing is unknown."""
    own = part.eliminant
    eliminant = own if own is None else replace(own, known=(*known, *own.known))
    return replace(part, definitions=(*known, *part.definitions), eliminant=eliminant)


def choices(parts: Sequence[SolvedSet]) -> Iterator[Root]:
    """All choices of two, in the order of solution."""
    return (root for part in parts for root in part.roots)
