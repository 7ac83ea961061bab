from __future__ import annotations

import json

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import residuals
from assur.mechanism import load, names
from assur.numerics import rotations
from assur.page.graph import coordinates, graph


def from_page(found, values):
    """Gaps of the cut joints from the page's data alone, written a second time and one number at a time."""
    frames = {found["base"]: (np.eye(3), np.zeros(3))}

    def motion(joint):
        own = values[joint["first"] : joint["first"] + joint["freedoms"]]
        axes = np.array(joint["axes"])
        turn = {
            "R": lambda: rotations.about_axis(axes[0], own[0]),
            "P": lambda: np.eye(3),
            "H": lambda: rotations.about_axis(axes[0], own[0]),
            "C": lambda: rotations.about_axis(axes[0], own[1]),
            "U": lambda: rotations.about_axis(axes[0], own[0]) @ rotations.about_axis(axes[1], own[1]),
            "S": lambda: rotations.from_vector(own),
        }[joint["type"]]()
        along = {"P": 1.0, "C": 1.0, "H": joint["pitch"] / (2 * np.pi)}.get(joint["type"], 0.0)
        shift = along * own[0] * axes[0] if along else np.zeros(3)
        return turn @ np.array(joint["turn"]), np.array(joint["at"]) + shift

    def child(joint, frame):
        turn, shift = motion(joint)
        rotation = frame[0] @ turn
        return rotation, frame[1] + frame[0] @ shift - rotation @ np.array(joint["childAt"])

    def parent(joint, frame):
        turn, shift = motion(joint)
        rotation = frame[0] @ turn.T
        return rotation, frame[1] + frame[0] @ np.array(joint["childAt"]) - rotation @ shift

    for step in found["tree"]:
        joint = found["joints"][step["joint"]]
        near, far = ("parent", "child") if step["forward"] else ("child", "parent")
        frames[joint[far]] = (child if step["forward"] else parent)(joint, frames[joint[near]])
    gaps = []
    for place in found["cut"]:
        joint = found["joints"][place]
        (r, o), (rotation, origin), at = child(joint, frames[joint["parent"]]), frames[joint["child"]], joint["childAt"]
        gaps.append([*(r @ at + o - rotation @ at - origin), *rotations.to_vector(r @ rotation.T)])
    return np.array(gaps)


@pytest.mark.parametrize("name", names())
def test_the_data_say_the_same_closure_as_the_record(name, rng):
    record = load(name)
    found = json.loads(json.dumps(graph(record)))
    values = np.array(record.home_values) + rng.normal(scale=0.2, size=len(record.coordinates))
    wanted = residuals(record, values)
    wanted[..., 3:] /= characteristic_length(record)
    scale = max(1.0, float(np.max(np.abs(wanted))))
    assert np.allclose(from_page(found, values), wanted, rtol=0, atol=1e-11 * scale)


@pytest.mark.parametrize("name", names())
def test_joint_values_are_named_in_their_order(name):
    record = load(name)
    joints = graph(record)["joints"]
    assert sum(joint["freedoms"] for joint in joints) == len(coordinates(record)) == len(record.home)
    for joint in joints:
        own = coordinates(record)[joint["first"] : joint["first"] + joint["freedoms"]]
        assert all(item["label"].split(".")[0] == joint["name"].split(".")[0] for item in own)
        assert len(joint["limits"]) == joint["freedoms"]
