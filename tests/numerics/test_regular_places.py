"""Regular places: the nearest float to each decimal place, so that parts of a grid are parts of the whole."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.numerics.regular_places import EXACT, regular_places

DECIMALS = st.decimals(-10_000, 10_000, places=3)


@given(DECIMALS, DECIMALS, st.integers(2, 400))
def test_each_is_the_nearest_float(low, high, count):
    places = regular_places(float(low), float(high), count)
    step = Fraction(high - low) / (count - 1)
    assert [float(Fraction(low) + k * step) for k in range(count)] == places.tolist()


@given(DECIMALS, st.decimals("0.001", 10, places=3), st.integers(3, 200), st.data())
def test_a_part_of_a_grid_has_its_places_to_the_bit(low, step, count, data):
    cut = data.draw(st.integers(1, count - 2))
    ends = [float(low + k * step) for k in (0, cut, cut + 1, count - 1)]
    whole = regular_places(ends[0], ends[3], count)
    first, second = regular_places(*ends[:2], cut + 1), regular_places(*ends[2:], count - cut - 1)
    np.testing.assert_array_equal(np.concatenate([first, second[: count - cut - 1]]), whole)


@pytest.mark.parametrize(("low", "high"), [(1e-300, 1e300), (0.1, 1 / 3), (-1e60, 1e-60), (5e-324, 5e-324)])
def test_numbers_that_need_more_than_a_float_for_their_quotients(low, high):
    places, step = regular_places(low, high, 7), (Fraction(repr(high)) - Fraction(repr(low))) / 6
    assert places.tolist() == [float(Fraction(repr(low)) + k * step) for k in range(7)]


def test_both_ways_to_work_them_out_agree_where_they_meet():
    near = (EXACT - 1) // 6
    for high in (near, near + 1):
        assert regular_places(0.0, float(high), 7).tolist() == [k * high / 6 for k in range(7)]


def test_one_place_is_the_middle():
    assert regular_places(3.0, 3.0, 1).tolist() == [3.0]
