"""What drops a mechanism whose limbs are to follow a virtual chain."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assur.errors import UsageError
from assur.synthesis.assembly import Range, Sought, assemble
from assur.synthesis.filters.explained import Explanation, by_family, by_length, misdriven, written_among
from assur.synthesis.following_limbs import KINDS_OF_JOINTS, following_limbs, places_leaving, types_with
from assur.synthesis.known_mechanisms import DrivenLimb, upright_axes
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.limbs import FREE, LimbType
from assur.synthesis.placed_series import following, series_of
from assur.synthesis.question import ANY, SynthesisQuestion
from assur.synthesis.virtual_chains import VirtualChain
from assur.topology.chains import ChainJoint


def following_limb(limb: DrivenLimb, asked: SynthesisQuestion, row: VirtualChain) -> CandidateLimb | Explanation:
    """The limb as the synthesis has it, or why it has not."""
    try:
        written = _written(limb, asked, row)
    except UsageError as error:
        return Explanation("words", error.message)
    if isinstance(written, Explanation):
        return written
    limbs = following_limbs(row, [written], asked.limbs)
    return limbs[0] if limbs else Explanation("limb", f"it does not get to every pose of {row.text}")


def following_together(
    limbs: Sequence[CandidateLimb], asked: SynthesisQuestion, row: VirtualChain
) -> Explanation | None:
    """Why these limbs make no mechanism that is asked for; nothing if they do."""
    classes = {limb.type.key: (limb,) for limb in limbs}
    chosen = [classes[limb.type.key] for limb in sorted(limbs, key=lambda limb: repr(limb.type.key))]
    places = places_leaving(chosen, row)
    otherwise = f"its limbs together leave the platform more than {row.text}, however they are turned here"
    if places is None:
        return Explanation("motion", otherwise)
    sought = Sought(row, Range(*ANY), (places,), reached=True)
    return by_family(assemble(chosen, sought), limbs, asked, otherwise)


def _written(limb: DrivenLimb, asked: SynthesisQuestion, row: VirtualChain) -> LimbType | Explanation:
    """The limb among those that the synthesis writes, or why it is none of them."""
    for joint in limb.chain.joints:
        kind = joint.type.letter if isinstance(joint, ChainJoint) else f"P({joint.kind})"
        if kind not in KINDS_OF_JOINTS:
            of = ", ".join(KINDS_OF_JOINTS)
            return Explanation("words", f"limbs that follow a virtual chain have no {kind}; they are made of {of}")
    if len(limb.chain.elements) < len(limb.chain.joints):
        return Explanation("words", "limbs that follow a virtual chain have no inner loops")
    too_long = by_length(limb, asked.max_joints)
    if too_long:
        return Explanation("words", too_long)
    freedoms = sum(joint.freedoms for joint in limb.chain.joints)
    if not row.dim <= freedoms < FREE:
        least = f"it has {freedoms}, and limbs that follow {row.text} have {row.dim} to {FREE - 1} freedoms"
        return Explanation("words", least)

    def written(*, idle: bool) -> LimbType | None:
        return written_among(types_with(row, freedoms, asked.max_joints, asked.actuators, idle=idle), limb, row)

    own = written(idle=asked.idle)
    if own:
        unwanted = asked.unwanted(own)
        return Explanation("words", unwanted) if unwanted else own
    driven = misdriven(limb, asked)
    if driven:
        return Explanation("words", driven)
    if written(idle=True):
        return Explanation("limb", f"one of its joints rests in all of {row.text}, which is allowed where asked for")
    if not _follows(limb, row):
        return Explanation("limb", f"it does not follow {row.text}, as its axes stand to that")
    return Explanation(
        "words",
        "no limb is written so: its axes are along x, y and z, each moves, and runs through O only where it must; "
        "neighbours behind the first joint are U and S as soon as they can be, or all are, or none",
    )


def _follows(limb: DrivenLimb, row: VirtualChain) -> bool:
    """Whether the limb, with its labelled point in that of the virtual chain, can take the poses of that."""
    chain = upright_axes(limb.chain)
    series = series_of([chain], np.random.default_rng(len(chain.text)))
    return bool(following(series, row.series, row.values)[0][0])
