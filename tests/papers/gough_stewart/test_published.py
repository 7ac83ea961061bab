"""Dietmaier's platform with 40 real postures, and Mourrain's with four, each number under its address.

B. Mourrain, The 40 "generic" positions of a parallel robot, ISSAC 1993, in the form that the test suite of the
project FRISCO and PHCpack hand on: the points of the base and of the platform, the lengths, and the equations of the
legs, and the 40 solutions. The points of the platform stand there in an order that is not that of the equations.
"""

import numpy as np

import assur

BASE = np.array([[0, 0.5, 1.5, 1.5, 1 / 3, 2], [0, -0.5, -0.5, 0.5, 0.5, 0], [0, -1, -1, -1, -1, 0]]).T
PLATFORM = np.array([[0, 1, 0, 1, 0, -1], [0, 0, -1, 1, 1, 0], [0, 1, 0, 1, 1, 1]]).T
PAIRS = [0, 1, 4, 5, 2, 3]
LENGTHS = [1, 1, 0.8, 2, 2, 2]
# Of legs 2 to 6 as printed: the constant, and the coefficients of u, v, w, where the platform is not turned.
EQUATIONS = [
    ["9.0", "2.0", "2.0", "8.0"],
    ["8.860", "-3.0", "3.0", "4.0"],
    ["7.5", "-5.0", "-1.0", "4.0"],
    ["0.361111111", "-0.6666666667", "-3.0", "2.0"],
    ["0", "-2.0", "2.0", "2.0"],
]
# u, v, w of the solutions that PHCpack lists without imaginary part: 4 of 40.
POSITIONS = [
    [-0.555383, -0.012990, -0.831493],
    [-0.274269, -0.344947, -0.897657],
    [0.271999, 0.958364, 0.086924],
    [0.355768, 0.900177, 0.251216],
]


def unturned(platform):
    """Legs 2 to 6 from the points and lengths: |n + y - x|^2 - l^2 with |n| = 1, times `scale` as printed."""
    apart = (platform - BASE)[1:]
    constants = 1 + np.sum(apart**2, axis=1) - np.square(LENGTHS[1:])
    scale = np.array([2, 1, 1, 1, 1])  # leg 2 is printed twice as large
    return scale[:, None] * np.column_stack([constants, 2 * apart])


def mourrain(platform):
    points = {"a": BASE, "b": platform}
    values = {
        f"{letter}{leg}{axis}": float(value)
        for letter, rows in points.items()
        for leg, row in enumerate(rows, 1)
        for axis, value in zip("xyz", row, strict=True)
    }
    return assur.load("gough_stewart").with_parameters(**values).direct(LENGTHS)


def turned(quaternion, points):
    """Points turned by a unit quaternion: p + 2 w (v x p) + 2 v x (v x p)."""
    w, v = quaternion[0], quaternion[1:]
    across = np.cross(v, points)
    return points + 2 * w * across + 2 * np.cross(v, across)


def test_dietmaiers_platform_has_the_forty_real_postures_of_the_title(at):
    row = at("Title: 40 real postures")["direct solutions"]
    assert (row.printed, row.computed, row.verdict) == ("40", 40, "ok")


def test_points_are_paired_by_mourrains_equations_and_not_as_they_stand():
    printed = np.array(EQUATIONS, dtype=float)
    np.testing.assert_allclose(unturned(PLATFORM[PAIRS]), printed, rtol=0, atol=1e-9)
    differ = np.any(np.abs(unturned(PLATFORM) - printed) > 0.1, axis=1)
    assert list(differ) == [False, True, True, True, True]


def test_mourrains_platform_has_the_four_real_postures_of_the_printed_forty():
    platform = PLATFORM[PAIRS]
    found = mourrain(platform)
    assert found.complete
    poses = found.poses[found.exists]
    np.testing.assert_allclose(sorted(poses[:, :3].tolist()), sorted(POSITIONS), rtol=0, atol=5e-7)
    for pose in poses:
        legs = pose[:3] + turned(pose[3:], platform) - BASE
        np.testing.assert_allclose(np.linalg.norm(legs, axis=1), LENGTHS, rtol=0, atol=1e-12)


def test_audit_is_complete(found):
    assert found.origin == "printed"
    assert found.claims_hold
    assert found.wrong == 0
