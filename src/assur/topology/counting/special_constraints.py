"""Special constraints: what is known of the platform before any loop is solved, from POC sets alone.

A direction of the base in which the platform never moves is a number that the direct problem need not find: the
platform keeps its orientation, its axis keeps its direction, or O' stays in a plane. The whole mechanism may see to
that, as in the paper's step from Eq. (6) to Eq. (7), or a limb without loops once its own inputs are given, as each
limb of a Cartesian mechanism holds O' in a plane.

That the platform never turns about one direction, but about two others, is of no use. It restricts velocities and not
orientations: turning about the two by turns also turns about the third.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.topology.screws.edges import Edge, along, closure, graph, input_columns, null_basis

FloatArray = NDArray[np.float64]

NEVER = 1e-7
"""A unit motion is blocked in a direction where it has less than this."""


@dataclass(frozen=True, eq=False)
class SpecialConstraint:
    """Rows (k, 6) that the platform's twist (omega, v at O') is always perpendicular to, and what they say in words."""

    rows: FloatArray
    words: str


def special_constraints(edges: Sequence[Edge], base: str, platform: str) -> tuple[SpecialConstraint, ...]:
    """Those of the whole mechanism, then those of each limb without loops, its inputs locked.

    Args:
        edges: with twists at N >= 2 configurations where the closure has its generic rank.
        base: a link.
        platform: a link.

    >>> slide = lambda name, axis, *links: Edge(name, *links, np.tile(np.array([[0.0, 0, 0, *axis]]).T, (2, 1, 1)))
    >>> table = [slide("P1", (1, 0, 0), "base", "cart"), slide("P2", (0, 1, 0), "cart", "table")]
    >>> [item.words for item in special_constraints(table, "base", "table")][:2]
    ['the platform does not rotate', "O' stays in a known plane"]
    """
    constraints = _blocked(along(edges, base, platform) @ null_basis(closure(edges)))
    for limb in _limbs(edges, base, platform):
        moves = np.delete(along(limb, base, platform), input_columns(limb), axis=-1)
        names = ", ".join(edge.name for edge in limb)
        constraints += [
            SpecialConstraint(constraint.rows, f"by {names} alone {constraint.words}") for constraint in _blocked(moves)
        ]
    return tuple(constraints)


def connected(edges: Sequence[Edge], link: str) -> tuple[str, ...]:
    """The links that some edges connect with a link, itself among them; none where they do not touch it."""
    built = graph(edges)
    return tuple(nx.dfs_preorder_nodes(built, link)) if link in built else ()


def way_to(goal: str, links: Sequence[str], edges: Sequence[Edge], avoid: str) -> list[Edge]:
    """The edges of the way from some links to another one that has fewest freedoms and does not pass a third.

    Inputs do not count, for they are given. Empty where the goal is among the links, or cannot be reached so.

    Args:
        goal: a link.
        links: where the way may start, those first that are preferred.
        edges: all that may be passed.
        avoid: a link.
    """
    ways: nx.MultiGraph[str] = nx.MultiGraph()
    ways.add_nodes_from((*links, goal))
    for edge in edges:
        if avoid not in (edge.parent, edge.child):
            ways.add_edge(edge.parent, edge.child, key=edge.name, weight=edge.freedoms - len(edge.inputs))
    starts = [link for link in links if link != avoid and nx.has_path(ways, link, goal)]
    if not starts:
        return []
    _, way = nx.multi_source_dijkstra(ways, starts, goal)
    between = [ways[near][far] for near, far in pairwise(way)]
    names = {min(some, key=lambda name: some[name]["weight"]) for some in between}
    return [edge for edge in edges if edge.name in names]


def _blocked(moves: FloatArray) -> list[SpecialConstraint]:
    """What twists (N, 6, c) leave out at all configurations."""
    turns, slides = _never(moves[:, :3]), _never(moves[:, 3:])
    turned = {3: "the platform does not rotate", 2: "the platform rotates about one fixed direction only"}
    moved = {3: "O' stays at a known point", 2: "O' stays on a known line", 1: "O' stays in a known plane"}
    constraints = []
    if len(turns) in turned:
        constraints.append(SpecialConstraint(np.hstack([turns, np.zeros_like(turns)]), turned[len(turns)]))
    if len(slides) in moved:
        constraints.append(SpecialConstraint(np.hstack([np.zeros_like(slides), slides]), moved[len(slides)]))
    return constraints


def _never(directions: FloatArray) -> FloatArray:
    """Orthonormal rows (k, 3) perpendicular to all columns of directions (N, 3, c)."""
    left, singular, _ = np.linalg.svd(np.concatenate(list(directions), axis=1))
    rows: FloatArray = left[:, int(np.sum(singular > NEVER)) :].T
    return rows


def _limbs(edges: Sequence[Edge], base: str, platform: str) -> list[list[Edge]]:
    """The edges of each limb from base to platform that has no loops."""
    between = graph(edges)
    between.remove_nodes_from((base, platform))
    parts = [[edge for edge in edges if {edge.parent, edge.child} & part] for part in nx.connected_components(between)]
    parts += [[edge] for edge in edges if {edge.parent, edge.child} == {base, platform}]
    return [part for part in parts if {base, platform} <= set(graph(part)) and not closure(part).shape[1]]
