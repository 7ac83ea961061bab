import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from assur.numerics import rotations
from examples import examples

parts = st.floats(-3.0, 3.0)


@given(st.tuples(parts, parts, parts))
@examples(200)
def test_rotation_of_a_vector_agrees_with_scipy(vector):
    expected = Rotation.from_rotvec(vector).as_matrix()
    np.testing.assert_allclose(rotations.from_vector(np.array(vector)), expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    "angle", [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 3.0, np.pi - 1e-3, np.pi - 1e-6, np.pi - 1e-9, np.pi]
)
def test_vector_of_a_rotation_is_its_inverse_up_to_half_turns(angle):
    rng = np.random.default_rng(0)
    axes = rng.normal(size=(200, 3))
    axes[0] = [1.0, 0.0, 0.0]
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    turned = rotations.from_vector(angle * axes)
    vectors = rotations.to_vector(turned)
    np.testing.assert_allclose(np.linalg.norm(vectors, axis=-1), angle, rtol=0, atol=1e-12)
    np.testing.assert_allclose(rotations.from_vector(vectors), turned, rtol=0, atol=1e-8)


def test_about_axis_agrees_with_the_rotation_vector():
    axis = np.array([0.6, 0.0, 0.8])
    angles = np.linspace(-4, 4, 9)
    np.testing.assert_allclose(
        rotations.about_axis(axis, angles), rotations.from_vector(angles[:, None] * axis), rtol=0, atol=1e-14
    )


def test_taking_is_the_smallest_rotation():
    rng = np.random.default_rng(2)
    for start, end in rng.normal(size=(50, 2, 3)):
        start, end = start / np.linalg.norm(start), end / np.linalg.norm(end)
        turn = rotations.taking(start, end)
        np.testing.assert_allclose(turn @ start, end, atol=1e-12)
        angle = np.linalg.norm(rotations.to_vector(turn))
        assert angle == pytest.approx(np.arccos(start @ end), abs=1e-9)


def _turns():
    """Rotation vectors: by chance, none, tiny ones and half turns about axes of every kind."""
    rng = np.random.default_rng(8)
    anywhere = rng.normal(size=(40, 3))
    half = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, -1, 1]], dtype=float)
    half *= np.pi / np.linalg.norm(half, axis=-1, keepdims=True)
    return np.concatenate([anywhere, np.zeros((1, 3)), 1e-9 * anywhere[:5], half, half * (1 - 1e-9)])


def test_quaternions_and_rotations_are_one_another():
    turned = rotations.from_vector(_turns())
    found = rotations.to_quaternion(turned)
    np.testing.assert_allclose(np.linalg.norm(found, axis=-1), 1.0, rtol=0, atol=1e-15)
    assert np.all(found[:, 0] >= 0)
    np.testing.assert_allclose(rotations.from_quaternion(found), turned, rtol=0, atol=1e-14)
    np.testing.assert_allclose(rotations.from_quaternion(-found), turned, rtol=0, atol=1e-14)


def test_angles_and_rotations_are_one_another():
    turned = rotations.from_vector(_turns())
    angles = rotations.to_angles(turned)
    np.testing.assert_allclose(rotations.from_angles(*angles), turned, rtol=0, atol=1e-14)
    assert np.max(np.abs(angles[1])) <= np.pi / 2
    upright = rotations.from_angles(np.array(0.3), np.array(np.pi / 2), np.array(0.1))
    np.testing.assert_allclose(rotations.from_angles(*rotations.to_angles(upright)), upright, rtol=0, atol=1e-14)


@pytest.mark.parametrize("size", [0.0, 1e-3, 0.0099, 0.0101, 0.5, 3.0])
def test_the_left_jacobian_is_the_rate_of_turning(size):
    vector = size * np.array([2.0, -1.0, 2.0]) / 3
    step = 1e-6
    for k, column in enumerate(rotations.left_jacobian(vector).T):
        ahead, behind = (rotations.from_vector(vector + sign * step * np.eye(3)[k]) for sign in (1, -1))
        np.testing.assert_allclose(rotations.to_vector(ahead @ behind.T) / (2 * step), column, atol=1e-9)


@pytest.mark.parametrize("batch", [(), (7,), (2, 3)])
def test_the_rates_matrix_undoes_the_left_jacobian(batch):
    vector = np.random.default_rng(3).normal(size=(*batch, 3))
    both = rotations.vector_rates_matrix(vector) @ rotations.left_jacobian(vector)
    np.testing.assert_allclose(both, np.broadcast_to(np.eye(3), both.shape), rtol=0, atol=1e-13)
