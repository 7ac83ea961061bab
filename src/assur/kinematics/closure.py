"""Loop closure of the joint graph: residual, Jacobian by screws, rank, and assembly by least squares.

At every cut joint the child's frame is reached twice: through the joint from its parent, and along the
spanning tree. The residual of a loop is the gap between the two frames: three lengths, and the rotation
vector from one to the other times the mechanism's characteristic length. A rotation vector vanishes at
the identity only, so an axis that is turned round is never taken for an assembly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.pose import error_rates, pose_error
from assur.model.joint_graph import Frame, child_frame, frames, joint_graph, screws
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names
from assur.numerics import components, least_squares, rotations

FloatArray = NDArray[np.float64]

CLOSED = 1e-9
"""A loop counts as closed when its residual is at most this times the characteristic length."""

BLOCK = 1024
"""Configurations that are closed at a time: their matrices stay in the cache."""

NEAR_DAMPING = 1e-8
"""Damping of the first step from a start that is known to be near."""

RANK_GAP = 1e-8
"""Singular values below this share of the largest count as zero."""


@dataclass(frozen=True, eq=False)
class Assembly:
    """Joint values (..., n) that close the loops as far as they can be closed from a start.

    `residual` (...) is the largest gap, in length units; `closed` (...) says whether it is within
    tolerance. Where it is not, the values are the closest approach that was found.
    """

    values: FloatArray
    residual: FloatArray
    closed: NDArray[np.bool_]
    steps: int


@lru_cache(maxsize=256)
def characteristic_length(record: MechanismRecord) -> float:
    """The length that turns an angle into a length: the largest distance of a joint from its link's origin."""
    spans = [np.linalg.norm(vector) for joint in record.joints.values() for vector in (joint.at, joint.child_at)]
    return float(max(spans)) or 1.0


