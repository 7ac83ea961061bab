import numpy as np
import pytest
from matplotlib.path import Path

pytestmark = pytest.mark.parametrize("context", ["planar_3rrr", "zeng2019"], indirect=True)
"""Those whose workspace is not plane."""


def shoelace(polygons):
    total = 0.0
    for polygon in polygons:
        x, y = np.asarray(polygon).T
        total += float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2
    return total


def test_areas_are_those_of_the_polygons(data):
    found = data("projections")["projections"]
    assert len(found) == 2
    for item in found:
        assert shoelace(item["polygons"]) == pytest.approx(item["area"], rel=1e-9)
        assert shoelace(item["near"]) == pytest.approx(item["near_area"], rel=1e-9, abs=1e-9)
        assert item["near_area"] <= item["area"] * (1 + 1e-9)


def test_every_pose_of_the_workspace_falls_on_the_projection(context, data):
    names = context.record.platform.pose
    found = data("projections")["projections"]
    poses = context.workspace.interior(4000, np.random.default_rng(4))
    for item in found:
        keep = [names.index(name) for name in item["plane"]]
        inside = [Path(np.asarray(polygon)).contains_points(poses[:, keep]) for polygon in item["polygons"]]
        assert np.mean(np.any(inside, axis=0)) > 0.99
