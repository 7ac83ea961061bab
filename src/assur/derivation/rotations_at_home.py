"""Orientations at home in numbers, of links and of the crosses of universal joints."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.derivation.hinges import cross_of
from assur.joint_graph.frames import frames
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import about
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def rotations_at_home(record: MechanismRecord) -> dict[str, FloatArray]:
    """Orientation (3, 3) of each link at home, and of the crosses of universal joints."""
    values, slices = home_values(record), joint_graph(record).slices
    turned = {link: frame[0] for link, frame in frames(record, values).items()}
    for joint in record.joints.values():
        turns = [(step, first) for step, first in joint.type.places if step.kind == "turn"]
        if len(turns) > 1:
            step, first = turns[0]
            angle = values[slices[joint.name].start + first]
            axis = np.asarray(joint.axes[step.direction], dtype=float)
            turned[cross_of(joint)] = turned[joint.parent] @ turned_about(axis, np.cos(angle), np.sin(angle))
    return turned


def turned_about(axis: FloatArray, cosine: float, sine: float) -> FloatArray:
    """The rotation (3, 3) about an axis (3,)."""
    return np.array(about(tuple(axis), cosine, sine), dtype=float)
