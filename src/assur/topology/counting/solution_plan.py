"""What the coupling degree means for the direct problem: which loop first, what is assumed, what is searched.

An Assur chain with coupling degree kappa takes kappa virtual variables, assumed in the loops with positive
constraint degree and found by a search on the equations of the loops with negative one. A special constraint
may give them before any loop is solved (the paper's step from Eq. (6) to Eq. (7)); see `special_constraints`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.results.answers.solution_order import AssurChain, AssurPlan, Loop, PlanStep
from assur.results.plain_text import count
from assur.topology.counting.actuation import locked_freedoms
from assur.topology.counting.coupling import Decomposition
from assur.topology.counting.special_constraints import SpecialConstraint, connected, special_constraints, way_to
from assur.topology.screws.edges import Edge, along, at_generic, closure, input_columns, null_basis, rank

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class SolutionPlan:
    """The order in which the direct problem is solved, Assur chain by Assur chain.

    `free` is how many freedoms the mechanism has left, beyond internal ones, when the inputs are locked; unless it is 0
    there is no plan. Nor is there one of a shaky mechanism, of which `shaky` says why. `drives`: of redundant inputs
    those by which it is planned; the others follow.
    """

    parts: tuple[AssurPlan, ...]
    free: int = 0
    shaky: str = ""
    drives: tuple[str, ...] = ()

    @property
    def search(self) -> int | None:
        """The largest dimension of a search that is left, 0 if every loop is solved in turn; None without a plan."""
        return None if self.refusal else max((part.search for part in self.parts), default=0)

    @property
    def refusal(self) -> str:
        """Why there is no plan and no coupling degree; empty where there are both."""
        if self.shaky or not self.free:
            return self.shaky
        left = "1 freedom" if self.free == 1 else f"{self.free} freedoms"
        return f"with all inputs locked the mechanism has {left} left"

    @property
    def words(self) -> tuple[str, ...]:
        """The plan in sentences."""
        if self.shaky:
            return (f"No order of loops is told: {self.shaky}.",)
        if self.free:
            return (f"These inputs determine no solution: {self.refusal}.",)
        parts = enumerate(self.parts, 1)
        lines = [line for number, part in parts for line in _sentences(part, number, len(self.parts))]
        first = f"By {', '.join(self.drives)} alone; the other inputs follow."
        return (first, *lines) if self.drives else tuple(lines)


def solution_plan(decomposition: Decomposition, edges: Sequence[Edge], base: str, platform: str) -> SolutionPlan:
    """The plan for the order of loops that attains the coupling degree.

    Args:
        decomposition: loops and Assur chains, from `assur.topology.counting.coupling`.
        edges: those it was made of, with twists at generic configurations.
        base: a link.
        platform: a link.
    """
    edges = at_generic(edges)
    free = locked_freedoms(edges, input_columns(edges), base, platform) if decomposition.loops else 0
    if free:
        return SolutionPlan((), free)
    stages = _stages(decomposition.loops, edges, base, platform)
    known = special_constraints(edges, base, platform) if decomposition.coupling_degree else ()
    return SolutionPlan(tuple(_plan(chain, decomposition.loops, stages, known) for chain in decomposition.assur_chains))


@dataclass(frozen=True, eq=False)
class _Stage:
    """The loops that are solved after some step, inputs locked, and the ways from them to base and platform.

    Attributes:
        equations: (N, r, c) on the rates of their joints and of those on the ways.
        moves: (N, 6, c) the platform's twist; (N, 0, c) where base or platform is out of reach.
        inside: how many columns are of the loops.
        internal: internal freedoms of the loops.
    """

    equations: FloatArray
    moves: FloatArray
    inside: int
    internal: int

    def unknowns(self, known: Sequence[SpecialConstraint]) -> int:
        """Freedoms of the loops that special constraints leave."""
        rows = [constraint.rows @ self.moves for constraint in known if self.moves.shape[1]]
        free = null_basis(np.concatenate([self.equations, *rows], axis=1))
        return rank(free[:, : self.inside], scale=1.0) - self.internal


def _stages(loops: Sequence[Loop], edges: Sequence[Edge], base: str, platform: str) -> list[_Stage]:
    place = {edge.name: edge for edge in edges}
    solved: list[Edge] = []
    internal = 0
    stages = []
    for loop in loops:
        solved += [place[name] for name in loop.joints]
        internal += loop.internal
        stages.append(_stage(solved, internal, edges, base, platform))
    return stages


def _stage(solved: Sequence[Edge], internal: int, edges: Sequence[Edge], base: str, platform: str) -> _Stage:
    links = list(dict.fromkeys(link for edge in solved for link in (edge.parent, edge.child)))
    used = [*solved, *way_to(base, links, edges, platform)]
    used += [edge for edge in way_to(platform, connected(used, base), edges, base) if edge not in used]
    matrix = closure(used)
    locked = np.eye(matrix.shape[-1])[input_columns(used)]
    reached = platform in connected(used, base)
    return _Stage(
        equations=np.concatenate([matrix, np.broadcast_to(locked, (len(matrix), *locked.shape))], axis=1),
        moves=along(used, base, platform) if reached else matrix[:, :0],
        inside=sum(edge.freedoms for edge in solved),
        internal=internal,
    )


def _plan(
    chain: AssurChain, loops: Sequence[Loop], stages: Sequence[_Stage], known: Sequence[SpecialConstraint]
) -> AssurPlan:
    """The plan of one Assur chain, with no more special constraints than give the least search."""
    own_stages = [stages[index] for index in chain.loops]
    used = list(known) if _searched(own_stages, known)[0] < chain.coupling_degree else []
    least = _searched(own_stages, used)[0]
    for constraint in used[::-1]:
        fewer = [other for other in used if other is not constraint]
        if _searched(own_stages, fewer)[0] == least:
            used = fewer
    search, left = _searched(own_stages, used)
    steps = [
        PlanStep(index, loops[index].joints, delta, max(delta, 0), max(-delta, 0), assumed)
        for index, assumed in zip(chain.loops, left, strict=True)
        for delta in [loops[index].delta]
    ]
    return AssurPlan(tuple(steps), chain.coupling_degree, search, " and ".join(constraint.words for constraint in used))


def _searched(stages: Sequence[_Stage], known: Sequence[SpecialConstraint]) -> tuple[int, list[int]]:
    """How many variables are searched at a time, and how many each loop adds, with some special constraints.

    Loops that leave no freedom end a search, as Assur chains end without special constraints.
    """
    before = together = most = 0
    added = []
    for stage in stages:
        now = stage.unknowns(known)
        added.append(max(now - before, 0))
        together += added[-1]
        most = max(most, together)
        before, together = now, together if now else 0
    return most, added


def _sentences(part: AssurPlan, number: int, of: int) -> list[str]:
    head = f"Assur chain {number}: " if of > 1 else ""
    return [*(f"{head}{_said(step, part, number)}" for step in part.steps), f"{head}{_conclusion(part)}"]


def _said(step: PlanStep, part: AssurPlan, number: int) -> str:
    """What one loop is for."""
    if step.virtual:
        does = f"takes {count(step.virtual, 'virtual variable')}"
    elif step.equations:
        does = f"gives {count(step.equations, 'equation')} for what was assumed"
    elif part.coupling_degree:
        does = "is solved in terms of what was assumed"
    else:
        does = "is solved by itself" if number == 1 else "is solved from what is known by then"
    if step.left > step.virtual:
        does += f", and {step.left - step.virtual} of its own must be assumed once special constraints are used"
    delta = f"{step.delta:+d}" if step.delta else "0"
    return f"loop {step.loop + 1} ({', '.join(step.joints)}), Δ = {delta}, {does}."


def _conclusion(part: AssurPlan) -> str:
    """What remains to be searched."""
    head = f"κ = {part.coupling_degree}"
    if not part.coupling_degree:
        return f"{head}: no search."
    least = f"at most a search in {count(part.search, 'dimension')}"
    if not part.reason:
        return f"{head}: {least}."
    if part.search:
        return f"{head}, but {part.reason}, which leaves {count(part.search, 'virtual variable')}: {least}."
    given = "the virtual variable" if part.coupling_degree == 1 else f"all {part.coupling_degree} virtual variables"
    return f"{head}, but {part.reason}, which gives {given}: no search is needed."
