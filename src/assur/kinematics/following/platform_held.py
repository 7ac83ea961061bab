"""The joint graph with its platform held: how joints follow the pose, what is singular, whether a step passes zero.

One matrix D holds the closure rows and the rows of the pose, lengths in characteristic lengths; D u' = (0, v) gives
the joint rates u' at pose rates v (`assur.numerics.newton.solved`). It is the derivative of Newton's steps to a pose.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.kinematics.following.ways import held_system
from assur.kinematics.rates.motions import input_units, pose_units
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord
from assur.numerics.newton import damped, solved

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
RESTS = 1e-3
"""Rate of an input per rate of the pose, without dimensions, below which the input counts as resting."""


@dataclass(frozen=True, eq=False)
class PlatformHeld:
    """Joint rates at assemblies (N, n).

    Attributes:
        matrix: D (N, 6 v + k, n).
        rates: (N, n, k) joint rates per rate of the pose, the smallest that do, without dimensions.
        inputs: (N, F, k) rates of the printed inputs per rate of the pose, without dimensions: Jq^-1 Jp.
    """

    matrix: FloatArray
    rates: FloatArray
    inputs: FloatArray

    @cached_property
    def serial(self) -> FloatArray:
        """Square (N,) of the sine that vanishes where joints must move infinitely fast: two branches merge.

        It falls to zero linearly towards the border of what a working mode reaches.
        """
        largest = np.linalg.svd(self.rates, compute_uv=False)[..., 0]
        return np.asarray(1.0 / (1.0 + largest**2))

    @cached_property
    def output(self) -> FloatArray:
        """The determinant (N,) of Jp with rows of length 1, one per input, for det Jq > 0; NaN where not square.

        Rows of (Jp, -Jq) may be multiplied by anything. With these the determinant runs evenly up to where an element
        of Jq vanishes and on from there; where an input rests (`RESTS`) it falls to zero with its row.
        """
        if self.inputs.shape[-1] != self.inputs.shape[-2]:
            return np.full(len(self.inputs), np.nan)
        size = np.sqrt(np.sum(self.inputs**2, axis=-1, keepdims=True) + RESTS**2)
        return np.asarray(np.linalg.det(self.inputs / size))


def platform_held(record: MechanismRecord, values: FloatArray) -> PlatformHeld:
    """Joint rates at assemblies (N, n).

    Example: the determinant of Jp for rows of length 1, as the null space of the closure gives Jp.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.rates.instantaneous import instantaneous
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)[None]
    >>> there = instantaneous(record, home)
    >>> rows = np.linalg.solve(there.jq, there.jp * pose_units(record))
    >>> wanted = np.linalg.det(rows / np.linalg.norm(rows, axis=-1, keepdims=True))
    >>> bool(np.abs(platform_held(record, home).output - wanted)[0] < 1e-6)
    True
    """
    return held_by(record, held_matrix(record, values))


def held_by(record: MechanismRecord, matrix: FloatArray) -> PlatformHeld:
    """As `platform_held`, of the matrix D (N, r, n) there."""
    wanted = len(pose_units(record))
    rates = solved(matrix, np.eye(matrix.shape[-2])[:, -wanted:])
    size = joint_units(record)
    own = np.array([item.sign for item in record.inputs]) * size[list(record.input_indices)] / input_units(record)
    return PlatformHeld(matrix, rates, rates[..., list(record.input_indices), :] * own[:, None])


def held_matrix(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """D (N, 6 v + k, n) at joint values (N, n): each loop about its cut joint, then the pose; no dimensions."""
    poses = np.zeros((len(values), len(record.platform.pose)))
    return held_system(record, values, poses)[1]


def passes_zero(record: MechanismRecord, before: FloatArray, after: FloatArray) -> BoolArray:
    """Whether two branches merge (N,) between near assemblies with D `before` and `after` (N, r, n): a rank is lost.

    The sign of the leading coefficient of det(D1' D2 + e 1) tells an odd number of singular values that pass zero.
    Where the closure alone passes as well, the branch goes on through a constraint singularity: none has merged.

    >>> from assur.model.registry import load_record
    >>> one = np.eye(5)[None, [0, 1, 2, 2, 2, 2, 3, 4]]  # six rows of a loop, two of the pose
    >>> other = one * [1.0, 1.0, 1.0, 1.0, -1.0]
    >>> record = load_record("fivebar")
    >>> passes_zero(record, one, one).tolist(), passes_zero(record, one, other).tolist()
    ([False], [True])
    """
    passed = _turned(before, after)
    rows = np.flatnonzero(passed)
    if len(rows):
        closure = slice(6 * len(joint_graph(record).cut))
        passed[rows] &= ~_turned(before[rows, closure], after[rows, closure])
    return passed


def _turned(first: FloatArray, second: FloatArray) -> BoolArray:
    sign, _ = np.linalg.slogdet(damped(np.swapaxes(first, -1, -2) @ second, first))
    return np.asarray(sign < 0.0)
