"""What the sliders cover: strokes where the file has them, a whole turn of an angle, else what the workspace needs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.turns import counted, lasting_relations
from assur.model.mechanism import Input, MechanismRecord
from assur.model.pose import LENGTHS, QUATERNION
from assur.scene.strokes import inputs_over_box

FloatArray = NDArray[np.float64]
PAD = 0.02
"""A slider goes beyond what the workspace needs by this share of it, and on to a round number."""

ROUND = 20
"""Ends are whole multiples of 1, 2 or 5 times a power of ten that is at most a share 1 / ROUND of the slider."""

CENTRED = 0.75 * np.pi
"""An angle at home up to this has a slider from -180 to 180 deg; others have one about 180, -180, 360, .. deg."""


def input_ranges(record: MechanismRecord) -> list[list[float]]:
    """(low, high) of each printed input, in lengths and rad, home included.

    >>> from assur.model.registry import load_record
    >>> low, high = np.array(input_ranges(load_record("zeng2019"))).T
    >>> bool(np.all(low < [162.7, -143.3, -24.7]) and np.all(high > [162.7, -143.3, -24.7]))
    True
    """
    home = inputs_of(record, home_values(record))
    needed = inputs_over_box(record)
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


def whole_turn(angle: float) -> tuple[float, float]:
    """One turn in rad that holds an angle well inside, from -180 to 180 deg where it can be.

    Every value of the angle has a place on it.

    >>> [float(end) for end in np.degrees(whole_turn(np.radians(170.0)))]
    [0.0, 360.0]
    """
    centre = 0.0 if abs(angle) <= CENTRED else np.pi * round(angle / np.pi)
    return centre - np.pi, centre + np.pi


def _around(record: MechanismRecord, name: str, home: float) -> tuple[float, float]:
    if name in QUATERNION:
        return -1.0, 1.0
    if name == "theta":
        return -np.pi / 2, np.pi / 2
    if name not in LENGTHS:
        return whole_turn(home)
    half = characteristic_length(record)
    return _outward(home - half, home + half)


def _range(record: MechanismRecord, driven: Input, home: float, needed: FloatArray) -> list[float]:
    if driven.stroke is not None:
        return [min(driven.stroke[0], home), max(driven.stroke[1], home)]
    if counted(record)[driven.coordinate.index]:
        half = 2 * np.pi * _turns(record, driven)
        return [home - half, home + half]
    if driven.coordinate.kind == "angle":
        return list(whole_turn(home))
    low, high = float(np.min(needed)), float(np.max(needed))
    half = PAD * (high - low) or characteristic_length(record)
    return list(_outward(low - half, high + half))


def _turns(record: MechanismRecord, driven: Input) -> int:
    """Whole turns of a driven screw, or of a shaft that drives one, that advance it by the characteristic length."""
    index = driven.coordinate.index
    together = [row for row in lasting_relations(record) if row[index]]
    screws = {record.coordinates[k].joint for row in together for k in np.flatnonzero(row)} | {driven.coordinate.joint}
    pitch = max(abs(record.joints[name].pitch) for name in screws)
    return max(1, round(characteristic_length(record) / pitch))


def _outward(low: float, high: float) -> tuple[float, float]:
    """The nearest round numbers that hold a range.

    >>> _outward(-12.3, 401.0), _outward(0.03, 0.98)
    ((-20.0, 420.0), (0.02, 0.98))
    """
    most = (high - low) / ROUND
    power = float(10.0 ** np.floor(np.log10(most)))
    step = power * (5 if most >= 5 * power else 2 if most >= 2 * power else 1)
    first, last = np.floor(low / step), np.ceil(high / step)
    return float(f"{step * first:.12g}"), float(f"{step * last:.12g}")
