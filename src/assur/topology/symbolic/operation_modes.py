"""Operation modes: how the platform of some limbs can move on from the configuration as written.

It may keep its orientation, turn about one axis, or take every orientation that its limbs leave it. Where it can go
on in several of these ways, there is no one answer.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from itertools import combinations, product, takewhile

from assur.topology.directions import parallel
from assur.topology.symbolic.blocks import Block, Structure
from assur.topology.symbolic.blocks import structure as gathered
from assur.topology.symbolic.constraints import Resisted, resisted
from assur.topology.symbolic.elementary import Elementary, Slide, Turn
from assur.topology.symbolic.motion import Limb, Motion, motion_at_home, motion_of
from assur.topology.symbolic.orientations import (
    EVERY,
    UNTURNED,
    Orientations,
    at_rest,
    axes_that_may_rest,
    orientations,
    returns,
    sphere_of,
    without_axes,
    without_still_axes,
)
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import rotations, translations
from assur.topology.symbolic.spans import Span


@dataclass(frozen=True)
class HeldLimbs:
    """Limbs held to the orientations of the platform that they carry, and what they resist.

    `from_platform` says that this is as the platform sees them: its directions are not fixed in the base.
    """

    limbs: tuple[Motion, ...]
    taken: Orientations
    resisted: Resisted
    from_platform: bool = False

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

    Axes of a limb that turn only against each other, as its first and last, or against a spherical joint, do so only
    where the platform's translations need it, or where the limb moves within itself.
    """
    assembly, home, sliding = assembled(limbs, UNTURNED), _at_home(limbs), _sliding(limbs)
    if isinstance(assembly, Refusal):
        return assembly
    if isinstance(sliding, HeldLimbs) and isinstance(home, HeldLimbs) and _goes_on(home, sliding):
        return sliding
    return _together([limb.motion for limb in _resting(assembly.limbs)], UNTURNED)


def _resting(limbs: Sequence[Motion]) -> Sequence[_RestingAxes]:
    """Limbs with as many axes at rest as can be.

    They are tried together: what two limbs turn for each other's sake, neither turns where both rest.
    """
    choices = [_resting_axes(limb) for limb in limbs]
    moving = [choice[0] for choice in choices]
    free = _common_translations(moving)
    most_at_rest = sorted(product(*choices), key=lambda chosen: -sum(len(limb.axes) for limb in chosen))
    return next(chosen for chosen in most_at_rest if _common_translations(chosen) >= free)


def _resting_axes(limb: Motion) -> list[_RestingAxes]:
    """A limb with none of its axes at rest, and with every choice of those that turn only against each other."""
    axes = axes_that_may_rest(limb.structure) if limb.structure else ()
    choices = [chosen for count in range(1, len(axes) + 1) for chosen in combinations(axes, count)]
    resting = [reduce(_RestingAxes.with_axes, chosen, _RestingAxes(limb, limb.structure)) for chosen in choices]
    return [_RestingAxes(limb, limb.structure), *(chosen for chosen in resting if chosen.idle >= limb.passive)]


@dataclass(frozen=True)
class _RestingAxes:
    """A limb with axes at rest that could turn: what moves its end link is a chain without them."""

    limb: Motion
    moving: Structure | None
    axes: tuple[Block, ...] = ()

    def with_axes(self, axes: Block) -> _RestingAxes:
        """The same with more axes at rest."""
        moving = without_axes(self.moving, axes) if self.moving else None
        return _RestingAxes(self.limb, moving, (*self.axes, axes))

    @cached_property
    def translations(self) -> Span:
        """Those of the end link."""
        return translations(self.moving) if self.axes and self.moving else self.limb.translations

    @property
    def idle(self) -> int:
        """Freedoms of the limb that do not move its end link."""
        at_rest = sum(self._turns(axes) for axes in self.axes)
        rotating = rotations(self.moving).dim if self.moving else 0
        return self.limb.freedoms - at_rest - self.translations.dim - rotating

    def _turns(self, axes: Block) -> int:
        """How many of the limb's turns are about some axes: where it has a spherical joint, on their side of it."""
        chain: Sequence[Elementary] = self.limb.limb.chain if self.limb.limb else ()
        structure = self.limb.structure
        sphere = {line.name for block in sphere_of(structure) for line in block.lines} if structure else set()
        if structure is not None and sphere:
            outwards = chain[::-1] if axes in structure.beyond else chain
            chain = tuple(takewhile(lambda part: part.name not in sphere, outwards))
        return sum(isinstance(part, Turn) and parallel(part.direction, axes.direction) for part in chain)

    @property
    def motion(self) -> Motion:
        """The limb's, whose axes at rest still could turn."""
        if self.limb.structure is None:
            return self.limb
        return _moving_as(self.limb, reduce(at_rest, self.axes, self.limb.structure)) if self.axes else self.limb


def _common_translations(limbs: Sequence[_RestingAxes]) -> int:
    return reduce(Span.meet, (limb.translations for limb in limbs)).dim


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
