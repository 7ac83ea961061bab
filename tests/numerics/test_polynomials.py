"""Polynomials: the algebra against SymPy, the roots against their construction, double roots and roots at infinity."""

import numpy as np
import pytest
import sympy as sp

from assur.numerics import polynomials as py
from work import calls

RANDOM = np.random.default_rng(4)


def test_algebra_over_symbols_is_that_of_sympy():
    a, b, c, t = sp.symbols("a b c t")
    first, second = (a, 0, b), (c, 1)

    def as_poly(coefficients):
        return sp.Add(*(value * t**k for k, value in enumerate(coefficients)))

    assert sp.expand(as_poly(py.multiply(first, second)) - as_poly(first) * as_poly(second)) == 0
    assert sp.expand(as_poly(py.subtract(first, second)) - as_poly(first) + as_poly(second)) == 0


def test_a_plain_zero_stays_plain():
    product = py.multiply((0, np.ones(3)), (0, np.ones(3)))
    assert product[0] == 0
    assert isinstance(product[0], int)
    assert isinstance(product[1], int)


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_half_angle_is_the_same_function(degree):
    terms = {(i, j): RANDOM.normal() for i in range(degree + 1) for j in range(degree + 1 - i)}
    angle = RANDOM.uniform(-3, 3, 20)
    t = np.tan(angle / 2)
    wanted = sum(value * np.cos(angle) ** i * np.sin(angle) ** j for (i, j), value in terms.items())
    found = np.polynomial.polynomial.polyval(t, np.array(py.half_angle(terms, degree))) / (1 + t * t) ** degree
    assert found == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize("degree", [1, 2, 6, 16])
def test_roots_give_the_polynomial_back(degree):
    coefficients = RANDOM.normal(size=(2, 3, degree + 1))
    found = py.roots(coefficients)
    assert found.shape == (2, 3, degree)
    for given, roots in zip(coefficients.reshape(-1, degree + 1), found.reshape(-1, degree), strict=True):
        again = np.polynomial.polynomial.polyfromroots(roots) * given[-1]
        assert again == pytest.approx(given, abs=1e-10 * np.max(np.abs(given)) * max(1, np.max(np.abs(roots))))


def angles_of(coefficients):
    """Angles (d,) of the roots in tan(angle/2), and which of them are real but for the rounding of a double one."""
    found = py.angle_of(py.roots(coefficients))
    return found.real, np.abs(found.imag) < 1e-6


def test_real_roots_of_known_position():
    wanted = np.sort(RANDOM.uniform(-2, 2, (50, 6)), axis=-1)
    coefficients = np.array([np.polynomial.polynomial.polyfromroots(row) for row in wanted])
    apart = np.min(np.diff(wanted, axis=-1), axis=-1) > 0.05
    assert np.sum(apart) > 5
    assert py.roots(coefficients)[apart] == pytest.approx(wanted[apart], abs=1e-7)


def test_roots_that_lie_together_are_told_apart_by_what_the_coefficients_are_of():
    wanted = np.array([0.7, 0.7001, 0.71, 0.72, -0.4, 3.0])
    rough = py.roots(np.polynomial.polynomial.polyfromroots(wanted) * (1 + 1e-13 * RANDOM.normal(size=7)))

    def values(at):
        gaps = at[..., None] - wanted
        gaps[gaps == 0] = 1e-300
        return np.abs(np.prod(gaps, axis=-1)), np.sum(1 / gaps, axis=-1)

    assert np.max(np.abs(np.sort(rough.real) - np.sort(wanted))) > 1e-8
    assert np.sort(py.approached(rough, values).real) == pytest.approx(np.sort(wanted), abs=1e-14)
    with np.errstate(invalid="ignore"):
        assert np.isinf(py.approached(np.append(rough, np.inf), values)[-1])


def test_far_and_near_roots_at_once():
    wanted = np.array([1e-9, 1.0, 2.0, 1e9])
    found = py.roots(np.polynomial.polynomial.polyfromroots(wanted))
    assert found.real == pytest.approx(wanted, rel=1e-12)


def test_degenerate_polynomials():
    found = py.roots([[0.0, 0, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1], [np.nan, 1, 1, 1], [-6, 3, 0, 0]])
    assert np.all(np.isnan(found[[0, 3]]))
    assert np.all(np.isinf(found[1]))
    assert np.all(found[2] == 0)
    assert found[4, 0] == 2
    assert np.all(np.isinf(found[4, 1:]))


