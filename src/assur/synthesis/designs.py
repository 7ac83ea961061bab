"""A mechanism that was found: its limbs in their positions, and what makes it good or bad."""

from __future__ import annotations

from dataclasses import dataclass

from assur.model.topology_description import Mode
from assur.results.answers.solution_order import Loop
from assur.results.answers.topology import RedundantConstraints
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.limbs import JOINT_KINDS
from assur.topology.chains import Chain
from assur.topology.counting.coupling import Decomposition
from assur.topology.counting.decoupling import Decoupling
from assur.topology.facts import Known

PARALLELOGRAM_REDUNDANT = 3
"""Redundant constraints of a planar loop of four R by itself, 6 - 3."""

_COUNTS = ("no", "one", "two", "three", "four", "five", "six")


@dataclass(frozen=True)
class DeterminingSet:
    """Some of redundant drives that determine a mechanism.

    Attributes:
        drives: their indices among all of them.
        coupling_degree: κ with these drives.
    """

    drives: tuple[int, ...]
    coupling_degree: int


def least(some: DeterminingSet) -> int:
    """By which sets of drives are compared: the κ that they need."""
    return some.coupling_degree


@dataclass(frozen=True, eq=False)
class Design:
    """A mechanism with the required motion, confirmed by both routes.

    Attributes:
        limbs: one beside the other.
        places: the position of each.
        chains: the limbs as they stand, joints named through the mechanism.
        known: the platform's POC set, and by which routes.
        loops: in the order that attains the coupling degree, by the redundant drives that need the least.
        decoupling: which output depends on which drive, where the platform goes; none with redundant drives.
        dof: F of Eq. (3), all of it the platform's.
        mode: "translation" where the limbs keep the platform from turning only once it does not turn, else "home".
        names: known mechanisms with the same limbs.
        row: of the motions with the name that was asked for, which one it has; empty where there is one.
        determining: the sets of redundant drives that determine it; none where drives are not redundant.
    """

    limbs: tuple[CandidateLimb, ...]
    places: tuple[int, ...]
    chains: tuple[Chain, ...]
    known: Known
    loops: Decomposition
    decoupling: Decoupling | None
    dof: int
    mode: Mode
    names: tuple[str, ...] = ()
    row: str = ""
    determining: tuple[DeterminingSet, ...] = ()

    @property
    def coupling_degree(self) -> int:
        """κ of Eq. (6); with redundant drives, the least that some of them need."""
        return self.loops.coupling_degree or 0

    @property
    def xi(self) -> tuple[int, ...]:
        """ξ of each loop, Eq. (4)."""
        return tuple(loop.xi for loop in self.loops.loops)

    @property
    def joints(self) -> int:
        """Joints; a U and a P(4R) count as one."""
        return sum(limb.type.joints for limb in self.limbs)

    @property
    def parallelograms(self) -> int:
        """Number of parallelograms."""
        return sum(limb.type.parallelograms for limb in self.limbs)

    @property
    def redundant(self) -> RedundantConstraints:
        """Redundant constraints, with a P(4R) as one joint and with its four R."""
        collapsed = sum(loop.redundant_constraints for loop in self.loops.loops)
        inside = PARALLELOGRAM_REDUNDANT * sum(limb.type.hinged for limb in self.limbs)
        return RedundantConstraints(collapsed, collapsed + inside)

    @property
    def zeros(self) -> int:
        """How many pairs of an output and a drive have nothing to do with each other."""
        return sum(not used for row in self.decoupling.depends for used in row) if self.decoupling else 0

    @property
    def drives_on_base(self) -> int:
        """Number of driven joints that stand on the base."""
        return sum(place in limb.type.on_base for limb in self.limbs for place in limb.type.driven)

    @property
    def passive_slides(self) -> int:
        """Number of P and C along which nothing drives; a parallelogram is none."""
        return sum(limb.type.passive_slides for limb in self.limbs)

    @property
    def joint_kinds(self) -> tuple[str, ...]:
        """Kinds of its joints, in the order of the notation."""
        used = {kind for limb in self.limbs for kind in limb.type.joint_kinds}
        return tuple(kind for kind in JOINT_KINDS if kind in used)

    @property
    def symmetric(self) -> bool:
        """Whether all limbs are of one type."""
        return self.kinds == 1

    @property
    def kinds(self) -> int:
        """Number of different limb types."""
        return len({limb.type.key for limb in self.limbs})

    @property
    def actuated(self) -> tuple[tuple[int, int], ...]:
        """(limb, joint) of the driven joints, both counted from 1."""
        return tuple((number, place + 1) for number, limb in enumerate(self.limbs, 1) for place in limb.type.driven)

    @property
    def order(self) -> tuple[int, int, int, int, int, tuple[str, ...]]:
        """The rank: κ, redundant constraints, joints; then simplicity: P(4R), kinds of limbs, text."""
        texts = tuple(limb.text for limb in self.limbs)
        return (self.coupling_degree, self.redundant.collapsed, self.joints, self.parallelograms, self.kinds, texts)

    @property
    def reason(self) -> str:
        """Why it stands where it stands, in one sentence without a full stop."""
        first, degree, surplus = self.loops.loops[0], self.coupling_degree, self.redundant.collapsed
        virtual = f"{_COUNTS[degree]} virtual variable{'' if degree == 1 else 's'}"
        coupled = f"{virtual}, for {self._closing(first)} with Δ = {first.delta and f'{first.delta:+d}'}"
        exact = f"{surplus or 'no'} constraint{'s are' if surplus > 1 else ' is'} redundant"
        equal = f"{_COUNTS[len(self.limbs)]} equal limbs" if self.symmetric else f"{_COUNTS[self.kinds]} kinds of limbs"
        if self.determining:
            drives = min(self.determining, key=least).drives
            numbers = ", ".join("{}.{}".format(*self.actuated[index]) for index in drives)
            coupled += f", by the drives {numbers}, one of {len(self.determining)} sets that determine it"
        turning = "; the platform keeps its orientation in one operation mode, and may turn in others"
        modes = turning if self.mode == "translation" else ""
        return f"{coupled}; ξ = {', '.join(map(str, self.xi))}, so {exact}; {self.joints} joints in {equal}{modes}"

    def _closing(self, loop: Loop) -> str:
        """Which limbs close a loop.

        Its edges are joints, or called "limb 1", or "limb 1, branch 2" in a limb with an inner loop.
        """
        of_joint = {joint.name: f"{number}" for number, chain in enumerate(self.chains, 1) for joint in chain.joints}
        numbers = (of_joint.get(edge, edge.removeprefix("limb ").partition(",")[0]) for edge in loop.joints)
        limbs = list(dict.fromkeys(numbers))
        if len(limbs) == 1:
            return f"the inner loop of limb {limbs[0]} closes"
        return f"limbs {' and '.join(limbs)} close a loop"