def residuals(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Gaps (..., v, 6) over the v cut joints: three lengths and three rotations times the characteristic length."""
    return _residuals(record, values, frames(record, values))


def _residuals(record: MechanismRecord, values: FloatArray, placed: dict[str, Frame]) -> FloatArray:
    graph = joint_graph(record)
    length = characteristic_length(record)
    gaps = np.zeros((*values.shape[:-1], len(graph.cut), 6))
    for index, joint in enumerate(graph.cut):
        reached = child_frame(joint, placed[joint.parent], values[..., graph.slices[joint.name]])
        rotation, origin = placed[joint.child]
        at_joint = components.applied(rotation, joint.child_at) + origin
        gaps[..., index, :3] = components.applied(reached[0], joint.child_at) + reached[1] - at_joint
        error = components.product_turned_back(reached[0], rotation)
        gaps[..., index, 3:] = length * rotations.to_vector(error)
    return gaps


def closure_error(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Largest gap (...) over the cut joints, in length units: point gaps, and rotations times the length.

    Zero (to rounding) exactly where joint values (..., n) are an assembly of the whole joint graph.
    """
    return _largest(residuals(record, values))


def _largest(gaps: FloatArray) -> FloatArray:
    """The largest (...) of gaps (..., v, 6), each by its length and by its rotation."""
    pairs = gaps.reshape(*gaps.shape[:-1], 2, 3)
    return np.asarray(np.max(np.linalg.norm(pairs, axis=-1), axis=(-1, -2), initial=0.0))


def loop_twists(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Closure Jacobian (..., 6 v, n): per loop the joint twists, signed along it; J qdot = 0 at an assembly."""
    return _loop_twists(record, screws(record, frames(record, values), values))


def _loop_twists(record: MechanismRecord, twists: FloatArray) -> FloatArray:
    graph = joint_graph(record)
    matrix = np.zeros((*twists.shape[:-2], len(graph.cut), 6, twists.shape[-1]))
    for index, (joint, loop) in enumerate(zip(graph.cut, graph.loops, strict=True)):
        for name, sense in ((joint.name, 1), *loop.items()):
            columns = graph.slices[name]
            matrix[..., index, :, columns] = sense * twists[..., columns]
    return matrix.reshape(*twists.shape[:-2], 6 * len(graph.cut), twists.shape[-1])


def _moments(angular: FloatArray, point: FloatArray) -> FloatArray:
    """Velocities (..., 3, n) at points (..., 3) that angular velocities (..., 3, n) about the origin make."""
    return rotations.skew(-point) @ angular


def _about_cut_joints(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Closure Jacobian (..., 6 v, n) with each loop's velocities taken at its cut joint.

    The rank is the same; but far from the base's origin the moments of the rotations would drown it.
    """
    placed = frames(record, values)
    matrix = loop_twists(record, values)
    for index, joint in enumerate(joint_graph(record).cut):
        rotation, origin = placed[joint.child]
        point = (rotation @ joint.child_at) + origin
        block = matrix[..., 6 * index : 6 * index + 6, :]
        block[..., 3:, :] += _moments(block[..., :3, :], point)
    return matrix


def closing_system(
    record: MechanismRecord, values: FloatArray, poses: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Gaps and their derivative, exact where they vanish, at joint values (N, n): what Newton's method needs.

    Returns:
        gaps (N, r) and derivative (N, r, n), in length units: the 6 v rows of the loops as `residuals` gives them, then
        as many rows as the pose has rates, for how far the platform is from poses (N, m), if any are given.

    Example: at home the platform is where it is said to be.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.pose import pose_of
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)[None]
    >>> gaps, derivative = closing_system(record, home, pose_of(record, home))
    >>> bool(abs(gaps).max() < 1e-9), derivative.shape
    (True, (1, 8, 5))
    """
    graph = joint_graph(record)
    length = characteristic_length(record)
    values = components.by_components(values)
    placed = frames(record, values)
    twists = screws(record, placed, values)
    lengths = sum(name in LENGTHS for name in record.platform.pose)
    units = np.repeat([1.0, length], [lengths, len(rate_names(record.platform.pose)) - lengths])
    rows = 6 * len(graph.cut)
    count = rows if poses is None else rows + len(units)
    residual, jacobian = np.empty((len(values), count)), np.zeros((len(values), count, values.shape[-1]))
    residual[:, :rows] = _residuals(record, values, placed).reshape(len(values), rows)
    for index, (joint, loop) in enumerate(zip(graph.cut, graph.loops, strict=True)):
        rotation, origin = placed[joint.child]
        point = components.applied(rotation, joint.child_at) + origin
        block = jacobian[:, 6 * index : 6 * index + 6]
        for name, sense in ((joint.name, 1), *loop.items()):
            columns = graph.slices[name]
            angular = twists[:, :3, columns]
            block[:, :3, columns] = sense * (twists[:, 3:, columns] + components.crossed(angular, point))
            block[:, 3:, columns] = sense * length * angular
    if poses is not None:
        residual[:, rows:] = pose_error(record, placed, poses, length)
        jacobian[:, rows:] = error_rates(record, placed, twists) * units[:, None]
    return residual, jacobian


def assemble(
    record: MechanismRecord,
    start: FloatArray,
    *,
    held: Sequence[int] = (),
    poses: FloatArray | None = None,
    tolerance: float = 1e-12,
    max_steps: int = 80,
    near: bool = False,
) -> Assembly:
    """Close the loops from starts (..., n), holding the joint values with indices `held`, or at given poses.

    Args:
        record: the mechanism.
        start: joint values (..., n).
        held: indices of joint values that must not change (those of the inputs: a direct problem).
        poses: (..., m), where the platform must be (an inverse problem); anywhere by default.
        tolerance: relative to the characteristic length.
        max_steps: of damped least squares on the whole joint graph, so that redundant loops do no harm.
        near: whether the starts are known to be near an assembly; the first step is then hardly damped.
    """
    count = start.shape[-1]
    wrong = [index for index in held if index not in range(count)]
    if wrong:
        raise UsageError(f"held: no joint values {wrong} among 0 .. {count - 1}")
    values: FloatArray = np.array(start, dtype=float).reshape(int(np.prod(start.shape[:-1])), count)
    wanted = None
    if poses is not None:
        wanted = np.broadcast_to(poses, (*start.shape[:-1], poses.shape[-1])).reshape(len(values), -1)
    free = np.setdiff1d(np.arange(count), np.asarray(held, dtype=int))
    length = characteristic_length(record)
    # a length counts in units of the characteristic length, so that a step mixes it fairly with angles
    scale = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])[free]

    def system(first: int, unknowns: FloatArray, rows: NDArray[np.intp]) -> tuple[FloatArray, FloatArray]:
        rows = rows + first
        trial = values[rows]
        trial[:, free] = unknowns * scale
        gaps, derivative = closing_system(record, trial, None if wanted is None else wanted[rows])
        return gaps / length, derivative[..., free] * (scale / length)

    steps = 0
    if len(free):
        damping = NEAR_DAMPING if near else least_squares.DAMPING
        for first in range(0, len(values), BLOCK):
            block = slice(first, first + BLOCK)
            found = least_squares.minimise(
                partial(system, first),
                values[block, free] / scale,
                tolerance=tolerance,
                max_steps=max_steps,
                damping=damping,
            )
            values[block, free] = found.x * scale
            steps = max(steps, found.steps)
    placed = frames(record, values)
    error = _largest(_residuals(record, values, placed))
    if wanted is not None:
        error = np.maximum(error, np.max(np.abs(pose_error(record, placed, wanted, length)), axis=-1))
    error = error.reshape(start.shape[:-1])
    return Assembly(values.reshape(start.shape), error, error <= CLOSED * length, steps)


@dataclass(frozen=True, eq=False)
class Mobility:
    """Freedom of the joint graph at an assembly, by the rank of its closure Jacobian.

    `rank` (...) of the 6 v rows, `freedoms` = n - rank, `redundant` = 6 v - rank, and `gap` (...): the
    smallest singular value kept over the largest dropped one (inf where none is dropped to rounding).
    """

    rank: NDArray[np.int_]
    freedoms: NDArray[np.int_]
    redundant: NDArray[np.int_]
    gap: FloatArray


def mobility(record: MechanismRecord, values: FloatArray, *, threshold: float = RANK_GAP) -> Mobility:
    """Rank, freedoms and redundant constraints at assemblies (..., n).

    Translations are counted in units of the characteristic length, so that the rank does not depend on the unit.
    """
    length = characteristic_length(record)
    matrix = _about_cut_joints(record, values)
    rows = np.tile([1.0, 1.0, 1.0, 1 / length, 1 / length, 1 / length], matrix.shape[-2] // 6)
    columns = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    singular = np.linalg.svd(matrix * rows[:, None] * columns, compute_uv=False)
    kept = singular > threshold * singular[..., :1]
    rank = np.sum(kept, axis=-1)
    smallest = np.min(np.where(kept, singular, np.inf), axis=-1)
    dropped = np.max(np.where(kept, 0.0, singular), axis=-1)
    with np.errstate(divide="ignore"):
        gap = np.where(dropped > 0.0, smallest / dropped, np.inf)
    return Mobility(rank, values.shape[-1] - rank, matrix.shape[-2] - rank, gap)
