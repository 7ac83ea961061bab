"""Steps over floats: motions against exponentials of their twists, states without trigonometry."""

import numpy as np
import pytest
from scipy.linalg import expm

from assur.joints.steps import BALL, SCREW, SLIDE, TURN, UNTURNED, about, of_quaternion, quaternions
from assur.numerics import rotations

AXIS = (2 / 7, 3 / 7, 6 / 7)
ADVANCE = 0.7


def displaced(step, values):
    """Turn and shift (4, 4) at values (c,)."""
    turn, shift = step.motion(AXIS, ADVANCE, tuple(step.state(values)))
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turn, shift
    return matrix


@pytest.mark.parametrize("step", [TURN, SLIDE, SCREW], ids=lambda step: step.kind)
def test_a_motion_is_the_exponential_of_its_twist(step):
    ((angular, velocity),) = step.twists(AXIS, ADVANCE, UNTURNED)
    for value in (-7.0, 0.0, 0.3, 9.0):
        generator = np.zeros((4, 4))
        generator[:3, :3], generator[:3, 3] = rotations.skew(np.array(angular, dtype=float)), velocity
        np.testing.assert_allclose(displaced(step, np.array([value])), expm(value * generator), atol=1e-13)


def test_a_ball_turns_by_its_rotation_vector():
    for vector in np.random.default_rng(0).uniform(-4, 4, (20, 3)):
        turn = expm(rotations.skew(vector))
        np.testing.assert_allclose(displaced(BALL, vector)[:3, :3], turn, atol=1e-13)
        np.testing.assert_allclose(of_quaternion(*(3.0 * quaternions(vector))), turn, atol=1e-13)


def test_states_of_many_joints_at_once_are_those_of_each():
    vectors = np.random.default_rng(1).normal(size=(3, 2, 5))
    together = BALL.state(vectors)
    for k in range(2):
        np.testing.assert_array_equal(together[:, k], BALL.state(vectors[:, k]))


def test_whole_numbers_stay_whole():
    assert about((0, 0, 1), 0, 1) == ((0, -1, 0), (1, 0, 0), (0, 0, 1))
    turn = about((0, 0, 1), 0.6, 0.8)
    assert [type(number) for row in turn for number in row] == [float, float, int, float, float, int, int, int, int]


def test_a_step_along_another_axis_is_another_step():
    assert TURN.along(1) != TURN
    assert TURN.along(0) == TURN
