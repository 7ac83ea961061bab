"""A path is followed in its mode, agrees with the closed form all along, and stops before what would change it."""

import dataclasses
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.cli.main import main
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import point
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import assemble, closure_error
from assur.kinematics.following.following import follow
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.registry import load_record
from assur.singularity.examples import singular_examples
from work import calls

DELTA = Path(__file__).parents[2] / "model" / "file" / "delta.toml"
DOCS = Path(__file__).parents[3] / "docs" / "mechanism-file.md"


def turned(change):
    return (change + np.pi) % (2 * np.pi) - np.pi


def in_mode(mechanism, pose, mode):
    """Joint values of the closed form at a pose."""
    found = mechanism.inverse(pose, mode)
    assert bool(found.exists[0])
    return found.joints[0]


def agrees_with_the_closed_form(mechanism, path):
    """Every point in the working and the assembly mode of the start; both problems are asked."""
    working, assembly = path.modes[0]
    assert path.modes[1] == (working, assembly)
    inverse = mechanism.inverse(path.poses, working)
    direct = mechanism.direct(path.inputs, assembly)
    angular = np.array([item.coordinate.kind == "angle" for item in mechanism.inputs])
    change = inverse.inputs[:, 0] - path.inputs
    length = characteristic_length(mechanism)
    # the inverse problem magnifies an error by one over the smallest singular value, the direct one likewise
    serial, parallel = (1.0 / path.smallest[name] for name in ("poses", "inputs"))
    gap = np.max(np.abs(np.where(angular, turned(change), change / length)), axis=-1)
    moved = np.linalg.norm(direct.poses[:, 0] - path.poses, axis=-1) / length
    for found, error, near in ((inverse, gap, serial), (direct, moved, parallel)):
        there = found.exists[:, 0]
        assert np.all(there | (near > 1e3))  # at a border a rounding may be too much
        np.testing.assert_array_less(error[there], 1e-9 * near[there])
    np.testing.assert_array_less(closure_error(mechanism, path.joints), 1e-11 * length)


@pytest.mark.parametrize(
    ("name", "pose", "mode", "targets"),
    [
        ("fivebar", [0.0, 200.0], "-+", [[60.0, 220.0], [60.0, 150.0], [-40.0, 180.0], [0.0, 200.0]]),
        ("zeng2019", [-15.0, 10.0, 456.0], "++-++", [[10.0, 40.0, 440.0], [-20.0, 60.0, 450.0], [-15.0, 10.0, 456.0]]),
    ],
)
def test_a_round_trip_in_poses_agrees_all_along_and_returns_to_the_start(name, pose, mode, targets):
    mechanism = assur.load(name)
    path = follow(mechanism, in_mode(mechanism, pose, mode), poses=targets)
    assert path.stopped is None
    assert path.shares[0] == 0.0
    assert path.shares[-1] == 1.0
    assert np.all(np.diff(path.shares) > 0)
    agrees_with_the_closed_form(mechanism, path)
    for target in targets:
        assert np.min(np.linalg.norm(path.poses - target, axis=-1)) < 1e-9 * characteristic_length(mechanism)
    assert np.max(np.abs(path.joints[-1] - path.joints[0])) < 1e-9 * characteristic_length(mechanism)
    assert path.closed
    assert not path.changed_assembly


def test_a_round_trip_in_inputs_goes_straight_in_inputs():
    mechanism = assur.load("zeng2019")
    start = mechanism.home_values
    first = inputs_of(mechanism, start)
    corners = [first + np.array([30.0, 10.0, 5.0]), first + np.array([0.0, 20.0, 15.0]), first]
    path = follow(mechanism, start, inputs=corners)
    assert path.stopped is None
    agrees_with_the_closed_form(mechanism, path)
    assert np.max(np.abs(path.joints[-1] - start)) < 1e-9 * characteristic_length(mechanism)
    on_first = path.inputs[: 1 + int(np.argmin(np.linalg.norm(path.inputs - corners[0], axis=-1)))]
    across = np.cross(on_first - first, [30.0, 10.0, 5.0])
    assert np.max(np.abs(across)) < 1e-9


