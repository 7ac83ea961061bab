"""Whether what a platform does lasts: directions that agree as written may part as it turns, or stay together.

Links inside different limbs turn independently, except where they are fixed in the base, fixed in the platform, or
turned about the same axes to the same orientation. The first is what the rules assume; the others are checked here.
"""

from __future__ import annotations

from itertools import combinations

from assur.topology.rules.motion import Motion, seen_from_end
from assur.topology.rules.operation_modes import Assembly, assembled
from assur.topology.rules.orientations import Orientations, turn_alike
from assur.topology.rules.refusals import Refusal
from assur.topology.rules.vectors import aligned


def why_it_does_not_last(found: Assembly) -> Refusal | None:
    """Why what the platform does as written is not what it goes on to do, where that is so."""
    if found.turned.dim > found.taken.dim and not found.has_rods:
        return Refusal("the limbs leave the platform a rotation that does not last as it turns")
    turning = [limb.structure for limb in found.limbs if limb.structure and limb.translations.turning]
    if not found.taken.dim or len(turning) < 2:
        return None
    if any(turn_alike(*pair) for pair in combinations(turning, 2)):
        return Refusal("translations of several limbs turn alike with the platform")
    seen = _from_the_platform(found)
    if isinstance(seen, Refusal):
        return seen
    mixed = [True for pair in zip(found.limbs, seen.limbs, strict=True) if _is_of_both(*pair, found.taken)]
    if len(mixed) > 1 or _size(seen) != _size(found):
        return Refusal("directions fixed in the platform decide together with some fixed in the base")
    return None


def _from_the_platform(found: Assembly) -> Assembly | Refusal:
    """The limbs as seen by the platform, where other directions stay fixed than in the base."""
    limbs = [seen_from_end(limb.limb) for limb in found.limbs if limb.limb]
    return assembled(limbs, Orientations(found.taken.dim, found.taken.axes[::-1]))


def _is_of_both(base: Motion, platform: Motion, taken: Orientations) -> bool:
    """Whether a limb translates along a direction fixed in the base and along another one fixed in the platform."""
    one, other = base.translations, platform.translations
    if not (one.fixed and one.turning and other.fixed and other.turning):
        return False
    lasting = taken.axes and all(aligned(axis, one.fixed[0]) for axis in taken.axes)
    return not (lasting and aligned(one.fixed[0], other.fixed[0]))


def _size(found: Assembly) -> tuple[int, int]:
    return found.resisted.forces.dim, found.resisted.couples.dim
