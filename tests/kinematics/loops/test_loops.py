"""All assemblies: against closed forms, random assemblies, a dense scan of the virtual variable, and a search."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.cli.main import main
from assur.errors import UsageError
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import point
from assur.kinematics.border import inputs_of
from assur.kinematics.closing_blocks.columns import assemblies_by_chance
from assur.kinematics.closure import assemble, closure_error, closure_jacobian
from assur.kinematics.configurations import places
from assur.kinematics.home import home_values
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.loops.parallelograms import crossed_parallelograms
from assur.kinematics.pose import pose_of
from assur.kinematics.search import search
from assur.model.mechanism import MechanismRecord
from assur.model.registry import load_record, names
from assur.synthesis.drafting.copying import copied
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains
from catalogue import each
from moved_frames import with_moved_frames
from reordered import reordered

TABLE_1 = (162.6907, -143.3209, -24.6776)


def test_the_papers_mechanism_has_the_four_poses_of_its_closed_form() -> None:
    mechanism = assur.load("zeng2019")
    found = solve_by_loops(mechanism, TABLE_1)
    assert found.complete
    assert found.searched == 2 + 2 * 2 + 4 * 2
    closed = np.array([group.pose for group in mechanism.direct(TABLE_1)])
    assert len(found.joints) == len(closed) == 4
    ours = pose_of(mechanism, found.joints)
    assert all(np.min(np.linalg.norm(ours - pose, axis=1)) < 1e-7 for pose in closed)


COMPLETE = (
    *("fivebar", "planar_3rrr", "planar_3rpr", "zeng2019", "tripteron", "three_crr", "three_rrc"),
    *("orthoglide", "linear_delta_4r", "tsai_platform", "delta_4s", "linear_delta_4s", "three_p2us"),
)


@pytest.mark.parametrize("name", [*COMPLETE, "three_rps", "h4_robot"])
def test_direct_problem_agrees_with_the_closed_form(name: str) -> None:
    mechanism = assur.load(name)
    found = solve_by_loops(mechanism, inputs_of(mechanism, mechanism.home_values))
    assert found.complete
    closed = np.array([group.pose for group in mechanism.direct(inputs_of(mechanism, mechanism.home_values))])
    ours = pose_of(mechanism, found.joints)
    gaps = np.linalg.norm(ours[:, None] - closed[None], axis=-1)
    assert np.max(np.min(gaps, axis=0)) < 1e-6
    assert np.max(np.min(gaps, axis=1)) < 1e-6


@pytest.mark.parametrize("name", ["delta_4s", "three_p2us", "orthoglide", "three_rps", "planar_3rrr"])
def test_where_the_frames_of_links_are_decides_nothing(name: str) -> None:
    """A rod whose frame stands beside its line is as straight as another."""
    record = load_record(name)
    moved, home = with_moved_frames(record, 3), home_values(record)
    pose = pose_of(record, home)
    assert np.allclose(pose_of(moved, home), pose)
    questions = [{"inputs": inputs_of(record, home)}, *([{"pose": pose}] if name != "three_rps" else [])]
    for question in questions:
        found, other = solve_by_loops(record, **question), solve_by_loops(moved, **question)
        assert found.complete
        assert other.complete
        assert len(found.joints) == len(other.joints) > 0
        where = places(record, other.joints)
        for row in places(record, found.joints):
            assert np.min(np.max(np.abs(where - row), axis=1)) < 1e-6


@pytest.mark.parametrize("name", [*COMPLETE, "three_rrrp4r"])
def test_inverse_problem_agrees_with_the_closed_form(name: str) -> None:
    mechanism = assur.load(name)
    pose = pose_of(mechanism, mechanism.home_values)
    found = solve_by_loops(mechanism, pose=pose)
    assert found.complete
    closed = np.array([group.inputs for group in mechanism.inverse(pose)])
    ours = inputs_of(mechanism, found.joints)
    turning = np.array([group.coordinate.kind == "angle" for group in mechanism.inputs])
    gaps = ours[:, None] - closed[None]
    gaps = np.linalg.norm(np.where(turning, np.sin(gaps / 2), gaps), axis=-1)
    assert np.max(np.min(gaps, axis=0)) < 1e-6


RANDOM = ("fivebar", "zeng2019", "planar_3rrr", "planar_3rpr", "orthoglide", "tripteron")


@pytest.mark.parametrize("name", each(RANDOM, ["fivebar", "planar_3rrr", "tripteron"]))
def test_no_random_assembly_is_missing(name: str) -> None:
    mechanism = assur.load(name)
    rng = np.random.default_rng(5)
    length = characteristic_length(mechanism)
    spread = np.array([np.pi if group.kind == "angle" else length for group in mechanism.coordinates])
    start = mechanism.home_values + spread * rng.uniform(-1, 1, size=(150, len(spread)))
    random = assemble(mechanism, start)
    closed = random.values[random.closed]
    kept = [row for row in closed if not crossed_parallelograms(mechanism, row) and _determined(mechanism, row)][:8]
    assert len(kept) >= 4
    for row in kept:
        found = solve_by_loops(mechanism, inputs_of(mechanism, row))
        assert found.complete
        places = np.array([_places(mechanism, other) for other in found.joints])
        assert np.min(np.max(np.abs(places - _places(mechanism, row)), axis=(1, 2))) < 1e-5 * length


def _determined(mechanism: MechanismRecord, joints: np.ndarray) -> bool:
    """Whether the inputs leave no motion: there are assemblies of the paper's mechanism that lie on a self-motion."""
    rates = np.delete(closure_jacobian(mechanism, joints), mechanism.input_indices, axis=-1)
    return bool(np.linalg.matrix_rank(rates, tol=1e-6) == rates.shape[-1])


