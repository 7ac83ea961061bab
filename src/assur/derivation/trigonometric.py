"""Polynomials in the cosine and the sine of one angle: one form of each, and as homogeneous ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy

from assur.derivation.linear import Form
from assur.derivation.symbols import Circle
from assur.derivation.witness import ModularWitness

Powers = tuple[int, int]
ONE = sympy.Integer(1)


def trigonometric_terms(
    formula: sympy.Expr, circle: tuple[sympy.Symbol, ...], witness: ModularWitness
) -> dict[Powers, sympy.Expr]:
    """Powers of cosine and sine, that of the sine 0 or 1 -> coefficient; what vanishes is left out.

    >>> c, s, a = sympy.symbols("c s a")
    >>> trigonometric_terms(a * s**2 + a * c**2 + c * s, (c, s), ModularWitness())
    {(0, 0): a, (1, 1): 1}
    """
    cosine, sine = circle
    terms: dict[Powers, sympy.Expr] = {}
    for term in sympy.Add.make_args(sympy.expand(formula)):
        powers = term.as_powers_dict()
        i, j = int(powers.get(cosine, 0)), int(powers.get(sine, 0))
        factor = term / (cosine**i * sine**j)
        for k in range(j // 2 + 1):  # (1 - cos^2)^(j // 2)
            key = i + 2 * k, j % 2
            terms[key] = terms.get(key, sympy.Integer(0)) + factor * (-1) ** k * sympy.binomial(j // 2, k)
    return {key: terms[key] for key in sorted(terms) if not witness.is_zero(terms[key])}


def reduced(formula: sympy.Expr, circle: tuple[sympy.Symbol, ...], witness: ModularWitness) -> sympy.Expr:
    """A polynomial modulo cos^2 + sin^2 = 1, in its one form.

    >>> c, s = sympy.symbols("c s")
    >>> reduced((c + s) ** 2, (c, s), ModularWitness())
    2*c*s + 1
    """
    cosine, sine = circle
    terms = trigonometric_terms(formula, circle, witness)
    return sum((factor * cosine**i * sine**j for (i, j), factor in terms.items()), sympy.Integer(0))


def shorter(form: Form, circles: Sequence[Circle], witness: ModularWitness) -> Form:
    """Coefficients modulo cos^2 + sin^2 = 1 of angles that are given, where they are shorter so.

    >>> c, s, a, x = sympy.symbols("c s a x")
    >>> shorter({x: a * c**2 + a * s**2}, [(c, s)], ModularWitness())
    {x: a}
    """
    short = dict(form)
    for circle in circles:
        whole = {key: part for key, part in short.items() if part.has(*circle) and part.is_polynomial(*circle)}
        plain = {key: reduced(part, circle, witness) for key, part in whole.items()}
        short |= {key: min(short[key], part, key=sympy.count_ops) for key, part in plain.items()}
    return short


def homogeneous(formula: sympy.Expr, degrees: Mapping[sympy.Symbol, int], one: sympy.Expr) -> tuple[sympy.Expr, int]:
    """A polynomial with powers of `one` in its terms, so that all are of one degree, and that degree.

    >>> c, s, w = sympy.symbols("c s w")
    >>> homogeneous(2 * c * s + 1, {c: 1, s: 1}, w)
    (2*c*s + w**2, 2)
    """
    terms = sympy.Add.make_args(sympy.expand(formula))
    sizes = [
        sum(degrees.get(base, 0) * int(power) for base, power in term.as_powers_dict().items() if base in degrees)
        for term in terms
    ]
    top = max(sizes)
    return sum((term * one ** (top - size) for term, size in zip(terms, sizes, strict=True)), sympy.Integer(0)), top
