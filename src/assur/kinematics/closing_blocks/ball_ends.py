"""Rods of parallelograms with ball joints at both ends, in the place of universal joints at one.

Half a turn of such a rod about its line is another state of the universal joint, in which other signs hold. With a ball
there it is a spin, and all else is as it was: where the universal joint is regular, the rod moves as it may.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from itertools import count

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.joints.spherical import SPHERICAL
from assur.kinematics.home import home_values
from assur.kinematics.loops.parallelograms import parallelograms
from assur.model.mechanism import Coordinate, Joint, MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]


@lru_cache(maxsize=64)
def with_ball_ends(record: MechanismRecord) -> MechanismRecord:
    """The mechanism in which rods of parallelograms have no universal joints but ball joints.

    >>> from assur.model.registry import load_record
    >>> record = load_record("three_p2us")
    >>> len(record.coordinates), len(with_ball_ends(record).coordinates)
    (33, 39)
    """
    freed = _freed(record)
    if not freed:
        return record
    places, coordinates = count(), list[Coordinate]()
    for name, joint in record.joints.items():
        own = SPHERICAL if name in freed else joint.type
        parts = zip(own.components, own.kinds, strict=True)
        coordinates += [Coordinate(name, component, next(places), kind) for component, kind in parts]
    joints = {name: _with_ball(joint) if name in freed else joint for name, joint in record.joints.items()}
    known = {(item.joint, item.component): item for item in coordinates}
    inputs = [
        replace(item, coordinate=known[item.coordinate.joint, item.coordinate.component]) for item in record.inputs
    ]
    groups = {
        name: replace(group, kind="P(4S)") if group.kind == "P(2US)" else group
        for name, group in record.generalised.items()
    }
    return replace(
        record,
        joints=joints,
        coordinates=tuple(coordinates),
        inputs=tuple(inputs),
        generalised=groups,
        home=ball_ended_values(record, home_values(record)),
        angles={},
        overrides={},  # home is that of the changed dimensions
    )


def ball_ended_values(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Its joint values (..., m) at joint values (..., n) of the mechanism."""
    freed, slices = _freed(record), joint_graph(record).slices
    columns = []
    for name, joint in record.joints.items():
        own = joints[..., slices[name]]
        if name in freed:
            first, second = (rotations.about_axis(joint.axes[k], own[..., k]) for k in (0, 1))
            own = rotations.to_vector(first @ second)
        columns.append(own)
    return np.concatenate(columns, axis=-1) if freed else joints


@lru_cache(maxsize=64)
def _freed(record: MechanismRecord) -> frozenset[str]:
    """The universal joints of rods in parallelograms, neither of whose turns is driven."""
    driven = {item.coordinate.joint for item in record.inputs}
    names = [name for group in parallelograms(record).values() if group.kind == "P(2US)" for name in group.joints]
    return frozenset(name for name in names if record.joints[name].type.turns == 2 and name not in driven)


def _with_ball(joint: Joint) -> Joint:
    return replace(
        joint, type=SPHERICAL, axes=np.zeros((0, 3)), limits=(None,) * len(SPHERICAL.components), written=None
    )
