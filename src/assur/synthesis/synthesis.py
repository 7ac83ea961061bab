"""First type synthesis: every mechanism of bounded size that has a wanted motion, without doubles, ranked."""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import get_args

from assur.errors import Interrupted, UnknownNameError, UsageError
from assur.synthesis.assembly import DesignsOfClasses, Range, assemble
from assur.synthesis.classes import Class, are_equal, classes
from assur.synthesis.designs import Design
from assur.synthesis.isomorphism import mechanism_key
from assur.synthesis.known_mechanisms import known_mechanisms
from assur.synthesis.limb_motions import CandidateLimb, LimbVerdict, verdict
from assur.synthesis.limbs import Actuators, limb_types
from assur.synthesis.positions import positions
from assur.synthesis.required import RequiredMotion, motion_named
from assur.synthesis.tally import Tally, total
from assur.topology.agreement import RoutesDisagreeError

Step = Callable[[int, int], None]
"""Called with (steps done, steps in all)."""

ANY = (0, 99)
"""Every coupling degree."""


class TooManyError(UsageError):
    """More combinations than are looked at unasked."""


@dataclass(frozen=True)
class SynthesisQuestion:
    """What was asked for; see `synthesis`."""

    motion: RequiredMotion
    max_joints: int
    coupling: tuple[int, int]
    symmetric: bool
    actuators: Actuators

    @property
    def limbs(self) -> int:
        """Number of limbs: one actuator in each."""
        return self.motion.dim


@dataclass(frozen=True, eq=False)
class Synthesis:
    """What was found.

    Attributes:
        asked: the question.
        limbs: limb types that have the motion, the simplest first in each class of equal motion.
        left_out: number of limb types that have not, by the reason.
        tally: of the combinations.
        designs: the mechanisms, best first.
    """

    asked: SynthesisQuestion
    limbs: tuple[CandidateLimb, ...]
    left_out: Counter[str]
    tally: Tally
    designs: tuple[Design, ...]


def ignored(done: int, whole: int) -> None:
    """A step that nobody counts."""


def synthesis(
    motion: str = "3T",
    limbs: int | None = None,
    max_joints: int = 5,
    coupling: tuple[int, int] = ANY,
    *,
    symmetric: bool = False,
    actuators: Actuators = "base",
    step: Step = ignored,
    most: int | None = None,
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
        most: combinations at most; any number where None.

    Errors:
        UnknownNameError: another motion. UsageError: another number of limbs, an empty range, or more combinations.
        Interrupted: Ctrl-C; its answer is what was found so far.
        RoutesDisagreeError: rules and twists differ; the message names every chain.

    Example:
        >>> found = synthesis("3T", max_joints=3, symmetric=True)
        >>> [design.names for design in found.designs if "three_crr" in design.names]
        [('three_crr',)]
    """
    asked = _question(motion, limbs, max_joints, coupling, symmetric, actuators)
    usable, left_out, disagreements = _limbs(asked, step)
    classes_of_limbs = classes(usable)
    count = number_of_combinations(len(usable), asked.limbs, symmetric=symmetric)
    if most is not None and count > most:
        raise TooManyError(
            f"{count} combinations of {len(usable)} limb types, and {most} are looked at unasked",
            hint="ask for fewer joints or for equal limbs, or allow more by `most`",
        )
    chosen = [
        some
        for some in combinations_with_replacement(classes_of_limbs, asked.limbs)
        if not symmetric or are_equal(some)
    ]
    parts: list[DesignsOfClasses] = []
    try:
        for done, some in enumerate(chosen):
            step(len(chosen) + done, 2 * len(chosen))
            parts.append(assemble(some, asked.motion, Range(*coupling), symmetric=symmetric))
    except KeyboardInterrupt:
        raise Interrupted(_answer(asked, classes_of_limbs, left_out, parts, disagreements)) from None
    return _answer(asked, classes_of_limbs, left_out, parts, disagreements)


def _answer(
    asked: SynthesisQuestion,
    classes_of_limbs: Sequence[Class],
    left_out: Counter[str],
    parts: Sequence[DesignsOfClasses],
    disagreements: tuple[str, ...],
) -> Synthesis:
    """What was found in the sets of classes that were looked at."""
    tally = total(part.tally for part in parts)
    disagreements += tally.disagreements
    if disagreements:
        raise RoutesDisagreeError("; ".join(disagreements), hint="assur has an error; please report these chains")
    designs = sorted((design for part in parts for design in part.designs), key=lambda design: design.order)
    return Synthesis(
        asked=asked,
        limbs=tuple(limb for members in classes_of_limbs for limb in members),
        left_out=left_out,
        tally=tally,
        designs=_named(designs, asked.motion),
    )


def number_of_combinations(types: int, limbs: int, *, symmetric: bool) -> int:
    """Mechanisms of so many limbs of so many types: their number is told by a formula before one is looked at.

    >>> number_of_combinations(170, 3, symmetric=False), number_of_combinations(170, 3, symmetric=True)
    (833340, 170)
    """
    return types if symmetric else math.comb(types + limbs - 1, limbs) if types else 0


def _question(
    motion: str, limbs: int | None, max_joints: int, coupling: tuple[int, int], symmetric: bool, actuators: Actuators
) -> SynthesisQuestion:
    target = motion_named(motion)
    if limbs is not None and limbs != target.dim:
        raise UsageError(
            f"{limbs} limbs for {target.name}; {target.dim} are wanted, one actuator in each",
            hint=f"give {target.dim}, or leave the number out",
        )
    if max_joints < 1:
        raise UsageError(f"at most {max_joints} joints in a limb; allowed: 1 or more", hint="5 finds all known ones")
    if not 0 <= coupling[0] <= coupling[1]:
        raise UsageError(f"coupling degrees {coupling[0]}..{coupling[1]}: there are none", hint="give them as 0..1")
    if actuators not in get_args(Actuators):
        raise UnknownNameError("place of the actuators", actuators, get_args(Actuators))
    return SynthesisQuestion(target, max_joints, coupling, symmetric, actuators)


def _limbs(asked: SynthesisQuestion, step: Step) -> tuple[list[CandidateLimb], Counter[str], tuple[str, ...]]:
    """Limbs with the motion, how many have it not and why, and those on which the routes disagree."""
    types = limb_types(asked.motion, asked.max_joints, asked.actuators)
    turns = positions(asked.motion, asked.limbs)
    verdicts: list[LimbVerdict] = []
    try:
        for done, limb in enumerate(types):
            step(done, 2 * len(types))
            verdicts.append(verdict(limb, asked.motion, turns))
    except KeyboardInterrupt:
        usable, left_out, _ = _sorted(verdicts)
        raise Interrupted(_answer(asked, classes(usable), left_out, (), ())) from None
    return _sorted(verdicts)


def _sorted(verdicts: Sequence[LimbVerdict]) -> tuple[list[CandidateLimb], Counter[str], tuple[str, ...]]:
    """Verdicts by what they say."""
    return (
        [verdict.limb for verdict in verdicts if verdict.limb],
        Counter(verdict.reason for verdict in verdicts if verdict.reason),
        tuple(verdict.disagreement for verdict in verdicts if verdict.disagreement),
    )


def _named(designs: list[Design], motion: RequiredMotion) -> tuple[Design, ...]:
    """The designs with the names of known mechanisms that have the same limbs."""
    known = known_mechanisms(motion)
    keys = [mechanism_key(limb.type.key for limb in design.limbs) for design in designs]
    return tuple(
        dataclasses.replace(design, names=known.get(key, ())) for design, key in zip(designs, keys, strict=True)
    )
