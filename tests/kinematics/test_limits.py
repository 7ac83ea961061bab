"""Strokes, joint limits and cones, and how far inside them a configuration is."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import frames
from assur.kinematics.limits import limits
from assur.model.registry import load_record

DELTA = Path(__file__).parents[1] / "model" / "file" / "delta.toml"


def test_a_cone_is_the_angle_between_the_axis_in_both_links():
    """Seen from the frames of the two links, not from the rotation vector."""
    mechanism = assur.load(DELTA)
    joints = mechanism.home_values
    cone = next(limit for limit in limits(mechanism, joints) if limit.name == "cone of leg1.C1")
    placed = frames(mechanism, joints)
    joint = mechanism.joints["leg1.C1"]
    seen = [placed[link][0] @ joint.cone_axis for link in (joint.parent, joint.child)]
    tilt = np.arccos(seen[0] @ seen[1])
    assert float(cone.value(joints)) == pytest.approx(tilt)
    assert float(cone.margin(joints)) == pytest.approx(np.radians(75) - tilt)


def test_strokes_are_of_the_printed_input_and_in_its_file_s_order():
    mechanism = assur.load(DELTA)
    names = [limit.name for limit in limits(mechanism, mechanism.home_values)]
    assert names[:3] == [f"stroke of {item.name}" for item in mechanism.inputs]


def test_whole_turns_do_not_matter_at_the_start_and_do_matter_later():
    record = load_record("fivebar")
    joint = dataclasses.replace(record.joints["B1"], limits=((np.radians(100), np.radians(260)),))
    record = dataclasses.replace(record, joints={**record.joints, "B1": joint})
    start = np.array([0.0, 0.0, np.radians(-170), 0.0, 0.0])  # the same as 190 deg
    (limit,) = limits(record, start)
    assert (limit.name, float(limit.value(start))) == ("limit of B1", pytest.approx(np.radians(190)))
    further = start + np.array([0.0, 0.0, np.radians(80), 0.0, 0.0])
    assert float(limit.margin(further)) == pytest.approx(np.radians(-10))