def _places(mechanism: MechanismRecord, joints: np.ndarray) -> np.ndarray:
    return np.array([point(mechanism, name, joints) for name in mechanism.joints])


def _scanned_poses(tips: np.ndarray, rods: np.ndarray, corners: np.ndarray) -> int:
    """Number of poses of a planar 3-RRR by a scan: platform angle -> C1 from two rods -> residual of the third rod."""
    phi = np.linspace(-np.pi, np.pi, 40001)
    turned = np.exp(1j * phi)[:, None] * corners
    centre = tips - turned  # the platform's origin is at distance rods[k] from centre[:, k]
    across = centre[:, 1] - centre[:, 0]
    distance = np.abs(across)
    along = (rods[0] ** 2 - rods[1] ** 2 + distance**2) / (2 * distance)
    height = rods[0] ** 2 - along**2
    count = 0
    for sense in (1, -1):
        with np.errstate(invalid="ignore"):
            origin = centre[:, 0] + across / distance * (along + 1j * sense * np.sqrt(height))
            gap = np.abs(origin - centre[:, 2]) - rods[2]
        count += int(np.sum(np.sign(gap[1:]) * np.sign(gap[:-1]) < 0))
    return count


def test_planar_3rrr_agrees_with_a_scan_of_the_platforms_angle() -> None:
    mechanism = assur.load("planar_3rrr")
    rng = np.random.default_rng(2)
    limbs = [("leg1.B", "leg1.C"), ("leg2.B", "leg2.C"), ("leg3.B", "leg3.C")]
    home = inputs_of(mechanism, mechanism.home_values)
    counts = []
    for _ in range(12):
        inputs = home + rng.uniform(-0.4, 0.4, size=3)
        found = solve_by_loops(mechanism, inputs)
        held = mechanism.home_values.copy()
        held[list(mechanism.input_indices)] = inputs
        tips = np.array([complex(*point(mechanism, b, held)[:2]) for b, _ in limbs])
        rods = np.array([np.linalg.norm(mechanism.joints[c].at) for _, c in limbs])
        corners = np.array([complex(*mechanism.joints[c].child_at[:2]) for _, c in limbs])
        expected = _scanned_poses(tips, rods, corners)
        counts.append(len(found.joints))
        assert len(found.joints) == expected
    assert len(set(counts)) > 1  # otherwise the scan decides nothing


def test_a_planar_3rpr_can_have_six_poses() -> None:
    mechanism = assur.load("planar_3rpr")
    found = solve_by_loops(mechanism, inputs_of(mechanism, mechanism.home_values))
    assert found.complete
    assert found.searched == 6
    assert np.max(closure_error(mechanism, found.joints)) < 1e-9 * characteristic_length(mechanism)


def test_the_four_bar_of_the_file_tests(request: pytest.FixtureRequest) -> None:
    mechanism = assur.load(request.config.rootpath / "tests" / "model" / "fourbar.toml")
    found = solve_by_loops(mechanism, [0.4])
    assert found.complete
    assert len(found.joints) == 2
    assert np.sign(found.joints[0, 2]) != np.sign(found.joints[1, 2])  # the transmission angle's two senses


def test_at_the_limit_of_reach_two_branches_are_one() -> None:
    mechanism = assur.load("fivebar")
    values = mechanism.values
    shoulder, reach = np.array([-values.g, 0.0]), values.l1 + values.l2
    direction = np.array([np.cos(1.2), np.sin(1.2)])
    numbers = [
        len(solve_by_loops(mechanism, pose=shoulder + (reach + gap) * direction).joints) for gap in (-0.1, 0, 0.1)
    ]
    assert numbers == [4, 2, 0]


