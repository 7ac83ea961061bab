"""What is unknown of links that turn: cosine and sine of an angle, a rod's direction, vectors along sides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import sympy

from assur.derivation.ball_triangles import SIDES, BallTriangle

ONE = sympy.Integer(1)


@dataclass(frozen=True)
class UnknownDirection:
    """What is unknown of a link: cosine and sine of an angle, the components of a rod's direction, or of a vector.

    Attributes:
        kind: "circle", "rod", "side" of a triangle of balls, or "stroke", a vector whose length is unknown too.
        name: by which its angle is called.
        unknowns: its symbols.
        links: whose orientation it says.
        square: of its length.
    """

    kind: Literal["circle", "rod", "side", "stroke"]
    name: str
    unknowns: tuple[sympy.Symbol, ...]
    links: tuple[str, ...]
    square: sympy.Expr = ONE

    @property
    def quadric(self) -> sympy.Expr:
        """What vanishes of its own accord: the sum of squares less that of its length."""
        return sum(unknown**2 for unknown in self.unknowns) - self.square

    @property
    def freedoms(self) -> int:
        """How many linear equations determine it, but for a choice of two."""
        return len(self.unknowns) - (self.kind != "stroke")


def sides_of(triangle: BallTriangle, links: Sequence[str]) -> tuple[UnknownDirection, ...]:
    """The sides of a triangle as unknowns, called by the link and the numbers of both corners."""
    name = links[0].replace(".", "_")
    unknowns = (tuple(sympy.Symbol(f"d{k}_{name}_{ends}", real=True) for k in "xyz") for ends in SIDES)
    every = zip(SIDES, unknowns, triangle.squares, strict=True)
    return tuple(UnknownDirection("side", f"{name}_{ends}", own, tuple(links), square) for ends, own, square in every)
