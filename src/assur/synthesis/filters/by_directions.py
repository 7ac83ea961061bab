"""What drops a mechanism where limbs have the motion at every point."""

from __future__ import annotations

from collections.abc import Sequence

from assur.errors import UsageError
from assur.synthesis.assembly import Range, Sought, assemble, placed
from assur.synthesis.filters.explained import (
    Explanation,
    by_family,
    by_length,
    inner_loop,
    misdriven,
    written_among,
)
from assur.synthesis.inner_loops import INNER_LOOPS
from assur.synthesis.isomorphism import Key, limb_key
from assur.synthesis.known_mechanisms import DrivenLimb
from assur.synthesis.limb_motions import CandidateLimb, LimbVerdict, verdict
from assur.synthesis.limbs import KINDS, TYPES, LimbType, hybrid_types, limb_types
from assur.synthesis.positions import placements, positions
from assur.synthesis.question import ANY, SynthesisQuestion
from assur.synthesis.required import RequiredMotion
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.chains import Chain, Parallelogram
from assur.topology.symbolic.refusals import Refusal

_IN_WORDS = {
    "a passive freedom": "some of its joints can move while its ends stand still",
    "not the motion": "its end cannot make all of {motion}",
    "an idle joint": "one of its joints stands still in all of {motion}",
}


def limb_by_directions(limb: DrivenLimb, asked: SynthesisQuestion) -> CandidateLimb | Explanation:
    """The limb as the synthesis has it, or why it has not.

    Errors:
        RoutesDisagreeError: rules and twists differ.
    """
    written = _written(limb, asked)
    if isinstance(written, str):
        return Explanation("words", written)
    judged = _judged(written, asked)
    return judged.limb or Explanation("limb", _IN_WORDS[judged.reason].format(motion=asked.motion.name))


def together_by_directions(limbs: Sequence[CandidateLimb], asked: SynthesisQuestion) -> Explanation | None:
    """Why these limbs make no mechanism that is asked for; nothing if they do.

    Errors:
        RoutesDisagreeError: rules and twists differ.
    """
    classes = {limb.type.key: (limb,) for limb in limbs}
    chosen = [classes[limb.type.key] for limb in limbs]
    sought = Sought(asked.motion, Range(*ANY), placements(asked.motion, asked.limbs))
    rules = placed(chosen, sought)[1]
    moves = "another motion" if isinstance(rules, Refusal) else str(rules.platform.poc)
    otherwise = f"its limbs together leave the platform {moves}, however they are placed here"
    return by_family(assemble(chosen, sought), limbs, asked, otherwise)


def _judged(limb: LimbType, asked: SynthesisQuestion) -> LimbVerdict:
    judged = verdict(limb, asked.motion, positions(asked.motion, asked.limbs))
    if judged.disagreement:
        raise RoutesDisagreeError(judged.disagreement, hint="assur has an error; please report these chains")
    return judged


def _written(limb: DrivenLimb, asked: SynthesisQuestion) -> LimbType | str:
    """The limb among those that the synthesis writes, or why it is none of them."""
    chain, motion = limb.chain, asked.motion
    for joint in chain.joints:
        if isinstance(joint, Parallelogram):
            if joint.kind not in KINDS.values():
                return f"limbs have no P({joint.kind})"
        elif joint.type not in TYPES.values():
            return f"limbs have no {joint.type.letter}; they are written with R, P, C, U, S and parallelograms"
    too_long = by_length(limb, asked.max_joints)
    if too_long:
        return too_long
    loop = inner_loop(limb)
    try:
        looped = loop and limb_key(Chain((loop,)), motion) not in _loops(motion)
        if loop and not asked.hybrid:
            return f"with as many limbs as freedoms, {asked.limbs}, each limb is a series with one drive"
        if looped:
            return f"its inner loop is none of the catalogue: {', '.join(row.name for row in INNER_LOOPS)}"
        types = (
            hybrid_types(motion, asked.max_joints) if loop else limb_types(motion, asked.max_joints, asked.actuators)
        )
        written = written_among(types, limb, motion)
        return (asked.unwanted(written) or written) if written else _not_written(limb, asked)
    except UsageError as error:
        return error.message


def _loops(motion: RequiredMotion) -> set[Key]:
    return {limb_key(Chain((loop,)), motion) for row in INNER_LOOPS for _, loop in row.turned_loops(motion)}


def _not_written(limb: DrivenLimb, asked: SynthesisQuestion) -> str:
    """Why no limb that is written is this one.

    Errors:
        UsageError: it cannot be placed.
        RoutesDisagreeError: rules and twists differ.
    """
    driven = "" if inner_loop(limb) else misdriven(limb, asked)
    if driven:
        return driven
    key = limb_key(limb.chain, asked.motion, limb.driven)
    judged = _judged(LimbType(limb.chain, limb.driven, key), asked)
    if judged.reason:
        return _IN_WORDS[judged.reason].format(motion=asked.motion.name)
    return (
        "no limb is written so: axes are parallel or perpendicular to each other, an S stands in limbs of six freedoms "
        "and three joints, a P along a neighbouring R is part of a C unless it is driven"
    )
