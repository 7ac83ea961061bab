"""The joint graph with its inputs or its platform locked: singular values, tangents, and whether a step passes zero.

Closure rows and the rows of what is locked form one matrix D; D u' = (0, rates) over the joint rates u', lengths
in units of the characteristic length. With the inputs locked D loses rank where the platform can still move
(parallel), with the platform locked where an input can (serial); where the closure itself loses rank, both do.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closure import assemble, closure_jacobian
from assur.kinematics.following.course import Prescribed
from assur.kinematics.pose import turning_rates
from assur.kinematics.rates.motions import general, pose_units
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
RANK = 1e-7
"""Singular values below this share of the largest count as zero."""

ZERO = 1e-6
"""A singular value up to here is zero at the start of a way, without dimensions."""

NEIGHBOURS = 4
"""Assemblies near the start that are asked for the rank in general."""

AWAY = 0.05
"""How far they are from it, in rad or characteristic lengths."""

NEEDED = 1e-3
"""Share of changes of gaps, towards the direction of the smallest singular value, that counts."""

Matrices = dict[str, FloatArray]


def matrices(record: MechanismRecord, values: FloatArray) -> Matrices:
    """`closure` (..., 6 v, n), and with the rows of what is locked below it `inputs` and `poses`; no dimensions."""
    size = joint_units(record)
    closure = closure_jacobian(record, values) * size
    moves = turning_rates(record, values) * size / pose_units(record)[:, None]
    driven = np.eye(values.shape[-1])[list(record.input_indices)]
    return {
        "closure": closure,
        "inputs": np.concatenate([closure, np.broadcast_to(driven, (*values.shape[:-1], *driven.shape))], axis=-2),
        "poses": np.concatenate([closure, moves], axis=-2),
    }


def general_ranks(record: MechanismRecord, values: FloatArray) -> dict[str, int]:
    """Rank of each matrix in general, about an assembly (n,): the largest there and at assemblies near it.

    With the inputs, or the platform, locked it is at least what the mechanism has in general: a mode in which the
    platform moves alone everywhere is singular everywhere.
    """
    rng = np.random.default_rng(0)
    away = AWAY * joint_units(record) * rng.normal(size=(NEIGHBOURS, len(values)))
    near = assemble(record, values + away, max_steps=30)
    around = np.concatenate([values[None], near.values[near.closed]])
    ranks = {}
    for name, matrix in matrices(record, around).items():
        sizes = np.linalg.svd(matrix, compute_uv=False)
        ranks[name] = int(np.max(np.sum(sizes > RANK * sizes[..., :1], axis=-1)))
    usual = general(record)
    for name, independent in (("inputs", usual.inputs), ("poses", usual.pose)):
        ranks[name] = min(max(ranks[name], ranks["closure"] + int(independent)), len(values))
    return ranks


def ranks_from(record: MechanismRecord, values: FloatArray, prescribed: Prescribed) -> dict[str, int]:
    """Ranks by which a way from an assembly (n,) is guarded that may be singular where nothing is prescribed.

    Of what is not prescribed the rank there counts: what is lost already can neither be lost nor kept.
    """
    ranks, other = general_ranks(record, values), own(prescribed)[1]
    at_start = int(np.sum(np.linalg.svd(matrices(record, values)[other], compute_uv=False) > ZERO))
    return {**ranks, other: min(ranks[other], at_start)}


def smallest(record: MechanismRecord, values: FloatArray, ranks: Mapping[str, int]) -> dict[str, FloatArray]:
    """Per matrix, the singular value (...) that goes to zero where it loses rank, at joint values (..., n)."""
    values_by_matrix: dict[str, FloatArray] = {}
    for name, matrix in matrices(record, values).items():
        values_by_matrix[name] = np.asarray(np.linalg.svd(matrix, compute_uv=False)[..., ranks[name] - 1])
    return values_by_matrix


@dataclass(frozen=True, eq=False)
class Locked:
    """One matrix at one assembly by its singular values: left (rows, r), sizes (r,), right (r, n)."""

    left: FloatArray
    sizes: FloatArray
    right: FloatArray

    def change(self, rows: FloatArray) -> tuple[FloatArray, float]:
        """The smallest change of joint values (n,) that changes gaps by rows (r,); and the share of these it misses."""
        parts = self.left.T @ rows
        missed = float(np.linalg.norm(rows - self.left @ parts))
        return self.right.T @ (parts / self.sizes), missed / float(np.linalg.norm(rows)) if missed else 0.0

    def needs(self, rows: FloatArray) -> bool:
        """Whether changes of gaps by rows (r,) need the direction whose singular value is the smallest.

        Where that one vanishes no joint rates give them: two branches merge there, and both end.
        """
        return bool(abs(self.left[:, -1] @ rows) > NEEDED * np.linalg.norm(rows))

    def kept(self, matrix: FloatArray) -> float:
        """What is left of the rank at another assembly: 1 where nothing changes, 0 or less where it is lost between.

        On the straight way from this matrix to the other one, seen in this one's row and column space, the
        determinant is prod (1 - t + t l) over the eigenvalues l of (this)^-1 (other): it vanishes between them where
        an l is real and not positive, however many vanish at once. The least real part is returned.
        """
        ratio = (self.left.T @ matrix @ self.right.T) / self.sizes[:, None]
        return float(np.min(np.linalg.eigvals(ratio).real))


def locked(matrix: FloatArray, rank: int) -> Locked:
    """The singular value decomposition of one matrix (rows, n), cut to its rank in general."""
    left, sizes, right = np.linalg.svd(matrix, full_matrices=False)
    return Locked(left[:, :rank], sizes[:rank], right[:rank])


def own(prescribed: Prescribed) -> tuple[str, str]:
    """The matrix of what is prescribed, then the other one."""
    return ("inputs", "poses") if prescribed == "inputs" else ("poses", "inputs")
