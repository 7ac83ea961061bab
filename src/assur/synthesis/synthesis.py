"""First type synthesis: every mechanism of bounded size that has a wanted motion, without doubles, ranked."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement

from assur.errors import Interrupted, UsageError
from assur.synthesis.assembly import MEMBERS, MechanismFamily, Range, Sought, assemble, mechanism
from assur.synthesis.classes import Class, are_equal, classes, number_of_members
from assur.synthesis.designs import Design
from assur.synthesis.following_limbs import classes_by_constraints, following_limbs, following_types, sets_of_classes
from assur.synthesis.isomorphism import Key
from assur.synthesis.known_mechanisms import known_by_directions, known_mechanisms
from assur.synthesis.limb_motions import CandidateLimb, LimbVerdict, verdict
from assur.synthesis.limbs import Actuators, hybrid_types, limb_types
from assur.synthesis.parasitic import arranged_classes, limb_classes, moved
from assur.synthesis.positions import placements, positions
from assur.synthesis.question import ANY, SynthesisQuestion, question
from assur.synthesis.tally import Tally, total
from assur.synthesis.virtual_chains import VirtualChain
from assur.topology.agreement import RoutesDisagreeError

Step = Callable[[int, int], None]
"""Called with (steps done, steps in all)."""


class TooManyError(UsageError):
    """More combinations than are looked at unasked."""


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
    idle: bool = False,
    passive_slides: bool = True,
    step: Step = ignored,
    most: int | None = None,
) -> Synthesis:
    """Mechanisms with a wanted motion, each confirmed by twists; by rules, too, where places make no difference.

    Limbs are series of R, P, C, U and parallelograms with axes parallel or perpendicular to each other, and S in limbs
    that constrain nothing; U counts as one joint. A series has one actuator. With fewer limbs than freedoms, limbs
    that begin with an inner loop of a catalogue have two, one in each of its branches.

    Args:
        motion: "3T", "2T1R", "3T1R" or "3T3R"; T counts translations, R rotations (one of them about z). Or one of
            `virtual_chains`, as "1T2R" for all of its rows and "1T2R:UP" for one.
        limbs: number of limbs, by default the number of freedoms; half of it, rounded up, is the least.
        max_joints: of a limb, on the way through one branch of its inner loop.
        coupling: least and largest coupling degree, Eq. (6).
        symmetric: only mechanisms of equal limbs. Without it, also the simplest of those with different limbs.
        actuators: "base" where the first joint of each limb is driven (R, P or the translation of C), "leg" where it is
            the first P between two joints that turn, "any" for any one R, P or C.
        members: of each family of different limbs so many are listed, the simplest, and known ones.
        parasitic: the motion is that at home, and others come with it: by limbs of three joints at most, whose
            constraints at home leave it, and a finite motion of each mechanism that is listed. One limb more than the
            motion has freedoms is passive, and alone constrains the platform.
        passive_slides: whether limbs may have P that nothing drives.
        idle: whether limbs that follow a virtual chain may have one R that stays at rest.
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
        idle=idle,
        passive_slides=passive_slides,
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
    if asked.rows:
        return _with_points(asked, step, most, also)
    usable, left_out, disagreements = _limbs(asked, step)
    classes_of_limbs = classes(usable)
    chosen = _sets_of_classes(classes_of_limbs, asked)
    _refuse_more(most, _combinations(chosen, asked), len(usable))
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


def _combinations(chosen: Sequence[tuple[Class, ...]], asked: SynthesisQuestion) -> int:
    return sum(len(some[0]) if asked.symmetric else number_of_members(some) for some in chosen)


def _refuse_more(most: int | None, count: int, types: int) -> None:
    if most is not None and count > most:
        raise TooManyError(
            f"{count} combinations of {types} limb types, and {most} are looked at unasked",
            hint="ask for fewer joints or for equal limbs, or allow more by `most`",
        )


