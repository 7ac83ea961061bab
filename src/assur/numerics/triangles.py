"""A triangle in a plane whose corners lie on three circles: one polynomial of degree six, over any number type.

With w_i = R b_i - a_i, seen from centre 1 and corner 1, corner i is on its circle where |p + w_i|^2 = r_i^2, and
corner 1 where |p|^2 = r_1^2. The differences are linear, w_i . p = k_i; put into |p|^2 = r_1^2 they leave

    k2^2 |w3|^2 - 2 k2 k3 w2.w3 + k3^2 |w2|^2 = r_1^2 (w2 x w3)^2.

Each of k2, k3, |w2|^2, w2.w3, |w3|^2 and w2 x w3 is linear in the cosine and the sine of the triangle's angle: the
equation has degree three in them, and six in the tangent of half the angle.
"""

from __future__ import annotations

from assur.numerics.polynomials import add, half_angle, multiply, scaled, subtract
from assur.numerics.vectors import Number, Pair

Points = tuple[Pair, Pair, Pair]
Terms = dict[tuple[int, int], Number]


def polynomial(centres: Points, corners: Points, squares: tuple[Number, Number, Number]) -> tuple[Number, ...]:
    """Seven coefficients, constant term first, of the polynomial in tan(angle/2).

    Args:
        centres: of the circles, in the fixed frame.
        corners: of the triangle, in its own frame.
        squares: of the radii.

    Example: a triangle that fits without being turned, so that zero is a root.

    >>> polynomial(((0, 0), (3, 0), (0, 5)), ((0, 0), (1, 0), (1, 2)), (1, 5, 5))[0]
    0.0
    """
    k2, k3, w22, w23, w33, area = (half_angle(terms, 1) for terms in _parts(centres, corners, squares))
    left = add(multiply(multiply(k2, k2), w33), multiply(multiply(k3, k3), w22))
    left = subtract(left, scaled(multiply(multiply(k2, k3), w23), 2))
    return subtract(left, multiply(scaled(multiply(area, area), squares[0]), (1, 0, 1)))


def position(
    centres: Points, corners: Points, squares: tuple[Number, Number, Number], turn: Pair
) -> tuple[Pair, Number]:
    """Where the origin of the triangle's frame is at an angle (cosine, sine), and w2 x w3; no answer where that is 0.

    >>> position(((0, 0), (3, 0), (0, 5)), ((0, 0), (1, 0), (1, 2)), (1, 5, 5), (1, 0))
    ((0.0, 1.0), 6)
    """
    k2, k3, _, _, _, area = (
        terms[0, 0] + terms[1, 0] * turn[0] + terms[0, 1] * turn[1] for terms in _parts(centres, corners, squares)
    )
    turned = tuple(rotated(corner, turn) for corner in corners)
    (x2, y2), (x3, y3) = (_less(_less(turned[k], turned[0]), _less(centres[k], centres[0])) for k in (1, 2))
    first = ((k2 * y3 - k3 * y2) / area, (k3 * x2 - k2 * x3) / area)
    return (centres[0][0] + first[0] - turned[0][0], centres[0][1] + first[1] - turned[0][1]), area


def rotated(vector: Pair, turn: Pair) -> Pair:
    """A vector turned by an angle (cosine, sine).

    >>> rotated((1, 2), (0, 1))
    (-2, 1)
    """
    return (turn[0] * vector[0] - turn[1] * vector[1], turn[1] * vector[0] + turn[0] * vector[1])


def lines(directions: Points, through: Points) -> Number:
    """Determinant of three lines: zero where they meet in a point or are parallel.

    >>> lines(((1, 0), (0, 1), (1, 1)), ((0, 5), (7, 0), (7, 5)))
    0
    """
    d1, d2, d3 = directions
    m2, m3 = (cross(_less(through[k], through[0]), directions[k]) for k in (1, 2))
    return m3 * cross(d1, d2) - m2 * cross(d1, d3)


def cross(first: Pair, second: Pair) -> Number:
    """Cross product in the plane.

    >>> cross((1, 0), (0, 1))
    1
    """
    return first[0] * second[1] - first[1] * second[0]


def _less(first: Pair, second: Pair) -> Pair:
    return (first[0] - second[0], first[1] - second[1])


def _parts(centres: Points, corners: Points, squares: tuple[Number, Number, Number]) -> tuple[Terms, ...]:
    """k2, k3, |w2|^2, w2.w3, |w3|^2 and w2 x w3, each as {(power of cosine, power of sine): factor}."""
    a2, a3 = (_less(centres[k], centres[0]) for k in (1, 2))
    b2, b3 = (_less(corners[k], corners[0]) for k in (1, 2))
    w22, w23, w33 = _product(a2, b2, a2, b2), _product(a2, b2, a3, b3), _product(a3, b3, a3, b3)
    # w2 x w3 = w2 . w3 with w3 turned back by a right angle
    area = _product(a2, b2, (a3[1], -a3[0]), (b3[1], -b3[0]))
    return _known(w22, squares[1] - squares[0]), _known(w33, squares[2] - squares[0]), w22, w23, w33, area


def _product(a: Pair, b: Pair, c: Pair, d: Pair) -> Terms:
    """(R b - a) . (R d - c)."""
    return {
        (0, 0): a[0] * c[0] + a[1] * c[1] + b[0] * d[0] + b[1] * d[1],
        (1, 0): -(a[0] * d[0] + a[1] * d[1]) - (b[0] * c[0] + b[1] * c[1]),
        (0, 1): a[0] * d[1] - a[1] * d[0] + b[1] * c[0] - b[0] * c[1],
    }


def _known(square: Terms, difference: Number) -> Terms:
    """k_i = (r_i^2 - r_1^2 - |w_i|^2) / 2."""
    constant, cosine, sine = square[0, 0], square[1, 0], square[0, 1]
    return {(0, 0): (difference - constant) / 2, (1, 0): -cosine / 2, (0, 1): -sine / 2}
