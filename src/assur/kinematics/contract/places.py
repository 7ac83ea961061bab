"""Where a closed form is asked: poses in the box and far beyond it, inputs as they come out and others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, QUATERNION, has_quaternion

FloatArray = NDArray[np.float64]

GROWTH = 3.0
"""Half of the poses come from a box so many times as wide as the file's: a margin says no there, or should."""
TURN = 1.0
"""How far an angle without a box goes from home to either side, in rad; a length goes as far as the mechanism is
long."""
WIDER = 0.5
"""Inputs are drawn from what poses need, and so much of that range further on either side."""

FARTHEST = 1e30
"""Inputs further away, of a form that is wrong, leave no room for a range."""


def poses(record: MechanismRecord, count: int, random: np.random.Generator) -> FloatArray:
    """Poses (count, m): half of them in the workspace box of the file, half in the wider one.

    >>> from assur.model.registry import load_record
    >>> poses(load_record("fivebar"), 6, np.random.default_rng(0)).shape
    (6, 2)
    """
    low, high = _box(record)
    middle, half = (low + high) / 2, (high - low) / 2
    grown = np.where(np.arange(count) % 2, GROWTH, 1.0)[:, None]
    drawn = middle + grown * half * random.uniform(-1.0, 1.0, size=(count, len(low)))
    return border.checked_poses(record, border.in_range(record, drawn))


def _box(record: MechanismRecord) -> tuple[FloatArray, FloatArray]:
    """The file's box; where it has none, about home."""
    names = record.platform.pose
    home = pose_of(record, home_values(record))
    reach = np.array([characteristic_length(record) if name in LENGTHS else TURN for name in names])
    low, high = home - reach, home + reach
    for k, name in enumerate(names):
        if name in record.box:
            low[k], high[k] = record.box[name]
    if has_quaternion(names):  # a quaternion of any length is a rotation
        columns = [names.index(name) for name in QUATERNION if name not in record.box]
        low[columns], high[columns] = home[columns] - 1.0, home[columns] + 1.0
    return low, high


def inputs(record: MechanismRecord, needed: FloatArray, count: int, random: np.random.Generator) -> FloatArray:
    """Inputs (count, n): as poses need them (N, n), the values of each mixed with those of the others, and beyond.

    >>> from assur.model.registry import load_record
    >>> inputs(load_record("fivebar"), np.array([[0.1, 0.2], [0.3, 0.4]]), 6, np.random.default_rng(0)).shape
    (6, 2)
    """
    needed = np.clip(needed, -FARTHEST, FARTHEST)
    low, high = np.min(needed, axis=0), np.max(needed, axis=0)
    spare = WIDER * (high - low)
    least, most = low - spare, high + spare
    for k, item in enumerate(record.inputs):  # a leg of negative length is no other leg
        if item.coordinate.kind == "length" and (low[k] - item.offset) * (high[k] - item.offset) > 0:
            above = low[k] > item.offset
            least[k], most[k] = (
                (max(least[k], item.offset), most[k]) if above else (least[k], min(most[k], item.offset))
            )
    drawn = random.uniform(least, most, size=(count, needed.shape[-1]))
    mixed = np.stack([random.choice(column, count) for column in needed.T], axis=-1)
    return np.where((np.arange(count) % 3 == 0)[:, None], mixed, drawn)
