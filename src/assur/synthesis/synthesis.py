"""First type synthesis: every mechanism of bounded size that has a wanted motion, without doubles, ranked."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import get_args

from assur.errors import UnknownNameError, UsageError
from assur.synthesis.assembly import Tally, assemble, classes
from assur.synthesis.designs import Design
from assur.synthesis.isomorphism import mechanism_key
from assur.synthesis.known_mechanisms import known_mechanisms
from assur.synthesis.limb_motions import Limb, verdict
from assur.synthesis.limbs import Actuators, limb_types
from assur.synthesis.positions import positions
from assur.synthesis.wanted import WantedMotion, motion_named
from assur.topology.agreement import RoutesDisagreeError

Step = Callable[[int, int], None]

LARGEST = 99
"""No coupling degree is larger."""


@dataclass(frozen=True, eq=False)
class Synthesis:
    """What was found.

    Attributes:
        motion: that was wanted.
        limbs: limb types that have it, the simplest first in each class of equal motion.
        left_out: limb types that have not, by the reason.
        tally: of the combinations.
        designs: the mechanisms, best first.
    """

    motion: WantedMotion
    limbs: tuple[Limb, ...]
    left_out: Counter[str]
    tally: Tally
    designs: tuple[Design, ...]


def synthesis(
    motion: str = "3T",
    limbs: int | None = None,
    max_joints: int = 5,
    coupling: tuple[int, int] = (0, LARGEST),
    *,
    symmetric: bool = False,
    actuators: Actuators = "base",
    step: Step = lambda done, total: None,
) -> Synthesis:
    """Mechanisms with a wanted motion, each confirmed by rules and by twists.

    Limbs are series of R, P, C, U and P(4R) with axes parallel or perpendicular to each other, and S in limbs that
    constrain nothing; U counts as one joint. Every limb has one actuator, so there are as many limbs as freedoms.

    Args:
        motion: "3T", "3T1R" or "2T1R"; T counts translations, R rotations (about z).
        limbs: number of limbs, by default the number of freedoms.
        max_joints: of a limb.
        coupling: least and largest coupling degree, Eq. (6).
        symmetric: only mechanisms of equal limbs. Without it, also the simplest of those with different limbs.
        actuators: "base" where the first joint of each limb is driven (R, P or the translation of C), "leg" where it is
            the first P between two joints that turn.
        step: called with (steps done, steps in all).

    Errors:
        UnknownNameError: another motion. UsageError: another number of limbs, or an empty range.
        RoutesDisagreeError: rules and twists differ; the message names every chain.

    Example:
        >>> found = synthesis("3T", max_joints=3, symmetric=True)
        >>> [design.names for design in found.designs if "three_crr" in design.names]
        [('three_crr',)]
    """
    wanted = _checked(motion, limbs, max_joints, coupling, actuators)
    types = list(limb_types(wanted, max_joints, actuators))
    turns = positions(wanted, wanted.dim)
    verdicts = []
    for done, limb in enumerate(types):
        step(done, 2 * len(types))
        verdicts.append(verdict(limb, wanted, turns))
    usable = classes([item.limb for item in verdicts if item.limb])
    tally = Tally(disagreements=[item.disagreement for item in verdicts if item.disagreement])
    designs: list[Design] = []
    chosen = list(combinations_with_replacement(usable, wanted.dim))
    for done, some in enumerate(chosen):
        step(len(chosen) + done, 2 * len(chosen))
        if not symmetric or len({id(members) for members in some}) == 1:
            designs += assemble(some, wanted, coupling, symmetric, tally)
    if tally.disagreements:
        raise RoutesDisagreeError("; ".join(tally.disagreements), hint="assur has an error; please report these chains")
    return Synthesis(
        motion=wanted,
        limbs=tuple(limb for members in usable for limb in members),
        left_out=Counter(item.reason for item in verdicts if item.reason),
        tally=tally,
        designs=_named(sorted(designs, key=lambda design: design.order), wanted),
    )


def _checked(
    motion: str, limbs: int | None, max_joints: int, coupling: tuple[int, int], actuators: str
) -> WantedMotion:
    wanted = motion_named(motion)
    if limbs is not None and limbs != wanted.dim:
        raise UsageError(
            f"{limbs} limbs for {wanted.name}; {wanted.dim} are wanted, one actuator in each",
            hint=f"--limbs {wanted.dim}, or leave it out",
        )
    if max_joints < 1:
        raise UsageError(f"at most {max_joints} joints in a limb; allowed: 1 or more", hint="5 finds all known ones")
    if not 0 <= coupling[0] <= coupling[1]:
        raise UsageError(f"coupling degree {coupling[0]}..{coupling[1]}: no such degree", hint="give it as 0..1")
    if actuators not in get_args(Actuators):
        raise UnknownNameError("place of the actuators", actuators, get_args(Actuators))
    return wanted


def _named(designs: list[Design], motion: WantedMotion) -> tuple[Design, ...]:
    """The designs with the names of known mechanisms that have the same limbs."""
    known = known_mechanisms(motion)
    keys = [mechanism_key(limb.type.key for limb in design.limbs) for design in designs]
    return tuple(
        dataclasses.replace(design, names=known.get(key, ())) for design, key in zip(designs, keys, strict=True)
    )
