"""Poses or inputs that home's mode reaches: many at once, along straight ways from home, by detours, by neighbours."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import checked_poses, in_range, inputs_of
from assur.kinematics.following.course import Prescribed
from assur.kinematics.following.neighbours import SignGuard, held_signs, joined, steps_at
from assur.kinematics.following.stepping import Pace, followed
from assur.kinematics.following.ways import Straight
from assur.kinematics.home import check_loops, home_values
from assur.kinematics.pose import pose_of, turned_alike
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations
from assur.work import stage

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]

FIRST, LEAST = 2.0**-2, 2.0**-10
"""Share of the way of the first step, and of the shortest one that is tried."""
MOST = 100
"""Steps on a way, taken or not, at most."""
AT_ONCE = 4096
"""Poses that are worked on together."""
DETOURS = 6
"""Ways by a pose by chance that are tried where the straight one stops."""
ASIDE = 0.5
"""How far aside these poses lie, as a share of the way, and of the file's box where it has one."""
ALL_ROUND = ("phi", "psi")
"""Angles of a pose that come back after a turn; theta turns back at a right angle."""
COARSE = 2.0**-5
"""The shortest step to one of many poses, or on a detour: what it does not lead to is out of reach, or a neighbour or
another detour leads there."""
SAMPLES, SOME = 512, 16
"""So many poses at a time are followed to from home, or a sixteenth, but a quarter of these at least: each takes some
ten times as long as from a neighbour."""
FINE = 62
"""Bits of a place on the curve along which these are spread, those of all coordinates together."""
WIDE = 1.5
"""Poses that are apart by more than this times the median distance are no neighbours: a line of a grid ends there."""


def followed_from_home(
    record: MechanismRecord, poses: FloatArray, least: float = LEAST, held: Prescribed = "poses"
) -> tuple[FloatArray, BoolArray]:
    """Assemblies of home's mode at poses, or at inputs, each followed along the straight way of coordinates from home.

    A step is taken where the loops close, no joint moves far, the signs that name the mode stay and no two branches
    merge (`Steps`); else it is halved. What a pose gets depends on that pose alone. A pose that is not reached may be
    reached by another way: nothing is proved of it.

    Args:
        record: the mechanism.
        poses: (N, m) in lengths and rad, not by quaternions; or printed inputs (N, k), as their numbers stand.
        least: share of the way of the shortest step that is tried.
        held: whether those are poses or inputs.

    Returns:
        joint values (N, n), NaN where the way ended before, and whether a pose was reached (N,).

    Example: the five-bar, up to where its elbows straighten, and beyond.

        >>> from assur.model.registry import load_record
        >>> _, reached = followed_from_home(load_record("fivebar"), np.array([[0.0, 280.0], [0.0, 290.0]]))
        >>> reached.tolist()
        [True, False]
    """
    home, count = home_values(record), len(poses)
    start = (pose_of if held == "poses" else inputs_of)(record, home)
    joints = _followed(record, np.tile(start, (count, 1)), np.tile(home, (count, 1)), poses, least, held)
    return joints, np.isfinite(joints[:, 0])


def followed_by_ways(record: MechanismRecord, poses: FloatArray) -> FloatArray:
    """Joint values (N, n) of home's mode at poses (N, m), NaN where no way led: straight from home, else by detours.

    Angles go the short way. What a pose gets depends on that pose alone; that none of the ways leads to it is no proof.

    Errors:
        MechanismFileError: a file of nothing but serial chains.

    Example: the five-bar, up to where its elbows straighten, and beyond.

        >>> from assur.model.registry import load_record
        >>> joints = followed_by_ways(load_record("fivebar"), np.array([[0.0, 280.0], [0.0, 290.0]]))
        >>> np.isfinite(joints[:, 0]).tolist()
        [True, False]
    """
    check_loops(record)
    with stage("ways of home's mode to poses", len(poses)) as work:
        parts = [np.empty((0, len(record.coordinates)))]
        for first in range(0, len(poses), AT_ONCE):
            parts.append(_by_ways(record, poses[first : first + AT_ONCE]))
            work.at(min(first + AT_ONCE, len(poses)), len(poses))
    return np.concatenate(parts)


