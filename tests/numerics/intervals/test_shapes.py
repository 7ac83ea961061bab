import numpy as np

from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.shapes import broadcast, concatenate, empty, stack


def test_definedness_goes_with_the_bounds():
    item = 1 / Interval.of([-1.0, 1.0], [1.0, 2.0])
    both = stack([item, Interval.of([3.0, 4.0])])
    assert both.defined.tolist() == [[False, True], [True, True]]
    assert concatenate([item, Interval.of([3.0])]).defined.tolist() == [False, True, True]
    wide = broadcast(item, (3, 2))
    assert wide.shape == (3, 2)
    assert not wide.defined[:, 0].any()


def test_a_single_flag_is_widened():
    item = Interval(np.zeros(3), np.ones(3), np.array(True))
    assert stack([item, item]).defined.shape == (3, 2)
    assert concatenate([empty(3), stack([item], axis=0)]).shape == (1, 3)
