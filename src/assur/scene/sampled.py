"""Configurations drawn at random: poses of the file's box that a mode reaches, or assemblies near home."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import joint_scales
from assur.kinematics.border import checked_poses
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.limits import limits
from assur.kinematics.position import inverse
from assur.model.mechanism import MechanismRecord
from assur.work import stage

FloatArray = NDArray[np.float64]
ROUNDS = 40
"""How many times as many poses are drawn, at most, as are wanted."""

SPREAD = 0.2
"""How far joints are spread about home, in rad and characteristic lengths, where there is no closed form."""


def from_box(record: MechanismRecord) -> bool:
    """Whether poses can be drawn from the file's box: with a closed form, and limits of every coordinate.

    >>> from assur.model.registry import load_record
    >>> from_box(load_record("fivebar"))
    True
    """
    return record.closed_form is not None and all(name in record.box for name in record.platform.pose)


@stage("poses to look at")
def sampled(record: MechanismRecord, count: int, mode: str | None = None, seed: int = 0) -> FloatArray:
    """Joint values (k, n), k at most `count`, of a working mode (the file's default) within strokes and limits.

    With a closed form and a box for every coordinate (`from_box`), poses are even in the box; else assemblies near
    home, of whichever mode they are.

    Errors: `UsageError` for a count below 1, for a mode that is none or cannot be told, and where no pose is reached.

    >>> from assur.model.registry import load_record
    >>> sampled(load_record("fivebar"), 10).shape
    (10, 5)
    """
    if count < 1:
        raise UsageError(f"samples: {count}; at least 1")
    in_box = from_box(record)
    if mode is not None and not in_box:
        lacks = "a closed form" if record.closed_form is None else "a box for every coordinate of the pose"
        raise UsageError(
            f"{record.name} has not {lacks}: no poses can be drawn of the working mode '{mode}'",
            hint="leave the mode out: then assemblies near home are drawn",
        )
    rng = np.random.default_rng(seed)
    bounds = limits(record, home_values(record))
    drawn: list[FloatArray] = []
    for _ in range(ROUNDS):
        joints = _of_box(record, count, mode, rng) if in_box else _near_home(record, count, rng)
        inside = (
            np.all([limit.margin(joints) >= 0 for limit in bounds], axis=0) if bounds else np.ones(len(joints), bool)
        )
        drawn.append(joints[inside])
        if sum(map(len, drawn)) >= count:
            break
    joints = np.concatenate(drawn)[:count]
    if not len(joints):
        name = (mode or record.modes.default_working) if in_box else ""
        raise UsageError(
            f"{record.name}: none of {ROUNDS * count} poses is reached{f' in mode {name}' if name else ''}",
            hint=f"see assur workspace {record.name}",
        )
    return joints


def _of_box(record: MechanismRecord, count: int, mode: str | None, rng: np.random.Generator) -> FloatArray:
    names = record.platform.pose
    low, high = np.array([record.box[name] for name in names]).T
    poses = checked_poses(record, rng.uniform(low, high, size=(count, len(names))))
    solutions = inverse(record, poses, mode or record.modes.default_working)
    return np.asarray(solutions.joints[solutions.exists])


def _near_home(record: MechanismRecord, count: int, rng: np.random.Generator) -> FloatArray:
    units = joint_scales(record)
    starts = home_values(record) + SPREAD * units * rng.uniform(-1, 1, size=(count, len(units)))
    near = assemble(record, starts)
    return np.asarray(near.values[near.closed])
