from fractions import Fraction

import numpy as np
import pytest

from assur.numerics import krawczyk
from assur.numerics.intervals import interval, rounding
from assur.numerics.intervals.interval import Interval
from assur.numerics.krawczyk import derivative, image, inflated, proves, refutes, tightened
from assur.numerics.recording import interval_program


def circle_and_line(_, x):
    """x^2 + y^2 = 25, 4 x = 3 y: zeros (3, 4) and (-3, -4)."""
    return [x[0] * x[0] + x[1] * x[1] - 25, 4 * x[0] - 3 * x[1]]


def test_a_box_about_a_zero_is_proved_and_its_image_holds_the_zero():
    box = Interval.of([[2.9, 3.9], [-3.1, -4.1]], [[3.1, 4.1], [-2.9, -3.9]])
    found = image(circle_and_line, box)
    assert proves(found, box).all()
    assert not refutes(found, box).any()
    assert found.contains([[3.0, 4.0], [-3.0, -4.0]]).all()


def test_a_box_beside_a_zero_is_refuted():
    box = Interval.of([[3.2, 4.2]], [[3.4, 4.4]])
    found = image(circle_and_line, box)
    assert refutes(found, box).all()
    assert not proves(found, box).any()


def test_a_box_with_both_zeros_is_neither():
    box = Interval.of([[-5.0, -5.0]], [[5.0, 5.0]])
    found = image(circle_and_line, box)
    assert not proves(found, box).any()
    assert not refutes(found, box).any()


def test_a_double_zero_proves_nothing():
    box = Interval.of([[-0.1]], [[0.1]])
    found = image(lambda _, x: [x[0] * x[0]], box)
    assert not proves(found, box).any()
    assert not refutes(found, box).any()


def test_where_the_derivative_has_no_bounds_nothing_is_proved():
    box = Interval.of([[-0.1], [0.9]], [[0.1], [1.1]])
    found = image(lambda ns, x: [ns.sqrt(x[0]) - 1], box)
    assert found.defined[:, 0].tolist() == [False, True]
    assert proves(found, box).tolist() == [False, True]
    assert refutes(found, box).tolist() == [False, False]


def test_bounds_of_the_derivative_hold_its_values():
    rng = np.random.default_rng(3)
    low = rng.uniform(0.5, 2.0, (200, 2))
    high = low + rng.uniform(0, 0.5, (200, 2))
    found = derivative(lambda ns, x: [x[0] * x[1] / (x[0] + 1), ns.sqrt(x[1]) * x[0]], Interval.of(low, high))
    x, y = rng.uniform(low, high).T
    exact = np.array([[y / (x + 1) ** 2, x / (x + 1)], [np.sqrt(y), x / (2 * np.sqrt(y))]]).transpose(2, 0, 1)
    assert found.contains(exact).all()


def squares_enclosed(count: int = 400) -> bool:
    """Whether the root of each of many floats lies within its narrow box, by exact fractions."""
    numbers = np.random.default_rng(5).uniform(0.1, 100.0, count)
    start = inflated(Interval.of(np.sqrt(numbers)[:, None] * (1 - 1e-6), np.sqrt(numbers)[:, None] * (1 + 1e-6)))
    found = tightened(lambda _, x: [x[0] * x[0] - numbers], start)
    rows = zip(found.low[:, 0].tolist(), found.high[:, 0].tolist(), numbers.tolist(), strict=True)
    return all(Fraction(low) ** 2 <= Fraction(number) <= Fraction(high) ** 2 for low, high, number in rows)


def test_narrow_boxes_hold_the_zero_exactly():
    assert squares_enclosed()


@pytest.mark.usefixtures("by_numpy")
def test_rounding_that_is_off_is_noticed(monkeypatch):
    for name in ("down", "up", "down_sum", "up_sum"):
        monkeypatch.setattr(rounding, name, lambda result: np.asarray(result, dtype=float))
    assert not squares_enclosed()


def test_a_containment_test_that_is_reversed_is_noticed(monkeypatch):
    within = interval.Interval.within
    monkeypatch.setattr(interval.Interval, "within", lambda one, other: within(other, one))
    with pytest.raises(AssertionError):
        test_a_box_about_a_zero_is_proved_and_its_image_holds_the_zero()


@pytest.mark.parametrize("size", range(1, krawczyk.SMALL + 1))
def test_machine_code_moves_boxes_as_numpy_does(monkeypatch, size):
    """The same bits, of images that prove something, that have no bounds and that are not defined."""
    rng = np.random.default_rng(size)
    middle, inverse = rng.normal(size=(40, size)), rng.normal(size=(40, size, size))
    offset, here = (Interval.of(low - rng.random(low.shape), low) for low in (0 * middle, middle))
    low = rng.normal(size=(40, size, size))
    low[3, 0, 0], inverse[4] = -np.inf, 0.0
    slopes = Interval(low, low + rng.random(low.shape), rng.random(low.shape) < 0.9)
    found = []
    for there in (True, False):
        monkeypatch.setattr(interval_program, "_DONE", interval_program._Done(interval_program.REPAID, there))
        found.append(krawczyk._moved(middle, offset, here, slopes, inverse))
    for part in ("low", "high", "defined"):
        np.testing.assert_array_equal(getattr(found[0], part), getattr(found[1], part))
