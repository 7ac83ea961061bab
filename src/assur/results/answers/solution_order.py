"""The order in which a mechanism is solved: its loops, its Assur chains, and the plan of the direct problem.

As in `assur.results.answers.topology` keys keep their meaning; others may be added.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

Names = tuple[str, ...]


@dataclass(frozen=True)
class Loop:
    """A loop in its place in an order: a single open chain on what is there before it.

    Attributes:
        joints: names in order along the chain.
        freedoms: sum of f_i over the chain.
        inputs: I_j, how many of them are actuated.
        xi: ξ_Lj of Eq. (4), its number of independent equations.
        internal: internal freedoms that move it and no loop before it; any value may be given to them, and they are not
            counted.
    """

    derived: ClassVar = ("delta",)

    joints: Names
    freedoms: int
    inputs: int
    xi: int
    internal: int = 0

    @property
    def delta(self) -> int:
        """Constraint degree Δ_j = Σ f_i - I_j - ξ_Lj, Eq. (5), internal freedoms left out."""
        return self.freedoms - self.internal - self.inputs - self.xi

    @property
    def redundant_constraints(self) -> int:
        """6 - ξ_Lj."""
        return 6 - self.xi


@dataclass(frozen=True)
class AssurChain:
    """Loops (their indices) whose constraint degrees add up to zero, none fewer of them from the first; Eq. (6)."""

    loops: tuple[int, ...]
    coupling_degree: int


@dataclass(frozen=True)
class PlanStep:
    """One loop of the plan.

    Attributes:
        loop: its index in the order of solution.
        joints: its joints in order.
        delta: its constraint degree, Eq. (5).
        virtual: virtual variables that are assumed here.
        equations: equations for virtual variables that it gives.
        left: virtual variables that still must be assumed here once special constraints are used.
    """

    loop: int
    joints: Names
    delta: int
    virtual: int
    equations: int
    left: int


@dataclass(frozen=True)
class AssurPlan:
    """The plan of one Assur chain: of `coupling_degree` virtual variables `search` are found by a search, at most.

    `reason` names the special constraints that make it fewer; empty where none does.
    """

    steps: tuple[PlanStep, ...]
    coupling_degree: int
    search: int
    reason: str = ""


@dataclass(frozen=True)
class PlanAnswer:
    """In which order the direct problem is solved; `search` is null where the inputs leave freedoms."""

    search: int | None
    words: Names
    assur_chains: tuple[AssurPlan, ...]
