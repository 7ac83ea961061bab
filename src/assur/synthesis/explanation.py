"""Why a synthesis lists a mechanism, or which of its filters drops it: the same filters, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from assur.results.plain_text import count as plural
from assur.synthesis.assembly import mechanism
from assur.synthesis.designs import Design
from assur.synthesis.filters.by_directions import limb_by_directions, together_by_directions
from assur.synthesis.filters.by_home_constraints import constraining_limb, constraining_together
from assur.synthesis.filters.by_virtual_chain import following_limb, following_together
from assur.synthesis.filters.explained import Explanation, inner_loop
from assur.synthesis.isomorphism import Key, mechanism_key
from assur.synthesis.known_mechanisms import DrivenLimb, placed_limbs
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.plans import Step
from assur.synthesis.question import SynthesisQuestion
from assur.synthesis.synthesis import ignored, synthesis
from assur.synthesis.virtual_chains import VirtualChain
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.notation import plain_text


def explanation(limbs: Sequence[DrivenLimb], asked: SynthesisQuestion, step: Step = ignored) -> Explanation:
    """Which filter of a synthesis drops a mechanism, or where it is listed.

    Of motions with several rows, it is the row in which the mechanism passes most filters.

    Args:
        limbs: of the mechanism; how they stand to each other is for the synthesis to choose, but in parasitic ones.
        asked: of the synthesis.
        step: called with (steps done, steps in all) where it is searched for.

    Errors:
        RoutesDisagreeError: rules and twists differ.
    """
    dropped = _by_numbers(limbs, asked)
    if dropped is not None:
        return dropped
    outcomes = [(row, _through(limbs, asked, row)) for row in asked.rows or (None,)]
    listed = next(((row, outcome) for row, outcome in outcomes if isinstance(outcome, tuple)), None)
    if listed:
        return _listed(limbs, listed[1], asked, listed[0], step)
    row, farthest = max(
        ((row, outcome) for row, outcome in outcomes if isinstance(outcome, Explanation)),
        key=lambda pair: pair[1].passed,
    )
    said = f"as {row.row}, {farthest.reason}" if row and len(outcomes) > 1 else farthest.reason
    return Explanation(farthest.dropped_by, said)


def _by_numbers(limbs: Sequence[DrivenLimb], asked: SynthesisQuestion) -> Explanation | None:
    freedoms = f"{asked.motion.dim} freedoms of {asked.motion.name}"
    needed = f"{asked.drives} drives that are asked for" if asked.redundant else freedoms
    if len(limbs) != asked.limbs:
        said = f"it has {plural(len(limbs), 'limb')}, and {asked.limbs} are asked for"
        if asked.limbs < min(len(limbs), asked.drives) and not any(inner_loop(limb) for limb in limbs):
            said += (
                f"; its limbs are series, of which each has one drive, and {asked.limbs} of them have fewer than the "
                f"{needed}: only limbs with an inner loop have two"
            )
        return Explanation("limbs", said)
    drives = sum(len(limb.driven) for limb in limbs)
    if drives != asked.drives:
        has = f"{asked.motion.name} has {asked.motion.dim} freedoms"
        wanted = f"{asked.drives} for the {freedoms} are asked for" if asked.redundant else has
        return Explanation("drives", f"it has {plural(drives, 'drive')}, and {wanted}")
    return None


def _through(limbs: Sequence[DrivenLimb], asked: SynthesisQuestion, row: VirtualChain | None) -> Explanation | Key:
    """What drops a mechanism after its numbers, or its canonical form where nothing does."""
    usable: list[CandidateLimb] = []
    judged = {limb: _limb(limb, asked, row) for limb in dict.fromkeys(limbs)}
    by_key: dict[Key, CandidateLimb] = {}
    for number, limb in enumerate(limbs, 1):
        one = judged[limb]
        if isinstance(one, Explanation):
            return Explanation(one.dropped_by, f"limb {number}, {plain_text(limb.chain)}: {one.reason}")
        usable.append(by_key.setdefault(one.type.key, one))
    dropped = _together(usable, limbs, asked, row)
    return dropped or mechanism_key(limb.type.key for limb in usable)


def _limb(limb: DrivenLimb, asked: SynthesisQuestion, row: VirtualChain | None) -> CandidateLimb | Explanation:
    if row:
        return following_limb(limb, asked, row)
    return constraining_limb(limb, asked) if asked.parasitic else limb_by_directions(limb, asked)


def _together(
    limbs: Sequence[CandidateLimb], given: Sequence[DrivenLimb], asked: SynthesisQuestion, row: VirtualChain | None
) -> Explanation | None:
    if row:
        return following_together(limbs, asked, row)
    if asked.parasitic:
        return constraining_together(limbs, given, asked)
    return together_by_directions(limbs, asked)


def _listed(
    limbs: Sequence[DrivenLimb], key: Key, asked: SynthesisQuestion, row: VirtualChain | None, step: Step
) -> Explanation:
    """Where the search lists it."""
    found = synthesis(asked, step=step, sought=key)
    is_it = _recognised(limbs, key, asked, row)
    for number, family in enumerate(found.families, 1):
        for design in family.designs:
            if is_it(design):
                rank = found.designs.index(design) + 1
                said = (
                    f"rank {rank}, in family {number} of {len(found.families)}, which has {family.members} members"
                    if found.whole
                    else f"in a family of {plural(family.members, 'member')}, with κ = {design.coupling_degree}; "
                    "its rank is told by the synthesis itself, which takes longer"
                )
                return Explanation("", said, found, design)
    if asked.novelty:
        known = "the catalogue has a mechanism with these limbs, and only others are asked for"
        new = "the catalogue has no mechanism with these limbs, and only those that it has are asked for"
        return Explanation("novelty", known if asked.novelty == "new" else new)
    raise RoutesDisagreeError(
        "the search does not list a mechanism that none of its filters drops", hint="please report these chains"
    )


def _recognised(
    limbs: Sequence[DrivenLimb], key: Key, asked: SynthesisQuestion, row: VirtualChain | None
) -> Callable[[Design], bool]:
    """What tells whether a mechanism that is listed is the one that is asked about."""
    if asked.parasitic:
        placed = placed_limbs("", limbs, asked.motion)
        return lambda design: placed.is_like(design.limbs, design.chains)
    return lambda design: mechanism(design.limbs) == key and design.row == (row.row if row else "")
