"""Dual numbers against derivatives known by hand, against complex steps, and beside arrays and scalars."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.numerics.dual import Dual, DualIntervals, Duals
from assur.numerics.intervals.interval import Interval

FINITE = st.floats(min_value=-50.0, max_value=50.0)


def straight_line(a, b, sqrt):
    """Every operation that a kernel may use, with a constant on either side."""
    root = sqrt(2 + a * a + b * b)
    return (3 - a) / root - b * root + (+b) / 4 - (1 / root) * (-a) + (a - 5) + (2.5 * b)


def complex_step(a, b, a_rate, b_rate, step=1e-30):
    """An independent derivative, exact to rounding for a function that is analytic."""
    return straight_line(complex(a, step * a_rate), complex(b, step * b_rate), np.sqrt).imag / step


@given(FINITE, FINITE, FINITE, FINITE)
def test_derivative_agrees_with_the_complex_step(a, b, a_rate, b_rate):
    found = straight_line(Dual(a, a_rate), Dual(b, b_rate), Duals().sqrt)
    size = 1.0 + (abs(a_rate) + abs(b_rate)) * (1.0 + a * a + b * b)
    assert found.value == pytest.approx(straight_line(a, b, np.sqrt), abs=1e-12 * size)
    assert found.derivative == pytest.approx(complex_step(a, b, a_rate, b_rate), abs=1e-12 * size)


@pytest.mark.parametrize(
    ("operation", "value", "derivative"),
    [
        (lambda t: t + 2, 5.0, 7.0),
        (lambda t: 2 + t, 5.0, 7.0),
        (lambda t: t - 2, 1.0, 7.0),
        (lambda t: 2 - t, -1.0, -7.0),
        (lambda t: t * 2, 6.0, 14.0),
        (lambda t: 2 * t, 6.0, 14.0),
        (lambda t: t / 2, 1.5, 3.5),
        (lambda t: 6 / t, 2.0, -6 * 7 / 9),
        (lambda t: -t, -3.0, -7.0),
        (lambda t: t - t * t, -6.0, 7.0 - 42.0),
        (lambda t: t / (t * t), 1 / 3, -7 / 9),
        (lambda t: (t + 1) * (t + 1), 16.0, 56.0),
    ],
)
def test_each_operation_at_three_moving_at_seven(operation, value, derivative):
    found = operation(Dual(3.0, 7.0))
    assert (found.value, found.derivative) == (pytest.approx(value), pytest.approx(derivative))


@pytest.mark.parametrize("left", [np.array([1.0, -1.0, 2.0]), np.int8([1, -1, 1]), np.float64(2.0)])
def test_an_array_or_a_numpy_scalar_on_the_left_leaves_the_operator_to_the_dual(left):
    right = Dual(np.array([4.0, 5.0, 8.0]), np.array([1.0, 2.0, 3.0]))
    value, rate = right.value, right.derivative
    cases = [
        (left * right, left * value, left * rate),
        (left + right, left + value, rate),
        (left - right, left - value, -rate),
        (left / right, left / value, -left * rate / (value * value)),
    ]
    for found, wanted, wanted_rate in cases:
        assert isinstance(found, Dual)
        np.testing.assert_allclose(found.value, wanted, rtol=1e-15)
        np.testing.assert_allclose(found.derivative, wanted_rate, rtol=1e-15)


def test_signs_on_a_leading_axis_broadcast_over_a_batch():
    signs = np.int8([[1], [-1]])  # (2, 1)
    found = signs * Duals().sqrt(Dual(np.array([4.0, 9.0, 16.0]), np.ones(3)))
    np.testing.assert_array_equal(found.value, [[2, 3, 4], [-2, -3, -4]])
    np.testing.assert_allclose(found.derivative, [[1 / 4, 1 / 6, 1 / 8], [-1 / 4, -1 / 6, -1 / 8]])


@pytest.mark.parametrize("shape", [(), (1,), (3, 1, 2)])
def test_every_batch_shape_is_kept(shape):
    found = straight_line(Dual(np.full(shape, 2.0), np.ones(shape)), Dual(np.full(shape, 3.0), 0.0), Duals().sqrt)
    assert np.shape(found.value) == np.shape(found.derivative) == shape


def test_root_of_a_constant_has_no_derivative_of_its_own():
    root = Duals().sqrt(16.0)
    assert (root.value, root.derivative) == (4.0, 0.0)


def test_root_at_and_below_zero_has_the_value_of_floats_and_no_derivative():
    root = Duals().sqrt(Dual(np.array([4.0, 0.0, -4.0]), np.array([1.0, 1.0, 0.0])))
    np.testing.assert_array_equal(root.value, [2.0, 0.0, 0.0])
    np.testing.assert_array_equal(root.derivative, [0.25, np.nan, np.nan])


def test_no_dual_is_changed_in_place():
    value, rate = np.array([1.0, 2.0]), np.array([3.0, 4.0])
    number = Dual(value, rate)
    straight_line(number, number, Duals().sqrt)
    np.testing.assert_array_equal(number.value, [1.0, 2.0])
    np.testing.assert_array_equal(number.derivative, [3.0, 4.0])
    with pytest.raises(AttributeError):
        number.value = rate


@given(FINITE, FINITE, FINITE, FINITE, st.floats(0, 1), st.floats(0, 2))
def test_duals_of_intervals_bound_the_duals_inside(a, b, a_rate, b_rate, share, width):
    a_inside, b_inside = min(a + share * width, a + width), min(b + share * width, b + width)
    number = straight_line(Dual(a_inside, a_rate), Dual(b_inside, b_rate), Duals().sqrt)
    boxes = [Dual(Interval.of(x, x + width), Interval.of(rate)) for x, rate in ((a, a_rate), (b, b_rate))]
    bounds = straight_line(*boxes, DualIntervals().sqrt)
    assert bounds.value.contains(number.value)  # to the last bit: every float operation lies between the rounded ones
    assert bounds.derivative.contains(number.derivative)
    assert bounds.value.defined
    assert bounds.derivative.defined


def test_an_interval_on_the_left_leaves_the_operator_to_the_dual():
    box, dual = Interval.of(2.0, 3.0), Dual(Interval.of(4.0, 5.0), Interval.of(1.0))
    for found, value, slope in (
        (box * dual, 10.0, 2.5), (box + dual, 6.5, 1.0), (box - dual, -2.0, -1.0), (box / dual, 0.5, -0.15)
    ):  # fmt: skip
        assert isinstance(found, Dual)
        assert found.value.contains(value)
        assert found.derivative.contains(slope)


def test_the_slope_of_a_root_over_a_box_is_not_defined_where_the_radicand_may_vanish():
    radicand = Dual(Interval.of([4.0, 0.0, -1.0, -2.0], [9.0, 9.0, 9.0, -1.0]), Interval.of(1.0))
    root = DualIntervals().sqrt(radicand)
    assert root.value.defined.tolist() == [True, True, False, False]
    assert root.derivative.defined.tolist() == [True, False, False, False]
    assert root.derivative.contains([1 / 4, 1 / 6, 1 / 6, 0]).tolist()[:3] == [True, True, True]
    constant = DualIntervals().sqrt(4.0)
    assert constant.value.contains(2.0)
    assert constant.derivative.contains(0.0)


@pytest.mark.parametrize(("value", "slope"), [(3.0, 2.0), (-3.0, -2.0), (0.0, 0.0)])
def test_the_magnitude_of_floats(value, slope):
    found = abs(Dual(np.array(value), 2.0))
    assert (found.value, found.derivative) == (abs(value), slope)


@pytest.mark.parametrize(
    ("low", "high", "least", "most"), [(1.0, 4.0, 2.0, 2.0), (-4.0, -1.0, -2.0, -2.0), (-1.0, 4.0, -2.0, 2.0)]
)
def test_the_magnitude_of_intervals_has_every_slope_between_its_points(low, high, least, most):
    found = abs(Dual(Interval.of(low, high), Interval.of(2.0)))
    assert found.value.contains(max(abs(low), abs(high)))
    assert found.derivative.low <= least <= most <= found.derivative.high
    assert found.derivative.width - (most - least) < 1e-14
    x = np.linspace(low, high, 9)
    slopes = np.diff(np.abs(x)) / np.diff(x) * 2.0
    assert np.all((found.derivative.low <= slopes + 1e-12) & (slopes - 1e-12 <= found.derivative.high))
