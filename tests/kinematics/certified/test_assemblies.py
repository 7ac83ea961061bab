from __future__ import annotations

import numpy as np
import pytest

import assur
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.assemblies import certified_assemblies
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.pose import pose_of
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
        assert all("dependent ones" not in item.how for item in found)
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


@pytest.mark.slow
def test_rods_that_spin_are_undecided(balls):
    given = inputs_of(balls, balls.home_values)
    found = certified_direct(balls, given)
    assert len(found) == 0
    assert found.undecided
    assert "turn about themselves" in found.undecided[0].meaning


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
