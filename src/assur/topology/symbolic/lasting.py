"""Whether what a platform does lasts: directions that agree as written may part as it turns, or stay together.

Links inside different limbs turn independently, except where they are fixed in the base, fixed in the platform, or
turned about the same axes to the same orientation. The first is what the rules assume; the others are checked here.
Where nothing that limbs resist is fixed in the base, what is fixed in the platform decides: the base moves against the
platform as the platform against the base, with as many elements at a general point.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

from assur.topology.directions import parallel
from assur.topology.symbolic.motion import Motion, seen_from_end
from assur.topology.symbolic.operation_modes import HeldLimbs, as_written, assembled
from assur.topology.symbolic.orientations import EVERY, Orientations, turn_alike
from assur.topology.symbolic.refusals import Refusal


def as_it_lasts(assembly: HeldLimbs) -> HeldLimbs | Refusal:
    """What the platform does as written, as the base sees it or the platform, or why it does not go on to do that."""
    refusal = _not_alone(assembly)
    if refusal is not None:
        return refusal
    refusal = _not_of_both(assembly)
    spans = [span for limb in assembly.limbs for span in (limb.forces, limb.couples)]
    if refusal is None or any(span.fixed or span.plane is not None for span in spans):
        return refusal or assembly
    seen = as_written([seen_from_end(limb.limb) for limb in assembly.limbs if limb.limb])
    if isinstance(seen, Refusal):
        return refusal
    return refusal if _not_alone(seen) else replace(seen, from_platform=True)


def _not_alone(assembly: HeldLimbs) -> Refusal | None:
    """Why it does not last as one of the two sees it."""
    if assembly.turned.dim > assembly.taken.dim and not assembly.has_rods:
        return Refusal("the limbs leave the platform a rotation that does not last as it turns")
    turning = [limb.structure for limb in assembly.limbs if limb.structure and limb.translations.turning]
    if assembly.taken.dim and any(turn_alike(*pair) for pair in combinations(turning, 2)):
        return Refusal("translations of several limbs turn alike with the platform")
    return None


def _not_of_both(assembly: HeldLimbs) -> Refusal | None:
    """Why base and platform do not see the same."""
    turning = [limb for limb in assembly.limbs if limb.structure and limb.translations.turning]
    if not assembly.taken.dim or len(turning) < 2:
        return None
    seen = _from_the_platform(assembly)
    if isinstance(seen, Refusal):
        return seen
    mixed = [pair for pair in zip(assembly.limbs, seen.limbs, strict=True) if _is_of_both(*pair, assembly.taken)]
    alike = assembly.taken != EVERY or any(_force_alike(*pair) for pair in combinations(mixed, 2))
    if (len(mixed) > 1 and alike) or _size(seen) != _size(assembly):
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


def _force_alike(first: tuple[Motion, Motion], second: tuple[Motion, Motion]) -> bool:
    """Whether two limbs of both kinds resist parallel forces, each seen by the base and by the platform.

    One that translates along a of the base and b of the platform resists a force along a x R b. Where the platform
    takes every orientation R, two of these are parallel only if their a and their b are. Of more, no two of which are,
    three are independent unless all a or all b are parallel: one R turns b1 into a2, and turns about it until b3 is in
    no plane with a2 and a3. That is what base and platform see by themselves.
    """
    sides = zip(first, second, strict=True)
    return all(parallel(one.translations.fixed[0], other.translations.fixed[0]) for one, other in sides)


def _size(assembly: HeldLimbs) -> tuple[int, int]:
    return assembly.resisted.forces.dim, assembly.resisted.couples.dim
