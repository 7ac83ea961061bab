"""Branches of a joint graph, and the loops that may be built next from those that are in already.

A branch is a chain of edges whose inner links carry nothing else. Where some branches are in, every part of the
mechanism that they connect counts as one node; a loop that may come next is a simple cycle between such nodes. It
adds exactly one independent loop: k branches join k nodes into one.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import networkx as nx

from assur.topology.screws.edges import Edge, graph


@dataclass(frozen=True)
class LoopBranch:
    """Names of edges in series from one link to another; the two are one link where the branch closes on itself."""

    edges: tuple[str, ...]
    start: str
    end: str


def branches(edges: Sequence[Edge]) -> tuple[LoopBranch, ...]:
    """The branches in the order of their first-named edges; edges that are in no loop are left out.

    Each is written from the end whose edge is named first.

    >>> import numpy as np
    >>> ends = {"A": "ok", "B": "kp", "C": "po", "D": "po", "E": "pt"}
    >>> edges = [Edge(name, *links, np.zeros((1, 6, 1))) for name, links in ends.items()]
    >>> [branch.edges for branch in branches(edges)]
    [('A', 'B'), ('C',), ('D',)]
    """
    bridges = {frozenset(pair) for pair in nx.bridges(graph(edges))}
    inside = [edge for edge in edges if frozenset((edge.parent, edge.child)) not in bridges]
    touching: dict[str, list[Edge]] = {}
    for edge in inside:
        touching.setdefault(edge.parent, []).append(edge)
        touching.setdefault(edge.child, []).append(edge)
    order = {edge.name: index for index, edge in enumerate(inside)}
    used: set[str] = set()
    collected = []
    for edge in inside:
        if edge.name not in used:
            branch = _through(edge, touching)
            used.update(branch.edges)
            turn = order[branch.edges[-1]] < order[branch.edges[0]]
            collected.append(LoopBranch(branch.edges[::-1], branch.end, branch.start) if turn else branch)
    return tuple(collected)


def _through(edge: Edge, touching: Mapping[str, list[Edge]]) -> LoopBranch:
    """The branch that an edge lies on."""
    after, end = _walk(edge, edge.child, edge.parent, touching)
    if end == edge.parent:
        return LoopBranch((edge.name, *after), edge.parent, end)
    before, start = _walk(edge, edge.parent, end, touching)
    return LoopBranch((*before[::-1], edge.name, *after), start, end)


def _walk(edge: Edge, link: str, stop: str, touching: Mapping[str, list[Edge]]) -> tuple[list[str], str]:
    """Edges from a link on, away from `edge`, up to a link where the way forks, or to `stop`."""
    names = []
    while link != stop and len(touching[link]) == 2:
        first, second = touching[link]
        edge = second if first is edge else first
        names.append(edge.name)
        link = edge.child if edge.parent == link else edge.parent
    return names, link


def next_loops(
    parts: Sequence[LoopBranch], taken: Collection[int], among: Collection[int] | None = None
) -> Iterator[tuple[int, ...]]:
    """Every loop that may come next, as the branches (their indices) around it, the first-named one first.

    Args:
        parts: all branches.
        taken: those that are in.
        among: those that the loop may use; all others by default.
    """
    node = _nodes(parts, taken)
    ends = {
        index: (node[part.start], node[part.end])
        for index, part in enumerate(parts)
        if index not in taken and (among is None or index in among)
    }
    leaving: dict[str, list[tuple[int, str]]] = {}
    for index, (start, end) in ends.items():
        leaving.setdefault(start, []).append((index, end))
        leaving.setdefault(end, []).append((index, start))
    for index, (start, end) in ends.items():
        yield from _cycles((index,), (end,), start, leaving)


def _cycles(
    way: tuple[int, ...], nodes: tuple[str, ...], goal: str, leaving: Mapping[str, list[tuple[int, str]]]
) -> Iterator[tuple[int, ...]]:
    """Ways on from the last node to the goal by branches after the first, no node twice."""
    if nodes[-1] == goal:
        yield way
        return
    for index, node in leaving[nodes[-1]]:
        if index > way[0] and node not in nodes:
            yield from _cycles((*way, index), (*nodes, node), goal, leaving)


def _nodes(parts: Sequence[LoopBranch], taken: Collection[int]) -> dict[str, str]:
    """The node that each link belongs to once some branches are in, by the name of one of its links."""
    node = {link: link for part in parts for link in (part.start, part.end)}
    for index in taken:
        kept, gone = node[parts[index].start], node[parts[index].end]
        node = {link: kept if name == gone else name for link, name in node.items()}
    return node


def names_along(parts: Sequence[LoopBranch], taken: Collection[int], loop: Sequence[int]) -> tuple[str, ...]:
    """Names of the edges in order along a loop, from the start of its first branch."""
    node = _nodes(parts, taken)
    joined = node[parts[loop[0]].start]
    names: list[str] = []
    for index in loop:
        start, end = node[parts[index].start], node[parts[index].end]
        forward = start == joined
        names += parts[index].edges if forward else parts[index].edges[::-1]
        joined = end if forward else start
    return tuple(names)
