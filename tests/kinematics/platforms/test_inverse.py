"""Limb by limb: as many assemblies as a search finds, and those; each closes, and all are said to be known."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import closure_error
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.loops.parallelograms import crossed_parallelograms
from assur.kinematics.platforms import inverse as platforms_inverse
from assur.kinematics.platforms.inverse import inverse_by_limbs
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.search import search
from assur.model.registry import load_record

DRAFTS = {
    "3-RPS": ["3-RPS"],
    "3-SPR": ["3-SPR"],
    "3UPS&UP": ["3UPS&UP"],
    "3-PRS": ["3-PRS", "upright rails"],
    "3-RRS": ["3-RRS"],
    "2UPR-SPR": ["2UPR-SPR"],
    "2UPR-RPU": ["2UPR-RPU"],
    "6-UPS": ["6-UPS"],
    "6-RUS": ["6-RUS"],
    "6-PUS": ["6-PUS"],
    "RSS": ["--limb", "R[y] S S", "--count", "6", "--actuate", "1.1,2.1,3.1,4.1,5.1,6.1"],
    "ball screws": ["--limb", "{R[z]@O H[z]@O | P[z]} R[x] S", "--count", "3"],
    "ball screws in legs": ["--limb", "U[x,y] {R[z]@O H[z]@O | P[z]} S", "--count", "3"],
    "4UPS&UPU": ["--chain", "U[x,y] P[z] U[x,y]", *["--chain", "U P S"] * 4],
    "spherical": ["--limb", "R[z]@O R[0.8,0,0.6]@O R[0,0.8,0.6]@O", "--count", "3"],
}
QUICK = ("spherical", "3-RPS")


@pytest.fixture(
    scope="module", params=[name if name in QUICK else pytest.param(name, marks=pytest.mark.deep) for name in DRAFTS]
)
def drafted(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("limbs") / "mine.toml"
    assert main(["new", str(path), *DRAFTS[request.param]]) == 0
    return load_record(path)


def beside_home(record, rng):
    """A pose near home that the mechanism reaches."""
    pose = pose_of(record, home_values(record))
    lengths = np.array(
        [0.05 * characteristic_length(record) if name in "xyz" else 0.2 for name in record.platform.pose]
    )
    return pose + rng.uniform(-1, 1, len(pose)) * lengths


def test_all_that_a_search_finds_and_no_other(drafted):
    rng = np.random.default_rng(4)
    pose = beside_home(drafted, rng)
    if "qw" in drafted.platform.pose:
        pose[-4:] /= np.linalg.norm(pose[-4:])
    solutions = inverse_by_limbs(drafted, pose)
    assert solutions.complete
    assert len(solutions.joints) >= 8
    assert np.max(closure_error(drafted, solutions.joints)) < 1e-9
    known = search(drafted, "inverse", pose).joints
    together = np.concatenate([solutions.joints, known])
    assert len(distinct(drafted, together)) == len(solutions.joints)
    assert len(distinct(drafted, solutions.joints)) == len(solutions.joints)


def test_the_answer_says_by_what_right_they_are_all(drafted):
    pose = pose_of(drafted, home_values(drafted))
    answer = inverse(drafted, pose)
    assert answer.complete
    assert "each limb alone, in all its ways: " in answer.right
    for limb in answer.limbs:
        assert f"{limb.limb.joints[0]} ({len(limb.values)})" in answer.right


def test_a_platform_out_of_reach_has_none_and_that_is_known(tmp_path):
    path = tmp_path / "rus.toml"
    assert main(["new", str(path), "6-RUS"]) == 0
    solutions = inverse_by_limbs(load_record(path), np.array([0.0, 0.0, 1e5, 1.0, 0.0, 0.0, 0.0]))
    assert (len(solutions.joints), solutions.complete) == (0, True)
    assert solutions.right.count("(0)") == 6  # no leg reaches it


@pytest.mark.parametrize("name", ["zeng2019", "tsai_platform", "linear_delta_4r", "orthoglide", "three_rrrp4r"])
def test_parallelograms_of_hinges_give_what_the_loops_have_in_turn(name):
    """Another way to all roots, which shares no equation: points on circles, solved one after another."""
    record = load_record(name)
    for pose in (pose_of(record, home_values(record)), beside_home(record, np.random.default_rng(6))):
        loops, solutions = solve_by_loops(record, pose=pose), inverse_by_limbs(record, pose)
        assert (loops.complete, solutions.complete) == (True, True)
        assert len(loops.joints) == len(solutions.joints)
        assert len(distinct(record, np.concatenate([loops.joints, solutions.joints]))) == len(loops.joints)


def test_of_too_many_choices_those_near_home_are_listed_and_how_many_there_are(monkeypatch):
    """Turns of screws make millions; here a list is made short."""
    monkeypatch.setattr(platforms_inverse, "MOST", 40)
    monkeypatch.setattr(platforms_inverse, "NEAREST", 20)
    record = load_record("gough_stewart")
    home = home_values(record)
    solutions = inverse_by_limbs(record, pose_of(record, home))
    assert not solutions.complete
    assert solutions.right.startswith("not all: there are 64, each limb alone, in all its ways")
    assert [len(limb.values) for limb in solutions.limbs] == 6 * [2]
    assert len(solutions.joints) == 16
    assert np.min(np.linalg.norm((solutions.joints - home)[:, record.input_indices], axis=1)) < 1e-6


@pytest.mark.deep
def test_screws_beside_universal_joints_have_every_turn_that_their_rods_reach(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "--limb", "H[z] U S", "--count", "6"]) == 0
    record = load_record(path)
    pose = pose_of(record, home_values(record))
    limbs = inverse(record, pose).limbs
    met = search(record, "inverse", pose).joints
    assert len(met) > 100
    for limb in limbs:
        own = [index for index in limb.indices if index in record.input_indices]
        ways = limb.values[:, [limb.indices.index(index) for index in own]]
        assert len(ways) > 8
        near = np.unique(met[:, own].round(5))
        assert np.max(np.min(np.abs(near[:, None] - ways.ravel()), axis=1)) < 1e-4


def test_an_own_mechanism_with_parallelograms_is_complete(tmp_path):
    """Translations by limbs R R Pa R: the loops in turn do not give its direct problem."""
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "--limb", "R[x] R[x] P(4R)[z] R[x]"]) == 0
    record = load_record(path)
    home = home_values(record)
    for answer, problem, given in (
        (inverse(record, pose_of(record, home)), "inverse", pose_of(record, home)),
        (direct(record, inputs_of(record, home)), "direct", inputs_of(record, home)),
    ):
        assert answer.complete
        assert "leg1.C and leg2.C and leg3.C stay parallel" in answer.right
        met = search(record, problem, given).joints
        uncrossed = [row for row in met if not crossed_parallelograms(record, row)]
        assert len(answer) == len(uncrossed) == len(distinct(record, np.array(uncrossed)))


def three_balls_below(digits):
    """A tripod of legs S P R whose slides are square to their hinges, axes written to so many digits."""
    lines = ['format = 1\nname = "balls"\nunit = "mm"\nangle = "deg"\nbase = "base"\n[platform]\nlink = "platform"']
    lines += ['point = [0, 0, 0]\npose = ["z", "theta", "psi"]\n[links]\nbase = {}\nplatform = {}']
    joints, home = ["[joints]"], ["[home]"]
    legs = [((209, 18, 0), (94, 25, 0)), ((-89, 168, 10), (-91, 115, 6)), ((-75, -217, -6), (-58, -75, -8))]
    for k, (ball, hinge) in enumerate(legs, 1):
        way = np.add((0, 0, 330), np.subtract(hinge, ball))
        axis = np.cross(way, hinge)
        axis, slide = (np.round(own / np.linalg.norm(own), digits).tolist() for own in (axis, way))
        middle = (0.5 * way).tolist()
        lines.append(f"cyl{k} = {{}}\nrod{k} = {{}}")
        joints.append(f'A{k} = {{ type = "spherical", parent = "base", child = "cyl{k}", at = {[*ball]} }}')
        joints.append(
            f'P{k} = {{ type = "prismatic", parent = "cyl{k}", child = "rod{k}", at = {middle}, axis = {slide} }}'
        )
        joints.append(
            f'B{k} = {{ type = "revolute", parent = "rod{k}", child = "platform", at = {middle}, '
            f"child_at = {[*hinge]}, axis = {axis} }}"
        )
        home.append(f"A{k} = [0, 0, 0]\nP{k} = 0\nB{k} = 0")
    drives = [f'[inputs]\nP{k} = {{ name = "q{k}" }}' if k == 1 else f'P{k} = {{ name = "q{k}" }}' for k in (1, 2, 3)]
    return "\n".join([*lines, *joints, *drives, *home])


def test_axes_of_six_digits_are_as_good_as_those_of_sixteen(tmp_path):
    counts = []
    for digits in (16, 9, 6):
        path = tmp_path / f"{digits}.toml"
        path.write_text(three_balls_below(digits), encoding="utf-8")
        solved = inverse(load_record(path), [330.0, 0.0, 0.0])
        assert solved.complete, solved.right
        counts.append(len(solved))
    assert len(set(counts)) == 1
