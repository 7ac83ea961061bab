"""Strokes: what the file states, else what the workspace needs, where a closed form tells."""

import numpy as np

import assur
from assur.kinematics.home import home_values
from assur.scene.strokes import strokes


def test_a_slider_without_a_stated_stroke_goes_as_far_as_the_workspace_needs():
    record = assur.load("orthoglide")
    found = strokes(record)
    assert set(found) == {item.coordinate.joint for item in record.inputs}
    poses = np.array([[high for _, high in record.box.values()], [0.0] * 3])
    answer = record.inverse(poses, record.modes.default_working)
    for k, item in enumerate(record.inputs):
        low, high = found[item.coordinate.joint]
        assert low < home_values(record)[item.coordinate.index] < high
        assert low <= float(item.joint_value(answer.inputs[1, 0, k])) <= high


def test_what_turns_has_none():
    """Cranks alone: none of them slides."""
    record = assur.load("planar_3rrr")
    assert strokes(record) == {}
