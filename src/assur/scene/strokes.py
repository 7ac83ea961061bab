"""Strokes: between which joint values the sliders of a mechanism go, as far as its file and its closed form tell."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import checked_poses, inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.position import inverse
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SAMPLES = 2000


@lru_cache(maxsize=64)
def strokes(record: MechanismRecord) -> Mapping[str, tuple[float, float]]:
    """Driven sliders -> lowest and highest joint value, home's included.

    The file's stroke, else what poses in the workspace's box need; one of which neither is known is left out.

    >>> from assur.model.registry import load_record
    >>> {joint: (round(low), round(high)) for joint, (low, high) in strokes(load_record("three_upu")).items()}
    {'leg1.P': (180, 320), 'leg2.P': (180, 320), 'leg3.P': (180, 320)}
    """
    home, needed = home_values(record), None
    found = {}
    for k, driven in enumerate(record.inputs):
        if driven.coordinate.kind != "length":
            continue
        if driven.stroke is not None:
            ends = np.array(driven.stroke)
        else:
            needed = inputs_over_box(record) if needed is None else needed
            ends = needed[:, k]
        values = [*driven.joint_value(ends), home[driven.coordinate.index]]
        if min(values) < max(values):
            found[driven.coordinate.joint] = (float(min(values)), float(max(values)))
    return found


def inputs_over_box(record: MechanismRecord) -> FloatArray:
    """Printed inputs (N, n) at home and at poses spread over the file's box, in the default working mode.

    Home alone where there is no box, or no closed form that answers at once.
    """
    home = inputs_of(record, home_values(record))
    if record.closed_form is None or not all(name in record.box for name in record.platform.pose):
        return home[None]
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = checked_poses(record, np.random.default_rng(0).uniform(low, high, size=(SAMPLES, len(low))))
    found = inverse(record, poses, record.modes.default_working or None)
    return np.concatenate([home[None], found.inputs[found.exists]])
