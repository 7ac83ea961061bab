"""Articulated platforms on parallelograms of rods: every pose, against three spheres scanned over the angle left."""

from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.points import point
from assur.kinematics.border import inputs_of
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.loops.parallelograms import crossed_parallelograms, parallelograms
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

PAR4 = Path(__file__).parent / "par4.toml"
UPRIGHT, OVER_Y, OVER_X = np.eye(3), np.diag([-1.0, 1.0, -1.0]), np.diag([1.0, -1.0, -1.0])


def _on_three_spheres(centres: np.ndarray, radius: float) -> np.ndarray:
    """Both points (2, N, 3) at one distance from three centres (N, 3, 3); NaN where there are none."""
    first, across = centres[:, 0], centres[:, 1:] - centres[:, :1]
    normal = np.cross(across[:, 0], across[:, 1])
    right = np.stack([*np.moveaxis(np.sum(across**2, axis=2) / 2, 1, 0), np.zeros(len(first))], axis=1)
    middle = np.linalg.solve(np.concatenate([across, normal[:, None]], axis=1), right[..., None])[..., 0]
    with np.errstate(invalid="ignore"):
        height = np.sqrt(radius**2 - np.sum(middle**2, axis=1))
    normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    return np.stack([first + middle + sign * height[:, None] * normal for sign in (1.0, -1.0)])


def _scanned(near: np.ndarray, far: np.ndarray, radius: float, second: np.ndarray) -> int:
    """How many angles of the platform close the fourth limb.

    Args:
        near: (4, 3) ends of the arms; far: (4, 3) ends of the rods on their bar, as it stands, from its origin.
        radius: the rods' length; second: (N, 3) the second bar's origin from the first's, over the whole turn.
    """
    centres = np.broadcast_to(near - far, (len(second), 4, 3)).copy()
    centres[:, 2:] -= second[:, None]
    gaps = np.linalg.norm(_on_three_spheres(centres[:, :3], radius) - centres[:, 3], axis=-1) - radius
    with np.errstate(invalid="ignore"):
        crossings = [np.sum(gap[1:] * gap[:-1] < 0) for gap in gaps]
    return int(sum(crossings))


def _arms(mechanism: MechanismRecord, inputs: np.ndarray, balls: tuple[str, ...]) -> np.ndarray:
    joints = mechanism.home_values.copy()
    joints[list(mechanism.input_indices)] = inputs
    return np.array([point(mechanism, name, joints) for name in balls])


def _par4_count(mechanism: MechanismRecord, inputs: np.ndarray) -> int:
    near = _arms(mechanism, inputs, tuple(f"Bp{k}" for k in range(4)))
    far = np.array([mechanism.joints[f"Cp{k}"].child_at for k in range(4)])
    turn = np.linspace(-np.pi, np.pi, 60001)
    g = mechanism.joints["Q1"].child_at[1]
    second = 2 * g * np.stack([np.sin(turn), -np.cos(turn), np.zeros_like(turn)], axis=1)
    return _scanned(near, far, float(np.linalg.norm(mechanism.joints["Cp0"].at)), second)


def _h4_count(mechanism: MechanismRecord, inputs: np.ndarray) -> int:
    near = _arms(mechanism, inputs, ("B1a", "B2a", "B3a", "B4a"))
    far = np.array([mechanism.joints[name].child_at for name in ("C1a", "C2a", "C3a", "C4a")])
    turn = np.linspace(-np.pi, np.pi, 60001)
    h = mechanism.joints["D1"].child_at[0]
    second = -2 * h * np.stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)], axis=1)
    length = float(np.linalg.norm(mechanism.joints["C1a"].at))
    count = 0
    for bar1, bar2 in ((UPRIGHT, UPRIGHT), (OVER_Y, OVER_X)):
        stood = np.concatenate([far[:2] @ bar1.T, far[2:] @ bar2.T])
        count += _scanned(near, stood, length, second @ bar1.T)
    return count


def test_a_par4_has_the_poses_of_a_scan() -> None:
    mechanism = assur.load(PAR4)
    rng, counts = np.random.default_rng(3), []
    for _ in range(8):
        inputs = inputs_of(mechanism, mechanism.home_values) + rng.uniform(-0.7, 0.7, size=4)
        found = solve_by_loops(mechanism, inputs)
        assert found.complete
        assert "(8)" in found.right
        assert len(found.joints) == _par4_count(mechanism, inputs)
        counts.append(len(found.joints))
    assert len(set(counts)) > 1  # otherwise the scan decides nothing


