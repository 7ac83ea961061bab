"""Sliders on links that turn: a length along a direction that turns is a vector, in which the loops are linear.

Let a link turn by (c, s) in a plane, and a length q run along its direction p. Where it meets the loop equations by
one vector of the link, V = (q + w1) (c, s) + w2 (-s, c), the two components of V take the place of q, c and s. Then
(q + w1)^2 = V.V - w2^2, with either sign, and (c, s) follow of V. Where a link has another vector too, as a platform
that slides on one limb and is jointed to the next, (c, s) stay in the equations of that: these follow after V. Along a
rod between ball or universal joints, whose direction is e, it is V = (q + w1) e.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.definitions import Definition, FreeNames
from assur.derivation.elimination import Root, SolvedSet
from assur.derivation.linear import Form
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness

ZERO = sympy.Integer(0)


@dataclass(frozen=True)
class StrokeVector:
    """A vector with a length along a direction that turns.

    Attributes:
        length: the symbol of the length.
        circle: the direction that turns.
        along, beside: w1 and w2, what the vector has beside the length.
        direction: the components of the vector, as unknowns.
    """

    length: sympy.Symbol
    circle: UnknownDirection
    along: sympy.Expr
    beside: sympy.Expr
    direction: UnknownDirection


def stroke_vectors(
    forms: Sequence[Form],
    strokes: Mapping[sympy.Symbol, UnknownDirection],
    witness: ModularWitness,
) -> tuple[tuple[StrokeVector, ...], list[Form]]:
    """Vectors in the place of lengths along directions that turn, and the equations in these.

    Args:
        forms: equations, in which such lengths are coefficients.
        strokes: length -> the circle along whose direction it runs.
        witness: by which what vanishes is told.

    Errors:
        NotDerivedError: a rod that turns and has more than one vector in the loops.

    Example: a slider on a turning link whose end stands aside by a.

    >>> q, c, s, a, x = sympy.symbols("q c s a x")
    >>> circle = UnknownDirection("circle", "leg", (c, s), ("leg",))
    >>> (vector,), forms = stroke_vectors([{c: q, s: -a, sympy.Integer(1): -x}], {q: circle}, ModularWitness())
    >>> vector.along, vector.beside, forms
    (0, a, [{1: -x, vx_leg: 1}])
    """
    vectors: list[StrokeVector] = []
    left = list(forms)
    for length, circle in strokes.items():
        vector = _along_rod(left, length, circle, witness) if circle.kind == "rod" else _vector(left, length, circle)
        left = [_replaced(form, vector, witness) for form in left]
        vectors.append(vector)
    return tuple(vectors), left


def _vector(forms: Sequence[Form], length: sympy.Symbol, circle: UnknownDirection) -> StrokeVector:
    rows = [_parts(form, length, circle) for form in forms if form.keys() & {*circle.unknowns}]
    along = beside = ZERO
    for p, q, first, second in sorted(rows, key=lambda row: sum(int(sympy.count_ops(part)) for part in row)):
        if p != 0 or q != 0:
            square = p**2 + q**2
            along = sympy.factor(sympy.cancel((first * p + second * q) / square))
            beside = sympy.factor(sympy.cancel((first * q - second * p) / square))
            break
    name = circle.name
    unknowns = tuple(sympy.Symbol(f"v{axis}_{name}", real=True) for axis in "xy")
    return StrokeVector(length, circle, along, beside, UnknownDirection("stroke", name, unknowns, circle.links))


def _along_rod(
    forms: Sequence[Form], length: sympy.Symbol, rod: UnknownDirection, witness: ModularWitness
) -> StrokeVector:
    """Errors: NotDerivedError, for a rod with more than one length in the loops."""
    along: set[sympy.Expr] = set()
    for form in forms:
        for unknown in rod.unknowns:
            part = sympy.expand(form.get(unknown, ZERO))
            if not witness.is_zero(part.coeff(length)):
                along.add(sympy.cancel(part.subs(length, 0) / part.coeff(length)))
            elif not witness.is_zero(part):
                along.add(sympy.zoo)
    if len(along) > 1:
        raise NotDerivedError(f"{rod.name} turns, carries a slider, and has two vectors in the loops")
    (share,) = along
    unknowns = tuple(sympy.Symbol(f"v{axis}_{rod.name}", real=True) for axis in "xyz")
    return StrokeVector(length, rod, share, ZERO, UnknownDirection("stroke", rod.name, unknowns, rod.links))


def _parts(
    form: Form, length: sympy.Symbol, circle: UnknownDirection
) -> tuple[sympy.Expr, sympy.Expr, sympy.Expr, sympy.Expr]:
    """Coefficients of q c and q s, and of c and s alone."""
    c, s = (sympy.expand(form.get(unknown, ZERO)) for unknown in circle.unknowns)
    return c.coeff(length), s.coeff(length), c.subs(length, 0), s.subs(length, 0)


def _replaced(form: Form, vector: StrokeVector, witness: ModularWitness) -> Form:
    """An equation in the vector. What else of the link is in it stays in the link's own direction."""
    old = vector.circle.unknowns
    rest = {key: part for key, part in form.items() if key not in old}
    if vector.circle.kind == "rod":
        shares = [sympy.expand(form.get(unknown, ZERO)).coeff(vector.length) for unknown in old]
        gaps: tuple[sympy.Expr, ...] = ()
    else:
        p, q, first, second = _parts(form, vector.length, vector.circle)
        shares = [p, q]
        gaps = first - vector.along * p - vector.beside * q, second - vector.along * q + vector.beside * p
    own = dict(zip(vector.direction.unknowns, shares, strict=True))
    turning = {unknown: sympy.factor(gap) for unknown, gap in zip(old, gaps, strict=False) if not witness.is_zero(gap)}
    return rest | {unknown: share for unknown, share in own.items() if share != 0} | turning


