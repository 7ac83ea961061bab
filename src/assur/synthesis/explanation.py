"""Why a synthesis lists a mechanism, or which of its filters drops it: the same filters, one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from assur.errors import UsageError
from assur.results.plain_text import count as plural
from assur.synthesis.assembly import Range, Sought, assemble, mechanism, placed
from assur.synthesis.designs import Design
from assur.synthesis.inner_loops import INNER_LOOPS
from assur.synthesis.isomorphism import Key, limb_key, mechanism_key
from assur.synthesis.known_mechanisms import DrivenLimb
from assur.synthesis.limb_motions import CandidateLimb, LimbVerdict, verdict
from assur.synthesis.limbs import KINDS, TYPES, LimbType, hybrid_types, limb_types
from assur.synthesis.plans import Step
from assur.synthesis.positions import placements, positions
from assur.synthesis.question import ANY, SynthesisQuestion
from assur.synthesis.required import RequiredMotion
from assur.synthesis.synthesis import Synthesis, ignored, synthesis
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.chains import Chain, InnerLoop, Parallelogram
from assur.topology.notation import plain_text
from assur.topology.symbolic.refusals import Refusal

Filter = Literal["", "limbs", "drives", "words", "limb", "motion", "actuation", "coupling", "symmetry", "novelty"]
"""What drops a mechanism, in this order; nothing where it is listed.

