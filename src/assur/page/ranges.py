"""What the sliders cover: strokes where the file has them, else what the workspace needs, else a stated share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import checked_poses, inputs_of
from assur.kinematics.closure import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import inverse
from assur.model.mechanism import Input, MechanismRecord
from assur.model.pose import LENGTHS, QUATERNION

FloatArray = NDArray[np.float64]
SAMPLES = 2000
PAD = 0.05
"""A slider goes beyond what the workspace needs by this share of it."""


def input_ranges(record: MechanismRecord) -> list[list[float]]:
    """(low, high) of each printed input, in lengths and rad, home included.

    >>> from assur.model.registry import load_record
    >>> low, high = np.array(input_ranges(load_record("zeng2019"))).T
    >>> bool(np.all(low < [162.7, -143.3, -24.7]) and np.all(high > [162.7, -143.3, -24.7]))
    True
    """
    home = inputs_of(record, home_values(record))
    needed = _needed(record, home)
    return [_range(record, item, float(home[k]), needed[:, k]) for k, item in enumerate(record.inputs)]


def pose_ranges(record: MechanismRecord) -> list[list[float]]:
    """(low, high) of each pose coordinate: the file's box, home included; without one around home.

    >>> from assur.model.registry import load_record
    >>> pose_ranges(load_record("fivebar"))
    [[-150.0, 150.0], [100.0, 260.0]]
    """
    home = pose_of(record, home_values(record))
    found = []
    for name, here in zip(record.platform.pose, home.tolist(), strict=True):
        low, high = record.box.get(name) or _around(record, name, here)
        found.append([min(low, here), max(high, here)])
    return found


def _around(record: MechanismRecord, name: str, here: float) -> tuple[float, float]:
    if name in QUATERNION:
        return -1.0, 1.0
    if name == "theta":
        return -np.pi / 2, np.pi / 2
    half = characteristic_length(record) if name in LENGTHS else np.pi
    return here - half, here + half


def _needed(record: MechanismRecord, home: FloatArray) -> FloatArray:
    """Printed inputs (N, n) at poses spread over the file's box, in the default working mode; only home without."""
    if record.closed_form is None or not all(name in record.box for name in record.platform.pose):
        return home[None]
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = checked_poses(record, np.random.default_rng(0).uniform(low, high, size=(SAMPLES, len(low))))
    found = inverse(record, poses, record.modes.default_working or None)
    return np.concatenate([home[None], found.inputs[found.exists]])


def _range(record: MechanismRecord, item: Input, here: float, needed: FloatArray) -> list[float]:
    if item.stroke is not None:
        return [min(item.stroke[0], here), max(item.stroke[1], here)]
    if item.coordinate.kind == "angle":
        needed = here + (needed - here + np.pi) % (2 * np.pi) - np.pi
    low, high = float(np.min(needed)), float(np.max(needed))
    if high == low:
        half = np.pi if item.coordinate.kind == "angle" else characteristic_length(record)
        return [here - half, here + half]
    return [low - PAD * (high - low), high + PAD * (high - low)]
