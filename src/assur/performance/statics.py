"""The wrenches that pass through the joints when one input pushes and the platform is held, from the joint graph.

By virtual work: x holds a wrench per cut joint and the wrench on what holds the platform. A joint j passes
lambda_j = sum of +-x over the loops it is in, and over the platform's branch. It does no work in a passive joint and
one unit in the pushing input: D^T x = e, where D stacks the closure and the platform's twists, per joint rate.

With the platform held each limb is on its own, and what it passes to the platform is reciprocal to its passive joints,
so it is a transmission wrench. That leaves open any wrench which the limb bears with its input slack: a constraint
wrench, or a stress inside a parallelogram. It is chosen so that sum |lambda_j|^2 is least over the joints that are not
driven, each about its centre, with lengths in units of the characteristic length: no constraint is stressed that need
not be, and what can be a force through the centres of the joints is one.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame, frames, screws
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

RANK = 1e-8
"""Singular values below this share of the largest count as zero."""

SOLVED = 1e-6
"""An input whose unit push or unit rate leaves more than this can neither push nor move."""


@dataclass(frozen=True, eq=False)
class Transmitted:
    """Wrenches and twists of F inputs at N configurations: at the platform's point, lengths in characteristic lengths.

    Attributes:
        wrenches: (N, F, joints, 6), moment and force that pass through each joint where an input pushes.
        at_platform: (N, F, 6), what arrives at the platform.
        twists: (N, F, 6), angular velocity and velocity of the platform where one input moves alone.
        input_twists: (N, F, 6), unit twists of the driven joints.
        centres: (N, joints, 3), centres of the joints.
        pushes, moves: (N, F), whether the input can push against the held platform, and can move alone.
    """

    wrenches: FloatArray
    at_platform: FloatArray
    twists: FloatArray
    input_twists: FloatArray
    centres: FloatArray
    pushes: BoolArray
    moves: BoolArray


def is_point(record: MechanismRecord) -> bool:
    """Whether the platform is its point alone, held and pushed by a force: the pose leaves out how its link turns.

    >>> from assur.model.registry import load_record
    >>> [is_point(load_record(name)) for name in ("fivebar", "orthoglide", "planar_3rrr")]
    [True, False, False]
    """
    return record.platform.orientation == "any" and all(name in LENGTHS for name in record.platform.pose)


@lru_cache(maxsize=64)
def incidence(record: MechanismRecord) -> FloatArray:
    """(joints, v + 1): with which sign a joint is in each loop, and in the platform's branch of the tree."""
    graph = joint_graph(record)
    names = list(record.joints)
    signs = np.zeros((len(names), len(graph.cut) + 1))
    for loop, joint in enumerate(graph.cut):
        for name, sense in ((joint.name, 1), *graph.loops[loop].items()):
            signs[names.index(name), loop] = sense
    for name, sense in graph.paths[record.platform.link].items():
        signs[names.index(name), -1] = sense
    return signs


def transmitted(record: MechanismRecord, values: FloatArray) -> Transmitted:
    """Wrenches and twists at joint values (N, n) that close the loops.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("orthoglide")
    >>> there = transmitted(record, home_values(record)[None])  # rods along the rails: force and motion agree
    >>> there.at_platform[0, :, 3:].round(6) + 0.0
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    length = characteristic_length(record)
    placed = frames(record, values)
    rotation, origin = placed[record.platform.link]
    point = (rotation @ record.platform.point) + origin
    twists = _scaled(record, screws(record, values), point)
    signs, centres = incidence(record), _centres(record, placed, point) / length
    of_joint = np.repeat(np.arange(len(record.joints)), [item.type.freedoms for item in record.joints.values()])
    blocks = signs[of_joint].T[:, None, :] * twists[..., None, :, :]  # (N, v + 1, 6, n)
    stacked = blocks.reshape(len(values), -1, values.shape[-1])  # (N, 6 v + 6, n)
    inputs = list(record.input_indices)
    passive = ~np.isin(list(record.joints), [item.coordinate.joint for item in record.inputs])
    rows = np.arange(stacked.shape[1])
    held = np.delete(rows, slice(-6, -3)) if is_point(record) else rows
    motion = _motion(stacked[:, :-6])
    moving, moves = _twists(motion, stacked[:, -6:], inputs)
    metric = _metric(signs[passive], centres[:, passive])[:, held[:, None], held]
    found = np.zeros((len(values), len(rows), len(inputs)))
    weighed = bool(np.linalg.matrix_rank(signs[passive]) == signs.shape[1])
    found[:, held], pushes = _least(motion, stacked[:, held[len(rows) - 6 :]], metric, inputs, weighed)
    parts = np.swapaxes(found, -1, -2).reshape(len(values), len(inputs), -1, 6)
    if is_point(record):
        moving[..., :3] = 0.0
    return Transmitted(
        wrenches=np.einsum("jl,nfla->nfja", signs, parts),
        at_platform=parts[:, :, -1],
        twists=moving,
        input_twists=np.swapaxes(twists[..., inputs], -1, -2),
        centres=centres,
        pushes=pushes,
        moves=moves,
    )


def _scaled(record: MechanismRecord, twists: FloatArray, point: FloatArray) -> FloatArray:
    """Unit twists (N, 6, n) of the joints at a point (N, 3), lengths in characteristic lengths."""
    length = characteristic_length(record)
    found = twists * joint_scales(record)
    found[..., 3:, :] += np.cross(found[..., :3, :], point[..., :, None], axis=-2)
    found[..., 3:, :] /= length
    return np.asarray(found)


def _centres(record: MechanismRecord, placed: dict[str, Frame], point: FloatArray) -> FloatArray:
    """Centres of the joints (N, joints, 3), seen from the platform's point."""
    found = [(placed[joint.child][0] @ joint.child_at) + placed[joint.child][1] for joint in record.joints.values()]
    return np.stack(found, axis=-2) - point[..., None, :]


