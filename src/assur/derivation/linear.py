"""Linear forms whose coefficients are formulas, eliminated exactly; what vanishes is told at a witness."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from functools import lru_cache
from itertools import combinations

import sympy

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.quotients import cancelled, primitive
from assur.derivation.witness import ModularWitness

Form = dict[sympy.Symbol | sympy.Integer, sympy.Expr]
"""Unknown -> its coefficient; of 1 the constant. What is zero is left out."""
ONE = sympy.Integer(1)
STEADY = 1
"""The cost of a pivot that never vanishes, or less."""
LONG = 200
"""Operations of two equations that are not combined only so that one of them gets shorter."""
VANISHED = 1e-9
"""A coefficient at home, of lengths in the file's unit, that is rounding."""


def form_of(expression: sympy.Expr, unknowns: Sequence[sympy.Symbol], witness: ModularWitness) -> Form:
    """An expression that is linear in some symbols as a form.

    >>> x, a = sympy.symbols("x a")
    >>> form_of(2 * a * x - a, [x], ModularWitness())
    {x: 2*a, 1: -a}
    """
    expanded = sympy.expand(expression)
    form = {unknown: expanded.coeff(unknown) for unknown in unknowns}
    form[ONE] = expanded.subs(dict.fromkeys(unknowns, 0))
    return {key: tidy(value) for key, value in form.items() if not witness.is_zero(value)}


def tidy(formula: sympy.Expr) -> sympy.Expr:
    """A formula multiplied out, over one denominator without common factors, if it has one."""
    return cancelled(sympy.sympify(formula))


def divisors(formula: sympy.Expr) -> list[sympy.Expr]:
    """Factors of what a formula is divided by, without numbers and powers; of a root what is under it.

    >>> a, x, y = sympy.symbols("a x y")
    >>> divisors(a / (2 * x * y) + 1 / x)
    [x, y]
    >>> divisors(a / sympy.sqrt(3)), divisors(a / (9 * x**2 * sympy.sqrt(y + 1)))
    ([], [x, y + 1])
    """
    under = sympy.fraction(tidy(formula))[1]
    factors = (factor.as_base_exp()[0] for factor in sympy.Mul.make_args(sympy.factor(under)))
    return [factor for factor in factors if not factor.is_number]


def value_of(form: Form) -> sympy.Expr:
    """The form as an expression."""
    return sum((coefficient * key for key, coefficient in form.items()), sympy.Integer(0))


def combined(first: Form, factor: sympy.Expr, second: Form, witness: ModularWitness) -> Form:
    """A form plus a multiple of another."""
    total = dict(first)
    for key, coefficient in second.items():
        changed = total.get(key, sympy.Integer(0)) + factor * coefficient
        if witness.is_zero(changed):
            total.pop(key, None)
        else:
            total[key] = tidy(changed)
    return total


def replaced(form: Form, values: Mapping[sympy.Symbol, Form], witness: ModularWitness) -> Form:
    """A form in which some unknowns are forms of others."""
    total = {key: coefficient for key, coefficient in form.items() if key not in values}
    for key, coefficient in form.items():
        if key in values:
            total = combined(total, coefficient, values[key], witness)
    return total


def solved(
    forms: Iterable[Form],
    unknowns: Sequence[sympy.Symbol],
    witness: ModularWitness,
    conditions: list[sympy.Expr] | None = None,
    turning: Collection[sympy.Symbol] = (),
) -> tuple[dict[sympy.Symbol, Form], list[Form]]:
    """Some of the unknowns as forms of what is left, and the equations that are left, in which they do not occur.

    What is divided by and may vanish is added to the conditions. Nothing is divided by what has a symbol of `turning`
    in it; equations are left then in which unknowns occur.

    >>> x, y = sympy.symbols("x y")
    >>> solved([{x: ONE, y: -ONE}, {x: ONE, y: ONE, ONE: -2 * ONE}], [x], ModularWitness())
    ({x: {y: 1}}, [{y: 2, 1: -2}])
    """
    left = [form for form in forms if form]
    values: dict[sympy.Symbol, Form] = {}
    costs: dict[sympy.Expr, tuple[int, int]] = {}
    while True:
        pivots = [
            ((*_cost(form[key], witness, costs), len(form)), k, key)
            for k, form in enumerate(left)
            for key in unknowns
            if key in form and not form[key].free_symbols & {*turning}
        ]
        if not pivots:
            return values, left
        cost, k, key = min(pivots, key=lambda pivot: pivot[:1])
        if (
            conditions is not None
            and cost[0] > STEADY
            and not turning
            and (pair := _turned_pair(left, unknowns, witness))
        ):
            factors, own_pair, left = pair
            conditions += [factor for factor in factors if not never_zero(factor, witness.sizes)]
            left = [own for own in (replaced(form, own_pair, witness) for form in left) if own]
            values = {other: replaced(form, own_pair, witness) for other, form in values.items()} | own_pair
            continue
        pivot = left.pop(k)
        if conditions is not None and not never_zero(pivot[key], witness.sizes):
            conditions.append(pivot[key])
        own = {other: tidy(-part / pivot[key]) for other, part in pivot.items() if other != key}
        left = [replaced(form, {key: own}, witness) if key in form else form for form in left]
        left = [form for form in left if form]
        values = {other: replaced(form, {key: own}, witness) for other, form in values.items()} | {key: own}


