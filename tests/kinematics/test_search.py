"""Search on the joint graph: what it finds, and what it counts as one."""

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import assemble, closure_error
from assur.kinematics.configurations import distinct
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.search import AGAIN, MOST, STARTS, search
from assur.kinematics.starts import by_chance
from assur.kinematics.status import Status
from assur.kinematics.turns import with_turns_of_home
from assur.model.registry import names

DELTA = Path(__file__).parents[1] / "model" / "file" / "delta.toml"
TABLE_1 = np.array([162.6907, -143.3209, -24.6776])


def test_the_four_poses_of_the_paper_are_among_the_assemblies_of_the_joint_graph():
    paper = assur.load("zeng2019")
    claimed, found = paper.direct(TABLE_1), paper.direct(TABLE_1, method="search", crossed=True)
    assert not found.complete
    assert "not proved" in found.right
    assert np.max(found.residuals) < 1e-8
    for pose in claimed.poses[claimed.exists]:
        assert np.min(np.linalg.norm(found.poses - pose, axis=-1)) < 1e-7
    assert len(found) > len(claimed)  # crossed parallelograms
    parallel = paper.direct(TABLE_1, method="search")
    left_out = len(found) - len(claimed)
    assert (len(parallel), parallel.complete_for, found.complete_for) == (len(claimed), "reduced", "joint_graph")
    assert f"; {left_out} with crossed parallelograms were left out" in parallel.right
    assert left_out == sum("~" in solution.mode for solution in found)


def test_where_a_parallelogram_is_crossed_at_home_none_is_left_out(monkeypatch):
    """The file is then another mechanism, whose platform turns: its own check would say so first."""
    monkeypatch.setattr("assur.kinematics.assemblies.check", lambda _: None)
    paper = assur.load("zeng2019")
    found = paper.direct(TABLE_1, method="search", crossed=True)
    crossed = next(k for k, label in enumerate(found.labels) if "~" in label)
    other = dataclasses.replace(paper, closed_form=None, home=found.joints[crossed])
    again = other.direct(TABLE_1, method="search")
    assert (again.complete_for, "left out" in again.right) == ("joint_graph", False)
    assert any("~" in label for label in again.labels)


def test_assemblies_of_one_sign_text_get_letters():
    found = assur.load("zeng2019").direct(TABLE_1, method="search", crossed=True)
    labels = [solution.mode for solution in found]
    assert len(set(labels)) == len(labels)
    assert {re.split("[a-z~]", label)[0] for label in labels} == {"+++", "++-", "--+", "---"}
    one = assur.load("zeng2019").direct(TABLE_1, mode=labels[3], method="search", crossed=True)
    assert [solution.mode for solution in one] == [labels[3]]


def test_a_mechanism_without_closed_form_has_direct_and_inverse_solutions():
    delta = assur.load(DELTA)
    home = delta.home_values
    inputs = [item.sign * home[item.coordinate.index] + item.offset for item in delta.inputs]
    found = delta.direct(inputs)
    assert len(found) >= 2
    assert np.max(closure_error(delta, found.joints)) < 1e-9 * 1000
    back = delta.inverse(found.poses[0])
    assert np.min(np.linalg.norm(back.inputs - inputs, axis=-1)) < 1e-7


def test_a_rod_that_spins_about_its_ball_joints_does_not_make_another_assembly():
    delta = assur.load("delta_4s")
    home, null = delta.home_values, instantaneous(delta, delta.home_values)
    assert int(null.ranks.internal) == 6
    spun = home + 0.3 * _spin(delta)
    turned = assemble(delta, spun, poses=pose_of(delta, home))
    other = home.copy()
    other[delta.input_indices[0]] += 1e-3
    assert np.max(np.abs(turned.values - home)) > 0.1
    assert distinct(delta, np.array([home, turned.values, other])).tolist() == [0, 2]


def _spin(mechanism):
    """A motion of passive joints (n,) that moves neither inputs nor platform, by home's null space."""
    motion = instantaneous(mechanism, mechanism.home_values).motion
    moves = np.concatenate([motion.inputs, motion.twists])
    _, _, rows = np.linalg.svd(moves)
    still = rows[np.linalg.matrix_rank(moves, tol=1e-7) :]
    spins = motion.null @ still.T
    return (motion.scale[:, None] * spins)[:, np.argmax(np.linalg.norm(spins, axis=0))]


def test_nothing_found_is_undecided_and_says_how_near_it_came():
    paper = assur.load("zeng2019")
    found = paper.direct([5000.0, 0.0, 0.0], method="search")
    assert len(found) == 0
    assert found.overall_status == Status.undecided
    assert found.failures[0].value < -1000.0


def test_a_few_hundred_starts_meet_the_sixteen_assemblies_of_a_delta_robot_again_and_again():
    delta = assur.load("delta_4s")
    first, second = (search(delta, "direct", np.zeros(3), seed) for seed in (0, 1))
    for each in (first, second):
        assert (len(each.joints), each.settled) == (16, True)
        assert each.last_new + AGAIN * 16 <= each.starts <= 3 * STARTS
    assert len(distinct(delta, np.concatenate([first.joints, second.joints]))) == 16


@pytest.mark.deep
@pytest.mark.parametrize("problem", ["direct", "inverse"])
@pytest.mark.parametrize("name", names())
def test_what_starts_by_chance_lead_to_a_search_meets(name, problem):
    """Three times as many as it ever takes, none of which knows any assembly."""
    mechanism = assur.load(name)
    home, rng = mechanism.home_values, np.random.default_rng(1)
    given = inputs_of(mechanism, home) if problem == "direct" else pose_of(mechanism, home)
    held = mechanism.input_indices if problem == "direct" else ()
    start = by_chance(mechanism, 3 * MOST, rng)
    if problem == "direct":
        start[:, held] = home[list(held)]
    closed = assemble(mechanism, start, held=held, poses=None if held else given, far=True)
    met = search(mechanism, problem, given)
    counted, same = with_turns_of_home(mechanism, closed.values[closed.closed], held)
    everything = distinct(mechanism, np.concatenate([met.joints, counted[same]]))
    missed = everything[everything >= len(met.joints)]
    assert not len(missed) or not met.settled, f"{len(missed)} beside {len(met.joints)}"


def test_the_same_seed_finds_the_same():
    record = assur.load("fivebar")
    given = np.radians([120.0, 60.0])
    first, second = search(record, "direct", given), search(record, "direct", given)
    np.testing.assert_array_equal(first.joints, second.joints)


def test_misuse_is_refused():
    paper = assur.load("zeng2019")
    with pytest.raises(UnknownNameError, match="guess"):
        paper.direct(TABLE_1, method="guess")
    with pytest.raises(UnknownNameError, match="assembly mode"):
        paper.direct(TABLE_1, mode="+-", method="search")
    with pytest.raises(UsageError, match="no closed form of the direct problem"):
        assur.load(DELTA).direct([0.0, 0.0, 0.0], method="closed form")


@pytest.mark.deep
def test_dietmaiers_forty_postures_are_met():
    """One of them is nearly double: starts come to it along a curved valley, by steps that are hardly damped."""
    lengths = np.array([1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071])
    assert len(search(assur.load("gough_stewart"), "direct", lengths).joints) == 40
