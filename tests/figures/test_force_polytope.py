"""The polytope that is drawn is that of the capacity."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.figures import catalogue as figures
from assur.figures.force_maps import FORCE_MAPS
from assur.figures.force_polytope import FORCE_POLYTOPE
from assur.kinematics.pose import pose_of
from assur.machine.forces.capacity import capacity


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_corners_and_sphere_are_those_of_the_capacity(name):
    context = figures.Context(assur.load(name))
    data = figures.drawing(context.record, "polytope", context).data
    held = capacity(context.record, pose_of(context.record, context.drawn_joints))
    np.testing.assert_allclose(data["vertices"], held.vertices)
    assert data["sphere"] == held.sphere
    caption = figures.spec(context.record, "polytope", context).caption
    assert f"{held.sphere:.4g} N" in caption
    assert held.limiting in caption


def test_without_limits_of_the_actuators_there_is_none():
    record = assur.load("fivebar")
    bare = figures.Context(replace(record, machine=replace(record.machine, actuators={})))
    assert "no largest force of theta1, theta2" in figures.left_out(bare.record, bare)["polytope"]


def test_forces_along_one_direction_span_none():
    context = figures.Context(assur.load("three_rps"))  # of the translations only that along z is a coordinate
    assert "along one direction" in FORCE_POLYTOPE.missing(context)
    assert FORCE_MAPS.missing(context) == ""  # which tell what is held along it
