"""Whether pivots that were good at examples are good at a configuration, in numbers of a straight line."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from assur.joint_graph.configuration import Configuration
from assur.numerics.elimination import Elimination, Pivots
from assur.numerics.vectors import Vector, dot, minus, plus, times

SIDES = 3
"""Right sides, drawn once, by which the size of the inverse is estimated."""


@dataclass(frozen=True, eq=False)
class PivotChecks:
    """Equations of the loops, `rows` of them, at a configuration, solved by pivots.

    `units` are of the columns, those of the rows are characteristic lengths for velocities.
    """

    configuration: Configuration
    entries: Mapping[tuple[int, int], Any]
    triangle: Elimination
    pivots: Pivots
    units: Sequence[Any]

    def size(self) -> Any:
        """Sum of squares of all entries, as numbers."""
        numbers = [(row, times(entry, self.units[column])) for (row, column), entry in self._loops()]
        turned, moved = (total(times(x, x) for row, x in numbers if (row % 6 >= 3) == far) for far in (False, True))
        return plus(turned, times(moved, self._per_length))

    def square(self, twist: tuple[Vector, Vector]) -> Any:
        """Of an angular velocity and a velocity, that in characteristic lengths."""
        turned, moved = (dot(part, part) for part in twist)
        return plus(turned, times(moved, self._per_length))

    def inverse(self) -> Any:
        """Mean square of what the pivots make of right sides drawn once: the square of the inverse's norm, estimated.

        Any inverse for consistent right sides is at least as large as the smallest of them.
        """
        length = self.configuration.geometry.length
        squares = []
        for draws in np.random.default_rng(0).normal(size=(SIDES, len(self.pivots))).tolist():
            numbers = zip(self.pivots, draws, strict=True)
            right = {row: times(draw, length) if row % 6 >= 3 else draw for (row, _), draw in numbers}
            solved = self.triangle.solved(right, count=len(self.pivots))
            squares += [times(x, x) for x in map(self.unknown, solved, solved.values())]
        return times(total(squares), 1.0 / SIDES)

    def left(self, vector: Mapping[int, Any], right: Mapping[int, Any]) -> tuple[Any, Any]:
        """Squares of what the rows leave of a right side, and of how much there is."""
        left: dict[int, Any] = {row: minus(0, number) for row, number in right.items()}
        for (row, column), entry in self._loops():
            if column in vector:
                left[row] = plus(left.get(row, 0), times(entry, vector[column]))
        among = [self.row(*item) for item in right.items()] + [self.unknown(*item) for item in vector.items()]
        return total(times(x, x) for x in (self.row(*item) for item in left.items())), total(times(x, x) for x in among)

    def gaps(self) -> Iterator[Any]:
        """Squares of distances in characteristic lengths, and of half the chords of the turns that are left."""
        for cut in self.configuration.graph.cut:
            distance, turned = self.configuration.gap(cut)
            yield times(dot(distance, distance), self._per_length)
            chord = [minus(turned[i][j], int(i == j)) for i in range(3) for j in range(3)]
            yield times(0.5, total(times(number, number) for number in chord))

    def row(self, row: int, number: Any) -> Any:
        """The number of a row, velocities in characteristic lengths."""
        return number / self.configuration.geometry.length if row % 6 >= 3 else number

    def unknown(self, column: int, number: Any) -> Any:
        """The number of a column in its unit."""
        unit = self.units[column]
        return number if type(unit) is int else number / unit

    @property
    def _per_length(self) -> Any:
        return 1 / (self.configuration.geometry.length * self.configuration.geometry.length)

    def _loops(self) -> Iterator[tuple[tuple[int, int], Any]]:
        rows = 6 * len(self.configuration.graph.cut)
        return ((key, entry) for key, entry in self.entries.items() if key[0] < rows)


def total(numbers: Iterable[Any]) -> Any:
    """Their sum, the integer 0 of none."""
    whole: Any = 0
    for number in numbers:
        whole = plus(whole, number)
    return whole
