"""The motions that keep every loop of the joint graph closed: their null space, and what of inputs and pose they move.

All of it is scaled to plain numbers: lengths count in units of the characteristic length, the angle of a screw in turns
that advance it by as much, so that a fine thread is no nearer to a singularity than a coarse one.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import RANK_GAP, assemble, closure_jacobian, rank_of
from assur.kinematics.home import check_loops, home_values
from assur.kinematics.pose import platform_twists, turning_rates
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int_]

SINGULAR = 1e-5
"""A singular value within this share of what it could be counts as zero, one of the closure within this share of what
the smallest is around home: a rank of the joint graph drops."""

AROUND_HOME = (0.02, 0.05, 0.1)
SAMPLES = 8


@dataclass(frozen=True)
class Ranks:
    """Ranks of the joint graph's motion: in general, or (...) at configurations.

    Attributes:
        closure: of the closure Jacobian.
        freedoms: motions that keep the loops closed, internal freedoms among them.
        inputs, pose, twists: independent rates of the inputs, of the pose, and of the platform's whole twist.
        related: of the inputs and the pose together.
        moving: of the inputs and the platform's whole twist together; freedoms - moving are internal.
    """

    closure: IntArray
    freedoms: IntArray
    inputs: IntArray
    pose: IntArray
    twists: IntArray
    related: IntArray
    moving: IntArray

    @property
    def internal(self) -> IntArray:
        """Motions of neither inputs nor platform, as the spin of a rod between two ball joints."""
        return np.asarray(self.freedoms - self.moving)


@dataclass(frozen=True, eq=False)
class InstantaneousMotion:
    """Null space of the closure (..., n, n; columns that are none are zero), and what it moves, scaled to numbers.

    `values` are the singular values of the scaled closure Jacobian, `scale` (n,) turns
    scaled joint rates into rates; `inputs` (..., F, n), `pose` (..., k, n) and `twists` (..., 6, n) are per motion, the
    pose's rates being those of `assur.kinematics.pose.turning_rates`. Redundant inputs count in all ranks.
    """

    values: FloatArray
    scale: FloatArray
    null: FloatArray
    inputs: FloatArray
    pose: FloatArray
    twists: FloatArray
    ranks: Ranks
    gap: FloatArray
    related_left: FloatArray


def pose_units(record: MechanismRecord) -> FloatArray:
    """What each rate of the pose (k,) is divided by to be a number: the characteristic length, or 1."""
    length = characteristic_length(record)
    return np.array([length if name in LENGTHS else 1.0 for name in rate_names(record.platform.pose)])


def input_units(record: MechanismRecord) -> FloatArray:
    """What each input (F,) is divided by to be a number: the characteristic length, 1, or a screw's turns for it."""
    return joint_units(record)[list(record.input_indices)]


def drive_units(record: MechanismRecord) -> FloatArray:
    """The same for every input (d,), redundant ones last."""
    return joint_units(record)[[item.coordinate.index for item in record.drives]]


def twist_units(record: MechanismRecord) -> FloatArray:
    """The same for a twist (6,)."""
    return np.repeat([1.0, characteristic_length(record)], 3)


@lru_cache(maxsize=64)
def general(record: MechanismRecord) -> Ranks:
    """Ranks in general: at random assemblies around home, those at which the closure has its largest rank.

    Home itself may be singular; what is near it in another mode of motion counts where its rank is larger.

    >>> from assur.model.registry import load_record
    >>> usual = general(load_record("zeng2019"))
    >>> int(usual.closure), int(usual.freedoms), int(usual.internal)
    (14, 3, 0)
    """
    ranks = _around_home(record).ranks
    usual = ranks.closure == np.max(ranks.closure)
    return Ranks(**{item.name: np.max(getattr(ranks, item.name)[usual]) for item in fields(Ranks)})


@lru_cache(maxsize=64)
def general_share(record: MechanismRecord) -> float:
    """The smallest singular value of the closure that counts over the largest: the largest such share around home."""
    values = _around_home(record).values
    return float(np.max(values[:, int(general(record).closure) - 1] / values[:, 0]))


