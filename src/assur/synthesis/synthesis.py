"""First type synthesis: every mechanism of bounded size that has a wanted motion, without doubles, ranked."""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement
from typing import get_args

from assur.errors import Interrupted, UnknownNameError, UsageError
from assur.synthesis.assembly import MEMBERS, MechanismFamily, Range, Sought, assemble, mechanism
from assur.synthesis.classes import Class, are_equal, classes, number_of_members
from assur.synthesis.designs import Design
from assur.synthesis.isomorphism import Key
from assur.synthesis.known_mechanisms import known_by_directions, known_mechanisms
from assur.synthesis.limb_motions import CandidateLimb, LimbVerdict, verdict
from assur.synthesis.limbs import Actuators, hybrid_types, limb_types
from assur.synthesis.parasitic import arranged_classes, limb_classes, moved
from assur.synthesis.positions import placements, positions
from assur.synthesis.required import PARASITIC, RequiredMotion, motion_named
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
    limbs: int
    max_joints: int
    coupling: tuple[int, int]
    symmetric: bool
    actuators: Actuators
    members: int
    parasitic: bool = False

    @property
    def hybrid(self) -> bool:
        """Whether some limbs begin with an inner loop and have two actuators."""
        return self.limbs < self.motion.dim

    @property
    def by_families(self) -> bool:
        """Whether what is found is told by families, which are many."""
        return self.hybrid or self.parasitic


