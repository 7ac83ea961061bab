"""Spans of directions, part of them fixed and part turning: the lines and planes that a chain's rules add and meet.

As a chain moves, some of its directions stay where they were written and others turn. A `Span` says which: a fixed
subspace, and how many further dimensions turn. "Turning" means generic: two lines that turn independently are
never parallel, and never lie in a plane that was given before, unless they turn in it.
"""

from __future__ import annotations

from dataclasses import dataclass

from assur.topology.directions import AXES, Vector, dot, normal, parallel, perpendicular, plane_basis, unit


@dataclass(frozen=True)
class Span:
    """A subspace of directions: one of 0; a line or plane, fixed or turning; a plane turning about a fixed line; all.

    Attributes:
        fixed: orthonormal basis of what stays fixed.
        turning: dimensions beyond it, whose directions turn.
        plane: normal of the fixed plane in which a single turning line turns; None where it leaves every plane.

    >>> parallelogram = Span().with_line(in_plane=(0.0, 1.0, 0.0))
    >>> parallelogram.dim, parallelogram.with_line(in_plane=(0.0, 1.0, 0.0)).fixed
    (1, ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0)))
    """

    fixed: tuple[Vector, ...] = ()
    turning: int = 0
    plane: Vector | None = None

    @property
    def dim(self) -> int:
        """Number of independent directions."""
        return len(self.fixed) + self.turning

    @property
    def normal(self) -> Vector:
        """Normal of a fixed plane."""
        return normal(*self.fixed)

    @property
    def is_fixed(self) -> bool:
        """Whether nothing of it turns."""
        return not self.turning

    def contains(self, direction: Vector) -> bool:
        """Whether it contains a fixed direction at every moment."""
        match len(self.fixed):
            case 0:
                return False
            case 1:
                return parallel(self.fixed[0], direction)
            case 2:
                return perpendicular(self.normal, direction)
        return True

    def contains_plane(self, axis: Vector) -> bool:
        """Whether it contains the whole plane perpendicular to a fixed direction."""
        return len(self.fixed) == 3 or (len(self.fixed) == 2 and parallel(self.normal, axis))

    def with_direction(self, direction: Vector) -> Span:
        """The sum with one fixed direction."""
        if self.contains(direction):
            return self
        if self.dim == 2:
            return ALL
        if len(self.fixed) == 1:
            return Span(_orthonormal(self.fixed[0], direction))
        if self.plane is not None and perpendicular(self.plane, direction):
            return plane_across(self.plane)
        return Span((direction,), self.turning)

    def with_line(self, in_plane: Vector | None = None) -> Span:
        """The sum with one more turning line, which stays perpendicular to `in_plane` where that is given."""
        if self.dim == 0:
            return Span((), 1, in_plane)
        if len(self.fixed) == 2:
            return self if parallel(self.normal, in_plane) else ALL
        if self.dim >= 2:
            return ALL
        if in_plane is not None:
            if self.fixed and perpendicular(self.fixed[0], in_plane):
                return plane_across(in_plane)
            if parallel(self.plane, in_plane):
                return plane_across(in_plane)
        return Span(self.fixed, self.turning + 1)

    def with_span(self, other: Span) -> Span:
        """The sum of two spans that turn independently."""
        total = self
        for direction in other.fixed:
            total = total.with_direction(direction)
        for _ in range(other.turning):
            total = total.with_line(other.plane)
        return total

    def turned(self, axis: Vector | None) -> Span:
        """The span once it turns about a fixed axis, or about a general point where the axis is None."""
        if self.dim in (0, 3):
            return self
        if axis is None:
            return Span((), self.dim)
        match len(self.fixed):
            case 0:
                return self if parallel(self.plane, axis) else Span((), self.turning)
            case 1:
                if parallel(self.fixed[0], axis):
                    return self
                in_plane = axis if self.dim == 1 and perpendicular(self.fixed[0], axis) else None
                return Span((), self.dim, in_plane)
        if parallel(self.normal, axis):
            return self
        return Span((unit(axis),), 1) if perpendicular(self.normal, axis) else Span((), 2)

    @property
    def complement(self) -> Span:
        """Everything perpendicular to it."""
        match len(self.fixed), self.turning:
            case 0, 0:
                return ALL
            case 0, 1:
                return Span((), 2) if self.plane is None else Span((self.plane,), 1)
            case 0, 2:
                return Span((), 1)
            case 1, 0:
                return plane_across(self.fixed[0])
            case 1, 1:
                return Span((), 1, self.fixed[0])
            case 2, 0:
                return Span((self.normal,))
        return Span()

    def meet(self, other: Span) -> Span:
        """What two spans that turn independently have in common."""
        return self.complement.with_span(other.complement).complement


NOTHING = Span()
"""No direction."""

ALL = Span(AXES)
"""Every direction."""


def plane_across(axis: Vector) -> Span:
    """The fixed plane perpendicular to a direction."""
    return Span(plane_basis(axis))


def _orthonormal(first: Vector, second: Vector) -> tuple[Vector, Vector]:
    """A basis of the plane of two directions."""
    across = unit(b - dot(first, second) * a for a, b in zip(first, second, strict=True))
    return (first, across)


def along(direction: Vector) -> Span:
    """The fixed line along a direction."""
    return Span((direction,))
