import numpy as np
import pytest

from assur.synthesis.drafting.pose import pose_for

WX, WY, WZ, X, Y, Z = np.eye(6)


@pytest.mark.parametrize(
    ("twists", "pose"),
    [
        ((X, Y, Z), ("x", "y", "z")),
        ((WZ, X, Y), ("x", "y", "phi")),
        ((X, Y, Z, WZ), ("x", "y", "z", "phi")),
        ((Z, WX, WY), ("z", "theta", "psi")),
        ((WX, WY, WZ), ("phi", "theta", "psi")),
        ((WX, Y, Z), ("y", "z", "psi")),
        ((X, Y, Z, WX, WY, WZ), ("x", "y", "z", "qw", "qx", "qy", "qz")),
        ((X + 0.01 * WX,), ("x",)),
    ],
)
def test_coordinates_are_those_that_move(twists, pose):
    assert pose_for(np.stack(twists, axis=1), len(twists)) == pose
    mixed = np.stack(twists, axis=1) @ np.linalg.qr(np.random.default_rng(0).normal(size=(len(twists),) * 2))[0]
    assert pose_for(mixed, len(twists)) == pose


def test_a_platform_that_turns_about_a_point_is_placed_by_angles():
    about = np.stack([WX + Y, WY - X, WZ + 0.5 * Z], axis=1)
    assert pose_for(about, 3) == ("x", "y", "z")
    assert pose_for(about, 3, turns=True) == ("phi", "theta", "psi")
    assert pose_for(about[:, :2], 2, turns=True) == ("theta", "psi")
    assert pose_for(np.stack([X, Y], axis=1), 2, turns=True) == ("x", "y")


def test_no_choice_is_said_to_be_none():
    assert pose_for(np.stack([X, X + 1e-9 * Y], axis=1), 2) is None
    assert pose_for(np.stack([X, WZ], axis=1), 2, still=True) is None
    assert pose_for(np.zeros((6, 4)), 1) is None
    assert pose_for(np.eye(6), 7) is None
