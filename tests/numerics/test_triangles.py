"""A triangle on three circles: the polynomial against the distances, over arrays and over exact fractions."""

from fractions import Fraction

import numpy as np
import pytest

from assur.numerics import polynomials, triangles


def _case(rng, count):
    """Centres and corners, angles and places (count,), and the squares that go with them."""
    centres, corners = (tuple((point[0], point[1]) for point in rng.normal(size=(3, 2))) for _ in range(2))
    angle = rng.uniform(-np.pi, np.pi, count)
    x, y = rng.normal(size=(2, count))
    turned = [triangles.rotated(corner, (np.cos(angle), np.sin(angle))) for corner in corners]
    squares = tuple((x + tx - cx) ** 2 + (y + ty - cy) ** 2 for (tx, ty), (cx, cy) in zip(turned, centres, strict=True))
    return centres, corners, squares, angle, (x, y)


def _real_angles(centres, corners, squares):
    """Angles (count, 6) of the real roots; NaN for the others."""
    coefficients = np.stack(np.broadcast_arrays(*triangles.polynomial(centres, corners, squares)), axis=-1)
    angles = polynomials.angle_of(polynomials.roots(coefficients))
    return np.where(np.abs(angles.imag) < 1e-6, angles.real, np.nan)


def test_the_true_angle_is_a_root_and_gives_the_place_back():
    centres, corners, squares, angle, place = _case(np.random.default_rng(2), 200)
    angles = _real_angles(centres, corners, squares)
    assert angles.shape == (200, 6)
    gaps = np.abs(np.exp(1j * angles) - np.exp(1j * angle)[:, None])
    assert np.max(np.nanmin(gaps, axis=-1)) < 1e-6
    found, _ = triangles.position(centres, corners, squares, (np.cos(angle), np.sin(angle)))
    assert np.median(np.hypot(found[0] - place[0], found[1] - place[1])) < 1e-12


def test_every_real_root_is_on_the_three_circles():
    centres, corners, squares, _, _ = _case(np.random.default_rng(3), 200)
    angles = _real_angles(centres, corners, squares)
    for k in range(6):
        turn = (np.cos(angles[:, k]), np.sin(angles[:, k]))
        (x, y), area = triangles.position(centres, corners, squares, turn)
        real = np.isfinite(angles[:, k]) & (np.abs(area) > 0.05)
        for (cx, cy), corner, square in zip(centres, corners, squares, strict=True):
            tx, ty = triangles.rotated(corner, turn)
            assert np.max(np.abs((x + tx - cx) ** 2 + (y + ty - cy) ** 2 - square)[real]) < 1e-6


@pytest.mark.parametrize("t", [0, 1, -1, 2, -2, 3, -3, 4])
def test_the_polynomial_is_cramers_rule_put_into_the_first_circle(t):
    """Over rational numbers, at more places than the degree: (|p|^2 - r1^2) D^2 (1 + t^2)^3."""
    one = Fraction(1)
    centres, corners = ((0, 0), (7 * one, 1), (2, 5 * one)), ((0, 0), (3 * one, 1), (1, 4 * one))
    squares = (9 * one, 16 * one, 11 * one)
    found = sum(value * t**k for k, value in enumerate(triangles.polynomial(centres, corners, squares)))
    turn = ((1 - one * t * t) / (1 + t * t), 2 * one * t / (1 + t * t))
    (a, b), (c, d) = (
        np.subtract(triangles.rotated(corner, turn), centre)
        for centre, corner in zip(centres[1:], corners[1:], strict=True)
    )
    e, f = ((square - squares[0] - x * x - y * y) / 2 for square, x, y in zip(squares[1:], (a, c), (b, d), strict=True))
    determinant = a * d - b * c
    place = ((e * d - b * f) / determinant, (a * f - e * c) / determinant)
    wanted = (place[0] ** 2 + place[1] ** 2 - squares[0]) * determinant**2 * (1 + t * t) ** 3
    assert found == wanted


@pytest.mark.parametrize("through", [((0, 0), (1, 0), (0, 2)), ((3, 1), (3, 1), (3, 1))])
def test_lines_through_one_point(through):
    point = (2.0, -1.0)
    directions = tuple((x - point[0], y - point[1]) for x, y in through)
    assert triangles.lines(directions, through) == pytest.approx(0)
    assert triangles.lines(((1, 0), (0, 1), (1, 1)), ((0, 0), (0, 0), (1, 0))) != 0
