"""What became of a mechanism in a synthesis: the filter that drops it, or where it is listed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from assur.results.plain_text import count as plural
from assur.synthesis.assembly import MechanismFamily, Range
from assur.synthesis.designs import Design
from assur.synthesis.isomorphism import limb_key
from assur.synthesis.known_mechanisms import DrivenLimb, upright_axes
from assur.synthesis.limb_motions import CandidateLimb
from assur.synthesis.limbs import LimbType, driven_joints
from assur.synthesis.question import SynthesisQuestion
from assur.synthesis.required import RequiredMotion
from assur.synthesis.synthesis import Synthesis
from assur.topology.agreement import RoutesDisagreeError
from assur.topology.chains import ChainJoint, InnerLoop

Filter = Literal[
    "", "limbs", "drives", "words", "limb", "motion", "arrangement", "actuation", "coupling", "symmetry", "novelty"
]
"""What drops a mechanism, in this order; nothing where it is listed.

The number of limbs, that of drives, which limbs are written at all, which of them have the motion, what they leave the
platform together, whether they do so as they stand to each other, whether the drives fix it, its coupling degree,
whether limbs must be equal, and whether known mechanisms are listed, or new ones.
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

    @property
    def passed(self) -> int:
        """How many filters it passed."""
        return get_args(Filter).index(self.dropped_by)


def inner_loop(limb: DrivenLimb) -> InnerLoop | None:
    """The inner loop that a limb begins with."""
    first = limb.chain.elements[0]
    return first if isinstance(first, InnerLoop) else None


def written_among(types: Sequence[LimbType], limb: DrivenLimb, motion: RequiredMotion) -> LimbType | None:
    """The limb among those that are written for a motion.

    Errors:
        UsageError: an inner loop that does not stand first.
    """
    key = limb_key(upright_axes(limb.chain), motion, limb.driven)
    return next((one for one in types if one.key == key), None)


def misdriven(limb: DrivenLimb, asked: SynthesisQuestion) -> str:
    """Why no series that is asked for is driven as this one; empty where it is."""
    if len(limb.driven) != 1:
        return f"it has {plural(len(limb.driven), 'drive')}, and a series has one"
    letters = [joint.type.letter if isinstance(joint, ChainJoint) else "A" for joint in limb.chain.joints]
    if limb.driven[0] in driven_joints(letters, asked.actuators):
        return ""
    places = {
        "base": "the first joint, an R, P or C; with actuators in the legs it may be another one",
        "leg": "the first P between joints that turn",
        "any": "an R, P or C",
    }
    return f"its drive is {limb.chain.joints[limb.driven[0]].name}, and asked for is {places[asked.actuators]}"


def by_family(
    family: MechanismFamily, limbs: Sequence[CandidateLimb], asked: SynthesisQuestion, otherwise: str
) -> Explanation | None:
    """What drops the one mechanism of a family, if anything does.

    Args:
        family: of these limbs alone, whatever its coupling degree is.
        limbs: of the mechanism.
        asked: of the synthesis.
        otherwise: what is said where it has not the motion.

    Errors:
        RoutesDisagreeError: rules and twists differ.
    """
    if family.tally.disagreements:
        raise RoutesDisagreeError("; ".join(family.tally.disagreements), hint="please report these chains")
    if not family.designs:
        if family.tally.unfixed:
            return Explanation("actuation", "its drives, locked, leave the platform a freedom")
        return Explanation("motion", otherwise)
    degree = family.designs[0].coupling_degree
    if degree not in Range(*asked.coupling):
        wanted = "..".join(map(str, dict.fromkeys(asked.coupling)))
        return Explanation("coupling", f"its coupling degree is κ = {degree}, and {wanted} is asked for")
    if asked.symmetric and len({limb.type.key for limb in limbs}) > 1:
        return Explanation("symmetry", "its limbs are not equal")
    return None


def by_length(limb: DrivenLimb, most: int) -> str:
    """Why a limb is too long, if it is."""
    loop = inner_loop(limb)
    longest = len(limb.chain.elements) + (max(map(len, loop.branches)) - 1 if loop else 0)
    return f"it has {longest} joints one behind the other, and {most} at most are looked at" if longest > most else ""