@pytest.mark.parametrize("prescribed", ["poses", "inputs"])
@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_wherever_it_goes_it_stays_in_its_mode(name, prescribed):
    """Far random targets: most are not reached, and no point of any path is in another mode."""
    mechanism = assur.load(name)
    rng = np.random.default_rng(3)
    stops = []
    for _ in range(3):
        start = mechanism.home_values
        here = pose_of(mechanism, start) if prescribed == "poses" else inputs_of(mechanism, start)
        size = characteristic_length(mechanism) if prescribed == "poses" or name == "zeng2019" else 2.0
        path = follow(mechanism, start, **{prescribed: here + size * rng.normal(size=len(here))})
        agrees_with_the_closed_form(mechanism, path)
        stops.append(path.stopped)
    assert any(stop is not None for stop in stops)


@lru_cache
def examples(name):
    return {example.factor.name: example for example in singular_examples(assur.load(name))}


FACTORS = [
    *(("fivebar", factor) for factor in ("sin_rods", "arm1", "arm2")),
    *(("zeng2019", factor) for factor in ("w", "sin_alpha_minus_beta", "u1")),
    *(
        pytest.param("zeng2019", factor, marks=pytest.mark.deep)
        for factor in ("v", "u2", "u3", "sin_alpha", "sin_beta")
    ),
]


@pytest.mark.parametrize(("name", "factor"), FACTORS)
def test_a_straight_line_through_a_singularity_stops_before_it_and_names_it(name, factor):
    mechanism = assur.load(name)
    example = examples(name)[factor]
    # the first regular pose of the same mode from which the line leads through the example
    away = 15.0 * np.random.default_rng(1).normal(size=(40, len(example.pose)))
    there = mechanism.inverse(example.pose + away, example.mode)
    away = away[np.argmax(there.exists[:, 0] & (there.status[:, 0] == 0))]
    found = mechanism.inverse(example.pose + away, example.mode)
    assert found.status[0] == 0
    path = follow(mechanism, found.joints[0], poses=example.pose - 0.9 * away)
    stop = path.stopped
    assert stop is not None
    assert stop.kind == example.status.name
    assert stop.size < 1e-2
    assert stop.factor
    assert stop.share <= 1 / 1.9
    # constraint singularities that end no branch are met to within what tells the branches apart
    assert stop.share == pytest.approx(1 / 1.9, abs=1e-2 if stop.kind == "constraint" else 1e-6)
    np.testing.assert_allclose(stop.pose, path.poses[-1])
    serial = [item.name for item in mechanism.closed_form.factor_list if item.kind == "serial"]
    assert stop.turns_back == (example.factor.name in serial)
    assert str(stop) in str(path)


def test_a_mode_that_is_singular_everywhere_is_left_at_once():
    """In the paper's mode +++++ links 9 and 10 stay parallel: u1 = u2 at every pose."""
    mechanism = assur.load("zeng2019")
    example = examples("zeng2019")["u1_minus_u2"]
    path = follow(mechanism, example.joints, poses=example.pose + np.array([5.0, 5.0, 5.0]))
    assert path.stopped is not None
    assert (path.stopped.share, path.stopped.kind) == (0.0, "self_motion")
    assert path.stopped.factor == "u1_minus_u2"


def test_inputs_stop_before_a_parallel_singularity_where_the_rods_are_stretched():
    """|B1B2| = 2 l2 on a straight way of the cranks, by the closed form's own margin."""
    mechanism = assur.load("fivebar", l2=150)
    start = mechanism.home_values
    first, last = inputs_of(mechanism, start), np.radians([180.0, 0.0])
    path = follow(mechanism, start, inputs=last)
    stop = path.stopped
    assert stop is not None
    assert (stop.kind, stop.factor, stop.turns_back) == ("parallel", "sin_rods", True)

    def room(share):
        first_angle, second_angle = first + share * (last - first)
        gap = np.array([140 + 100 * (np.cos(second_angle) - np.cos(first_angle)),
                        100 * (np.sin(second_angle) - np.sin(first_angle))])  # fmt: skip
        return 300.0 - np.linalg.norm(gap)

    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if room(middle) > 0 else (low, middle)
    assert 0.0 <= low - stop.share < 1e-8
    assert stop.gap is not None
    assert stop.gap > 0.0  # there is no assembly behind, only a closest approach
    agrees_with_the_closed_form(mechanism, path)


