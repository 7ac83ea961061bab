"""Configurations of one working mode: poses drawn evenly from the file's box, those kept that the mode reaches."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.border import checked_poses
from assur.kinematics.closure import assemble, characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.limits import limits
from assur.kinematics.position import inverse
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
ROUNDS = 40
"""How many times as many poses are drawn, at most, as are wanted."""

SPREAD = 0.2
"""How far joints are spread about home, in rad and characteristic lengths, where there is no closed form."""


def sampled(record: MechanismRecord, count: int, mode: str | None = None, seed: int = 0) -> FloatArray:
    """Joint values (k, n), k at most `count`, of a working mode (the file's default) within strokes and limits.

    With a closed form and a box for every coordinate, poses are even in the box; else assemblies near home.

    Errors: `UsageError` for a count below 1, and where no pose is reached.

    >>> from assur.model.registry import load_record
    >>> sampled(load_record("fivebar"), 10).shape
    (10, 5)
    """
    if count < 1:
        raise UsageError(f"samples: {count}; at least 1")
    rng = np.random.default_rng(seed)
    names = record.platform.pose
    in_box = record.closed_form is not None and all(name in record.box for name in names)
    bounds = limits(record, home_values(record))
    found: list[FloatArray] = []
    for _ in range(ROUNDS):
        joints = _of_box(record, count, mode, rng) if in_box else _near_home(record, count, rng)
        inside = np.all([item.margin(joints) >= 0 for item in bounds], axis=0) if bounds else np.ones(len(joints), bool)
        found.append(joints[inside])
        if sum(map(len, found)) >= count:
            break
    joints = np.concatenate(found)[:count]
    if not len(joints):
        raise UsageError(
            f"{record.name}: none of {ROUNDS * count} poses is reached in mode {mode or record.modes.default_working}",
            hint=f"see assur workspace {record.name}",
        )
    return joints


def _of_box(record: MechanismRecord, count: int, mode: str | None, rng: np.random.Generator) -> FloatArray:
    names = record.platform.pose
    low, high = np.array([record.box[name] for name in names]).T
    poses = checked_poses(record, rng.uniform(low, high, size=(count, len(names))))
    found = inverse(record, poses, mode or record.modes.default_working)
    return np.asarray(found.joints[found.exists])


def _near_home(record: MechanismRecord, count: int, rng: np.random.Generator) -> FloatArray:
    length = characteristic_length(record)
    units = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    starts = home_values(record) + SPREAD * units * rng.uniform(-1, 1, size=(count, len(units)))
    near = assemble(record, starts)
    return np.asarray(near.values[near.closed])
