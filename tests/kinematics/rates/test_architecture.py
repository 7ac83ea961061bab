"""Architecturally singular platforms are accepted, named so, and answer what can be answered."""

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from assur.cli.main import main
from assur.kinematics.home import home_values
from assur.kinematics.naming import sign_meanings
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.rates.architecture import architecture_text, self_motion_dimension
from assur.kinematics.status import Status
from assur.kinematics.validation.check import doubts, faults
from assur.model.registry import load_record
from assur.report.report import report_html
from six_legs import six_ups, three_rpr

TURN = Rotation.from_euler("zyx", [20, 8, -5], degrees=True).as_matrix()
PLACE = np.array([10.0, 20.0, 300.0])
ANGLES = np.arange(6) * np.pi / 3
HEXAGON = 200 * np.column_stack([np.cos(ANGLES), np.sin(ANGLES), np.zeros(6)])
TRIANGLE = HEXAGON[::2]
MIDDLES = (TRIANGLE + np.roll(TRIANGLE, -1, axis=0)) / 2
SCATTERED = np.column_stack([np.random.default_rng(0).normal(size=(6, 2)) * 150, np.zeros(6)])
LINE = np.column_stack([np.linspace(-200, 200, 6), np.zeros((6, 2))])

PLATFORMS = {
    "similar hexagons": (HEXAGON, 0.6 * HEXAGON),
    "corners on middles": (
        np.concatenate([TRIANGLE, MIDDLES]),
        np.concatenate([-0.6 * MIDDLES[[1, 2, 0]], -0.6 * TRIANGLE[[2, 0, 1]]]),
    ),
    "a base in a line": (LINE, 0.5 * SCATTERED),
    "similar, on no conic": (SCATTERED, 0.5 * SCATTERED),
    "of no kind": (HEXAGON, 0.5 * SCATTERED),
}


@pytest.fixture(scope="module", params=PLATFORMS)
def platform(request, tmp_path_factory):
    base, points = PLATFORMS[request.param]
    path = tmp_path_factory.mktemp("platforms") / "own.toml"
    path.write_text(six_ups("own", base, points, PLACE, TURN))
    return str(path), base, points


def lost(base, points):
    """By how much the six lines of the legs lack rank, at poses by chance."""
    rng, ranks = np.random.default_rng(1), []
    for turn in Rotation.random(8, random_state=2).as_matrix():
        ends = points @ turn.T + PLACE + 50 * rng.normal(size=3)
        lines = (ends - base) / np.linalg.norm(ends - base, axis=1, keepdims=True)
        ranks.append(np.linalg.matrix_rank(np.hstack([lines, np.cross(base, lines) / 200]), tol=1e-9))
    return 6 - max(ranks)


def test_the_lines_of_the_legs_say_which_platforms_are_singular_everywhere(platform):
    path, base, points = platform
    record = load_record(path)
    ways = lost(base, points)
    assert self_motion_dimension(record) == ways
    assert architecture_text(record).startswith("architecturally singular") == bool(ways)
    assert faults(record) == ()


def test_poses_of_one_set_of_lengths_are_points_of_a_self_motion(platform):
    path, base, points = platform
    record = load_record(path)
    if not lost(base, points):
        return
    solutions = inverse(record, pose_of(record, home_values(record)) + np.array([5, -8, 12, 0.1, 0.05, -0.04]))
    assert solutions.complete
    assert {Status(s).name for s in solutions.status[solutions.exists]} == {"self_motion"}
    lengths = solutions.inputs[solutions.exists][0]
    poses = direct(record, lengths)
    assert not poses.complete
    assert np.sum(poses.exists) > 3
    for pose in poses.poses[poses.exists]:
        turn = Rotation.from_euler("ZYX", pose[3:]).as_matrix()
        ends = points @ turn.T + pose[:3]
        assert np.linalg.norm(ends - base, axis=1) == pytest.approx(np.abs(lengths), abs=1e-4)
    assert not np.any(direct(record, lengths + np.eye(6)[1]).exists)


def test_every_command_answers_what_can_be_answered(tmp_path, capsys):
    path = tmp_path / "own.toml"
    path.write_text(six_ups("own", *PLATFORMS["similar hexagons"], PLACE, TURN))

    def said(*words):
        code = main([*words, "--json"])
        return code, json.loads(capsys.readouterr().out)

    code, answer = said("check", str(path))
    assert (code, answer["sound"], answer["facts"]["architecture"][:24]) == (0, True, "architecturally singular")
    pose = ["12", "22", "305", "18", "7", "-4"]
    code, answer = said("inverse", str(path), *pose)
    assert (code, answer["complete"], len(answer["solutions"])) == (0, True, 64)
    home = [item["mode"] for item in answer["solutions"] if item["home"]]
    assert home == ["++++++"]
    lengths = next(item["inputs"] for item in answer["solutions"] if item["home"])
    code, answer = said("direct", str(path), *map(repr, lengths))
    assert (code, answer["complete"], answer["status"]) == (0, False, "self_motion")
    assert answer["architecture"]
    code, answer = said("singularity", str(path), "--pose", *pose)
    assert (code, answer["kind"]) == (0, "self_motion")
    assert said("topology", str(path))[0] == 0
    assert main(["check", str(path)]) == 0
    assert "architecturally singular: with every input held the platform still moves in 1 way" in " ".join(
        capsys.readouterr().out.split()
    )


def test_a_singular_home_is_said_and_names_its_modes_beside_it(tmp_path):
    """The lines of all three legs meet in one point at home: there the two assemblies beside it merge."""
    centre, points = np.array([130.0, 100.0]), np.array([(-40.0, -30.0), (50.0, -20.0), (0.0, 60.0)])
    ends = points + np.array([100.0, 90.0])
    base = centre + np.array([[3.0], [2.5], [2.0]]) * (ends - centre)
    path = tmp_path / "own.toml"
    path.write_text(three_rpr("own", base, points, 100.0, 90.0, 0.0))
    record = load_record(str(path))
    (note,) = doubts(record)
    assert "home is singular: parallel" in str(note)
    (meaning,) = sign_meanings(record, "direct").values()
    assert meaning.endswith("stand on one side of where they are singular; at home they are")
    poses = direct(record, [163.0, 56.0, 60.0])
    assert sorted(poses.labels[poses.exists]) == ["+", "-"]
    code = main(["singularity", str(path), "--pose", "102", "88", "3"])
    assert code == 0


def test_the_report_says_it_once_and_that_listed_poses_are_some_of_infinitely_many(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(six_ups("own", *PLATFORMS["similar hexagons"], PLACE, TURN))
    html = report_html(load_record(str(path)), resolution=8, figures=False)
    assert html.count("The mechanism is architecturally singular") == 1
    assert "moves through infinitely many, of which these are some" in html
    assert html.count("joints that turn about themselves (8 times)") == html.count("joints that turn about themselves")
    assert ">Dimensions<" not in html  # it has none by name
