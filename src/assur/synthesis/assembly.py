"""Limbs put together: by classes of equal motion, where the rules decide; then one by one, confirmed by twists."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import permutations

from assur.synthesis.classes import Class, are_equal, number_of_members, simplest_members
from assur.synthesis.confirmed import Confirmed, confirmed
from assur.synthesis.designs import Design
from assur.synthesis.expected import Expected, expected
from assur.synthesis.isomorphism import Key, mechanism_key
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.required import RequiredMotion
from assur.synthesis.tally import Tally
from assur.topology.facts import Known
from assur.topology.notation import parse_chains
from assur.topology.symbolic.refusals import Refusal

MEMBERS = 20
"""Of mechanisms with different limbs so many are listed for each set of classes, the simplest first."""

TRIES = 200
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
class MechanismFamily:
    """The mechanisms of a set of classes, the best first, and how many there were."""

    designs: tuple[Design, ...]
    tally: Tally

    @property
    def members(self) -> int:
        """Mechanisms that it stands for, those with the motion."""
        return self.tally.with_motion


@dataclass(frozen=True)
class Sought:
    """What is asked of every set of classes.

    Attributes:
        motion: required of the platform.
        degrees: coupling degrees.
        placements: positions of the limbs, the first that gives the motion is taken.
        symmetric: whether all limbs must be equal.
        members: so many mechanisms of different limbs are listed.
        known: canonical forms of mechanisms that are listed however many joints they have.
        reached: whether constraints say already that the limbs have the motion in the first of the placements.
    """

    motion: RequiredMotion
    degrees: Range
    placements: tuple[tuple[int, ...], ...]
    symmetric: bool = False
    members: int = MEMBERS
    known: Collection[Key] = ()
    reached: bool = False


def assemble(chosen: Sequence[Class], sought: Sought) -> MechanismFamily:
    """The mechanisms with one limb of each of these classes: those of equal limbs all, of the others the simplest.

    Args:
        chosen: one class for each limb, equal ones side by side; only one class, if limbs must be equal.
        sought: what is asked of them.
    """
    total = len(chosen[0]) if sought.symmetric else number_of_members(chosen)
    places, rules = placed(chosen, sought)
    degrees: Counter[int] = Counter()
    if isinstance(rules, Expected):
        if not rules.reaches:
            return MechanismFamily((), Tally(classes=1, combinations=total))
        if rules.counts:
            degrees[rules.counts.coupling_degree] = total
    outcomes: list[Design | Rejected] = []
    if not degrees or max(degrees) in sought.degrees:
        judge = partial(_outcome, places=places, rules=rules, sought=sought)
        equal = [(limb,) * len(chosen) for limb in chosen[0]] if are_equal(chosen) else []
        outcomes += map(judge, equal)
        if not sought.symmetric:
            outcomes += _simplest(chosen, sought, judge)
    rejected = [outcome for outcome in outcomes if isinstance(outcome, Rejected)]
    tally = Tally(
        classes=1,
        combinations=total,
        with_motion=total if sought.reached or isinstance(rules, Expected) else 0,
        coupling_degrees=degrees,
        tried=len(outcomes),
        unfixed=sum(rejection.unfixed for rejection in rejected),
        disagreements=tuple(rejection.disagreement for rejection in rejected if rejection.disagreement),
    )
    designs = sorted((outcome for outcome in outcomes if isinstance(outcome, Design)), key=lambda design: design.order)
    return MechanismFamily(tuple(designs), tally)


def placed(chosen: Sequence[Class], sought: Sought) -> tuple[tuple[int, ...], Expected | Refusal]:
    """The first placement that gives the motion by the rules, or the first at all, and what the rules say of it."""
    said = [(places, _by_rules(chosen, places, sought.motion)) for places in sought.placements]
    reaching = (pair for pair in said if isinstance(pair[1], Expected) and pair[1].reaches)
    return next(reaching, said[0])


def _by_rules(chosen: Sequence[Class], places: Sequence[int], motion: RequiredMotion) -> Expected | Refusal:
    """What the rules say of the classes, by their first members.

    Inner loops and redundant drives are for the twists to count.
    """
    first = [members[0] for members in chosen]
    if not all(limb.motions for limb in first):
        return Refusal(next(limb.known.refusal for limb in first if not limb.motions))
    said = expected([limb.motions[place] for limb, place in zip(first, places, strict=True)], motion)
    drives = sum(len(limb.type.driven) for limb in first)
    if isinstance(said, Expected) and (drives > motion.dim or any(limb.type.loop for limb in first)):
        return replace(said, counts=None)
    return said


def _simplest(
    chosen: Sequence[Class], sought: Sought, judge: Callable[[Sequence[CandidateLimb]], Design | Rejected]
) -> list[Design | Rejected]:
    """The simplest mechanisms of limbs that are not all equal, what was rejected on the way, and known ones."""
    outcomes: list[Design | Rejected] = []
    known = known_members(chosen, sought.known)
    for limbs in simplest_members(chosen)[:TRIES]:
        outcomes.append(judge(limbs))
        known = [other for other in known if mechanism(other) != mechanism(limbs)]
        if sum(isinstance(outcome, Design) for outcome in outcomes) == sought.members:
            break
    return [*outcomes, *map(judge, known)]


def mechanism(limbs: Sequence[CandidateLimb]) -> Key:
    """Canonical form of the mechanism with these limbs."""
    return mechanism_key(limb.type.key for limb in limbs)


def known_members(chosen: Sequence[Class], known: Collection[Key]) -> list[tuple[CandidateLimb, ...]]:
    """Known mechanisms with different limbs, one of each of these classes."""
    by_key = [{limb.type.key: limb for limb in members} for members in chosen]
    members = []
    for keys in known:
        if len(keys) != len(chosen) or len(set(keys)) == 1:
            continue
        orders = (order for order in permutations(keys) if all(map(dict.__contains__, by_key, order)))
        order = next(orders, None)
        if order is not None:
            members.append(tuple(limbs[key] for limbs, key in zip(by_key, order, strict=True)))
    return members


def _outcome(
    limbs: Sequence[CandidateLimb], places: Sequence[int], rules: Expected | Refusal, sought: Sought
) -> Design | Rejected:
    """The mechanism of these limbs, if the twists confirm it and its driven joints fix the platform."""
    twists, motion = confirmed(limbs, places), sought.motion
    chains = [limb.chains[place].text for limb, place in zip(limbs, places, strict=True)]
    text = " | ".join(chains)
    if twists.dof != motion.dim:
        said = f"{text}: the rules say F = {motion.dim}, the twists {twists.dof}"
        return Rejected(disagreement=said if isinstance(rules, Expected) else "")
    if twists.left:
        return Rejected(unfixed=True)
    difference = _difference(twists, rules)
    if difference:
        return Rejected(disagreement=f"{text}: {difference}")
    degree = twists.loops.coupling_degree
    if degree is None or degree not in sought.degrees:
        return Rejected()
    return Design(
        limbs=tuple(limbs),
        places=tuple(places),
        chains=parse_chains(chains),
        known=_known(rules, motion),
        loops=twists.loops,
        decoupling=twists.decoupling,
        dof=twists.dof,
        determining=twists.determining,
        mode="translation" if not motion.rotations and any(limb.needs_mode for limb in limbs) else "home",
    )


def _difference(twists: Confirmed, rules: Expected | Refusal) -> str:
    """Where the counts of the two routes differ, in words."""
    if isinstance(rules, Refusal) or rules.counts is None:
        return ""
    names = [edge.name for edge in twists.edges]
    order = [names.index(name) for loop in twists.loops.loops for name in loop.joints]
    said = (rules.counts.xi(order), rules.counts.coupling_degree)
    counted = (tuple(loop.xi for loop in twists.loops.loops), twists.loops.coupling_degree)
    return (
        "" if said == counted else f"the rules say ξ = {said[0]}, κ = {said[1]}, the twists {counted[0]}, {counted[1]}"
    )


def _known(rules: Expected | Refusal, motion: RequiredMotion) -> Known:
    if isinstance(rules, Refusal):
        return Known(motion.poc, "twists", rules.reason)
    return Known(rules.platform.poc, "both")
