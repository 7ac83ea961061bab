"""The power coefficient against the maximum it is defined by, and against pitches and distances of screws."""

import numpy as np
import pytest

from assur.numerics import rotations
from assur.performance.power import power_coefficient

RNG = np.random.default_rng(11)


def screws(count=50):
    wrench, twist = RNG.normal(size=(2, count, 6))
    return wrench, twist, RNG.normal(size=(count, 3))


def characteristic_point(wrench, point):
    """Foot of the perpendicular from a point on the axis of a wrench, by least squares on the line."""
    moment, force = wrench[:3], wrench[3:]
    axis = np.cross(force, moment) / (force @ force)
    return axis + force * (force @ (point - axis)) / (force @ force)


def test_it_is_the_share_of_the_most_that_any_direction_gives():
    directions = RNG.normal(size=(200_000, 3))
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    for wrench, twist, point in zip(*screws(8), strict=True):
        force = wrench[3:]
        centre = characteristic_point(wrench, point)
        pitch = wrench[:3] @ force / (force @ force)
        velocity = twist[3:] + np.cross(twist[:3], centre)
        powers = np.abs(directions @ velocity + pitch * (directions @ twist[:3]))
        own = abs(force @ velocity / np.linalg.norm(force) + pitch * force @ twist[:3] / np.linalg.norm(force))
        assert power_coefficient(wrench, twist, point) == pytest.approx(own / powers.max(), rel=1e-3)


def test_the_most_is_that_of_two_screws_with_pitches_and_distance():
    """|t o w|_max = sqrt((h_t + h_w)^2 + d^2), d from the characteristic point to the axis of the twist."""
    for wrench, twist, point in zip(*screws(), strict=True):
        force, angular = wrench[3:], twist[:3]
        h_w = wrench[:3] @ force / (force @ force)
        h_t = twist[3:] @ angular / (angular @ angular)
        on_axis = np.cross(angular, twist[3:]) / (angular @ angular)
        away = characteristic_point(wrench, point) - on_axis
        distance = np.linalg.norm(np.cross(away, angular)) / np.linalg.norm(angular)
        power = abs(wrench[:3] @ angular + force @ twist[3:]) / np.linalg.norm(force) / np.linalg.norm(angular)
        expected = power / np.hypot(h_t + h_w, distance)
        assert power_coefficient(wrench, twist, point) == pytest.approx(expected, rel=1e-10)


def test_it_depends_on_no_frame_and_no_scale():
    wrench, twist, point = screws()
    before = power_coefficient(wrench, twist, point)
    turn, shift = rotations.from_vector(np.array([0.3, -1.1, 0.7])), np.array([2.0, -0.5, 1.0])
    moved = []
    for screw, linear_last in ((wrench, False), (twist, True)):
        free, bound = (screw[:, :3], screw[:, 3:]) if linear_last else (screw[:, 3:], screw[:, :3])
        free, bound = free @ turn.T, bound @ turn.T
        bound = bound + np.cross(shift, free)
        moved.append(np.concatenate([free, bound] if linear_last else [bound, free], axis=-1))
    after = power_coefficient(3.0 * moved[0], -0.2 * moved[1], point @ turn.T + shift)
    np.testing.assert_allclose(after, before, rtol=1e-9)


@pytest.mark.parametrize(
    ("wrench", "twist", "expected"),
    [
        ([0, 0, 0, 3, 0, 4], [0, 0, 0, 0, 0, 2], 0.8),  # force and translation
        ([3, 0, 4, 0, 0, 0], [0, 0, 2, 0, 0, 0], 0.8),  # couple and rotation
        ([3, 0, 4, 0, 0, 0], [0, 0, 0, 0, 0, 2], 0.0),  # a couple moves no point
        ([0, 0, 0, 1, 0, 0], [0, 0, 1, 0, 0, 0], 0.0),  # the axis of the turn meets the characteristic point
        ([0, 0, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], 0.0),
    ],
)
def test_couples_and_translations(wrench, twist, expected):
    found = power_coefficient(np.array(wrench, float), np.array(twist, float), np.zeros(3))
    assert found == pytest.approx(expected, abs=1e-15)


def test_a_couple_is_the_limit_of_wrenches_with_less_and_less_force():
    couple, twist = np.array([3.0, 0, 4, 0, 0, 0]), np.array([0.3, 0.1, 2, 0.4, 0.5, 0.6])
    limit = power_coefficient(couple, twist, np.zeros(3))
    force = np.array([0, 0, 0, 3.0, 0, 4])
    gaps = [abs(power_coefficient(couple + size * force, twist, np.zeros(3)) - limit) for size in (1e-3, 1e-6, 1e-12)]
    assert 1e-5 < gaps[0] < 1e-2
    assert gaps[1] < 1e-5
    assert gaps[2] < 1e-11  # counted as a couple from here on