def _parasitic(asked: SynthesisQuestion, step: Step, most: int | None) -> Synthesis:
    """Mechanisms whose motion at home is the one that is asked for."""
    classes_of_limbs = limb_classes(asked.motion, asked.actuators, passive=asked.limbs > asked.motion.dim)
    asked_for = (tuple(limb for limb in some if asked.wants(limb.type)) for some in classes_of_limbs)
    classes_of_limbs = tuple(some for some in asked_for if some)
    known = known_by_directions(asked.motion)
    sought = Sought(
        asked.motion, Range(*asked.coupling), (), asked.symmetric, asked.members, [one.key for one in known]
    )
    families: list[MechanismFamily] = []
    try:
        arranged = list(arranged_classes(classes_of_limbs, asked.motion, asked.limbs))
        if asked.symmetric:
            arranged = [one for one in arranged if are_equal(one.chosen)]
        if not asked.symmetric:  # equal limbs are few
            _refuse_more(most, sum(one.members for one in arranged), sum(map(len, classes_of_limbs)))
        for done, one in enumerate(arranged):
            step(done, len(arranged))
            families.append(moved(one, sought))
    except KeyboardInterrupt:
        raise Interrupted(_answer(asked, classes_of_limbs, Counter(), families, ())) from None
    return _answer(asked, classes_of_limbs, Counter(), families, ())


def _with_points(asked: SynthesisQuestion, step: Step, most: int | None, also: Sequence[Key]) -> Synthesis:
    """Mechanisms whose limbs follow a virtual chain, for each row of the motion."""
    families: list[MechanismFamily] = []
    classes_of_limbs: list[Class] = []
    left_out: Counter[str] = Counter()
    try:
        for number, row in enumerate(asked.rows):
            step(number, len(asked.rows))
            every = following_types(row, asked.max_joints, asked.actuators, idle=asked.idle)
            types = tuple(filter(asked.wants, every))
            limbs = following_limbs(row, types, asked.limbs)
            left_out["not the motion"] += len(types) - len(limbs)
            classes_of_limbs += classes_by_constraints(limbs, row)
            sets = list(sets_of_classes(classes_by_constraints(limbs, row), row, asked.limbs))
            if asked.symmetric:
                sets = [(chosen, places) for chosen, places in sets if are_equal(chosen)]
            _refuse_more(most, _combinations([chosen for chosen, _ in sets], asked), len(limbs))
            known = (*known_mechanisms(row), *also)
            for done, (chosen, places) in enumerate(sets):
                step(number * len(sets) + done, len(asked.rows) * len(sets))
                degrees = Range(*asked.coupling)
                sought = Sought(row, degrees, (places,), asked.symmetric, asked.members, known, reached=True)
                families.append(_of_row(assemble(chosen, sought), row))
    except KeyboardInterrupt:
        raise Interrupted(_answer(asked, classes_of_limbs, left_out, families, ())) from None
    return _answer(asked, classes_of_limbs, left_out, families, ())


def _of_row(family: MechanismFamily, row: VirtualChain) -> MechanismFamily:
    designs = tuple(dataclasses.replace(design, row=row.row) for design in family.designs)
    return dataclasses.replace(family, designs=designs)


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


def _limbs(asked: SynthesisQuestion, step: Step) -> tuple[list[CandidateLimb], Counter[str], tuple[str, ...]]:
    """Limbs with the motion, how many have it not and why, and those on which the routes disagree."""
    types = limb_types(asked.motion, asked.max_joints, asked.actuators)
    if asked.hybrid:
        types += hybrid_types(asked.motion, asked.max_joints)
    types = tuple(filter(asked.wants, types))
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
    if asked.rows:
        by_row = {row.row: known_mechanisms(row) for row in asked.rows}
        return lambda design: by_row[design.row].get(mechanism(design.limbs), ())
    if asked.parasitic:
        placed = known_by_directions(asked.motion)
        return lambda design: tuple(one.name for one in placed if one.is_like(design))
    known = known_mechanisms(asked.motion)
    return lambda design: known.get(mechanism(design.limbs), ())


def _named(family: MechanismFamily, names: Callable[[Design], tuple[str, ...]]) -> MechanismFamily:
    designs = (dataclasses.replace(design, names=names(design)) for design in family.designs)
    return dataclasses.replace(family, designs=tuple(designs))