def closure_share(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """The closure's smallest singular value that counts, over the largest, as a share (...) of what it is around home.

    It is 0 where the closure loses rank at joint values (..., n).

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> 0.5 < float(closure_share(record, around_home(record)[0])) <= 1.0
    True
    """
    sizes = closure_values(record, values)
    return np.asarray(sizes[..., int(general(record).closure) - 1] / sizes[..., 0] / general_share(record))


def closure_values(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Singular values (..., s) of the closure at joint values (..., n): those of `motions` at a third of its time."""
    return np.asarray(np.linalg.svd(closure_jacobian(record, values) * joint_units(record), compute_uv=False))


@lru_cache(maxsize=64)
def _around_home(record: MechanismRecord) -> InstantaneousMotion:
    """The motion at home and at assemblies near it."""
    return motions(record, around_home(record), RANK_GAP)


@lru_cache(maxsize=64)
def around_home(record: MechanismRecord) -> FloatArray:
    """Joint values (N, n) of home and of assemblies near it."""
    home = home_values(record)
    at_home = motions(record, home, RANK_GAP)
    random = np.random.default_rng(0).normal(size=(len(AROUND_HOME), SAMPLES, len(home)))
    away = np.array(AROUND_HOME)[:, None, None] * random @ at_home.null.T * at_home.scale
    near = assemble(record, (home + away).reshape(-1, len(home)))
    return np.concatenate([home[None], near.values[near.closed]])


def motions(record: MechanismRecord, values: FloatArray, threshold: float | None = None) -> InstantaneousMotion:
    """Null space of the closure at joint values (..., n), and what it moves.

    `threshold` is the share of the closure's largest singular value below which one counts as zero; by default
    `SINGULAR` times the share that the smallest has around home.

    Errors:
        MechanismFileError: a file of nothing but serial chains.
    """
    check_loops(record)
    threshold = SINGULAR * general_share(record) if threshold is None else threshold
    scale = joint_units(record)
    closure = closure_jacobian(record, values) * scale  # (..., 6 v, n)
    _, singular, right = np.linalg.svd(closure, full_matrices=closure.shape[-2] < closure.shape[-1])
    rank, gap = rank_of(singular, threshold * singular[..., 0])
    null = np.swapaxes(right, -1, -2) * (np.arange(values.shape[-1]) >= rank[..., None])[..., None, :]
    drives = np.zeros((len(record.drives), values.shape[-1]))
    for row, driven in enumerate(record.drives):
        drives[row, driven.coordinate.index] = driven.sign  # in the units of `drive_units`, which are the joints'
    drives = np.broadcast_to(drives, (*values.shape[:-1], *drives.shape))
    pose = turning_rates(record, values) * scale / pose_units(record)[:, None]
    twists = platform_twists(record, values) * scale / twist_units(record)[:, None]
    parts = {
        "inputs": drives,
        "pose": pose,
        "twists": twists,
        "related": np.concatenate([pose, drives], axis=-2),
        "moving": np.concatenate([twists, drives], axis=-2),
    }
    moved = {name: part @ null for name, part in parts.items()}
    first = min(int(np.min(rank, initial=values.shape[-1])), values.shape[-1] - 1)  # columns before it are all zero
    related_left, related, _ = np.linalg.svd(moved["related"][..., first:])
    ranks, gaps = {}, [gap]
    for name, part in parts.items():
        sizes = related if name == "related" else np.linalg.svd(moved[name][..., first:], compute_uv=False)
        ranks[name], gap = rank_of(sizes, SINGULAR * np.linalg.norm(part, axis=(-1, -2)))
        gaps.append(gap)
    return InstantaneousMotion(
        values=singular,
        scale=scale,
        null=null,
        inputs=moved["inputs"][..., : len(record.inputs), :],
        pose=moved["pose"],
        twists=moved["twists"],
        ranks=Ranks(closure=rank, freedoms=values.shape[-1] - rank, **ranks),
        gap=np.min(gaps, axis=0),
        related_left=related_left,
    )
