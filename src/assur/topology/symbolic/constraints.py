"""What limbs resist together: forces and couples, and the couples that come of forces on different lines.

A limb resists the couples perpendicular to its rotations and forces perpendicular to its pure translations. The
platform translates along what no force of any limb resists. Where two limbs resist the same direction of force, on
two lines, they resist a couple too: there the linear rules end and location decides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

from assur.topology.directions import Vector, parallel
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.orientations import Orientations
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.shared_lines import shared_line
from assur.topology.symbolic.spans import NOTHING, Span
from assur.topology.symbolic.subgroups import axes_through


@dataclass(frozen=True)
class Resisted:
    """What some limbs resist.

    Attributes:
        forces: directions of forces.
        couples: directions of couples.
        located: whether forces on different lines added a couple.
    """

    forces: Span = NOTHING
    couples: Span = NOTHING
    located: bool = False

    @property
    def dim(self) -> int:
        """Freedoms of the platform that are left, dim M."""
        return 6 - self.forces.dim - self.couples.dim


def resisted(limbs: Sequence[Motion], taken: Orientations) -> Resisted | Refusal:
    """What all limbs resist, one after the other.

    Args:
        limbs: held to the orientations that the platform takes.
        taken: those orientations.
    """
    total = Resisted()
    for index, limb in enumerate(limbs):
        before = limbs[:index]
        couples = total.couples if _same_plane(limb, before, taken) else total.couples.with_span(limb.couples)
        shared = total.forces.meet(limb.forces)
        through_one_point = have_common_end([motion for motion in (*before, limb) if motion.dim < 6])
        related = couples if through_one_point else _with_relations(couples, shared, limb, before)
        located = related != couples
        if located and _common_labels(limb, before) and not _one_centre(limb, before):
            line = shared_line([motion for motion in (*before, limb) if motion.dim < 6], taken)
            if not (line and shared.dim == 1 and shared.contains(line)):
                return Refusal("limbs share a point, and where their axes lie decides what they resist")
            related = couples.with_line(in_plane=line)
        total = Resisted(total.forces.with_span(limb.forces), related, total.located or located)
    return total


def _same_plane(limb: Motion, before: Sequence[Motion], taken: Orientations) -> bool:
    """Whether a limb turns about the same two axes as one before it, and resists the same couple."""
    return taken.dim == 2 and limb.rotations.dim == 2 and any(other.rotations.dim == 2 for other in before)


def _with_relations(couples: Span, shared: Span, limb: Motion, before: Sequence[Motion]) -> Span:
    """Couples with those that a limb's forces make with parallel forces of other limbs."""
    if shared.dim == 1 and shared.is_fixed:
        axis = shared.fixed[0]
        pure = limb.pure_along(axis) and any(resists_purely(other, axis) for other in before)
        return couples.with_line(in_plane=axis if pure else None)
    count = shared.dim
    if shared.dim == 3 and limb.concurrent and any(_fixes_a_point(other) for other in before):
        count = 0 if _one_centre(limb, before) else 2
    for _ in range(count):
        couples = couples.with_line()
    return couples


def have_common_end(limbs: Sequence[Motion]) -> bool:
    """Whether limbs can make all their rotations about one point of the end link: their forces run through it."""
    return len({limb.turns_about for limb in limbs}) == 1 and bool(limbs[0].turns_about)


def resists_purely(limb: Motion, axis: Vector) -> bool:
    """Whether a limb resists a force along an axis, and no couple about it comes with that."""
    return limb.forces.contains(axis) and limb.pure_along(axis)


def _fixes_a_point(limb: Motion) -> bool:
    return limb.concurrent and limb.forces.dim == 3


def _one_centre(limb: Motion, before: Sequence[Motion]) -> bool:
    """Whether a limb turns about the same labelled point as one before it."""
    centre = limb.limb.centre if limb.limb else ""
    return bool(centre) and any(_fixes_a_point(other) and _centre(other) == centre for other in before)


def _centre(limb: Motion) -> str:
    return limb.limb.centre if limb.limb else ""


def _common_labels(limb: Motion, before: Sequence[Motion]) -> bool:
    return any(_share(limb, other) for other in before)


def share_a_point(limbs: Sequence[Motion]) -> bool:
    """Whether axes of two limbs run through one labelled point, and that ties what they resist."""
    return any(_common_labels(limb, limbs[:index]) for index, limb in enumerate(limbs))


def _share(limb: Motion, other: Motion) -> bool:
    """Whether two limbs turn about one line, or have several axes each through one point, where forces then meet.

    One axis of each through a point, and not the same one, leaves it open where the forces are that meet them.
    """
    if limb.limb is None or other.limb is None:
        return False
    for label in limb.limb.labels & other.limb.labels:
        first, second = (axes_through(label, motion.limb.chain) for motion in (limb, other) if motion.limb)
        if min(len(first), len(second)) > 1 or any(_may_be_one(*pair) for pair in product(first, second)):
            return True
    return False


def _may_be_one(first: Vector | None, second: Vector | None) -> bool:
    return first is None or second is None or parallel(first, second)
