"""A coupled set: one of its circles is taken as known, and what the other links leave over is one polynomial in it.

The linear equations say most unknowns of the others. The quadrics of these, taken together without their quadratic
parts, are linear in what is left; Cramer's rule solves them, and one equation is left over: the eliminant. All of them
are polynomials in the cosine and the sine of the circle, so in t, the tangent of half its angle, over powers of
1 + t^2. Powers of 1 + t^2 that divide the eliminant itself are divided out. The circle is that of least degree.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.angle_residues import cycle_type, polynomial, residues, some_root
from assur.derivation.circle_pairs import CirclePair, circle_pair
from assur.derivation.cycle_types import CycleType, findings
from assur.derivation.definitions import Definition, FreeNames
from assur.derivation.elimination import SolvedSet
from assur.derivation.linear import ONE, Form, divided, rank, replaced, solved, tidy, value_of
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.reduced_quadrics import product_symbol, reduced_form, reduced_quadric
from assur.derivation.trigonometric import trigonometric_terms
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness, NoResidueRootError

ZERO = sympy.Integer(0)
Matrix = list[list[sympy.Expr]]
DRAWS = 12
"""At which a polynomial is looked at; of the permutations of six or eight roots a sixth or an eighth is one cycle."""


@dataclass(frozen=True)
class _Leftover:
    """What the base leaves: linear equations of `unknowns`, perhaps a quadric, and the values of all others."""

    base: UnknownDirection
    unknowns: tuple[sympy.Symbol, ...]
    lines: tuple[Form, ...]
    quadric: Form
    values: Mapping[sympy.Symbol, Form]
    conditions: tuple[sympy.Expr, ...]

    def eliminant(self, names: FreeNames) -> AngleEliminant:
        """The polynomial that is left."""
        return _eliminant(self, names)

    def values_of(self, eliminant: AngleEliminant) -> Iterator[Definition]:
        """The unknowns by Cramer's rule, and what follows of them."""
        for k, unknown in enumerate(self.unknowns, start=1):
            yield Definition(unknown, eliminant.steps[k].symbol / eliminant.steps[0].symbol)
        for unknown, form in self.values.items():
            yield Definition(unknown, value_of(form))


def eliminated(
    directions: Sequence[UnknownDirection],
    equations: Sequence[Form],
    witness: ModularWitness,
    taken: set[str],
    platform: str = "",
    carrier: UnknownDirection | None = None,
) -> SolvedSet:
    """A set whose directions belong together, by its eliminant; of equal degrees that in the platform's angle.

    A circle by which axes of the others turn is a coefficient of the equations; it is the one that is taken as known.

    Errors:
        NotDerivedError: none of its circles leaves linear equations and one more.
    """
    names = FreeNames(taken)
    known, equations = _named(equations, witness, names, () if carrier is None else carrier.unknowns)
    choices: list[tuple[tuple[int, bool, int], _Leftover | CirclePair, AngleEliminant]] = []
    why = ["there is no circle among them"]
    for base in sorted(directions, key=lambda own: platform not in own.links):
        if base.kind == "circle" and carrier in (None, base):
            try:
                left = _left_by(base, directions, equations, witness)
                rough = _shaped(left.eliminant(FreeNames(set(taken))), witness)
            except NotDerivedError as error:
                why.append(str(error))
                continue
            choices.append(((rough.degree, platform not in base.links, _length_of(rough)), left, rough))
            if platform in base.links and _irreducible(rough, witness):
                break  # every other angle that says all the rest has a polynomial of the same degree
    if not choices:
        raise NotDerivedError(why[-1])
    _, left, rough = min(choices, key=lambda choice: choice[0])
    plain = left.eliminant(names)
    eliminant = replace(_with_names(plain, known, names, witness), spare=rough.spare, degree=rough.degree)
    for own in eliminant.known[len(known) :]:
        _define(own, witness)
    witness.drawn(left.base.unknowns, lambda: some_root(eliminant, witness))
    values = left.values_of(eliminant)
    after = [*eliminant.entries, *eliminant.steps[:-1], *eliminant.backward, *values]
    for own in after:
        _define(own, witness)
    return SolvedSet(
        (left.base, *(direction for direction in directions if direction is not left.base)),
        tuple(equations),
        eliminant.named_lines or left.lines,
        tuple(dict.fromkeys((*left.conditions, *eliminant.divisors))),
        (*eliminant.known, *after),
        (),
        (),
        eliminant,
    )


