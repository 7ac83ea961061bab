"""Type of freedom: whether all drives move one Assur chain, or chains that hang together, or parts that do not.

The Assur chains are the nodes of a digraph. A chain stands after another one where the rates of its joints depend on
that one's drives; a drive outside all loops is a chain by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import networkx as nx
import numpy as np

from assur.results.answers.solution_order import AssurChain, Loop
from assur.topology.screws.edges import Edge, at_generic, closure, input_columns, null_basis

FreedomType = Literal["full", "partial", "separable"]
"""One Assur chain has all drives; several have them and hang together; or they fall into parts."""

ZERO = 1e-8
"""Rates below this share of the largest one at the same configuration are zero."""


def freedom_type(edges: Sequence[Edge], loops: Sequence[Loop], chains: Sequence[AssurChain]) -> FreedomType | None:
    """The type of freedom, of as many drives as determine the mechanism; None without any, or where they conflict.

    Args:
        edges: with twists at generic configurations.
        loops: in the order that attains the coupling degree.
        chains: the Assur chains, with indices of these loops.

    >>> drives = [Edge(f"P{i}", str(i), str(i + 1), np.eye(6)[None, :, 2 + i : 3 + i], (), (0,)) for i in (1, 2)]
    >>> freedom_type(drives, (), ())
    'separable'
    """
    edges = at_generic(edges)
    columns = input_columns(edges)
    if not columns:
        return None
    free = null_basis(closure(edges))
    rates = free[:, columns, :]
    if np.any(np.linalg.matrix_rank(rates, tol=1e-7) < len(columns)):
        return None
    moved = np.abs(free @ np.linalg.pinv(rates))  # (N, c, n)
    used = np.any(moved > ZERO * np.max(moved, axis=(1, 2), keepdims=True), axis=0)
    owners = _owners(edges, loops, chains)
    digraph: nx.DiGraph[str] = nx.DiGraph()
    for row, owner in enumerate(owners):
        drives = (column for column, depends in zip(columns, used[row], strict=True) if depends)
        digraph.add_edges_from((owners[column], owner) for column in drives)
    driven = {owners[column] for column in columns}
    if len(driven) == 1:
        return "full"
    parts = [part for part in nx.weakly_connected_components(digraph) if part & driven]
    return "partial" if len(parts) == 1 else "separable"


def _owners(edges: Sequence[Edge], loops: Sequence[Loop], chains: Sequence[AssurChain]) -> list[str]:
    """The Assur chain of each column, by its number; a joint in no loop stands for itself."""
    named = {
        joint: str(number)
        for number, chain in enumerate(chains, 1)
        for index in chain.loops
        for joint in loops[index].joints
    }
    return [named.get(edge.name, f"joint {edge.name}") for edge in edges for _ in range(edge.freedoms)]
