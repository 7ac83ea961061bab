"""A line, a conic and the unit circle: when they meet in a point, where, and why, as polynomials.

The line a c + b s + d = 0 meets the circle at n c = -d a - b p and n s = -d b + a p with n = a^2 + b^2 and
p^2 = n - d^2. There the conic q1 + q2 c + q3 s + q4 c s + q5 s^2 is (U + V p) / n^2. So the three have a point in
common where U^2 = V^2 (n - d^2); n^2 divides that everywhere, and leaves T^2 + K (n - d^2). Here K and T are quadrics
in the line: the conic's dual, and what it and that of the circle have in common. It is p = -U / V, and n divides cosine
and sine times V.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import sympy

a, b, d, c, s = sympy.symbols("a b d c s")
q = sympy.symbols("q1:6")
STEPS = sympy.symbols("w T K")


@dataclass(frozen=True)
class LineAndConic:
    """What three curves say together.

    Attributes:
        steps: n - d^2, T and K.
        eliminant: what vanishes where they have a point in common, in these.
        over: of cosine and sine, times `under`.
        under: where it vanishes too, the line meets circle and conic in both points.
        why: of the eliminant, and of cosine and sine times `under` less `over`: multipliers of line, circle and conic.
    """

    steps: tuple[sympy.Expr, sympy.Expr, sympy.Expr]
    eliminant: sympy.Expr
    over: tuple[sympy.Expr, sympy.Expr]
    under: sympy.Expr
    why: tuple[tuple[sympy.Expr, sympy.Expr, sympy.Expr], ...]

    def at(
        self,
        line: Sequence[sympy.Expr],
        conic: Sequence[sympy.Expr],
        circle: Sequence[sympy.Expr],
        steps: Sequence[sympy.Expr] = (),
    ) -> LineAndConic:
        """The same of a line, a conic and a circle by their names, and of steps if they have some."""
        names = dict(zip((a, b, d, *q, c, s), (*line, *conic, *circle), strict=True)) | dict(
            zip(STEPS, steps, strict=False)
        )

        def put(formula: sympy.Expr) -> sympy.Expr:
            return formula.xreplace(names)

        why = tuple((put(one), put(two), put(three)) for one, two, three in self.why)
        w, t, k = map(put, self.steps)
        return LineAndConic(
            (w, t, k), put(self.eliminant), (put(self.over[0]), put(self.over[1])), put(self.under), why
        )


@lru_cache(maxsize=1)
def line_and_conic() -> LineAndConic:
    """In symbols of its own.

    >>> own = line_and_conic()
    >>> own.under
    a**3*q3 + a**2*(-b*q2 - d*q4) + a*(b**2*q3 - 2*b*d*q5) - b**3*q2 + b**2*d*q4
    """
    n, p = a**2 + b**2, a * s - b * c
    u = (
        q[0] * n**2 - n * d * (q[1] * a + q[2] * b) + q[3] * a * b * (2 * d**2 - n)
        + q[4] * (d**2 * b**2 + a**2 * (n - d**2))
    )  # fmt: skip
    v = n * (q[2] * a - q[1] * b) + q[3] * d * (b**2 - a**2) - 2 * q[4] * a * b * d
    w, t, k = STEPS
    steps = n - d**2, _common(), _dual()
    eliminant = t**2 + k * w
    whole = eliminant.subs(dict(zip(STEPS, steps, strict=True)))
    if sympy.expand(whole * n**2 - u**2 + v**2 * (n - d**2)) != 0:
        raise ArithmeticError("no quotient")
    over = _quotient(b * u - a * d * v, n), _quotient(-b * d * v - a * u, n)
    claims = (whole, u - v * p), (c * v - over[0], -b * n), (s * v - over[1], a * n)
    why = tuple((*_of_line_and_circle(left - share * _conic()), share) for left, share in claims)
    cosine, sine = map(_collected, over)
    return LineAndConic(steps, eliminant, (cosine, sine), sympy.collect(sympy.expand(v), (a, b)), why)


def _conic() -> sympy.Expr:
    return q[0] + q[1] * c + q[2] * s + q[3] * c * s + q[4] * s**2


def _common() -> sympy.Expr:
    """What the duals of conic and circle have in common, as a quadric in the line."""
    ahead = a**2 * (q[0] - q[4]) + b**2 * q[0] + d**2 * q[4]
    return ahead + a * b * q[3] - a * d * q[1] - b * d * q[2]


def _dual() -> sympy.Expr:
    """The conic's dual: where it vanishes, the line touches the conic."""
    ahead = a**2 * (4 * q[0] * q[4] - q[2] ** 2) - b**2 * q[1] ** 2 - d**2 * q[3] ** 2
    across = a * b * (q[1] * q[2] - 2 * q[0] * q[3]) + a * d * (q[2] * q[3] - 2 * q[1] * q[4]) + b * d * q[1] * q[3]
    return ahead + 2 * across


def _quotient(over: sympy.Expr, under: sympy.Expr) -> sympy.Expr:
    quotient, rest = sympy.div(sympy.expand(over), sympy.expand(under), a)
    if rest != 0:
        raise ArithmeticError("no quotient")
    return sympy.expand(quotient)


def _of_line_and_circle(formula: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Multipliers of line and circle: by the line for d, then by the circle for c."""
    along, rest = sympy.div(sympy.expand(formula), a * c + b * s + d, d)
    around, rest = sympy.div(sympy.expand(rest), c**2 + s**2 - 1, c)
    if rest != 0:
        raise ArithmeticError("no sum of multiples of line and circle")
    return sympy.factor_terms(along), sympy.factor_terms(around)


def _collected(formula: sympy.Expr) -> sympy.Expr:
    """By products of the conic's coefficients, each factored."""
    terms = (
        sympy.prod([k**i for k, i in zip(q, powers, strict=True)]) * sympy.factor(part)
        for powers, part in sympy.Poly(formula, *q).terms()
    )
    return sum(terms, sympy.Integer(0))
