from dataclasses import replace

import numpy as np

import assur
from assur.figures.catalogue import drawing
from assur.joint_graph.points import point
from assur.kinematics.closure import closure_error


def test_points_are_those_of_the_joint_graph(every, data_of_every):
    skeleton = every.schematic
    found = data_of_every("model")["points"]
    assert set(every.record.points) <= set(found)
    for name, at in found.items():
        np.testing.assert_allclose(at, point(skeleton.record, name, skeleton.values), atol=1e-9)


def test_the_drawn_configuration_is_an_assembly(every):
    for skeleton in (every.schematic, every.skeleton):
        assert closure_error(skeleton.record, skeleton.values) < 1e-6 * skeleton.size


def test_the_schematic_is_the_one_that_the_companion_asks_for(every, data_of_every):
    plan = every.companion.schematic
    values = data_of_every("model")["parameters"]
    assert {name: values[name] for name in plan.parameters} == plan.parameters
    if plan.pose:
        pose = dict(zip("xyz", data_of_every("model")["platform"], strict=True))
        np.testing.assert_allclose([pose[name] for name in every.record.platform.pose], plan.pose, atol=1e-6)


def test_angles_are_joint_values(every, data_of_every):
    for name, value in data_of_every("model")["angles_rad"].items():
        coordinate = every.record.angles.get(name) or next(
            item.coordinate for item in every.record.inputs if item.name == name
        )
        assert value == every.schematic.values[coordinate.index]


def test_a_platform_point_outside_of_the_links_is_on_the_page():
    record = assur.load("planar_3rpr")
    size = 3 * float(np.linalg.norm(record.platform.point)) + 1000.0
    moved = replace(record, platform=replace(record.platform, point=np.array([size, size, 0.0])))
    figure = drawing(moved, "model").figure
    figure.canvas.draw()
    width, height = figure.bbox.size
    for text in figure.axes[0].texts:
        x, y = text.get_window_extent().get_points().mean(axis=0)
        assert 0 < x < width
        assert 0 < y < height
