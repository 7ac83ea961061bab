"""Links that three ball joints hold and nothing else: the sides of the triangle of these say how such a link turns.

Three vectors d12, d23, d31 from ball to ball add up to zero and keep their lengths. Whatever vectors do that, one
rotation takes the triangle to them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from assur.derivation.hinges import point_on
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.symbols import GivenSymbols
from assur.numerics.vectors import Matrix, Vector, apply, cross, dot, subtract

CORNERS = 3
SIDES = ("12", "23", "31")
"""Corners between which the sides of a triangle are."""


@dataclass(frozen=True)
class BallTriangle:
    """Three balls of a body.

    Attributes:
        number: of the triangle.
        corners: their points, in the body's frame.
        joints: their names.
    """

    number: int
    corners: Matrix
    joints: tuple[str, ...]

    @property
    def sides(self) -> Matrix:
        """From the first to the second, from that to the third, and back, in the body's frame."""
        a, b, c = self.corners
        return subtract(b, a), subtract(c, b), subtract(a, c)

    def ends(self, side: str) -> tuple[str, str]:
        """The joints from which and to which a side is, by the numbers of its corners."""
        first, last = (self.joints[int(corner) - 1] for corner in side)
        return first, last

    @property
    def squares(self) -> tuple[sympy.Expr, ...]:
        """Of the lengths of the sides."""
        return tuple(sympy.expand(dot(side, side)) for side in self.sides)

    def beside(self, vector: Vector) -> sympy.Expr:
        """Of the first side across the last in a vector, all in the body's frame."""
        first, _, last = self.sides
        normal = cross(first, last)
        return sympy.simplify(dot(normal, vector) / sympy.expand(dot(normal, normal)))

    def shares(self, vector: Vector) -> tuple[sympy.Expr, sympy.Expr]:
        """Of the first and of the last side in a vector, both in the body's frame."""
        u, _, w = self.sides
        uu, uw, ww, uv, wv = (dot(a, b) for a, b in ((u, u), (u, w), (w, w), (u, vector), (w, vector)))
        size = sympy.expand(uu * ww - uw * uw)
        first = sympy.simplify((uv * ww - wv * uw) / size)
        last = sympy.simplify((wv * uu - uv * uw) / size)
        return first, last


def ball_triangles(
    symbols: GivenSymbols, bodies: Mapping[str, tuple[str, Matrix]], oriented: Mapping[str, object]
) -> dict[str, BallTriangle]:
    """Body -> its triangle, of those that three ball joints hold and whose orientation nothing else says.

    Errors:
        NotDerivedError: three balls on one line.
    """
    record = symbols.record
    triangles: dict[str, BallTriangle] = {}
    for body in dict.fromkeys(own for link, (own, _) in bodies.items() if link in record.links):
        inside = {link: turn for link, (own, turn) in bodies.items() if own == body and link in record.links}
        joints = [own for own in record.joints.values() if (own.parent in inside) != (own.child in inside)]
        if inside.keys() & oriented.keys() or len(joints) != CORNERS or not all(own.type.ball for own in joints):
            continue
        ends = [(own, own.parent if own.parent in inside else own.child) for own in joints]
        if len({link for _, link in ends}) > 1:
            continue
        a, b, c = (apply(inside[link], point_on(symbols, own, link)) for own, link in ends)
        triangle = BallTriangle(len(triangles), (a, b, c), tuple(own.name for own in joints))
        first, _, last = triangle.sides
        if symbols.witness.is_zero(dot(first, first) * dot(last, last) - dot(first, last) ** 2):
            raise NotDerivedError(f"{', '.join(triangle.joints)} of {body} are on one line")
        triangles[body] = triangle
    return triangles
