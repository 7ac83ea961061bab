"""Three quadrics meet in eight points: the polynomial of degree eight for one coordinate t, and the other two from it.

At a fixed t the quadrics are conics in x and y. Their quadratic parts are independent of t, so the three equations give

    x^2 = a1 x + b1 y + c1,    x y = a2 x + b2 y + c2,    y^2 = a3 x + b3 y + c3,

a and b of degree 1 in t, c of degree 2. Then x (x y) - y (x^2) = 0 and x (y^2) - y (x y) = 0, with these put in, are
two equations linear in x and y, and y times the first of them is a third. At a common point the determinant of the
three is zero; its degree is 2 + 2 + 4 = 8. So its roots are the eight points, and nothing else.
"""

from __future__ import annotations

from typing import Any

from assur.numerics.polynomials import Polynomial, add, multiply, scaled, subtract
from assur.numerics.vectors import cross, dot

Number = Any
Quadric = tuple[Polynomial, Polynomial, Polynomial, Polynomial, Polynomial, Polynomial]
"""Factors of x^2, x y, y^2, x, y and 1, polynomials in t of degrees 0, 0, 0, 1, 1, 2; it is where the sum is zero."""

Relation = tuple[Polynomial, Polynomial, Polynomial]
"""Factors of x, y and 1 in an equation linear in x and y."""


def eliminant(quadrics: tuple[Quadric, Quadric, Quadric]) -> tuple[Number, ...]:
    """Coefficients (9) of the polynomial in t whose roots are the coordinates t of the common points.

    The leading coefficient depends on the quadratic parts alone. It is zero where these do not determine x^2, x y and
    y^2, or where two points at infinity have one t: then turn the coordinates.

    Example: x^2 = 1, y^2 = 4 and x y = t^2 - 2 give -t^4 (t^2 - 4)^2.

    >>> first, second = ((1,), (0,), (0,), (0,), (0,), (-1,)), ((0,), (0,), (1,), (0,), (0,), (-4,))
    >>> third = ((0,), (1,), (0,), (0,), (0,), (2, 0, -1))
    >>> [round(part) for part in eliminant((first, second, third))]
    [0, 0, 0, 0, -16, 0, 8, 0, -1]
    """
    rows = _rows(quadrics)
    first, second = _relations(rows)
    third = _times_y(first, rows)
    x, y, one = _cross(first, second)
    return _total(multiply(third[0], x), multiply(third[1], y), multiply(third[2], one))


def other_two(quadrics: tuple[Quadric, Quadric, Quadric], t: Number) -> tuple[Number, Number, Number]:
    """The coordinates x and y of the point at a root t, and the determinant that vanishes where two points share it."""
    first, second = _relations(_rows(quadrics))
    x, y, apart = cross(_at(first, t), _at(second, t))
    return x / apart, y / apart, apart


def _rows(quadrics: tuple[Quadric, Quadric, Quadric]) -> tuple[Relation, Relation, Relation]:
    """(a, b, c) for x^2, x y and y^2, by Cramer's rule."""
    first, second, third = ((q[0][0], q[1][0], q[2][0]) for q in quadrics)
    columns = (cross(second, third), cross(third, first), cross(first, second))
    determinant = dot(first, columns[0])
    rest = [[quadric[part] for quadric in quadrics] for part in (3, 4, 5)]
    one, two, three = (
        tuple(_total(*(scaled(part, -columns[i][row] / determinant) for i, part in enumerate(parts))) for parts in rest)
        for row in range(3)
    )
    return _relation(one), _relation(two), _relation(three)


def _relations(rows: tuple[Relation, Relation, Relation]) -> tuple[Relation, Relation]:
    """The two equations linear in x and y: x (x y) - y (x^2) = 0 and x (y^2) - y (x y) = 0."""
    (a1, b1, c1), (a2, b2, c2), (a3, b3, c3) = rows
    first = (
        add(subtract(multiply(a2, b2), multiply(b1, a3)), c2),
        subtract(_total(multiply(a2, b1), multiply(subtract(b2, a1), b2)), add(multiply(b1, b3), c1)),
        subtract(_total(multiply(a2, c1), multiply(subtract(b2, a1), c2)), multiply(b1, c3)),
    )
    second = (
        subtract(_total(multiply(a3, a1), multiply(subtract(b3, a2), a2), c3), multiply(b2, a3)),
        subtract(multiply(a3, b1), add(multiply(a2, b2), c2)),
        subtract(_total(multiply(a3, c1), multiply(subtract(b3, a2), c2)), multiply(b2, c3)),
    )
    return first, second


def _times_y(relation: Relation, rows: tuple[Relation, Relation, Relation]) -> Relation:
    """A linear relation times y, linear again by the rows for x y and y^2."""
    p, q, r = relation
    _, (a2, b2, c2), (a3, b3, c3) = rows
    return (
        add(multiply(p, a2), multiply(q, a3)),
        _total(multiply(p, b2), multiply(q, b3), r),
        add(multiply(p, c2), multiply(q, c3)),
    )


def _cross(first: Relation, second: Relation) -> Relation:
    """Cross product of two relations: x, y and 1 up to a common factor."""
    (a, b, c), (d, e, f) = first, second
    return (
        subtract(multiply(b, f), multiply(c, e)),
        subtract(multiply(c, d), multiply(a, f)),
        subtract(multiply(a, e), multiply(b, d)),
    )


def _relation(parts: tuple[Polynomial, ...]) -> Relation:
    x, y, one = parts
    return x, y, one


def _at(relation: Relation, t: Number) -> tuple[Number, Number, Number]:
    """Values of the three polynomials at t."""
    x, y, one = (_value(part, t) for part in relation)
    return x, y, one


def _value(polynomial: Polynomial, t: Number) -> Number:
    total: Number = 0
    for coefficient in reversed(polynomial):
        total = total * t + coefficient
    return total


def _total(*polynomials: Polynomial) -> tuple[Number, ...]:
    total: tuple[Number, ...] = ()
    for polynomial in polynomials:
        total = add(total, polynomial)
    return total
