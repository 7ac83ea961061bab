"""The POC set of a platform at a general point, from what its limbs resist."""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.poc import Mark, PocSet
from assur.topology.rules.constraints import Resisted, resists_purely
from assur.topology.rules.marks import MOVING, rotation_mark, translation_mark
from assur.topology.rules.motion import Motion
from assur.topology.rules.spans import Span, perpendicular


def platform_set(limbs: Sequence[Motion], found: Resisted) -> PocSet:
    """The POC set at a general point O'.

    t = dim M - 3 + rank of the moments about O' of all that is resisted: what is resisted by a force through O', and
    by nothing else, O' cannot feel.
    """
    resisting = [limb for limb in limbs if limb.dim < 6]
    if len(resisting) == 1:
        return resisting[0].restated
    chains = [limb.structure for limb in limbs if limb.structure is not None]
    moved, turned = found.forces.complement, found.couples.complement
    t = found.dim - 3 + _rank_of_moments(limbs, found)
    seen = moved if t == moved.dim else _with_rotation(t, turned, found)
    mark = translation_mark(seen, *chains)
    if mark.relation == "arm":
        mark = _arm(limbs, (t, turned.dim, found.dim))
    return PocSet(t, turned.dim, found.dim, mark, rotation_mark(turned, *chains))


def _arm(limbs: Sequence[Motion], numbers: tuple[int, int, int]) -> Mark:
    """The arm of the limb that has no other motion than the platform; else the platform's centre of rotation moves."""
    sets = [limb.restated for limb in limbs]
    return next((item.t_mark for item in sets if (item.t, item.r, item.dim) == numbers), MOVING)


def is_helical(limbs: Sequence[Motion], found: Resisted) -> bool:
    """Whether the one rotation advances along its axis, and nothing else translates along it."""
    turned = found.couples.complement
    if turned.dim != 1 or not turned.is_fixed:
        return False
    axis = turned.fixed[0]
    return found.forces.contains(axis) and not any(resists_purely(limb, axis) for limb in limbs)


def _rank_of_moments(limbs: Sequence[Motion], found: Resisted) -> int:
    """Couples, and moments of forces on general lines about a general point."""
    forces, couples = found.forces, found.couples
    planar = forces.dim == 1 and forces.is_fixed and couples.dim == 2 and couples.contains_plane(forces.fixed[0])
    if planar and any(resists_purely(limb, forces.fixed[0]) for limb in limbs):
        return 2
    through_one_point = all(limb.concurrent and limb.forces.dim == 3 for limb in limbs if limb.dim < 6)
    if not couples.dim and forces.dim == 3 and through_one_point:
        return 2
    return min(3, forces.dim + couples.dim)


def _with_rotation(t: int, turned: Span, found: Resisted) -> Span:
    """Directions in which O' moves, where rotation about a fixed axis adds to pure translations."""
    if turned.dim == 1 and turned.is_fixed and found.forces.contains(turned.fixed[0]):
        return perpendicular(turned.fixed[0]) if t == 2 else Span((), t, turned.fixed[0])
    return Span((), t)