The number of limbs, that of drives, which limbs are written at all, which of them have the motion, what they leave the
platform together, whether the drives fix it, its coupling degree, whether limbs must be equal, and whether known
mechanisms are listed, or new ones.
"""


@dataclass(frozen=True, eq=False)
class Explanation:
    """What became of a mechanism.

    Attributes:
        dropped_by: the first filter that drops it.
        reason: why, in one sentence without a full stop.
        synthesis: in which it is listed, if it is.
        design: as it is listed there.
    """

    dropped_by: Filter
    reason: str
    synthesis: Synthesis | None = None
    design: Design | None = None


def explanation(limbs: Sequence[DrivenLimb], asked: SynthesisQuestion, step: Step = ignored) -> Explanation:
    """Which filter of a synthesis drops a mechanism, or where it is listed.

    Args:
        limbs: of the mechanism; how they stand to each other is for the synthesis to choose.
        asked: of the synthesis.
        step: called with (steps done, steps in all) where it is searched for.

    Errors:
        RoutesDisagreeError: rules and twists differ.
    """
    dropped = _by_numbers(limbs, asked)
    if dropped is not None:
        return dropped
    usable: dict[Key, CandidateLimb] = {}
    keys = []
    judged_limbs = {limb: _limb(limb, asked) for limb in dict.fromkeys(limbs)}
    for number, limb in enumerate(limbs, 1):
        judged = judged_limbs[limb]
        if isinstance(judged, Explanation):
            return Explanation(judged.dropped_by, f"limb {number}, {plain_text(limb.chain)}: {judged.reason}")
        keys.append(judged.type.key)
        usable[judged.type.key] = judged
    return _together([usable[key] for key in keys], asked) or _listed(mechanism_key(keys), asked, step)


def _by_numbers(limbs: Sequence[DrivenLimb], asked: SynthesisQuestion) -> Explanation | None:
    freedoms, name = asked.motion.dim, asked.motion.name
    if len(limbs) != asked.limbs:
        said = f"it has {plural(len(limbs), 'limb')}, and {asked.limbs} are asked for"
        if asked.limbs < min(len(limbs), freedoms) and not any(_loop(limb.chain) for limb in limbs):
            said += (
                f"; its limbs are series, of which each has one drive, and {asked.limbs} of them have fewer than the "
                f"{freedoms} freedoms of {name}: only limbs with an inner loop have two"
            )
        return Explanation("limbs", said)
    drives = sum(len(limb.driven) for limb in limbs)
    if drives != freedoms:
        return Explanation("drives", f"it has {plural(drives, 'drive')}, and {name} has {freedoms} freedoms")
    return None


def _loop(chain: Chain) -> InnerLoop | None:
    first = chain.elements[0]
    return first if isinstance(first, InnerLoop) else None


def _limb(limb: DrivenLimb, asked: SynthesisQuestion) -> CandidateLimb | Explanation:
    """The limb as the synthesis has it, or why it has not."""
    written = _written(limb, asked)
    if isinstance(written, str):
        return Explanation("words", written)
    judged = verdict(written, asked.motion, positions(asked.motion, asked.limbs))
    _refuse_disagreement(judged)
    return judged.limb or Explanation("limb", _IN_WORDS[judged.reason].format(motion=asked.motion.name))


def _refuse_disagreement(judged: LimbVerdict) -> None:
    if judged.disagreement:
        raise RoutesDisagreeError(judged.disagreement, hint="assur has an error; please report these chains")


_IN_WORDS = {
    "a passive freedom": "some of its joints can move while its ends stand still",
    "not the motion": "its end cannot make all of {motion}",
    "an idle joint": "one of its joints stands still in all of {motion}",
}


def _written(limb: DrivenLimb, asked: SynthesisQuestion) -> LimbType | str:
    """The limb among those that the synthesis writes, or why it is none of them."""
    chain, motion = limb.chain, asked.motion
    for joint in chain.joints:
        if isinstance(joint, Parallelogram):
            if joint.kind not in KINDS.values():
                return f"limbs have no P({joint.kind})"
        elif joint.type not in TYPES.values():
            return f"limbs have no {joint.type.letter}; they are written with R, P, C, U, S and parallelograms"
    loop = _loop(chain)
    longest = max(map(len, loop.branches)) + len(chain.elements) - 1 if loop else len(chain.elements)
    if longest > asked.max_joints:
        return f"it has {longest} joints one behind the other, and at most {asked.max_joints} are asked for"
    try:
        key = limb_key(chain, motion, limb.driven)
        looped = loop and limb_key(Chain((loop,)), motion) not in _loops(motion)
    except UsageError as error:
        return error.message
    if loop and not asked.hybrid:
        return f"with as many limbs as freedoms, {asked.limbs}, each limb is a series with one drive"
    if looped:
        return f"its inner loop is none of the catalogue: {', '.join(row.name for row in INNER_LOOPS)}"
    types = (
        limb_types(motion, asked.max_joints, asked.actuators) if not loop else hybrid_types(motion, asked.max_joints)
    )
    written = {limb_type.key: limb_type for limb_type in types}.get(key)
    unwanted = asked.unwanted(written) if written else ""
    return unwanted or written or _not_written(limb, asked, key)


def _loops(motion: RequiredMotion) -> set[Key]:
    return {limb_key(Chain((loop,)), motion) for row in INNER_LOOPS for _, loop in row.turned_loops(motion)}


def _not_written(limb: DrivenLimb, asked: SynthesisQuestion, key: Key) -> str:
    """Why no limb that is written is this one."""
    drive = limb.chain.joints[limb.driven[0]] if limb.driven else None
    if asked.actuators == "base" and not _loop(limb.chain) and limb.driven != (0,):
        driven = f"its drive is {drive.name}" if drive is not None else "it has no drive"
        return (
            f"{driven}, and asked for are drives at the first joint; with actuators in the legs it may be another one"
        )
    try:
        judged = verdict(LimbType(limb.chain, limb.driven, key), asked.motion, positions(asked.motion, asked.limbs))
    except UsageError as error:
        return error.message
    if judged.reason:
        return _IN_WORDS[judged.reason].format(motion=asked.motion.name)
    return (
        "no limb is written so: axes are parallel or perpendicular to each other, an S stands in limbs of six freedoms "
        "and three joints, a P along a neighbouring R is part of a C unless it is driven"
    )


def _together(limbs: Sequence[CandidateLimb], asked: SynthesisQuestion) -> Explanation | None:
    """Why these limbs make no mechanism that is asked for; nothing if they do."""
    classes = {limb.type.key: (limb,) for limb in limbs}
    chosen = [classes[limb.type.key] for limb in limbs]
    sought = Sought(asked.motion, Range(*ANY), placements(asked.motion, asked.limbs))
    rules = placed(chosen, sought)[1]
    family = assemble(chosen, sought)
    if family.tally.disagreements:
        raise RoutesDisagreeError("; ".join(family.tally.disagreements), hint="please report these chains")
    if not family.designs:
        if family.tally.unfixed:
            return Explanation("actuation", "its drives, locked, leave the platform a freedom")
        moves = "another motion" if isinstance(rules, Refusal) else str(rules.platform.poc)
        return Explanation("motion", f"its limbs together leave the platform {moves}, however they are placed here")
    degree = family.designs[0].coupling_degree
    if degree not in Range(*asked.coupling):
        wanted = "..".join(map(str, dict.fromkeys(asked.coupling)))
        return Explanation("coupling", f"its coupling degree is κ = {degree}, and {wanted} is asked for")
    if asked.symmetric and len(classes) > 1:
        return Explanation("symmetry", "its limbs are not equal")
    return None


def _listed(key: Key, asked: SynthesisQuestion, step: Step) -> Explanation:
    """Where the search lists it."""
    found = synthesis(asked, step=step, also=(key,))
    for number, family in enumerate(found.families, 1):
        for design in family.designs:
            if mechanism(design.limbs) == key:
                rank = found.designs.index(design) + 1
                said = f"rank {rank}, in family {number} of {len(found.families)}, which has {family.members} members"
                return Explanation("", said, found, design)
    if asked.novelty:
        known = "the catalogue has a mechanism with these limbs, and only others are asked for"
        new = "the catalogue has no mechanism with these limbs, and only those that it has are asked for"
        return Explanation("novelty", known if asked.novelty == "new" else new)
    raise RoutesDisagreeError(
        "the search does not list a mechanism that none of its filters drops", hint="please report these chains"
    )
