"""What becomes of a box: inside, regular, outside by a margin, or open; and across which coordinate it is halved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.certificates.formulas import RegionFormulas
from assur.numerics.intervals.interval import Interval
from assur.workspace.certified.boxes import Boxes

FloatArray = NDArray[np.float64]
Tokens = NDArray[np.str_]

INSIDE, REGULAR, OUTSIDE, OPEN = "i", "r", "o", "b"
BLOCK = 8192
"""Boxes that are worked on at a time."""


@dataclass(frozen=True, eq=False)
class Leaves:
    """The rules by which boxes of one mechanism are decided."""

    formulas: RegionFormulas

    def tokens(self, boxes: Boxes) -> Tokens:
        """The leaf (N,) that each box would be: i, r, oNN with the number of the margin in hex, or b.

        >>> from assur.certificates.formulas import formulas
        >>> from assur.model.registry import load_record
        >>> leaves = Leaves(formulas(load_record("zeng2019")))
        >>> low = np.array([[-15.0, 200.0], [0.0, 0.0], [440.0, 400.0]])
        >>> leaves.tokens(Boxes(low, low + 1)).tolist()
        ['r', 'o00']
        """
        parts = [self._tokens(boxes[k : k + BLOCK]) for k in range(0, len(boxes), BLOCK)]
        return np.concatenate(parts)

    def _tokens(self, boxes: Boxes) -> Tokens:
        values, real = self.formulas.over(boxes.intervals)
        tokens = np.full(len(boxes), OPEN, dtype="<U3")
        inside, outside = real.copy(), []
        for name in self.formulas.names("margins"):
            value = values[f"margins: {name}"]
            inside &= value.defined & (value.low >= 0)
            outside.append(np.broadcast_to(value.negative, inside.shape))
        for name in self.formulas.names("nonzero"):
            inside &= values[f"nonzero: {name}"].nonzero
        tokens[inside] = INSIDE
        regular = inside.copy()
        for name in self.formulas.names("factors"):
            regular &= values[f"factors: {name}"].nonzero
        tokens[regular] = REGULAR
        for index, holds in reversed(list(enumerate(outside))):
            tokens[holds] = f"{OUTSIDE}{index:02x}"
        return tokens

    def signs(self, boxes: Boxes) -> set[tuple[str, bool]]:
        """Signs of the factors over regular boxes: (name, whether positive)."""
        signs: set[tuple[str, bool]] = set()
        for k in range(0, len(boxes), BLOCK):
            values, _ = self.formulas.over(boxes[k : k + BLOCK].intervals)
            for name in self.formulas.names("factors"):
                positive = np.broadcast_to(values[f"factors: {name}"].positive, len(boxes[k : k + BLOCK]))
                signs |= {(name, sign) for sign in np.unique(positive).tolist()}
        return signs

    def vanishes(self, regular: Boxes, inside: Boxes) -> bool:
        """Whether a factor is certainly zero somewhere in a box that is cut into these leaves alone.

        It has one sign in a regular leaf, the other in another one, and a value at every pose of those inside, so it
        is continuous all over the box. A factor with a pole may change its sign without a zero.
        """
        signs = self.signs(regular)
        both = [name for name, positive in sorted(signs) if positive and (name, False) in signs]
        for k in range(0, len(inside), BLOCK):
            values, _ = self.formulas.over(inside[k : k + BLOCK].intervals)
            both = [name for name in both if np.all(values[f"factors: {name}"].defined)]
        return bool(both)

    def axes(self, boxes: Boxes, extents: FloatArray, least: FloatArray) -> NDArray[np.int64]:
        """Across which coordinate (N,) to halve: the one of which the outputs that are still open depend most.

        Args:
            boxes: N of them, each with a side that is longer than the least.
            extents: (k, 1) sides of the whole.
            least: (k, 1) sides that are not longer are not halved.
        """
        parts = [self._axes(boxes[k : k + BLOCK], extents, least) for k in range(0, len(boxes), BLOCK)]
        return np.concatenate(parts)

    def _axes(self, boxes: Boxes, extents: FloatArray, least: FloatArray) -> NDArray[np.int64]:
        widths = boxes.high - boxes.low
        score = np.where(widths > least, 1e-3 * widths / extents, -np.inf)
        candidates = np.flatnonzero(np.any(widths > least, axis=1))
        if len(candidates) == 1:
            return np.full(len(boxes), candidates[0])
        whole, _ = self.formulas.over(boxes.intervals)
        intervals = boxes.intervals
        for axis in candidates.tolist():
            middle = Interval.of(0.5 * boxes.low[axis] + 0.5 * boxes.high[axis])
            held, _ = self.formulas.over([*intervals[:axis], middle, *intervals[axis + 1 :]])
            for name, value in whole.items():
                is_open = ~value.nonzero if not name.startswith("margins: ") else ~value.positive & (value.high >= 0)
                with np.errstate(invalid="ignore", divide="ignore"):
                    narrowed = 1 - (held[name].high - held[name].low) / (value.high - value.low)
                score[axis] += np.where(is_open, np.nan_to_num(narrowed, nan=0.0, posinf=0.0, neginf=0.0), 0.0)
        return np.asarray(np.argmax(score, axis=0))
