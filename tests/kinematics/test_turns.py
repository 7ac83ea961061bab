"""Screws: whole turns are never wrapped nor forgotten. Each expected number is worked out from the pitches."""

import numpy as np
import pytest

from assur.joint_graph.tree import joint_graph
from assur.joint_graph.turns import turn_relations
from assur.joints.spherical import SPHERICAL
from assur.kinematics.answers.excess import excesses
from assur.kinematics.configurations import places
from assur.kinematics.following.following import follow
from assur.kinematics.home import home_values
from assur.kinematics.limits import limits
from assur.kinematics.pose import pose_of
from assur.kinematics.postures import unwound
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.search import search
from assur.kinematics.turns import (
    counted,
    in_one_turn,
    lasting_relations,
    periodic,
    told_by_turns,
    unwrapped,
    with_turns_of_home,
)
from assur.model.dimensions import with_parameters
from assur.model.registry import load_record
from assur.numerics import rotations
from assur.workspace.region import workspace
from screw_mechanisms import DIFFERENTIAL, FIVEBAR, JACK, TRIPOD, loaded

TURN = 2 * np.pi


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("screws")


@pytest.fixture(scope="module")
def differential(folder):
    return loaded(folder, DIFFERENTIAL)


@pytest.fixture(scope="module")
def fivebar(folder):
    return loaded(folder, FIVEBAR)


@pytest.fixture(scope="module")
def tripod(folder):
    return loaded(folder, TRIPOD)


@pytest.mark.parametrize("degrees", [0.0, 30.0, 114.591559, -181.0, 360.0, 720.0, -3600.0, 36_000.0])
def test_two_screws_in_series_advance_by_the_difference_of_their_pitches(differential, degrees):
    found = differential.direct(np.radians([degrees]))
    assert found.poses[..., 0].round(9).tolist() == [round(8 * degrees / 360, 9)]
    assert (found.complete, [item.status.name for item in found]) == (True, ["regular"])
    searched = differential.direct(np.radians([degrees]), method="search")
    assert searched.poses[..., 0].round(9).tolist() == [round(8 * degrees / 360, 9)]


@pytest.mark.parametrize("height", [2.0, 12.0, -40.0, 500.0])
def test_their_inverse_gives_real_turns(differential, height):
    found = differential.inverse([height])
    assert np.degrees(found.inputs[..., 0]).round(6).tolist() == [round(360 * height / 8, 6)]
    assert [item.status.name for item in found] == ["regular"]


def in_order(rows):
    """Rows by their rounded numbers, so that the last digit decides no order."""
    return np.array(
        sorted(np.asarray(rows, dtype=float).tolist(), key=lambda row: [round(item, 6) + 0.0 for item in row])
    )


def elbows(first, second):
    """Where the two rods of 130 mm of the five-bar meet, their sliders being at x (mm): above and below."""
    half = 0.5 * (second - first)
    height = np.sqrt(130**2 - half**2)
    return in_order([[0.5 * (first + second), -height], [0.5 * (first + second), height]])


@pytest.mark.parametrize("turns", [(0, 0), (2, 0), (10, -10), (-6, 6), (-2.25, 7.5)])
def test_motors_turn_the_screws_of_a_five_bar(fivebar, turns):
    """Its first nut advances by -10 mm a turn of the shaft, its second by 5 mm."""
    found = fivebar.direct(TURN * np.array(turns))
    assert np.allclose(in_order(found.poses), elbows(-50 - 10 * turns[0], 50 + 5 * turns[1]), atol=1e-9)
    assert found.complete
    assert np.allclose(found.inputs, TURN * np.array(turns), atol=1e-9)


@pytest.mark.parametrize("pose", [(-30.0, 110.0), (70.0, 90.0), (0.0, -125.0)])
def test_the_inverse_of_the_five_bar_needs_many_turns(fivebar, pose):
    found = fivebar.inverse(pose)
    x, y = pose
    half = np.sqrt(130**2 - y**2)
    wanted = [((-50 - a) / 10, (b - 50) / 5) for a in (x - half, x + half) for b in (x - half, x + half)]
    assert np.allclose(in_order(found.inputs / TURN), in_order(wanted), atol=1e-9)


