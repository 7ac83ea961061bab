from __future__ import annotations

import numpy as np

from assur.kinematics.closure import closure_error
from assur.model.points import point


def test_points_are_those_of_the_joint_graph(context, data):
    skeleton = context.schematic
    found = data("model")["points"]
    assert set(context.record.points) <= set(found)
    for name, at in found.items():
        np.testing.assert_allclose(at, point(skeleton.record, name, skeleton.values), atol=1e-9)


def test_the_drawn_configuration_is_an_assembly(context):
    for skeleton in (context.schematic, context.skeleton):
        assert closure_error(skeleton.record, skeleton.values) < 1e-6 * skeleton.size


def test_the_schematic_is_the_one_that_the_companion_asks_for(context, data):
    plan = context.companion.schematic
    values = data("model")["parameters"]
    assert {name: values[name] for name in plan.parameters} == plan.parameters
    if plan.pose:
        pose = dict(zip("xyz", data("model")["platform"], strict=True))
        np.testing.assert_allclose([pose[name] for name in context.record.platform.pose], plan.pose, atol=1e-6)


def test_angles_are_joint_values(context, data):
    for name, value in data("model")["angles_rad"].items():
        coordinate = context.record.angles.get(name) or next(
            item.coordinate for item in context.record.inputs if item.name == name
        )
        assert value == context.schematic.values[coordinate.index]