def _named(
    equations: Sequence[Form], witness: ModularWitness, names: FreeNames, turning: tuple[sympy.Symbol, ...]
) -> tuple[tuple[Definition, ...], list[Form]]:
    """Sums that are known in each equation under names, the same of the same sum; beside cosine and sine that turn."""
    known = dict[sympy.Expr, Definition]()

    def name(factor: sympy.Expr) -> sympy.Expr:
        if factor.free_symbols & {*turning}:
            terms = trigonometric_terms(factor, turning, witness)
            return sum((name(part) * turning[0] ** i * turning[1] ** j for (i, j), part in terms.items()), ZERO)
        if not factor.has(sympy.Add):
            return factor
        short = sympy.factor_terms(factor)
        sign = -1 if -short in known else 1
        if sign * short not in known:
            own = known[short] = Definition(names.numbered("a"), short)
            _define(own, witness)
        return sign * known[sign * short].symbol

    named = [{key: name(factor) for key, factor in form.items()} for form in equations]
    return tuple(known.values()), named


def _irreducible(eliminant: AngleEliminant, witness: ModularWitness) -> bool:
    """Whether cycle types at a few draws show that a polynomial is irreducible."""
    types: dict[CycleType, int] = {}
    for _ in range(DRAWS):
        with contextlib.suppress(NoResidueRootError):
            if (own := cycle_type(eliminant, witness)) is not None:
                types[own] = witness.field.p
        if findings(eliminant.degree, types).irreducible:
            return True
        witness.draw_again()
    return False


def _define(own: Definition, witness: ModularWitness) -> None:
    witness.home.setdefault(own.symbol, witness.at_home(own.formula))
    witness.define(own.symbol, own.formula)


def _leftover(
    base: UnknownDirection,
    directions: Sequence[UnknownDirection],
    equations: Sequence[Form],
    witness: ModularWitness,
) -> _Leftover:
    others = [direction for direction in directions if direction is not base]
    unknowns = [unknown for direction in others for unknown in direction.unknowns]
    conditions: list[sympy.Expr] = []
    kept = _kept(others, equations, witness)
    apart = [unknown for unknown in unknowns if unknown not in kept]
    values, rest = solved(equations, apart, witness, conditions, base.unknowns)
    inner, given = solved(rest, kept, witness, conditions, base.unknowns)
    values = {unknown: replaced(form, inner, witness) for unknown, form in values.items()} | inner
    if not all(form.keys() & {*unknowns} for form in given):
        raise NotDerivedError(f"{base.name} has linear equations of its own")
    left = tuple(unknown for unknown in unknowns if unknown not in values)
    forms = {unknown: values.get(unknown, {unknown: ONE}) for unknown in unknowns}
    curved_ones = [direction for direction in others if direction.kind != "stroke"]
    quadrics = [reduced_quadric(direction, forms, base, left, witness) for direction in curved_ones]
    monomials = sorted({key for form in quadrics for key in form if key not in left and key != ONE}, key=str)
    turning = any(form[key].free_symbols & {*base.unknowns} for form in quadrics for key in monomials if key in form)
    if turning and len(quadrics) > 1:
        raise NotDerivedError(f"with {base.name} taken as known, quadratic parts turn with it")
    curved, plain = ({}, quadrics) if not monomials else solved(quadrics, monomials, witness, conditions)
    if turning:
        curved, plain = dict.fromkeys(monomials[:1], quadrics[0]), []
    lines = sorted((reduced_form(_divided(line, base), base, witness) for line in (*given, *plain)), key=_length)
    if len(lines) + len(curved) != len(left) + 1 or len(curved) > 1:
        raise NotDerivedError(
            f"with {base.name} taken as known, {len(lines)} linear equations and {len(curved)} quadrics are left "
            f"for {len(left)} unknowns"
        )
    quadric = _divided(min(quadrics, key=_length), base) if curved else {}
    return _Leftover(base, left, tuple(lines), quadric, values, tuple(conditions))


def _left_by(
    base: UnknownDirection, directions: Sequence[UnknownDirection], equations: Sequence[Form], witness: ModularWitness
) -> _Leftover | CirclePair:
    """What a circle leaves that is taken as known. Errors: NotDerivedError."""
    try:
        return _leftover(base, directions, equations, witness)
    except NotDerivedError:
        if not any(own.kind == "side" for own in directions):
            raise
        return circle_pair(base, directions, equations, witness)


def _kept(
    others: Sequence[UnknownDirection], equations: Sequence[Form], witness: ModularWitness
) -> tuple[sympy.Symbol, ...]:
    """Unknowns of one direction of which all others are linear forms, so that its own quadric is the plain one."""
    for direction in others:
        unknowns = [unknown for other in others if other is not direction for unknown in other.unknowns]
        if rank(equations, unknowns, witness) == len(unknowns):
            return direction.unknowns
    return ()


def _divided(form: Form, base: UnknownDirection) -> Form:
    """A form without the factor that all of it shares, but for what of that turns with the base: it may vanish."""
    plain = divided(form)
    key = next(iter(form))
    shared, _ = sympy.fraction(tidy(form[key] / plain[key]))
    factors = (factor**power for factor, power in sympy.factor_list(shared)[1])
    turning = sympy.prod([factor for factor in factors if factor.free_symbols & {*base.unknowns}])
    return plain if turning == 1 else {own: tidy(part * turning) for own, part in plain.items()}


