"""Limbs put together: by classes of equal motion, where the rules decide; then one by one, confirmed by twists."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from assur.synthesis.classes import Class, are_equal, number_of_members, simplest_members
from assur.synthesis.confirmed import Confirmed, confirmed
from assur.synthesis.designs import Design
from assur.synthesis.expected import Expected, expected
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.required import RequiredMotion
from assur.synthesis.tally import Tally
from assur.topology.facts import Known
from assur.topology.notation import parse_chains
from assur.topology.poc import PocSet
from assur.topology.symbolic.refusals import Refusal

MEMBERS = 20
"""Of mechanisms with different limbs so many are listed for each set of classes, the simplest first."""

TRIES = 10 * MEMBERS
"""So many are tried to find them."""


@dataclass(frozen=True)
class Range:
    """Coupling degrees that are wanted."""

    low: int
    high: int

    def __contains__(self, degree: int) -> bool:
        return self.low <= degree <= self.high


@dataclass(frozen=True)
class Rejected:
    """Why limbs make no mechanism: the driven joints do not fix it, or the routes disagree, or it is not wanted."""

    unfixed: bool = False
    disagreement: str = ""


@dataclass(frozen=True, eq=False)
class DesignsOfClasses:
    """The mechanisms of a set of classes, and how many there were."""

    designs: tuple[Design, ...]
    tally: Tally


def assemble(
    chosen: Sequence[Class], motion: RequiredMotion, degrees_allowed: Range, *, symmetric: bool
) -> DesignsOfClasses:
    """The mechanisms with one limb of each of these classes: those of equal limbs all, of the others the simplest.

    Args:
        chosen: one class for each position, equal ones side by side; only one class, if limbs must be equal.
        motion: required of the platform.
        degrees_allowed: coupling degrees.
        symmetric: whether all limbs must be equal.
    """
    total = len(chosen[0]) if symmetric else number_of_members(chosen)
    rules = _by_rules(chosen, motion)
    degrees: Counter[int] = Counter()
    if isinstance(rules, Expected):
        if not rules.reaches:
            return DesignsOfClasses((), Tally(classes=1, combinations=total))
        if rules.counts:
            degrees[rules.counts.coupling_degree] = total
    outcomes: list[Design | Rejected] = []
    if not degrees or max(degrees) in degrees_allowed:
        equal = [(limb,) * len(chosen) for limb in chosen[0]] if are_equal(chosen) else []
        outcomes += [_outcome(limbs, rules, motion, degrees_allowed) for limbs in equal]
        if not symmetric:
            outcomes += _simplest(chosen, rules, motion, degrees_allowed)
    rejected = [outcome for outcome in outcomes if isinstance(outcome, Rejected)]
    tally = Tally(
        classes=1,
        combinations=total,
        with_motion=total if isinstance(rules, Expected) else 0,
        coupling_degrees=degrees,
        tried=len(outcomes),
        unfixed=sum(rejection.unfixed for rejection in rejected),
        disagreements=tuple(rejection.disagreement for rejection in rejected if rejection.disagreement),
    )
    return DesignsOfClasses(tuple(outcome for outcome in outcomes if isinstance(outcome, Design)), tally)


def _by_rules(chosen: Sequence[Class], motion: RequiredMotion) -> Expected | Refusal:
    """What the rules say of the classes, by their first members."""
    first = [members[0] for members in chosen]
    if not all(limb.motions for limb in first):
        return Refusal(next(limb.known.refusal for limb in first if not limb.motions))
    return expected([limb.motions[place] for place, limb in enumerate(first)], motion)


def _simplest(
    chosen: Sequence[Class], rules: Expected | Refusal, motion: RequiredMotion, degrees_allowed: Range
) -> list[Design | Rejected]:
    """The simplest mechanisms of limbs that are not all equal, and what was rejected on the way to them."""
    outcomes: list[Design | Rejected] = []
    for limbs in simplest_members(chosen)[:TRIES]:
        outcomes.append(_outcome(limbs, rules, motion, degrees_allowed))
        if sum(isinstance(outcome, Design) for outcome in outcomes) == MEMBERS:
            break
    return outcomes


def _outcome(
    limbs: Sequence[CandidateLimb], rules: Expected | Refusal, motion: RequiredMotion, degrees_allowed: Range
) -> Design | Rejected:
    """The mechanism of these limbs, if the twists confirm it and its driven joints fix the platform."""
    twists = confirmed(limbs)
    text = " | ".join(limb.chains[place].text for place, limb in enumerate(limbs))
    if twists.dof != motion.dim:
        said = f"{text}: the rules say F = {motion.dim}, the twists {twists.dof}"
        return Rejected(disagreement=said if isinstance(rules, Expected) else "")
    if twists.left:
        return Rejected(unfixed=True)
    difference = _difference(twists, rules)
    if difference:
        return Rejected(disagreement=f"{text}: {difference}")
    degree = twists.loops.coupling_degree
    if degree is None or degree not in degrees_allowed:
        return Rejected()
    return Design(
        limbs=tuple(limbs),
        chains=parse_chains([limb.chains[place].text for place, limb in enumerate(limbs)]),
        known=_known(rules, motion),
        loops=twists.loops,
        dof=twists.dof,
        mode="translation" if any(limb.needs_mode for limb in limbs) else "home",
    )


def _difference(twists: Confirmed, rules: Expected | Refusal) -> str:
    """Where the counts of the two routes differ, in words."""
    if isinstance(rules, Refusal) or rules.counts is None:
        return ""
    order = [twists.names.index(name) for loop in twists.loops.loops for name in loop.joints]
    said = (rules.counts.xi(order), rules.counts.coupling_degree)
    counted = (tuple(loop.xi for loop in twists.loops.loops), twists.loops.coupling_degree)
    return (
        "" if said == counted else f"the rules say ξ = {said[0]}, κ = {said[1]}, the twists {counted[0]}, {counted[1]}"
    )


def _known(rules: Expected | Refusal, motion: RequiredMotion) -> Known:
    if isinstance(rules, Refusal):
        poc = PocSet(len(motion.translations), len(motion.rotations), motion.dim)
        return Known(poc, "twists", rules.reason)
    return Known(rules.platform.poc, "both")
