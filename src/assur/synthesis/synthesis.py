"""First type synthesis: every mechanism of bounded size that has a wanted motion, without doubles, ranked."""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from assur.errors import Interrupted, UsageError
from assur.synthesis.assembly import MechanismFamily, mechanism
from assur.synthesis.designs import Design
from assur.synthesis.isomorphism import Key
from assur.synthesis.kept_families import KeptFamilies, kept_families
from assur.synthesis.known_mechanisms import known_by_directions, known_mechanisms
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.plans import SearchPlan, Step, plans
from assur.synthesis.question import Novelty, SynthesisQuestion
from assur.synthesis.tally import Tally, total
from assur.topology.agreement import RoutesDisagreeError

PATIENCE = 30.0
"""Seconds, as estimated, that are spent on the rank of one mechanism."""


@dataclass(frozen=True, eq=False)
class Synthesis:
    """What was found.

    Attributes:
        asked: the question.
        limbs: limb types that have the motion, the simplest first in each class of equal motion.
        left_out: number of limb types that have not, by the reason.
        tally: of the combinations.
        families: the mechanisms by the classes of their limbs, the family of the best one first.
        kept: so many sets of classes an earlier run had looked at.
        whole: whether all sets were looked at, or those alone that may have one mechanism.
    """

    asked: SynthesisQuestion
    limbs: tuple[CandidateLimb, ...]
    left_out: Counter[str]
    tally: Tally
    families: tuple[MechanismFamily, ...]
    kept: int = 0
    whole: bool = True

    @cached_property
    def designs(self) -> tuple[Design, ...]:
        """The mechanisms, best first."""
        every = (design for family in self.families for design in family.designs)
        return tuple(sorted(every, key=lambda design: design.order))


def ignored(done: int, whole: int) -> None:
    """A step that nobody counts."""


def synthesis(
    asked: SynthesisQuestion, *, step: Step = ignored, most: int | None = None, sought: Key | None = None
) -> Synthesis:
    """Mechanisms with a wanted motion, each confirmed by twists; by rules, too, where places make no difference.

    What is found of each set of classes of limbs is kept at once in the user's cache, so that the same question, asked
    again, goes on where it was ended, be it by Ctrl-C or by a kill.

    Args:
        asked: the question.
        step: called with (steps done, steps in all).
        most: combinations at most; any number where None.
        sought: canonical form of a mechanism that is listed however many joints it has, as known ones are; where all
            sets of classes would take longer than `PATIENCE`, those that may have it are looked at alone.

    Errors:
        UsageError: more combinations.
        Interrupted: Ctrl-C; its answer is what was found so far.
        RoutesDisagreeError: rules and twists differ; the message names every chain.

    Example:
        >>> from assur.synthesis.question import question
        >>> found = synthesis(question("3T", max_joints=3, symmetric=True))
        >>> [design.names for design in found.designs if "three_crr" in design.names]
        [('three_crr',)]
    """
    parts = 2 * (len(asked.rows) or 1)
    also = () if sought is None else (sought,)
    with kept_families(dataclasses.replace(asked, novelty=""), also) as kept:
        search = _Search(asked, kept)
        try:
            before = [_part(step, number, parts) for number in range(0, parts, 2)]
            for number, plan in enumerate(plans(asked, before, also)):
                _refuse_more(most, plan)
                search.run(plan, _part(step, 2 * number + 1, parts), sought)
        except KeyboardInterrupt:
            raise Interrupted(search.answer()) from None
    return search.answer()


def _refuse_more(most: int | None, plan: SearchPlan) -> None:
    if most is not None and plan.combinations > most:
        types = sum(map(len, plan.classes))
        raise UsageError(
            f"{plan.combinations} combinations of {types} limb types, and {most} are looked at unasked",
            hint=f"ask for fewer joints, for equal limbs, or for all with --yes: {plan.effort}",
        )


class _Search:
    """What was found so far."""

    def __init__(self, asked: SynthesisQuestion, kept: KeptFamilies) -> None:
        self.asked, self.kept = asked, kept
        self.plans: list[SearchPlan] = []
        self.families: list[MechanismFamily] = []
        self.whole = True

    def run(self, plan: SearchPlan, step: Step, sought: Key | None) -> None:
        """Look at all sets of classes of a plan, but those whose families are kept; at few of many if one is sought.

        Errors:
            KeyboardInterrupt: Ctrl-C, also one that came while the plan was made.
        """
        self.plans.append(plan)
        if plan.cut:
            raise KeyboardInterrupt
        few = sought is not None and plan.duration > PATIENCE
        self.whole &= not few
        for done, some in enumerate(plan.sets):
            step(done, len(plan.sets))
            if few and sought is not None and not some.may_have(sought):
                continue
            self.families.append(self.kept.family(f"{len(self.plans)}.{done}", some))

    def answer(self) -> Synthesis:
        """The families by what their best mechanism is worth."""
        tally = total(family.tally for family in self.families)
        disagreements = [text for plan in self.plans for text in plan.disagreements] + list(tally.disagreements)
        if disagreements:
            raise RoutesDisagreeError("; ".join(disagreements), hint="assur has an error; please report these chains")
        names = _names(self.asked)
        named = [_named(family, names, self.asked.novelty) for family in self.families]
        kept = [family for family in named if family.designs]
        return Synthesis(
            asked=self.asked,
            limbs=tuple(limb for plan in self.plans for members in plan.classes for limb in members),
            left_out=sum((plan.left_out for plan in self.plans), Counter()),
            tally=tally,
            families=tuple(sorted(kept, key=lambda family: family.designs[0].order)),
            kept=self.kept.reread,
            whole=self.whole,
        )


def _part(step: Step, before: int, parts: int) -> Step:
    """The steps of one part of a work, of as many alike."""
    return lambda done, whole: step(before * whole + done, parts * whole)


def _names(asked: SynthesisQuestion) -> Callable[[Design], tuple[str, ...]]:
    """What gives the names of known mechanisms with the same limbs; parasitic ones are placed alike, too."""
    if asked.rows:
        by_row = {row.row: known_mechanisms(row) for row in asked.rows}
        return lambda design: by_row[design.row].get(mechanism(design.limbs), ())
    if asked.parasitic:
        placed = known_by_directions(asked.motion)
        return lambda design: tuple(one.name for one in placed if one.is_like(design.limbs, design.chains))
    known = known_mechanisms(asked.motion)
    return lambda design: known.get(mechanism(design.limbs), ())


def _named(family: MechanismFamily, names: Callable[[Design], tuple[str, ...]], novelty: Novelty) -> MechanismFamily:
    """The family with the names of its mechanisms, of which only known ones are kept, or only new ones."""
    designs = (dataclasses.replace(design, names=names(design)) for design in family.designs)
    kept = (design for design in designs if not novelty or bool(design.names) == (novelty == "known"))
    return dataclasses.replace(family, designs=tuple(kept))
