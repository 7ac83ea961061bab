"""Three circles that belong together: with one taken as known, a line for each of the others and what both say.

Links that turn about fixed axes and carry the balls of one link are such a set. The sides of the triangle follow
linearly; that they keep their lengths says three equations, each of two circles. So with the first circle known, the
second and the third lie on a line each, and the equation between these two is linear in the second. Cramer's rule
solves it and the second line; that the second is a circle is then a conic in the third. A line, a conic and the circle
have a point in common where their eliminant vanishes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.definitions import Definition, FreeNames
from assur.derivation.line_and_conic import line_and_conic
from assur.derivation.linear import ONE, Form, divided, rank, solved, value_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.reduced_quadrics import product_symbol, reduced_form, reduced_quadric
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness

ZERO = sympy.Integer(0)
Triple = tuple[sympy.Expr, sympy.Expr, sympy.Expr]


@dataclass(frozen=True)
class CirclePair:
    """What one circle leaves where it is known.

    Attributes:
        base: that circle.
        circles: the two others.
        lines: one of each of these, and the equation of both.
        values: all other unknowns, of the circles.
        conditions: what was divided by.
    """

    base: UnknownDirection
    circles: tuple[UnknownDirection, UnknownDirection]
    lines: tuple[Form, Form, Form]
    values: Mapping[sympy.Symbol, Form]
    conditions: tuple[sympy.Expr, ...]

    @property
    def unknowns(self) -> tuple[sympy.Symbol, ...]:
        """Of the two circles."""
        return tuple(unknown for own in self.circles for unknown in own.unknowns)

    def eliminant(self, names: FreeNames) -> PairEliminant:
        """The polynomial that is left, and how the circles follow of a root."""
        return _Elimination(self, names).eliminant()

    def values_of(self, eliminant: AngleEliminant) -> Iterator[Definition]:
        """The circles at a root, and what follows of them."""
        (first, last), (under, x, y, det, m, n) = self.circles, (own.symbol for own in eliminant.backward)
        quotients = (x / under, y / under, m / det, n / det)
        for unknown, formula in zip((*last.unknowns, *first.unknowns), quotients, strict=True):
            yield Definition(unknown, formula)
        for unknown, form in self.values.items():
            yield Definition(unknown, value_of(form))


@dataclass(frozen=True)
class PairEliminant(AngleEliminant):
    """The eliminant of a pair of circles.

    Attributes:
        pair: the circles.
        first, last: coefficients of their lines, by names.
        both: of the equation of both what it has of the cosine and of the sine of the first, and beside: each in the
            cosine and the sine of the last, and beside.
        across: Cramer's determinant and what stands over it, in the same way.
        conic: coefficients in the last circle: 1, cosine, sine, their product, square of the sine.
        meeting: the last steps, of line, conic and circle.
    """

    pair: CirclePair | None = None
    first: Triple = (ZERO, ZERO, ZERO)
    last: Triple = (ZERO, ZERO, ZERO)
    both: tuple[Triple, ...] = ()
    across: tuple[Triple, ...] = ()
    conic: tuple[sympy.Expr, ...] = ()
    meeting: tuple[Definition, ...] = ()

    @property
    def named_lines(self) -> tuple[Form, ...]:
        """The lines of both circles, and the equation of both, with names for coefficients."""
        (c, s, *last), own = self.unknowns, [*self.both[0], *self.both[1], *self.both[2]]
        products = [product_symbol(x, y) for x in (c, s) for y in last]
        keys = (*products[:2], c, *products[2:], s, *last, ONE)
        rows = (
            zip((c, s, ONE), self.first, strict=True),
            zip((*last, ONE), self.last, strict=True),
            zip(keys, own, strict=True),
        )
        return tuple({key: part for key, part in row if part != 0} for row in rows)

    @property
    def left_quadric(self) -> sympy.Expr:
        """The conic in the last circle."""
        cosine, sine = self.unknowns[2:]
        return sum(own * part for own, part in zip(self.conic, (1, cosine, sine, cosine * sine, sine**2), strict=True))


def circle_pair(
    base: UnknownDirection, directions: Sequence[UnknownDirection], equations: Sequence[Form], witness: ModularWitness
) -> CirclePair:
    """What a circle leaves of its set where it is known.

    Errors:
        NotDerivedError: no two circles, or not a line for each.
    """
    others = [own for own in directions if own is not base]
    circles = [own for own in others if own.kind == "circle"]
    apart = [unknown for own in others if own.kind != "circle" for unknown in own.unknowns]
    conditions: list[sympy.Expr] = []
    values, rest = solved(equations, apart, witness, conditions, base.unknowns)
    if len(circles) != len(("first", "last")) or rest or len(values) != len(apart):
        raise NotDerivedError(f"with {base.name} taken as known, no two circles are left that say all else")
    first, last = circles
    unknowns = (*first.unknowns, *last.unknowns)
    forms = {unknown: values.get(unknown, {unknown: ONE}) for own in others for unknown in own.unknowns}
    quadrics = [reduced_quadric(own, forms, base, unknowns, witness) for own in others if own.kind != "stroke"]

    def left(needed: Sequence[sympy.Symbol], beside: Sequence[sympy.Symbol] = ()) -> Form:
        """A sum of multiples of as few quadrics as have one with nothing but that in it."""
        kept = (*needed, *beside)
        for count in range(1, len(quadrics) + 1):
            for some in combinations(quadrics, count):
                out = sorted({key for form in some for key in form if key not in kept and key != ONE}, key=str)
                if rank(some, out, witness) < count and rank(some, [*out, *kept], witness) == count:
                    _, own = solved(some, out, witness, conditions, base.unknowns)
                    for form in own:
                        if form.keys() & {*needed} and form.keys() <= {*kept, ONE}:
                            return reduced_form(divided(form), base, witness)
        raise NotDerivedError(f"with {base.name} taken as known, {first.name} and {last.name} lie on no line each")

    products = [product_symbol(x, y) for x in first.unknowns for y in last.unknowns]
    lines = left(first.unknowns), left(last.unknowns), left(products, unknowns)
    return CirclePair(base, (first, last), lines, values, tuple(dict.fromkeys(conditions)))


class _Elimination:
    def __init__(self, pair: CirclePair, names: FreeNames) -> None:
        self.pair, self.names = pair, names
        self.entries: dict[sympy.Expr, Definition] = {}
        self.known: dict[sympy.Expr, Definition] = {}
        self.steps: list[Definition] = []

    def eliminant(self) -> PairEliminant:
        (cosine, sine), third = (own.unknowns for own in self.pair.circles)
        line, other, equation = self.pair.lines
        first = self._line(line, (cosine, sine))
        last = self._line(other, third)
        both = tuple(self._of_last(equation, key, third) for key in (cosine, sine, ONE))
        across = self._across(first, both)
        conic = self._conic(*across)
        meeting = line_and_conic().at(last, conic, third)
        steps = [Definition(self.names.numbered("h"), own) for own in meeting.steps]
        meeting = line_and_conic().at(last, conic, third, [own.symbol for own in steps])
        under = Definition(self.names.named("v"), meeting.under)
        over = [Definition(self.names.numbered("v"), own) for own in meeting.over]
        places = [own.symbol for own in (*over, under)]
        backward = [under, *over]
        for name, row in zip(("det", "m", "n"), across, strict=True):
            formula = sum((share * place for share, place in zip(row, places, strict=True)), ZERO)
            backward.append(Definition(self.names.named(name), formula))
        self.steps += [*steps, Definition(self.names.named("elim"), meeting.eliminant)]
        return PairEliminant(
            self.pair.base, tuple(self.known.values()), tuple(self.entries.values()), tuple(self.steps),
            self.pair.unknowns, divisors=(backward[0].symbol, backward[3].symbol), backward=tuple(backward),
            pair=self.pair, first=first, last=last, both=both, across=across, conic=conic, meeting=tuple(steps),
        )  # fmt: skip

    def _entry(self, formula: sympy.Expr) -> sympy.Expr:
        """A coefficient by its name."""
        if formula.is_number or formula.is_Symbol:
            return formula
        sign = -1 if formula.could_extract_minus_sign() else 1
        turning = formula.free_symbols & {*self.pair.base.unknowns}
        group, letter = (self.entries, "f") if turning else (self.known, "k")
        if sign * formula not in group:
            group[sign * formula] = Definition(self.names.numbered(letter), sign * formula)
        return sign * group[sign * formula].symbol

    def _line(self, form: Form, circle: Sequence[sympy.Symbol]) -> Triple:
        a, b, d = (self._entry(form.get(key, ZERO)) for key in (*circle, ONE))
        return a, b, d

    def _of_last(self, form: Form, key: sympy.Expr, circle: Sequence[sympy.Symbol]) -> Triple:
        """What an equation has of a cosine, a sine or beside them, as a form in the last circle."""
        keys = (*circle, ONE) if key == ONE else (*(product_symbol(key, own) for own in circle), key)
        x, y, z = (self._entry(form.get(own, ZERO)) for own in keys)
        return x, y, z

    def _step(self, letter: str, formula: sympy.Expr) -> sympy.Expr:
        """A formula of more than one symbol gets a name."""
        if formula.is_number or formula.is_Symbol:
            return formula
        self.steps.append(Definition(self.names.numbered(letter), formula))
        return self.steps[-1].symbol

    def _across(self, line: Triple, both: Sequence[Triple]) -> tuple[Triple, Triple, Triple]:
        """The determinant and what stands over it, as forms in the last circle."""
        a, b, d = line
        rows = []
        for letter, x, y, of_x, of_y in (("g", a, b, 1, 0), ("m", b, d, 2, 1), ("n", d, a, 0, 2)):
            u, v, w = (self._step(letter, sympy.expand(x * both[of_x][k] - y * both[of_y][k])) for k in range(3))
            rows.append((u, v, w))
        return rows[0], rows[1], rows[2]

    def _conic(self, under: Triple, first: Triple, second: Triple) -> tuple[sympy.Expr, ...]:
        """Both squares less that of the determinant, by the square of the sine for that of the cosine."""

        def part(i: int, k: int) -> sympy.Expr:
            return first[i] * first[k] + second[i] * second[k] - under[i] * under[k]

        own = part(2, 2) + part(0, 0), 2 * part(0, 2), 2 * part(1, 2), 2 * part(0, 1), part(1, 1) - part(0, 0)
        return tuple(self._step("q", formula) for formula in own)
