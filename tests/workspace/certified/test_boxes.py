"""Boxes: parts fill the whole without a gap."""

import numpy as np

from assur.workspace.certified.boxes import Boxes, together

RNG = np.random.default_rng(3)


def some(count=50, size=3):
    ends = np.sort(RNG.normal(size=(2, size, count)) * 100, axis=0)
    return Boxes(ends[0], ends[1])


def test_halves_meet_and_fill():
    boxes = some()
    axis = RNG.integers(3, size=len(boxes))
    halves = boxes.halved(axis)
    first, second = halves[: len(boxes)], halves[len(boxes) :]
    every = np.arange(len(boxes))
    np.testing.assert_array_equal(first.high[axis, every], second.low[axis, every])
    np.testing.assert_array_equal(first.low, boxes.low)
    np.testing.assert_array_equal(second.high, boxes.high)
    np.testing.assert_allclose(first.sizes.middle + second.sizes.middle, boxes.sizes.middle, rtol=1e-12)


def test_a_grid_of_parts_has_the_ends_of_the_whole_and_no_gaps():
    boxes = some(4)
    parts = boxes.divided([3, 1, 5])
    assert len(parts) == 4 * 15
    for k in range(4):
        own = parts[slice(15 * k, 15 * (k + 1))]
        for axis, count in enumerate((3, 1, 5)):
            low, high = np.unique(own.low[axis]), np.unique(own.high[axis])
            assert len(low) == count
            assert low[0] == boxes.low[axis, k]
            assert high[-1] == boxes.high[axis, k]
            np.testing.assert_array_equal(high[:-1], low[1:])


def test_sizes_enclose_the_volume():
    boxes = Boxes(np.array([[0.1], [0.2]]), np.array([[0.4], [0.7]]))
    assert boxes.sizes.low[0] < 0.15 < boxes.sizes.high[0]


def test_the_middle_is_inside_even_of_the_thinnest_box():
    low = np.array([[1.0]])
    boxes = Boxes(low, np.nextafter(low, 2.0))
    assert boxes.low[0, 0] <= boxes.middles[0, 0] <= boxes.high[0, 0]


def test_all_parts_in_their_order():
    boxes = some(6)
    found = together([boxes[:2], boxes[2:]])
    np.testing.assert_array_equal(found.low, boxes.low)
