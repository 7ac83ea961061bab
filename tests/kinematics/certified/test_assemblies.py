import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.certified import assemblies
from assur.kinematics.certified.assemblies import certified_assemblies
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.result import answer
from assur.kinematics.pose import pose_of
from assur.numerics import rotations
from assur.numerics.intervals.interval import Interval


def holds(found, floats, problem):
    asked = floats.poses if problem == "direct" else floats.inputs
    rows = asked[floats.exists]
    bounds = [item.pose if problem == "direct" else item.inputs for item in found]
    return len(rows) == len(bounds) and all(
        any(np.all((item.low - 1e-6 <= row) & (row <= item.high + 1e-6)) for item in bounds) for row in rows
    )


@pytest.mark.parametrize("name", ["fivebar", "planar_3rpr", "planar_3rrr", "three_rps", "three_upu"])
def test_assemblies_without_redundant_constraints_are_proved(name):
    record = assur.load(name)
    inputs, pose = inputs_of(record, record.home_values), pose_of(record, record.home_values)
    inputs = inputs * np.linspace(1.01, 1.03, len(inputs))
    for problem, given, floats in (
        ("direct", inputs, record.direct(inputs)),
        ("inverse", pose, record.inverse(pose)),
    ):
        found = certified_assemblies(record, problem, given)
        assert holds(found, floats, problem)
        assert all("dependent ones" not in item.how and item.left == 0 for item in found)
        assert "dependent" not in found.headline
        assert not found.proved  # that there are no others is not


def test_bounds_agree_with_those_of_the_closed_form():
    record = assur.load("planar_3rrr")
    inputs = np.add(inputs_of(record, record.home_values), [0.1, -0.05, 0.02])
    one, other = certified_direct(record, inputs), certified_direct(record, inputs, "joint graph")
    assert len(one) == len(other) == 2
    for item in one:
        held = [np.all((item.pose.low <= own.pose.high) & (own.pose.low <= item.pose.high)) for own in other]
        assert sum(held) == 1


def test_an_overconstrained_mechanism_says_what_is_not_proved():
    record = assur.load("zeng2019")
    found = certified_direct(record, [162.6907, -143.3209, -24.6776], "joint graph")
    assert len(found) == 4
    assert all("14 independent equations" in item.how and "6 dependent ones hold to" in item.how for item in found)
    assert not found.proved
    assert "4 solutions of the independent equations proved (the dependent ones hold to " in found.headline
    assert found.right.startswith("a zero of the independent equations is proved")
    assert all(0 < item.left < 1e-8 for item in found)
    assert [item.left for item in answer(found).solutions] == [item.left for item in found]


def test_a_mechanism_without_a_closed_form_is_proved_on_its_joint_graph(tmp_path):
    own = assur.load("fivebar")
    path = tmp_path / "alone.toml"
    path.write_text(own.file.read_text())
    record = assur.load(path)
    assert record.closed_form is None
    given = np.radians([127.0, 53.0])
    found = certified_direct(record, given)
    assert holds(found, own.direct(given), "direct")
    assert "not proved" in found.headline or "is not" in found.headline
    pose = own.direct(given).poses[own.direct(given).exists][0]
    assert holds(certified_inverse(record, pose), own.inverse(pose), "inverse")


def test_rods_that_spin_are_held(balls):
    """A Delta robot with a ball at both ends of each rod: the same two platforms as its closed form proves."""
    given = np.add(inputs_of(balls, balls.home_values), [0.01, 0.02, 0.03])
    found = certified_direct(balls, given, "joint graph")
    assert len(found) == 2
    assert not found.undecided
    assert all("6 rods held that may spin" in item.how and item.left == 0 for item in found)
    assert holds(found, balls.direct(given), "direct")


@pytest.mark.parametrize(("name", "count"), [("linear_delta_4s", 2), ("h4_robot", 4)])
def test_rods_on_balls_are_proved_where_the_closed_form_proves_them(name, count):
    """All unknown joints of a linear Delta robot are balls: its two platforms alone tell its assemblies apart."""
    record = assur.load(name)
    given = inputs_of(record, record.home_values) * np.linspace(1.01, 1.03, len(record.inputs))
    one, other = certified_direct(record, given), certified_direct(record, given, "joint graph")
    assert len(one) == len(other) == count
    for item in one:
        held = [np.all((item.pose.low <= own.pose.high) & (own.pose.low <= item.pose.high)) for own in other]
        assert sum(held) == 1


def test_an_assembly_at_a_singularity_is_undecided():
    record = assur.load("fivebar", l2=150)
    # rods in one line: 2 l2 = 2 g - 2 l1 cos(q1), with q2 = pi - q1
    cosine = (record.values.g - record.values.l2) / record.values.l1
    given = np.array([np.arccos(cosine), np.pi - np.arccos(cosine)])
    found = certified_assemblies(record, "direct", given)
    assert len(found) == 0
    assert found.undecided


def test_a_containment_test_that_is_reversed_is_noticed(monkeypatch):
    record = assur.load("planar_3rpr")
    given = inputs_of(record, record.home_values) * 1.01
    within = Interval.within
    monkeypatch.setattr(Interval, "within", lambda one, other: within(other, one))
    assert not holds(certified_assemblies(record, "direct", given), record.direct(given), "direct")


def test_an_assembly_that_was_found_twice_is_not_proved_twice(monkeypatch):
    """Two float answers so near each other that both proofs may be of one assembly: only one counts."""
    record = assur.load("fivebar")
    given = np.radians([127.0, 53.0])
    monkeypatch.setattr(assemblies, "distinct", lambda *_: np.array([0, 0, 1]))
    found = certified_assemblies(record, "direct", given, "loops")
    assert len(found) == 2
    assert [item.meaning for item in found.undecided] == ["one assembly or two"]


def with_turned_frame(record, link, turn):
    """The same mechanism with the frame of one link turned, so that its joints have constant rotations."""

    def joint(item):
        if item.child == link:
            item = dataclasses.replace(item, child_at=turn @ item.child_at, turn=item.turn @ turn.T)
        if item.parent == link:
            item = dataclasses.replace(item, at=turn @ item.at, axes=item.axes @ turn.T, turn=turn @ item.turn)
        return item

    return dataclasses.replace(record, joints={name: joint(item) for name, item in record.joints.items()})


@pytest.mark.parametrize(("vector", "in_plane"), [((0.0, 0.0, 0.7), True), ((0.3, -0.2, 0.5), False)])
def test_turned_joints_make_no_other_mechanism(vector, in_plane):
    """In the plane the proof is whole; a tilted frame is one in floats only, and the answer says what is left."""
    record, given = assur.load("fivebar"), np.radians([127.0, 53.0])
    turned = with_turned_frame(record, "crank1", rotations.from_vector(np.array(vector)))
    one, other = (certified_assemblies(item, "direct", given, "loops") for item in (record, turned))
    assert len(one) == len(other) == 2
    for own, item in zip(one, other, strict=True):
        assert np.all((own.pose.low <= item.pose.high) & (item.pose.low <= own.pose.high))
        assert (item.left == 0) is in_plane
        assert item.left < 1e-9
    assert ("independent equations" in other.headline) is not in_plane
