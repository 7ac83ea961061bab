"""Near home: solutions in the order of their distance from home, so that a number says which one is meant."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.configurations import places
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
DIGITS = 6
"""Distances and places that agree to so many digits after the point are equal, so that rounding decides no order."""


def distances(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """How far configurations (N, coordinates) are from home (N,), a length being one characteristic length.

    Compared are the places of all joints and of the platform, its orientation, and the inputs: a rod that spins about
    its ball joints is not far from itself.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> float(distances(record, home_values(record)[None])[0])
    0.0
    """
    here = places(record, home_values(record)[None])
    return np.asarray(np.linalg.norm(places(record, joints) - here, axis=1))


def nearest_first(record: MechanismRecord, joints: FloatArray) -> NDArray[np.intp]:
    """Order (N,) of configurations (N, coordinates): nearest to home first; equally near ones by their places.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> found = direct(record, [2.2, 0.9]).joints
    >>> nearest_first(record, found).tolist() == np.argsort(distances(record, found)).tolist()
    True
    """
    if not len(joints):
        return np.empty(0, dtype=np.intp)
    keys = np.round(np.column_stack([distances(record, joints), places(record, joints)]), DIGITS)
    return np.asarray(np.lexsort(keys.T[::-1]))
