"""Boxes: many of them as two arrays, in the plane of the coordinates that matter or in space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals.interval import Interval, as_interval

FloatArray = NDArray[np.float64]


LEAST = 5e-324
"""The smallest extent that is a float; that of a box that floats cannot divide counts as it."""


@dataclass(frozen=True, eq=False)
class Boxes:
    """N boxes: low and high (k, N), one row per coordinate, in length units and rad.

    >>> boxes = Boxes(np.array([[0.0], [0.0]]), np.array([[4.0], [1.0]]))
    >>> boxes.halved(np.array([0])).high.tolist()
    [[2.0, 4.0], [1.0, 1.0]]
    """

    low: FloatArray
    high: FloatArray

    def __len__(self) -> int:
        return int(self.low.shape[1])

    def __getitem__(self, index: NDArray[np.bool_] | NDArray[np.int64] | slice) -> Boxes:
        return Boxes(self.low[:, index], self.high[:, index])

    @property
    def intervals(self) -> list[Interval]:
        """One interval (N,) per coordinate."""
        return [Interval.of(low, high) for low, high in zip(self.low, self.high, strict=True)]

    @property
    def middles(self) -> FloatArray:
        """A point (k, N) inside each, the middle but for rounding."""
        return np.clip(0.5 * self.low + 0.5 * self.high, self.low, self.high)

    @property
    def sizes(self) -> Interval:
        """Enclosure (N,) of the volume of each."""
        total = as_interval(np.ones(len(self)))
        for low, high in zip(self.low, self.high, strict=True):
            total = total * (Interval.of(high) - Interval.of(low))
        return Interval(np.maximum(total.low, 0.0), total.high, total.defined)

    def halved(self, axis: NDArray[np.int64]) -> Boxes:
        """Each cut in two across the coordinate (N,) of that number; first all lower halves, then all upper ones."""
        every = np.arange(len(self))
        middle = self.middles[axis, every]
        first, second = self.high.copy(), self.low.copy()
        first[axis, every] = second[axis, every] = middle
        return Boxes(np.hstack([self.low, second]), np.hstack([first, self.high]))

    def divided(self, counts: Sequence[int]) -> Boxes:
        """Each cut into a grid of so many equal parts along each coordinate, the first box's parts first."""
        found = self
        for axis, count in enumerate(counts):
            edges = np.linspace(found.low[axis], found.high[axis], count + 1)
            low, high = np.repeat(found.low, count, axis=1), np.repeat(found.high, count, axis=1)
            low[axis], high[axis] = edges[:-1].T.ravel(), edges[1:].T.ravel()
            found = Boxes(low, high)
        return found


def together(parts: Sequence[Boxes]) -> Boxes:
    """The boxes of all parts, one part after the other."""
    return Boxes(np.hstack([part.low for part in parts]), np.hstack([part.high for part in parts]))
