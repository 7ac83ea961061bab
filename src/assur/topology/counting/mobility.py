"""Mobility: how many freedoms the formula counts, how many move the platform, and what never moves at all.

F = Σ f_i - Σ ξ_Lj = Σ f_i - rank of the closure, Eqs. (3) and (4). Some of it may be internal: a motion that leaves
the platform and every input at rest, such as a rod's spin between two ball joints.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.topology.screws.edges import (
    Edge,
    along,
    at_generic,
    closure,
    column_names,
    graph,
    input_columns,
    null_basis,
    rank,
)

FloatArray = NDArray[np.float64]

AT_REST = 1e-7
"""Rates below this share of a motion are rounding errors of zero."""


@dataclass(frozen=True)
class InternalFreedom:
    """`count` freedoms that move these joints only, and neither the platform nor an input."""

    joints: tuple[str, ...]
    count: int


@dataclass(frozen=True)
class Mobility:
    """Freedoms and constraints of a graph of edges.

    Attributes:
        joints, links: m and n of v = m - n + 1.
        freedoms: sum of f_i.
        rank: of the closure, the sum of all ξ_Lj.
        platform: dimension of the platform's motion, dim M of its POC set.
        internal: freedoms that move neither the platform nor an input.
        idle: joints that never move.
        idle_components: freedoms of other joints with several, as C and U, that never move, ("C2.1",).
    """

    joints: int
    links: int
    freedoms: int
    rank: int
    platform: int
    internal: tuple[InternalFreedom, ...]
    idle: tuple[str, ...]
    idle_components: tuple[str, ...]

    @property
    def loops(self) -> int:
        """Number of independent loops, v = m - n + 1."""
        return self.joints - self.links + 1

    @property
    def dof(self) -> int:
        """F as the formula counts it, Eq. (3)."""
        return self.freedoms - self.rank

    @property
    def internal_freedoms(self) -> int:
        """How many of F are internal."""
        return sum(freedom.count for freedom in self.internal)

    @property
    def controlled(self) -> int:
        """F less internal freedoms: how many inputs it takes."""
        return self.dof - self.internal_freedoms

    @property
    def redundant_constraints(self) -> int:
        """6 v - rank."""
        return 6 * self.loops - self.rank


@dataclass(frozen=True, eq=False)
class Motions:
    """Bases of all motions of a mechanism at N configurations, c columns of its closure.

    Attributes:
        useful: (N, c, d) orthonormal, perpendicular to the internal ones.
        internal: (N, c, i) orthonormal, those that leave the platform and the inputs at rest.
        platform: (N, 6, d) the platform's twist in each useful motion.
    """

    useful: FloatArray
    internal: FloatArray
    platform: FloatArray


def motions(
    edges: Sequence[Edge],
    base: str,
    platform: str,
    inputs: Sequence[int] | None = None,
    finite: FloatArray | None = None,
) -> Motions:
    """All motions, split into useful and internal ones.

    Args:
        edges: a connected graph, with twists at generic configurations.
        base: a link.
        platform: a link.
        inputs: actuated columns of the closure; those that the edges name by default.
        finite: (N, c, F) basis of the motions, where they are fewer than the closure leaves: of a shaky linkage.
    """
    if finite is None:
        edges = at_generic(edges)
    free = null_basis(closure(edges)) if finite is None else finite
    moves = along(edges, base, platform) @ free
    actuated = list(input_columns(edges) if inputs is None else inputs)
    seen = np.concatenate([moves, free[:, actuated]], axis=1)  # (N, 6 + n, k)
    _, singular, turned = np.linalg.svd(seen)
    ranks = np.sum(singular > AT_REST, axis=-1)
    useful = int(np.max(ranks))
    kept = ranks == useful
    parts = np.swapaxes(turned[kept], -1, -2)
    free, moves = free[kept], moves[kept]
    return Motions(free @ parts[..., :useful], free @ parts[..., useful:], moves @ parts[..., :useful])


def mobility(edges: Sequence[Edge], base: str, platform: str, finite: FloatArray | None = None) -> Mobility:
    """F of Eq. (3) and what it is made of, for generalised joints or for all joints, as the edges are.

    Of a shaky linkage `finite` (N, c, F) has the motions that it really has, as for `motions`.

    Raises UnknownNameError for a link that no edge names, UsageError where links hang together with no joint.

    >>> turn = [[0, 0, 1, *np.cross(point, (0, 0, 1))] for point in ((0, 0, 0), (1, 2, 0), (4, 2, 0), (4, 0, 0))]
    >>> links = ("base", "crank", "rod", "rocker", "base")
    >>> bars = [
    ...     Edge(f"R{i + 1}", links[i], links[i + 1], np.array(turn[i], float).reshape(1, 6, 1)) for i in range(4)
    ... ]
    >>> found = mobility(bars, "base", "rod")
    >>> found.dof, found.loops, found.redundant_constraints
    (1, 1, 3)
    """
    built = _connected(edges, base, platform)
    space = motions(edges, base, platform, finite=finite)
    moving = np.concatenate([space.useful, space.internal], axis=-1)
    still = np.max(np.abs(moving), axis=(0, 2), initial=0.0) < AT_REST
    owner = _owners(edges)
    idle = [edge.name for index, edge in enumerate(edges) if np.all(still[owner == index])]
    parts = [
        (name, edges[index]) for name, index, rests in zip(column_names(edges), owner, still, strict=True) if rests
    ]
    freedoms = sum(edge.freedoms for edge in edges)
    return Mobility(
        joints=len(edges),
        links=built.number_of_nodes(),
        freedoms=freedoms,
        rank=freedoms - moving.shape[-1],
        platform=rank(space.platform, scale=1.0),
        internal=_named(space.internal, edges),
        idle=tuple(idle),
        idle_components=tuple(
            name for name, edge in parts if edge.freedoms > 1 and edge.single and edge.name not in idle
        ),
    )


def _connected(edges: Sequence[Edge], base: str, platform: str) -> nx.MultiGraph[str]:
    built = graph(edges)
    for link in (base, platform):
        if link not in built:
            raise UnknownNameError("link", link, built)
    apart = sorted(set(built) - {base, *nx.descendants(built, base)})
    if apart:
        raise UsageError(
            f"no joints connect the links {', '.join(apart)} with the base '{base}'; every link must be connected",
            hint="a chain that does not reach the platform, or a misspelt link, leaves such links",
        )
    return built


def _owners(edges: Sequence[Edge]) -> NDArray[np.int64]:
    """Index (c,) of the edge that each column belongs to."""
    return np.repeat(np.arange(len(edges)), [edge.freedoms for edge in edges])


def _named(internal: FloatArray, edges: Sequence[Edge]) -> tuple[InternalFreedom, ...]:
    """Internal freedoms by the joints that they move, as few as possible at a time.

    A space is the direct sum of parts that move different joints exactly where the projector onto it has no entries
    between those joints.
    """
    projector = np.max(np.abs(internal @ np.swapaxes(internal, -1, -2)), axis=0)
    owner = _owners(edges)
    together = (projector > AT_REST) | (owner[:, None] == owner)
    labels = _components(together)
    share = np.mean(np.sum(internal**2, axis=-1), axis=0)  # (c,), its sum over a part is the part's dimension
    moving = np.diag(projector) > AT_REST
    freedoms = []
    for label in dict.fromkeys(labels[moving]):
        part = labels == label
        joints = tuple(edges[index].name for index in dict.fromkeys(owner[part & moving]))
        freedoms.append(InternalFreedom(joints, round(float(np.sum(share[part])))))
    return tuple(freedoms)


def _components(together: NDArray[np.bool_]) -> NDArray[np.intp]:
    """For each node (c,) the first one that a path leads to, in a graph with a loop at each node (c, c)."""
    labels = np.arange(len(together))
    while np.any((least := np.min(np.where(together, labels, len(labels)), axis=1)) < labels):
        labels = least
    return labels


def driven_joints(edges: Sequence[Edge]) -> tuple[str, ...]:
    """Names of the joints of which a freedom is driven."""
    return tuple(edge.name for edge in edges if edge.inputs)


def passive_joints(edges: Sequence[Edge], mobility: Mobility) -> tuple[str, ...]:
    """Names of the joints that move and are not driven."""
    return tuple(edge.name for edge in edges if not edge.inputs and edge.name not in mobility.idle)
