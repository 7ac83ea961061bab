"""Coupling: the order of loops in which a mechanism is least coupled, its Assur chains and coupling degree.

Loops come in one after the other, each as a single open chain (SOC) on what is already there. For the set S_j of
edges that are in after loop j, ξ_Lj = rank closure(S_j) - rank closure(S_j-1). That is Eq. (4): in block form

    closure(S_j) = [[A, 0], [B, C]],    A = closure(S_j-1), B its part of the new loop, C the twists of the SOC;

with N a basis of the motions that A leaves, rank closure(S_j) = rank A + rank [B N | C]. The columns of B N are how
the links that the SOC joins can move against each other in what is already there (∩ M_bi), those of C how the SOC
lets them (M_b(j+1)): rank [B N | C] = dim{(∩ M_bi) ∪ M_b(j+1)}.

So Δ_j is the change of D(S) = Σ f - internal freedoms - inputs - rank closure(S), which depends on the set alone. An
Assur chain ends where D is zero, and the least Σ|Δ_j| over all orders is a shortest path over sets.

With the inputs locked, S has Σ f - inputs - rank closure(S) freedoms. The whole mechanism leaves those of them that
belong to its internal freedoms: rank N_S, with N a basis of the internal motions and N_S its rows of the joints in S.
So an internal freedom counts with the first loop that it moves. Any value may be given to it there: what later loops
decide, and a search must find, is the rest, D(S) = Σ f - rank N_S - inputs - rank closure(S) >= 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.results.answers.solution_order import AssurChain, Loop
from assur.topology.counting.branches import LoopBranch, branches, names_along, next_loops
from assur.topology.screws.edges import Edge, closure, rank

FloatArray = NDArray[np.float64]

SETS = 200_000
"""Sets of branches that the search for the least coupled order may look at."""


@dataclass(frozen=True)
class Decomposition:
    """Loops in an order, and the Assur chains that they make. Loops after the last chain are in none."""

    loops: tuple[Loop, ...]
    assur_chains: tuple[AssurChain, ...]

    @property
    def remainder(self) -> int:
        """Σ Δ_j: freedoms of the loops less internal ones, less inputs; zero if there are as many inputs as needed."""
        return sum(loop.delta for loop in self.loops)

    @property
    def coupling_degree(self) -> int | None:
        """The largest of the Assur chains, 0 without loops; None where the inputs are too many or too few."""
        if self.remainder:
            return None
        return max((chain.coupling_degree for chain in self.assur_chains), default=0)


def coupling(edges: Sequence[Edge], internal: FloatArray | None = None, limit: int = SETS) -> Decomposition:
    """The decomposition with the least Σ|Δ_j| over all orders of loops, Eqs. (5) and (6).

    Among equals the one with most Assur chains, then the one whose loops have fewest branches and are named first.
    Edges that are in no loop (a serial arm) take no part.

    Args:
        edges: with twists at generic configurations; parallelograms as one edge, by the convention of the theory.
        internal: (N, c, i) basis of the internal motions, columns of the edges in their order, from
            `assur.topology.counting.mobility.motions`; none by default.
        limit: sets of branches to look at before giving up.

    Raises UsageError where there are more sets than that; `coupling_of` then takes an order.

    >>> at = lambda *point: [0, 0, 1, *np.cross(point, (0, 0, 1))]
    >>> points = [at(0, 0, 0), at(0, 2, 0), at(3, 3, 0), at(5, 2, 0), at(5, 0, 0)]
    >>> links = ("base", "a", "b", "c", "d", "base")
    >>> five_bar = [
    ...     Edge(f"R{i}", links[i], links[i + 1], np.array(points[i]).reshape(1, 6, 1), (), (0,) if i in (0, 4) else ())
    ...     for i in range(5)
    ... ]
    >>> found = coupling(five_bar)
    >>> found.loops[0].xi, found.loops[0].delta, found.coupling_degree
    (3, 0, 0)
    """
    counted = _Counted(edges, internal)
    return counted.decomposition(_least_coupled(counted, limit))


def coupling_of(
    edges: Sequence[Edge], order: Sequence[Sequence[str]], internal: FloatArray | None = None
) -> Decomposition:
    """The decomposition in a given order of loops, such as one that a paper prints; nothing is minimised.

    Args:
        edges: as for `coupling`.
        internal: as for `coupling`.
        order: names of the edges that each loop adds to those before it.

    Raises UnknownNameError for an unknown edge, UsageError for an order that does not add one loop at a time.

    >>> slide = lambda name, axis: Edge(name, "base", "table", np.array([0, 0, 0, *axis], float).reshape(1, 6, 1))
    >>> found = coupling_of([slide("P1", (1, 0, 0)), slide("P2", (0, 1, 0))], [["P1", "P2"]])
    >>> found.loops[0].xi, found.loops[0].delta
    (2, 0)
    """
    counted = _Counted(edges, internal)
    taken: frozenset[int] = frozenset()
    loops = []
    for number, names in enumerate(order, 1):
        loop = _as_loop(counted.parts, taken, counted.indices(names), number)
        loops.append(loop)
        taken |= set(loop)
    left = [name for index, part in enumerate(counted.parts) if index not in taken for name in part.edges]
    if left:
        raise UsageError(f"{', '.join(left)} are in no loop of the order; every loop of the mechanism must be named")
    return counted.decomposition(tuple(loops))


def _as_loop(
    parts: Sequence[LoopBranch], taken: frozenset[int], stated: frozenset[int], number: int
) -> tuple[int, ...]:
    for loop in next_loops(parts, taken, stated):
        if len(loop) == len(stated):
            return loop
    names = ", ".join(name for index in sorted(stated) for name in parts[index].edges)
    raise UsageError(
        f"loop {number} of the order ({names}) does not add exactly one loop to those before it",
        hint="name only the joints that a loop adds; they must run as one chain between links that are already there",
    )


class _Counted:
    """Freedoms, inputs and ranks of sets of branches; a rank is computed once for each set."""

    def __init__(self, edges: Sequence[Edge], internal: FloatArray | None) -> None:
        self.parts = branches(edges)
        self._place = {edge.name: edge for edge in edges}
        self._internal = internal
        self._owner = np.array([edge.name for edge in edges for _ in range(edge.freedoms)])  # (c,)
        self._chains = [_in_series(part, self._place) for part in self.parts]
        self._sums = [_sums(part, self._place) for part in self.parts]
        self._ranks: dict[frozenset[int], int] = {frozenset(): 0}
        self._internal_ranks: dict[frozenset[int], int] = {frozenset(): 0}

    def rank(self, taken: frozenset[int]) -> int:
        """Rank of the closure of a set of branches."""
        if taken not in self._ranks:
            self._ranks[taken] = rank(closure([self._chains[index] for index in sorted(taken)]))
        return self._ranks[taken]

    def left(self, taken: frozenset[int]) -> int:
        """D of a set of branches, the running sum of Δ_j."""
        free = sum(self._sums[index][0] - self._sums[index][1] for index in taken)
        return free - self.internal(taken) - self.rank(taken)

    def internal(self, taken: frozenset[int]) -> int:
        """How many ways internal motions move a set of branches."""
        if self._internal is None:
            return 0
        if taken not in self._internal_ranks:
            names = [name for index in taken for name in self.parts[index].edges]
            self._internal_ranks[taken] = rank(self._internal[:, np.isin(self._owner, names)], scale=1.0)
        return self._internal_ranks[taken]

    def decomposition(self, order: Sequence[tuple[int, ...]]) -> Decomposition:
        """The loops and Assur chains of an order."""
        taken: frozenset[int] = frozenset()
        loops = []
        for part in order:
            after = taken | set(part)
            loops.append(
                Loop(
                    joints=names_along(self.parts, taken, part),
                    freedoms=sum(self._sums[index][0] for index in part),
                    inputs=sum(self._sums[index][1] for index in part),
                    xi=self.rank(after) - self.rank(taken),
                    internal=self.internal(after) - self.internal(taken),
                )
            )
            taken = after
        return Decomposition(tuple(loops), _assur_chains([loop.delta for loop in loops]))

    def indices(self, names: Iterable[str]) -> frozenset[int]:
        """The branches that some edges make up; whole ones only."""
        stated = set(names)
        for name in stated - set(self._place):
            raise UnknownNameError("joint", name, self._place)
        whole = frozenset(index for index, part in enumerate(self.parts) if stated.issuperset(part.edges))
        broken = stated - {name for index in whole for name in self.parts[index].edges}
        if broken:
            raise UsageError(
                f"{', '.join(sorted(broken))}: part of a chain of joints, or in no loop; a loop takes whole chains",
                hint=f"the chains are {'; '.join(' '.join(part.edges) for part in self.parts)}",
            )
        return whole


def _in_series(part: LoopBranch, place: Mapping[str, Edge]) -> Edge:
    """A branch as one edge, from its start to its end."""
    reached, columns = part.start, []
    for name in part.edges:
        edge = place[name]
        forward = edge.parent == reached
        columns.append(edge.twists if forward else -edge.twists)
        reached = edge.child if forward else edge.parent
    return Edge(part.edges[0], part.start, part.end, np.concatenate(columns, axis=-1))


def _sums(part: LoopBranch, place: Mapping[str, Edge]) -> tuple[int, int]:
    """Freedoms and inputs of a branch."""
    return sum(place[name].freedoms for name in part.edges), sum(len(place[name].inputs) for name in part.edges)


Key = tuple[int, int, tuple[tuple[int, tuple[int, ...]], ...]]
"""What is least: Σ|Δ_j|, loops that end no Assur chain, then branches of each loop, few and first-named ones first."""


def _least_coupled(counted: _Counted, limit: int) -> tuple[tuple[int, ...], ...]:
    """The best order, by Dijkstra's search over sets of branches; every loop lengthens the key of a set."""
    start: tuple[Key, frozenset[int]] = ((0, 0, ()), frozenset())
    waiting = [start]
    best: dict[frozenset[int], Key] = {start[1]: start[0]}
    everything = frozenset(range(len(counted.parts)))
    while True:
        key, taken = heappop(waiting)
        if taken == everything:
            return tuple(loop for _, loop in key[2])
        if key > best[taken]:
            continue
        before = counted.left(taken)
        for loop in next_loops(counted.parts, taken):
            after = taken | set(loop)
            left = counted.left(after)
            longer = (key[0] + abs(left - before), key[1] + (left != 0), (*key[2], (len(loop), loop)))
            if after not in best or longer < best[after]:
                best[after] = longer
                heappush(waiting, (longer, after))
            if len(best) > limit:
                raise UsageError(
                    f"coupling degree: more than {limit} sets of loops among {len(counted.parts)} chains of joints",
                    hint="count parallelograms as one joint each, or give the order of loops",
                )


def _assur_chains(deltas: Sequence[int]) -> tuple[AssurChain, ...]:
    """The shortest runs of loops from the first whose constraint degrees add up to zero."""
    chains = []
    first = 0
    for end in range(1, len(deltas) + 1):
        run = deltas[first:end]
        if sum(run) == 0:
            chains.append(AssurChain(tuple(range(first, end)), sum(map(abs, run)) // 2))
            first = end
    return tuple(chains)
