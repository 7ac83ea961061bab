"""Certified answers held against what is known, and against the answers in floats of every mechanism."""

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.pose import pose_of
from assur.model.registry import names
from assur.numerics.intervals.interval import Interval
from catalogue import each

TABLE_1 = [162.6907, -143.3209, -24.6776]
POSES = [[-15.4714, 9.6849, 456.3315], [-15.4714, 9.6849, -396.3315], [-83.0873, 9.6849, 118.2099]]
"""Rows 3, 2 and 4 of Table 1 of Zeng et al. 2019, to its digits."""
CLOSED = [name for name in names() if assur.load(name).closed_form is not None]


def near_home(record, seed):
    """Inputs a little off home, and the pose that belongs to other such inputs."""
    rng = np.random.default_rng(seed)
    home = record.home_values
    sizes = [1.0 if item.coordinate.kind == "angle" else characteristic_length(record) for item in record.inputs]
    inputs = inputs_of(record, home) + 0.02 * np.array(sizes) * rng.standard_normal(len(sizes))
    return inputs, pose_of(record, home)


def agrees(found, floats, problem):
    """Whether the proved solutions are those of the float answer, each within rounding of its bounds."""
    asked = floats.poses if problem == "direct" else floats.inputs
    rows = asked[floats.exists]
    bounds = [item.pose if problem == "direct" else item.inputs for item in found]
    if len(rows) != len(bounds):
        return False
    scale = 1e-7 * (1 + np.abs(rows))
    return all(
        any(np.all((item.low - off <= row) & (row <= item.high + off)) for item in bounds)
        for row, off in zip(rows, scale, strict=True)
    )


@pytest.fixture(scope="module")
def paper():
    return assur.load("zeng2019")


@pytest.mark.parametrize("way", ["closed form", "boxes"])
def test_the_four_poses_of_the_paper_are_proved_and_that_there_is_no_fifth(paper, way):
    found = certified_direct(paper, TABLE_1, way)
    assert found.proved
    assert len(found) == 4
    for pose in POSES:
        held = [np.all(np.abs(item.pose.middle - pose) < 1e-4) for item in found]
        assert sum(held) == 1
    assert max(item.width for item in found) < 1e-10
    assert {item.mode for item in found} == {"+++", "++-", "--+", "---"}


def test_both_ways_enclose_the_same_poses(paper):
    one, other = (certified_direct(paper, TABLE_1, way) for way in ("closed form", "boxes"))
    other = {item.mode: item for item in other}
    for item in one:
        same = other[item.mode]
        assert item.working_mode == same.working_mode
        assert np.all((item.pose.low <= same.pose.high) & (same.pose.low <= item.pose.high))


@pytest.mark.parametrize("way", ["closed form", "boxes"])
def test_inputs_out_of_reach_are_proved_to_have_none(paper, way):
    found = certified_direct(paper, [1000.0, -143.3209, -24.6776], way)
    assert found.proved
    assert (len(found), found.headline) == (0, "proved, no solution")


def test_singular_inputs_are_undecided(paper):
    """yA1 - l3 - yA2 = 2 l2: links 9, 10 and 11 are stretched, two poses meet."""
    l2, l3 = paper.parameters["l2"].value, paper.parameters["l3"].value
    found = certified_direct(paper, [l2 + l3 / 2, -l2 - l3 / 2, 0.0])
    assert not found.proved
    assert [(item.name, bool(item.low[0] <= 0 <= item.high[0])) for item in found.undecided] == [("w2", True)]


@pytest.mark.parametrize("way", ["closed form", "boxes"])
def test_a_self_motion_is_undecided(paper, way):
    l3 = paper.parameters["l3"].value
    given = [l3 / 2, -l3 / 2, 0.0]
    options = {} if way == "closed form" else {"way": way}
    found = certified_direct(paper, given, **options)
    assert not found.proved
    assert len(found) == 0
    if way == "closed form":
        assert [item.name for item in found.undecided] == ["B"]
        return
    (curve, *_) = paper.direct(given).curves
    for pose in curve.poses(9):
        assert any(np.all((item.low - 1e-6 <= pose) & (pose <= item.high + 1e-6)) for item in found.undecided)


