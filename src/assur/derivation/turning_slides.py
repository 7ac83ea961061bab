"""Velocities of slides along lines that turn: eliminated without a division by the line's cosine or sine."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence

import sympy

from assur.derivation.linear import Form, combined, tidy
from assur.derivation.witness import ModularWitness


def along_slides(
    forms: Iterable[Form],
    rates: Iterable[sympy.Symbol],
    circles: Sequence[tuple[sympy.Symbol, sympy.Symbol]],
    witness: ModularWitness,
) -> list[Form]:
    """The same equations; two that a slide enters by cosine and sine of its line become one along it and one across.

    The rate is left in the one along, by the square of both that is 1.

    Args:
        forms: equations between rates.
        rates: those of slides, among others.
        circles: (cosine, sine) of what turns.
        witness: for tests of zero.

    >>> c, s, rate, x, y = sympy.symbols("c s rate x y")
    >>> along_slides([{rate: c, x: -1}, {rate: s, y: -1}], [rate], [(c, s)], ModularWitness())
    [{rate: 1, x: -c, y: -s}, {y: -c, x: s}]
    """
    left = [*forms]
    for rate, (cosine, sine) in itertools.product(rates, circles):
        rows = [k for k, form in enumerate(left) if form.get(rate, sympy.Integer(0)).free_symbols & {cosine, sine}]
        for i, j in itertools.permutations(rows, 2):
            share = sympy.cancel(left[i].get(rate, 0) / cosine)
            if share == 0 or share.free_symbols & {cosine, sine}:
                continue
            for own in (sine, -sine):
                if witness.is_zero(left[j].get(rate, 0) - share * own):
                    along, across = _turned(left[i], left[j], cosine, own, witness)
                    left[i], left[j] = along | {rate: share}, across
                    break
    return left


def _turned(
    first: Form, second: Form, cosine: sympy.Symbol, sine: sympy.Expr, witness: ModularWitness
) -> tuple[Form, Form]:
    """Both equations turned by an angle."""
    turned = []
    for one, a, other, b in ((first, cosine, second, sine), (second, cosine, first, -sine)):
        total = combined({key: tidy(a * part) for key, part in one.items()}, b, other, witness)
        turned.append({key: _on_circle(part, cosine, sine) for key, part in total.items()})
    return turned[0], turned[1]


def _on_circle(part: sympy.Expr, cosine: sympy.Symbol, sine: sympy.Expr) -> sympy.Expr:
    """A coefficient with the squares of sine and cosine added up to 1, where that is shorter."""
    other = sympy.expand(sympy.expand(part).subs(sine**2, 1 - cosine**2))
    return min(part, other, key=sympy.count_ops)
