"""The POC set of a platform at a general point, or where its limbs end, from what they resist."""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.directions import parallel
from assur.topology.poc import Mark, PocSet
from assur.topology.symbolic.constraints import Resisted, have_common_end, resists_purely, share_a_point
from assur.topology.symbolic.marks import MOVING, rotation_mark, translation_mark
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spans import ALL, NOTHING, Span, plane_across
from assur.topology.symbolic.subgroups import word


def platform_set(limbs: Sequence[Motion], resisted: Resisted, at: str = "") -> PocSet | Refusal:
    """The POC set at a general point O', or at the labelled point in which the limbs end.

    t = dim M - 3 + rank of the moments about O' of all that is resisted: what is resisted by a force through O', and
    by nothing else, O' cannot feel. Where every limb can make all its rotations about O', all forces run through it,
    and the linear rules hold.
    """
    resisting = [limb for limb in limbs if limb.dim < 6]
    if at:
        return _at_common_end(resisting, resisted, at)
    if len(resisting) == 1:
        return resisting[0].restated
    if (
        resisted.forces.dim == 3
        and not resisted.couples.dim
        and share_a_point(resisting)
        and not _through_one_point(resisting)
    ):
        return Refusal("limbs share a point, and whether their forces run through it decides how O' moves")
    chains = [limb.structure for limb in limbs if limb.structure is not None]
    moved, turned = resisted.forces.complement, resisted.couples.complement
    t = resisted.dim - 3 + _rank_of_moments(limbs, resisted)
    seen = moved if t == moved.dim else _with_rotation(t, turned, resisted)
    mark = translation_mark(seen, *chains)
    if mark.relation == "arm":
        mark = _arm(limbs, (t, turned.dim, resisted.dim))
    return PocSet(t, turned.dim, resisted.dim, mark, rotation_mark(turned, *chains))


def _at_common_end(resisting: Sequence[Motion], resisted: Resisted, at: str) -> PocSet | Refusal:
    """The POC set at the point about which all limbs can turn."""
    chains = [limb.structure for limb in resisting if limb.structure is not None]
    moved, turned = resisted.forces.complement, resisted.couples.complement
    if any(limb.turns_about != at for limb in resisting):
        t, most = (resisted.dim - _rotations_about(resisting, at, most=most).dim for most in (True, False))
        if t < most:
            return Refusal("O' lies on the last axes of limbs that can make several rotations about it")
        moved = moved if t == moved.dim else ALL if t == 3 else Span((), t)
    return PocSet(moved.dim, turned.dim, resisted.dim, translation_mark(moved, *chains), rotation_mark(turned, *chains))


def _rotations_about(resisting: Sequence[Motion], at: str, *, most: bool) -> Span:
    """Rotations that all limbs can make about a point of the platform, in its directions: at most, or in general."""
    common = ALL
    for limb in resisting:
        count = limb.dim - limb.seen_at(at).t
        known = _turning_about(limb, at)
        known = known if known.dim == count else Span((), count)
        common = common.meet(ALL if count == 3 or (most and known.turning) else known)
    return common


def _turning_about(limb: Motion, at: str) -> Span:
    """The rotations about a point of the end link, in its directions, that a limb's subgroups have."""
    turning = [block.direction for block in limb.structure.blocks if block.net] if limb.structure else []
    span = NOTHING
    for letter in (word(limb.limb.chain) or ()) if limb.limb else ():
        if letter.ball:
            span = ALL if at in letter.points else span.turned(None)
        if letter.axis is None:
            continue
        if any(parallel(axis, letter.axis) for axis in turning):
            span = span.turned(letter.axis)
        if at in letter.points or not letter.has_place:
            span = span.with_direction(letter.axis)
    return span


def _arm(limbs: Sequence[Motion], numbers: tuple[int, int, int]) -> Mark:
    """The arm of the limb that has no other motion than the platform; else the platform's centre of rotation moves."""
    sets = [limb.restated for limb in limbs]
    return next((poc.t_mark for poc in sets if (poc.t, poc.r, poc.dim) == numbers), MOVING)


def is_helical(limbs: Sequence[Motion], resisted: Resisted) -> bool:
    """Whether the one rotation advances along its axis, and nothing else translates along it."""
    turned = resisted.couples.complement
    if turned.dim != 1 or not turned.is_fixed:
        return False
    axis = turned.fixed[0]
    return resisted.forces.contains(axis) and not any(resists_purely(limb, axis) for limb in limbs)


def _rank_of_moments(limbs: Sequence[Motion], resisted: Resisted) -> int:
    """Couples, and moments of forces on general lines about a general point."""
    forces, couples = resisted.forces, resisted.couples
    planar = forces.dim == 1 and forces.is_fixed and couples.dim == 2 and couples.contains_plane(forces.fixed[0])
    if planar and any(resists_purely(limb, forces.fixed[0]) for limb in limbs):
        return 2
    resisting = [limb for limb in limbs if limb.dim < 6]
    if not couples.dim and forces.dim == 3 and _through_one_point(resisting):
        return 2
    return min(3, forces.dim + couples.dim)


def _through_one_point(resisting: Sequence[Motion]) -> bool:
    """Whether all forces that limbs resist run through one point."""
    return all(limb.concurrent and limb.forces.dim == 3 for limb in resisting) or have_common_end(resisting)


def _with_rotation(t: int, turned: Span, resisted: Resisted) -> Span:
    """Directions in which O' moves, where rotation about a fixed axis adds to pure translations."""
    if turned.dim == 1 and turned.is_fixed and resisted.forces.contains(turned.fixed[0]):
        return plane_across(turned.fixed[0]) if t == 2 else Span((), t, turned.fixed[0])
    return Span((), t)