def _by_ways(record: MechanismRecord, poses: FloatArray) -> FloatArray:
    home = home_values(record)
    start = pose_of(record, home)
    begun = np.array([turned_alike(record.platform.pose, start, pose) for pose in poses])
    joints = np.full((len(poses), len(home)), np.nan)
    asides = _asides(record, start, _short_way(record, begun, poses))
    for way, least in itertools.chain([((poses,), LEAST)], (((aside, poses), COARSE) for aside in asides)):
        rows = np.flatnonzero(np.isnan(joints[:, 0]))
        if not len(rows):
            break
        at, values = begun[rows], np.tile(home, (len(rows), 1))
        for vertices in way:
            goal = _short_way(record, at, poses[rows]) if vertices is poses else vertices[rows]
            at, values = goal, _followed(record, at, values, goal, least)
        joints[rows] = values
    return joints


def _followed(
    record: MechanismRecord,
    start: FloatArray,
    joints: FloatArray,
    goals: FloatArray,
    least: float = LEAST,
    held: Prescribed = "poses",
) -> FloatArray:
    """Joint values (N, n) to which straight ways lead from assemblies (N, n) at poses (N, m) or inputs; else NaN."""
    rows, ends = np.flatnonzero(np.isfinite(joints[:, 0])), np.full(joints.shape, np.nan)
    begun, pace = steps_at(home_guard(record, held), start[rows], joints[rows]), Pace(least, most=MOST)
    way = Straight(record, start[rows], goals[rows], held)
    good = followed(way, begun.places, begun.guard, pace, np.full(len(rows), FIRST))
    ends[rows[good]] = begun.places.joints[good]
    return ends


def _asides(record: MechanismRecord, start: FloatArray, goals: FloatArray) -> Iterator[FloatArray]:
    """Poses (N, m) by which to go where the straight way stops; a single angle may go the other way round."""
    if len(start) > 1:
        yield from detours(record, "poses", start, goals)
    elif record.platform.pose[0] in ALL_ROUND:
        yield goals - np.copysign(2.0 * np.pi, goals - start)


def _short_way(record: MechanismRecord, start: FloatArray, goals: FloatArray) -> FloatArray:
    """The same poses (N, m), their angles and quaternions next to those of others."""
    names, near = record.platform.pose, goals.copy()
    turning = [k for k, name in enumerate(names) if is_angle(name)]
    near[:, turning] = start[:, turning] + rotations.nearest_turn(goals[:, turning] - start[:, turning])
    if has_quaternion(names):
        columns = [names.index(name) for name in QUATERNION]
        opposite = np.sum(start[:, columns] * goals[:, columns], axis=1) < 0.0
        near[np.ix_(opposite, columns)] *= -1.0
    return near


def detours(
    record: MechanismRecord, prescribed: Prescribed, start: FloatArray, goals: FloatArray, count: int = DETOURS
) -> Iterator[FloatArray]:
    """Places (N, k) beside the ways from one (k,) to others (N, k), drawn by chance; the same ways have the same."""
    rng = np.random.default_rng(0)
    size = np.repeat(np.max(np.abs(goals - start), axis=1, keepdims=True), len(start), axis=1)
    if prescribed == "poses":
        spans = [np.subtract(*record.box[name][::-1]) if name in record.box else 0.0 for name in record.platform.pose]
        size = np.where(np.array(spans) > 0, spans, np.abs(goals - start))
    for _ in range(count):
        aside = 0.5 * (start + goals) + ASIDE * size * rng.uniform(-1.0, 1.0, len(start))
        yield checked_poses(record, in_range(record, aside)) if prescribed == "poses" else aside


def home_guard(record: MechanismRecord, held: Prescribed) -> SignGuard:
    """The guard of home's mode."""
    return SignGuard(record, held_signs(record, held, home_values(record)), held)


