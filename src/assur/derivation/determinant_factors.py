"""Factors of determinants of velocity equations."""

from __future__ import annotations

import sympy


def factors_of(matrix: sympy.Matrix) -> tuple[tuple[sympy.Expr, int], ...]:
    """Factors of a determinant with their powers, a number first.

    Rows and columns with one entry are taken out first: an entry is small, and a root of three in it does no harm.

    >>> x, y = sympy.symbols("x y")
    >>> factors_of(sympy.Matrix([[2 * x, 0], [1, x + y]]))
    ((2, 1), (x, 1), (x + y, 1))
    """
    number, powers = sympy.Integer(1), dict[sympy.Expr, int]()
    left = matrix
    while True:
        alone = _alone(left)
        own = left[alone] * (-1) ** sum(alone) if alone else left.det(method="berkowitz") if left.rows else 1
        for base, exponent in sympy.factor(sympy.cancel(own)).as_powers_dict().items():
            base = _on_circles(base)
            factor, power = (sympy.sqrt(base), 2 * exponent) if exponent.q == 2 else (base, exponent)
            if factor.is_number:
                number *= factor**power
            else:
                powers[factor] = powers.get(factor, 0) + int(power)
        if alone is None:
            return ((number, 1), *powers.items())
        left = left.minor_submatrix(*alone)


def _on_circles(factor: sympy.Expr) -> sympy.Expr:
    """A factor without sums of the squares of an angle's cosine and sine, where it is shorter so."""
    own = factor
    for sine in factor.atoms(sympy.sin):
        short = sympy.expand(sympy.expand(own).subs(sine**2, 1 - sympy.cos(sine.args[0]) ** 2))
        own = min(own, short, key=sympy.count_ops)
    return own


def _alone(matrix: sympy.Matrix) -> tuple[int, int] | None:
    """The place of an entry that is alone in its row or column."""
    for upright, lines in ((False, matrix.tolist()), (True, matrix.T.tolist())):
        for i, line in enumerate(lines):
            entries = [j for j, entry in enumerate(line) if entry != 0]
            if len(entries) == 1:
                return (entries[0], i) if upright else (i, entries[0])
    return None