def _length(form: Form) -> tuple[int, int]:
    return len(form), sum(int(sympy.count_ops(part)) for part in form.values())


def _length_of(eliminant: AngleEliminant) -> int:
    return sum(int(sympy.count_ops(own.formula)) for own in (*eliminant.entries, *eliminant.steps))


def _eliminant(left: _Leftover, names: FreeNames) -> AngleEliminant:
    """Entries and steps; the determinant by which the unknowns are divided is the first of these."""
    entries: dict[sympy.Expr, Definition] = {}

    def entry(formula: sympy.Expr) -> sympy.Expr:
        if formula.is_number or formula.is_Symbol:
            return formula
        if formula not in entries:
            entries[formula] = Definition(names.numbered("f"), formula)
        return entries[formula].symbol

    rows = [[entry(line.get(key, ZERO)) for key in (*left.unknowns, ONE)] for line in left.lines]
    count = len(left.unknowns)
    steps: list[Definition] = []
    homogeneous: dict[sympy.Symbol, sympy.Expr] = {}
    one: sympy.Expr = ONE
    if count:
        own = Definition(names.named("det"), _determinant([row[:-1] for row in rows[:count]]))
        one = own.symbol
        steps.append(own)
        for k, unknown in enumerate(left.unknowns):
            matrix = [[*row[:k], -row[-1], *row[k + 1 : -1]] for row in rows[:count]]
            steps.append(Definition(names.numbered("n"), _determinant(matrix)))
            homogeneous[unknown] = steps[-1].symbol
    last = _determinant(rows) if not left.quadric else _at(left, homogeneous, one, entry)
    steps.append(Definition(names.named("elim"), last))
    divisors = tuple(own.symbol for own in steps[:1]) if count else ()
    return AngleEliminant(
        left.base, (), tuple(entries.values()), tuple(steps), left.unknowns, left.quadric, divisors=divisors
    )


def _at(
    left: _Leftover,
    values: Mapping[sympy.Symbol, sympy.Expr],
    one: sympy.Expr,
    entry: Callable[[sympy.Expr], sympy.Expr],
) -> sympy.Expr:
    """The quadric where the unknowns are `values` over `one`, times the square of that."""
    products = {product_symbol(a, b): values[a] * values[b] for a in left.unknowns for b in left.unknowns}
    products |= {a: values[a] * one for a in left.unknowns} | {ONE: one**2}
    return sum((entry(part) * products[key] for key, part in left.quadric.items()), ZERO)


def _determinant(rows: Matrix) -> sympy.Expr:
    return sympy.expand(sympy.Matrix(rows).det(method="berkowitz"))


def _shaped(eliminant: AngleEliminant, witness: ModularWitness) -> AngleEliminant:
    """With its degree, and how often 1 + t^2 divides it. Errors: NotDerivedError, where it is none of that degree."""
    name = eliminant.direction.name
    for _ in range(DRAWS):
        with contextlib.suppress(NoResidueRootError):
            (own, spare), known = polynomial(eliminant, witness), residues(eliminant, witness, backward=True)
            break
        witness.draw_again()
    else:
        raise NotDerivedError(f"with {name} taken as known, coefficients have roots that no draw makes residues")
    if own.degree() < 1:
        raise NotDerivedError(f"with {name} taken as known, nothing is left that says where it is")
    if own.gcd(own.derivative()).degree() > 0:
        raise NotDerivedError(f"the polynomial in {name} has multiple roots")
    if any(own.gcd(known[divisor]).degree() > 0 for divisor in eliminant.divisors):
        raise NotDerivedError(f"the polynomial in {name} has roots that say nothing")
    return replace(eliminant, spare=spare, degree=own.degree())


def _with_names(
    plain: AngleEliminant, known: tuple[Definition, ...], names: FreeNames, witness: ModularWitness
) -> AngleEliminant:
    """What is known of the entries under names."""
    given: dict[sympy.Expr, sympy.Symbol] = {}

    def name(factor: sympy.Expr) -> sympy.Expr:
        if sympy.count_ops(factor) < 2:
            return factor
        short = sympy.factor_terms(factor)
        sign = -1 if short.could_extract_minus_sign() else 1
        if sign * short not in given:
            given[sign * short] = names.numbered("a")
        return sign * given[sign * short]

    cosine, sine = plain.direction.unknowns
    entries = []
    for own in plain.entries:
        terms = trigonometric_terms(own.formula, plain.direction.unknowns, witness)
        formula = sum((name(factor) * cosine**i * sine**j for (i, j), factor in terms.items()), ZERO)
        entries.append(Definition(own.symbol, formula))
    new = (Definition(symbol, formula) for formula, symbol in given.items())
    return replace(plain, known=(*known, *plain.known, *new), entries=tuple(entries))
