"""Search: assemblies from many starts at once, sorted out by where every joint is; never claimed to be all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import held_inputs
from assur.kinematics.closure import Assembly, assemble, characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.model.joint_graph import frames
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
STARTS = 192
MOST = 8 * STARTS
AGAIN = 8
"""A search ends when so many assemblies in a row, for each that is known, were known already; or after MOST starts."""

SAME = 1e-5
"""Assemblies whose joints are all nearer than this share of the characteristic length are one."""


@dataclass(frozen=True, eq=False)
class Search:
    """Assemblies (K, coordinates) that were found from `starts` starts, in the order of their first finding.

    `last_new` is the number of the start that found the last new one: far below `starts`, more are unlikely.
    `nearest` is the smallest gap that any start came to, in length units; `settled` says whether the search ended
    because it met nothing new any more.
    """

    joints: FloatArray
    starts: int
    last_new: int
    nearest: float
    settled: bool


def search(record: MechanismRecord, problem: Problem, given: FloatArray, seed: int = 0) -> Search:
    """Assemblies at printed inputs (n,) or at a pose (m,), from home and from starts by chance.

    Angles start anywhere on the circle, lengths within twice the characteristic length of home. The search ends when
    it has met what it knows `AGAIN` times as often as it has met anything new, or after `MOST` starts.

    >>> from assur.model.registry import load_record
    >>> len(search(load_record("fivebar"), "direct", np.radians([127.0, 53.0])).joints)
    2
    """
    rng = np.random.default_rng(seed)
    known = np.empty((0, len(record.coordinates)))
    starts, last, nearest, again = 0, 0, np.inf, 0
    while starts < MOST and again < AGAIN * max(len(known), 1):
        found = _assembled(record, problem, given, _starts(record, STARTS, rng, with_home=starts == 0))
        closed = np.flatnonzero(found.closed)
        joints = np.concatenate([known, in_one_turn(record, found.values[closed])])
        kept = distinct(record, joints)
        again += len(closed)
        if len(kept) > len(known):
            newest = int(kept[-1]) - len(known)
            last, again = starts + int(closed[newest]) + 1, len(closed) - newest - 1
        known, nearest, starts = joints[kept], min(nearest, float(np.min(found.residual))), starts + STARTS
    return Search(known, starts, last, nearest, again >= AGAIN * max(len(known), 1))


def _assembled(record: MechanismRecord, problem: Problem, given: FloatArray, start: FloatArray) -> Assembly:
    if problem == "direct":
        return assemble(record, held_inputs(record, start, given), held=record.input_indices)
    return assemble(record, start, poses=given)


def distinct(record: MechanismRecord, joints: FloatArray) -> NDArray[np.intp]:
    """Indices of the first of each group of joint values (N, coordinates) that are one configuration.

    Configurations are told apart by where the joints and the platform are, and by their inputs; a rod that spins about
    its ball joints does not make another one.
    """
    where = places(record, joints)
    kept: list[int] = []
    for k, place in enumerate(where):
        if not kept or np.min(np.max(np.abs(where[kept] - place), axis=-1)) > SAME:
            kept.append(k)
    return np.array(kept, dtype=np.intp)


def in_one_turn(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Joint values (..., coordinates) with the angle of every axis between -pi and pi."""
    turning = [
        item.index for item in record.coordinates if item.kind == "angle" and record.joints[item.joint].type.axes > 0
    ]
    answer = np.array(joints)
    answer[..., turning] = (answer[..., turning] + np.pi) % (2 * np.pi) - np.pi
    return answer


def places(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Places (N, k) of all joints and of the platform in units of the characteristic length, and the inputs."""
    placed, length = frames(record, joints), characteristic_length(record)
    columns = []
    for joint in record.joints.values():
        rotation, origin = placed[joint.parent]
        columns.append((rotation @ joint.at + origin) / length)
    rotation, origin = placed[record.platform.link]
    columns += [(rotation @ record.platform.point + origin) / length, rotation.reshape(len(joints), 9)]
    for item in record.inputs:
        value = joints[:, item.coordinate.index]
        angular = item.coordinate.kind == "angle"
        columns += [np.cos(value)[:, None], np.sin(value)[:, None]] if angular else [value[:, None] / length]
    return np.concatenate(columns, axis=-1)


def _starts(record: MechanismRecord, count: int, rng: np.random.Generator, *, with_home: bool) -> FloatArray:
    """Joint values (count, coordinates) by chance, the first of them home where that is wanted."""
    home, length = home_values(record), characteristic_length(record)
    angular = np.array([item.kind == "angle" for item in record.coordinates])
    spread = rng.uniform(-1.0, 1.0, size=(count, len(home)))
    if with_home:
        spread[0] = 0.0
    return np.asarray(np.where(angular, home + np.pi * spread, home + 2.0 * length * spread))
