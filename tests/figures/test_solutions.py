import numpy as np

import assur
from assur.figures.catalogue import drawing
from assur.joint_graph.points import point
from assur.kinematics.position import direct
from spherical import spherical


def test_all_listed_direct_solutions_are_drawn_and_close(context, data):
    found = data("solutions")
    solved = list(direct(context.record, found["inputs"]))
    assert len(found["solutions"]) == len(solved) == len(context.assemblies)
    for item in found["solutions"]:
        match = next(other for other in solved if other.mode == item["mode"])
        np.testing.assert_allclose(item["pose"], match.pose)
        assert item["residual"] < 1e-6 * context.skeleton.size
        joints = np.array(list(match.joints.values()))
        for name, at in item["points"].items():
            np.testing.assert_allclose(at, point(context.record, name, joints), atol=1e-9)


def test_the_drawn_configuration_is_number_one(context, data):
    first = data("solutions")["solutions"][0]
    for name, at in first["points"].items():
        np.testing.assert_allclose(at, context.skeleton.points[name], atol=1e-6)


def test_driven_joints_stand_at_one_place_in_all(context, data):
    sliders = [item.coordinate.joint for item in context.record.inputs]
    solutions = data("solutions")["solutions"]
    for item in solutions:
        for name in sliders:
            np.testing.assert_allclose(item["points"][name], solutions[0]["points"][name], atol=1e-6)


def test_a_mechanism_whose_joints_are_in_one_point_is_drawn(tmp_path):
    record = assur.load(spherical(tmp_path))
    drawn = drawing(record, "solutions")
    assert np.all(np.isfinite(drawn.figure.get_size_inches()))
    assert len(drawn.data["solutions"]) == 8
