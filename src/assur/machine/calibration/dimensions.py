"""Which dimensions are unknown: alike wherever they are written, or each limb's and each link's by itself."""

from __future__ import annotations

from functools import lru_cache
from typing import Literal

import numpy as np

from assur.kinematics.home import home_values
from assur.machine.accuracy.geometry_errors import geometry_errors
from assur.model.mechanism import MechanismRecord

Owner = Literal["limb", "link"]
"""Whose copies of a dimension are looked at one by one."""
ROUNDED = 1e-6
"""Share of what a dimension moves below which its copies are all of it: slopes of formulas are differences."""


@lru_cache(maxsize=64)  # many poses of one mechanism ask
def dimensions(record: MechanismRecord, copies: Owner | None = None) -> tuple[str, ...]:
    """Names, as `assur.machine.accuracy.geometry_errors` has them, of dimensions that joints are written with.

    A dimension whose copies are not all of it stands with them: one of limbs that the base is written with too.

    >>> from assur.model.registry import load_record
    >>> dimensions(load_record("fivebar"), "link")
    ('base.g', 'crank1.l1', 'crank2.l1', 'rod1.l2', 'rod2.l2')
    """
    errors = geometry_errors(record, home_values(record))
    moved = np.concatenate([errors.twists.reshape(len(errors.names), 6 * len(errors.joints)), errors.point], axis=1)
    names: list[str] = []
    for place, whole in enumerate(errors.names):
        if "." in whole:
            continue
        own = [k for k, name in enumerate(errors.names) if copies and _is_copy(record, name, whole, copies)]
        rest = moved[place] - np.sum(moved[own], axis=0)
        if not own or np.max(np.abs(rest)) > ROUNDED * np.max(np.abs(moved[place])):
            names.append(whole)
        names += [errors.names[k] for k in own]
    return tuple(names)


def _is_copy(record: MechanismRecord, name: str, whole: str, copies: Owner) -> bool:
    owner, _, own = name.rpartition(".")
    return bool(owner) and own == whole and (owner in record.links) == (copies == "link")