def test_inputs_stop_before_the_parallel_singularity_w_of_the_paper():
    """B1 and B2 so far apart that links 9 and 10 lie along Y: the radicand l2^2 - B^2/4 of Eq. (8) ends there."""
    mechanism = assur.load("zeng2019")
    example = examples("zeng2019")["w"]
    start = in_mode(mechanism, example.pose + np.array([2.0, 3.0, 10.0]), example.mode)
    first = inputs_of(mechanism, start)
    path = follow(mechanism, start, inputs=first + 1.5 * (example.inputs - first))
    stop = path.stopped
    assert stop is not None
    assert (stop.kind, stop.factor, stop.turns_back) == ("parallel", "w", True)
    assert 0.0 <= 1 / 1.5 - stop.share < 1e-7
    agrees_with_the_closed_form(mechanism, path)


def test_a_path_that_stopped_can_be_gone_back():
    mechanism = assur.load("fivebar")
    start = in_mode(mechanism, [0.0, 200.0], "-+")
    there = follow(mechanism, start, poses=[20.0, 400.0])
    assert there.stopped is not None
    assert there.stopped.kind == "serial"
    back = follow(mechanism, there.joints[-1], poses=[0.0, 200.0])
    assert back.stopped is None
    np.testing.assert_allclose(back.joints[-1], start, atol=1e-9)


def test_the_joint_graph_alone_is_enough():
    """Without its closed form the five-bar stops at the same place, of the same kind, and names no factor."""
    mechanism = assur.load("fivebar")
    bare = dataclasses.replace(mechanism, closed_form=None)
    start = in_mode(mechanism, [0.0, 200.0], "-+")
    with_it, without = (follow(item, start, poses=[20.0, 400.0]).stopped for item in (mechanism, bare))
    assert with_it is not None
    assert without is not None
    assert (without.kind, without.share, without.factor, without.size) == (with_it.kind, with_it.share, "", None)


def test_delta_with_ball_joints_follows_a_square_and_returns(tmp_path):
    """Rods that spin freely do no harm; ball joints that are outside their cones at home stop the path."""
    tight = tmp_path / "tight.toml"
    tight.write_text(DELTA.read_text().replace("angle = 75", "angle = 40"))
    mechanism = assur.load(tight)
    start = mechanism.home_values
    here = pose_of(mechanism, start)
    stop = follow(mechanism, start, poses=here + np.array([5.0, 0.0, 0.0])).stopped
    assert stop is not None
    assert (stop.kind, stop.share) == ("limit", 0.0)
    assert "cone of leg" in stop.quantity
    assert stop.value < 0
    corners = here + np.array([[20.0, 0, 0], [20.0, 20.0, 0], [0, 20.0, -10.0], [0, 0, 0]])
    path = follow(mechanism, start, poses=corners, use_limits=False)
    assert path.stopped is None
    assert closure_error(mechanism, path.joints).max() < 1e-9
    assert np.max(np.abs(path.inputs[-1] - path.inputs[0])) < 1e-9
    assert np.max(np.abs(path.poses[-1] - here)) < 1e-9 * 250


def test_a_stroke_stops_the_path_just_inside():
    mechanism = assur.load("fivebar")
    stroke = (np.radians(100.0), np.radians(140.0))
    inputs = (dataclasses.replace(mechanism.inputs[0], stroke=stroke), *mechanism.inputs[1:])
    limited = dataclasses.replace(mechanism, inputs=inputs)
    start = in_mode(mechanism, [0.0, 200.0], "-+")
    start = start + np.array([2 * np.pi, 0, 0, 0, 0])  # the same assembly, counted from elsewhere
    path = follow(limited, start, poses=[80.0, 200.0])
    assert path.stopped is not None
    assert (path.stopped.kind, path.stopped.quantity) == ("limit", "the room to the stroke of theta1")
    assert 0.0 <= path.inputs[-1, 0] - 2 * np.pi - stroke[0] < 1e-8
    assert follow(limited, start, poses=[80.0, 200.0], use_limits=False).stopped is None


@pytest.fixture(scope="module")
def three_rrr(tmp_path_factory):
    """The 3-RRR of the documentation, with a base and a platform of nearly one size."""
    text = DOCS.read_text(encoding="utf-8").partition("```toml\n")[2].partition("```")[0]
    file = tmp_path_factory.mktemp("docs") / "planar3rrr.toml"
    file.write_text(text, encoding="utf-8")
    return assur.load(file, R=150, r=130)