def test_a_self_motion_is_not_called_complete() -> None:
    angle = np.arccos(0.7)  # the tips of the two cranks coincide
    found = solve_by_loops(assur.load("fivebar"), [angle, np.pi - angle])
    assert not found.complete
    assert found.right == "not proved, since B1 and B2 have infinitely many values, real or not"


def test_inverse_problem_of_the_papers_mechanism() -> None:
    mechanism = assur.load("zeng2019")
    pose = [-15.4714, 9.6849, 456.3315]
    found = solve_by_loops(mechanism, pose=pose)
    closed = np.array([group.inputs for group in mechanism.inverse(pose)])
    assert found.complete
    assert len(found.joints) == len(closed) == 8
    ours = inputs_of(mechanism, found.joints)
    assert all(np.min(np.linalg.norm(ours - row, axis=1)) < 1e-6 for row in closed)


def test_crossed_parallelograms_are_shown_on_demand() -> None:
    mechanism = assur.load("zeng2019")
    found = solve_by_loops(mechanism, TABLE_1, crossed=True)
    kinds = [crossed_parallelograms(mechanism, row) for row in found.joints]
    assert not found.complete
    assert "not proved" in found.right
    assert kinds.count(()) == 4
    assert kinds.count(("Pa2",)) == 4
    assert len(kinds) == 32  # by independent starts on the whole joint graph


