"""Status of configurations of the joint graph: ranks say what is singular, finite steps what is self-motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.joint_graph.frames import Frame, frames
from assur.kinematics.border import checked_joints
from assur.kinematics.closure import assemble
from assur.kinematics.rates.instantaneous import Instant, instantaneous
from assur.kinematics.rates.motions import SINGULAR, motions, twist_units
from assur.kinematics.rates.regularity import surely_regular
from assur.kinematics.status import NEAR_SINGULAR, Status
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

STEPS = (0.01, 0.02, 0.04)
"""How far a self-motion is followed, in rad or characteristic lengths; every step must end near where it was aimed."""


def classify_at(record: MechanismRecord, joints: ArrayLike) -> NDArray[np.int8]:
    """Status (...) of configurations of the joint graph, at joint values (..., n).

    parallel: the inputs can stand while the platform moves (RO), or cannot be chosen freely (II); serial: the pose can
    stand while inputs move (RI), or not move in every direction (IO); comprehensive: both; constraint: more freedoms
    than in general (IIM); self_motion: the platform moves by a finite amount while every input stands, shown by steps
    of `STEPS`; near_singular: a measure is at most `NEAR_SINGULAR` and none of these holds; not_closed: the loops are
    not. For the letters see `Instant.types`.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> Status(int(classify_at(record, home_values(record)))).name
    'regular'
    """
    values = checked_joints(record, joints)
    rows = values.reshape(-1, values.shape[-1])
    status = np.full(len(rows), Status.regular, dtype=np.int8)
    doubtful = ~surely_regular(record, rows)
    if np.any(doubtful):
        status[doubtful] = status_of(record, rows[doubtful], instantaneous(record, rows[doubtful]))
    return status.reshape(values.shape[:-1])


def status_of(record: MechanismRecord, values: FloatArray, instant: Instant) -> NDArray[np.int8]:
    """The same for joint values (..., n) whose first-order motion is known."""
    serial, parallel = sides(instant)
    with np.errstate(invalid="ignore"):
        near = np.any([measure <= NEAR_SINGULAR for measure in instant.measures.values()], axis=0)
    status = np.zeros(instant.closed.shape, dtype=np.int8)
    for level, holds in (
        (Status.near_singular, near),
        (Status.serial, serial),
        (Status.parallel, parallel),
        (Status.comprehensive, serial & parallel),
        (Status.constraint, instant.types["IIM"]),
    ):
        status = np.where(holds, np.int8(level), status)
    loose = instant.types["RO"]
    if np.any(loose):
        moves = np.zeros(loose.shape, dtype=bool)
        moves[loose] = has_finite_motion(record, values[loose])
        status = np.where(moves, np.int8(Status.self_motion), status)
    return np.asarray(np.where(instant.closed, status, np.int8(Status.not_closed)), dtype=np.int8)


def sides(instant: Instant) -> tuple[BoolArray, BoolArray]:
    """Whether a configuration is singular on the inputs' side (serial) and on the platform's (parallel), each (...)."""
    types = instant.types
    return types["RI"] | types["IO"], types["RO"] | types["II"]


def has_finite_motion(record: MechanismRecord, values: FloatArray) -> BoolArray:
    """Whether the platform moves by a finite amount with every input locked, from assemblies (N, n).

    From each it is displaced along every motion of the platform that leaves the inputs alone, both ways, by each of
    `STEPS`, and the loops are closed again. Where no motion but one of first order exists, they close back where they
    were; a self-motion lets the platform stay at least half as far away as it was put. The steps show what is true.
    They do not prove what is false where several motions of first order meet: a basis of them is tried, no sums.
    """
    ways, speeds = _loose_ways(record, values)  # (d, N, n), (d, N)
    inputs = list(record.input_indices)
    start = frames(record, values)[record.platform.link]
    moves = np.zeros(len(values), dtype=bool)
    for way, speed in zip(ways, speeds, strict=True):
        for sense in (1.0, -1.0):
            held = speed > 0.0
            for step in STEPS:
                if not np.any(held):
                    break
                begun = values[held] + sense * step * way[held]
                begun[:, inputs] = values[held][:, inputs]  # a way that is loose at first order nearly may move them
                trial = assemble(record, begun, held=inputs)
                away = _distance(record, start, frames(record, trial.values)[record.platform.link], held)
                held[held] = trial.closed & (away > 0.5 * step * speed[held]) & (away < 2.0 * step * speed[held])
            moves |= held
    return moves


def _loose_ways(record: MechanismRecord, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Joint rates (d, N, n) that leave the inputs alone, and how fast each moves the platform (d, N), fastest first."""
    motion = motions(record, values)
    _, sizes, right = np.linalg.svd(motion.inputs)
    sizes = np.pad(sizes, ((0, 0), (0, right.shape[-1] - sizes.shape[-1])))
    loose = np.swapaxes(right, -1, -2) * (sizes <= SINGULAR)[:, None, :]  # (N, n, n), combinations of motions
    _, speeds, turned = np.linalg.svd(motion.twists @ loose)
    moving = np.where(speeds > SINGULAR, speeds, 0.0)  # (N, min(6, n))
    count = int(np.max(np.sum(moving > 0.0, axis=-1), initial=0))
    ways = motion.null @ loose @ np.swapaxes(turned, -1, -2)[..., :count] * motion.scale[:, None]
    return np.moveaxis(ways, -1, 0), moving[:, :count].T


def _distance(record: MechanismRecord, start: Frame, end: Frame, rows: BoolArray) -> FloatArray:
    """How far the platform has moved (k,): rotation and displacement of its point in characteristic lengths."""
    rotation, origin = start[0][rows], start[1][rows]
    turn = rotations.to_vector(end[0] @ np.swapaxes(rotation, -1, -2))
    shift = (end[0] - rotation) @ record.platform.point + end[1] - origin
    return np.asarray(np.linalg.norm(np.concatenate([turn, shift], axis=-1) / twist_units(record), axis=-1))