@pytest.mark.parametrize("angle", [-3.0, -1.2, 0.0, 0.4, np.pi])
@pytest.mark.parametrize("offset", [-1e-15, 0.0, 1e-15])
def test_a_double_angle_is_not_lost(angle, offset):
    """(1 - cos(a - angle) + offset) (cos(a - 0.3) - 0.5): a double angle, rounded either way, and two simple ones."""
    double = py.half_angle({(0, 0): 1 + offset, (1, 0): -np.cos(angle), (0, 1): -np.sin(angle)}, 1)
    simple = py.half_angle({(0, 0): -0.5, (1, 0): np.cos(0.3), (0, 1): np.sin(0.3)}, 1)
    found, real = angles_of(np.array(py.multiply(double, simple), dtype=float))
    assert np.all(real)
    turned = np.abs(np.exp(1j * found) - np.exp(1j * angle))
    nearest = np.sort(turned)[:2]
    assert np.all(nearest < 3e-7)
    others = np.sort(found[np.argsort(turned)[2:]])
    assert others == pytest.approx([0.3 - np.pi / 3, 0.3 + np.pi / 3], abs=1e-12)


@pytest.mark.parametrize("gap", [1e-5, 1e-3])
def test_two_real_roots_stay_two_and_a_complex_pair_stays_complex(gap):
    found, real = angles_of(np.polynomial.polynomial.polyfromroots([0.5, 0.5 + gap, -2]))
    assert np.all(real)
    assert np.diff(np.sort(found))[-1] > gap
    complex_pair = np.polynomial.polynomial.polymul([0.25 + gap * gap, -1, 1], [2, 1])
    assert np.sum(angles_of(complex_pair)[1]) == 1


def test_the_unit_of_the_unknown_does_not_count():
    """In millimetres or in kilometres: the same double root."""
    for size in (1e-6, 1.0, 1e6):
        found = py.roots(np.polynomial.polynomial.polyfromroots(size * np.array([1, 1, -3])))
        assert found / size == pytest.approx([-3, 1, 1], abs=1e-6)


@pytest.mark.parametrize("place", [0.0, 0.7, -30.0, 1e6, np.inf])
@pytest.mark.parametrize("gap", [0.0, 1e-9, 1e-4])
def test_nearness_tells_a_double_root_from_two(place, gap):
    """Two roots at twice the arctangent of a place, real or complex, gap apart, beside simple ones of both kinds."""
    angle = 2 * np.arctan(place)
    others = np.polynomial.polynomial.polymul([1.0, 0.3, 1.1], [-2.0, 1.0])
    for sense in (1, -1):
        # cos^2 of half the distance to the angle is 0 there; less or more by gap^2 makes two roots or none
        pair = py.half_angle({(0, 0): 1 - sense * gap**2 / 2, (1, 0): -np.cos(angle), (0, 1): -np.sin(angle)}, 1)
        coefficients = np.array(py.multiply(pair, others))
        real, count = py.nearness(coefficients, py.roots(coefficients), np.full(len(coefficients), 1e-14))
        doubtful = gap < 1e-6
        assert np.sum(real & (count > 1)) == (2 if doubtful else 0)
        assert np.sum(real & (count == 1)) == 1 + (0 if doubtful or sense < 0 else 2)


def test_nearness_counts_the_roots_that_lie_together():
    for many in (1, 2, 3, 4):
        coefficients = np.polynomial.polynomial.polyfromroots([0.4] * many + [3.0, -2.0, 1j, -1j]).real
        real, count = py.nearness(coefficients, py.roots(coefficients), 1e-13 * np.abs(coefficients))
        assert np.sum(real) == many + 2
        assert sorted(count[real].tolist()) == sorted([1, 1] + [many] * many)


def test_a_real_root_below_a_complex_pair_is_simple():
    """p is zero at the real point below the pair, but not because of the pair."""
    coefficients = np.array([0.0, 1.0, 0.0, 1.0])  # t (t^2 + 1)
    real, count = py.nearness(coefficients, py.roots(coefficients), 1e-14 * np.abs(coefficients) + 1e-14)
    assert np.sum(real) == 1
    assert count[real].tolist() == [1]


def test_nearness_of_degenerate_polynomials_is_nothing():
    coefficients = np.array([[0.0, 0.0, 0.0], [np.nan, 1.0, 1.0]])
    real, count = py.nearness(coefficients, py.roots(coefficients), np.zeros((2, 3)))
    assert not np.any(real)
    assert count.tolist() == [[1, 1], [1, 1]]


def test_ten_thousand_of_degree_eight_at_once():
    """By no more calls than a thousand of them."""
    coefficients = RANDOM.normal(size=(10_000, 9))
    found = py.roots(coefficients)
    assert calls(lambda: py.roots(coefficients)) <= calls(lambda: py.roots(coefficients[:1000]))
    value = np.abs(sum(coefficients[:, k, None] * found**k for k in range(9)))
    bound = sum(np.abs(coefficients[:, k, None] * found**k) for k in range(9))
    assert np.max(value / bound) < 1e-12
