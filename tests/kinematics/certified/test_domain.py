from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import frames
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.domain import ReachBound, _by_both, pose_box, reaches
from assur.model.pose import is_angle
from assur.model.registry import names
from catalogue import each


@pytest.mark.parametrize(
    "name", each([name for name in names() if name != "gough_stewart"], ("zeng2019", "planar_3rrr", "three_rps"))
)
def test_every_pose_lies_in_the_box(name):
    record = assur.load(name)
    rng = np.random.default_rng(1)
    home = inputs_of(record, record.home_values)
    for _ in range(3):
        inputs = home * (1 + 0.02 * rng.standard_normal(len(home)))
        low, high = pose_box(record, inputs)
        found = record.direct(inputs)
        poses = found.poses[found.exists]
        assert len(poses)
        lengths = [not is_angle(part) for part in record.platform.pose]
        assert np.all((low <= poses)[:, lengths] & (poses <= high)[:, lengths])


@pytest.mark.parametrize("name", ["fivebar", "orthoglide", "three_rrc", "tripteron", "zeng2019"])
def test_limbs_that_need_not_close_stay_in_their_regions(name):
    """Whatever the free joints do: along each limb of the tree the platform's point is no farther than is said."""
    record = assur.load(name)
    inputs = inputs_of(record, record.home_values)
    values = np.random.default_rng(2).uniform(-4, 4, (2000, len(record.coordinates)))
    values[:, [item.index for item in record.coordinates if item.kind == "length"]] *= 300
    for item, value in zip(record.inputs, inputs, strict=True):
        values[:, item.coordinate.index] = (value - item.offset) * item.sign
    rotation, origin = frames(record, values)[record.platform.link]
    points = origin + rotation @ record.platform.point
    regions = list(reaches(record, inputs))
    inside = []
    for region in regions:
        away = points - region.centre
        if region.axis is not None:
            away = away - np.outer(away @ region.axis, region.axis)
        inside.append(np.linalg.norm(away, axis=1) <= region.radius)
    assert any(np.all(rows) for rows in inside)  # that of the limb by which the tree reaches the platform


def test_a_slider_that_is_parallel_to_fifteen_digits_only_bounds_nothing():
    """It may go as far as it likes, and far enough out the smallest angle matters."""
    record = assur.load("three_rrc")
    inputs = inputs_of(record, record.home_values)
    assert pose_box(record, inputs) is not None
    sliders = [joint for joint in record.joints.values() if "length" in joint.type.kinds]
    nearly = {}
    for joint in sliders:
        axes = joint.axes.copy()
        large, small = np.argsort(-np.abs(axes[0]))[:2]
        axes[0, small] += 1e-15 * axes[0, large]
        nearly[joint.name] = replace(joint, axes=axes)
    tilted = replace(record, joints={**record.joints, **nearly})
    assert pose_box(tilted, inputs) is None
    assert not [region for region in reaches(tilted, inputs) if region.axis is not None]


def test_two_cylinders_that_are_not_parallel_bound_what_lies_in_both():
    rng = np.random.default_rng(4)
    for _ in range(20):
        axes = [axis / np.linalg.norm(axis) for axis in rng.standard_normal((2, 3))]
        one, other = (ReachBound(100 * rng.standard_normal(3), 50.0 + 200 * rng.random(), axis) for axis in axes)
        points = rng.uniform(-2000, 2000, (40_000, 3))
        away = [points - item.centre for item in (one, other)]
        inside = [
            np.linalg.norm(part - np.outer(part @ item.axis, item.axis), axis=1) <= item.radius
            for part, item in zip(away, (one, other), strict=True)
        ]
        both = points[inside[0] & inside[1]]
        bounds = _by_both(one, other)
        if bounds is not None:
            assert np.all(np.abs(both - bounds[0]) <= bounds[1])
    parallel = ReachBound(np.ones(3), 5.0, one.axis)
    assert _by_both(one, parallel) is None


def test_a_shorter_limb_makes_a_smaller_box():
    wide, narrow = (
        np.subtract(*pose_box(assur.load("fivebar", l2=l2), np.array([2.2, 0.9]))[::-1]) for l2 in (200, 100)
    )
    assert np.all(narrow < wide)


def test_a_quaternion_has_no_box():
    record = assur.load("gough_stewart")
    assert pose_box(record, inputs_of(record, record.home_values)) is None
