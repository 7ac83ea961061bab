"""Sentences: what the + of a sign means, in the letters of the joints."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from assur.kinematics.closing_blocks.ball_ends import ball_ended_values, with_ball_ends
from assur.kinematics.closing_blocks.blocks import PLATFORM
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.kinematics.closing_blocks.distinguishing import ModeSign
from assur.kinematics.closing_blocks.signs import BlockSign, StrokeSign
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord
from assur.numerics.rotations import cross

PARALLEL = 1e-9
"""Sine of the angle between axes up to which they are parallel: they are written, or turned by a limb's angle."""


def sign_name(record: MechanismRecord, sign: ModeSign, taken: set[str]) -> str:
    """A short name that is not taken yet: of the limb that has all its joints, of the platform for most joints.

    >>> from assur.kinematics.closing_blocks.distinguishing import distinguishing_signs
    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rrr")
    >>> [sign_name(record, sign, set()) for sign in distinguishing_signs(record, "inverse")]
    ['leg1', 'leg2', 'leg3']
    """
    joints = [name for name in sign.joints if name != PLATFORM]
    limbs = [limb.name for limb in record.chains.values() if {*joints} <= {*limb.serial, *limb.loop, *limb.tail}]
    prefixes = {name.rpartition(".")[0] for name in joints}
    if limbs:
        base = limbs[0]
    elif len(prefixes) == 1 and "" not in prefixes:
        base = prefixes.pop()
    else:
        base = "platform" if len(joints) > len(record.joints) / 2 else f"{joints[0]}-{joints[-1]}"
    names = (base, *(f"{base} {number}" for number in range(2, len(taken) + 3)))
    return next(name for name in names if name not in taken)


def sentence(record: MechanismRecord, sign: ModeSign) -> str:
    """What holds where a sign is +, as it does at home.

    >>> from assur.kinematics.closing_blocks.distinguishing import distinguishing_signs
    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rrr")
    >>> print(sentence(record, distinguishing_signs(record, "inverse")[0]))
    leg1.B lies on the right of the line from leg1.A to leg1.C
    """
    screws = _at_home(record, sign.needs_platform(with_ball_ends(record)))
    if len(sign.factors) == 1:
        factor = sign.factors[0]
        if isinstance(factor, StrokeSign):
            side = "ahead of" if factor.size > 0 else "behind"
            return f"{factor.far} lies {side} {factor.near} along {factor.slide}"
        side = _dyad_side(screws, factor)
        if side:
            return side
    joints = ", ".join(_text(name) for name in sign.joints)
    if not sign.signs(screws)[0]:
        return f"the loops of {joints} stand on one side of where they are singular; at home they are"
    return f"the loops of {joints} stand on home's side of where they are singular"


@lru_cache(maxsize=64)
def _at_home(record: MechanismRecord, platform: bool) -> ScrewColumns:
    return ScrewColumns(with_ball_ends(record), ball_ended_values(record, home_values(record))[None], platform)


def _dyad_side(screws: ScrewColumns, factor: BlockSign) -> str:
    """How a loop of three hinges stands, or of two hinges and a slide across them; "" of any other block.

    Left and right are seen from where the axis of the first hinge points to.
    """
    record, names = screws.record, factor.joints
    if len(factor.block.loops) != 1 or len(names) != 3 or PLATFORM in names:
        return ""
    types = {name: record.joints[name].type for name in names}
    hinges = [name for name, own in types.items() if (own.turns, own.slides, own.ball) == (1, 0, False)]
    slides = [name for name, own in types.items() if (own.turns, own.slides, own.ball) == (0, 1, False)]
    axes = [screws.axis(name)[0] for name in hinges]
    if len(hinges) < 2 or len(hinges) + len(slides) != 3:
        return ""
    if max(np.linalg.norm(cross(axes[0], axis)) for axis in axes) > PARALLEL:
        return ""
    places = [screws.centre(name)[0] for name in hinges]
    if slides:
        along = screws.axis(slides[0])[0]
        if abs(along @ axes[0]) > PARALLEL:
            return ""
        ahead = float((places[1] - places[0]) @ along) > 0
        return f"{hinges[1]} lies {'ahead of' if ahead else 'behind'} {hinges[0]} along {slides[0]}"
    turn = float(cross(places[2] - places[0], places[1] - places[0]) @ axes[0])
    return f"{hinges[1]} lies on the {'left' if turn > 0 else 'right'} of the line from {hinges[0]} to {hinges[2]}"


def _text(name: str) -> str:
    return "the platform" if name == PLATFORM else name
