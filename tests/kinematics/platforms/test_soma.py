"""Soma coordinates: poses there and back, and the quadrics that they say."""

import numpy as np

from assur.kinematics.platforms.soma import STUDY, composed_soma, frames_of, norm_of, products, soma_of, spheres
from assur.numerics.rotations import from_quaternion

RNG = np.random.default_rng(5)
QUATERNIONS = RNG.normal(size=(20, 4))
FRAMES = from_quaternion(QUATERNIONS / np.linalg.norm(QUATERNIONS, axis=1)[:, None]), RNG.normal(size=(20, 3))


def test_poses_there_and_back():
    soma = soma_of(FRAMES)
    assert np.max(np.abs(products(soma) @ STUDY)) < 1e-15
    rotations, places = frames_of(-3.0 * soma)
    assert np.allclose(rotations, FRAMES[0], rtol=0, atol=1e-12)
    assert np.allclose(places, FRAMES[1], rtol=0, atol=1e-12)


def test_sums_of_the_seventeen_say_a_distance():
    """|p + R b - a|^2 by its formula, and as a sum of |p|^2, p, R' p, R and 1."""
    a, b = RNG.normal(size=(2, 3))
    rotations, places = FRAMES
    sums = np.concatenate([[1.0], -2 * a, 2 * b, -2 * np.outer(a, b).ravel(), [a @ a + b @ b]])
    soma = soma_of(FRAMES)
    values = products(soma) @ (sums @ spheres()) / norm_of(soma)
    assert np.allclose(values, np.sum((places + rotations @ b - a) ** 2, axis=1), rtol=0, atol=1e-12)


def test_they_are_independent_of_each_other_and_of_studys():
    assert np.linalg.matrix_rank(np.concatenate([spheres(), STUDY[None]])) == 18


def test_displacements_one_after_another():
    rotations, places = FRAMES
    both = frames_of(composed_soma(soma_of(FRAMES), soma_of((rotations[::-1], places[::-1]))))
    assert np.allclose(both[0], rotations @ rotations[::-1], rtol=0, atol=1e-12)
    assert np.allclose(both[1], places + np.einsum("nij,nj->ni", rotations, places[::-1]), rtol=0, atol=1e-12)
