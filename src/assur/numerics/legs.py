"""Legs that stand round the Z axis, and what a rod or a pair of bars in a leg does, over any number type.

A leg is placed by a turn about Z, (cosine, sine). In its own frame it points outwards along X; Y is around, Z up.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from assur.numerics.meetings import angle_with
from assur.numerics.vectors import Number, Pair, Vector, difference_of_angles, triple


def thirds(ns: Any) -> tuple[Pair, Pair, Pair]:
    """The turns of three legs a third of a turn apart: 0, 120 and 240 deg.

    >>> from assur.numerics.number_types import Floats
    >>> [round(float(cosine), 3) for cosine, _ in thirds(Floats())]
    [1.0, -0.5, -0.5]
    """
    half, sine = ns.sqrt(1) / 2, ns.sqrt(3) / 2
    return ((1, 0), (-half, sine), (-half, -sine))


def from_leg(turn: Pair, a: Vector) -> Vector:
    """A vector of a leg's frame, in the base's.

    >>> from_leg((0, 1), (2, 0, 5))
    (0, 2, 5)
    """
    cosine, sine = turn
    return (cosine * a[0] - sine * a[1], sine * a[0] + cosine * a[1], a[2])


def in_leg(turn: Pair, a: Vector) -> Vector:
    """A vector of the base's frame, in a leg's.

    >>> in_leg((0, 1), (0, 2, 5))
    (2, 0, 5)
    """
    cosine, sine = turn
    return (cosine * a[0] + sine * a[1], cosine * a[1] - sine * a[0], a[2])


def pointing(ns: Any, ahead: Number, beside: Number, along: Number, nothing: Number = 0) -> tuple[Pair, Pair, Number]:
    """The two angles of a universal joint that points a rod, and the square of the rod's part across the first axis.

    Args:
        ns: the namespace of the kernel.
        ahead: component of the rod's unit vector where both angles are zero.
        beside: component towards which the first angle turns it.
        along: component along the first axis, towards which the second angle, of -90 to 90 deg, then tilts it.
        nothing: added to both sides of the first quotients; a tiny number makes the first angle zero where the rod
            lies along the first axis, instead of 0/0.

    Returns:
        First angle and second angle as (cosine, sine); the square of the second's cosine.

    >>> from assur.numerics.number_types import Floats
    >>> first, second, square = pointing(Floats(), 0.0, 0.6, 0.8)
    >>> [round(float(part), 9) for part in (*first, *second, square)]
    [0.0, 1.0, 0.6, 0.8, 0.36]
    """
    square = ahead * ahead + beside * beside
    across = ns.sqrt(square)
    return ((ahead + nothing) / (across + nothing), beside / (across + nothing)), (across, along), square


class TwoBars(NamedTuple):
    """A crank about the origin of a plane and a rod from its end; directions and the angle between as pairs.

    Attributes:
        crank, rod: directions (cosine, sine).
        elbow: the rod's angle from the crank; its sine has the sign that was asked for.
        square: of the reach; zero where the end lies on the crank's axis, and the crank has no direction.
        radicand: negative where the end is out of reach.
    """

    crank: Pair
    rod: Pair
    elbow: Pair
    square: Number
    radicand: Number


def two_bars(ns: Any, end: Pair, crank: Number, rod: Number, sign: Number) -> TwoBars:
    """A crank and a rod of given lengths that reach a point of their plane: the meeting of two circles.

    >>> from assur.numerics.number_types import Floats
    >>> found = two_bars(Floats(), (3.0, 4.0), 3.0, 4.0, 1.0)
    >>> [float(part) for part in (*found.crank, *found.rod, *found.elbow)]
    [1.0, 0.0, 0.0, 1.0, 0.0, 1.0]
    """
    square = end[0] * end[0] + end[1] * end[1]
    turn, radicand = angle_with(ns, *end, (square + crank * crank - rod * rod) / (2 * crank), -sign)
    direction = ((end[0] - crank * turn[0]) / rod, (end[1] - crank * turn[1]) / rod)
    return TwoBars(turn, direction, difference_of_angles(direction, turn), square, radicand)


def couples(turns: tuple[Pair, Pair, Pair], rods: tuple[Vector, Vector, Vector]) -> Number:
    """Volume that three couples span, each across the Y axis of a leg and its rods.

    A pair of equal, parallel rods, one beside the other along Y, keeps the platform from turning by such a couple;
    three of them keep it from all turning unless this is zero.

    >>> one, out = (1, 0), (0, 0, -1)
    >>> couples((one, one, one), (out, out, out))
    0
    """
    one, two, three = (
        (cosine * rod[2], sine * rod[2], -(cosine * rod[0] + sine * rod[1]))  # (0, 1, 0) x rod, in the base's frame
        for (cosine, sine), rod in zip(turns, rods, strict=True)
    )
    return triple(one, two, three)
