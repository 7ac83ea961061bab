"""Following a path: tangent, step, correction; the mode is kept, and the path stops before what would change it.

Steps (`stepping`) adapt themselves; where the guard (`ranks`) lets none be taken the path stops and says before what
(`stopping`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import Interrupted, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import checked, inputs_of
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.following.course import Course, Prescribed, Turns, course
from assur.kinematics.following.locked import general_ranks, smallest
from assur.kinematics.following.path import Path
from assur.kinematics.following.ranks import FIRST, Blocked, RankGuard
from assur.kinematics.following.stepping import Pace, Places, followed
from assur.kinematics.following.stopping import stop_at
from assur.kinematics.following.ways import Stretch, system_of
from assur.kinematics.limits import limits
from assur.kinematics.naming import mode_names
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.work import stage

FloatArray = NDArray[np.float64]
TOLERANCE = 1e-9
"""Share of the way within which a path stops before what stops it."""

LARGEST_STEP = 0.05
"""Share of the way that one step takes at most."""

LEAVING = 1e-3
"""Share of the tolerance to which steps may go down at the start, where another path may have stopped."""


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
        ranks: those of `assur.kinematics.following.locked.general_ranks` on this branch where they are known already.

    Returns:
        The points, adaptive steps apart, and `stopped`: None, or a `Stop` that says before what the path ends: a
        singularity (serial, parallel, comprehensive, constraint), the border of reach being one, or a limit.
        A singularity that is touched, or passed and passed back, between two points is not seen. A start that is
        singular where nothing is prescribed is left: poses go on from a parallel singularity, inputs from a serial one.

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
    targets = inputs if poses is None else poses
    begun = inputs_of(record, start) if prescribed == "inputs" else pose_of(record, start)
    way = course(record, prescribed, begun, np.asarray([] if targets is None else targets), turns)
    bounds = limits(record, start) if use_limits else ()
    known = general_ranks(record, start) if ranks is None else ranks
    with stage("path") as work:
        guard = RankGuard(prescribed, lambda *_: bounds, known, work)
        try:
            walked(record, way, start, guard, Pace(tolerance, largest_step, LEAVING))
        except KeyboardInterrupt:
            if not guard.points:
                raise
            guard.refused.append(Blocked("interrupted"))
            raise Interrupted(_path(record, way, guard)) from None
    return _path(record, way, guard)


def _checked_start(record: MechanismRecord, joints: ArrayLike) -> FloatArray:
    names = tuple(record.coordinate_label(coordinate) for coordinate in record.coordinates)
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


def walked(record: MechanismRecord, way: Course, start: FloatArray, guard: RankGuard, pace: Pace) -> bool:
    """Whether the end of a way is come to from joint values (n,); the guard has the points up to there."""
    matrix = system_of(record, way.prescribed, start[None], way.vertices[:1])[1]
    places = Places(np.zeros(1), start[None].copy(), matrix)
    going = guard.begun(Stretch(record, way, 0), places)
    steps = np.array([min(FIRST, pace.largest) if guard.leaving else pace.largest])
    for segment, end in enumerate(way.shares[1:]):
        going = going and bool(followed(Stretch(record, way, segment), places, guard, pace, steps, float(end))[0])
    return going


def _path(record: MechanismRecord, way: Course, guard: RankGuard) -> Path:
    """The path of the points that the guard has let by."""
    last = guard.points[-1].share
    stretch = Stretch(record, way, int(np.searchsorted(way.shares, last, side="right")) - 1)
    joints = np.array([point.joints for point in guard.points])
    sizes = smallest(record, joints, guard.ranks)
    return Path(
        record=record,
        prescribed=way.prescribed,
        shares=np.array([point.share for point in guard.points]),
        joints=joints,
        poses=pose_of(record, joints),
        inputs=inputs_of(record, joints),
        smallest=sizes,
        modes=(mode_names(record, joints[0]), mode_names(record, joints[-1])),
        stopped=None if last == way.shares[-1] else stop_at(stretch, guard.points, guard.refused[-1], sizes),
    )
