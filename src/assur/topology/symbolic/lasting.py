"""Whether what a platform does lasts: directions that agree as written may part as it turns, or stay together.

Links inside different limbs turn independently, except where they are fixed in the base, fixed in the platform, or
turned about the same axes to the same orientation. The first is what the rules assume; the others are checked here.
"""

from __future__ import annotations

from itertools import combinations

from assur.topology.directions import parallel
from assur.topology.symbolic.motion import Motion, seen_from_end
from assur.topology.symbolic.operation_modes import HeldLimbs, assembled
from assur.topology.symbolic.orientations import Orientations, turn_alike
from assur.topology.symbolic.refusals import Refusal


def why_it_does_not_last(assembly: HeldLimbs) -> Refusal | None:
    """Why what the platform does as written is not what it goes on to do, where that is so."""
    if assembly.turned.dim > assembly.taken.dim and not assembly.has_rods:
        return Refusal("the limbs leave the platform a rotation that does not last as it turns")
    turning = [limb.structure for limb in assembly.limbs if limb.structure and limb.translations.turning]
    if not assembly.taken.dim or len(turning) < 2:
        return None
    if any(turn_alike(*pair) for pair in combinations(turning, 2)):
        return Refusal("translations of several limbs turn alike with the platform")
    seen = _from_the_platform(assembly)
    if isinstance(seen, Refusal):
        return seen
    mixed = [True for pair in zip(assembly.limbs, seen.limbs, strict=True) if _is_of_both(*pair, assembly.taken)]
    if len(mixed) > 1 or _size(seen) != _size(assembly):
        return Refusal("directions fixed in the platform decide together with some fixed in the base")
    return None


def _from_the_platform(assembly: HeldLimbs) -> HeldLimbs | Refusal:
    """The limbs as seen by the platform, where other directions stay fixed than in the base."""
    limbs = [seen_from_end(limb.limb) for limb in assembly.limbs if limb.limb]
    return assembled(limbs, Orientations(assembly.taken.dim, assembly.taken.axes[::-1]))


def _is_of_both(base: Motion, platform: Motion, taken: Orientations) -> bool:
    """Whether a limb translates along a direction fixed in the base and along another one fixed in the platform."""
    near, far = base.translations, platform.translations
    if not (near.fixed and near.turning and far.fixed and far.turning):
        return False
    lasting = taken.axes and all(parallel(axis, near.fixed[0]) for axis in taken.axes)
    return not (lasting and parallel(near.fixed[0], far.fixed[0]))


def _size(assembly: HeldLimbs) -> tuple[int, int]:
    return assembly.resisted.forces.dim, assembly.resisted.couples.dim
