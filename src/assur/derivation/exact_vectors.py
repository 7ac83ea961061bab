"""Vectors and rotations of formulas: compared modulo a prime, and written without what is zero everywhere."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import sympy

from assur.derivation.witness import ModularWitness
from assur.numerics.vectors import Matrix, Vector, cross, dot, scaled


@dataclass(frozen=True, eq=False)
class ExactVectors:
    """Vectors that a witness compares.

    >>> x, y = sympy.symbols("x y")
    >>> ExactVectors(ModularWitness()).tidied(((x + y)**2 - x**2 - 2*x*y - y**2, x - x + 1, x))
    (0, 1, x)
    """

    witness: ModularWitness

    def unit(self, vector: Vector) -> Vector:
        """A vector over its length."""
        x, y, z = map(sympy.sympify, vector)
        return _unit((x, y, z))

    def along(self, axis: Vector, other: Vector) -> bool:
        """Whether two vectors lie on one line."""
        return all(self.witness.is_zero(part) for part in cross(axis, other))

    def upright(self, axis: Vector) -> Vector:
        """The same line; along an axis of the base, its positive sense."""
        parts = [sympy.sympify(part) for part in axis]
        first = next(part for part in reversed(parts) if not self.witness.is_zero(part))
        return scaled(axis, -1) if first.could_extract_minus_sign() else axis

    def equal(self, first: Matrix, second: Matrix) -> bool:
        """Whether two rotations are one."""
        return all(
            self.witness.is_zero(a - b)
            for row, other in zip(first, second, strict=True)
            for a, b in zip(row, other, strict=True)
        )

    def tidied(self, vector: Vector) -> Vector:
        """A vector, its parts expanded, or 0, 1 or -1 where they are that everywhere."""
        x, y, z = map(self._plain, vector)
        return x, y, z

    def _plain(self, part: sympy.Expr) -> sympy.Expr:
        """A formula that is 0, 1 or -1 everywhere is that number."""
        number = next((number for number in (0, 1, -1) if self.witness.is_zero(part - number)), None)
        return _on_circles(sympy.expand(part)) if number is None else number

    def tidy(self, matrix: Matrix) -> Matrix:
        """The same of a rotation."""
        a, b, c = (self.tidied(row) for row in matrix)
        return a, b, c


@lru_cache(maxsize=512)
def _unit(vector: Vector) -> Vector:
    """A vector over its length, worked out once: to simplify is what takes the time."""
    square = sympy.expand(dot(vector, vector))
    size = sympy.sqrt(_on_circles(square))
    x, y, z = (part if part == 0 else sympy.simplify(part / size) for part in vector)
    return x, y, z


def _on_circles(formula: sympy.Expr) -> sympy.Expr:
    """A polynomial with the squares of sines of angles among the dimensions written by their cosines."""
    for sine in sorted(formula.atoms(sympy.sin), key=str):
        square = 1 - sympy.cos(sine.args[0]) ** 2
        formula = sympy.expand(formula.replace(
            lambda part, own=sine: part.is_Pow and part.base == own and part.exp.is_Integer and part.exp > 1,
            lambda part, own=sine, two=square: two ** (int(part.exp) // 2) * own ** (int(part.exp) % 2),
        ))  # fmt: skip
    return formula
