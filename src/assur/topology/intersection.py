"""The intersection of Eq. (2): the POC set of a platform, from those of its limbs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from assur.topology.blocks import mirrored
from assur.topology.constraints import Resisted, resisted
from assur.topology.limb_steps import limb_derivation
from assur.topology.motion import Limb, Mode, Motion, motion_at_home, motion_of
from assur.topology.orientations import EVERY, UNTURNED, Orientations, orientations, returns, turn_alike
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
        translations=found.resisted.forces.complement,
        rotations=found.turned,
        orientations=found.taken,
        freedoms=poc.dim,
        given=poc,
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
    return _together([motion_of(limb, taken) for limb in limbs], taken)


def _together(motions: Sequence[Motion | Refusal], taken: Orientations) -> Assembly | Refusal:
    refusal = next((motion for motion in motions if isinstance(motion, Refusal)), None)
    if refusal is not None:
        return refusal
    carried = tuple(motion for motion in motions if isinstance(motion, Motion))
    common = _common([motion.orientations for motion in carried])
    if isinstance(common, Refusal):
        return common
    least = min(common, taken, key=lambda item: item.dim)
    found = resisted(carried, least)
    return found if isinstance(found, Refusal) else Assembly(carried, least, found)


def _as_written(limbs: Sequence[Limb]) -> Assembly | Refusal:
    """Limbs as they can move from the configuration as written.

    The mechanism leaves it in as many directions as it has freedoms there, and moves on in one mode where it keeps
    as many: with the platform unturned, turning about one axis, or taking every orientation that the limbs leave.
    """
    home = _together([motion_at_home(limb) for limb in limbs], UNTURNED)
    if isinstance(home, Refusal):
        return home
    still = _assembled(limbs, UNTURNED)
    if isinstance(still, Refusal):
        return still if any(returns(limb.structure) for limb in limbs) else _narrowed(limbs, _common(orientations(limb.structure) for limb in limbs))
    for found in _modes(limbs, still):
        if isinstance(found, Refusal) or found.freedoms == home.freedoms:
            return found
    return Refusal("as written, the limbs are in a position from which they can move on in several modes")


def _modes(limbs: Sequence[Limb], still: Assembly) -> Iterator[Assembly | Refusal]:
    """Ways in which a platform may turn, the least first."""
    if not still.turned.dim:
        yield still
    if still.turned.dim == 1 and still.turned.is_fixed:
        about = _assembled(limbs, Orientations(1, still.turned.fixed))
        if isinstance(about, Assembly) and about.turned.dim == about.taken.dim == 1:
            yield about
    taken = _common(orientations(limb.structure) for limb in limbs)
    if taken != UNTURNED:
        yield _narrowed(limbs, taken)


def _narrowed(limbs: Sequence[Limb], taken: Orientations | Refusal) -> Assembly | Refusal:
    """Limbs whose platform takes every one of some orientations that they leave it."""
    while not isinstance(taken, Refusal):
        found = _assembled(limbs, taken)
        if isinstance(found, Refusal) or found.turned.dim >= found.taken.dim == taken.dim:
            return found
        if found.taken.dim < taken.dim:
            taken = found.taken
            continue
        fixed = found.turned.dim == 1 and found.turned.is_fixed
        taken = Orientations(found.turned.dim, found.turned.fixed if fixed else ())
    return taken


def _common(sets: Iterable[Orientations]) -> Orientations | Refusal:
    """The orientations in every set."""
    common: Orientations | Refusal = EVERY
    for one in sets:
        if isinstance(common, Refusal):
            return common
        common = common.meet(one)
    return common


def _does_not_last(found: Assembly) -> Refusal | None:
    """Why what the platform does as written is not what it goes on to do, where that is so."""
    rods = any(limb.structure is not None and limb.structure.rods for limb in found.limbs)
    if found.turned.dim > found.taken.dim and not rods:
        return Refusal("the limbs leave the platform a rotation that does not last as it turns")
    turning = [limb.structure for limb in found.limbs if limb.structure and limb.translations.turning]
    if not found.taken.dim or len(turning) < 2:
        return None
    if any(turn_alike(*pair) for pair in combinations(turning, 2)):
        return Refusal("translations of several limbs turn alike with the platform")
    seen = _from_the_platform(found)
    if isinstance(seen, Refusal):
        return seen
    mixed = [a for a, b in zip(found.limbs, seen.limbs, strict=True) if _is_partly_fixed(a) and _is_partly_fixed(b)]
    if len(mixed) > 1 or _size(seen) != _size(found):
        return Refusal("directions fixed in the platform decide together with some fixed in the base")
    return None


def _from_the_platform(found: Assembly) -> Assembly | Refusal:
    """The limbs as seen by the platform, where other directions stay fixed than in the base."""
    limbs = [replace(limb.limb, structure=mirrored(limb.limb.structure)) for limb in found.limbs if limb.limb]
    return _assembled(limbs, Orientations(found.taken.dim, found.taken.axes[::-1]))


def _is_partly_fixed(limb: Motion) -> bool:
    """Whether translations turn, but not every way."""
    moved = limb.translations
    return moved.turning > 0 and bool(moved.fixed or moved.complement.fixed or moved.plane or moved.complement.plane)


def _size(found: Assembly) -> tuple[int, int]:
    return found.resisted.forces.dim, found.resisted.couples.dim