def test_an_h4_has_the_poses_of_a_scan_with_its_bars_either_way_up() -> None:
    mechanism = assur.load("h4_robot")
    rng, over = np.random.default_rng(4), 0
    for _ in range(6):
        inputs = rng.uniform(-np.pi, np.pi, size=4)
        found = solve_by_loops(mechanism, inputs)
        assert found.complete
        assert "2 ways in which links that do not turn can stand" in found.right
        assert len(found.joints) == _h4_count(mechanism, inputs)
        over += sum(point(mechanism, "C1a", row)[0] < point(mechanism, "C2a", row)[0] for row in found.joints)
    assert over  # bars that stand over are met


def test_loops_are_told_once_though_those_of_bars_that_stand_over_end_before() -> None:
    """At some of these poses arms reach in one way in which bars stand, and the first of them do in the other."""
    mechanism, rng = assur.load("h4_robot"), np.random.default_rng(0)
    ends = []
    for _ in range(6):
        pose = np.concatenate([rng.uniform(-150, 150, 2), rng.uniform([-450, -1], [-250, 1])])
        found = mechanism.inverse(pose, method="loops")
        ends.append(len(found))
        assert found.right.count("its loops in turn") == 1
        assert "A4 and B4a (2)" in found.right
    assert {16, 32} <= set(ends)


def _ways_of_leg(mechanism: MechanismRecord, leg: int, end: np.ndarray) -> int:
    """How many angles of an arm bring its rod's near end to a rod's length from the far one, over a whole turn."""
    row, index = mechanism.home_values.copy(), mechanism.input_indices[leg - 1]
    near = []
    for angle in np.linspace(0.0, 2.0 * np.pi, 2001):
        row[index] = angle
        near.append(point(mechanism, f"B{leg}a", row))
    gaps = np.linalg.norm(np.array(near) - end, axis=1) - np.linalg.norm(mechanism.joints[f"C{leg}a"].at)
    return int(np.sum(gaps[1:] * gaps[:-1] < 0))


def _h4_ways(mechanism: MechanismRecord, pose: np.ndarray) -> int:
    """How many inputs reach a pose, with bars and platform either way up."""
    count = 0
    for bars, psi in (((UPRIGHT, UPRIGHT), 0.0), ((OVER_Y, OVER_X), np.pi)):
        turned = rotations.from_angles(pose[3], np.zeros(()), np.asarray(psi))
        ways = 1
        for leg in range(1, 5):
            hinge, bar = mechanism.joints[f"D{(leg + 1) // 2}"], bars[(leg - 1) // 2]
            place = pose[:3] + turned @ (np.array(hinge.child_at) - mechanism.platform.point) - bar @ hinge.at
            ways *= _ways_of_leg(mechanism, leg, place + bar @ mechanism.joints[f"C{leg}a"].child_at)
        count += ways
    return count


@pytest.mark.parametrize("seed", [5, *(pytest.param(seed, marks=pytest.mark.deep) for seed in (0, 2, 3, 4))])
def test_an_h4_reaches_a_pose_as_often_as_its_legs_do_with_the_platform_either_way_up(seed: int) -> None:
    mechanism = assur.load("h4_robot")
    home = pose_of(mechanism, mechanism.home_values)
    pose = home + np.random.default_rng(seed).uniform(-1.0, 1.0, size=4) * [80.0, 80.0, 80.0, 1.0]
    found = solve_by_loops(mechanism, pose=pose)
    assert found.complete
    assert len(found.joints) == _h4_ways(mechanism, pose) > 16  # the platform turned over is met


def test_rods_that_cross_are_not_among_the_answers_and_are_said_to_be_left_out() -> None:
    mechanism = assur.load(PAR4)
    answer = mechanism.direct(np.radians([20.0, 25.0, 10.0, 18.0]))
    assert (answer.complete, answer.complete_for) == (True, "reduced")
    assert list(parallelograms(mechanism)) == [f"rodm{k}/rodp{k}" for k in range(4)]
    assert not any(crossed_parallelograms(mechanism, row) for row in answer.joints)
    assert "rodm0/rodp0 and rodm1/rodp1" in answer.right


def test_the_home_of_a_par4_is_among_its_poses() -> None:
    mechanism = assur.load(PAR4)
    home = mechanism.home_values
    poses = pose_of(mechanism, solve_by_loops(mechanism, inputs_of(mechanism, home)).joints)
    assert np.min(np.linalg.norm(poses - pose_of(mechanism, home), axis=1)) < 1e-6


@pytest.mark.parametrize("name", ["gough_stewart", "three_rps", "fivebar"])
def test_rods_that_are_no_parallelogram_are_not_taken_for_one(name: str) -> None:
    assert not parallelograms(assur.load(name))