def test_following_from_home_ends_where_the_direct_problem_says(fivebar):
    path = follow(fivebar, fivebar.home_values, inputs=TURN * np.array([4.0, -3.0]))
    assert path.stopped is None
    assert np.allclose(path.inputs[-1], TURN * np.array([4.0, -3.0]))
    assert np.allclose(path.poses[-1], elbows(-90.0, 35.0)[1])
    assert not path.closed  # four turns away, though the shafts stand as before


def test_three_screws_lift_a_platform(tripod):
    """20 mm a turn of the nut against the shaft, whose motor turns the other way; home stands 160 mm over the nuts."""
    found = tripod.direct(-TURN * np.array([2.0, 2.0, 2.0]))
    assert np.min(np.max(np.abs(found.poses - [200.0, 0.0, 0.0]), axis=1)) < 1e-9
    back = tripod.inverse([360.0, 0.0, 0.0])
    assert np.min(np.max(np.abs(back.inputs + TURN * 10.0), axis=1)) < 1e-9


def test_a_nut_that_is_threaded_on_anew_is_no_assembly_of_this_mechanism(differential):
    home = home_values(differential)
    threaded = home + np.array([0.0, TURN, -3.0])
    assert float(differential.closure_error(threaded)) < 1e-9
    assert with_turns_of_home(differential, np.array([home, threaded]))[1].tolist() == [True, False]


def test_which_turns_count(differential, fivebar, folder):
    assert counted(differential).tolist() == [True, True, False]
    assert counted(fivebar)[:6].tolist() == [True, True, False, True, True, False]
    assert periodic(fivebar).tolist() == [False] * 6 + [True] * 3
    assert np.abs(turn_relations(fivebar))[:, :6].tolist() == [[1, 1, 0, 0, 0, 0], [0, 0, 0, 1, 1, 0]]
    bearing = loaded(
        folder, FIVEBAR, ('M1 = { name = "q1" }', 'S1 = { name = "q1" }'), ('name = "driven"', 'name = "driven2"')
    )
    assert counted(bearing)[:2].tolist() == [False, True]  # the bearing of a driven screw turns back into itself
    assert np.abs(turn_relations(bearing))[:, :2].tolist() == [[0, 0]]


def test_a_driven_shaft_tells_its_screw(fivebar):
    assert told_by_turns(fivebar, {0: 9.0}) == {1: pytest.approx(-9.0)}
    assert told_by_turns(fivebar, {2: 9.0}) == {}


def test_turns_of_screws_are_kept_and_those_of_revolutes_are_not(fivebar):
    values = np.full(9, 3 * TURN + 0.25)
    screws = np.array([True, True, False, True, True, False, False, False, False])
    turned = in_one_turn(fivebar, values)
    assert turned[screws].tolist() == values[screws].tolist()
    assert np.allclose(turned[6:], 0.25)
    assert np.allclose(unwound(fivebar, values, np.zeros(9)), turned)
    assert np.allclose(unwrapped(fivebar, values), turned)


def test_places_tell_turns_of_screws_apart(fivebar):
    home = fivebar.home_values
    for index, apart in ((0, True), (1, True), (6, False)):
        other = home.copy()
        other[index] += TURN
        here, there = places(fivebar, np.array([home, other]))
        assert bool(np.max(np.abs(here - there)) > 1e-5) is apart


def test_limits_of_screws_count_turns_and_those_of_revolutes_do_not(folder):
    text = FIVEBAR.replace("pitch = 10 }", "pitch = 10, limits = [-1000, 1000] }").replace(
        'child = "rod1", at = [-50, 0, 0], axis = "z" }',
        'child = "rod1", at = [-50, 0, 0], axis = "z", limits = [300, 450] }',
    )
    record = loaded(folder, text, ('name = "driven"', 'name = "bounded"'))
    found = record.direct(TURN * np.array([-3.0, 0.0]))
    by = [[(item.joint, round(np.degrees(item.by), 6)) for item in solution.excesses] for solution in found]
    upper = int(np.argmax(found.poses[:, 1]))
    assert by[upper] == [("S1", 80.0)]  # 1080 deg where 1000 are allowed; 67.38 + 360 deg lies within 300 .. 450
    assert next(limit.high for limit in limits(record, record.home_values)) == pytest.approx(np.radians(1000))
    assert excesses(record, "direct", found.given, record.home_values) == ()


