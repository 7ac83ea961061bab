"""Vectors that are fixed in links, in the base, by what is unknown of how these turn."""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal

import sympy

from assur.derivation.ball_triangles import BallTriangle
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import LinkOrientations, Orientation
from assur.derivation.symbols import GivenSymbols
from assur.derivation.unknown_directions import UnknownDirection, sides_of
from assur.joints.steps import UNTURNED
from assur.numerics.vectors import Vector, add, apply, cross, dot, scaled, subtract


class CarriedVectors:
    """What is unknown of each link, by the numbers of circles, rods and triangles, and vectors by it."""

    def __init__(self, symbols: GivenSymbols, placed: LinkOrientations) -> None:
        self.symbols, self.placed = symbols, placed
        self.circles = {k: self._unknown_direction("circle", links) for k, links in self._numbered("circle").items()}
        self.rods = {k: self._unknown_direction("rod", links) for k, links in self._numbered("rod").items()}
        self.sides = {own.number: sides_of(own, links) for own, links in self._triangles().items()}

    def vector(self, link: str, vector: Vector) -> Vector:
        """A vector fixed in a link, in the base."""
        own = self.placed.links[link]
        turned = apply(own.constant, vector) if own.constant is not UNTURNED else vector
        if own.rod is not None:
            return self._along(link, own, turned)
        if own.triangle is not None:
            return self._in_triangle(link, own.triangle, turned)
        return self._turned(own, turned)

    def _in_triangle(self, link: str, triangle: BallTriangle, vector: Vector) -> Vector:
        if not self.symbols.witness.is_zero(triangle.beside(vector)):
            raise NotDerivedError(f"{link} has a joint beside the plane of {', '.join(triangle.joints)}")
        return self.of_sides(triangle, vector)

    def of_sides(self, triangle: BallTriangle, vector: Vector) -> Vector:
        """What a vector has of the first and of the last side."""
        first, last = triangle.shares(vector)
        (a, b, c), _, (x, y, z) = (own.unknowns for own in self.sides[triangle.number])
        return add(scaled((a, b, c), first), scaled((x, y, z), last))

    def _turned(self, own: Orientation, turned: Vector) -> Vector:
        """A vector that turns on a circle, if there is one, or on one that turns on another."""
        if own.axis is None or own.circle is None:
            return turned
        parts = [(sympy.Integer(1), turned)]
        if own.second is not None and own.hinge is not None:
            parts = self._about(own.hinge, own.second, turned)
        whole: Vector = (0, 0, 0)
        for factor, part in parts:
            for share, vector in self._about(own.axis, own.circle, part):
                whole = add(whole, scaled(vector, factor * share))
        return whole

    def _about(self, axis: Vector, circle: int, turned: Vector) -> list[tuple[sympy.Expr, Vector]]:
        """Vectors of which a turned one is the sum, by 1, the cosine and the sine."""
        cosine, sine = self.circles[circle].unknowns
        along = self.short(axis, self.tidied(scaled(axis, dot(axis, turned))))
        across = self.short(axis, self.tidied(subtract(turned, along)))
        beside = self.short(axis, self.tidied(cross(axis, across)))
        return [(sympy.Integer(1), along), (cosine, across), (sine, beside)]

    def leanings(self, used: Collection[UnknownDirection]) -> list[sympy.Expr]:
        """What vanishes as rods lean on their hinges as they do, where used directions say how both turn."""
        return [
            dot(self.rods[own.rod].unknowns, self._turned(own, own.hinge)) - dot(own.line, own.hinge)
            for own in dict.fromkeys(self.placed.links.values())
            if own.rod is not None and own.line is not None and own.hinge is not None and own.circle is not None
            if {self.rods[own.rod], self.circles.get(own.circle)} <= {*used}
        ]

    def short(self, axis: Vector, vector: Vector) -> Vector:
        """A vector by names, where it turns about an axis that what is given turns."""
        return self.placed.named.vector(vector) if any(map(self.placed.named.turned, axis)) else vector

    def _along(self, link: str, own: Orientation, vector: Vector) -> Vector:
        line, hinge, is_zero = own.line or (0, 0, 0), own.hinge or (0, 0, 0), self.symbols.witness.is_zero
        across = is_zero(dot(line, hinge))
        share, beside = dot(line, vector), dot(hinge, vector) if across else 0
        in_plane = add(scaled(line, share), scaled(hinge, beside))
        if not all(map(is_zero, subtract(vector, in_plane))):
            raise NotDerivedError(f"{link} is no straight rod")
        ex, ey, ez = self.rods[own.rod or 0].unknowns
        along = scaled((ex, ey, ez), sympy.simplify(share))
        return along if is_zero(beside) else add(along, scaled(self._turned(own, hinge), beside))

    def tidied(self, vector: Vector) -> Vector:
        """A vector with 0 for what vanishes, multiplied out."""
        x, y, z = (0 if self.symbols.witness.is_zero(part) else sympy.expand(part) for part in vector)
        return x, y, z

    def _numbered(self, kind: Literal["circle", "rod"]) -> dict[int, list[str]]:
        numbered: dict[int, list[str]] = {}
        for link, own in self.placed.links.items():
            circle = own.circle if own.second is None else own.second
            number = own.rod if kind == "rod" else circle if own.rod is None else None
            if number is not None:
                numbered.setdefault(number, []).append(link)
        return numbered

    def _unknown_direction(self, kind: Literal["circle", "rod"], links: list[str]) -> UnknownDirection:
        name = next((link for link in links if "'" not in link), links[0]).replace(".", "_").replace("'s cross", "")
        prefixes = ("cos", "sin") if kind == "circle" else ("ex", "ey", "ez")
        return UnknownDirection(
            kind, name, tuple(sympy.Symbol(f"{k}_{name}", real=True) for k in prefixes), tuple(links)
        )

    def _triangles(self) -> dict[BallTriangle, list[str]]:
        links: dict[BallTriangle, list[str]] = {}
        for link, own in self.placed.links.items():
            if own.triangle is not None:
                links.setdefault(own.triangle, []).append(link)
        return links
