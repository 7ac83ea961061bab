"""Names of modes on the joint graph: by the file's quantities where it has them, else by signs of closing blocks."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.modes import Problem, mode_text, sign_names
from assur.kinematics.named_signs import named_signs
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@lru_cache(maxsize=64)
def sign_meanings(record: MechanismRecord, problem: Problem) -> Mapping[str, str]:
    """Name of each sign of a mode -> what holds where it is +: the file's formula, or a sentence.

    >>> from assur.model.registry import load_record
    >>> list(sign_meanings(load_record("fivebar"), "inverse").items())
    [('s1', 'sin(B1) > 0'), ('s2', 'sin(B2) > 0')]
    >>> print(sign_meanings(load_record("gough_stewart"), "inverse")["leg1"])
    B1 lies ahead of A1 along P1
    """
    if sign_names(record, problem):
        written = record.modes.assembly if problem == "direct" else record.modes.working
        return {name: f"{formula.text} > 0" for name, formula in written.items()}
    from assur.kinematics.closing_blocks.kept import kept_signs  # which names in a file do without
    from assur.kinematics.closing_blocks.sentences import sentence, sign_name

    meanings: dict[str, str] = {}
    for sign in kept_signs(record, problem):
        meanings[sign_name(record, sign, {*meanings})] = sentence(record, sign)
    return meanings


def signs_at(record: MechanismRecord, problem: Problem, joints: FloatArray, zero: float = 0.0) -> NDArray[np.int8]:
    """Signs (..., s) of a mode of a problem at joint values (..., n), in the order of `sign_meanings`.

    0 where a quantity of the file is within `zero` (rad, characteristic lengths), or a block is singular.
    """
    if sign_names(record, problem):
        return named_signs(record, problem, joints, zero)
    from assur.kinematics.closing_blocks.columns import ScrewColumns  # which names in a file do without
    from assur.kinematics.closing_blocks.kept import kept_signs

    screws = ScrewColumns(record, np.reshape(joints, (-1, joints.shape[-1])))
    signs = [sign.signs(screws) for sign in kept_signs(record, problem)] if len(screws.values) else []
    columns = np.array(signs, dtype=np.int8).reshape(len(sign_meanings(record, problem)), len(screws.values)).T
    return columns.reshape(*joints.shape[:-1], columns.shape[-1])


def mode_names(record: MechanismRecord, joints: FloatArray) -> tuple[str, str]:
    """Working and assembly mode of joint values (n,), by signs alone; "" where there are none.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rpr")
    >>> mode_names(record, home_values(record))
    ('+++', '+')
    """
    return mode_text(signs_at(record, "inverse", joints)), mode_text(signs_at(record, "direct", joints))