def followed_together(
    record: MechanismRecord, poses: FloatArray, held: Prescribed = "poses"
) -> tuple[FloatArray, BoolArray]:
    """As `followed_from_home`, of poses (N, m) or inputs (N, k) that are near one another, as on a grid.

    Some are followed to from home, the others from neighbours that are reached, which takes a tenth of the time; and
    so on with some of those that are left, until none of these is reached. What a pose gets depends on all of them.

    Example: the five-bar along a line, the last pose beyond its reach.

        >>> from assur.model.registry import load_record
        >>> line = np.stack([np.zeros(6), np.linspace(240.0, 290.0, 6)], axis=1)
        >>> followed_together(load_record("fivebar"), line)[1].tolist()
        [True, True, True, True, True, False]
    """
    guard = home_guard(record, held)
    joints = np.full((len(poses), len(record.coordinates)), np.nan)
    around, left = neighbours(poses), np.arange(len(poses))
    tried = np.zeros(len(poses), dtype=bool)
    while len(left):
        some = left[_spread_out(poses[left], min(SAMPLES, max(SAMPLES // 4, len(left) // SOME)))]
        least = LEAST if len(some) == len(left) else COARSE
        joints[some], good = followed_from_home(record, poses[some], least, held)
        if not np.any(good):
            break
        tried[some] = True
        _spread(guard, poses, joints, around, some[good])
        left = np.flatnonzero(np.isnan(joints[:, 0]) & ~tried)
    return joints, np.isfinite(joints[:, 0])


def _spread(guard: SignGuard, poses: FloatArray, joints: FloatArray, around: IntArray, begun: IntArray) -> None:
    """From poses that are reached to all that neighbours lead to, layer by layer; joint values (N, n) are filled in."""
    front, steps = begun, steps_at(guard, poses[begun], joints[begun])
    while len(front):
        heads = around[:, front]
        tails = np.broadcast_to(np.arange(len(front)), heads.shape)
        reached, layer = [front[:0]], [steps.of(front[:0])]
        while True:
            onward = (heads >= 0) & np.isnan(joints[heads, 0])
            tails, heads = tails[onward], heads[onward]
            if not len(heads):
                break
            ends, first = np.unique(heads, return_index=True)
            after, good = steps.of(tails[first]).to(poses[ends])
            reached.append(ends[good])
            layer.append(after.of(good))
            joints[ends[good]] = layer[-1].places.joints
            tails, heads = np.delete(tails, first), np.delete(heads, first)
        front, steps = np.concatenate(reached), joined(layer)


def _spread_out(points: FloatArray, count: int) -> IntArray:
    """So many rows of points (N, d) at most, spread evenly: at regular places of Morton's curve, which fills space."""
    size, low, span = points.shape[1], np.min(points, axis=0), np.ptp(points, axis=0)
    fine = min(FINE // size, 16)
    cells = ((points - low) / np.where(span > 0.0, span, 1.0) * (2**fine - 1)).astype(np.int64)
    along = np.zeros(len(points), dtype=np.int64)
    for k in np.flatnonzero(span > 0.0):
        for bit in range(fine):
            along |= (cells[:, k] >> bit & 1) << (bit * size + k)
    every = -(-len(points) // count)
    return np.argsort(along, kind="stable")[every // 2 :: every]


def neighbours(poses: FloatArray) -> IntArray:
    """Index (2 m, N) of the next pose up and down each coordinate, the last one first, all others equal; else -1.

    Gaps in a line of poses are wider than `WIDE` times the median distance along that coordinate.

    >>> neighbours(np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]])).tolist()
    [[1, -1, -1], [-1, 0, -1], [2, -1, -1], [-1, -1, 0]]
    """
    count, size = poses.shape
    index = np.full((2 * size, count), -1)
    for row, k in enumerate(reversed(range(size))):
        others = np.delete(poses, k, axis=1)
        order = np.lexsort((poses[:, k], *others.T))
        low, high = order[:-1], order[1:]
        distance = poses[high, k] - poses[low, k]
        line = np.all(others[low] == others[high], axis=1) & (distance > 0.0)
        line &= distance <= WIDE * np.median(distance[line]) if np.any(line) else line
        index[2 * row, low[line]], index[2 * row + 1, high[line]] = high[line], low[line]
    return index
