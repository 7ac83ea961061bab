"""Remarks on listed solutions: which of them are one double solution, and where angles of the pose say too much."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.configurations import places
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]

DOUBLE = 1e-4
"""Solutions nearer than this, in rad or characteristic lengths, are a double one, or two too near to tell: rounding
moves a double root of the loops by 1e-8, that of a polynomial of high degree by thousands of times as much."""

UPRIGHT = 1e-6
"""Cosine of theta below which theta is a right angle: phi and psi then turn about one axis to the digits printed."""


def doubles(record: MechanismRecord, joints: FloatArray) -> tuple[tuple[int, int, float], ...]:
    """Pairs of solutions with joint values (N, n) that are a double one, and how far apart they are.

    Compared are the places of all joints and of the platform, in characteristic lengths, its orientation, the inputs.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("fivebar")
    >>> home = home_values(record)
    >>> found = doubles(record, np.array([home, home + 1e-6, home + 0.1]))
    >>> [(first, second, apart < 1e-5) for first, second, apart in found]
    [(0, 1, True)]
    """
    if len(joints) < 2:
        return ()
    where = places(record, joints)
    pairs = []
    for second in range(1, len(joints)):
        apart = np.max(np.abs(where[:second] - where[second]), axis=-1)
        pairs += [(int(first), second, float(apart[first])) for first in np.flatnonzero(apart < DOUBLE)]
    return tuple(pairs)


def angles_remark(record: MechanismRecord, pose: FloatArray) -> str:
    """What counts of phi and psi at a pose (m,) at which theta is a right angle; nothing elsewhere.

    R = Rz(phi) Ry(theta) Rx(psi) is Ry(90 deg) Rx(psi - phi) there, and Ry(-90 deg) Rx(psi + phi).

    >>> from assur.model.registry import load_record
    >>> angles_remark(load_record("planar_3rpr"), np.array([0.0, 0.0, 1.0]))
    ''
    """
    named = dict(zip(record.platform.pose, pose.tolist(), strict=True))
    if not {"phi", "theta", "psi"} <= named.keys() or not abs(np.cos(named["theta"])) < UPRIGHT:
        return ""
    return f"theta is a right angle: only psi {'-' if named['theta'] > 0 else '+'} phi counts"
