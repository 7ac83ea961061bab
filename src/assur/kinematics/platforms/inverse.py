"""The inverse problem as a product: each limb closes alone, and any choice of one way a limb is an assembly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.limbs.networks import Limb, limbs_of
from assur.kinematics.limbs.point_closure import DOUBTFUL, MovingLimbError
from assur.kinematics.limbs.serial import NotSerialError
from assur.kinematics.limbs.solving import LimbSolutions
from assur.kinematics.loops.loops import LoopSolutions, PositionQuestion, unsolved
from assur.kinematics.loops.parallelograms import parallelograms
from assur.kinematics.platforms.conditions import (
    UncertainConditionsError,
    conditions_at,
    drawn_rotations,
    joined,
)
from assur.kinematics.platforms.limbs import closed_limb, limb_conditions
from assur.kinematics.platforms.open_poses import OpenPoses, poses_by_limb
from assur.kinematics.platforms.poses import Poses, poses_under
from assur.kinematics.pose import error_of
from assur.kinematics.turns import counts_turns, joint_units, periodic, with_turns_of_home
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, has_quaternion
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
MOST, NEAREST = 4096, 256
"""Assemblies that are listed at most; of more, as the turns of screws make them, so many near home."""
NOT_ALL = "not all"
"""How the right of solutions begins of which every limb's ways are known, and some of their choices are listed."""
OPEN = "the quadrics that limbs say of the platform leave it infinitely many poses"
AS_GIVEN = 1e-5
"""By how much a pose may miss what is given, in characteristic lengths and rad, before loops are closed."""


def inverse_by_limbs(record: MechanismRecord, pose: FloatArray, *, crossed: bool = False) -> LoopSolutions:
    """All assemblies at a pose (m,), limb by limb; not complete where the pose or the limbs are not of that kind.

    Parallelograms of hinges stay such, unless `crossed` ones are asked for too.

    >>> from assur.model.registry import load_record
    >>> record = load_record("gough_stewart")
    >>> solutions = inverse_by_limbs(record, np.array([0.0, 10.0, 300.0, 1.0, 0.0, 0.0, 0.0]))
    >>> len(solutions.joints), solutions.complete
    (64, True)
    """
    question = PositionQuestion(record, "inverse", pose)
    size = characteristic_length(record)
    try:
        series = limbs_of(record, crossed=crossed)
        given = conditions_at(partial(_drawn, record, pose, size), size)
        conditions = joined([given, *(limb_conditions(limb, size) for limb in series)])
        poses = poses_under(conditions, size) or poses_by_limb(record, pose, series)
        if poses is None:
            return unsolved(record, False, f"not proved, since {OPEN}")
        frames = [frame for frame in poses.frames if _as_given(record, pose, frame, size)]
        driven = [item.coordinate.index for item in record.drives]
        sets = [[closed_limb(limb, frame, size, driven) for limb in series] for frame in frames]
    except (NotSerialError, MovingLimbError, UncertainConditionsError) as error:
        return unsolved(record, False, f"not proved, since {error}")
    right = _right(poses, len(frames), series, sets)
    many = sum(prod(len(own.values) for own in limbs) for limbs in sets)
    if many > MOST and (len(sets) > 1 or parallelograms(record)):
        return unsolved(record, False, f"not proved, since there are more than {MOST}")
    listed = sets if many <= MOST else [_near_home(record, limbs) for limbs in sets]
    pieces = [_starts(record, limbs) for limbs in listed] or [(np.zeros((0, len(record.coordinates))), np.zeros(0))]
    starts, bent = (np.concatenate(part) for part in zip(*pieces, strict=True))
    if counts_turns(record):  # a nut threaded on another turn closes as well
        starts, same = with_turns_of_home(record, starts)
        starts, bent, right = starts[same], bent[same], right + "; screws have the turns of home"
    alike = distinct(record, starts)  # a link may stand in two ways in which no joint is elsewhere
    starts, bent = starts[alike], bent[alike]
    joints = question.closed(starts)
    looked = sum(own.roots for limbs in sets for own in limbs)
    sure = starts[bent <= DOUBTFUL]
    doubtful = len(joints) != len(sure) or (len(sure) < len(starts) and len(question.closed(sure)) < len(joints))
    if doubtful or not poses.sure:
        return LoopSolutions(joints, False, f"not proved, since roots are too near to tell them: {right}", looked)
    limbs = tuple(sets[0]) if len(sets) == 1 else ()
    if many > MOST:
        right = f"{NOT_ALL}: there are {many}, {right}; {len(joints)} near home are listed"
    return LoopSolutions(joints, many <= MOST, right, looked, limbs=limbs)


