"""Unknowns of the loops that belong together, such as a point on a circle, and the quadratic equations they satisfy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

COLUMNS = {"circle": 2, "slider": 2, "rod": 3, "ball": 3, "triangle": 6}


@dataclass(frozen=True)
class UnknownGroup:
    """Unknowns that belong together, in columns from `first` on.

    Attributes:
        kind: "circle" (z, z~), "slider" (s z, s z~), "rod" (k z, k z~, sin phi), "ball" (a direction's components) or
            "triangle" (those of the vectors from its first corner to the second and the third).
        circle: the column of its circle's z; of its own where it is one.
        name, index: of the slider's joint, and of its length among the joint values.
        alone: a rod whose circle occurs nowhere else: a point on a sphere.
        sides: the squares of a triangle's sides: 12, 13, 23.
    """

    kind: Literal["circle", "slider", "rod", "ball", "triangle"]
    first: int
    circle: int
    name: str = ""
    alone: bool = False
    sides: tuple[float, ...] = ()
    index: int = -1

    @property
    def columns(self) -> tuple[int, ...]:
        """Its columns."""
        return tuple(range(self.first, self.first + COLUMNS[self.kind]))

    @property
    def quadratic(self) -> tuple[tuple[tuple[float, int, int], ...], ...]:
        """Its quadratic equations: sums of factor times column times column; column 0 is the constant 1."""
        z, other, first, second = self.circle, self.circle + 1, self.first, self.first + 1
        joined = ((1.0, first, other), (-1.0, z, second))
        if self.kind == "circle":
            return (((1.0, z, other), (-1.0, 0, 0)),)
        if self.kind == "slider":
            return (joined,)
        if self.kind == "ball":
            return ((*((1.0, column, column) for column in self.columns), (-1.0, 0, 0)),)
        if self.kind == "triangle":
            return tuple((*terms, (-side, 0, 0)) for terms, side in zip(_sides(self.columns), self.sides, strict=True))
        sphere = ((1.0, first, second), (1.0, first + 2, first + 2), (-1.0, 0, 0))
        return (sphere,) if self.alone else (sphere, joined)

    @property
    def freedoms(self) -> int:
        """How many linear equations determine it."""
        return len(self.columns) - len(self.quadratic)


def _sides(columns: tuple[int, ...]) -> tuple[tuple[tuple[float, int, int], ...], ...]:
    """The squares of vectors p and q and of p - q, whose components are in six columns."""
    p, q = columns[:3], columns[3:]
    first, second = (tuple((1.0, column, column) for column in part) for part in (p, q))
    return first, second, (*first, *second, *((-2.0, *pair) for pair in zip(p, q, strict=True)))
