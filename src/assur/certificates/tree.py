"""The tree of a proof: a box halved again and again until its parts are decided, or small enough together.

Written depth first as text: a digit halves across that coordinate at the float 0.5 low + 0.5 high, the lower half
first; everything else is a leaf. So the leaves cover the box and do not overlap by construction.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.certificates.leaves import INSIDE, REGULAR
from assur.workspace.certified.boxes import Boxes

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Tokens = NDArray[np.str_]
Progress = Callable[[int, int], None]
TOKEN = re.compile(r"[0-9]|o[0-9a-f]{2}|[a-z]")

SHARE = 0.5
"""The largest boxes with at least this share of what is not settled are halved next."""


@dataclass(frozen=True, eq=False)
class Tree:
    """Boxes in the order in which they were made, and what became of each.

    Attributes:
        boxes: N of them, the whole first.
        tokens: (N,) what each is: a digit where it is halved, else its leaf.
        first, second: (N,) places of the lower and the upper half, -1 of a leaf.
        shares: (N,) of the volume of the whole.
    """

    boxes: Boxes
    tokens: Tokens
    first: IntArray
    second: IntArray
    shares: FloatArray

    @property
    def leaves(self) -> NDArray[np.bool_]:
        """Which boxes (N,) are leaves."""
        return self.first < 0

    @property
    def text(self) -> str:
        """The tree, depth first."""
        tokens, first, second = self.tokens.tolist(), self.first.tolist(), self.second.tolist()
        parts, stack = [], [0]
        while stack:
            place = stack.pop()
            parts.append(tokens[place])
            if first[place] >= 0:
                stack += (second[place], first[place])
        return "".join(parts)


@dataclass(frozen=True, eq=False)
class Limits:
    """When a tree is large enough.

    Attributes:
        unsettled: leaves that are halved on.
        gap: what they may leave open, as a share of what is certainly reached.
        least: (k, 1) sides that are not longer are not halved.
        most: leaves at most.
    """

    unsettled: tuple[str, ...]
    gap: float
    least: FloatArray
    most: int

    def next(self, tree: Tree) -> IntArray:
        """Which boxes are halved next; none where the tree is large enough."""
        leaf = tree.leaves
        reached = float(np.sum(tree.shares[leaf & np.isin(tree.tokens, (INSIDE, REGULAR))]))
        wide = np.any(tree.boxes.high - tree.boxes.low > self.least, axis=0)
        may = np.flatnonzero(leaf & np.isin(tree.tokens, self.unsettled) & wide)
        left, room = float(np.sum(tree.shares[may])), max(self.most - int(np.sum(leaf)), 0)
        if left <= self.gap * reached:
            return may[:0]
        order = may[np.argsort(-tree.shares[may], kind="stable")]
        return order[: min(int(np.searchsorted(np.cumsum(tree.shares[order]), SHARE * left)) + 1, room)]


def grow(
    whole: Boxes,
    judge: Callable[[Boxes], Tokens],
    axes: Callable[[Boxes], IntArray],
    limits: Limits,
    progress: Progress | None = None,
    start: Tree | None = None,
) -> Tree:
    """The tree of a box.

    Args:
        whole: one box.
        judge: the leaf (N,) that each of some boxes would be.
        axes: across which coordinate (N,) each is halved; one that is longer than the least.
        limits: when it is large enough.
        progress: called with leaves so far and leaves at most.
        start: a tree of this box that is grown on.

    Ctrl-C ends the growth: what is decided by then is kept, the rest stays open.

    >>> halves = lambda boxes: np.where(boxes.low[0] >= 0.5, "i", np.where(boxes.high[0] <= 0.5, "o00", "b"))
    >>> unit = Boxes(np.zeros((1, 1)), np.ones((1, 1)))
    >>> limits = Limits(("b",), 0.0, np.array([[1e-3]]), 9)
    >>> grow(unit, halves, lambda boxes: np.zeros(len(boxes), dtype=int), limits).text
    '0o00i'
    """
    tree = start or Tree(whole, judge(whole).astype("<U3"), np.array([-1]), np.array([-1]), np.ones(1))
    with contextlib.suppress(KeyboardInterrupt):
        while len(cut := limits.next(tree)):
            tree = _halved(tree, cut, judge, axes)
            if progress is not None:
                progress(int(np.sum(tree.leaves)), limits.most)
    return tree


def planted(text: str, whole: Boxes) -> Tree:
    """The tree of which this is the text: `planted(tree.text, whole)` has the boxes of `tree` in another order.

    >>> planted("0o00i", Boxes(np.zeros((1, 1)), np.ones((1, 1)))).boxes.low.tolist()
    [[0.0, 0.0, 0.5]]
    """
    tokens = TOKEN.findall(text)
    first, second = np.full((2, len(tokens)), -1)
    low, high = (np.repeat(side, len(tokens), axis=1) for side in (whole.low, whole.high))
    shares = np.ones(len(tokens))
    waiting: list[tuple[int, int]] = []  # boxes whose upper half is still to come, and across which coordinate
    for place, token in enumerate(tokens[:-1]):
        if token.isdigit():
            axis, parent, ends = int(token), place, high
            waiting.append((place, axis))
            first[place] = place + 1
        else:
            (parent, axis), ends = waiting.pop(), low
            second[parent] = place + 1
        child = place + 1
        low[:, child], high[:, child] = low[:, parent], high[:, parent]
        ends[axis, child] = 0.5 * low[axis, parent] + 0.5 * high[axis, parent]
        shares[child] = shares[parent] / 2
    return Tree(Boxes(low, high), np.array(tokens, dtype="<U3"), first, second, shares)


def _halved(tree: Tree, cut: IntArray, judge: Callable[[Boxes], Tokens], axes: Callable[[Boxes], IntArray]) -> Tree:
    """The tree with some leaves cut in two; the old one is left as it is."""
    axis = axes(tree.boxes[cut])
    halves = tree.boxes[cut].halved(axis)
    tokens, first, second = tree.tokens.copy(), tree.first.copy(), tree.second.copy()
    start, size = len(tokens), len(cut)
    tokens[cut], first[cut] = axis.astype("<U3"), start + np.arange(size)
    second[cut] = first[cut] + size
    ends = np.full(2 * size, -1)
    return Tree(
        Boxes(np.hstack([tree.boxes.low, halves.low]), np.hstack([tree.boxes.high, halves.high])),
        np.concatenate([tokens, judge(halves)]),
        np.concatenate([first, ends]),
        np.concatenate([second, ends]),
        np.concatenate([tree.shares, np.tile(tree.shares[cut] / 2, 2)]),
    )
