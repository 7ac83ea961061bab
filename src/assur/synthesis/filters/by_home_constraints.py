"""What drops a mechanism of which the constraints at home are to leave a motion that others come with."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from assur.errors import UsageError
from assur.synthesis.arrangements import arranged_classes
from assur.synthesis.assembly import Range, Sought
from assur.synthesis.filters.explained import Explanation, by_family, by_length, misdriven, written_among
from assur.synthesis.known_mechanisms import DrivenLimb, placed_limbs
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.limbs import FREE, SHORT, TYPES, LimbType, short_types
from assur.synthesis.parasitic import limb_with_directions, moved
from assur.synthesis.question import ANY, SynthesisQuestion
from assur.synthesis.shared_axes import without_labels
from assur.topology.chains import ChainJoint


def constraining_limb(limb: DrivenLimb, asked: SynthesisQuestion) -> CandidateLimb | Explanation:
    """The limb as the synthesis has it, or why it has not."""
    try:
        written = _written(limb, asked)
    except UsageError as error:
        return Explanation("words", error.message)
    if isinstance(written, str):
        return Explanation("words", written)
    candidate = limb_with_directions(written, asked.motion)
    return candidate[1] if candidate else Explanation("limb", _resisting(written, asked))


def constraining_together(
    limbs: Sequence[CandidateLimb], given: Sequence[DrivenLimb], asked: SynthesisQuestion
) -> Explanation | None:
    """Why these limbs, as they stand to each other, make no mechanism that is asked for; nothing if they do.

    Args:
        limbs: as the synthesis has them.
        given: the same, as they stand.
        asked: of the synthesis.

    Errors:
        RoutesDisagreeError: rules and twists differ.
    """
    classes = {limb.type.key: (limb,) for limb in limbs}
    counts = Counter(limb.type.key for limb in limbs)
    every = list(arranged_classes([tuple(classes[key] for key in counts.elements())], asked.motion))
    if not every:
        said = f"its limbs together leave another motion than {asked.motion.name} at home, however they are placed here"
        return Explanation("motion", said)
    standing = placed_limbs("", given, asked.motion)
    alike = [one for one in every if standing.is_like(first := one.simplest()[0], one.chains(first))]
    if not alike:
        texts = " | ".join(chain.text for chain in every[0].chains(every[0].simplest()[0]))
        return Explanation("arrangement", f"its limbs leave {asked.motion.name} where they stand otherwise, as {texts}")
    otherwise = (
        f"moved by a finite amount, it has not {asked.motion.dim} freedoms that others come with, all joints moving; "
        "or modes meet at home"
    )
    sought = Sought(asked.motion, Range(*ANY), ())
    reasons = [by_family(moved(one, sought), limbs, asked, otherwise) for one in alike]
    return None if None in reasons else reasons[0]


def _written(limb: DrivenLimb, asked: SynthesisQuestion) -> LimbType | str:
    """The limb among those that the synthesis writes, or why it is none of them."""
    for joint in limb.chain.joints:
        kind = joint.type.letter if isinstance(joint, ChainJoint) else f"P({joint.kind})"
        if kind not in TYPES:
            return f"limbs of parasitic mechanisms have no {kind}; they are made of {', '.join(TYPES)}"
    too_long = by_length(limb, max(SHORT))
    if too_long:
        return too_long
    bare = DrivenLimb(without_labels(limb.chain), limb.driven)
    passive = short_types(asked.motion, asked.actuators, passive=True) if asked.limbs > asked.drives else ()
    own = written_among((*short_types(asked.motion, asked.actuators), *passive), bare, asked.motion)
    if own:
        return asked.unwanted(own) or own
    return misdriven(limb, asked) or (
        f"no limb is written so: it has two or three joints along x, y and z, {asked.motion.dim} to {FREE} freedoms, "
        "all independent at home"
    )


def _resisting(limb: LimbType, asked: SynthesisQuestion) -> str:
    if not limb.driven:
        return f"it has no drive, and does not leave {asked.motion.name} by itself"
    return f"at home it resists a freedom of {asked.motion.name}, or along directions that depend on where it stands"