def _turned_pair(
    forms: Sequence[Form], unknowns: Sequence[sympy.Symbol], witness: ModularWitness
) -> tuple[list[sympy.Expr], dict[sympy.Symbol, Form], list[Form]] | None:
    """Two unknowns of two equations (a, b) and k (-b, a), as forms; factors of a^2 + b^2, and the other equations.

    Neither a nor b need be other than zero: the unknowns follow where not both vanish.
    """
    for first, second in combinations(forms, 2):
        for x, y in combinations([key for key in unknowns if key in first and key in second], 2):
            a, b, c, d = first[x], first[y], second[x], second[y]
            if not witness.vanishes(a, c, -b, d) or not never_zero(share := tidy(d / a), witness.sizes):
                continue
            square = tidy(a**2 + b**2)
            rests = [{key: part for key, part in own.items() if key not in (x, y)} for own in (first, second)]
            values = {}
            for key, shares in ((x, (-d, b)), (y, (c, -a))):
                total: Form = {}
                for part, rest in zip(shares, rests, strict=True):
                    total = combined(total, tidy(part / (share * square)), rest, witness)
                values[key] = total
            factors = divisors(1 / square)
            return factors, values, [own for own in forms if own is not first and own is not second]
    return None


def projected(
    forms: Sequence[Form], lengths: Sequence[sympy.Symbol], witness: ModularWitness
) -> tuple[dict[sympy.Symbol, Form], list[Form]]:
    """Lengths as forms of what is left, and what is left of the equations, each projected on its own coefficients.

    A length along a unit vector a has the coefficients a in three equations: a of these is it, whatever a is. Where one
    of them is a number, the shortest such equation says it alone. Where a turns, the square of a is not written as 1 in
    what is left: so factors of a are seen that all of an equation shares.

    Errors:
        NotDerivedError: a length that no equation is left for.

    >>> x, y = sympy.symbols("x y")
    >>> projected([{x: ONE, y: -ONE}], [x], ModularWitness())
    ({x: {y: 1}}, [])
    """
    left, values = list(forms), dict[sympy.Symbol, Form]()
    for length in lengths:
        rows = [form for form in left if length in form]
        unit = _along_unit_vector(rows, length, witness)
        rows = unit or rows
        left = [form if form in unit else _without(form, length, unit, witness) for form in left]
        pivot: Form = {}
        alone = [] if unit else [row for row in rows if row[length].is_number]
        for row in [min(alone, key=_size)] if alone else rows:
            pivot = combined(pivot, row[length], row, witness)
        if length not in pivot:
            raise NotDerivedError(
                f"no equation is left that says how far {length} slides, beside those of other slides"
            )
        size = sympy.simplify(pivot[length])
        own = {key: tidy(-part / size) for key, part in pivot.items() if key != length}
        left = [form for form in (replaced(form, {length: own}, witness) for form in left) if form]
        if unit:
            own = {key: tidy(-part) for key, part in pivot.items() if key != length}
        values = {key: replaced(form, {length: own}, witness) for key, form in values.items()} | {length: own}
    return values, left


def _along_unit_vector(rows: Sequence[Form], length: sympy.Symbol, witness: ModularWitness) -> list[Form]:
    """Rows, three at most, in which a length has the components of a unit vector that is no number, or none."""
    for count in range(1, 4):
        for own in combinations(sorted(rows, key=len), count):
            turning = any(row[length].free_symbols for row in own)
            if turning and witness.is_zero(sum((row[length] ** 2 for row in own), -ONE)):
                return [*own]
    return []


def _without(form: Form, length: sympy.Symbol, rows: Sequence[Form], witness: ModularWitness) -> Form:
    """A form less a number times one of some rows, if that takes a length out of it."""
    for row in rows if length in form else ():
        share = tidy(-form[length] / row[length])
        if share.is_number:
            return combined(form, share, row, witness)
    return form


def divided(row: Form) -> Form:
    """A row times its denominators, without the factor that all of it shares.

    >>> a, x, y = sympy.symbols("a x y")
    >>> divided({x: 2 * a / y, y: a})
    {x: 2, y: y}
    """
    return dict(zip(row, primitive([*row.values()]), strict=True))


