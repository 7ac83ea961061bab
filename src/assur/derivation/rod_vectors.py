"""The direction of a rod by vectors: what a set's formulas are component by component, told again by their identity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from assur.derivation.elimination import SolvedSet
from assur.numerics.vectors import Vector, add, cross, dot, scaled, subtract

ZERO = sympy.Integer(0)


@dataclass(frozen=True)
class RodVectors:
    """d = (h v x w + k w x u + r w) / w.w with w = u x v.

    Attributes:
        unknowns: the components of d.
        normals: u and v.
        shares: h and k, as u.d = h and v.d = k.
        across: w.
        square: w.w.
        radicand: r^2 = w.w - |h v - k u|^2.
        root: r.
    """

    unknowns: Vector
    normals: tuple[Vector, Vector]
    shares: tuple[sympy.Expr, sympy.Expr]
    across: Vector
    square: sympy.Symbol
    radicand: sympy.Symbol
    root: sympy.Symbol


def rod_vectors(part: SolvedSet) -> RodVectors | None:
    """How the first direction of a set is found, where it is the meeting of two planes with the unit sphere.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> rod_vectors(analytic_solution(load_record("delta_4s"), "direct").sets[0]).across
    (wx1, wy1, wz1)
    >>> rod_vectors(analytic_solution(load_record("fivebar"), "direct").sets[0]) is None
    True
    """
    base = part.directions[0]
    if base.kind != "rod" or len(part.roots) != 1 or len(part.lines) < 2:
        return None
    formulas = {own.symbol: own.formula for own in part.definitions}
    rows = [
        [_named(formulas, form.get(key, ZERO), letter) for key in base.unknowns]
        for form, letter in zip(part.lines, "uv", strict=False)
    ]
    shares = [-form.get(sympy.Integer(1), ZERO) for form in part.lines]
    h, k = (_named(formulas, share, letter) for share, letter in zip(shares, "hk", strict=False))
    n, m = ((row[0], row[1], row[2]) for row in rows)
    x, y, z = (_named(formulas, own, "w") for own in cross(n, m))
    w: Vector = (x, y, z)
    square = _named(formulas, dot(w, w), "N")
    if not square.is_Symbol or not all(sympy.sympify(own).is_Symbol for own in w):
        return None
    root, radicand = part.roots[0].symbol, part.roots[0].radicand
    apart = subtract(scaled(m, h), scaled(n, k))
    if sympy.expand(formulas[radicand] - square + dot(apart, apart)) != 0:
        return None
    whole = add(add(scaled(cross(m, w), h), scaled(cross(w, n), k)), scaled(w, root))
    for unknown, own in zip(base.unknowns, whole, strict=True):
        if sympy.expand(formulas[unknown] * square - own) != 0:
            return None
    return RodVectors(base.unknowns, (n, m), (h, k), w, square, radicand, root)


def _named(formulas: Mapping[sympy.Symbol, sympy.Expr], formula: sympy.Expr, letter: str) -> sympy.Expr:
    """The symbol that stands for a formula, of several that with a letter; else the formula."""
    own = sympy.factor_terms(formula)
    symbols = [symbol for symbol, other in formulas.items() if other == own]
    return min(symbols, key=lambda symbol: not symbol.name.startswith(letter), default=sympy.sympify(formula))
