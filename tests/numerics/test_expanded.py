"""Polynomials expanded as a number type: against plain arithmetic, and their arrays against differences."""

import numpy as np
import pytest

from assur.errors import UsageError
from assur.numerics.expanded import Expanded, expand, unknowns


def cubic(x, y, z, t):
    """A kernel over any numbers, homogeneous of degree 3 in x, y, z and of degree 2 in t."""
    return (2 - t) * x * y * (x - z) - (y + 3 * z) * z * z * (t * t + 1) + x * x * x - 0 * y


def conic(x, y, z, t):
    return x * x - (1 - t) * y * z + -z * z


def mixed(x, y, z, t):
    return x * y - t * z


def random_points(count, seed=0):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(count, 4)) + 1j * rng.normal(size=(count, 4))


def value(polynomial, point):
    return sum(factor * np.prod(point ** np.array(exponents)) for exponents, factor in polynomial.terms.items())


@pytest.mark.parametrize("kernel", [cubic, conic])
def test_an_expanded_kernel_has_the_kernels_values(kernel):
    polynomial = kernel(*unknowns(4))
    for point in random_points(5):
        assert value(polynomial, point) == pytest.approx(kernel(*point), rel=1e-13)


def test_arrays_may_stand_on_either_side():
    (x,) = unknowns(1)
    factor = np.array([1.0, 2.0])
    for polynomial in (factor * x - factor, x * factor + -factor, -(factor - factor * x)):
        assert isinstance(polynomial, Expanded)
        np.testing.assert_array_equal(polynomial.terms[(1,)], factor)
        np.testing.assert_array_equal(polynomial.terms[(0,)], -factor)


def test_a_system_has_the_kernels_values_and_derivatives():
    system = expand([cubic(*unknowns(4)), conic(*unknowns(4))])
    points = random_points(6, seed=1)
    x, t, problem = points[:, :3], points[:, 3], np.zeros(6, dtype=int)
    found, slope, rate = system.evaluate(x, t, problem)
    np.testing.assert_allclose(found.T, [kernel(*x.T, t) for kernel in (cubic, conic)], rtol=1e-13)
    step = 1e-6
    for k in range(4):
        ahead, behind = points.copy(), points.copy()
        ahead[:, k] += step
        behind[:, k] -= step
        difference = np.array([(kernel(*ahead.T) - kernel(*behind.T)) / (2 * step) for kernel in (cubic, conic)]).T
        np.testing.assert_allclose(slope[..., k] if k < 3 else rate, difference, rtol=1e-7, atol=1e-8)


def test_problems_of_a_batch_are_told_apart():
    x, y, t = unknowns(3)
    system = expand([x * x - np.array([1.0, 4.0, 9.0]) * y * y * (1 + t)])
    root, zero = np.array([[1, 1], [2, 1], [3, 1]], dtype=complex), np.zeros(3)
    np.testing.assert_allclose(system.evaluate(root, zero, np.arange(3))[0], 0, atol=1e-15)
    assert np.all(system.evaluate(root, zero, np.array([1, 2, 0]))[0] != 0)


@pytest.mark.parametrize("kernels", [[cubic], [cubic, conic, conic], [cubic, mixed]])
def test_a_system_that_is_not_square_or_not_homogeneous_is_refused(kernels):
    with pytest.raises(UsageError, match="homogeneous equations are wanted"):
        expand([kernel(*unknowns(4)) for kernel in kernels])
