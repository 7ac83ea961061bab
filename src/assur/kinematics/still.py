"""What stands still about home, and so in all of home's mode.

An analytic function of the configuration that is constant about home is so on every regular path from it. A platform
that home's mode never turns over is in another mode where it is; it may be another mechanism by all rights, as a Delta
robot whose platform is turned.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import RANK_GAP, assemble, mobility
from assur.kinematics.home import home_values
from assur.kinematics.loops.parallelograms import some_crossed
from assur.kinematics.rates.motions import motions
from assur.kinematics.turns import joint_units, periodic
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
AWAY, SAMPLES = 0.1, 24
"""How far assemblies about home are from it, in rad or characteristic lengths, and how many are looked at."""

STILL, OTHER = 1e-7, 1e-3
"""What changes by less about home stands still; what is further from its value there is another. Cosines, lengths in
characteristic lengths. Four digits lie between, so that neither rounding nor a small motion is taken for one."""


PLATFORM_TURN = "how the platform is turned"


def otherwise(record: MechanismRecord, joints: FloatArray) -> list[str]:
    """What stands still about home and is another at joint values (N, n): its name; "" where nothing is.

    What a parallelogram joins stands as in one, unless home's crosses: where it crosses over, all may turn in a plane.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> otherwise(record, home_values(record)[None])
    ['']
    """
    names, still, home = _still(record)
    apart = (np.abs(_places(record, joints)[1] - home) > OTHER) & still
    crossed = some_crossed(record, joints) & ~some_crossed(record, home_values(record)[None])
    return [
        names[int(np.argmax(row))] if np.any(row) else "how a parallelogram stands" if over else ""
        for row, over in zip(apart, crossed, strict=True)
    ]


def turned_platform(record: MechanismRecord, joints: FloatArray) -> BoolArray:
    """Whether the platform does not turn about home, and is turned at joint values (N, n): it is in another mode.

    >>> from assur.model.registry import load_record
    >>> record = load_record("three_upu")
    >>> turned_platform(record, home_values(record)[None])
    array([False])
    """
    names, still, home = _still(record)
    turn = still & (np.array(names) == PLATFORM_TURN)
    return np.asarray(np.any((np.abs(_places(record, joints)[1] - home) > OTHER) & turn, axis=1))


@lru_cache(maxsize=64)
def _still(record: MechanismRecord) -> tuple[list[str], BoolArray, FloatArray]:
    """Names (k,) of what could stand still, whether it does about home, and its value there; nothing does where home
    has motions that are lost about it, as several modes may meet there.
    """
    home = home_values(record)
    there = motions(record, home, RANK_GAP)
    near = assemblies_about_home(record, SAMPLES)
    names, values = _places(record, np.concatenate([home[None], near]))
    ranks = mobility(record, near).rank if len(near) else np.array([])
    usual = len(near) > SAMPLES // 2 and bool(np.all(ranks == there.ranks.closure))
    return names, np.asarray((np.ptp(values, axis=0) < STILL) & usual), values[0]


def assemblies_about_home(record: MechanismRecord, count: int) -> FloatArray:
    """Assemblies (N, n) some tenth of a rad or of the characteristic length from home: at most so many.

    >>> from assur.model.registry import load_record
    >>> assemblies_about_home(load_record("fivebar"), 6).shape
    (6, 5)
    """
    home = home_values(record)
    there = motions(record, home, RANK_GAP)
    random = np.random.default_rng(0).normal(size=(count, len(home)))
    near = assemble(record, home + AWAY * random @ there.null.T * there.scale)
    return near.values[near.closed]


def _places(record: MechanismRecord, joints: FloatArray) -> tuple[list[str], FloatArray]:
    """Names (k,) and values (N, k): how every link stands, the platform first, and the values of joints."""
    placed, length = frames(record, joints), characteristic_length(record)
    names: list[str] = []
    columns: list[FloatArray] = []
    platform = record.platform.link
    for link in (platform, *(name for name in placed if name != platform)):
        rotation, origin = placed[link]
        named = "the platform" if link == platform else f"link {link}"
        names += 9 * [f"how {named} is turned"] + 3 * [f"where {named} is"]
        columns += [np.broadcast_to(rotation, (len(joints), 3, 3)).reshape(-1, 9)]
        columns += [np.broadcast_to(origin, (len(joints), 3)) / length]
    units, turning = joint_units(record), periodic(record)
    for item in record.coordinates:
        if record.joints[item.joint].type.ball:
            continue
        value = joints[:, item.index]
        parts = [np.cos(value), np.sin(value)] if turning[item.index] else [value / units[item.index]]
        names += len(parts) * [f"the value of {record.coordinate_label(item)}"]
        columns += [part[:, None] for part in parts]
    return names, np.concatenate(columns, axis=1)