def test_near_a_singularity_the_two_poses_are_still_told_apart(paper):
    l2, l3 = paper.parameters["l2"].value, paper.parameters["l3"].value
    found = certified_direct(paper, [l2 + l3 / 2 - 1e-6, -l2 - l3 / 2, 0.0])
    assert found.proved
    assert agrees(found, paper.direct([l2 + l3 / 2 - 1e-6, -l2 - l3 / 2, 0.0]), "direct")


SOLVED = [name for name in CLOSED if assur.load(name).closed_form.direct is not None]


@pytest.mark.parametrize("name", each(SOLVED, ("zeng2019", "planar_3rrr", "three_rps")))
def test_proved_directs_are_those_found_in_floats(name):
    record = assur.load(name)
    inputs, _ = near_home(record, 1)
    found, floats = certified_direct(record, inputs), record.direct(inputs)
    assert found.proved
    assert agrees(found, floats, "direct")
    assert all(np.all(np.abs(item.pose.width) < 1e-7) for item in found)


@pytest.mark.parametrize("name", CLOSED)
def test_proved_inverses_are_those_found_in_floats(name):
    record = assur.load(name)
    _, pose = near_home(record, 1)
    found, floats = certified_inverse(record, pose), record.inverse(pose)
    assert found.proved
    assert agrees(found, floats, "inverse")


@pytest.mark.parametrize("name", ["fivebar", "orthoglide", "planar_3rpr", "three_upu", "tripteron"])
def test_box_by_box_the_answer_is_the_same(name):
    record = assur.load(name)
    inputs, _ = near_home(record, 2)
    found, floats = certified_direct(record, inputs, "boxes"), record.direct(inputs)
    assert found.proved
    assert {tuple(item.pose.middle.round(6)) for item in found} == {
        tuple(pose) for pose in floats.poses[floats.exists].round(6)
    }


@pytest.mark.slow
def test_a_mechanism_without_a_closed_direct_problem_is_certified_box_by_box():
    record = assur.load("three_rrrp4r")
    inputs, _ = near_home(record, 1)
    found = certified_direct(record, inputs)
    assert found.proved
    assert agrees(found, record.direct(inputs), "direct")


def test_a_containment_test_that_is_reversed_is_noticed(monkeypatch, paper):
    within = Interval.within
    monkeypatch.setattr(Interval, "within", lambda one, other: within(other, one))
    found = certified_direct(paper, TABLE_1, "boxes")
    assert not (found.proved and agrees(found, paper.direct(TABLE_1), "direct"))


def test_a_sign_that_is_flipped_in_a_margin_is_noticed(monkeypatch, paper):
    monkeypatch.setattr(Interval, "negative", property(lambda own: (own.low > 0) & own.defined))
    found = certified_direct(paper, TABLE_1)
    assert not (found.proved and agrees(found, paper.direct(TABLE_1), "direct"))


def test_what_is_not_possible_is_refused(paper):
    with pytest.raises(UnknownNameError):
        certified_direct(paper, TABLE_1, "guess")
    with pytest.raises(UsageError, match="batch"):
        certified_direct(paper, [TABLE_1, TABLE_1])
    with pytest.raises(UsageError, match="only the direct"):
        certified_inverse(paper, POSES[0], "boxes")
    with pytest.raises(UsageError, match="finite"):
        certified_direct(paper, [np.nan, 0.0, 0.0])
    with pytest.raises(UsageError, match="no closed form"):
        certified_direct(assur.load("three_rrrp4r"), [0.1, 0.1, 0.1], "closed form")
    platform = assur.load("gough_stewart")
    inputs = inputs_of(platform, platform.home_values)
    with pytest.raises(UsageError, match="no box"):
        certified_direct(platform, inputs, "boxes")
