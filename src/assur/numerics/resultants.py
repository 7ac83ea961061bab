"""Three quadrics meet in eight points: the polynomial for one coordinate t is a resultant, without any division.

At a fixed t the quadrics are three conics in x and y. Written as Q = x^2 (..) + y (..) + 1 (..), and likewise with y^2
or 1^2 split off, the determinant of the three rows of factors is a conic again, Sylvester's form; it vanishes at every
common point. Three quadrics and three forms are six equations linear in x^2, x y, y^2, x, y and 1, and the determinant
is the resultant of the conics (Sylvester; J.-P. Jouanolou, Formes d'inertie et resultant, 1997). In t its degree is 8,
and its leading coefficient is the resultant of the quadratic parts: zero only where these have a common point.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

from assur.numerics.polynomials import Polynomial, add, multiply, scaled, subtract
from assur.numerics.vectors import Vector, apply, cross, difference_of_angles, dot, transposed, triple
from assur.numerics.vectors import add as add_vectors
from assur.numerics.vectors import scaled as scaled_vector
from assur.numerics.vectors import subtract as subtract_vectors

Number = Any
Quadric = tuple[Polynomial, Polynomial, Polynomial, Polynomial, Polynomial, Polynomial]
"""Factors of x^2, x y, y^2, x, y and 1, polynomials in t of degrees 0, 0, 0, 1, 1, 2; it is where the sum is zero."""
Form = tuple[Number, Vector]
"""k and f of k + f . w, where w are three coordinates."""
Pair = tuple[Number, Number]
CircleForm = tuple[Number, Sequence[Pair]]
"""k and, for each of three angles, factors of its cosine and its sine."""
Minors = Mapping[tuple[int, ...], Polynomial]
"""Three columns of three quadrics or forms -> their determinant."""


STEPS = 2
DAMPING = 1e-12
"""Keeps a step of least squares calm at a double root."""
ASKEW = ((6 / 7, 2 / 7, 3 / 7), (2 / 7, 3 / 7, -6 / 7), (3 / 7, -6 / 7, -2 / 7))
"""Orthonormal rows t, x, y, askew to the usual planes of symmetry: solutions that mirror each other differ in t."""


def sum_of_squares(forms: Sequence[Form]) -> Quadric:
    """The quadric on which the squares of forms k + f . w in three coordinates add up to 1, in the askew ones.

    Example: the unit sphere, which is one in any orthonormal coordinates.

    >>> axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    >>> [tuple(round(part, 9) + 0.0 for part in own) for own in sum_of_squares([(0, axis) for axis in axes])]
    [(1.0,), (0.0,), (1.0,), (0.0, 0.0), (0.0, 0.0), (-1.0, 0.0, 1.0)]
    """
    total: Quadric = ((0,), (0,), (0,), (0,), (0,), (-1,))
    for constant, factors in forms:
        by_t, u, v = apply(ASKEW, factors)
        far = (constant, by_t)
        xx, xy, yy, x, y, one = total
        total = (
            add(xx, (u * u,)),
            add(xy, (2 * u * v,)),
            add(yy, (v * v,)),
            add(x, scaled(far, 2 * u)),
            add(y, scaled(far, 2 * v)),
            add(one, multiply(far, far)),
        )
    return total


def nearer(sums: Sequence[Sequence[Form]], point: Vector) -> Vector:
    """A point after two damped steps of least squares towards three such quadrics, for what rounding left.

    >>> axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    >>> [round(part, 9) for part in nearer([[(0, axis)] for axis in axes], (1.001, -0.999, 1.0))]
    [1.0, -1.0, 1.0]
    """
    for _ in range(STEPS):
        places = [[(constant + dot(factors, point), factors) for constant, factors in forms] for forms in sums]
        rows = [_sum([scaled_vector(factors, place) for place, factors in own]) for own in places]
        missing = [(sum(place * place for place, _ in own) - 1) / 2 for own in places]
        point = subtract_vectors(point, _step(rows, missing))
    return point


def nearer_angles(sums: Sequence[tuple[Number, Sequence[CircleForm]]], angles: Sequence[Pair]) -> tuple[Pair, ...]:
    """Cosines and sines of three angles after two such steps towards three sums of squares in these.

    Args:
        sums: of each what it is to be, and the forms k + f . (cosine, sine) + ... of the three angles.
        angles: nearly.

    >>> axes = [[(int(k == own),) * 2 for k in range(3)] for own in range(3)]
    >>> [round(part, 9) + 0.0 for part in nearer_angles([(1, [(0, own)]) for own in axes], [(1, 1e-3)] * 3)[0]]
    [1.0, 0.0]
    """
    for _ in range(STEPS):
        angles = [(c * (3 - c * c - s * s) / 2, s * (3 - c * c - s * s) / 2) for c, s in angles]  # squares add up to 1
        rows, missing = [], []
        for total, forms in sums:
            places = [constant + sum(map(_along, factors, angles)) for constant, factors in forms]
            slopes = [tuple(map(_across, factors, angles)) for _, factors in forms]
            whole = _sum([scaled_vector(slope, place) for slope, place in zip(slopes, places, strict=True)])
            rows.append(scaled_vector(whole, 1 / total))
            missing.append((sum(place * place for place in places) / total - 1) / 2)
        angles = [*map(difference_of_angles, angles, map(_small, _step(rows, missing)))]
    return tuple(angles)


def _along(factors: Pair, angle: Pair) -> Number:
    return factors[0] * angle[0] + factors[1] * angle[1]


def _across(factors: Pair, angle: Pair) -> Number:
    return factors[1] * angle[0] - factors[0] * angle[1]


def _small(turn: Number) -> Pair:
    """An angle that is near zero: twice the one that has half of it as its tangent."""
    square = turn * turn / 4
    return ((1 - square) / (1 + square), turn / (1 + square))


def _step(rows: Sequence[Vector], missing: Sequence[Number]) -> Vector:
    """By which three linear forms are to change, by damped least squares."""
    one, two, three = rows
    (a, b, c), (_, d, e), (_, _, f) = (
        tuple(dot(row, other) + DAMPING * (i == k) for k, other in enumerate(rows)) for i, row in enumerate(rows)
    )
    adjugate = ((d * f - e * e, c * e - b * f, b * e - c * d), (c * e - b * f, a * f - c * c, b * c - a * e),
                (b * e - c * d, b * c - a * e, a * d - b * b))  # fmt: skip
    # the determinant of the damped products of the rows, as squares: never zero
    volume, lengths = triple(one, two, three), sum(dot(row, row) for row in rows)
    areas = sum(dot(area, area) for area in (cross(one, two), cross(two, three), cross(one, three)))
    determinant = volume * volume + DAMPING * (areas + DAMPING * (lengths + DAMPING))
    weights = scaled_vector(apply(adjugate, (missing[0], missing[1], missing[2])), 1 / determinant)
    return apply(transposed((one, two, three)), weights)


def _sum(vectors: Sequence[Vector]) -> Vector:
    total: Vector = (0, 0, 0)
    for own in vectors:
        total = add_vectors(total, own)
    return total


def eliminant(quadrics: tuple[Quadric, Quadric, Quadric]) -> tuple[Number, ...]:
    """Coefficients (9) of the polynomial in t whose roots are the coordinates t of the common points.

    Example: x^2 = 1, y^2 = 4 and x y = t^2 - 2 give t^4 (t^2 - 4)^2, up to the sign.

    >>> first, second = ((1,), (0,), (0,), (0,), (0,), (-1,)), ((0,), (0,), (1,), (0,), (0,), (-4,))
    >>> third = ((0,), (1,), (0,), (0,), (0,), (2, 0, -1))
    >>> eliminant((first, second, third))
    (0, 0, 0, 0, -16, 0, 8, 0, -1)
    """
    minors = _minors(quadrics)
    lower = _minors(_forms(minors))
    total: tuple[Number, ...] = ()
    for columns, minor in minors.items():
        others = tuple(k for k in range(6) if k not in columns)
        total = add(total, scaled(multiply(minor, lower[others]), _sense((*columns, *others))))
    return total


def other_two(quadrics: tuple[Quadric, Quadric, Quadric], t: Number) -> tuple[Number, Number, Number]:
    """The coordinates x and y of the point at a root t, and a square that vanishes where two points share it.

    The vector (x^2, x y, y^2, x, y, 1) is across all six equations. Any five, three quadrics and two forms, give a
    multiple of it; the three multiples are taken together, and the square is that of their last parts, free of scale.
    """
    here = tuple(tuple((_value(part, t),) for part in quadric) for quadric in quadrics)
    minors = _minors(here)
    forms = _forms(minors)
    x: Number = 0
    y: Number = 0
    one: Number = 0
    for pair in itertools.combinations(forms, 2):
        along_x, along_y, along_one = (_left_out(place, minors, *pair) for place in (3, 4, 5))
        x, y, one = x + along_x * along_one, y + along_y * along_one, one + along_one * along_one
    size = sum(minor[0] * minor[0] for minor in minors.values())
    return x / one, y / one, one / (size * size * size)


def _left_out(place: int, minors: Minors, first: Sequence[Polynomial], second: Sequence[Polynomial]) -> Number:
    """The determinant of three quadrics and two forms without one column, at one t."""
    total: Number = 0
    for columns, minor in minors.items():
        if place not in columns:
            i, j = (k for k in range(6) if k != place and k not in columns)
            pair = first[i][0] * second[j][0] - first[j][0] * second[i][0]
            total = total + _sense((*columns, place, i, j)) * minor[0] * pair
    return total


def _forms(minors: Minors) -> tuple[Sequence[Polynomial], ...]:
    """Sylvester's forms, with x^2, y^2 and 1^2 split off."""
    m, none = minors, (0,)
    return (
        (m[0, 1, 3], m[0, 2, 3], none, subtract(m[0, 1, 5], m[0, 3, 4]), m[0, 2, 5], m[0, 4, 5]),
        (none, m[0, 2, 4], m[1, 2, 4], m[0, 2, 5], subtract(m[1, 2, 5], m[2, 3, 4]), scaled(m[2, 3, 5], -1)),
        (none, m[0, 2, 5], m[1, 2, 5], m[0, 4, 5], subtract(m[1, 4, 5], m[2, 3, 5]), m[3, 4, 5]),
    )


def _minors(rows: Sequence[Sequence[Polynomial]]) -> Minors:
    first, second, third = rows
    pairs = {
        (i, j): subtract(multiply(second[i], third[j]), multiply(second[j], third[i]))
        for i, j in itertools.combinations(range(6), 2)
    }
    return {
        (i, j, k): add(
            subtract(multiply(first[i], pairs[j, k]), multiply(first[j], pairs[i, k])), multiply(first[k], pairs[i, j])
        )
        for i, j, k in itertools.combinations(range(6), 3)
    }


def _sense(order: Sequence[int]) -> int:
    """Of a permutation: 1 if it is even, -1 if it is odd."""
    crossed = sum(first > second for first, second in itertools.combinations(order, 2))
    return -1 if crossed % 2 else 1


def _value(polynomial: Polynomial, t: Number) -> Number:
    total: Number = 0
    for coefficient in reversed(polynomial):
        total = total * t + coefficient
    return total
