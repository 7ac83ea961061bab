"""Maps of stiffness: the nodes say what poses say, in the workspace alone."""

import numpy as np
import pytest

import assur
from assur.kinematics.status import Status
from assur.machine.elasticity.stiffness_maps import stiffness_maps
from assur.workspace.region import workspace


@pytest.mark.parametrize(("name", "held"), [("zeng2019", {"y": 0.0}), ("planar_3rrr", {"phi": 0.0})])
def test_a_node_says_what_its_pose_says(name, held):
    record = assur.load(name)
    maps = stiffness_maps(record, workspace(record, resolution=8, held=held), nodes=5)
    (first, xs), (second, ys) = maps.axes
    inside = np.argwhere(maps.status == Status.regular)
    assert 2 < len(inside) < 25
    for place in (inside[0], inside[-1]):
        pose = {**held, first: xs[place[0]], second: ys[place[1]]}
        own = record.stiffness([pose[coordinate] for coordinate in record.platform.pose])
        assert maps["least_stiffness"][tuple(place)] == pytest.approx(own.translational[0][0, 0], rel=1e-6)
        way = [maps[f"direction_{axis}"][tuple(place)] for axis in "xyz"]
        np.testing.assert_allclose(way, own.translational[1][0, 0], atol=1e-6)
    outside = maps.status == Status.unreachable
    assert np.isnan(maps["least_stiffness"][outside]).all()
