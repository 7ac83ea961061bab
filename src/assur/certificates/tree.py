"""The tree of a proof: a box halved again and again until its parts are decided, or small enough together.

Written depth first as text: a digit halves across that coordinate at the float 0.5 low + 0.5 high, the lower half
first; everything else is a leaf. So the leaves cover the box and do not overlap by construction.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.certificates.leaves import INSIDE, REGULAR
from assur.errors import UsageError
from assur.work import Progress
from assur.workspace.certified.boxes import Boxes

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Tokens = NDArray[np.str_]
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
        levels, size = [np.array([0])], np.ones(len(self.tokens), dtype=np.int64)
        while len(cut := levels[-1][self.first[levels[-1]] >= 0]):
            levels.append(np.concatenate([self.first[cut], self.second[cut]]))
        cuts = [level[self.first[level] >= 0] for level in levels]
        for cut in reversed(cuts):  # how many tokens each subtree has, from its leaves
            size[cut] += size[self.first[cut]] + size[self.second[cut]]
        place = np.zeros_like(size)
        for cut in cuts:
            place[self.first[cut]] = place[cut] + 1
            place[self.second[cut]] = place[cut] + 1 + size[self.first[cut]]
        ordered = np.empty_like(self.tokens)
        ordered[place] = self.tokens
        return "".join(ordered.tolist())


@dataclass(frozen=True, eq=False)
class Limits:
    """When a tree is large enough.

    Attributes:
        unsettled: leaves that are halved on.
        gap: what they may leave open, as a share of what is certainly reached.
        least: (k, 1) sides that are not longer are not halved.
        most: leaves at most.
        stoppable: whether Ctrl-C ends the growth, too: what is decided by then is kept, the rest stays open.
    """

    unsettled: tuple[str, ...]
    gap: float
    least: FloatArray
    most: int
    stoppable: bool = False

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

    >>> halves = lambda boxes: np.where(boxes.low[0] >= 0.5, "i", np.where(boxes.high[0] <= 0.5, "o00", "b"))
    >>> unit = Boxes(np.zeros((1, 1)), np.ones((1, 1)))
    >>> limits = Limits(("b",), 0.0, np.array([[1e-3]]), 9)
    >>> grow(unit, halves, lambda boxes: np.zeros(len(boxes), dtype=int), limits).text
    '0o00i'
    """
    tree = start or Tree(whole, judge(whole).astype("<U3"), np.array([-1]), np.array([-1]), np.ones(1))
    with contextlib.suppress(*[KeyboardInterrupt] if limits.stoppable else []):
        while len(cut := limits.next(tree)):
            tree = _halved(tree, cut, judge, axes)
            if progress is not None:
                progress(int(np.sum(tree.leaves)), limits.most)
    return tree


def planted(text: Any, whole: Boxes, judge: Callable[[Boxes], Tokens]) -> Tree:
    """The tree whose cuts a text has, with every leaf judged anew: what the text says of its leaves is not believed.

    `planted(tree.text, whole, judge)` has the boxes of `tree` in another order.

    Errors:
        UsageError: the text is no whole tree of this box.

    >>> halves = lambda boxes: np.where(boxes.low[0] >= 0.5, "i", np.where(boxes.high[0] <= 0.5, "o00", "b"))
    >>> unit = Boxes(np.zeros((1, 1)), np.ones((1, 1)))
    >>> tree = planted("0ii", unit, halves)
    >>> tree.boxes.low.tolist(), tree.text
    ([[0.0, 0.0, 0.5]], '0o00i')
    """
    tokens = TOKEN.findall(text) if isinstance(text, str) else []
    if not tokens or sum(map(len, tokens)) != len(text) or tokens[-1].isdigit():
        raise _no_tree()
    first, second = np.full((2, len(tokens)), -1)
    low, high = (np.repeat(side, len(tokens), axis=1) for side in (whole.low, whole.high))
    shares = np.ones(len(tokens))
    waiting: list[tuple[int, int]] = []  # boxes whose upper half is still to come, and across which coordinate
    for child, (place, token) in enumerate(enumerate(tokens[:-1]), 1):
        if token.isdigit() and int(token) < len(low):
            axis, parent, ends = int(token), place, high
            waiting.append((place, axis))
            first[place] = child
        elif waiting and not token.isdigit():
            (parent, axis), ends = waiting.pop(), low
            second[parent] = child
        else:
            raise _no_tree()
        middle = 0.5 * low[axis, parent] + 0.5 * high[axis, parent]
        if not low[axis, parent] < middle < high[axis, parent]:
            raise _no_tree()
        low[:, child], high[:, child] = low[:, parent], high[:, parent]
        ends[axis, child] = middle
        shares[child] = shares[parent] / 2
    if waiting:
        raise _no_tree()
    boxes, leaf, judged = Boxes(low, high), first < 0, np.array(tokens, dtype="<U3")
    judged[leaf] = judge(boxes[leaf])
    return Tree(boxes, judged, first, second, shares)


def _no_tree() -> UsageError:
    return UsageError("the certificate to be carried on has no whole tree of boxes", hint="begin anew")


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