def test_a_search_on_turns_gives_what_the_loops_give(fivebar):
    given = TURN * np.array([2.5, -4.0])
    loops = fivebar.direct(given, method="loops").joints
    found = search(fivebar, "direct", given).joints
    assert np.allclose(in_order(loops), in_order(found), atol=1e-8)


@pytest.fixture(scope="module")
def jack(folder):
    return loaded(folder, JACK)


@pytest.mark.parametrize("turns", [0.25, -3.0, 12.4])
def test_turns_count_where_hinges_across_the_screw_keep_its_nut_from_turning(jack, turns):
    """The beam as at home, and turned over so that its hinge B is as far under the nut's as it was above it."""
    found = jack.direct([TURN * turns])
    over = -2 * np.arctan2(30, -100)
    heights = [-8 * turns, -8 * turns - 40 * np.sin(over)]
    assert np.allclose(np.sort(found.poses[:, 0]), np.sort(heights), atol=1e-8)
    back = jack.inverse([-8 * turns])
    assert np.min(np.abs(back.inputs[:, 0] - TURN * turns)) < 1e-8
    assert len(back) == 2


def test_a_sum_that_no_motion_changes_is_told_by_assemblies_around_home(jack, fivebar):
    assert turn_relations(jack).shape == (0, 5)
    assert lasting_relations(jack).tolist() == [[1, 1, 0, 0, 0]]
    assert len(lasting_relations(fivebar)) == len(turn_relations(fivebar))


def test_a_stroke_of_a_shaft_is_reached_once(jack):
    """Over a quarter of a turn the nut moves by a quarter of the lead."""
    region = workspace(jack, box={"z": (-10.0, 10.0)}, strokes={"q": (0.0, TURN / 4)})
    assert region.volume == pytest.approx(2.0, rel=0.05)


@pytest.mark.parametrize("lead", [80.0, 8.0, 0.05, 1e-3])
def test_a_fine_thread_is_no_singularity(folder, lead):
    """Where the velocity ratio is the lead everywhere, nothing that is said of singular and regular depends on it."""
    found = with_parameters(loaded(folder, JACK), lead=lead).direct([2.5])
    assert {item.status.name for item in found} == {"regular"}


@pytest.mark.parametrize("length", [0.0, 1.0, np.pi - 1e-9, np.pi + 1e-9, 2 * np.pi, 5 * np.pi, 10 * np.pi])
def test_rotation_vectors_are_those_of_the_same_rotation_at_most_half_a_turn_long(length):
    record = load_record("delta_4s")
    place = next(joint_graph(record).slices[name] for name, joint in record.joints.items() if joint.type is SPHERICAL)
    joints = np.zeros(len(record.coordinates))
    joints[place] = length * np.array([2.0, -1.0, 2.0]) / 3.0
    short = in_one_turn(record, joints)[place]
    assert np.allclose(rotations.from_vector(short), rotations.from_vector(joints[place]), rtol=0, atol=1e-14)
    assert np.linalg.norm(short) <= np.pi + 1e-12


def test_a_ball_joint_that_made_whole_turns_is_no_constraint_singularity():
    """Its rates are singular at a rotation vector of length 2 pi, which says nothing about the mechanism."""
    record = load_record("three_rps")
    slices = joint_graph(record).slices
    balls = [slices[name] for name, joint in record.joints.items() if joint.type is SPHERICAL]
    turned = home_values(record).copy()
    for place in balls:
        vector = turned[place]
        size = np.linalg.norm(vector)
        turned[place] = 2 * np.pi * np.array([0.0, 0.0, 1.0]) if size < 1e-9 else vector * (1 + 2 * np.pi / size)
    found = search(record, "inverse", pose_of(record, home_values(record)))
    assert np.max([np.linalg.norm(found.joints[:, place], axis=-1) for place in balls]) <= np.pi + 1e-12
    here = instantaneous(record, in_one_turn(record, turned))
    usual = instantaneous(record, home_values(record))
    assert float(here.measures["closure"]) == pytest.approx(float(usual.measures["closure"]), abs=1e-9)
    assert not any(here.types.values())
