"""Operation modes: how the platform of some limbs can move on from the configuration as written.

It may keep its orientation, turn about one axis, or take every orientation that its limbs leave it. Where it can go
on in several of these ways, there is no one answer.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce

from assur.topology.directions import parallel
from assur.topology.symbolic.blocks import Block, Structure
from assur.topology.symbolic.blocks import structure as gathered
from assur.topology.symbolic.constraints import Resisted, resisted
from assur.topology.symbolic.elementary import Slide, Turn
from assur.topology.symbolic.motion import Limb, Motion, motion_at_home, motion_of
from assur.topology.symbolic.orientations import (
    EVERY,
    UNTURNED,
    Orientations,
    at_rest,
    axes_around,
    orientations,
    returns,
    without_axes,
    without_still_axes,
)
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import rotations, translations
from assur.topology.symbolic.spans import Span


@dataclass(frozen=True)
class HeldLimbs:
    """Limbs held to the orientations of the platform that they carry, and what they resist."""

    limbs: tuple[Motion, ...]
    taken: Orientations
    resisted: Resisted

    @property
    def turned(self) -> Span:
        """Directions that the platform rotates about."""
        return self.resisted.couples.complement

    @property
    def has_rods(self) -> bool:
        """Whether some limbs rotate about rods, which is no finite rotation while they are parallelograms."""
        return any(limb.structure is not None and limb.structure.rods for limb in self.limbs)

    @property
    def freedoms(self) -> int:
        """Freedoms of the mechanism: of the platform, and those that leave it at rest."""
        return self.resisted.dim + sum(limb.passive for limb in self.limbs)


def assembled(limbs: Sequence[Limb], taken: Orientations) -> HeldLimbs | Refusal:
    """Limbs whose platform takes given orientations."""
    return _together([motion_of(limb, taken) for limb in limbs], taken)


def _together(motions: Sequence[Motion | Refusal], taken: Orientations) -> HeldLimbs | Refusal:
    refusal = next((motion for motion in motions if isinstance(motion, Refusal)), None)
    if refusal is not None:
        return refusal
    carried = tuple(motion for motion in motions if isinstance(motion, Motion))
    fewer = [motion.orientations for motion in carried if motion.orientations.dim < taken.dim]
    least = _common(fewer) if fewer else taken
    if isinstance(least, Refusal):
        return least
    constraint = resisted(carried, least)
    return constraint if isinstance(constraint, Refusal) else HeldLimbs(carried, least, constraint)


def as_written(limbs: Sequence[Limb]) -> HeldLimbs | Refusal:
    """Limbs as they can move from the configuration as written.

    The mechanism leaves it in as many directions as it has freedoms there, and moves on in one mode where it keeps
    as many: with the platform unturned, turning about one axis, or taking every orientation that the limbs leave.
    """
    home = _at_home(limbs)
    if isinstance(home, Refusal):
        return home
    still = assembled(limbs, UNTURNED)
    if isinstance(still, Refusal):
        returning = any(returns(limb.structure) for limb in limbs)
        return still if returning else _narrowed(limbs, _allowed(limbs))
    for mode in _modes(limbs, home, still):
        if isinstance(mode, Refusal) or _goes_on(home, mode):
            return mode
    return Refusal("as written, the limbs are in a position from which they can move on in several modes")


def _at_home(limbs: Sequence[Limb]) -> HeldLimbs | Refusal:
    """Limbs in the one configuration as written."""
    return _together([motion_at_home(limb) for limb in limbs], UNTURNED)


def _goes_on(home: HeldLimbs, mode: HeldLimbs) -> bool:
    """Whether a mode starts at home: as many freedoms as there, and a platform that can do no less."""
    more = mode.resisted.dim >= home.resisted.dim and mode.turned.dim >= home.turned.dim
    return more and mode.freedoms == home.freedoms


def _modes(limbs: Sequence[Limb], home: HeldLimbs, still: HeldLimbs) -> Iterator[HeldLimbs | Refusal]:
    """Ways in which a platform may turn, the least first."""
    yield _sliding(limbs)
    common = _allowed(limbs)
    if not still.turned.dim or (common == UNTURNED and still.has_rods):
        yield still
    for turned in (home.turned, still.turned):
        if turned.dim == 1 and turned.is_fixed:
            about = assembled(limbs, Orientations(1, turned.fixed))
            if isinstance(about, HeldLimbs) and about.turned.dim == about.taken.dim == 1 and _turns(about):
                yield about
    if common != UNTURNED:
        yield _narrowed(limbs, common)


def _sliding(limbs: Sequence[Limb]) -> HeldLimbs | Refusal:
    """Limbs in which nothing turns.

    Where they have all freedoms of home they are the mechanism: no link ever turns, and slides that were written
    parallel stay so, which the other modes take to part.
    """
    sliding = []
    for limb in limbs:
        slides = tuple(part for part in limb.chain if isinstance(part, Slide))
        freedoms = sum(slide.span.dim for slide in slides)
        sliding.append(replace(limb, chain=slides, structure=gathered(slides), freedoms=freedoms))
    return assembled(sliding, UNTURNED)


def _turns(assembly: HeldLimbs) -> bool:
    """Whether limbs let the platform turn with those axes at rest that alone would turn it out of its orientations."""
    rest = [_moving_as(motion, without_still_axes(motion.structure)) for motion in assembly.limbs if motion.structure]
    constraint = resisted(rest, assembly.taken)
    return isinstance(constraint, Resisted) and constraint.couples.complement.dim == assembly.taken.dim


def _moving_as(motion: Motion, kept: Structure) -> Motion:
    """A limb with another structure."""
    return replace(motion, structure=kept, rotations=rotations(kept), translations=translations(kept))


def unturned(limbs: Sequence[Limb]) -> HeldLimbs | Refusal:
    """Limbs whose platform keeps its orientation.

    First and last axes of a limb that turn against each other do so only where the platform's translations need it,
    or where the limb moves within itself.
    """
    assembly, home, sliding = assembled(limbs, UNTURNED), _at_home(limbs), _sliding(limbs)
    if isinstance(assembly, Refusal):
        return assembly
    if isinstance(sliding, HeldLimbs) and isinstance(home, HeldLimbs) and _goes_on(home, sliding):
        return sliding
    motions, moved = list(assembly.limbs), [limb.translations for limb in assembly.limbs]
    for index, motion in enumerate(assembly.limbs):
        around = axes_around(motion.structure) if motion.structure else None
        if motion.structure is None or around is None:
            continue
        rest = without_axes(motion.structure, around)
        fewer = [*moved[:index], translations(rest), *moved[index + 1 :]]
        if _common_translations(fewer) == _common_translations(moved) and _idle(motion, around, rest) == motion.passive:
            kept = at_rest(motion.structure, around)
            motions[index] = _moving_as(motion, kept)
            moved = fewer
    return _together(motions, UNTURNED)


def _common_translations(spans: Sequence[Span]) -> int:
    return reduce(Span.meet, spans).dim


def _idle(motion: Motion, around: Block, rest: Structure) -> int:
    """Freedoms of a limb that do not move its end link, without the axes around the rest."""
    chain = motion.limb.chain if motion.limb else ()
    removed = sum(isinstance(part, Turn) and parallel(part.direction, around.direction) for part in chain)
    return motion.freedoms - removed - translations(rest).dim - rotations(rest).dim


def _narrowed(limbs: Sequence[Limb], taken: Orientations | Refusal) -> HeldLimbs | Refusal:
    """Limbs whose platform takes every one of some orientations that they leave it."""
    while not isinstance(taken, Refusal):
        assembly = assembled(limbs, taken)
        if isinstance(assembly, Refusal) or assembly.turned.dim >= assembly.taken.dim == taken.dim:
            return assembly
        if assembly.taken.dim < taken.dim:
            taken = assembly.taken
            continue
        fixed = assembly.turned.dim == 1 and assembly.turned.is_fixed
        taken = Orientations(assembly.turned.dim, assembly.turned.fixed if fixed else ())
    return taken


def _allowed(limbs: Sequence[Limb]) -> Orientations | Refusal:
    """The orientations that every limb takes."""
    return _common(orientations(limb.structure) for limb in limbs)


def _common(sets: Iterable[Orientations]) -> Orientations | Refusal:
    """The orientations in every set."""
    common: Orientations | Refusal = EVERY
    for taken in sets:
        if isinstance(common, Refusal):
            return common
        common = common.meet(taken)
    return common