def lines_determinant(mechanism, joints):
    """Determinant (N,) of the planar 3-RRR's Jp, the lines of the rods: (C - B, (C - O') x (C - B)) in each row."""
    platform = pose_of(mechanism, joints)[:, :2]
    rows = []
    for leg in ("leg1", "leg2", "leg3"):
        b, c = (point(mechanism, f"{leg}.{letter}", joints)[:, :2] for letter in "BC")
        rod, arm = c - b, c - platform
        rows.append(np.column_stack([rod, arm[:, 0] * rod[:, 1] - arm[:, 1] * rod[:, 0]]))
    return np.linalg.det(np.stack(rows, axis=1))


def test_a_loop_in_inputs_that_changes_the_assembly_without_a_singularity(three_rrr):
    """A cuspidal mechanism: two assemblies at the same inputs are joined by a path that crosses no singularity.

    The pose path between them gives a loop in inputs; going round it by inputs alone ends in the other assembly.
    """
    starts = np.random.default_rng(0).uniform(-np.pi, np.pi, (200, 9))
    at_pose = assemble(three_rrr, starts, poses=np.array([103.04, 79.32, -0.62]))
    rods = [three_rrr.joint_coordinates(f"leg{k}.B")[0].index for k in (1, 2, 3)]
    in_working_mode = at_pose.closed & np.all(np.sin(at_pose.values[:, rods]) * [-1, 1, 1] > 0, axis=1)
    first = at_pose.values[np.argmax(in_working_mode)]
    held = list(three_rrr.input_indices)
    starts[:, held] = first[held]
    found = assemble(three_rrr, starts, held=held)
    poses = pose_of(three_rrr, found.values[found.closed])
    other = poses[np.argmin(np.linalg.norm((poses - [61.6, 153.9, 0.456]) / [100, 100, 1], axis=-1))]
    there = follow(three_rrr, first, poses=other)
    assert there.stopped is None
    np.testing.assert_allclose(turned(there.inputs[-1] - there.inputs[0]), 0.0, atol=1e-9)
    loop = follow(three_rrr, first, inputs=there.inputs[1:], turns="given")
    assert loop.stopped is None
    assert loop.closed
    assert loop.changed_assembly
    assert "assembly change" in str(loop)
    np.testing.assert_allclose(loop.poses[-1], other, atol=1e-7)
    assert np.linalg.norm(loop.poses[-1] - loop.poses[0]) > 10.0
    determinant = lines_determinant(three_rrr, loop.joints)
    assert np.all(determinant > 0) or np.all(determinant < 0)


def test_angles_go_the_short_way_or_as_given():
    mechanism = assur.load("fivebar", l1=30)
    start = mechanism.home_values
    first = inputs_of(mechanism, start)
    almost = first + np.radians([350.0, 0.0])
    short = follow(mechanism, start, inputs=almost)
    given = follow(mechanism, start, inputs=almost, turns="given")
    assert short.stopped is None
    assert short.inputs[-1, 0] == pytest.approx(first[0] - np.radians(10.0))
    assert given.stopped is not None  # a whole turn of a crank meets its rod in line
    assert (given.stopped.kind, given.stopped.factor) == ("serial", "arm1")
    assert given.inputs[-1, 0] > first[0]


def test_nowhere_to_go_is_a_path_of_one_point():
    mechanism = assur.load("fivebar")
    path = follow(mechanism, mechanism.home_values, inputs=inputs_of(mechanism, mechanism.home_values))
    assert (len(path), path.stopped) == (1, None)


def test_a_start_in_a_singularity_of_the_inputs_is_left_along_poses():
    mechanism = assur.load("fivebar")
    example = singular_examples(mechanism)[0]
    assert example.factor.name == "sin_rods"
    path = follow(mechanism, example.joints, poses=example.pose + np.array([5.0, 5.0]))
    assert path.left == "parallel"
    assert path.stopped is None
    held = follow(mechanism, example.joints, inputs=inputs_of(mechanism, example.joints) + 0.1)
    assert held.stopped is not None
    assert held.stopped.share == 0.0
    assert held.stopped.kind in ("parallel", "self_motion")


RPR = """
format = 1
name = "rpr"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "plate", pose = ["x", "y", "phi"] }
[links]
base = {}
plate = {}
[limbs.leg]
repeat = { about = "z", count = 3 }
[limbs.leg.links]
tube = {}
rod = {}
[limbs.leg.joints]
A = { type = "revolute", parent = "base", child = "tube", at = [200, 0, 0], axis = "z" }
B = { type = "prismatic", parent = "tube", child = "rod", at = [0, 0, 0], child_at = [60, 0, 0], axis = "-x" }
C = { type = "revolute", parent = "rod", child = "plate", at = [60, 0, 0], child_at = [60, 0, 0], axis = "z" }
[limbs.leg.inputs]
B = { name = "q" }
[limbs.leg.home]
A = 0
B = 140
C = 0
"""


