"""The intersection of Eq. (2): the POC set of a platform, from those of its limbs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from assur.errors import UsageError
from assur.topology.poc import Mark, PocSet
from assur.topology.symbolic.lasting import as_it_lasts
from assur.topology.symbolic.limb_steps import limb_derivation
from assur.topology.symbolic.marks import MOVING
from assur.topology.symbolic.motion import Limb, Mode, Motion, check_mode, motion_of
from assur.topology.symbolic.operation_modes import HeldLimbs, as_written, unturned
from assur.topology.symbolic.orientations import EVERY, Orientations
from assur.topology.symbolic.platform_set import is_helical, platform_set
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spans import ALL, NOTHING
from assur.topology.symbolic.subgroups import parts_that_all_allow, share_a_sphere, that_hold_back


def parallel(
    motions: Sequence[Motion], mode: Mode = "free", name: str = "the platform", at: str = ""
) -> Motion | Refusal:
    """The motion of a platform that several limbs carry, by the rules of POC theory.

    Args:
        motions: of the limbs' end links, from `serial`.
        mode: "free", or "translation" where the platform keeps its orientation.
        name: what the derivation calls it.
        at: label of the limbs' common end where O' is; a general point of the platform by default.

    Returns:
        The motion with O' there, or why the rules give none.

    Errors:
        UsageError: no limb, or another mode.

    >>> from assur.topology.chains import ChainJoint
    >>> from assur.joints.prismatic import PRISMATIC
    >>> from assur.joints.revolute import REVOLUTE
    >>> from assur.topology.symbolic.union import serial
    >>> x, y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    >>> limbs = [serial([ChainJoint(PRISMATIC, (u,)), *[ChainJoint(REVOLUTE, (u,))] * 3]) for u in (x, y)]
    >>> print(parallel(limbs).poc)
    t³ r⁰
    """
    if not motions:
        raise UsageError("there is no limb; at least one is needed")
    check_mode(mode)
    limbs = [motion.limb for motion in motions if motion.limb is not None]
    if len(limbs) < len(motions):
        return Refusal("the pitch of a helical joint couples a rotation and a translation")
    carried = (_about_a_point(motions, at) if mode == "free" else None) or _held(that_hold_back(limbs), mode, at)
    if isinstance(carried, Refusal):
        return carried
    return replace(
        carried,
        conditions=tuple(dict.fromkeys(condition for limb in limbs for condition in limb.conditions)),
        derive=lambda: limb_derivation(motions, lambda some: parallel(some, mode, at=at), name, at),
    )


def _held(limbs: Sequence[Limb], mode: Mode, at: str) -> Motion | Refusal:
    """The motion of a platform by what its limbs resist, held to the orientations that it takes."""
    assembly = unturned(limbs) if mode == "translation" else as_written(limbs)
    if mode == "free" and isinstance(assembly, HeldLimbs):
        assembly = as_it_lasts(assembly)
    if isinstance(assembly, Refusal):
        return assembly
    if assembly.from_platform and at:
        return Refusal("directions fixed in the platform decide how its point O' moves")
    poc = platform_set(assembly.limbs, assembly.resisted, at)
    if isinstance(poc, Refusal):
        return poc
    if any(_is_another(motion_of(part), poc) for part in parts_that_all_allow(limbs)):
        return Refusal("limbs share a point, and from the position as written part of a limb moves on by itself")
    moved, turned, taken = assembly.resisted.forces.complement, assembly.turned, assembly.taken
    if assembly.from_platform:
        moved, turned, taken = moved.turned(None), turned.turned(None), Orientations(taken.dim)
        moving = [Mark() if count in (0, 3) else MOVING for count in (poc.t, poc.r)]
        poc = replace(poc, t_mark=moving[0], r_mark=moving[1])
    helical = is_helical(assembly.limbs, assembly.resisted)
    return Motion(moved, turned, taken, freedoms=poc.dim, given=poc, helical=helical)


def _is_another(motion: Motion | Refusal, poc: PocSet) -> bool:
    """Whether a motion has as many freedoms as a POC set, or more, and is not that one."""
    return isinstance(motion, Motion) and motion.dim >= poc.dim and (motion.poc.r, motion.dim) != (poc.r, poc.dim)


def _about_a_point(motions: Sequence[Motion], at: str) -> Motion | None:
    """The motion of a platform that limbs let turn about a point that they share, and do nothing else."""
    limbs = [motion.limb for motion in motions if motion.limb is not None and motion.dim < 6]
    common = frozenset.intersection(*(limb.labels for limb in limbs)) if limbs else frozenset[str]()
    centre = next((label for label in sorted(common) if share_a_sphere(limbs, label)), "")
    if not centre:
        return None
    poc = PocSet(0, 3, 3) if at == centre else PocSet(2, 3, 3, MOVING)
    return Motion(NOTHING, ALL, EVERY, freedoms=3, given=poc, from_home=True)


def xi_of_next(before: Motion, limb: Motion, after: Motion) -> int:
    """Independent equations of the loop that one more limb closes, Eq. (4).

    xi = dim{(intersection of the limbs so far) u M of the limb} = dim before + dim limb - dim after.

    Args:
        before: the platform's motion with the limbs so far.
        limb: the next limb's end link.
        after: the platform's motion with that limb too.
    """
    return before.dim + limb.dim - after.dim
