"""Loop closure of the joint graph: residual, Jacobian by screws, rank, and assembly by least squares.

At every cut joint the child's frame is reached twice: through the joint from its parent, and along the
spanning tree. The residual of a loop is the gap between the two frames: three lengths, and the rotation
vector from one to the other times the mechanism's characteristic length. A rotation vector vanishes at
the identity only, so an axis that is turned round is never taken for an assembly. The gap itself is
`assur.joint_graph.configuration.Configuration.gap`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.configuration import Configuration
from assur.joint_graph.frames import flat
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joint_graph.programs import Outputs, program
from assur.joint_graph.tree import joint_graph
from assur.kinematics.newton import Newton
from assur.kinematics.newton_step import NewtonStep
from assur.kinematics.pose import error_of, error_rates, frame_of, platform_moves, platform_numbers
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.pose import LENGTHS, rate_names
from assur.numerics import least_squares, rotations
from assur.numerics.vectors import add, apply, cross, subtract, times
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]

CLOSED = 1e-9
"""A loop counts as closed when its residual is at most this times the characteristic length."""

BLOCK = 256
"""Configurations that are closed at a time: their matrices stay in the cache."""

MANY = 512
"""Starts near assemblies from which recording a step of Newton's method, some 0.1 s, is repaid."""

NEAR_DAMPING = 1e-8
"""Damping of the first step from a start that is known to be near."""

FAR_DAMPING = 0.1
"""That from a start by chance. With a hundredth of it half of the starts run into valleys without a root; with ten
times as much they close no more often, only later."""

FAR_LEAST = 1e-12
"""Damping after a step that failed, of a start by chance: so it comes to a root that is nearly double. A start beside
an assembly must not: where that moves at first order alone it would run along this motion until the loops close."""

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