def test_a_parallel_singularity_at_the_start_is_left_along_poses_and_not_along_inputs(tmp_path, capsys):
    """All three legs point to the middle at home, where they hold the platform's turning by nothing."""
    path = tmp_path / "rpr.toml"
    path.write_text(RPR)
    record = load_record(path)
    home = home_values(record)
    gone = follow(record, home, poses=[10.0, 5.0, 0.2])
    assert gone.stopped is None
    assert gone.left == "parallel"
    assert "a parallel singularity left, no other seen" in str(gone)
    assert np.allclose(gone.poses[-1], [10.0, 5.0, 0.2])
    assert np.min(gone.smallest["inputs"][1:]) > 1e-5
    held = follow(record, home, inputs=inputs_of(record, home) + 5.0)
    assert (held.stopped.share, held.stopped.kind, held.left) == (0.0, "parallel", "")
    assert main(["follow", str(path), "--along", "inputs", "--to", "150", "145", "148"]) == 6
    said = " ".join(capsys.readouterr().out.split())
    assert "The start is at a parallel singularity, which no one way leaves: begin beside it" in said


def test_a_step_takes_as_much_work_on_a_long_path_as_on_a_short_one():
    mechanism = assur.load("zeng2019")
    start = mechanism.home_values
    ahead = pose_of(mechanism, start) + np.array([30.0, 40.0, -40.0])

    def work(largest_step):
        """Steps, and calls a step."""
        path = follow(mechanism, start, poses=ahead, largest_step=largest_step)
        assert path.stopped is None
        return len(path), calls(lambda: follow(mechanism, start, poses=ahead, largest_step=largest_step)) / len(path)

    (few, each_of_few), (many, each_of_many) = work(0.08), work(0.02)
    assert many > 2 * few
    assert each_of_many <= each_of_few


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({}, "give either inputs or poses"),
        ({"inputs": [0, 0], "poses": [0, 0]}, "give either inputs or poses"),
        ({"poses": [0.0, 200.0, 3.0]}, "poses of fivebar: 3 values, 2 wanted|pose of fivebar: 3 values, 2 wanted"),
        ({"inputs": [np.nan, 0.0]}, "every value must be finite"),
        ({"poses": [[[0.0, 200.0]]]}, "one target or a row of them"),
        ({"poses": [0.0, 200.0], "turns": "long"}, "unknown way to turn 'long'; there is: given, short"),
        ({"poses": [0.0, 200.0], "tolerance": 0.0}, "0 < the first < the second"),
        ({"poses": [0.0, 200.0], "largest_step": 2.0}, "0 < the first < the second"),
    ],
)
def test_misuse_is_refused(changed, message):
    mechanism = assur.load("fivebar")
    with pytest.raises(assur.UsageError, match=message):
        follow(mechanism, mechanism.home_values, **changed)


def test_a_start_that_is_no_assembly_is_refused_with_its_gap():
    mechanism = assur.load("fivebar")
    with pytest.raises(assur.UsageError, match="the start is not assembled, a gap of"):
        follow(mechanism, mechanism.home_values + 0.1, poses=[0.0, 200.0])
    with pytest.raises(assur.UsageError, match="one configuration is followed at a time"):
        follow(mechanism, np.tile(mechanism.home_values, (2, 1)), poses=[0.0, 200.0])


def test_a_way_that_is_shorter_than_rounding_is_gone_in_the_longest_steps(tmp_path):
    """It ran on in steps that each saw nothing but noise, for minutes."""
    path = tmp_path / "own.toml"
    rails = [f"P[{a}] R[{a}] R[{a}] R[{b}] R[{b}]" for a, b in ("xy", "xy", "yx", "yx")]
    assert main(["new", str(path), *(word for rail in rails for word in ("--chain", rail))]) == 0
    record = load_record(str(path))
    home = home_values(record)
    inputs = inputs_of(record, home)
    path = follow(record, home, inputs=inputs + 1e-10 * np.arange(1, 5), tolerance=1e-3)
    assert path.stopped is None
    assert len(path.shares) == 21
