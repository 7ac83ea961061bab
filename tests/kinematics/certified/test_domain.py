from __future__ import annotations

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.domain import pose_box, reaches
from assur.model.joint_graph import frames
from assur.model.pose import is_angle
from assur.model.registry import names


@pytest.mark.parametrize("name", [name for name in names() if name != "gough_stewart"])
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


def test_a_shorter_limb_makes_a_smaller_box():
    wide, narrow = (
        np.subtract(*pose_box(assur.load("fivebar", l2=l2), np.array([2.2, 0.9]))[::-1]) for l2 in (200, 100)
    )
    assert np.all(narrow < wide)


def test_a_quaternion_has_no_box():
    record = assur.load("gough_stewart")
    assert pose_box(record, inputs_of(record, record.home_values)) is None
