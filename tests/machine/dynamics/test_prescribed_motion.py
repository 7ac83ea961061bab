"""Motions in time: derivatives against differences, periods, samples, quaternions."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.machine.dynamics.prescribed_motion import harmonic, sampled
from assur.numerics import rotations

STEP = 1e-5


@pytest.fixture(scope="module")
def fivebar():
    return assur.load("fivebar")


@pytest.fixture(scope="module")
def stewart():
    return assur.load("gough_stewart")


def swaying(record):
    """A motion of all coordinates of a platform with a quaternion whose length changes."""
    size = [0.1, 0.2, 0.1, 0.3, 0.2, -0.3, 0.1]
    return harmonic(record, [0, 0, 1, 1, 0, 0.1, 0], size, [2.0, 3, 4, 1, 2, 3, 5], np.arange(7.0), t_end=3.0)


def test_rates_are_those_of_the_places(fivebar):
    way = harmonic(fivebar, [0, 224], [10, 5], [2.0, 3.0], [0.1, 0.7])
    times = np.array([0.3, 1.1])
    before, at, after = (way.at(times + sense * STEP) for sense in (-1, 0, 1))
    np.testing.assert_allclose((after[0] - before[0]) / (2 * STEP), at[1], rtol=1e-7)
    np.testing.assert_allclose((after[1] - before[1]) / (2 * STEP), at[2], rtol=1e-7)


def test_a_quaternion_turns_with_the_angular_velocity_that_is_told(stewart):
    way, times = swaying(stewart), np.array([0.4, 2.0])
    before, at, after = (way.at(times + sense * STEP) for sense in (-1, 0, 1))
    assert np.linalg.norm(at[0][:, 3:], axis=1) == pytest.approx([1.0, 1.0])
    first, last = (rotations.from_quaternion(part[0][:, 3:]) for part in (before, after))
    turned = rotations.to_vector(last @ np.swapaxes(first, -1, -2)) / (2 * STEP)
    np.testing.assert_allclose(turned, at[1][:, 3:], rtol=1e-6)
    np.testing.assert_allclose((after[1] - before[1]) / (2 * STEP), at[2], rtol=1e-6)


def test_samples_of_a_smooth_motion_give_it_back_whatever_the_sign_of_its_quaternions(stewart):
    way, times = swaying(stewart), np.linspace(0.0, 3.0, 121)
    poses = way.at(times)[0]
    poses[1::2, 3:] *= -1.0
    back = sampled(stewart, times, poses)
    between = np.array([0.5123, 1.7])
    for told, given in zip(back.at(between), way.at(between), strict=True):
        np.testing.assert_allclose(told, given, atol=2e-4)


def test_angles_go_the_short_way():
    record = assur.load("planar_3rrr")
    poses = [[0.0, 0.0, np.radians(angle)] for angle in (170, 175, 180, -175, -170, -165)]
    way = sampled(record, np.arange(6.0), poses)
    assert np.degrees(way.at(np.array([2.5]))[1][0, 2]) == pytest.approx(5.0)


def test_it_lasts_until_all_are_where_they_began(fivebar):
    assert harmonic(fivebar, [0, 224], [1, 1], [2.0, 3.0]).times[-1] == pytest.approx(2 * np.pi)
    assert harmonic(fivebar, [0, 224], [1, 0], [2.0, 0.1]).times[-1] == pytest.approx(np.pi)  # y stands still
    assert harmonic(fivebar, [0, 224], [1, 1], [1.0, np.sqrt(2)]).times[-1] == pytest.approx(24 * np.pi)  # never
    assert len(harmonic(fivebar, [0, 224], [1, 1], [2.0, 3.0], count=9).times) == 9


def test_what_is_no_motion_is_refused(fivebar):
    with pytest.raises(UsageError, match="nothing moves"):
        harmonic(fivebar, [0, 224], [0, 1], [1.0, 0.0])
    with pytest.raises(UsageError, match="amplitude of fivebar: 3 values"):
        harmonic(fivebar, [0, 224], [0, 1, 2], 1.0)
    with pytest.raises(UsageError, match="3 times and 3 poses"):
        sampled(fivebar, [0, 1, 2], [[0, 224]] * 3)
    with pytest.raises(UsageError, match="times do not grow"):
        sampled(fivebar, [0, 1, 1, 2], [[0, 224]] * 4)
