"""The graph that topology counts on: edges between links, each with its twists at some configurations.

An edge is a joint, or a generalised joint (a parallelogram) with the relative twists that it allows. Everything
that the second route says is the rank of a closure made of such edges, or a motion space that it leaves.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import networkx as nx
import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

RANK_GAP = 1e-7
"""Singular values below this share of the largest count as zero."""


@dataclass(frozen=True, eq=False)
class Edge:
    """A joint or a generalised joint between two links.

    Attributes:
        twists: (N, 6, f) columns (omega, v at the platform's O' of the configuration, in lengths of the
            linkage's size) at N configurations, moving the child against the parent.
        joints: names of the joints that it stands for.
        inputs: which of its columns are actuated.
        single: whether each column is a freedom by itself that can be driven or idle, unlike those of a ball joint.
    """

    name: str
    parent: str
    child: str
    twists: FloatArray
    joints: tuple[str, ...] = ()
    inputs: tuple[int, ...] = ()
    single: bool = True

    @property
    def freedoms(self) -> int:
        """f_i of Eq. (3)."""
        return int(self.twists.shape[-1])


def graph(edges: Iterable[Edge]) -> nx.MultiGraph[str]:
    """Links as nodes, edges keyed by name."""
    built: nx.MultiGraph[str] = nx.MultiGraph()
    for edge in edges:
        built.add_edge(edge.parent, edge.child, key=edge.name)
    return built


def closure(edges: Sequence[Edge]) -> FloatArray:
    """Closure matrix (N, 6 v, sum of f): one block of six rows for each independent loop, columns in order.

    Edges that close no loop give zero columns.
    """
    count = len(edges[0].twists) if edges else 1
    starts = np.cumsum([0, *(edge.freedoms for edge in edges)])
    place = {edge.name: (edge, slice(starts[i], starts[i + 1])) for i, edge in enumerate(edges)}
    loops = _loops(edges)
    matrix = np.zeros((count, len(loops), 6, int(starts[-1])))
    for index, loop in enumerate(loops):
        for name, sense in loop.items():
            edge, columns = place[name]
            matrix[:, index, :, columns] = sense * edge.twists
    return matrix.reshape(count, 6 * len(loops), int(starts[-1]))


def _loops(edges: Sequence[Edge]) -> list[dict[str, int]]:
    """Independent loops, each edge name -> +1 or -1 along it, from a spanning forest."""
    to_root: dict[str, dict[str, int]] = {}
    rest: list[Edge] = []
    waiting = list(edges)
    while waiting:
        grown = False
        for edge in list(waiting):
            near, far = edge.parent in to_root, edge.child in to_root
            if near and far:
                rest.append(edge)
            elif near:
                to_root[edge.child] = {**to_root[edge.parent], edge.name: 1}
            elif far:
                to_root[edge.parent] = {**to_root[edge.child], edge.name: -1}
            else:
                continue
            waiting.remove(edge)
            grown = True
        if not grown:
            to_root[waiting[0].parent] = {}
    loops = []
    for edge in rest:
        loop = {**to_root[edge.parent], edge.name: 1}
        for name, sense in to_root[edge.child].items():
            loop[name] = loop.get(name, 0) - sense
        loops.append({name: sense for name, sense in loop.items() if sense})
    return loops


def along(edges: Sequence[Edge], start: str, end: str) -> FloatArray:
    """Twist (N, 6, sum of f) of one link against another per rate of each column, along one path between them."""
    built = graph(edges)
    links = nx.shortest_path(built, start, end)
    place = {edge.name: edge for edge in edges}
    senses = {}
    for near, far in pairwise(links):
        name = min(built[near][far], key=list(place).index)
        senses[name] = 1 if place[name].parent == near else -1
    columns = [senses.get(edge.name, 0) * edge.twists for edge in edges]
    return np.concatenate(columns, axis=-1)


def rank(matrix: FloatArray, scale: float | None = None) -> int:
    """Generic rank of matrices (N, rows, columns): the largest over the configurations.

    `scale` is what singular values are compared with, the largest of each matrix by default. Give it where the
    whole matrix may be zero but for rounding.

    >>> dust = np.full((1, 2, 2), 1e-16)
    >>> rank(dust), rank(dust, scale=1.0), rank(dust + np.eye(2))
    (0, 0, 2)
    """
    if 0 in matrix.shape[1:]:
        return 0
    singular = np.linalg.svd(matrix, compute_uv=False)
    return int(np.max(_ranks(singular, scale)))


def null_basis(matrix: FloatArray, scale: float | None = None) -> FloatArray:
    """Orthonormal basis (N', columns, k) of what the closure leaves, at the N' configurations of generic rank."""
    count = matrix.shape[-1]
    if not matrix.shape[1]:
        return np.broadcast_to(np.eye(count), (len(matrix), count, count))
    _, singular, turned = np.linalg.svd(matrix)
    ranks = _ranks(singular, scale)
    generic = int(np.max(ranks))
    basis: FloatArray = np.swapaxes(turned[ranks == generic, generic:], -1, -2)
    return basis


def _ranks(singular: NDArray[np.floating[Any]], scale: float | None) -> NDArray[np.int64]:
    """Rank (N,) of each configuration from its singular values (N, r)."""
    largest = np.maximum(singular[..., :1], RANK_GAP) if scale is None else scale
    ranks: NDArray[np.int64] = np.sum(singular > RANK_GAP * largest, axis=-1)
    return ranks


def at_generic(edges: Sequence[Edge]) -> tuple[Edge, ...]:
    """The edges at those of their configurations where the closure has its generic rank, best conditioned first.

    `null_basis` then keeps them all, so that it stands beside `along` configuration by configuration.
    """
    matrix = closure(edges)
    if 0 in matrix.shape[1:]:
        return tuple(edges)
    singular = np.linalg.svd(matrix, compute_uv=False)
    ranks = _ranks(singular, None)
    generic = int(np.max(ranks))
    gap = singular[:, generic - 1] / np.maximum(singular[:, 0], RANK_GAP) if generic else np.ones(len(matrix))
    kept = [int(index) for index in np.argsort(-gap, kind="stable") if ranks[index] == generic]
    return tuple(dataclasses.replace(edge, twists=edge.twists[kept]) for edge in edges)


def input_columns(edges: Sequence[Edge]) -> list[int]:
    """Columns of the actuated freedoms in the closure of these edges, in the order of the edges."""
    starts = np.cumsum([0, *(edge.freedoms for edge in edges)])
    return [int(starts[index]) + column for index, edge in enumerate(edges) for column in edge.inputs]


def column_names(edges: Sequence[Edge]) -> tuple[str, ...]:
    """Name of each column: of its edge, with the number of the component where the edge has several ("C2.1")."""
    return tuple(
        edge.name if edge.freedoms == 1 else f"{edge.name}.{column + 1}"
        for edge in edges
        for column in range(edge.freedoms)
    )