def residuals(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Gaps (..., v, 6) over the v cut joints: three lengths and three rotations times the characteristic length."""
    numbers = program(record, _gaps)(record, flat(record, values))
    gaps = _gap_rows(numbers, characteristic_length(record))
    return gaps.reshape(*values.shape[:-1], len(joint_graph(record).cut), 6)


def _gaps(configuration: Configuration) -> Outputs:
    """Twelve numbers for each cut joint, "gap loop,k": the distance, and the turn row by row."""
    gaps = [configuration.gap(joint) for joint in configuration.graph.cut]
    return {
        f"gap {index},{k}": number
        for index, (distance, (a, b, c)) in enumerate(gaps)
        for k, number in enumerate((*distance, *a, *b, *c))
    }


def _gap_rows(numbers: FloatArray, length: float) -> FloatArray:
    """Gaps (N, 6 v) from the numbers (12 v, N) of `_gaps`: distances, and rotation vectors times a length."""
    blocks = numbers.reshape(len(numbers) // 12, 12, numbers.shape[1])
    rows = np.empty((numbers.shape[1], len(blocks), 6))
    rows[:, :, :3] = np.moveaxis(blocks[:, :3], -1, 0)
    rows[:, :, 3:] = length * rotations.to_vector(np.moveaxis(blocks[:, 3:], -1, 0).reshape(*rows.shape[:2], 3, 3))
    return rows.reshape(len(rows), 6 * len(blocks))


def closure_error(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Largest gap (...) over the cut joints, in length units: point gaps, and rotations times the length.

    Zero (to rounding) exactly where joint values (..., n) are an assembly of the whole joint graph.
    """
    return _largest(residuals(record, values))


def _largest(gaps: FloatArray) -> FloatArray:
    """The largest (...) of gaps (..., v, 6), each by its length and by its rotation."""
    pairs = gaps.reshape(*gaps.shape[:-1], 2, 3)
    return np.asarray(np.max(np.linalg.norm(pairs, axis=-1), axis=(-1, -2), initial=0.0))


def closure_jacobian(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Derivative J (..., 6 v, n) of the loops: per loop its joints' twists, signed along it; J qdot = 0 at an assembly.

    Angular velocities, then velocities at the platform's point in characteristic lengths. Far from the base's origin
    the moments of the rotations about it would drown the rank.
    """
    twists, loops = program(record, _loop_twists), len(joint_graph(record).cut)
    matrix = twists.matrix("twist", twists(record, flat(record, values)), (6 * loops, len(record.coordinates)))
    matrix.reshape(len(matrix), loops, 6, len(record.coordinates))[:, :, 3:] /= characteristic_length(record)
    return matrix.reshape(*values.shape[:-1], *matrix.shape[1:])


def _loop_twists(configuration: Configuration) -> Outputs:
    """Twists around each loop at the platform's point, those entries that are not always zero: "twist row,column"."""
    graph, (_, point) = configuration.graph, configuration.platform
    return {
        f"twist {6 * index + row},{column}": number
        for index, (cut, loop) in enumerate(zip(graph.cut, graph.loops, strict=True))
        for name, sense in ((cut.name, 1), *loop.items())
        for row, column, number in configuration.entries(graph.joint(name), sense, point)
    }


def gaps_and_rates(configuration: Configuration) -> Outputs:
    """Gaps, and how fast they change: of each loop lengths first, then angular velocities of the turn that is left."""
    rates = {
        f"derivative {6 * index + (row + 3) % 6},{column}": number
        for index, cut in enumerate(configuration.graph.cut)
        for row, column, number in _gap_rates(configuration, cut)
    }
    return {**_gaps(configuration), **rates}


def _gap_rates(configuration: Configuration, cut: Joint) -> Iterator[tuple[int, int, Any]]:
    """Row, coordinate and value: the near side moves the point that is reached, the far side the child's own.

    The turn E = R1 R2^T from the child's frame to the one that is reached has the angular velocity w1 - E w2. Joints
    that lead to both sides turn what an open loop leaves with them.
    """
    graph = configuration.graph
    distance, turned = configuration.gap(cut)
    own = configuration.child_point(cut)
    reached = add(own, distance)
    near, far = {**graph.paths[cut.parent], cut.name: 1}, graph.paths[cut.child]
    for name in dict.fromkeys((*near, *far)):
        sense = near[name] if name in near else -far[name]
        point = reached if name in near else own
        for column, (angular, velocity) in enumerate(
            configuration.twists(graph.joint(name), point), start=graph.slices[name].start
        ):
            if name in near and name in far:
                rates = (*subtract(angular, apply(turned, angular)), *cross(angular, distance))
            else:
                rates = (*(angular if name in near else apply(turned, angular)), *velocity)
            for row, number in enumerate(rates):
                if not (type(number) is int and number == 0):
                    yield row, column, times(sense, number)


def closing_numbers(configuration: Configuration) -> Outputs:
    """Gaps and their exact derivative, the platform's frame and twists: what closes the loops, also at a pose."""
    return {**gaps_and_rates(configuration), **platform_numbers(configuration), **platform_moves(configuration)}


def closing_system(
    record: MechanismRecord, values: FloatArray, poses: FloatArray | None
) -> tuple[FloatArray, FloatArray]:
    """Gaps and their derivative at joint values (N, n), exact for loops also where they are open, for a pose at it.

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
    length, count = characteristic_length(record), len(record.coordinates)
    system = program(record, closing_numbers)  # also without poses: a program more takes longer to record
    numbers = system(record, values)
    loops = len(joint_graph(record).cut)
    gaps = _gap_rows(numbers[system.rows("gap")], length)
    derivative = system.matrix("derivative", numbers, (6 * loops, count))
    turning = derivative.reshape(len(values), loops, 6, count)[:, :, 3:]
    vectors = gaps.reshape(len(values), loops, 6)[:, :, 3:] / length
    turning[:] = length * (rotations.vector_rates_matrix(vectors) @ turning)  # (N, v, 3, n)
    if poses is None:
        return gaps, derivative
    names = record.platform.pose
    lengths = sum(name in LENGTHS for name in names)
    units = np.repeat([1.0, length], [lengths, len(rate_names(names)) - lengths])
    frame = frame_of(numbers[system.rows("platform")], (len(values),))
    away = error_of(names, frame, poses, length)
    rates = error_rates(names, frame[0], system.matrix("move", numbers, (6, count))) * units[:, None]
    return np.concatenate([gaps, away], axis=1), np.concatenate([derivative, rates], axis=1)


def assemble(
    record: MechanismRecord,
    start: FloatArray,
    *,
    held: Sequence[int] = (),
    poses: FloatArray | None = None,
    tolerance: float = 1e-12,
    max_steps: int = 80,
    enough: float = 1.0,
    near: bool = False,
    far: bool = False,
) -> Assembly:
    """Close the loops from starts (..., n), holding the joint values with indices `held`, or at given poses.

    Args:
        record: the mechanism.
        start: joint values (..., n).
        held: indices of joint values that must not change (those of the inputs: a direct problem).
        poses: (..., m), where the platform must be (an inverse problem); anywhere by default.
        tolerance: relative to the characteristic length.
        max_steps: of damped least squares on the whole joint graph, so that redundant loops do no harm.
        enough: share of the starts that must close before the others are left as they are.
        near: whether the starts are known to be near an assembly: the first step is then hardly damped, and many starts
            go through Newton's method first.
        far: whether they may be anywhere: the first step is then damped much more, and the rotation vectors of ball
            joints are kept within half a turn.
    """
    count = start.shape[-1]
    wrong = [index for index in held if index not in range(count)]
    if wrong:
        raise UsageError(f"held: no joint values {wrong} among 0 .. {count - 1}")
    values: FloatArray = np.array(start, dtype=float).reshape(int(np.prod(start.shape[:-1])), count)
    asked = None
    if poses is not None:
        asked = np.broadcast_to(poses, (*start.shape[:-1], poses.shape[-1])).reshape(len(values), -1)
    free = np.setdiff1d(np.arange(count), np.asarray(held, dtype=int))
    length = characteristic_length(record)
    left = np.arange(len(values))
    steps = 0
    if near and len(values) >= MANY and joint_graph(record).cut:
        step = NewtonStep(tuple(sorted(held)), () if asked is None else record.platform.pose)
        closest = Newton(record, step)(values, asked)
        values[closest.closed], steps = closest.values[closest.closed], closest.steps
        left = np.flatnonzero(~closest.closed)
    scale = joint_scales(record)[free]

    def system(block: NDArray[np.intp], unknowns: FloatArray, rows: NDArray[np.intp]) -> tuple[FloatArray, FloatArray]:
        rows = block[rows]
        trial = values[rows]
        trial[:, free] = unknowns * scale
        gaps, derivative = closing_system(record, trial, None if asked is None else asked[rows])
        return gaps / length, derivative[..., free] * (scale / length)

    turns = [range(k, k + 3) for k in range(len(free)) for turn in joint_graph(record).turns if free[k] == turn.start]

    def unwound(unknowns: FloatArray) -> FloatArray:
        if turns:
            unknowns[:, turns] = rotations.shortest(unknowns[:, turns])
        return unknowns

    error: FloatArray = np.full(len(values), np.nan)
    if len(free):
        damping = NEAR_DAMPING if near else FAR_DAMPING if far else least_squares.DAMPING
        for first in range(0, len(left), BLOCK):
            block = left[first : first + BLOCK]
            nearest = least_squares.minimise(
                partial(system, block),
                values[np.ix_(block, free)] / scale,
                tolerance=tolerance,
                max_steps=max_steps,
                enough=enough,
                damping=damping,
                least=FAR_LEAST if far else least_squares.LEAST,
                same=unwound if far else None,
            )
            values[np.ix_(block, free)] = nearest.x * scale
            error[block] = _error(record, nearest.residual * length)
            steps = max(steps, nearest.steps)
    if np.any(other := np.isnan(error)):
        error[other] = _error(record, closing_system(record, values[other], None if asked is None else asked[other])[0])
    error = error.reshape(start.shape[:-1])
    return Assembly(values.reshape(start.shape), error, error <= CLOSED * length, steps)


def _error(record: MechanismRecord, gaps: FloatArray) -> FloatArray:
    """The largest (N,) of gaps (N, r) of `closing_system`: of loops, and of a pose coordinate by coordinate."""
    loops, away = np.split(gaps, [6 * len(joint_graph(record).cut)], axis=1)
    largest = np.maximum(_largest(loops.reshape(len(gaps), -1, 6)), np.max(np.abs(away), axis=1, initial=0.0))
    return np.asarray(largest)


def gap_left(record: MechanismRecord, assembly: Assembly) -> str:
    """What is said of loops that do not close from home."""
    return f"the loops do not close from home: a gap of {float(assembly.residual):.3g} {record.unit} remains"


@dataclass(frozen=True, eq=False)
class AssemblyMobility(Tabulated):
    """Freedom of the joint graph at an assembly, by the rank of its closure Jacobian.

    `rank` (...) of the 6 v rows, `freedoms` = n - rank, `redundant` = 6 v - rank, and `gap` (...): the
    smallest singular value kept over the largest dropped one (inf where none is dropped to rounding).
    """

    rank: NDArray[np.int_]
    freedoms: NDArray[np.int_]
    redundant: NDArray[np.int_]
    gap: FloatArray

    def _title(self) -> str:
        return "freedom of the joint graph"

    def _entries(self) -> Entries:
        numbers = [np.ravel(part).tolist() for part in (self.freedoms, self.rank, self.redundant, self.gap)]
        return [
            dict(zip(("freedoms", "rank", "redundant", "gap"), row, strict=True)) for row in zip(*numbers, strict=True)
        ]


def mobility(record: MechanismRecord, values: FloatArray, *, threshold: float = RANK_GAP) -> AssemblyMobility:
    """Rank, freedoms and redundant constraints at assemblies (..., n).

    Translations are counted in units of the characteristic length, so that the rank does not depend on the unit.
    """
    matrix = closure_jacobian(record, values) * joint_scales(record)
    singular = np.asarray(np.linalg.svd(matrix, compute_uv=False), dtype=float)
    rank, gap = rank_of(singular, threshold * np.max(singular, axis=-1, initial=0.0))
    return AssemblyMobility(rank, values.shape[-1] - rank, matrix.shape[-2] - rank, gap)


def rank_of(singular: FloatArray, zero: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
    """Rank (...) and gap (...) of matrices with singular values (..., k), those up to `zero` (...) counting as zero.

    The gap is the smallest one kept over the largest dropped: inf where none is dropped.
    """
    kept = singular > zero[..., None]
    least = np.min(np.where(kept, singular, np.inf), axis=-1, initial=np.inf)
    dropped = np.max(np.where(kept, 0.0, singular), axis=-1, initial=0.0)
    smallest = np.where(np.isfinite(least), least, zero)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.sum(kept, axis=-1), np.where(dropped > 0.0, smallest / dropped, np.inf)