@dataclass(frozen=True, eq=False)
class Synthesis:
    """What was found.

    Attributes:
        asked: the question.
        limbs: limb types that have the motion, the simplest first in each class of equal motion.
        left_out: number of limb types that have not, by the reason.
        tally: of the combinations.
        families: the mechanisms by the classes of their limbs, the family of the best one first.
    """

    asked: SynthesisQuestion
    limbs: tuple[CandidateLimb, ...]
    left_out: Counter[str]
    tally: Tally
    families: tuple[MechanismFamily, ...]

    @cached_property
    def designs(self) -> tuple[Design, ...]:
        """The mechanisms, best first."""
        every = (design for family in self.families for design in family.designs)
        return tuple(sorted(every, key=lambda design: design.order))


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
    members: int = MEMBERS,
    parasitic: bool = False,
    step: Step = ignored,
    most: int | None = None,
) -> Synthesis:
    """Mechanisms with a wanted motion, each confirmed by rules and by twists.

    Limbs are series of R, P, C, U and parallelograms with axes parallel or perpendicular to each other, and S in limbs
    that constrain nothing; U counts as one joint. A series has one actuator. With fewer limbs than freedoms, limbs
    that begin with an inner loop of a catalogue have two, one in each of its branches.

    Args:
        motion: "3T", "2T1R", "3T1R" or "3T3R"; T counts translations, R rotations (one of them about z).
        limbs: number of limbs, by default the number of freedoms; half of it, rounded up, is the least.
        max_joints: of a limb, on the way through one branch of its inner loop.
        coupling: least and largest coupling degree, Eq. (6).
        symmetric: only mechanisms of equal limbs. Without it, also the simplest of those with different limbs.
        actuators: "base" where the first joint of each limb is driven (R, P or the translation of C), "leg" where it is
            the first P between two joints that turn.
        members: of each family of different limbs so many are listed, the simplest, and known ones.
        parasitic: the motion is that at home, and others come with it: by limbs of three joints at most, whose
            constraints at home leave it, and a finite motion of each mechanism that is listed. One limb more than the
            motion has freedoms is passive, and alone constrains the platform.
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
    asked = question(
        motion,
        limbs,
        max_joints,
        coupling,
        symmetric=symmetric,
        actuators=actuators,
        members=members,
        parasitic=parasitic,
    )
    return searched(asked, step, most)


def searched(
    asked: SynthesisQuestion, step: Step = ignored, most: int | None = None, also: Sequence[Key] = ()
) -> Synthesis:
    """The answer to a question, as `synthesis` gives it.

    Args:
        asked: the question.
        step: called with (steps done, steps in all).
        most: combinations at most.
        also: canonical forms of mechanisms that are listed however many joints they have, as known ones are.

    Errors:
        TooManyError, Interrupted, RoutesDisagreeError: as `synthesis`.
    """
    if asked.parasitic:
        return _parasitic(asked, step, most)
    usable, left_out, disagreements = _limbs(asked, step)
    classes_of_limbs = classes(usable)
    chosen = _sets_of_classes(classes_of_limbs, asked)
    count = sum(map(number_of_members, chosen)) if not asked.symmetric else sum(len(some[0]) for some in chosen)
    _refuse_more(most, count, len(usable))
    sought = Sought(
        asked.motion,
        Range(*asked.coupling),
        placements(asked.motion, asked.limbs),
        asked.symmetric,
        asked.members,
        (*known_mechanisms(asked.motion), *also),
    )
    families: list[MechanismFamily] = []
    try:
        for done, some in enumerate(chosen):
            step(len(chosen) + done, 2 * len(chosen))
            families.append(assemble(some, sought))
    except KeyboardInterrupt:
        raise Interrupted(_answer(asked, classes_of_limbs, left_out, families, disagreements)) from None
    return _answer(asked, classes_of_limbs, left_out, families, disagreements)


def _refuse_more(most: int | None, count: int, types: int) -> None:
    if most is not None and count > most:
        raise TooManyError(
            f"{count} combinations of {types} limb types, and {most} are looked at unasked",
            hint="ask for fewer joints or for equal limbs, or allow more by `most`",
        )


def _parasitic(asked: SynthesisQuestion, step: Step, most: int | None) -> Synthesis:
    """Mechanisms whose motion at home is the one that is asked for."""
    classes_of_limbs = limb_classes(asked.motion, asked.actuators, passive=asked.limbs > asked.motion.dim)
    known = known_by_directions(asked.motion)
    sought = Sought(
        asked.motion, Range(*asked.coupling), (), asked.symmetric, asked.members, [one.key for one in known]
    )
    families: list[MechanismFamily] = []
    try:
        arranged = list(arranged_classes(classes_of_limbs, asked.motion, asked.limbs))
        if asked.symmetric:
            arranged = [one for one in arranged if are_equal(one.chosen)]
        _refuse_more(most, sum(one.members for one in arranged), sum(map(len, classes_of_limbs)))
        for done, one in enumerate(arranged):
            step(done, len(arranged))
            families.append(moved(one, sought))
    except KeyboardInterrupt:
        raise Interrupted(_answer(asked, classes_of_limbs, Counter(), families, ())) from None
    return _answer(asked, classes_of_limbs, Counter(), families, ())


def _sets_of_classes(every: Sequence[Class], asked: SynthesisQuestion) -> list[tuple[Class, ...]]:
    """One class for each limb, with as many drives as the motion has freedoms."""
    return [
        some
        for some in combinations_with_replacement(every, asked.limbs)
        if sum(len(members[0].type.driven) for members in some) == asked.motion.dim
        and (are_equal(some) or not asked.symmetric)
    ]


def _answer(
    asked: SynthesisQuestion,
    classes_of_limbs: Sequence[Class],
    left_out: Counter[str],
    families: Sequence[MechanismFamily],
    disagreements: tuple[str, ...],
) -> Synthesis:
    """What was found in the sets of classes that were looked at."""
    tally = total(family.tally for family in families)
    disagreements += tally.disagreements
    if disagreements:
        raise RoutesDisagreeError("; ".join(disagreements), hint="assur has an error; please report these chains")
    names = _names(asked)
    named = [_named(family, names) for family in families if family.designs]
    return Synthesis(
        asked=asked,
        limbs=tuple(limb for members in classes_of_limbs for limb in members),
        left_out=left_out,
        tally=tally,
        families=tuple(sorted(named, key=lambda family: family.designs[0].order)),
    )


def question(
    motion: str = "3T",
    limbs: int | None = None,
    max_joints: int = 5,
    coupling: tuple[int, int] = ANY,
    *,
    symmetric: bool = False,
    actuators: Actuators = "base",
    members: int = MEMBERS,
    parasitic: bool = False,
) -> SynthesisQuestion:
    """What is asked of a synthesis, by the arguments of `synthesis`.

    Errors:
        UnknownNameError, UsageError: as `synthesis`.
    """
    target = motion_named(motion, among=PARASITIC) if parasitic else motion_named(motion)
    number = target.dim if limbs is None else limbs
    if parasitic and number not in (target.dim, target.dim + 1):
        raise UsageError(
            f"{number} limbs for {target.name} that others come with; each has one drive, and at most one has none",
            hint=f"give {target.dim}, or {target.dim + 1} of which one has no drive",
        )
    least = max(2, math.ceil(target.dim / 2))
    if not parasitic and not least <= number <= target.dim:
        raise UsageError(
            f"{number} limbs for {target.name}; a limb has one actuator, or two with an inner loop",
            hint=f"give {least} to {target.dim}, or leave the number out for {target.dim}",
        )
    if number < target.dim and actuators == "leg":
        raise UsageError(
            f"{number} limbs for {target.name} with actuators in the legs; with inner loops they stand on the base",
            hint=f"leave out the place of the actuators, or ask for {target.dim} limbs",
        )
    if max_joints < 1:
        raise UsageError(f"at most {max_joints} joints in a limb; allowed: 1 or more", hint="5 finds all known ones")
    if not 0 <= coupling[0] <= coupling[1]:
        raise UsageError(f"coupling degrees {coupling[0]}..{coupling[1]}: there are none", hint="give them as 0..1")
    if actuators not in get_args(Actuators):
        raise UnknownNameError("place of the actuators", actuators, get_args(Actuators))
    if members < 1:
        raise UsageError(f"{members} members of each family; one at least")
    return SynthesisQuestion(target, number, max_joints, coupling, symmetric, actuators, members, parasitic)


def _limbs(asked: SynthesisQuestion, step: Step) -> tuple[list[CandidateLimb], Counter[str], tuple[str, ...]]:
    """Limbs with the motion, how many have it not and why, and those on which the routes disagree."""
    types = limb_types(asked.motion, asked.max_joints, asked.actuators)
    if asked.hybrid:
        types += hybrid_types(asked.motion, asked.max_joints)
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


def _names(asked: SynthesisQuestion) -> Callable[[Design], tuple[str, ...]]:
    """What gives the names of known mechanisms with the same limbs; parasitic ones are placed alike, too."""
    if asked.parasitic:
        placed = known_by_directions(asked.motion)
        return lambda design: tuple(one.name for one in placed if one.is_like(design))
    known = known_mechanisms(asked.motion)
    return lambda design: known.get(mechanism(design.limbs), ())


def _named(family: MechanismFamily, names: Callable[[Design], tuple[str, ...]]) -> MechanismFamily:
    designs = (dataclasses.replace(design, names=names(design)) for design in family.designs)
    return dataclasses.replace(family, designs=tuple(designs))
