import numpy as np
import pytest

from assur.joint_graph.points import point
from assur.scene.companion import length

pytestmark = pytest.mark.parametrize("context", ["zeng2019"], indirect=True)
"""The one whose file names angles about two axes, and a measure."""


def test_points_are_projections_of_the_joint_graph(context, data):
    skeleton = context.schematic
    for plane in data("planes")["planes"]:
        keep = ["xyz".index(name) for name in plane["plane"]]
        assert plane["points"]
        for name, at in plane["points"].items():
            np.testing.assert_allclose(at, point(skeleton.record, name, skeleton.values)[keep], atol=1e-9)


def test_every_angle_of_the_file_is_in_one_plane(context, data):
    drawn = [name for plane in data("planes")["planes"] for name in plane["angles_rad"]]
    assert sorted(drawn) == sorted(context.record.angles)


def test_measures_are_as_long_as_they_claim(context):
    skeleton = context.schematic
    claims = [item for item in context.companion.measures if item.length]
    assert claims
    for item in claims:
        ends = [point(skeleton.record, name, skeleton.values)["xyz".index(item.along)] for name in item.ends]
        assert abs(ends[1] - ends[0]) == pytest.approx(length(skeleton.record, item.length), rel=1e-9)