REFUSED = {
    "gough_stewart": "platform carries a point outside the plane of three ball joints",
    "three_upu": "leg1.A's cross turns about more than one direction",
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_system_of_circles_says_so(name: str) -> None:
    mechanism = assur.load(name)
    found = solve_by_loops(mechanism, inputs_of(mechanism, mechanism.home_values))
    assert (len(found.joints), found.complete) == (0, False)
    assert REFUSED[name] in found.right


def test_the_direct_problem_is_complete_for_16_of_18_mechanisms() -> None:
    complete = {*COMPLETE, "three_rps", "three_rrrp4r", "h4_robot"}
    assert (len(complete), complete | {*REFUSED}) == (16, {*names()})


def test_a_platform_on_three_circles_has_the_poses_of_its_two_quartics() -> None:
    mechanism = assur.load("three_rps")
    rng = np.random.default_rng(4)
    counts = set()
    for legs in [*rng.uniform(150, 400, size=(12, 3)), (900.0, 50.0, 60.0), *LEGS_ALIKE]:
        found = solve_by_loops(mechanism, legs)
        closed = mechanism.direct(legs)
        assert found.complete
        assert (len(found.joints), found.searched) == (len(closed), 16)
        if not len(closed):
            counts.add(0)
            continue
        ours, theirs = (places(mechanism, joints) for joints in (found.joints, closed.joints[closed.exists]))
        gaps = np.max(np.abs(ours[:, None] - theirs), axis=2)
        assert np.max(np.min(gaps, axis=0), initial=0.0) < 1e-4
        counts.add(len(found.joints))
    assert {0, 4, 8, 16} <= counts


def test_where_two_quartics_are_undecided_three_circles_are_not() -> None:
    mechanism = assur.load("three_rps", R=60.0, r=120.0)
    legs = np.array([255.3, 343.9, 304.3])
    found = solve_by_loops(mechanism, legs)
    assert found.complete
    assert not mechanism.direct(legs, method="closed form").complete
    searched = search(mechanism, "direct", legs).joints
    gaps = np.max(np.abs(places(mechanism, found.joints)[:, None] - places(mechanism, searched)), axis=2)
    assert gaps.shape == (12, 12)
    assert np.max(np.min(gaps, axis=0)) < 1e-5


def test_a_platform_that_can_move_is_not_called_complete() -> None:
    found = solve_by_loops(assur.load("three_rps", R=60.0, r=120.0), [300.0, 300.0, 300.0])
    assert not found.complete
    assert "leg1.A and leg2.A and leg3.A and platform have infinitely many values" in found.right


LEGS_ALIKE = ((300.0, 300.0, 300.0), (387.2, 387.2, 387.2), (290.5, 210.4, 210.4), (150.0, 378.1, 378.1))
"""Where poses share a leg's angle, so that its eliminant has double roots."""


@pytest.mark.parametrize("inputs", [(0.93, 1.11, 0.78), (0.3, 0.7, 0.7)])
def test_a_direct_problem_with_64_roots_has_the_poses_that_a_search_finds(inputs: tuple[float, ...]) -> None:
    mechanism = assur.load("three_rrrp4r")
    found = solve_by_loops(mechanism, inputs)
    assert (found.complete, found.searched) == (True, 64)
    searched = search(mechanism, "direct", np.array(inputs)).joints
    kept = np.array([row for row in searched if not crossed_parallelograms(mechanism, row)])
    ours, theirs = pose_of(mechanism, found.joints), pose_of(mechanism, kept)
    gaps = np.linalg.norm(ours[:, None] - theirs, axis=-1)
    assert len(ours) == len(theirs) == 4
    assert np.max(np.min(gaps, axis=0)) < 1e-6


DRAFTS = {
    "rps": (["R[y] P[z] S"] * 3, 8),  # the cranks are driven: ball joints on three lines
    "cs": (["C[x] S", "C[y] S", "C[z] S"], 16),
    "pus": (["P[x] U S", "P[y] U S", "P[z] U S"], 16),
    "rrp": (["R[z] R[z] P[x]"] * 3, 6),
}


@pytest.mark.parametrize("name", each(DRAFTS, ["cs", "rrp"]))
def test_drafts_have_the_assemblies_that_a_search_finds(name: str, tmp_path: Path) -> None:
    limbs, count = DRAFTS[name]
    path = tmp_path / f"{name}.toml"
    path.write_text(drafted(parse_chains(limbs), path).text, encoding="utf-8")
    mechanism = assur.load(path)
    inputs = inputs_of(mechanism, mechanism.home_values)
    found = solve_by_loops(mechanism, inputs)
    assert found.complete
    assert f"({count})" in found.right
    searched = search(mechanism, "direct", inputs).joints
    gaps = np.max(np.abs(places(mechanism, found.joints)[:, None] - places(mechanism, searched)), axis=2)
    assert np.max(np.min(gaps, axis=0)) < 1e-5
    # Drawn starts spread over a characteristic length: what lies dozens of them away (13 m of a drive's 0.1 m) they
    # may miss, and only the loops in turn know of it.
    far = np.max(np.abs(found.joints - mechanism.home_values), axis=1) > 30 * characteristic_length(mechanism)
    assert np.max(np.min(gaps, axis=1), where=~far, initial=0.0) < 1e-5
    assert np.count_nonzero(~far) >= 2


@pytest.mark.parametrize(("name", "count"), [("three_rps", 8), ("three_p2us", 2), ("three_rrrp4r", 4)])
def test_a_file_without_closed_form_is_solved_completely(name: str, count: int, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(copied(name, path).text, encoding="utf-8")
    mechanism = assur.load(path)
    found = mechanism.direct(inputs_of(mechanism, mechanism.home_values))
    assert mechanism.closed_form is None
    assert (len(found), found.complete) == (count, True)
    assert "its loops in turn" in found.right


REORDERED = ("delta_4s", "zeng2019", "h4_robot", "three_p2us", "tsai_platform", "3-RPa(4S)")


@pytest.mark.parametrize("name", each(REORDERED, ("delta_4s", "zeng2019")))
def test_the_order_of_the_file_decides_nothing(name: str, tmp_path: Path) -> None:
    """Rods that stay parallel have one direction, whichever end of each is written first."""
    record = load_record(_arranged(name, tmp_path) if name.startswith("3") else name)
    home = home_values(record)
    for solve in (
        lambda own: solve_by_loops(own, inputs_of(record, home)),
        lambda own: solve_by_loops(own, pose=pose_of(record, home)),
    ):
        expected = solve(record)
        assert len(expected.joints) > 0
        for seed in range(3):
            solutions = solve(reordered(record, seed))
            assert (len(solutions.joints), solutions.complete) == (len(expected.joints), expected.complete)


def _arranged(shorthand: str, folder: Path) -> Path:
    path = folder / "mine.toml"
    assert main(["new", str(path), shorthand]) == 0
    return path


def test_an_angle_that_a_pose_leaves_open_is_not_taken_as_zero(tmp_path: Path) -> None:
    """A loop carries the platform on an axis of the plane's: phi comes with theta and psi, and is none of the pose."""
    path = tmp_path / "mine.toml"
    chains = parse_chains(["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y]", "U P S", "U P S"])
    path.write_text(drafted(chains, path).text, encoding="utf-8")
    record = load_record(path)
    assert record.platform.pose == ("y", "z", "theta", "psi")
    at = next(joints for joints in assemblies_by_chance(record) if abs(_phi(record, joints)) > 0.1)
    found = solve_by_loops(record, pose=pose_of(record, at))
    assert not found.complete
    assert "obliquely" in found.right


def _phi(record: MechanismRecord, joints: np.ndarray) -> float:
    turned = frames(record, joints)[record.platform.link][0]
    return float(np.arctan2(turned[1, 0], turned[0, 0]))


@pytest.mark.parametrize("given", [{}, {"inputs": [0.0, 0.0], "pose": [0.0, 0.0]}, {"inputs": [[0.0, 0.0]]}])
def test_misuse_is_refused(given: dict[str, list[float]]) -> None:
    with pytest.raises(UsageError):
        solve_by_loops(assur.load("fivebar"), **given)