def with_strokes(
    part: SolvedSet, vectors: Sequence[StrokeVector], number: int, witness: ModularWitness, taken: set[str]
) -> SolvedSet:
    """A solved set with lengths and angles of the vectors in it."""
    names = FreeNames(taken)
    definitions, roots, conditions = list(part.definitions), list(part.roots), list(part.conditions)
    own = [vector for vector in vectors if vector.direction in part.directions]
    for k, vector in enumerate(own):
        suffix = f"{number}" if len(own) == 1 else f"{number}{'abcdefgh'[k]}"
        for definition in _solved(vector, suffix, names, witness, roots, conditions):
            turned = any(root.symbol == definition.symbol and witness.home[root.symbol] < 0.0 for root in roots)
            witness.define(definition.symbol, -definition.formula if turned else definition.formula)
            definitions.append(definition)
    return SolvedSet(
        part.directions, part.equations, part.lines, tuple(conditions), tuple(definitions), tuple(roots),
        part.shared, part.eliminant,
    )  # fmt: skip


def _solved(
    vector: StrokeVector,
    suffix: str,
    names: FreeNames,
    witness: ModularWitness,
    roots: list[Root],
    conditions: list[sympy.Expr],
) -> Iterator[Definition]:
    square = names.named(f"N{suffix}")
    yield Definition(square, sum((part**2 for part in vector.direction.unknowns), ZERO))
    conditions.append(square)
    radicand = names.named(f"M{suffix}")
    yield Definition(radicand, square - vector.beside**2)
    root, reach = names.named(f"r{suffix}"), vector.length + vector.along
    roots.append(Root(root, radicand, reach))
    witness.home[root] = witness.at_home(reach)
    yield Definition(root, sympy.sqrt(radicand))
    yield Definition(vector.length, root - vector.along)
    if vector.beside == 0:
        for unknown, part in zip(vector.circle.unknowns, vector.direction.unknowns, strict=True):
            yield Definition(unknown, part / root)
    else:
        (x, y), (cosine, sine) = vector.direction.unknowns, vector.circle.unknowns
        yield Definition(cosine, (root * x + vector.beside * y) / square)
        yield Definition(sine, (root * y - vector.beside * x) / square)
