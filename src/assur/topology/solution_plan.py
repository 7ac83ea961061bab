"""What the coupling degree means for the direct problem: which loop first, what is assumed, what is searched.

An Assur chain with coupling degree kappa takes kappa virtual variables, assumed in the loops with positive
constraint degree and found by a search on the equations of the loops with negative one. A special constraint
removes the search where the platform can never move in some directions: that is known beforehand, and may leave
the first loops nothing to assume (the paper's step from Eq. (6) to Eq. (7)).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.topology.coupling import Decomposition, Loop
from assur.topology.edges import Edge, along, at_generic, closure, graph, input_columns, null_basis, rank

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Step:
    """One loop of the plan.

    Attributes:
        loop: its index in the order of solution.
        joints: its joints in order.
        delta: its constraint degree, Eq. (5).
        virtual: virtual variables that are assumed here.
        equations: equations for virtual variables that it gives.
        left: virtual variables that still must be assumed here once the platform's fixed directions are used.
    """

    loop: int
    joints: tuple[str, ...]
    delta: int
    virtual: int
    equations: int
    left: int


@dataclass(frozen=True)
class AssurPlan:
    """The plan of one Assur chain: `coupling_degree` virtual variables, `search` of them found by a search."""

    steps: tuple[Step, ...]
    coupling_degree: int
    search: int
    reason: str = ""


@dataclass(frozen=True)
class SolutionPlan:
    """The order in which the direct problem is solved, Assur chain by Assur chain."""

    parts: tuple[AssurPlan, ...]

    @property
    def search(self) -> int:
        """The largest dimension of a search that is left; 0 means every loop is solved in turn."""
        return max((part.search for part in self.parts), default=0)

    @property
    def words(self) -> tuple[str, ...]:
        """The plan in sentences."""
        return tuple(
            line for number, part in enumerate(self.parts, 1) for line in _sentences(part, number, len(self.parts))
        )


def solution_plan(decomposition: Decomposition, edges: Sequence[Edge], base: str, platform: str) -> SolutionPlan:
    """The plan for the order of loops that attains the coupling degree.

    Args:
        decomposition: loops and Assur chains, from `assur.topology.coupling`.
        edges: those it was made of, with twists at generic configurations.
        base: a link.
        platform: a link.
    """
    edges = at_generic(edges)
    blocked = _blocked(edges, base, platform)
    place = {edge.name: edge for edge in edges}
    solved: list[str] = []
    before = 0
    parts = []
    for chain in decomposition.assur_chains:
        steps = []
        for index in chain.loops:
            loop = decomposition.loops[index]
            solved += loop.edges
            free = _unknowns([place[name] for name in solved], edges, base, platform, blocked)
            steps.append(_step(index, loop, max(free - before, 0)))
            before = free
        search = sum(step.left for step in steps)
        reason = "" if search == chain.coupling_degree else _reason(blocked)
        parts.append(AssurPlan(tuple(steps), chain.coupling_degree, search, reason))
    return SolutionPlan(tuple(parts))


def _step(index: int, loop: Loop, left: int) -> Step:
    virtual = max(loop.delta, 0)
    return Step(index, loop.edges, loop.delta, virtual, max(-loop.delta, 0), min(left, virtual))


@dataclass(frozen=True, eq=False)
class _Blocked:
    """Directions (k, 3) in the base in which the platform never turns, and in which O' never moves."""

    rotations: FloatArray
    translations: FloatArray


def _blocked(edges: Sequence[Edge], base: str, platform: str) -> _Blocked:
    """What is blocked at every configuration, by the platform's motion spaces taken together."""
    free = null_basis(closure(edges))
    moves = along(edges, base, platform) @ free  # (N, 6, k)
    turned = np.concatenate(list(moves[:, :3]), axis=1)
    moved = np.concatenate(list(moves[:, 3:]), axis=1)
    return _Blocked(_never(turned), _never(moved))


def _never(directions: FloatArray) -> FloatArray:
    """Orthonormal rows (k, 3) perpendicular to all columns of directions (3, m)."""
    left, singular, _ = np.linalg.svd(directions)
    used = int(np.sum(singular > 1e-7))
    rows: FloatArray = left[:, used:].T
    return rows


def _unknowns(solved: Sequence[Edge], edges: Sequence[Edge], base: str, platform: str, blocked: _Blocked) -> int:
    """Freedoms left in the loops solved so far, with inputs locked and the platform's blocked directions used."""
    tail = _tail(solved, edges, base, platform)
    used = [*solved, *(edge for edge in edges if edge.name in tail)]
    matrix = closure(used)
    locked = np.eye(matrix.shape[-1])[input_columns(used)]
    rows = [matrix, np.broadcast_to(locked, (len(matrix), *locked.shape))]
    links = {link for edge in used for link in (edge.parent, edge.child)}
    if {base, platform} <= links:
        moves = along(used, base, platform)
        rows += [blocked.rotations @ moves[:, :3], blocked.translations @ moves[:, 3:]]
    free = null_basis(np.concatenate(rows, axis=1))
    inside = sum(edge.freedoms for edge in solved)
    return rank(free[:, :inside], scale=1.0)


def _tail(solved: Sequence[Edge], edges: Sequence[Edge], base: str, platform: str) -> set[str]:
    """The edges that lead from the solved loops to the platform without passing the base."""
    links = {link for edge in solved for link in (edge.parent, edge.child)} - {base}
    if platform in links:
        return set()
    rest = graph(edge for edge in edges if base not in (edge.parent, edge.child))
    if platform not in rest:
        return set()
    ways = [
        nx.shortest_path(rest, link, platform) for link in links if link in rest and nx.has_path(rest, link, platform)
    ]
    if not ways:
        return set()
    way = min(ways, key=len)
    return {next(iter(rest[here][there])) for here, there in pairwise(way)}


def _reason(blocked: _Blocked) -> str:
    turns, moves = 3 - len(blocked.rotations), 3 - len(blocked.translations)
    if not turns:
        return "the platform does not rotate"
    if turns < 3:
        return f"the platform rotates in {turns} fixed direction{'s' if turns > 1 else ''} only"
    return f"O' moves in {moves} fixed direction{'s' if moves > 1 else ''} only"


def _sentences(part: AssurPlan, number: int, of: int) -> list[str]:
    head = f"Assur chain {number}: " if of > 1 else ""
    lines = []
    for step in part.steps:
        does = "is solved in what was assumed" if part.coupling_degree else "is solved by itself"
        if step.virtual:
            does = f"takes {_count(step.virtual, 'virtual variable')}"
        if step.equations:
            does = f"gives {_count(step.equations, 'equation')} for what was assumed"
        lines.append(f"{head}loop {step.loop + 1} ({', '.join(step.joints)}), Δ = {step.delta:+d}, {does}.")
    if not part.coupling_degree:
        return [*lines, f"{head}κ = 0: no search."]
    if not part.search:
        fixed = ", ".join(f"loop {step.loop + 1}" for step in part.steps if step.virtual)
        return [
            *lines,
            f"{head}κ = {part.coupling_degree}, but {part.reason}, and that fixes {fixed}: no search is needed.",
        ]
    less = f" ({part.reason}, which leaves {part.search} of {part.coupling_degree})" if part.reason else ""
    return [*lines, f"{head}κ = {part.coupling_degree}: a search in {_count(part.search, 'dimension')}{less}."]


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
