"""Laws of intervals: what stays enclosed, what is never defined again, shapes, and the IEEE 1788 test vectors."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import UsageError
from assur.numerics.intervals.interval import Interval, as_interval, common

NUMBERS = st.floats(min_value=-1e6, max_value=1e6)
SHARES = st.floats(min_value=0, max_value=1)
BOXES = st.tuples(NUMBERS, NUMBERS).map(sorted)

KERNELS = {
    "sum of squares": lambda x, y, root: root(x * x + y * y),
    "quotient": lambda x, y, _: (x - 3 * y) / (2 + y * y) + 1 / (1 + abs(x)),
    "meeting": lambda x, y, root: (x * y - 2.5 * root(x * x + 4)) / (x * x + y * y + 0.25),
    "signs": lambda x, y, root: -x * (+y) - (5 - x) * root(abs(y)),
}


def floats_root(radicand):
    return np.sqrt(np.maximum(radicand, 0.0))


@given(BOXES, BOXES, SHARES, SHARES, st.sampled_from(sorted(KERNELS)))
def test_the_float_answer_of_a_number_inside_lies_inside(x, y, s, t, name):
    inside = [low + share * (high - low) for (low, high), share in ((x, s), (y, t))]
    inside = [np.float64(min(max(number, low), high)) for number, (low, high) in zip(inside, (x, y), strict=True)]
    answer = KERNELS[name](Interval.of(*x), Interval.of(*y), Interval.sqrt)
    number = KERNELS[name](*inside, floats_root)
    slack = 1e-12 * (1 + abs(number)) + 1e-9 * max(map(abs, inside))  # the float itself is rounded, without bounds
    assert answer.defined
    assert answer.low - slack <= number <= answer.high + slack


@given(BOXES, BOXES, SHARES, SHARES, st.sampled_from(sorted(KERNELS)))
def test_a_part_of_a_box_has_a_part_of_its_answer(x, y, s, t, name):
    """Inclusion is monotone: to the last bit, because every step outwards is."""
    ends = [sorted((low + 0.5 * s * (high - low), high - 0.5 * t * (high - low))) for low, high in (x, y)]
    part = [
        Interval.of(*np.clip(pair, *box)) for pair, box in zip(ends, (x, y), strict=True)
    ]  # halves meet to rounding
    small = KERNELS[name](*part, Interval.sqrt)
    large = KERNELS[name](Interval.of(*x), Interval.of(*y), Interval.sqrt)
    assert large.low <= small.low <= small.high <= large.high


@pytest.mark.parametrize("operation", ["__add__", "__sub__", "__mul__", "__truediv__"])
def test_inclusion_is_monotone_for_nasty_intervals(operation, nasty_intervals):
    rng = np.random.default_rng(0)
    size = len(nasty_intervals.low)
    a, b, c, d = (nasty_intervals[rng.integers(size, size=20_000)] for _ in range(4))
    if operation == "__truediv__":  # of nothing but zero there is no quotient; its bounds, the whole line, say so
        kept = b.magnitude > 0
        a, b, c, d = a[kept], b[kept], c[kept], d[kept]
    wide = [Interval.of(np.minimum(p.low, q.low), np.maximum(p.high, q.high)) for p, q in ((a, c), (b, d))]
    small, large = getattr(a, operation)(b), getattr(wide[0], operation)(wide[1])
    assert np.all((large.low <= small.low) & (small.high <= large.high))
    assert not np.any(large.defined & ~small.defined)


def test_bounds_are_never_nan_and_never_the_wrong_infinity(nasty_intervals):
    rng = np.random.default_rng(1)
    size = len(nasty_intervals.low)
    x, y = (nasty_intervals[rng.integers(size, size=50_000)] for _ in range(2))
    pairs = [x + y, x - y, x * y, x / y, common(x, y)[0]]
    for found in [*pairs, x * x, -x, abs(x), x.sqrt(), x + 1, 2 - x, 3 * x, 1 / x, x / 7, x * 0.0, x / 0.0]:
        assert np.all((found.low <= found.high) & (found.low < np.inf) & (found.high > -np.inf))


def test_a_square_is_never_negative_and_a_product_of_two_may_be():
    x, y = Interval.of(-1.0, 2.0), Interval.of(-1.0, 2.0)
    assert (x * x).low == 0
    assert (x * x).high >= 4
    assert (x * y).low <= -2
    assert (x * x + y * y).low == 0  # so that the root of it is defined
    assert (x * x + y * y).sqrt().defined


@pytest.mark.parametrize("undefined", [1 / Interval.of(-1.0, 1.0), Interval.of(-1.0, 4.0).sqrt(), as_interval(np.nan)])
def test_what_is_not_defined_stays_so(undefined):
    fine = Interval.of(2.0, 3.0)
    found = [
        undefined + fine, fine - undefined, undefined * 0.0, 0.0 * undefined, fine / undefined, undefined / fine,
        -undefined, +undefined, abs(undefined), undefined * undefined, undefined.sqrt(), common(fine, undefined)[0],
        undefined + 1, 1 - undefined, undefined[()],
    ]  # fmt: skip
    for number in found:
        assert not number.defined
        assert not number.positive | number.negative | number.nonzero
        assert not number.within(Interval.of(-np.inf, np.inf))
    far = Interval(np.float64(7.0), np.float64(8.0), np.asarray(False))
    assert not far.positive
    assert not far.within(Interval.of(0.0, 9.0))
    assert not common(far, fine)[1], "having nothing in common proves nothing"


def test_nan_and_infinity_are_no_numbers():
    x = Interval.of([1.0, 2.0, 3.0], [2.0, 3.0, 4.0])
    number = np.array([np.nan, np.inf, 1.0])
    for found in (x + number, number - x, x * number, x / number, number / x):
        assert found.defined.tolist() == [False, False, True]
        assert np.all(found.low <= found.high)
    assert np.all(np.isinf((x + number).low[:2]))


def test_division_by_what_touches_zero_has_one_bound():
    found = Interval.of([1.0, -2.0, 1.0, -2.0], [2.0, -1.0, 2.0, -1.0]) / Interval.of(
        [0.0, 0.0, -4.0, -4.0], [4.0, 4.0, -0.0, 0.0]
    )
    np.testing.assert_allclose(found.low, [0.25, -np.inf, -np.inf, 0.25])
    np.testing.assert_allclose(found.high, [np.inf, -0.25, -0.25, np.inf])
    assert not np.any(found.defined)


def test_signed_zeros_are_the_same_zero():
    for zero in (0.0, -0.0):
        assert (Interval.of(1.0, 2.0) / Interval.of(zero, 4.0)).low > 0.24
        assert (Interval.of(1.0, 2.0) / Interval.of(-4.0, zero)).high < -0.24
        assert not (1 / Interval.of(zero)).defined
        assert Interval.of(zero).contains(-zero)
        assert Interval.of(zero).sqrt().defined
        assert float((Interval.of(-1.0, 1.0) * zero).width) == 0


def test_the_root_of_what_is_negative_is_that_of_floats():
    found = Interval.of([-4.0, -4.0, 0.0, 4.0], [-1.0, 9.0, 9.0, 9.0]).sqrt()
    assert found.defined.tolist() == [False, False, True, True]
    assert found.high[0] == 0
    assert found.contains([0.0, 0.0, 0.0, 2.0]).all()
    assert found.contains([0.0, 3.0, 3.0, 3.0]).all()


@pytest.mark.parametrize("bounds", [(2.0, 1.0), (np.nan, 1.0), (0.0, np.nan), (np.inf, np.inf), (-np.inf, -np.inf)])
def test_a_set_without_numbers_is_refused(bounds):
    with pytest.raises(UsageError, match="low <= high"):
        Interval.of([0.0, bounds[0]], [1.0, bounds[1]])


def test_middle_width_and_magnitude(nasty_intervals):
    x = nasty_intervals
    assert np.all(np.isfinite(x.middle))
    assert np.all(x.contains(x.middle))
    np.testing.assert_array_equal(x.width == 0, x.low == x.high)
    bounded = np.isfinite(x.low) & np.isfinite(x.high)
    np.testing.assert_array_equal(np.isinf(x.width[~bounded]), True)
    for low, high, width in zip(x.low[bounded], x.high[bounded], x.width[bounded], strict=True):
        assert np.isinf(width) or Fraction(width) >= Fraction(high) - Fraction(low)
    assert np.all((x.magnitude >= np.abs(x.low)) & (x.magnitude >= np.abs(x.high)))
    assert Interval.of(1.0, 3.0).middle == 2


def test_common_and_within():
    x, y = Interval.of([0.0, 0.0, 0.0], [2.0, 2.0, 2.0]), Interval.of([1.0, 3.0, 2.0], [3.0, 4.0, 5.0])
    found, nothing = common(x, y)
    assert nothing.tolist() == [False, True, False]
    assert (found.low.tolist(), found.high.tolist()) == ([1.0, 0.0, 2.0], [2.0, 2.0, 2.0])
    inner = Interval.of([0.5, 0.0, 0.5], [1.5, 1.0, 2.0])
    assert inner.within(x).tolist() == [True, False, False]


@pytest.mark.parametrize("left", [np.array([1.0, -1.0, 2.0]), np.int8([1, -1, 1]), np.float64(2.0), 3, np.array(2.0)])
def test_an_array_on_the_left_leaves_the_operator_to_the_interval(left):
    x = Interval.of([2.0, 3.0, 5.0], [2.5, 3.5, 5.5])
    for found, exact in (
        (left + x, left + x.low),
        (left - x, left - x.low),
        (left * x, left * x.low),
        (left / x, left / x.low),
    ):
        assert isinstance(found, Interval)
        assert found.contains(exact).all()


def test_signs_on_a_leading_axis_broadcast_and_every_part_has_the_shape():
    signs, x = np.int8([[1], [-1]]), Interval.of([2.0, 3.0, 5.0], [2.5, 3.5, 5.5])
    scalar = Interval.of(2.0, 3.0)
    for found in (
        signs * x,
        x - signs,
        signs / x,
        x / signs,
        scalar * signs + x,
        common(scalar, x)[0],
    ):
        assert found.low.shape == found.high.shape == found.defined.shape == found.shape
        assert found.shape in {(2, 3), (3,)}
    assert (signs * scalar).shape == (signs * scalar).defined.shape == (2, 1)
    assert x[1:].shape == (2,)
    assert (x[0] * x[0]).low == pytest.approx(4)


def test_no_operation_changes_its_arguments():
    x, y = Interval.of([1.0, -1.0], [2.0, 3.0]), Interval.of([0.0, 1.0], [2.0, 3.0])
    for _ in (x + y, x - y, x * y, x / y, x * x, x.sqrt(), abs(x), -x, x * 2, x / 2, common(x, y)):
        assert (x.low.tolist(), x.high.tolist()) == ([1.0, -1.0], [2.0, 3.0])
        assert (y.low.tolist(), y.high.tolist()) == ([0.0, 1.0], [2.0, 3.0])


# ---- IEEE 1788 ----------------------------------------------------------------------------------------------

OPERATIONS = {
    "pos": lambda x: +x,
    "neg": lambda x: -x,
    "add": lambda x, y: x + y,
    "sub": lambda x, y: x - y,
    "mul": lambda x, y: x * y,
    "div": lambda x, y: x / y,
    "recip": lambda x: 1 / x,
    "sqr": lambda x: x * x,
    "sqrt": lambda x: x.sqrt(),
    "abs": abs,
    "intersection": lambda x, y: common(x, y)[0],
}
FLOATS_WIDER = {"add": 2, "sub": 2, "sqrt": 2, "mul": 1, "div": 1, "recip": 1, "sqr": 1}
"""By how many floats a bound may lie outside the tightest one, beside 2^-959; the others are exact."""


@pytest.mark.parametrize("name", OPERATIONS)
def test_the_standard_s_vectors(name, vectors):
    """Ours holds the tightest answer and is wider by the stated number of floats.

    We have no empty set: what the standard answers by it is not defined here, or has nothing in common.
    """
    cases = [(given_ones, result) for operation, given_ones, result in vectors if operation == name]
    assert len(cases) >= 3
    for given_ones, result in cases:
        if None in given_ones:
            continue
        arguments = [Interval.of(*bounds) for bounds in given_ones]
        ours = OPERATIONS[name](*arguments)
        if result is None:
            assert common(*arguments)[1] if name == "intersection" else not ours.defined, given_ones
            continue
        assert ours.low <= result[0], given_ones
        assert ours.high >= result[1], given_ones
        assert ours.low >= _wider(result[0], -np.inf, FLOATS_WIDER.get(name, 0)), given_ones
        assert ours.high <= _wider(result[1], np.inf, FLOATS_WIDER.get(name, 0)), given_ones


def _wider(bound, towards, floats):
    with np.errstate(over="ignore"):
        answer = np.float64(bound)
        for _ in range(floats):
            answer = np.nextafter(answer, towards)
        least = np.copysign(2.0**-959 if floats else 0.0, towards)
        return min(answer, bound + least) if towards < 0 else max(answer, bound + least)