def _near_home(record: MechanismRecord, limbs: Sequence[LimbSolutions]) -> list[LimbSolutions]:
    """Those ways of each limb whose inputs are nearest to home's, as many as have `NEAREST` choices at most.

    Other joint values may be another's that puts every point where home has it.
    """
    home, turning, units = home_values(record), periodic(record), joint_units(record)
    apart, ordered = [], []
    for own in limbs:
        driven = [k for k, index in enumerate(own.indices) if index in record.input_indices]
        columns = [own.indices[k] for k in driven]
        way = own.values[:, driven] - home[columns]
        turns = turning[columns]
        way[:, turns] = np.remainder(way[:, turns] + np.pi, 2.0 * np.pi) - np.pi
        far = np.linalg.norm(way / units[columns], axis=1)
        order = np.argsort(far, kind="stable")
        apart.append(far[order])
        ordered.append(replace(own, values=own.values[order], bent=own.bent[order]))
    counts = [len(own.values) for own in limbs]
    while prod(counts) > NEAREST:
        farthest = max((k for k, count in enumerate(counts) if count > 1), key=lambda k: apart[k][counts[k] - 1])
        counts[farthest] -= 1
    return [
        replace(own, values=own.values[:count], bent=own.bent[:count])
        for own, count in zip(ordered, counts, strict=True)
    ]


def _right(poses: Poses | OpenPoses, real: int, series: Sequence[Limb], sets: Sequence[Sequence[LimbSolutions]]) -> str:
    whole = f"the platform as limbs hold it, {poses.complex} complex poses, {real} of them real"
    if isinstance(poses, OpenPoses):
        whole = f"{poses.right}, {real} real poses"
    if not sets:
        return whole
    ways = []
    for limb, *own in zip(series, *sets, strict=True):
        counts = sorted({len(at_pose.values) for at_pose in own})
        ways.append(f"{limb.joints[0]} ({' to '.join(map(str, dict.fromkeys((counts[0], counts[-1]))))})")
    return f"{whole + ', then ' if poses.complex > 1 else ''}each limb alone, in all its ways: {', '.join(ways)}"


def _drawn(record: MechanismRecord, pose: FloatArray, size: float, count: int, rng: np.random.Generator) -> Frame:
    """Frames of the platform at a pose (m,), open coordinates by chance."""
    named = dict(zip(record.platform.pose, pose, strict=True))
    place = rng.uniform(-size, size, (count, 3))
    for k, name in enumerate(LENGTHS):
        place[:, k] = named.get(name, place[:, k])
    angles = [
        named.get(name, drawn) for name, drawn in zip(ANGLES, rng.uniform(-np.pi, np.pi, (3, count)), strict=True)
    ]
    if has_quaternion(record.platform.pose):
        turned = rotations.from_quaternion(np.array([named[name] for name in QUATERNION]))
    elif named.keys() & {*ANGLES}:
        turned = rotations.from_angles(*(np.broadcast_to(angle, count) for angle in angles))
    else:
        turned = drawn_rotations(rng, count)
    turned = np.broadcast_to(turned, (count, 3, 3))
    return turned, place - turned @ record.platform.point


def _as_given(record: MechanismRecord, pose: FloatArray, frame: Frame, size: float) -> bool:
    """Whether a frame is printed as the pose: an open angle may be given by the one beyond a half turn."""
    seen = frame[0], frame[1] + frame[0] @ record.platform.point
    return bool(np.max(np.abs(error_of(record.platform.pose, seen, pose, size))) < AS_GIVEN * size)


def _starts(record: MechanismRecord, limbs: list[LimbSolutions]) -> tuple[FloatArray, FloatArray]:
    """Joint values (N, n) of all choices, and by how much (N,) their roots were made real."""
    choices = [*product(*(range(len(own.values)) for own in limbs))]
    starts = np.tile(home_values(record), (len(choices), 1))
    bent = np.zeros(len(choices))
    for own, chosen in zip(limbs, np.array(choices, dtype=int).reshape(-1, len(limbs)).T, strict=True):
        starts[:, list(own.indices)] = own.values[chosen]
        bent = np.maximum(bent, own.bent[chosen])
    return starts, bent
