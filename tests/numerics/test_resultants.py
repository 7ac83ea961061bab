"""Three quadrics: eight points that are known beforehand, and eight complex ones that are not."""

import itertools
from fractions import Fraction

import numpy as np
import pytest

from assur.numerics import polynomials, resultants

CUBE = np.array(list(itertools.product((-1, 1), repeat=3)))


def planes_squared(row, offset):
    """(row . (t, x, y) - offset)^2 - 1 = 0: two parallel planes."""
    t, x, y = row
    constant = (-offset, t)
    square = polynomials.multiply(constant, constant)
    return (
        (x * x,),
        (2 * x * y,),
        (y * y,),
        polynomials.scaled(constant, 2 * x),
        polynomials.scaled(constant, 2 * y),
        polynomials.add(square, (-1,)),
    )


def parallelepiped(rng, number=float):
    """Three pairs of planes and the eight corners (8, 3) in which they meet."""
    matrix, offset = rng.integers(-5, 6, size=(3, 3)), rng.integers(-5, 6, size=3)
    while round(np.linalg.det(matrix)) == 0:
        matrix = rng.integers(-5, 6, size=(3, 3))
    three = tuple(
        planes_squared([number(int(part)) for part in row], number(int(b)))
        for row, b in zip(matrix, offset, strict=True)
    )
    return three, np.linalg.solve(matrix, (CUBE + offset).T).T


def value(coefficients, t):
    return sum(part * t**k for k, part in enumerate(coefficients))


@pytest.mark.parametrize("seed", range(12))
def test_roots_are_the_corners_of_a_parallelepiped(seed):
    three, corners = parallelepiped(np.random.default_rng(seed))
    coefficients = np.array(resultants.eliminant(three), dtype=float)
    assert coefficients.shape == (9,)
    wanted = np.polynomial.polynomial.polyfromroots(corners[:, 0])
    np.testing.assert_allclose(coefficients / coefficients[-1], wanted, rtol=1e-6, atol=1e-9 * np.abs(wanted).max())
    for t, x, y in corners:
        alone = np.sort(np.abs(corners[:, 0] - t))[1] > 1e-6
        if alone:
            np.testing.assert_allclose(resultants.other_two(three, t)[:2], (x, y), rtol=1e-7, atol=1e-7)


def test_fractions_stay_exact():
    three, corners = parallelepiped(np.random.default_rng(3), Fraction)
    coefficients = resultants.eliminant(three)
    assert all(isinstance(part, Fraction) for part in coefficients)
    for t in corners[:, 0]:
        exact = Fraction(float(t)).limit_denominator(10_000)
        assert value(coefficients, exact) == 0


def test_eight_complex_points_of_quadrics_at_random():
    rng = np.random.default_rng(1)
    degrees = (0, 0, 0, 1, 1, 2)
    for _ in range(20):
        three = tuple(tuple(tuple(rng.normal(size=d + 1)) for d in degrees) for _ in range(3))
        found = polynomials.roots(np.array(resultants.eliminant(three), dtype=float))
        assert found.shape == (8,)
        for t in found:
            x, y, apart = resultants.other_two(three, t)
            size = (1 + abs(t) + abs(x) + abs(y)) ** 2
            for quadric in three:
                parts = [value(part, t) for part in quadric]
                total = np.dot(parts, [x * x, x * y, y * y, x, y, 1])
                assert abs(total) < 1e-6 * size / min(1.0, abs(apart) ** 0.5)


def test_the_determinant_vanishes_where_two_points_share_t():
    three = (planes_squared((0, 1, 0), 0), planes_squared((0, 0, 1), 0), planes_squared((1, 1, -1), 0))
    # x = y = 1 and x = y = -1 both have t = 1 or t = -1
    with np.errstate(divide="ignore", invalid="ignore"):
        assert resultants.other_two(three, np.array(1.0))[2] == pytest.approx(0.0, abs=1e-20)


def test_the_square_that_vanishes_has_no_scale():
    three, corners = parallelepiped(np.random.default_rng(3))
    larger = tuple(
        tuple(polynomials.scaled(part, factor) for part in quadric)
        for quadric, factor in zip(three, (7, 0.3, 50), strict=True)
    )
    t = corners[0, 0]
    assert resultants.other_two(larger, t)[2] == pytest.approx(resultants.other_two(three, t)[2], rel=1e-9)


def test_quadratic_parts_need_not_give_the_squares_at_a_fixed_t():
    """x y = 2, x t = 3 and x^2 + y^2 + t^2 = 5 give x^4 - 5 x^2 + 13 = 0; the other four points are at infinity."""
    three = (
        ((0,), (1,), (0,), (0,), (0,), (-2,)),
        ((0,), (0,), (0,), (0, 1), (0,), (-3,)),
        ((1,), (0,), (1,), (0,), (0,), (-5, 0, 1)),
    )
    coefficients = np.trim_zeros(np.array(resultants.eliminant(three), dtype=float), "b")
    assert len(coefficients) == 5
    x = np.roots([1, 0, -5, 0, 13])
    for t in 3 / x:
        assert abs(value(coefficients, t)) < 1e-9 * np.abs(coefficients).max()


def test_sums_of_squares_meet_where_each_of_them_is_one():
    """Circles of radius 1 about three axes, as cylinders: the eight points are met, and mended where they are not."""
    rng = np.random.default_rng(4)
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    axes = np.array([axes[0], axes[1], np.cross(axes[0], axes[1]) + 0.3 * axes[0]])
    shift = 0.2 * rng.normal(size=3)
    sums = [
        [(-float(row @ shift), tuple(row)) for row in np.linalg.svd(axis[None])[2][1:]]
        for axis in axes
    ]  # fmt: skip
    quadrics = tuple(map(resultants.sum_of_squares, sums))
    met = 0
    for t in polynomials.roots(np.array(resultants.eliminant(quadrics), dtype=float)):
        if abs(t.imag) < 1e-9:
            x, y, _ = resultants.other_two(quadrics, t.real)
            point = np.array(resultants.ASKEW).T @ (t.real, x, y)
            wrong = tuple(point + 1e-4 * rng.normal(size=3))
            for place, gap in ((tuple(point), 1e-6), (resultants.nearer(sums, wrong), 1e-12)):
                totals = [sum((k + np.dot(f, place)) ** 2 for k, f in forms) for forms in sums]
                np.testing.assert_allclose(totals, 1, atol=gap)
            met += 1
    assert met in (4, 6, 8)
