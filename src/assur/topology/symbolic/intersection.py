"""The intersection of Eq. (2): the POC set of a platform, from those of its limbs."""

from __future__ import annotations

from collections.abc import Sequence

from assur.errors import UsageError
from assur.topology.symbolic.lasting import why_it_does_not_last
from assur.topology.symbolic.limb_steps import limb_derivation
from assur.topology.symbolic.motion import Mode, Motion, check_mode
from assur.topology.symbolic.operation_modes import as_written, unturned
from assur.topology.symbolic.platform_set import is_helical, platform_set
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.subgroups import that_hold_back


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
    holding = that_hold_back(limbs)
    assembly = unturned(holding) if mode == "translation" else as_written(holding)
    if isinstance(assembly, Refusal):
        return assembly
    refusal = why_it_does_not_last(assembly) if mode == "free" else None
    if refusal is not None:
        return refusal
    poc = platform_set(assembly.limbs, assembly.resisted, at)
    if isinstance(poc, Refusal):
        return poc
    return Motion(
        translations=assembly.resisted.forces.complement,
        rotations=assembly.turned,
        orientations=assembly.taken,
        freedoms=poc.dim,
        given=poc,
        conditions=tuple(dict.fromkeys(condition for limb in limbs for condition in limb.conditions)),
        helical=is_helical(assembly.limbs, assembly.resisted),
        derive=lambda: limb_derivation(motions, lambda some: parallel(some, mode, at=at), name, at),
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
