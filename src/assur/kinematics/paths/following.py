"""Following a path: tangent, step, correction; the mode is kept, and the path stops before what would change it.

Steps (`assur.kinematics.paths.stepping`) adapt themselves; where none can be taken the path stops and says before what
(`assur.kinematics.paths.stopping`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import Interrupted, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantity
from assur.kinematics.border import checked, inputs_of
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.limits import limits
from assur.kinematics.modes import mode_text
from assur.kinematics.paths.course import Prescribed, Turns, course
from assur.kinematics.paths.locked import general_ranks, smallest
from assur.kinematics.paths.path import Path
from assur.kinematics.paths.stepping import Blocked, Point, Task, outside, point_at, step_on
from assur.kinematics.paths.stopping import SINGULAR, stop_at
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.work import WorkStage, stage

FloatArray = NDArray[np.float64]
TOLERANCE = 1e-9
"""Share of the way within which a path stops before what stops it."""

LARGEST_STEP = 0.05
"""Share of the way that one step takes at most."""

FURTHEST = 0.25
"""How far the joint values move in one step at most, in rad or characteristic lengths, all of them together."""

MISSED = 1e-6
"""Rates of which a larger share cannot be produced are those of no motion."""


def follow(
    record: MechanismRecord,
    joints: ArrayLike,
    *,
    inputs: ArrayLike | None = None,
    poses: ArrayLike | None = None,
    turns: Turns = "short",
    use_limits: bool = True,
    tolerance: float = TOLERANCE,
    largest_step: float = LARGEST_STEP,
    ranks: dict[str, int] | None = None,
) -> Path:
    """The path from an assembled configuration to given inputs or to a given pose, the mode kept.

    Args:
        record: the mechanism.
        joints: (n,) joint values at the start, an assembly.
        inputs: (n,) printed inputs to go to, straight; or (k, n), along a polyline.
        poses: (m,) or (k, m), the same for the platform. Either inputs or poses are given.
        turns: angles go the "short" way from vertex to vertex, or as "given".
        use_limits: stop at strokes of inputs and limits of joints where the file has them.
        tolerance: share of the way within which the path stops before what stops it, or as near as the branches can
            be told from each other.
        largest_step: share of the way that one step takes at most.
        ranks: those of `assur.kinematics.paths.locked.general_ranks` on this branch where they are known already.

    Returns:
        The points, adaptive steps apart, and `stopped`: None, or a `Stop` that says before what the path ends: a
        singularity (serial, parallel, comprehensive, constraint), the border of reach being one, or a limit.
        A singularity that is touched, or passed and passed back, between two points is not seen.

    Errors:
        UsageError: shapes, both or neither of inputs and poses, a start that is not assembled.

    Example: P of the five-bar goes straight up until crank and rod are in line, at sqrt((l1 + l2)^2 - g^2).

    >>> from assur.kinematics.position import inverse
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> start = next(iter(inverse(record, [0.0, 200.0], mode="-+")))
    >>> path = follow(record, list(start.joints.values()), poses=[0.0, 400.0])
    >>> path.stopped.kind, float(path.poses[-1, 1].round(3)), float(np.sqrt((100 + 194) ** 2 - 70**2).round(3))
    ('serial', 285.545, 285.545)
    """
    start = _checked_start(record, joints)
    if (inputs is None) == (poses is None):
        raise UsageError("follow: give either inputs or poses", hint="follow(record, joints, poses=[...])")
    if not 0.0 < tolerance < largest_step <= 1.0:
        raise UsageError(
            f"follow: tolerance {tolerance:g} and largest_step {largest_step:g}; 0 < the first < the second <= 1"
        )
    prescribed: Prescribed = "inputs" if poses is None else "poses"
    wanted = inputs if poses is None else poses
    here = inputs_of(record, start) if prescribed == "inputs" else pose_of(record, start)
    way = course(record, prescribed, here, np.asarray([] if wanted is None else wanted), turns)
    bounds = limits(record, start) if use_limits else ()
    known = general_ranks(record, start) if ranks is None else ranks
    task = Task(record, way, bounds, known, tolerance, largest_step)
    points: list[Point] = []
    try:
        with stage("path") as work:
            blocked = _walk(task, start, points, work)
    except KeyboardInterrupt:
        if not points:
            raise
        raise Interrupted(_path(task, points, Blocked("interrupted", 0))) from None
    return _path(task, points, blocked)


def _checked_start(record: MechanismRecord, joints: ArrayLike) -> FloatArray:
    names = tuple(record.coordinate_label(item) for item in record.coordinates)
    start = checked(joints, names, f"joint values of {record.name}").copy()
    if start.ndim != 1:
        raise UsageError(f"follow: joint values of shape {start.shape}; one configuration is followed at a time")
    gap = float(closure_error(record, start))
    if gap > 1e3 * CLOSED * characteristic_length(record):
        raise UsageError(
            f"{record.name}: the start is not assembled, a gap of {gap:.3g} {record.unit} remains",
            hint="take joint values from .direct(..).joints, .inverse(..).joints or .home_values",
        )
    return start


def _walk(task: Task, start: FloatArray, points: list[Point], work: WorkStage) -> Blocked | None:
    """Add points from the start to the end of the way, or to what blocks it, which is the answer."""
    points.append(point_at(task, 0.0, start))
    blocked = _blocked_at_once(task, points[0])
    step = task.largest_step
    for segment, end in enumerate(task.way.shares[1:]):
        while blocked is None and points[-1].share < end:
            here = points[-1]
            tangent, missed = here.own.tangent(task.way.rate(here.share, segment))
            if missed > MISSED:
                blocked = Blocked("missed", segment)
                break
            most = min(task.largest_step, FURTHEST / float(np.linalg.norm(tangent)))
            taken, step = step_on(task, here, segment, tangent, min(step, most))
            if isinstance(taken, Blocked):
                blocked = taken
            else:
                points.append(taken)
                work.at(len(points), result=f"{taken.share:.0%} of the way")
    return blocked


def _blocked_at_once(task: Task, start: Point) -> Blocked | None:
    """What blocks the way before it begins: a singular start, or one outside the limits."""
    if len(task.way.vertices) < 2:
        return None
    if min(start.own.sizes[-1], start.other.sizes[-1]) <= SINGULAR:
        return Blocked("lost", 0)
    broken = outside(task, start.joints)
    return Blocked("limit", 0, broken) if broken else None


def _path(task: Task, points: list[Point], blocked: Blocked | None) -> Path:
    record = task.record
    joints = np.array([point.joints for point in points])
    sizes = smallest(record, joints, task.ranks)
    stopped = None if blocked is None else stop_at(record, task.way, points, blocked, sizes)
    return Path(
        record=record,
        prescribed=task.way.prescribed,
        shares=np.array([point.share for point in points]),
        joints=joints,
        poses=pose_of(record, joints),
        inputs=inputs_of(record, joints),
        smallest=sizes,
        modes=(mode_names(record, joints[0]), mode_names(record, joints[-1])),
        stopped=stopped,
    )


def mode_names(record: MechanismRecord, joints: FloatArray) -> tuple[str, str]:
    """Working and assembly mode of joint values (n,), by the quantities that the file names; "" where it names none."""
    groups = (record.modes.working, record.modes.assembly)
    working, assembly = (
        mode_text([int(np.sign(quantity(record, item, joints))) for item in group.values()]) for group in groups
    )
    return working, assembly