def _metric(signs: FloatArray, centres: FloatArray) -> FloatArray:
    """(N, 6 v + 6, 6 v + 6): the quadratic form sum |lambda_j|^2 of x, each wrench about the centre of its joint."""
    shift = np.zeros((*centres.shape[:-1], 6, 6))
    shift[...] = np.eye(6)
    x, y, z = np.moveaxis(centres, -1, 0)
    for row, column, value in ((0, 4, z), (0, 5, -y), (1, 3, -z), (1, 5, x), (2, 3, y), (2, 4, -x)):
        shift[..., row, column] = value  # moment - centre x force
    local = np.swapaxes(shift, -1, -2) @ shift  # (N, joints, 6, 6)
    form = np.einsum("jl,jm,njab->nlamb", signs, signs, local)
    size = 6 * signs.shape[1]
    return np.asarray(form.reshape(len(centres), size, size))


@dataclass(frozen=True, eq=False)
class _Motion:
    """The closure (N, r, n), its inverse (N, n, r) and null space (N, n, n), and what is left of its rows (N, r, r).

    Columns that are no part of a null space are zero.
    """

    closure: FloatArray
    inverse: FloatArray
    free: FloatArray
    stresses: FloatArray


def _motion(closure: FloatArray) -> _Motion:
    left, sizes, right = np.linalg.svd(closure)
    inverse, rank = _inverse(left, sizes, right)
    return _Motion(closure, inverse, _last(np.swapaxes(right, -1, -2), rank), _last(left, rank))


def _inverse(left: FloatArray, sizes: FloatArray, right: FloatArray) -> tuple[FloatArray, NDArray[np.int_]]:
    """Pseudo-inverse and rank (N,) of matrices by their singular value decomposition."""
    rank = np.sum(sizes > RANK * sizes[:, :1], axis=-1)
    count = sizes.shape[-1]
    kept = np.arange(count) < rank[:, None]
    reciprocal = np.where(kept, 1.0 / np.where(kept, sizes, 1.0), 0.0)
    scaled = right[:, :count] * reciprocal[..., None]
    return np.swapaxes(scaled, -1, -2) @ np.swapaxes(left[..., :count], -1, -2), rank


def _last(vectors: FloatArray, rank: NDArray[np.int_]) -> FloatArray:
    """Columns (N, d, d) with the first `rank` of them (N,) made zero."""
    return np.asarray(vectors * (np.arange(vectors.shape[-1]) >= rank[:, None])[:, None, :])


def _twists(motion: _Motion, platform: FloatArray, inputs: list[int]) -> tuple[FloatArray, BoolArray]:
    """Platform's twists (N, F, 6) where one input moves at unit rate and the others are locked, and whether it can."""
    driven = motion.free[:, inputs]  # (N, F, n)
    rates = np.linalg.pinv(driven, rcond=RANK)
    missed = driven @ rates - np.eye(len(inputs))
    return np.swapaxes(platform @ motion.free @ rates, -1, -2).copy(), np.max(np.abs(missed), axis=-2) <= SOLVED


def _least_change(square: FloatArray, right: FloatArray) -> FloatArray:
    """A solution of semidefinite equations (N, k, k): drives in series bear on no passive joint, whatever they bear."""
    return np.asarray(np.linalg.pinv(square, rcond=RANK, hermitian=True) @ right)


def _least(
    motion: _Motion, platform: FloatArray, metric: FloatArray, inputs: list[int], weighed: bool
) -> tuple[FloatArray, BoolArray]:
    """Per input the least x (N, r + p, F) in the metric with (closure, platform)^T x = e, and whether there is one."""
    pushed = np.eye(platform.shape[-1])[:, inputs]
    carried = np.swapaxes(platform @ motion.free, -1, -2)  # (N, n, p)
    left, sizes, right = np.linalg.svd(carried, full_matrices=False)
    inverse, rank = _inverse(left, sizes, right)
    first = inverse @ np.swapaxes(motion.free, -1, -2) @ pushed
    backward = np.swapaxes(motion.inverse, -1, -2)  # (N, r, n)
    across = np.swapaxes(platform, -1, -2)
    found = np.concatenate([backward @ (pushed - across @ first), first], axis=-2)
    idle = _last(np.swapaxes(right, -1, -2), rank)  # (N, p, p): loads that the limbs bear with slack inputs
    borne = np.concatenate([-backward @ across @ idle, idle], axis=-2)
    inside = np.concatenate([motion.stresses, np.zeros((*first.shape[:-1], motion.stresses.shape[-1]))], axis=-2)
    spare = np.concatenate([inside, borne], axis=-1)  # (N, r + p, r + p)
    form = np.swapaxes(spare, -1, -2) @ metric
    unused = ~np.any(spare, axis=-2)
    square = form @ spare + np.eye(spare.shape[-1]) * unused[:, None, :]
    change = np.linalg.solve if weighed else _least_change
    found = found - spare @ change(square, form @ found)
    stacked = np.concatenate([motion.closure, platform], axis=-2)
    missed = np.swapaxes(stacked, -1, -2) @ found - pushed
    return found, np.max(np.abs(missed), axis=-2) <= SOLVED
