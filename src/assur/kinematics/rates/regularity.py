"""Regularity of many configurations by one inverse of a symmetric matrix each, without singular values.

With the platform held the scaled joint rates solve D u = (0, v), D being the closure C above the rows X of the pose.
The trace of (D^T D + e)^-1 is the sum of 1/(s^2 + e) over the singular values s of D. Those that the spins of rods
add are zero and stand in it as 1/e; no other is smaller than what is left of the sum allows. Nor is the smallest of C
that counts: what C reaches, it reaches by rates with X u = 0. With R = D^+ (0, 1) and the rows Q of the inputs, A = Q
R takes rates of the pose to those of the inputs, and the measures of `Instant` are 1/sqrt(1 + |A|^2) and 1/sqrt(1 +
|A^-1|^2). Frobenius norms stand for the others, which are smaller.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import CLOSED, closure_error, closure_jacobian
from assur.kinematics.pose import turning_rates
from assur.kinematics.rates.motions import (
    SINGULAR,
    general,
    general_share,
    input_units,
    pose_units,
)
from assur.kinematics.status import NEAR_SINGULAR
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
BLOCK = 512
"""Configurations that are looked at together: their matrices stay in the cache."""
DAMPING = 1e-8
"""What is added to squares of singular values of about 1: they are told apart from zero down to some 1e-4, and the sum
keeps eight digits beside what the spins of rods add."""
SOLVED = 1e-8
"""What motions that move the pose may leave loops open by: far less than `SINGULAR`, the rank of the closure is then no
larger than usual. Assemblies that move to first order alone are known to the root of the gap, some 1e-6, and are not
sure for that."""


def surely_regular(record: MechanismRecord, values: FloatArray) -> BoolArray:
    """Where (N,) configurations (N, n) are regular without a doubt; elsewhere nothing is said.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> surely_regular(record, np.repeat(home_values(record)[None], 3, axis=0)).tolist()
    [True, True, True]
    """
    sure = np.zeros(len(values), dtype=bool)
    if not _determined(record):
        return sure
    for first in range(0, len(values), BLOCK):
        sure[first : first + BLOCK] = _sure(record, values[first : first + BLOCK])
    return sure


@lru_cache(maxsize=64)
def _determined(record: MechanismRecord) -> bool:
    """Whether inputs and pose determine each other, and nothing moves beside them but rods that spin.

    A rod between two ball joints spins in every configuration, so that no motion beyond those of the inputs is left
    where the closure has its usual rank.
    """
    usual, count = general(record), len(record.inputs)
    ranks = (usual.inputs, usual.pose, usual.related, usual.moving)
    square = len(pose_units(record)) == count and all(int(rank) == count for rank in ranks)
    return square and int(usual.closure) > 0 and int(usual.internal) == _spins(record)


def _spins(record: MechanismRecord) -> int:
    """How many rods hang between two ball joints."""
    ends = record.base, record.platform.link
    count = 0
    for link in {name for joint in record.joints.values() for name in (joint.parent, joint.child)} - set(ends):
        joints = [joint for joint in record.joints.values() if link in (joint.parent, joint.child)]
        count += len(joints) == 2 and all(joint.type.ball for joint in joints)
    return count


def _sure(record: MechanismRecord, values: FloatArray) -> BoolArray:
    scale, rank, count = joint_units(record), int(general(record).closure), len(record.inputs)
    closure = closure_jacobian(record, values) * scale  # (N, 6 v, n)
    pose = turning_rates(record, values) * scale / pose_units(record)[:, None]  # (N, k, n)
    held = np.concatenate([closure, pose], axis=1)
    transposed = np.swapaxes(held, 1, 2)
    inverse = np.linalg.inv(transposed @ held + DAMPING * np.eye(len(scale)))
    rest = np.trace(inverse, axis1=1, axis2=2) - (len(scale) - rank - count) / DAMPING
    with np.errstate(divide="ignore", invalid="ignore"):
        least = np.sqrt(np.maximum(1.0 / rest - DAMPING, 0.0)) * (rest > 0.0)
    goal = np.eye(held.shape[1])[:, -count:]  # (6 v + k, k)
    rates = inverse @ transposed[..., -count:]  # (N, n, k)
    for _ in range(2):  # each takes what damping leaves down by itself once more
        rates += inverse @ (transposed @ (goal - held @ rates))
    off = np.max(np.abs(held @ rates - goal), axis=(1, 2))
    drives = scale[list(record.input_indices)] / input_units(record)
    follow = rates[:, list(record.input_indices)] * drives[:, None]  # A (N, F, k)
    lead = np.linalg.inv(follow + np.where(np.abs(np.linalg.det(follow)) > 0.0, 0.0, np.nan)[:, None, None])
    steep, full = np.linalg.norm(follow, axis=(1, 2)), np.linalg.norm(lead, axis=(1, 2))
    size = np.linalg.norm(closure, axis=(1, 2))
    part = np.maximum(np.linalg.norm(pose, axis=(1, 2)), float(np.linalg.norm(drives)))
    spread = np.linalg.norm(rates, axis=(1, 2)) * np.maximum(1.0, full)  # over the least of the poses' and the inputs'
    return np.asarray(
        (off <= SOLVED * np.linalg.norm(rates, axis=(1, 2)))
        & (least > NEAR_SINGULAR * general_share(record) * size)
        & (spread * part * SINGULAR < 1.0)
        & (np.hypot(1.0, np.maximum(steep, full)) * NEAR_SINGULAR < 1.0)
        & (closure_error(record, values) <= CLOSED * characteristic_length(record))
    )
