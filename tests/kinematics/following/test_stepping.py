"""The loop that follows: every way comes to its end or to its shortest step, however a guard judges."""

import numpy as np
import pytest

from assur.kinematics.following.stepping import Pace, Places, followed


class Wall:
    """Lets nothing by beyond its place; notes how far steps wanted to go."""

    def __init__(self, place):
        self.place, self.tried = place, []

    def step(self, _way, here, ends, _rows):
        self.tried.append(ends.copy())
        return Places(ends, here.joints, here.known), ends <= self.place, 2.0 * (ends - here.shares)


def begun(count):
    return Places(np.zeros(count), np.zeros((count, 1)), np.zeros((count, 1, 1)))


@pytest.mark.parametrize("end", [0.02, 0.1, 0.13, 0.15, 0.3, 1.0])
@pytest.mark.parametrize("place", [0.0, 0.05, 0.21, 0.97])
def test_a_way_ends_within_the_tolerance_of_what_stops_it(end, place):
    here, guard = begun(3), Wall(place)
    arrived = followed(None, here, guard, Pace(0.1), np.array([1.0, 0.1, 0.01]), end)
    assert len(guard.tried) < 30
    np.testing.assert_array_equal(arrived, np.full(3, end <= place))
    np.testing.assert_array_equal(here.shares == end, arrived)
    assert np.all(here.shares <= place) or np.all(arrived)
    assert np.all(arrived | (here.shares >= min(place, end) - 0.16))


def test_no_step_is_longer_than_the_pace_allows_and_none_is_left_that_is_too_short():
    here, guard = begun(1), Wall(1.0)
    assert followed(None, here, guard, Pace(0.1, largest=0.3), np.array([1.0]))[0]
    np.testing.assert_allclose(np.concatenate(guard.tried), [0.3, 0.6, 0.9, 1.0])


def test_so_many_steps_are_tried_and_no_more():
    here, guard = begun(1), Wall(1.0)
    assert not followed(None, here, guard, Pace(1e-3, largest=0.01, most=7), np.array([0.01]))[0]
    assert len(guard.tried) == 7