def sparse(forms: Sequence[Form], witness: ModularWitness, everywhere: bool = False) -> list[Form]:
    """Equations of the same span with few unknowns each: pairs are combined as long as that shortens one of them.

    Nothing is divided by what may vanish, as a difference of two dimensions or the sine of one does in another machine.

    Args:
        forms: the equations.
        witness: tells what vanishes.
        everywhere: whether the span is to be the same also where a coefficient vanishes: shares are formulas of
            dimensions alone, that never vanish.

    >>> x, y, z = sympy.symbols("x y z")
    >>> sparse([{x: ONE, y: ONE}, {x: ONE, y: ONE, z: ONE}], ModularWitness())
    [{z: -1}, {x: 1, y: 1}]
    """
    left = [form for form in forms if form]
    while (better := _shorter(left, witness, everywhere)) is not None:
        k, form = better
        left[k] = form
        left = [form for form in left if form]
    return left


def _shorter(forms: Sequence[Form], witness: ModularWitness, everywhere: bool) -> tuple[int, Form] | None:
    for k, form in enumerate(forms):
        for other in forms:
            shared = [key for key in form if key in other and key != ONE]
            if other is form or not shared or len(other) > len(form) + 1:
                continue
            for key in shared:
                count, (size, length) = _left(form, key, other, witness), _size(form)
                if count > size or (count == size and length + _size(other)[1] > LONG):
                    continue
                share = tidy(-form[key] / other[key])
                if not (never_zero(share) if everywhere else all(map(never_zero, divisors(share)))):
                    continue
                changed = combined(form, share, other, witness)
                if _size(changed) < _size(form):
                    return k, changed
    return None


def _left(form: Form, key: sympy.Symbol, other: Form, witness: ModularWitness) -> int:
    """How many unknowns are left of a form less that multiple of another by which a key vanishes."""
    zero = sympy.Integer(0)
    return sum(
        not witness.vanishes(form.get(own, zero), other[key], form[key], other.get(own, zero))
        for own in (form.keys() | other.keys()) - {ONE, key}
    )


def size(forms: Sequence[Form]) -> int:
    """Operations of all coefficients."""
    return sum(_size(form)[1] for form in forms)


def _size(form: Form) -> tuple[int, int]:
    return len(form.keys() - {ONE}), sum(int(sympy.count_ops(part)) for part in form.values())


def _cost(pivot: sympy.Expr, witness: ModularWitness, known: dict[sympy.Expr, tuple[int, int]]) -> tuple[int, int]:
    """Numbers are divided by first, then what never vanishes, then what does not at home; short ones first."""
    if pivot not in known:
        at_home = pivot.free_symbols <= witness.home.keys()
        there = at_home and abs(witness.at_home(pivot)) > VANISHED
        sure = 0 if pivot.is_number else 1 if never_zero(pivot) else 2 if there else 3
        known[pivot] = sure, int(sympy.count_ops(pivot))
    return known[pivot]


@lru_cache(maxsize=4096)
def never_zero(formula: sympy.Expr, sizes: tuple[sympy.Expr, ...] = ()) -> bool:
    """Whether a formula of positive dimensions and the like cannot vanish.

    Args:
        formula: in its names, which are real.
        sizes: sums of squares that are the square of an axis' length: an axis has a direction, so none is zero.

    >>> a, b = sympy.symbols("a b", real=True)
    >>> never_zero(a**2 + 1), never_zero(a**2 + b**2), never_zero(2 * a**2 + 2 * b**2, (a**2 + b**2,))
    (True, False, True)
    >>> never_zero(3 * a**2 + 4 * b**2, (a**2 + b**2,)), never_zero(3 * a**2, (a**2 + b**2,))
    (True, False)
    """
    own = sympy.factor_terms(formula)
    known = {symbol for size in sizes for symbol in size.free_symbols}
    if known & own.free_symbols and all(symbol in known or symbol.is_positive for symbol in own.free_symbols):
        own = sympy.factor(own).subs({size: sympy.Dummy(positive=True) for size in sizes})
    return bool(own.is_nonzero) or _has_size(own, sizes)


def _has_size(formula: sympy.Expr, sizes: tuple[sympy.Expr, ...]) -> bool:
    """Whether it is a sum of squares that vanish together only where the square of some axis' length does."""
    terms = [term.as_coeff_Mul() for term in sympy.Add.make_args(formula)]
    if not all(factor.is_positive and square.is_Pow and square.exp == 2 for factor, square in terms):
        return False
    gone = {square.base: 0 for _, square in terms}
    return any(size.subs(gone) == 0 for size in sizes)


def rank(forms: Sequence[Form], unknowns: Sequence[sympy.Symbol], witness: ModularWitness) -> int:
    """The rank of the coefficients of some unknowns, at the witness."""
    return witness.rank([[form.get(key, sympy.Integer(0)) for key in unknowns] for form in forms])
