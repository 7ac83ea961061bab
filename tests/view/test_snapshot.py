"""How a change moves what is shown: every number against another route."""

import re

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.following.locked import general_ranks
from assur.view import snapshot
from assur.view.dials import dials, read
from assur.view.dials import inputs as input_dials
from assur.view.snapshot import start, to_inputs, to_poses, with_dial, with_input, with_parameter, with_values

WITH_SIGNS = ("fivebar", "zeng2019", "delta_4s", "tripteron", "three_upu", "orthoglide")


@pytest.fixture(scope="module")
def bar():
    return start(assur.load("fivebar"))


@pytest.mark.parametrize("name", WITH_SIGNS)
def test_an_input_moved_is_where_the_closed_form_has_it(name):
    before = start(assur.load(name))
    dial = input_dials(before.record)[0]
    aim = before.inputs
    aim[0] += 0.01 * (dial.high - dial.low)
    after = with_input(before, 0, float(aim[0]))
    assert after.reason is None
    assert after.inputs == pytest.approx(aim, abs=1e-9)
    assert after.modes == before.modes
    found = before.record.direct(aim)
    gaps = np.linalg.norm(found.poses[found.exists] - after.pose, axis=-1)
    assert np.min(gaps) < 1e-9 * characteristic_length(before.record)


@pytest.mark.parametrize("name", [*WITH_SIGNS, "planar_3rpr", "three_rps"])
def test_the_platform_moved_is_where_it_was_asked_to_be(name):
    before = start(assur.load(name))
    dial = dials(before.record)[0]
    aim = before.pose
    aim[0] += 0.002 * (dial.high - dial.low)
    after = with_dial(before, 0, float(aim[0]))
    assert after.reason is None
    assert after.pose == pytest.approx(aim, abs=1e-9)
    assert after.modes == before.modes
    assert after.residual < 1e-9 * (dial.high - dial.low)


def test_an_orientation_by_quaternion_is_turned_by_angles():
    before = start(assur.load("gough_stewart"))
    names = [item.name for item in dials(before.record)]
    here = read(before.record, before.values)
    after = with_dial(before, names.index("phi"), float(here[3]) + 0.02)
    assert after.reason is None
    assert read(before.record, after.values) == pytest.approx(here + np.array([0, 0, 0, 0.02, 0, 0]), abs=1e-9)


def test_where_it_cannot_go_on_it_stops_at_the_border_and_says_why(bar):
    """Crank and rod are in line at sqrt(294^2 - 70^2); straight up both legs are."""
    straight = to_poses(bar, [0.0, bar.pose[1]])
    stopped = to_poses(straight, [0.0, 400.0])
    assert stopped.pose[1] == pytest.approx(np.sqrt(294.0**2 - 70.0**2), abs=1e-2)
    assert stopped.residual < 1e-9
    missing = np.hypot(400.0, 70.0) - 294.0
    assert str(stopped.reason) == (
        "serial singularity: A1, B1, P are collinear; A2, B2, P are collinear; "
        f"leg1 is {missing:.3g} mm too short, leg2 is {missing:.3g} mm too short"
    )


def test_from_there_it_comes_back_in_the_same_mode(bar):
    back = to_poses(to_poses(bar, [0.0, 400.0]), bar.pose)
    assert back.reason is None
    assert back.values == pytest.approx(bar.values, abs=1e-6)


def test_a_stroke_is_kept():
    """The file of the 3-RPS gives its legs strokes."""
    before = start(assur.load("three_rps"))
    stroke = before.record.inputs[0].stroke
    after = with_input(before, 0, stroke[1] + 10.0)
    assert after.reason.kind == "limit"
    assert after.inputs[0] == pytest.approx(stroke[1], abs=1e-2)
    assert str(after.reason) == f"stroke of {before.record.inputs[0].name} ends at {stroke[1]:g} mm"


def test_nothing_asked_nothing_moved(bar):
    assert np.array_equal(to_inputs(bar, bar.inputs).values, bar.values)


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "planar_3rrr"])
def test_a_dimension_changes_and_the_inputs_stay(name):
    before = start(assur.load(name))
    parameter = next(item for item in before.record.parameters.values() if item.unit == before.record.unit)
    after = with_parameter(before, parameter.name, 1.01 * parameter.value)
    assert after.reason is None
    assert after.record.parameters[parameter.name].value == 1.01 * parameter.value
    assert after.residual < 1e-9 * abs(parameter.value)
    assert after.modes == before.modes
    assert after.inputs == pytest.approx(before.inputs, abs=1e-9)


def test_a_dimension_at_which_the_branch_ends_keeps_the_pose_instead():
    """With the inputs held the 3-RPR's assembly merges with another at d3 = 28.1; no other one is jumped to."""
    before = start(assur.load("planar_3rpr"))
    after = with_parameter(before, "d3", 33.344)
    assert after.reason is None
    assert after.pose == pytest.approx(before.pose, abs=1e-9)
    assert np.max(np.abs(after.inputs - before.inputs)) > 0.1


def test_what_is_known_of_a_branch_is_kept_along_it_and_not_beyond(bar, monkeypatch):
    asked = []
    known = general_ranks(bar.record, bar.values)
    monkeypatch.setattr(snapshot, "general_ranks", lambda *given: asked.append(given) or known)
    moved = with_dial(with_input(bar, 0, 2.0), 0, 5.0)
    assert len(asked) == 1
    with_input(with_values(moved, moved.values), 0, 2.0)
    with_input(with_parameter(moved, "l1", 101.0), 0, 2.0)
    assert len(asked) == 3
    assert moved.values == pytest.approx(moved.record.follow(moved.values, poses=moved.pose).joints[-1], abs=1e-9)


def test_a_dimension_with_which_nothing_closes_is_not_taken(bar):
    after = with_parameter(bar, "l2", 20.0)
    assert after.reason.kind == "dimension"
    knees = np.linalg.norm(bar.record.point("B1", bar.values) - bar.record.point("B2", bar.values)) / 2
    reach = np.hypot(bar.pose[0] + 70.0, bar.pose[1]) - 100.0
    said = re.fullmatch(
        r"l2 = 20 leaves the mode: with the inputs held it ends at (\S+) \(parallel singularity\), "
        r"with the pose held it ends at (\S+) \(serial singularity\)",
        str(after.reason),
    )
    assert [float(item) for item in said.groups()] == pytest.approx([knees, reach], abs=0.1)
    assert after.record is bar.record
    assert np.array_equal(after.values, bar.values)


def test_a_dimension_that_there_is_not_is_said(bar):
    assert "unknown parameter of fivebar 'l9'" in str(with_parameter(bar, "l9", 5.0).reason)


def test_other_joint_values_are_an_assembly_or_refused(bar):
    other = bar.record.direct(bar.inputs, "-").joints[0]
    assert with_values(bar, other).modes[1] == "-"
    with pytest.raises(UsageError, match="no assembly, a gap of"):
        with_values(bar, np.zeros(5) + 0.3)
    with pytest.raises(UsageError, match="5 joint values"):
        with_values(bar, [1.0, 2.0])
    with pytest.raises(UsageError, match="finite"):
        with_values(bar, [np.nan] * 5)


def test_what_it_cannot_read_it_says(bar):
    turned = to_poses(start(assur.load("three_rps")), [280.0, 2.0, 0.0])
    assert str(turned.reason) == "pose of three_rps: theta is between -90 and 90 deg"
    assert to_inputs(bar, [np.nan, 1.0]).reason.kind == "input"
