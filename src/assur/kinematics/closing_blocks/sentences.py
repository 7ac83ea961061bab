"""Sentences: what the + of a sign means, in the letters of the joints."""

from __future__ import annotations

from functools import lru_cache

from assur.kinematics.closing_blocks.ball_ends import ball_ended_values, with_ball_ends
from assur.kinematics.closing_blocks.blocks import PLATFORM
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.kinematics.closing_blocks.distinguishing import ModeSign
from assur.kinematics.closing_blocks.sides import side
from assur.kinematics.closing_blocks.signs import BlockSign
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord


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
    if limbs and joints:
        base = limbs[0]
    elif len(prefixes) == 1 and "" not in prefixes:
        base = prefixes.pop()
    else:
        base = "platform" if not joints or len(joints) > len(record.joints) / 2 else f"{joints[0]}-{joints[-1]}"
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
    if sign.meaning:
        return sign.meaning
    (factor, *others) = sign.factors
    if not others and not isinstance(factor, BlockSign):
        return factor.meaning
    if words := side(record, sign):
        return words
    screws = _at_home(record, sign.needs_platform(with_ball_ends(record)))
    joints = ", ".join(_text(name) for name in sign.joints)
    if not sign.signs(screws)[0]:
        return f"the loops of {joints} stand on one side of where they are singular; at home they are"
    return f"the loops of {joints} stand on home's side of where they are singular"


@lru_cache(maxsize=64)
def _at_home(record: MechanismRecord, platform: bool) -> ScrewColumns:
    return ScrewColumns(with_ball_ends(record), ball_ended_values(record, home_values(record))[None], platform)


def _text(name: str) -> str:
    return "the platform" if name == PLATFORM else name
