"""Joint values without trigonometry: a length itself, an angle's cosine and sine, a ball joint's quaternion."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.joints.joint_type import JointType
from assur.model.mechanism import MechanismRecord
from assur.numerics import components

FloatArray = NDArray[np.float64]


@lru_cache(maxsize=64)
def state_names(record: MechanismRecord) -> dict[str, tuple[str, ...]]:
    """Names of the numbers of each joint, with the index of the coordinate that they belong to.

    >>> from assur.model.registry import load_record
    >>> list(state_names(load_record("orthoglide")).values())[:2]
    [('length0',), ('cos1', 'sin1')]
    """
    slices = joint_graph(record).slices
    names: dict[str, tuple[str, ...]] = {}
    for name, joint in record.joints.items():
        start = slices[name].start
        names[name] = tuple(f"{number}{start + first}" for step, first in joint.type.places for number in step.numbers)
    return names


def state_of(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """The state (k, b), in the order of `state_names`, of joint values (n, b).

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> state_of(record, np.zeros((5, 1)))[:4, 0]
    array([1., 0., 1., 0.])
    """
    slices = joint_graph(record).slices
    parts = [joint_state(joint.type, values[slices[name]]) for name, joint in record.joints.items()]
    return np.concatenate(parts)


def joint_state(joint_type: JointType, values: FloatArray) -> FloatArray:
    """The numbers (k, b) of one joint at its values (f, b)."""
    return np.concatenate([step.state(values[first : first + len(step.kinds)]) for step, first in joint_type.places])


def ball_rates(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Angular velocity per rate of each part of the rotation vectors of joint values (n, b): rows (9 s, b).

    Nine for each of the s ball joints, in the joints' order: the matrix row by row.
    """
    slices, rows = joint_graph(record).slices, [np.empty((0, values.shape[1]))]
    for name, joint in record.joints.items():
        for step, first in joint.type.places:
            if step.kind == "ball":
                start = slices[name].start + first
                matrix = components.left_jacobian(np.moveaxis(values[start : start + 3], 0, -1))
                rows.append(np.moveaxis(matrix, 0, -1).reshape(9, -1))
    return np.concatenate(rows)
