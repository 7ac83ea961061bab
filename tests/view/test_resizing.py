"""A dimension is followed: where a branch ends it ends, found by all solutions of the direct problem on both sides."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import assemble
from assur.kinematics.following.locked import general_ranks
from assur.kinematics.pose import pose_of
from assur.model.dimensions import with_parameters
from assur.view.resizing import TOLERANCE, resized


def _resized(name, parameter, value, held, values=None):
    record = assur.load(name)
    start = record.home_values if values is None else values
    return record, resized(record, start, parameter, value, held, general_ranks(record, start))


def _nearest(record, inputs, pose):
    found = record.direct(inputs)
    return np.min(np.linalg.norm(found.poses[found.exists] - pose, axis=-1)), int(found.exists.sum())


def test_where_two_assemblies_merge_the_inputs_cannot_stay():
    """Of the 3-RPR two of six assemblies are one a little further on, then none; a Newton step jumps to a third."""
    record, found = _resized("planar_3rpr", "d3", 33.344, "inputs")
    assert found.why == "parallel singularity"
    change = 33.344 - record.parameters["d3"].value
    inputs, pose = inputs_of(found.record, found.values), pose_of(found.record, found.values)
    assert inputs == pytest.approx(inputs_of(record, np.array(record.home_values)), abs=1e-9)
    here = _nearest(with_parameters(record, d3=found.reached), inputs, pose)
    beyond = _nearest(with_parameters(record, d3=found.reached + 10 * TOLERANCE * change), inputs, pose)
    assert here == (pytest.approx(0.0, abs=1e-6), 6)
    assert beyond[1] == 4
    assert beyond[0] > 1.0
    jumped = assemble(with_parameters(record, d3=33.344), np.array(record.home_values), held=record.input_indices)
    assert bool(jumped.closed)  # which is why it has to be followed


def test_with_the_pose_held_it_is_where_small_steps_lead():
    record, found = _resized("planar_3rpr", "d3", 33.344, "poses")
    values, pose = np.array(record.home_values), pose_of(record, np.array(record.home_values))
    for value in np.linspace(record.parameters["d3"].value, 33.344, 200)[1:]:
        step = assemble(with_parameters(record, d3=float(value)), values, poses=pose, near=True)
        assert bool(step.closed)
        values = step.values
    assert (found.why, found.reached) == ("", 33.344)
    assert found.values == pytest.approx(values, abs=1e-6)


def test_a_mechanism_without_named_signs_keeps_its_mode_too():
    """The legs of the Gough platform as lines of space: their determinant keeps its sign, and is nearly zero there."""
    record, found = _resized(
        "gough_stewart", "a2x", 1.3 * assur.load("gough_stewart").parameters["a2x"].value, "inputs"
    )
    assert found.why == "parallel singularity"
    before, after = _lines(record, np.array(record.home_values)), _lines(found.record, found.values)
    assert before * after > 0
    assert abs(after) < 0.05 * abs(before)


def _lines(record, values):
    """Determinant of the six legs' unit line coordinates, about the origin."""
    named = assur.load("gough_stewart", **dict(record.overrides))
    rows = []
    for k in range(1, 7):
        base, platform = (named.point(f"{letter}{k}", values) for letter in "AB")
        way = (platform - base) / np.linalg.norm(platform - base)
        rows.append([*way, *np.cross(base, way)])
    return np.linalg.det(np.array(rows))


def test_where_crank_and_rod_come_in_line_the_pose_cannot_stay():
    """Leg 1 of the five-bar reaches P as long as l1 + l2 is the distance of P from A1."""
    record, found = _resized("fivebar", "l1", 20.0, "poses")
    x, y = pose_of(record, np.array(record.home_values))
    shortest = np.hypot(x + record.parameters["g"].value, y) - record.parameters["l2"].value
    assert found.why == "serial singularity"
    assert shortest < found.reached < shortest + 100 * TOLERANCE * (record.parameters["l1"].value - 20.0)


def test_where_the_legs_lines_meet_in_one_point_it_ends_though_every_loop_goes_on_closing():
    """The 3-RPR with its pose held: the determinant of its three legs' lines is zero there, and changes its sign."""
    record, found = _resized("planar_3rpr", "c3", -19.8, "poses")
    pose = pose_of(record, np.array(record.home_values))
    reached, change = found.reached, -19.8 - record.parameters["c3"].value
    assert found.why == "parallel singularity"
    values = {}
    for share in (0.0, 20 * TOLERANCE):
        further = with_parameters(record, c3=reached + share * change)
        values[share] = assemble(further, found.values, poses=pose, near=True)
        assert bool(values[share].closed)
        values[share] = _meeting(further, values[share].values)
    home = _meeting(record, np.array(record.home_values))
    assert home * values[0.0] > 0 > home * values[20 * TOLERANCE]
    assert abs(values[0.0]) < 1e-2 * abs(home)


def _meeting(record, values):
    """Determinant of the lines A_k B_k of a plane 3-RPR."""
    named = assur.load("planar_3rpr", **dict(record.overrides))
    rows = []
    for k in (1, 2, 3):
        base, platform = (named.point(f"{letter}{k}", values)[:2] for letter in "AB")
        way = (platform - base) / np.linalg.norm(platform - base)
        rows.append([*way, base[0] * way[1] - base[1] * way[0]])
    return np.linalg.det(np.array(rows))


def test_a_stroke_ends_it():
    record = assur.load("three_rps")
    low, high = record.inputs[0].stroke
    ends = [_resized("three_rps", name, 3.0 * item.value, "poses")[1] for name, item in record.parameters.items()]
    stopped = [item for item in ends if item.why.startswith("stroke of ")]
    assert stopped
    for item in stopped:
        inputs = inputs_of(item.record, item.values)
        assert all(low - 1e-6 <= value <= high + 1e-6 for value in inputs)


def test_there_and_back_is_where_it_was():
    record, there = _resized("zeng2019", "d", 75.0, "inputs")
    home = np.array(record.home_values)
    ranks = general_ranks(there.record, there.values)
    back = resized(there.record, there.values, "d", record.parameters["d"].value, "inputs", ranks)
    assert (there.why, back.why) == ("", "")
    assert np.max(np.abs(there.values - home)) > 1e-2
    assert back.values == pytest.approx(home, abs=1e-8)


def test_it_does_not_begin_at_a_singularity():
    """P straight above, both legs of the five-bar stretched."""
    record = assur.load("fivebar")
    ranks = general_ranks(record, record.home_values)
    top = record.inverse([0.0, np.sqrt(294.0**2 - 70.0**2) - 1e-13]).joints[0]
    found = resized(record, top, "l1", 101.0, "inputs", ranks)
    assert (found.why, found.reached) == ("serial singularity", 100.0)


def test_no_such_dimension_is_refused():
    with pytest.raises(Exception, match="unknown parameter"):
        _resized("fivebar", "l9", 3.0, "inputs")
    with pytest.raises(UsageError, match="cannot be -3"):
        _resized("fivebar", "l1", -3.0, "inputs")
