"""Series and parallel: a graph between two of its nodes as a tree of edges one after another and side by side."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Series:
    """Parts one after another, from the start, and the nodes between them."""

    parts: tuple[Tree, ...]
    nodes: tuple[str, ...]


@dataclass(frozen=True)
class Beside:
    """Parts side by side between the same two nodes."""

    parts: tuple[Tree, ...]


Tree = str | Series | Beside
"""An edge by its name, or parts of which each is a tree."""

_Branch = tuple[str, str, Tree]


def tree(edges: Mapping[str, tuple[str, str]], start: str, end: str) -> Tree | None:
    """The tree of edges (name -> two nodes) between two nodes; None where the graph does not reduce to one.

    >>> tree({"a": ("0", "1"), "b": ("2", "1"), "c": ("0", "2")}, "0", "2")
    Beside(parts=(Series(parts=('a', 'b'), nodes=('1',)), 'c'))
    """
    left: list[_Branch] = [(first, second, name) for name, (first, second) in edges.items()]
    while len(left) > 1:
        merged = _joined(left, {start, end}) or _grouped(left)
        if merged is None:
            return None
        left = merged
    first, second, found = left[0]
    return {(start, end): found, (end, start): turned(found)}.get((first, second))


def turned(part: Tree) -> Tree:
    """A tree run through from its end."""
    if isinstance(part, Series):
        return Series(tuple(turned(item) for item in reversed(part.parts)), part.nodes[::-1])
    return Beside(tuple(turned(item) for item in part.parts)) if isinstance(part, Beside) else part


def levels(part: Tree) -> int:
    """Edges one after another, at most.

    >>> levels(Beside((Series(("a", "b"), ("1",)), "c")))
    2
    """
    if isinstance(part, Series):
        return sum(map(levels, part.parts))
    return max(map(levels, part.parts)) if isinstance(part, Beside) else 1


def _joined(left: list[_Branch], ends: set[str]) -> list[_Branch] | None:
    """Two branches made one at a node that nothing else touches; None where there is no such node."""
    touching: dict[str, list[int]] = {}
    for index, (start, end, _) in enumerate(left):
        touching.setdefault(start, []).append(index)
        touching.setdefault(end, []).append(index)
    for node, indices in touching.items():
        if node in ends or len(set(indices)) != 2 or len(indices) != 2:
            continue
        first, second = indices
        start, _, before = _leading_to(node, left[first])
        end, _, after = _leading_to(node, left[second])
        made = (start, end, _series(before, node, turned(after)))
        return [made if index == first else branch for index, branch in enumerate(left) if index != second]
    return None


def _leading_to(node: str, branch: _Branch) -> _Branch:
    start, end, part = branch
    return branch if end == node else (end, start, turned(part))


def _series(before: Tree, node: str, after: Tree) -> Series:
    first = before if isinstance(before, Series) else Series((before,), ())
    second = after if isinstance(after, Series) else Series((after,), ())
    return Series((*first.parts, *second.parts), (*first.nodes, node, *second.nodes))


def _grouped(left: list[_Branch]) -> list[_Branch] | None:
    """All branches between one pair of nodes made one; None where no two have both nodes in common."""
    between: dict[frozenset[str], list[int]] = {}
    for index, (start, end, _) in enumerate(left):
        between.setdefault(frozenset((start, end)), []).append(index)
    for indices in between.values():
        if len(indices) < 2:
            continue
        start, end, _ = left[indices[0]]
        parts = [_leading_to(end, left[index])[2] for index in indices]
        flat = [item for part in parts for item in (part.parts if isinstance(part, Beside) else (part,))]
        return [
            (start, end, Beside(tuple(flat))) if index == indices[0] else branch
            for index, branch in enumerate(left)
            if index not in indices[1:]
        ]
    return None
