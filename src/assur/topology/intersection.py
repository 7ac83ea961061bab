"""The intersection of Eq. (2): the POC set of a platform, from those of its limbs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from assur.topology.blocks import mirrored
from assur.topology.constraints import Resisted, resisted
from assur.topology.limb_steps import limb_derivation
from assur.topology.motion import Limb, Mode, Motion, motion_of
from assur.topology.orientations import EVERY, UNTURNED, Orientations, orientations, returns
from assur.topology.platform_set import is_helical, platform_set
from assur.topology.refusals import Refusal
from assur.topology.spans import Span


def parallel(motions: Sequence[Motion], mode: Mode = "free", name: str = "the platform") -> Motion | Refusal:
    """The motion of a platform that several limbs carry, by the rules of POC theory.

    Args:
        motions: of the limbs' end links, from `serial`.
        mode: "free", or "translation" where the platform keeps its orientation.
        name: what the derivation calls it.

    Returns:
        The motion with O' at a general point of the platform, or why the rules give none.

    >>> from assur.topology.chains import ChainJoint
    >>> from assur.topology.joints import PRISMATIC, REVOLUTE
    >>> from assur.topology.union import serial
    >>> x, y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    >>> limbs = [serial([ChainJoint(PRISMATIC, (u,)), *[ChainJoint(REVOLUTE, (u,))] * 3]) for u in (x, y)]
    >>> print(parallel(limbs).poc)
    t³ r⁰
    """
    limbs = [motion.limb for motion in motions if motion.limb is not None]
    if len(limbs) < len(motions):
        return Refusal("the pitch of a helical joint couples a rotation and a translation")
    found = _assembled(limbs, UNTURNED) if mode == "translation" else _as_written(limbs)
    if isinstance(found, Refusal):
        return found
    refusal = _does_not_last(found) if mode == "free" else None
    if refusal is not None:
        return refusal
    poc = platform_set(found.limbs, found.resisted)
    return Motion(
        poc=poc,
        restated=poc,
        translations=found.resisted.forces.complement,
        rotations=found.turned,
        orientations=found.taken,
        freedoms=poc.dim,
        conditions=tuple(dict.fromkeys(condition for limb in limbs for condition in limb.conditions)),
        helical=is_helical(found.limbs, found.resisted),
        derive=lambda: limb_derivation(motions, lambda some: parallel(some, mode), name),
    )


def xi_of_next(before: Motion, limb: Motion, after: Motion) -> int:
    """Independent equations of the loop that one more limb closes, Eq. (4).

    xi = dim{(intersection of the limbs so far) u M of the limb} = dim before + dim limb - dim after.

    Args:
        before: the platform's motion with the limbs so far.
        limb: the next limb's end link.
        after: the platform's motion with that limb too.
    """
    return before.dim + limb.dim - after.dim


@dataclass(frozen=True)
class Assembly:
    """Limbs held to the orientations of the platform that they carry, and what they resist."""

    limbs: tuple[Motion, ...]
    taken: Orientations
    resisted: Resisted

    @property
    def turned(self) -> Span:
        """Directions that the platform rotates about."""
        return self.resisted.couples.complement

    @property
    def freedoms(self) -> int:
        """Freedoms of the mechanism: of the platform, and those that leave it at rest."""
        return self.resisted.dim + sum(limb.passive for limb in self.limbs)


def _assembled(limbs: Sequence[Limb], taken: Orientations) -> Assembly | Refusal:
    """Limbs whose platform takes given orientations."""
    held = [motion_of(limb, taken) for limb in limbs]
    refusal = next((motion for motion in held if isinstance(motion, Refusal)), None)
    if refusal is not None:
        return refusal
    carried = tuple(motion for motion in held if isinstance(motion, Motion))
    found = resisted(carried, taken)
    return found if isinstance(found, Refusal) else Assembly(carried, taken, found)


def _as_written(limbs: Sequence[Limb]) -> Assembly | Refusal:
    """Limbs as they can move from the configuration as written.

    Where all limbs are unturned, the mechanism has as many freedoms as there are directions to leave that
    configuration in. If it does not turn then, it never does. Else it turns as far as it keeps as many freedoms.
    """
    still = _assembled(limbs, UNTURNED)
    if isinstance(still, Refusal):
        return still if any(returns(limb.structure) for limb in limbs) else _narrowed(limbs)
    if not still.turned.dim:
        return still
    if still.turned.dim == 1 and still.turned.is_fixed:
        about = _assembled(limbs, Orientations(1, still.turned.fixed))
        if isinstance(about, Assembly) and about.turned.dim == 1 and about.freedoms == still.freedoms:
            return about
    widest = _narrowed(limbs)
    if isinstance(widest, Refusal) or widest.freedoms == still.freedoms:
        return widest
    return Refusal("as written, the limbs are in a position from which they can move on in several modes")


def _narrowed(limbs: Sequence[Limb]) -> Assembly | Refusal:
    """Limbs whose platform takes every orientation that they leave it."""
    taken = _common_orientations(limbs)
    while not isinstance(taken, Refusal):
        found = _assembled(limbs, taken)
        if isinstance(found, Refusal) or found.turned.dim >= taken.dim:
            return found
        fixed = found.turned.dim == 1 and found.turned.is_fixed
        taken = Orientations(found.turned.dim, found.turned.fixed if fixed else ())
    return taken


def _common_orientations(limbs: Sequence[Limb]) -> Orientations | Refusal:
    """The orientations that every limb takes."""
    common: Orientations | Refusal = EVERY
    for limb in limbs:
        if isinstance(common, Refusal):
            return common
        common = common.meet(orientations(limb.structure))
    return common


def _does_not_last(found: Assembly) -> Refusal | None:
    """Why what the platform does as written is not what it goes on to do, where that is so."""
    rods = any(limb.structure is not None and limb.structure.rods for limb in found.limbs)
    if found.turned.dim > found.taken.dim and not rods:
        return Refusal("the limbs leave the platform a rotation that does not last as it turns")
    turning = [limb for limb in found.limbs if 0 < limb.translations.dim < 3 and limb.translations.turning]
    if not found.taken.dim or len(turning) < 2:
        return None
    if found.taken.dim == 2 and found.taken.axes:
        return Refusal("translations of several limbs turn with the platform")
    seen = found.resisted
    if _from_the_platform(found) != (seen.forces.dim, seen.couples.dim):
        return Refusal("directions fixed in the platform decide together with some fixed in the base")
    return None


def _from_the_platform(found: Assembly) -> tuple[int, int] | None:
    """Numbers of forces and couples as seen by the platform, where other directions stay fixed than in the base."""
    limbs = [replace(limb.limb, structure=mirrored(limb.limb.structure)) for limb in found.limbs if limb.limb]
    seen = _assembled(limbs, Orientations(found.taken.dim, found.taken.axes[::-1]))
    return None if isinstance(seen, Refusal) else (seen.resisted.forces.dim, seen.resisted.couples.dim)
