"""Where circles, spheres and lines meet: the steps of which closed forms are made, over any number type.

Each takes the namespace `ns` first (see `assur.numerics.number_types`) and a sign that chooses between two
answers; the radicand that decides whether there is one is returned with the answer, as a margin.
"""

from __future__ import annotations

from typing import Any

from assur.numerics.vectors import Number, Pair, Vector, add, cross, dot, scaled, subtract

TINY = 1e-30
"""What a line through centres that all coincide is taken along Z by: beside any other length it is nothing."""
FLOOR = 1e-90
"""Of squares that are never zero where the centres are as they should be: by it nobody has to take that on trust."""
MANY = 1e9
"""Makes a distance between centres that is not zero count for more than any radius."""


def angle_with(ns: Any, a: Number, b: Number, c: Number, sign: Number) -> tuple[Pair, Number]:
    """The angle with a cos + b sin = c as (cosine, sine), and the radicand a^2 + b^2 - c^2.

    The two angles lie on either side of the direction (a, b): `sign` is that of a sin - b cos.

    >>> from assur.numerics.number_types import Floats
    >>> angle_with(Floats(), 2.0, 0.0, 1.0, -1.0)[1]
    3.0
    """
    square = a * a + b * b
    radicand = square - c * c
    root = sign * ns.sqrt(radicand)
    return ((a * c - b * root) / square, (b * c + a * root) / square), radicand


def three_spheres(
    ns: Any, centres: tuple[Vector, Vector, Vector], squares: tuple[Number, Number, Number], sign: Number
) -> tuple[Vector, Number, Number]:
    """The point at given distances from three centres, the radicand, and the normal's square.

    Args:
        ns: the namespace of the kernel.
        centres: three points; where they are in one line the normal's square is zero and there is no single answer.
        squares: squares of the radii.
        sign: that of (point - first centre) . n, with n = (second - first) x (third - first).

    Returns:
        The point; the radicand: n^2 times the square of the point's height over the plane of the centres; n^2.

    Example:
        >>> from assur.numerics.number_types import Floats
        >>> centres = ((0, 0, 0), (2, 0, 0), (0, 2, 0))
        >>> point, radicand, square = three_spheres(Floats(), centres, (3, 3, 3), 1)
        >>> [float(part) for part in point], radicand, square
        ([1.0, 1.0, 1.0], 16.0, 16)
    """
    first, second, third = centres
    u, v = subtract(second, first), subtract(third, first)
    normal = cross(u, v)
    square = dot(normal, normal)
    along = (dot(u, u) + squares[0] - squares[1]) / 2
    across = (dot(v, v) + squares[0] - squares[2]) / 2
    # the foot of the point in the plane of the centres, from u . f = along, v . f = across
    foot = scaled(add(scaled(cross(v, normal), along), scaled(cross(normal, u), across)), 1 / square)
    radicand = (squares[0] - dot(foot, foot)) * square
    height = sign * ns.sqrt(radicand) / square
    return add(first, add(foot, scaled(normal, height))), radicand, square


def coincident_spheres(
    ns: Any, centres: tuple[Vector, Vector, Vector], square: Number, across: Vector, turn: Pair
) -> tuple[Vector, Number]:
    """A point at one distance from three centres in one line: it runs on a circle where two of them coincide.

    Args:
        ns: the namespace of the kernel.
        centres: three points in one line, two of them the same. Where all are, the point is free on a sphere, and the
            circle is the one about Z.
        square: square of the radius.
        across: a vector that is parallel neither to the line through the centres nor to Z.
        turn: (cosine, sine) of the angle along the circle.

    Returns:
        The point; the radicand: the square of the circle's radius. It is negative too where the centres are all apart,
        because no point has the same distance from three points of a line.

    Example:
        >>> from assur.numerics.number_types import Floats
        >>> centres = ((0, 0, 0), (0, 0, 2), (0, 0, 0))
        >>> point, radicand = coincident_spheres(Floats(), centres, 10, (1, 0, 0), (1, 0))
        >>> [float(part) + 0.0 for part in point], float(radicand)
        ([0.0, 3.0, 1.0], 9.0)
    """
    first, second, third = centres
    u, v = subtract(second, first), subtract(third, first)
    w = subtract(u, v)
    # one of u, v, w is zero, so u + v is not, unless all are; and (point - first) . u = u^2 / 2, the same for v
    axis = add(add(u, v), (0, 0, TINY * ns.sqrt(square)))
    along = dot(axis, axis) + FLOOR * square
    first_gap, second_gap, third_gap = dot(u, u), dot(v, v), dot(w, w)  # two are equal and one is zero
    foot = scaled(axis, (first_gap + second_gap) / (2 * along))
    apart = first_gap * second_gap * third_gap / (square * square)
    radicand = square - (first_gap + second_gap + third_gap) / 8 - MANY * apart
    level = cross(axis, across)
    width = dot(level, level) + FLOOR * square
    right = scaled(level, turn[0] * ns.sqrt(radicand) / ns.sqrt(width))
    up = scaled(cross(axis, level), turn[1] * ns.sqrt(radicand) / (ns.sqrt(along) * ns.sqrt(width)))
    return add(add(first, foot), add(right, up)), radicand


def linear_in_three(rows: tuple[Vector, Vector, Vector], right: Vector) -> tuple[Vector, Number]:
    """The vector x with rows x = right, by Cramer's rule, and the determinant; no answer where that is zero.

    >>> linear_in_three(((2, 0, 0), (0, 4, 0), (0, 0, 1)), (2, 2, 3))[0]
    (1.0, 0.5, 3.0)
    """
    a, b, c = rows
    bc, ca, ab = cross(b, c), cross(c, a), cross(a, b)
    determinant = dot(a, bc)
    total = add(add(scaled(bc, right[0]), scaled(ca, right[1])), scaled(ab, right[2]))
    return (total[0] / determinant, total[1] / determinant, total[2] / determinant), determinant
